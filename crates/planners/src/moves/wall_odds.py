"""Fits the network of wall_odds.rs to mazes, and writes its weights to wall_odds.bin.

    pip install numpy
    python wall_odds.py FOLDER [--every-second]

FOLDER holds mazes of 16 x 16 cells as text. With --every-second the network is fitted to every
second one, and tried on others. It takes two minutes of a processor and 2 GB.
"""

import random
import sys
from pathlib import Path

import numpy as np

SIDE = 16
REACH = 2
UNITS = 64
ONE = 24.0
UNKNOWN, OPEN, WALL = 0, 1, 2
STATES, SIDES_OF_A_STATE, ROUNDS, BATCH, RATE = 250, 40, 16, 512, 3e-3
PADDING = REACH + 1
DIRECTIONS = ((1, 0), (-1, 0), (0, 1), (0, -1))


class Maze:
    """Walls south and west of every cell; one row and one column more than there are cells."""

    def __init__(self, south, west, goals):
        self.south, self.west, self.goals = south, west, goals

    @classmethod
    def read(cls, text):
        """Returns a maze drawn with posts, `---` and `|`; `None` if it has another size."""
        rows = []
        for line in text.splitlines():
            if line[:1] in ("o", "+", "|"):
                rows.append(line.ljust(4 * SIDE + 1))
            elif rows:
                break
        if len(rows) != 2 * SIDE + 1:
            return None
        south = np.zeros((SIDE + 1, SIDE), bool)
        west = np.zeros((SIDE, SIDE + 1), bool)
        goals = set()
        for y in range(SIDE + 1):
            posts = rows[2 * (SIDE - y)]
            south[y] = [posts[4 * x + 1 : 4 * x + 4] == "---" for x in range(SIDE)]
        for y in range(SIDE):
            cells = rows[2 * (SIDE - y) - 1]
            west[y] = [cells[4 * x] == "|" for x in range(SIDE + 1)]
            goals |= {(x, y) for x in range(SIDE) if cells[4 * x + 2] == "G"}
        return cls(south, west, goals)


def side_of(x, y, east, north):
    """Returns a side of a cell as (is it west of a cell, row, column)."""
    return (True, y, x + (east > 0)) if east else (False, y + (north > 0), x)


class Known:
    """What a mouse knows of a maze. All outside counts as walls, as far as a side looks."""

    def __init__(self, maze):
        self.maze = maze
        self.south = np.full((SIDE + 1 + 2 * PADDING, SIDE + 2 * PADDING), WALL, np.int8)
        self.west = self.south.T.copy()
        inner = slice(PADDING, PADDING + SIDE)
        between = slice(PADDING + 1, PADDING + SIDE)
        self.south[between, inner] = UNKNOWN
        self.west[inner, between] = UNKNOWN

    def known(self, side):
        """Returns what is known of a side."""
        is_west, row, column = side
        return (self.west if is_west else self.south)[row + PADDING, column + PADDING]

    def look(self, side):
        """Looks at a side, and returns whether a wall stands there."""
        is_west, row, column = side
        walls, known = (self.maze.west, self.west) if is_west else (self.maze.south, self.south)
        known[row + PADDING, column + PADDING] = WALL if walls[row, column] else OPEN
        return walls[row, column]

    def explore(self, rng, cells):
        """Looks around in some cells, each next to an earlier one, the first at the start."""
        front, found = [(0, 0)], {(0, 0)}
        depth_first = rng.random()
        for _ in range(cells):
            if not front:
                break
            last = len(front) - 1
            recent = max(0, last - 2) if rng.random() < depth_first else 0
            x, y = front.pop(rng.randint(recent, last))
            for east, north in DIRECTIONS:
                at = (x, y)
                while not self.look(side_of(*at, east, north)):
                    at = (at[0] + east, at[1] + north)
                    if at == (x + east, y + north) and at not in found:
                        found.add(at)
                        front.append(at)

    def unknown(self):
        west = [(True, *at) for at in (np.argwhere(self.west == UNKNOWN) - PADDING).tolist()]
        south = [(False, *at) for at in (np.argwhere(self.south == UNKNOWN) - PADDING).tolist()]
        return west + south

    def has_entrance(self):
        """Returns whether a side into the goal is known to be open."""
        for x, y in self.maze.goals:
            for east, north in DIRECTIONS:
                is_within = (x + east, y + north) in self.maze.goals
                if not is_within and self.known(side_of(x, y, east, north)) == OPEN:
                    return True
        return False

    def around(self, side):
        """Returns what is known around a side: parallel sides, then those across; and the goal."""
        is_west, row, column = side
        if is_west:
            parallel, across = self.west, self.south
            y, x = row, column
            cells = ((x - 1, y), (x, y))
        else:
            parallel, across = self.south.T, self.west.T
            y, x = column, row
            cells = ((y, x - 1), (y, x))
        y, x = y + PADDING, x + PADDING
        goals = sum(cell in self.maze.goals for cell in cells)
        entrance = goals == 1 and self.has_entrance()
        return (
            parallel[y - REACH : y + REACH + 1, x - REACH : x + REACH + 1].copy(),
            across[y - REACH : y + REACH + 2, x - REACH : x + REACH].copy(),
            (goals == 2, goals == 1 and not entrance, entrance),
        )


