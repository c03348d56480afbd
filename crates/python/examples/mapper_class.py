"""A mapper for the arena, as a class of four methods: its map are the cells that the robot drove through.

    tolman arena --mapper 'python3 crates/python/examples/mapper_class.py'
"""

from __future__ import annotations

import math
from collections import Counter
from typing import Any

import tolman

Cell = tuple[int, int]


class DrivenCells(tolman.Mapper):
    def begin(self, hello: tolman.Hello) -> None:
        self.wide = hello["corridor_width"]  # m, which a cell is wide
        self.x, self.y = 0.0, 0.0  # the robot, in cells
        self.cell: Cell = (0, 0)
        self.ways: dict[Cell, set[Cell]] = {(0, 0): set()}
        self.signs: dict[Cell, Counter[Any]] = {}  # how often a landmark was sensed in a cell, or None

    def step(self, told: tolman.Step) -> tolman.Belief:
        if told["task"] != "explore":
            return None  # it was put down somewhere, and does not look for itself
        heading, rolled = told["sensing"]["compass"], told["sensing"]["odometry"]["distance"] / self.wide
        self.x, self.y = self.x + rolled * math.cos(heading), self.y + rolled * math.sin(heading)
        cell = round(self.x), round(self.y)
        if cell != self.cell:
            self.ways.setdefault(cell, set()).add(self.cell)
            self.ways[self.cell].add(cell)
            self.cell = cell
        self.signs.setdefault(cell, Counter())[told["landmark"]] += 1
        return self.x * self.wide, self.y * self.wide

    def map(self) -> tolman.PlaceMap:
        """Places are the cells where not just two ways meet; corridors join them."""
        ids = {cell: number for number, cell in enumerate(self.ways) if len(self.ways[cell]) != 2 or self._sign(cell)}
        places: list[tolman.Place] = [
            {"id": ids[x, y], "position": (x * self.wide, y * self.wide), "landmark": self._sign((x, y))} for x, y in ids
        ]
        return {"places": places, "links": [(ids[cell], ids[self._end(cell, way, ids)]) for cell in ids for way in self.ways[cell]]}

    def _end(self, last: Cell, cell: Cell, ids: dict[Cell, int]) -> Cell:
        while cell not in ids:
            last, cell = cell, next(iter(self.ways[cell] - {last}))
        return cell

    def _sign(self, cell: Cell) -> Any:
        """Return what was sensed there most often: at its border a landmark may be the neighbour's."""
        return self.signs[cell].most_common(1)[0][0]

    def certainty(self) -> float:
        return 0.9 if "Goal" in map(self._sign, self.signs) else 0.1  # a map without the goal is not whole


if __name__ == "__main__":
    DrivenCells.run()
