"""What the environments have in common of their options."""

from __future__ import annotations

from typing import Any

from ._tolman import Maze


def maze_option(options: dict[str, Any] | None) -> Maze | str | None:
    """Return the maze that `reset` is asked for: a Maze, the name of a family, or None."""
    for name, value in (options or {}).items():
        if name != "maze" or not isinstance(value, (Maze, str)):
            raise ValueError(f"options has {name!r}: {value!r}, but may only have 'maze': a Maze or the name of a family")
    return (options or {}).get("maze")


def check_render_mode(mode: str | None) -> None:
    """Refuse what no environment can show."""
    if mode not in (None, "rgb_array"):
        raise ValueError(f"render_mode is {mode!r} but has to be None or 'rgb_array'")
