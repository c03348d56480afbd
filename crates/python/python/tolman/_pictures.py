"""Pictures and frames that matplotlib and pandas make."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from ._tolman import Maze


def _needed(module: str) -> Any:
    """Return a module that only some methods need."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(f"this needs {module}: pip install {module.split('.')[0]}") from error


def _lines(ax: Any, lines: list[Any], **look: Any) -> Any:
    """Draw lines into axes, or into new ones, whose units are alike, and return the axes."""
    axes = _needed("matplotlib.pyplot").subplots()[1] if ax is None else ax
    axes.add_collection(_needed("matplotlib.collections").LineCollection(lines, **look))
    axes.set_aspect("equal")
    axes.autoscale_view()
    return axes


def plot_maze(ax: Any, maze: Maze) -> Any:
    """Draw the walls of a maze, S at its start and G at its goals."""
    walls = [
        ends
        for x in range(maze.width)
        for y in range(maze.height)
        for direction, ends in (
            ("north", [(x, y + 1), (x + 1, y + 1)]),
            ("east", [(x + 1, y), (x + 1, y + 1)]),
            ("south", [(x, y), (x + 1, y)]),
            ("west", [(x, y), (x, y + 1)]),
        )
        if not maze.is_open((x, y), direction)
    ]
    axes = _lines(ax, walls, colors="#222", linewidths=2)
    marks = [("G", goal) for goal in maze.goals] + ([] if maze.start is None else [("S", maze.start)])
    for letter, (x, y) in marks:
        axes.text(x + 0.5, y + 0.5, letter, ha="center", va="center")
    return axes


def plot_map(
    ax: Any, places: dict[int, dict[str, Any]], links: list[tuple[int, int]], path: npt.NDArray[np.float64]
) -> Any:
    """Draw the places whose position is known, their links, and the robot's way."""
    at = {place: known["position"] for place, known in places.items() if "position" in known}
    axes = _lines(ax, [(at[tail], at[head]) for tail, head in links if tail in at and head in at], colors="#999")
    if len(path) and not at:
        axes.plot(path[:, 0], path[:, 1], linewidth=0.8)
    if at:
        axes.scatter(*zip(*at.values()), s=16, zorder=2)
    return axes


def frame_of_places(places: dict[int, dict[str, Any]]) -> Any:
    """Return places as a frame of pandas."""
    pandas = _needed("pandas")
    rows = [(*known.get("position", (None, None)), known.get("landmark")) for known in places.values()]
    return pandas.DataFrame(rows, index=pandas.Index(list(places), name="id"), columns=["x", "y", "landmark"])
