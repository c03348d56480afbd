"""Sends a mapper of one's own into the arena of the command `tolman`."""

from __future__ import annotations

import json
import os
import shlex
import shutil
import subprocess
import sys
from collections.abc import Sequence
from typing import Any

from ._mapper import Mapper

# Set in a mapper's process: a file that also calls `arena` would start processes without end.
IS_SERVING = "TOLMAN_MAPPER"


def arena(
    mapper: type[Mapper],
    *,
    families: str | Sequence[str] = "all",
    worlds: int = 2,
    seed: int = 1,
    robot: str = "own",
    condition: str = "as-made",
    system: str | None = None,
    log: bool = False,
    command: str | None = None,
) -> list[dict[str, Any]]:
    """Send a mapper into `worlds` worlds of each family, and return a row for each of them.

    Parameters
    ----------
    mapper : class made of `Mapper`
        It has to stand at the top of a file or module, where another process finds it.
    families : str or sequence of str
        The kinds of mazes, or "all". `tolman arena --help` lists them.
    worlds : int
        The number of worlds of each family.
    seed : int
        The same seed gives the same worlds.
    robot : str
        The robot that drives, or "own" for that of MSLST Better.
    condition : str
        What is changed of the worlds and the robot; "as-made" is nothing.
    system : str or None
        A system whose rows follow, or "all".
    log : bool
        Whether to show what the mapper prints and raises.
    command : str or None
        The program `tolman`; None takes the one on the PATH.

    Returns
    -------
    list of dict
        What `tolman arena --json` writes: `system`, `world`, `right`, `purity`, `link_recall`, `found`, `why` and more.

    Raises
    ------
    TypeError, ValueError
        If the mapper is not such a class or stands in no file, or the command refuses an option.
    FileNotFoundError
        If there is no command.
    RuntimeError
        If the command fails, or the file of the mapper calls the arena when it is imported.
    """
    if IS_SERVING in os.environ:
        raise RuntimeError('tolman.arena is called while its mapper is looked up: put the call under if __name__ == "__main__":')
    words = [sys.executable, "-m", "tolman._serve", *_found_by(mapper)]
    program = command or shutil.which("tolman")
    if program is None:
        raise FileNotFoundError("there is no command tolman on the PATH: install it, or give command=")
    asked = ["arena", "--json", "--mapper", shlex.join(words), "--worlds", str(worlds), "--seed", str(seed)]
    asked += ["--robot", robot, "--condition", condition]
    asked += [] if system is None else ["--system", system]
    asked += ["--log"] if log else []
    # The mapper's process finds the modules that this one finds.
    finds = {**os.environ, "PYTHONPATH": os.pathsep.join(path or os.getcwd() for path in sys.path)}
    rows: list[dict[str, Any]] = []
    for family in [families] if isinstance(families, str) else families:
        held = subprocess.run([program, *asked, "--family", family], env=finds, capture_output=True, encoding="utf-8")
        if held.returncode != 0:
            fault = ValueError if held.returncode == 2 else RuntimeError
            raise fault(held.stderr.strip() or f"{program} ended with exit status {held.returncode}")
        if log:
            sys.stderr.write(held.stderr)
        rows += map(json.loads, held.stdout.splitlines())
    for row in rows:
        row["system"] = mapper.__name__ if row["system"] == shlex.join(words) else row["system"]
    return rows


def _found_by(mapper: Any) -> list[str]:
    """Return the module or file of a mapper, and its name: another process finds it by them."""
    if not isinstance(mapper, type) or not issubclass(mapper, Mapper):
        raise TypeError(f"mapper is {mapper!r} but has to be a class that is made of tolman.Mapper")
    name, source = mapper.__name__, mapper.__module__
    if mapper.__qualname__ != name:
        raise ValueError(f"{mapper.__qualname__} is not at the top of its file, where another process finds it: move it there")
    if source == "__main__":
        file = getattr(sys.modules[source], "__file__", None) or ""
        if not os.path.isfile(file):
            raise ValueError(f"{name} stands in no file, where another process finds it: put it into one and import it")
        source = os.path.abspath(file)
    return [source, name]
