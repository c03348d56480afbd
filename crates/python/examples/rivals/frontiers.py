"""Where to explore next.

Source: Yamauchi, "A Frontier-Based Approach for Autonomous Exploration", CIRA 1997: the robot goes to
the nearest cell of known floor beside cells of which nothing is known.
"""

import numpy as np
from clearance import clearance
from floor_places import without_pockets

AROUND = [(dy, dx) for dy in (-1, 0, 1) for dx in (-1, 0, 1) if dx or dy]


def drivable(floor, walls, radius):
    """Return what a step into each cell costs: more near walls.

    It is infinite where the robot does not fit; `radius` is in cells.
    """
    far = clearance(walls, most=2 * round(radius) + 4)
    return np.where(without_pockets(floor, walls) & (far > radius), 1 + 4 / far.clip(1) ** 2, np.inf)


def frontier(floor, walls, cost):
    """Return the cells that a robot can reach beside unknown ones."""
    known = without_pockets(floor, walls) | walls
    beside = sum(np.roll(~known, shift, (0, 1)).astype(int) for shift in AROUND)
    return (cost < np.inf) & (beside >= 2)
