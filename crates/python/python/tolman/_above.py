"""Pictures of a robot in a maze from above, as environments render them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ._tolman import Maze

# Pixels of a picture: from one cell to the next, and of a wall.
CELL, _WALL = 24, 3

Colour = tuple[int, int, int]

GOAL: Colour = (190, 235, 190)


def from_above(maze: Maze, robot: tuple[float, float, float], floors: Mapping[tuple[int, int], Colour]) -> Any:
    """Return an array of shape (rows, columns, 3) of uint8: walls, coloured floors and the robot.

    `robot` is x and y in cells from the south-west corner, and the heading, rad.
    """
    walls = maze.to_array()
    sizes = [[_WALL if at % 2 == 0 else CELL - _WALL for at in range(count)] for count in walls.shape]
    stands = walls.repeat(sizes[0], axis=0).repeat(sizes[1], axis=1)
    picture = np.full((*stands.shape, 3), 255, np.uint8)
    high = maze.height * CELL + _WALL
    for (east, north), colour in floors.items():
        top = high - (north + 1) * CELL - _WALL
        picture[top : top + CELL, east * CELL : (east + 1) * CELL + _WALL] = colour
    picture[stands == 1] = 0
    x, y, heading = robot
    rows, columns = np.ogrid[: stands.shape[0], : stands.shape[1]]
    for ahead, radius, colour in ((0.0, 5.0, (210, 40, 40)), (3.0, 1.5, (255, 255, 255))):
        column = x * CELL + _WALL / 2 + ahead * math.cos(heading)
        row = high - y * CELL - _WALL / 2 - ahead * math.sin(heading)
        picture[(rows - row) ** 2 + (columns - column) ** 2 <= radius**2] = colour
    return picture
