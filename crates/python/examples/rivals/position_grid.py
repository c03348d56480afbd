"""Active Markov localization on a grid of positions.

Source: Fox, Burgard, Thrun, "Active Markov Localization for Mobile Robots", Robotics and Autonomous
Systems 25 (1998): beliefs over a grid (section 2), the expected entropy after an action, the
expected cost by the chance that a relative position is occupied (section 3.1 to 3.3). A compass
tells the heading, so that the grid has two dimensions.
"""

import numpy as np
from clearance import clearance
from monte_carlo import EVERY, FRESH, STRAY, expected_ranges
from particle_maps import GAIN
from ways import back, ways

# Positions that stand for the belief where the entropy is foreseen. How far off the targets are,
# and how far apart, in corridors.
FORESEEN, REACH, SPACING = 30, 3, 0.5
# What a corridor's width of driving, and a target that is surely occupied, cost beside a nat (β).
DRIVE, OCCUPIED = 0.05, 3.0
# Length of the longest beam, in cells, over which stray ranges are spread.
LONGEST = 13
# How far the belief spreads in a move, as a share of the weight that goes to the cells beside.
SPREAD = 0.02


class PositionGrid:
    """The belief that the robot is in each cell of a floor; all cells are off by less than one."""

    def __init__(self, fits, walls, corner, cell, width):
        self.fits, self.corner, self.cell, self.width = fits, np.asarray(corner), cell, width
        self.far = clearance(walls, most=16)
        self.belief = fits / fits.sum()
        self.offset, self.moved = np.zeros(2), np.inf

    def move(self, motion, heading):
        """Move the belief. What would be in a wall is lost."""
        self.offset += motion.distance * np.array([np.cos(heading), np.sin(heading)]) / self.cell
        self.moved += abs(motion.distance)
        whole = np.round(self.offset).astype(int)
        self.offset -= whole
        moved = np.roll(self.belief, whole[::-1], (0, 1))
        if motion.distance:
            beside = sum(np.roll(moved, by, axis) for by in (-1, 1) for axis in (0, 1))
            moved = (1 - 4 * SPREAD) * moved + SPREAD * beside
        self.settle(np.where(self.fits, moved, 0))

    def look(self, scan, heading):
        """Weigh the belief by a scan. A second one from the same place is no news."""
        if self.moved < FRESH * self.cell:
            return
        self.moved = 0.0
        rows, columns = np.nonzero(self.belief > 1e-7)
        expected = self.expected(np.column_stack([columns, rows]), heading + scan.bearings[::EVERY], scan)
        logs = self.log_chance(expected, scan.ranges[::EVERY])
        weighed = np.zeros_like(self.belief)
        weighed[rows, columns] = self.belief[rows, columns] * np.exp(logs - logs.max())
        self.settle(weighed)

    def settle(self, belief):
        """Take a belief, or begin again where it has nothing left."""
        total = belief.sum()
        self.belief = belief / total if total > 1e-12 else self.fits / self.fits.sum()

    def expected(self, cells, along, scan):
        """Return the ranges to expect in cells, as columns and rows."""
        spots = (cells + self.corner + 0.5 + self.offset) * self.cell
        most = scan.ranges.max()
        return np.minimum(expected_ranges(self.far, self.corner, self.cell, spots, along, most), most)

    def log_chance(self, expected, ranges):
        """Return the log-likelihood of ranges."""
        off = (expected - ranges) / self.cell
        return GAIN * np.log((1 - STRAY) * np.exp(-(off**2) / 2) + STRAY / LONGEST).sum(axis=-1)

    def likeliest(self):
        """Return the likeliest cell, as row and column, and the weight half a corridor around."""
        at = np.unravel_index(self.belief.argmax(), self.belief.shape)
        rows, columns = np.nonzero(self.belief)
        near = np.hypot(rows - at[0], columns - at[1]) <= self.width / self.cell / 2
        return (int(at[0]), int(at[1])), float(self.belief[rows[near], columns[near]].sum())

    def action(self, scan, heading, random):
        """Return the relative way, in cells, to where entropy falls most for what it costs."""
        rows, columns = np.nonzero(self.belief)
        chosen = random.choice(len(rows), FORESEEN, p=self.belief[rows, columns])
        cells = np.column_stack([columns[chosen], rows[chosen]])
        side = round(REACH * self.width / self.cell)
        occupied = self.occupied(cells, side)
        cost = (DRIVE * self.cell / self.width) + OCCUPIED * occupied
        found = ways((side, side), np.where(occupied < 0.9, cost, np.inf))
        step = round(SPACING * self.width / self.cell)
        around = range(side % step, 2 * side + 1, step)
        targets = [(row, column) for row in around for column in around if (row, column) in found]
        targets = [at for at in targets if at != (side, side)]
        if not targets:
            return None
        moves = np.array(targets)[:, ::-1] - side
        worth = self.foreseen(cells + moves[:, None], scan, heading) + [found[at][0] for at in targets]
        return [(row - side, column - side) for row, column in back(found, targets[int(worth.argmin())])]

    def occupied(self, cells, side):
        """Return the chance that each relative position is no floor."""
        floor = np.pad(self.fits, side)
        windows = [floor[row : row + 2 * side + 1, column : column + 2 * side + 1] for column, row in cells]
        return 1 - np.mean(windows, axis=0)

    def foreseen(self, cells, scan, heading):
        """Return the entropies to expect after the scan at one of some cells, by row of them."""
        along = heading + scan.bearings[::EVERY]
        expected = self.expected(cells.reshape(-1, 2), along, scan).reshape(*cells.shape[:2], -1)
        entropies = []
        for ranges in expected:
            logs = self.log_chance(ranges[:, None], ranges)
            chances = np.exp(logs - logs.max(axis=0))
            chances /= chances.sum(axis=0)
            entropies.append(-(chances * np.log(np.maximum(chances, 1e-12))).sum(axis=0).mean())
        return np.array(entropies)

    def at(self, positions):
        """Return the weight of the cells that are nearest to each position."""
        rows, columns = np.nonzero(self.belief > 1e-7)
        spots = (np.column_stack([columns, rows]) + self.corner + 0.5 + self.offset) * self.cell
        nearest = ((spots[:, None] - np.asarray(positions)) ** 2).sum(axis=2).argmin(axis=1)
        return np.bincount(nearest, self.belief[rows, columns], len(positions))