def examples(mazes, rng):
    """Returns sides of mazes known in part, and whether they are open."""
    parallel, across, goal, is_open = [], [], [], []
    for maze in mazes:
        for _ in range(STATES):
            known = Known(maze)
            known.explore(rng, rng.randint(1, 220))
            unknown = known.unknown()
            rng.shuffle(unknown)
            chosen = set(rng.sample(range(len(unknown)), min(SIDES_OF_A_STATE, len(unknown))))
            for number, side in enumerate(unknown):
                around = known.around(side) if number in chosen else None
                is_wall = known.look(side)
                if around:
                    parallel.append(around[0])
                    across.append(around[1])
                    goal.append(around[2])
                    is_open.append(not is_wall)
    return (
        np.array(parallel, np.int8),
        np.array(across, np.int8),
        np.array(goal, np.float32),
        np.array(is_open, np.float32),
    )


def inputs(parallel, across, goal):
    around = np.concatenate([parallel.reshape(len(goal), -1), across.reshape(len(goal), -1)], 1)
    return np.concatenate([around == OPEN, around == WALL, goal], 1).astype(np.float32)


def log_odds(weights, rows):
    hidden, bias, out, out_bias = weights
    return np.maximum(rows @ hidden + bias, 0) @ out + out_bias


def loss(weights, data):
    odds = log_odds(weights, inputs(*data[:3]))
    return np.logaddexp(0, np.where(data[3] > 0, -odds, odds)).mean()


def fit(data, seed=0):
    """Fits the weights by Adam. Each batch is mirrored by chance, in two ways."""
    rng = np.random.default_rng(seed)
    parallel, across, goal, is_open = data
    width = inputs(*(part[:1] for part in data[:3])).shape[1]
    weights = [
        rng.normal(0, 12**-0.5, (width, UNITS)),
        np.zeros(UNITS),
        rng.normal(0, 0.3, UNITS),
        np.zeros(1),
    ]
    weights = [part.astype(np.float32) for part in weights]
    means = [np.zeros_like(part) for part in weights]
    squares = [np.zeros_like(part) for part in weights]
    batches = len(goal) // BATCH
    for step in range(1, ROUNDS * batches + 1):
        number = (step - 1) % batches
        if number == 0:
            order = rng.permutation(len(goal))
        batch = order[number * BATCH : (number + 1) * BATCH]
        mirror = (slice(None), *(slice(None, None, way) for way in rng.choice([1, -1], 2)))
        rows = inputs(parallel[batch][mirror], across[batch][mirror], goal[batch])
        hidden, bias, out, out_bias = weights
        sums = rows @ hidden + bias
        units = np.maximum(sums, 0)
        error = (1 / (1 + np.exp(-(units @ out + out_bias))) - is_open[batch]) / BATCH
        back = np.outer(error, out) * (sums > 0)
        slopes = [rows.T @ back + 1e-5 * hidden, back.sum(0), units.T @ error, error.sum(keepdims=True)]
        rate = RATE * (1 - step / (ROUNDS * batches + 1))
        for at, slope in enumerate(slopes):
            means[at] = 0.9 * means[at] + 0.1 * slope
            squares[at] = 0.999 * squares[at] + 0.001 * slope**2
            change = means[at] / (1 - 0.9**step) / (np.sqrt(squares[at] / (1 - 0.999**step)) + 1e-8)
            weights[at] = weights[at] - np.float32(rate) * change.astype(np.float32)
    return weights


def save(weights, path):
    """Writes the weights as bytes, without those of the side itself, which is unknown."""
    around = (2 * REACH + 1) ** 2 + 2 * REACH * (2 * REACH + 2)
    itself = (2 * REACH + 1) ** 2 // 2
    hidden = np.delete(weights[0], [itself, around + itself], 0)
    rows = np.concatenate([hidden.ravel(), *(part.ravel() for part in weights[1:])])
    path.write_bytes(np.clip(np.rint(rows * ONE), -127, 127).astype(np.int8).tobytes())


def main():
    folder, every_second = Path(sys.argv[1]), "--every-second" in sys.argv
    mazes = [Maze.read(path.read_text(errors="replace")) for path in sorted(folder.glob("*.txt"))]
    mazes = [maze for maze in mazes if maze]
    data = examples(mazes[::2] if every_second else mazes, random.Random(1))
    weights = fit(data)
    print(f"{len(data[3])} sides of mazes it was fitted to: log loss {loss(weights, data):.4f}")
    if every_second:
        others = examples(mazes[1::10], random.Random(2))
        print(f"{len(others[3])} sides of others: log loss {loss(weights, others):.4f}")
    save(weights, Path(__file__).with_suffix(".bin"))


if __name__ == "__main__":
    main()
