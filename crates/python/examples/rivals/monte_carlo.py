"""Monte Carlo localization on a grid map.

Source: Fox, Burgard, Dellaert, Thrun, "Monte Carlo Localization: Efficient Position Estimation for
Mobile Robots", AAAI 1999, with the beam model of Thrun, Burgard, Fox, "Probabilistic Robotics",
section 6.3 (a normal distribution around the expected range, and a uniform one). The number of
samples follows from how far they are spread: Fox, "Adapting the Sample Size in Particle Filters
Through KLD-Sampling", International Journal of Robotics Research 22 (2003), equation 8.
"""

import numpy as np
from clearance import clearance
from particle_maps import COMPASS, GAIN, SLIP, TURN_SLIP, VEER

SAMPLES, FEWEST = 4000, 200
# Error of the distribution that the number of samples allows, and the quantile of 99 %.
ERROR, QUANTILE = 0.05, 2.33
# Cells to drive until a scan counts again.
FRESH = 3
# Share of the ranges that anything may explain.
STRAY = 0.05
# Steps of a beam at most.
STRIDES = 12
# Beams beside each other see the same: of six, one counts.
EVERY = 6


class MonteCarlo:
    """Samples of the pose, x, y, m, and heading, rad, with their weights."""

    def __init__(self, walls, floor, corner, cell, heading, seed=0):
        self.far = clearance(walls, most=16)
        self.corner, self.cell = np.asarray(corner), cell
        self.random = np.random.default_rng(seed)
        cells = np.argwhere(floor)
        drawn = cells[self.random.integers(len(cells), size=SAMPLES)]
        spots = (drawn[:, ::-1] + self.corner + self.random.random((SAMPLES, 2))) * cell
        headings = self.random.uniform(-np.pi, np.pi, SAMPLES)
        if heading is not None:
            headings = heading + COMPASS * self.random.standard_normal(SAMPLES)
        self.poses = np.column_stack([spots, headings])
        self.weights = np.full(SAMPLES, 1 / SAMPLES)
        self.moved = np.inf

    def move(self, motion):
        """Move the samples by odometry, each with errors of its own."""
        noise = self.random.standard_normal((3, len(self.poses)))
        turn, way = (0, 0) if motion is None else motion
        self.moved += abs(way)
        self.poses[:, 2] += turn + noise[0] * np.hypot(TURN_SLIP * turn, VEER * way)
        gone = way * (1 + SLIP * noise[1])
        self.poses[:, 0] += gone * np.cos(self.poses[:, 2])
        self.poses[:, 1] += gone * np.sin(self.poses[:, 2])

    def look(self, scan):
        """Weigh the samples by a scan, and draw them again when few have all the weight.

        A second scan from the same place is no news.
        """
        if self.moved < FRESH * self.cell:
            return
        self.moved = 0.0
        picked = slice(None, None, EVERY)
        most = scan.ranges.max()
        along = self.poses[:, 2, None] + scan.bearings[picked]
        expected = expected_ranges(self.far, self.corner, self.cell, self.poses[:, :2], along, most)
        expected = np.minimum(expected, most)
        off = (expected - scan.ranges[picked]) / self.cell
        chance = (1 - STRAY) * np.exp(-(off**2) / 2) + STRAY * self.cell / most
        logs = GAIN * np.log(chance).sum(axis=1)
        self.weights *= np.exp(logs - logs.max())
        self.weights /= self.weights.sum()
        if 1 / np.sum(self.weights**2) < len(self.poses) / 2:
            self.draw_again()

    def draw_again(self):
        count = self.enough()
        spots = (self.random.random() + np.arange(count)) / count
        chosen = np.minimum(np.searchsorted(np.cumsum(self.weights), spots), len(self.poses) - 1)
        jitter = self.random.standard_normal((count, 3)) * [self.cell / 4, self.cell / 4, 0.01]
        self.poses = self.poses[chosen] + jitter
        self.weights = np.full(count, 1 / count)

    def enough(self):
        """Return how many samples the bins need that have weight; a bin is five cells wide."""
        likely = self.poses[self.weights > 1e-3 / len(self.poses), :2]
        bins = len(np.unique(np.floor(likely / (5 * self.cell)), axis=0))
        part = 2 / (9 * max(bins - 1, 1))
        count = (bins - 1) / (2 * ERROR) * (1 - part + np.sqrt(part) * QUANTILE) ** 3
        return int(np.clip(count, FEWEST, SAMPLES))

    def at(self, positions):
        """Return the weight of the samples that are nearest to each position."""
        off = self.poses[:, None, :2] - np.asarray(positions)
        return np.bincount((off**2).sum(axis=2).argmin(axis=1), self.weights, len(positions))


def expected_ranges(far, corner, cell, spots, along, most):
    """Return the ranges to expect, by steps as long as nothing can be in the way.

    `far` has how far each cell is from a wall, in cells; `along` the bearings from east, for all
    spots or a row for each.
    """
    ahead_x, ahead_y = np.cos(along), np.sin(along)
    reach = np.zeros((len(spots), np.shape(along)[-1]))
    for _ in range(STRIDES):
        x = np.floor((spots[:, 0, None] + reach * ahead_x) / cell).astype(int) - corner[0]
        y = np.floor((spots[:, 1, None] + reach * ahead_y) / cell).astype(int) - corner[1]
        free = far[np.clip(y, 0, len(far) - 1), np.clip(x, 0, far.shape[1] - 1)]
        step = np.maximum(free - 0.7, 0.5) * cell
        reach = np.where((free < 0.5) | (reach > most), reach, reach + step)
    return reach
