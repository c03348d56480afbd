"""A Rao-Blackwellized particle filter for grid maps: improved proposal, adaptive resampling.

Source: Grisetti, Stachniss, Burgard, "Improved Techniques for Grid Mapping with Rao-Blackwellized
Particle Filters", IEEE Transactions on Robotics 23 (2007), algorithm 1 (sections III to V). Each
particle has a pose and a map of its own. Matching is by the hill climbing of section V, on cells
that keep the mean of their hits, as in the authors' public code (GMapping, OpenSLAM).
"""

import numpy as np
from wire import wrapped

PARTICLES = 15
# Poses drawn around the mode to find the mean and the variance of the proposal (K in the paper).
DRAWN = 20
# A cell has a wall if at least this share of the beams through it ended there (GMapping).
WALL = 0.25
# Part of a scan's log-likelihood that counts, since its beams are not independent (GMapping).
GAIN = 1 / 3
# Of so many hits one is matched (`lskip` in GMapping).
EVERY = 2
# Odometry's standard deviations: of a way for each metre, of a turn for each radian and each metre.
SLIP, TURN_SLIP, VEER = 0.2, 0.2, 0.1
# The compass's standard deviation, rad.
COMPASS = 0.03
# Cells that are added on a side where the map ends.
MARGIN = 24
AROUND = [(dx, dy) for dy in (-1, 0, 1) for dx in (-1, 0, 1)]


