"""Distances to the nearest cell of a set."""

import numpy as np


def clearance(is_in, most):
    """Return how far each cell is from the nearest of a set, in cells from middle to middle.

    Cells that are farther than `most` have that.
    """
    rows = np.where(is_in, 0.0, np.inf)
    for _ in range(most):  # along the rows
        rows[:, 1:] = np.minimum(rows[:, 1:], rows[:, :-1] + 1)
        rows[:, :-1] = np.minimum(rows[:, :-1], rows[:, 1:] + 1)
    squares = np.pad(rows**2, ((most, most), (0, 0)), constant_values=np.inf)
    height = len(rows)
    near = [squares[most + off : most + off + height] + off**2 for off in range(-most, most + 1)]
    return np.minimum(np.sqrt(np.min(near, axis=0)), most)
