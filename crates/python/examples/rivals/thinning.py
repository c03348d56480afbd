"""Skeletons of floors.

Source: Zhang, Suen, "A Fast Parallel Algorithm for Thinning Digital Patterns", Communications of the
ACM 27 (1984), section 2.
"""

import numpy as np

# The neighbours P2 to P9 of the paper, as (row, column).
AROUND = [(-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1)]


def thinned(floor):
    """Return the skeleton of a floor. Its border has to be empty."""
    floor = floor.copy()
    while True:
        before = floor.sum()
        for is_second in (False, True):
            near = [np.roll(floor, (-row, -column), (0, 1)) for row, column in AROUND]
            north, _, east, _, south, _, west, _ = near
            count = np.sum(near, axis=0)
            begins = np.sum([~now & then for now, then in zip(near, near[1:] + near[:1])], axis=0)
            if is_second:
                keeps = (north & east & west) | (north & south & west)
            else:
                keeps = (north & east & south) | (east & south & west)
            floor &= ~((count >= 2) & (count <= 6) & (begins == 1) & ~keeps)
        if floor.sum() == before:
            return floor