class ParticleMaps:
    """Particles of pose and map. `poses` has a row of x, y, m, and heading, rad, of each."""

    def __init__(self, cell, step, heading, seed=0):
        self.cell, self.step = cell, step
        self.random = np.random.default_rng(seed)
        self.poses = np.tile([0.0, 0.0, heading], (PARTICLES, 1))
        self.spread = np.full(3, 1e-9)
        self.log_weights, self.log_sums = np.zeros(PARTICLES), np.zeros(PARTICLES)
        side = 2 * MARGIN
        self.corner = np.array([-MARGIN, -MARGIN])
        # By particle, row and column: hits, beams through, and the sums of the hits' x and y.
        self.maps = np.zeros((4, PARTICLES, side, side), np.float32)
        self.walls = None
        self.moved, self.is_new = 0.0, True

    @property
    def best(self):
        """Return the number of the particle with the likeliest history."""
        return int(np.argmax(self.log_sums))

    def move(self, motion, compass):
        """Move all particles by odometry. The scan corrects them."""
        if motion is None:  # anything within a step
            self.spread += [self.step**2, self.step**2, 0.1]
            self.moved = np.inf
            turn = 0.0 if compass is None else wrapped(compass - self.poses[self.best, 2])
        else:
            way, turn = motion.distance, motion.turn
            self.moved += abs(way) + abs(turn) * self.step
            self.spread += [(SLIP * way) ** 2] * 2 + [(TURN_SLIP * turn) ** 2 + (VEER * way) ** 2]
        self.poses[:, 2] += turn
        if motion is not None:
            self.poses[:, 0] += way * np.cos(self.poses[:, 2])
            self.poses[:, 1] += way * np.sin(self.poses[:, 2])

    def look(self, scan, compass):
        """Correct, weigh and draw again by a scan, and draw it on the maps, if the robot moved."""
        if not self.is_new and self.moved < self.step:
            return
        if not self.is_new:
            self.correct(scan, compass)
        self.draw(scan)
        self.moved, self.is_new = 0.0, False
        weights = np.exp(self.log_weights - self.log_weights.max())
        weights /= weights.sum()
        if 1 / np.sum(weights**2) < PARTICLES / 2:
            places = (self.random.random() + np.arange(PARTICLES)) / PARTICLES
            chosen = np.minimum(np.searchsorted(np.cumsum(weights), places), PARTICLES - 1)
            self.poses, self.maps = self.poses[chosen], np.take(self.maps, chosen, axis=1)
            self.log_sums, self.log_weights = self.log_sums[chosen], np.zeros(PARTICLES)

    def correct(self, scan, compass):
        guess = self.poses.copy()
        self.grow(scan.ranges.max())
        self.walls = self.means(scan.ranges.max())
        deviation = np.sqrt(self.spread)

        def score(poses):
            """Return the log of the product of all likelihoods, for rows of poses by particle."""
            off = poses - guess[:, None]
            moved = np.sum((off / np.maximum(deviation, 1e-4)) ** 2, axis=2) / 2
            fit = GAIN * self.fit(poses, scan) - moved
            if compass is not None:
                fit -= (wrapped(poses[..., 2] - compass) / COMPASS) ** 2 / 2
            return fit

        mode, scores = self.climbed(guess, score)
        reach = np.minimum(deviation, self.cell / 2) + 1e-4
        drawn = mode[:, None] + self.random.uniform(-1, 1, (PARTICLES, DRAWN, 3)) * reach
        drawn[:, 0] = mode
        chances = score(drawn)
        shares = np.exp(chances - scores[:, None])
        sums = shares.sum(axis=1)
        shares /= sums[:, None]
        mean = np.einsum("nk,nki->ni", shares, drawn)
        off = drawn - mean[:, None]
        variance = np.einsum("nk,nki,nkj->nij", shares, off, off) + 1e-12 * np.eye(3)
        noise = self.random.standard_normal((PARTICLES, 3))
        self.poses = mean + np.einsum("nij,nj->ni", np.linalg.cholesky(variance), noise)
        gained = scores + np.log(sums)
        self.log_weights += gained
        self.log_sums += gained
        self.spread[:] = 1e-9

    def climbed(self, poses, score):
        """Climb to the nearest maximum, with halved steps where none of them leads up."""
        ways = np.vstack([np.zeros(3), np.eye(3), -np.eye(3)])
        steps = np.array([self.cell / 2, self.cell / 2, 0.03])
        best, numbers, halved = score(poses[:, None])[:, 0], np.arange(PARTICLES), 0
        while halved < 3:
            tried = poses[:, None] + ways * steps
            scores = score(tried)
            chosen = scores.argmax(axis=1)
            if np.all(scores[numbers, chosen] <= best + 1e-3):
                steps, halved = steps / 2, halved + 1
                continue
            poses, best = tried[numbers, chosen], scores[numbers, chosen]
        return poses, best

    def fit(self, poses, scan):
        """Return the log-likelihood of a scan by how far its hits are from those in the maps."""
        along = poses[..., 2, None] + scan.bearings[scan.met][::EVERY]
        reach = scan.ranges[scan.met][::EVERY]
        x, y = poses[..., 0, None] + reach * np.cos(along), poses[..., 1, None] + reach * np.sin(along)
        (first_column, first_row), mean_x, mean_y = self.walls
        height, width = mean_x.shape[1:]
        column = np.clip(np.floor(x / self.cell).astype(int) - first_column, 1, width - 2)
        row = np.clip(np.floor(y / self.cell).astype(int) - first_row, 1, height - 2)
        at = (np.arange(len(poses))[:, None, None] * height + row) * width + column
        near = at[..., None] + [dy * width + dx for dx, dy in AROUND]
        far = (mean_x.ravel()[near] - x[..., None]) ** 2 + (mean_y.ravel()[near] - y[..., None]) ** 2
        # A hit without a wall beside it counts as one that is a cell and a half off.
        off = np.minimum(far.min(axis=-1), (1.5 * self.cell) ** 2)
        return -off.sum(axis=-1) / (2 * (self.cell / 2) ** 2)

    def window(self, reach):
        """Return the cells that a scan can reach: the first column and row, and their slices."""
        low = np.floor((self.poses[:, :2].min(axis=0) - reach) / self.cell).astype(int) - 2
        high = np.floor((self.poses[:, :2].max(axis=0) + reach) / self.cell).astype(int) + 3
        columns, rows = (slice(*ends) for ends in zip(low - self.corner, high - self.corner))
        return low, (slice(None), rows, columns)

    def means(self, reach):
        """Return the mean of the hits in the cells around that are walls; others are far off."""
        low, cells = self.window(reach)
        hits, through, sum_x, sum_y = (part[cells] for part in self.maps)
        is_wall, count = (hits > 0) & (hits >= WALL * through), np.maximum(hits, 1)
        return low, *(np.where(is_wall, total / count, 1e6) for total in (sum_x, sum_y))

    def draw(self, scan):
        """Draw a scan into the map of each particle."""
        most = scan.ranges.max()
        self.grow(most)
        low, cells = self.window(most)
        drawn = self.maps[0][cells].shape
        along = self.poses[:, 2, None] + scan.bearings
        ahead = np.stack([np.cos(along), np.sin(along)])
        far = np.arange(0, most, self.cell / 2)
        points = self.poses.T[:2, :, None, None] + ahead[..., None] * far
        hit = self.poses.T[:2, :, None] + ahead * scan.ranges

        def cell_of(points):
            column, row = np.floor(points / self.cell).astype(int) - low.reshape(2, *[1] * (points.ndim - 1))
            numbers = np.arange(PARTICLES).reshape(-1, *[1] * (row.ndim - 1))
            return (numbers * drawn[1] + row) * drawn[2] + column

        def count(at, weights=None):
            return np.bincount(at, weights, np.prod(drawn)).reshape(drawn)

        passed, ends = cell_of(points), cell_of(hit)
        # Each beam counts once in a cell, and in its last cell as a hit alone.
        is_passed = (far < scan.ranges[:, None]) & (passed != ends[..., None])
        is_passed[..., 1:] &= passed[..., 1:] != passed[..., :-1]
        ends, hit = ends[:, scan.met].ravel(), hit[:, :, scan.met].reshape(2, -1)
        hits, through, sum_x, sum_y = (part[cells] for part in self.maps)
        through += count(passed[is_passed]) + count(ends)
        hits += count(ends)
        sum_x += count(ends, hit[0])
        sum_y += count(ends, hit[1])

    def grow(self, reach):
        """Add margins where a scan would reach over the maps' sides."""
        size = np.array(self.maps.shape[:1:-1])
        low, (_, rows, columns) = self.window(reach)
        before = np.maximum(0, self.corner - low)
        after = np.maximum(0, np.array([columns.stop, rows.stop]) - size)
        if before.any() or after.any():
            before, after = [np.where(more > 0, more + MARGIN, 0) for more in (before, after)]
            sides = [(0, 0), (0, 0), (before[1], after[1]), (before[0], after[0])]
            self.maps = np.pad(self.maps, sides)
            self.corner = self.corner - before

    def grid(self):
        """Return the best particle's floor and walls, and the cell in its corner."""
        hits, through = self.maps[:2, self.best]
        walls = (hits > 0) & (hits >= WALL * through)
        return (through > 0) & ~walls, walls, self.corner
