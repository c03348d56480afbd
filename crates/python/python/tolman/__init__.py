"""Quantizers, mazes, robots, planners, and systems that learn maps of mazes.

>>> import numpy as np, tolman
>>> gng = tolman.GNG(max_units=20).fit(np.random.default_rng(1).random((2000, 2)))
>>> gng.units_.shape
(20, 2)
>>> maze = tolman.Maze.generate("perfect", 5, 5, seed=1)
>>> learned = tolman.learn(maze, "mslst-better", seed=1)
"""

from tolman_quantizers import GNG, SOINN, AssociativeMemory, EquilibriumGNG, NotFittedError

from ._arena import arena
from ._mapper import Belief, Guess, Hello, Mapper, Place, PlaceMap, Step
from ._planners import Path, shortest_path
from ._tolman import BumpMap, Drive, Map, Maze, Mouse, Replay, Robot, learn, map_log, systems

__all__ = [
    "GNG",
    "SOINN",
    "AssociativeMemory",
    "Belief",
    "BumpMap",
    "Drive",
    "EquilibriumGNG",
    "Guess",
    "Hello",
    "Map",
    "Mapper",
    "Maze",
    "Mouse",
    "NotFittedError",
    "Path",
    "Place",
    "PlaceMap",
    "Replay",
    "Robot",
    "Step",
    "arena",
    "learn",
    "map_log",
    "shortest_path",
    "systems",
]
