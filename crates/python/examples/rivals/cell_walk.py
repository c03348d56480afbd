"""What a robot does and sees from cell to cell: moves by the compass, and which sides are open."""

import math

import numpy as np
import wire

# The robot is in the next cell when it is this share of a cell past the middle between both.
PAST = 0.1
SIDES = ((1, 0), (0, 1), (-1, 0), (0, -1))  # east, north, west, south


class CellWalk:
    """Actions, looks, and for the judge alone the cells by dead reckoning.

    Looks and cells are one more than actions.
    """

    def __init__(self, width):
        self.width, self.x, self.y = width, 0.0, 0.0
        self.actions, self.looks, self.cells = [], [None], [(0, 0)]
        self.nearest = math.inf

    @property
    def point(self):
        """Return where dead reckoning has the robot, m."""
        (column, row), width = self.cells[-1], self.width
        return [(column + self.x) * width, (row + self.y) * width]

    def step(self, sensing, landmark):
        """Note what a time step adds."""
        rolled, scan, along = wire.motion(sensing), wire.scan(sensing), sensing["compass"]
        if rolled and along is not None:
            self.x += rolled.distance * math.cos(along) / self.width
            self.y += rolled.distance * math.sin(along) / self.width
        for action, (dx, dy) in enumerate(SIDES):
            if self.x * dx + self.y * dy > 0.5 + PAST:
                self.x, self.y, self.nearest = self.x - dx, self.y - dy, math.inf
                self.actions.append(action)
                self.looks.append(None)
                self.cells.append((self.cells[-1][0] + dx, self.cells[-1][1] + dy))
        if scan and along is not None:
            self.correct(scan, along)
        off = max(abs(self.x), abs(self.y))
        seen = self.looks[-1]
        if scan and along is not None and (seen is None or off < self.nearest - 0.02):
            self.nearest, seen = off, (self.open_sides(scan, along), seen[1] if seen else None)
        if landmark and seen and off < 0.5 - PAST:  # not one of the cell beside
            seen = (seen[0], str(landmark))
        self.looks[-1] = seen

    def correct(self, scan, along):
        """Move the robot in its cell by how far the walls that it sees are off the cells' sides."""
        reach = scan.ranges[scan.met] / self.width
        bearings = along + scan.bearings[scan.met]
        hits = np.array([self.x + reach * np.cos(bearings), self.y + reach * np.sin(bearings)])
        off = hits % 1 - 0.5
        # A hit in the middle of a side: corners and ends of walls belong to two.
        is_wall = (np.abs(off[::-1]) > 0.25) & (np.abs(off) < 0.25)
        shifts = [np.median(far[are]) if are.any() else 0.0 for far, are in zip(off, is_wall)]
        self.x, self.y = self.x - float(shifts[0]), self.y - float(shifts[1])

    def open_sides(self, scan, along):
        """Return which sides of the cell the beams pass, from where the robot is in it."""
        return tuple(self.is_open(scan, along, side) for side in SIDES)

    def is_open(self, scan, along, side):
        passing, stopped = 0, 0
        for bearing, reach in zip(scan.bearings, scan.ranges):
            dx, dy = math.cos(along + bearing), math.sin(along + bearing)
            ahead = dx * side[0] + dy * side[1]
            if ahead > 0.3:
                # To the line of the side, in cells.
                off = (0.5 - self.x * side[0] - self.y * side[1]) / ahead
                across = (self.x + off * dx) * side[1] + (self.y + off * dy) * side[0]
                if abs(across) < 0.25:
                    beyond = reach / self.width > off + 0.1
                    passing, stopped = passing + beyond, stopped + (not beyond)
        return bool(passing > stopped)
