"""A brain for the arena: it explores to frontiers, and finds itself where entropy falls most.

    tolman arena --brain 'python3 active_locate.py' --family office

Sources: position_grid.py, frontiers.py and grid_mapper.py name them. It needs a laser, a compass,
odometry and numpy.
"""

import math

import numpy as np
import wire
from clearance import clearance
from frontiers import drivable, frontier
from grid_mapper import GridMapper
from position_grid import PositionGrid
from ways import way
from wheels import Wheels

# Weight of one place at which it knows where it is, and steps after which it gives up.
SURE, MOST_STEPS = 0.95, 300
# How far it drives before it plans again, in corridors.
STRIDE = 0.35
# How near it has to have been to notice a landmark, in corridors.
NEAR = 0.35


class ActiveBrain:
    def __init__(self, hello):
        self.hello, self.mapper, self.wheels = hello, GridMapper(hello), Wheels()
        self.stride = round(STRIDE * hello.corridor_width / self.mapper.cell)
        self.random = np.random.default_rng(0)
        self.grid, self.steps = None, 0
        # Cells where it stood, as rows and columns.
        self.stood = set()
        # The way to where it looks next, in cells from where it was chosen, and how far it is gone.
        self.path, self.gone = None, np.zeros(2)

    def act(self, told):
        """Return the belief and the command."""
        sensing = told["sensing"]
        self.wheels.learn(wire.motion(sensing), sensing["bump"])
        self.steps = 0 if told["put_down"] else self.steps + 1
        if sensing["compass"] is None:
            # A reading may be missing, but not the first.
            is_blind = self.mapper.maps is None
            return [], {"give_up": "it needs a compass"} if is_blind else self.wheels.command(0, 0)
        if told["task"] == "explore":
            return self.mapper.explore(told), self.explore(sensing)
        self.find(told)
        if told["put_down"]:  # This reading is still from before the lift.
            return [], self.wheels.command(0.0, 0.0)
        if told["task"] == "localize":
            return self.places(), self.localize(sensing)
        return self.places(), self.home(told)

    def map(self):
        """Return the map."""
        return self.mapper.map()

    def explore(self, sensing):
        """Drive to the nearest frontier, then to where it has not stood: landmarks show there."""
        floor, walls, corner = self.mapper.maps.grid()
        cost = drivable(floor, walls, self.hello.radius / self.mapper.cell)
        x, y, heading = self.mapper.maps.poses[self.mapper.maps.best]
        self.stood.add((math.floor(y / self.mapper.cell), math.floor(x / self.mapper.cell)))
        if sensing["bump"]:
            return self.wheels.command(0.5, -0.1 * self.hello.corridor_width)
        here, path = self.nearest(cost, x, y, corner), None
        for targets in (frontier(floor, walls, cost), self.elsewhere(cost, corner)):
            if path is None and targets.any():
                path = way(here, lambda at: targets[at], cost)
        if path is None:
            return {"done": True}
        if len(path) < 3:  # It is there: the scan after a move shows more.
            return self.wheels.command(0.5, 0.3 * self.mapper.cell)
        return self.along(path, x, y, heading, corner)

    def elsewhere(self, cost, corner):
        """Return the drivable cells that are far from all where it stood."""
        stood = np.zeros(cost.shape, bool)
        stood[tuple(np.transpose(list(self.stood)) - corner[::-1, None])] = True
        near = round(NEAR * self.hello.corridor_width / self.mapper.cell)
        return (cost < np.inf) & (clearance(stood, most=near + 1) > near)

    def nearest(self, cost, x, y, corner):
        """Return the drivable cell that is nearest to a point."""
        cells = np.argwhere(cost < np.inf)
        here = np.array([y, x]) / self.mapper.cell - corner[::-1] - 0.5
        row, column = cells[((cells - here) ** 2).sum(axis=1).argmin()]
        return int(row), int(column)

    def along(self, path, x, y, heading, corner):
        """Drive to a point of a path."""
        row, column = path[min(len(path) - 1, self.stride)]
        to = (np.array([column, row]) + corner + 0.5) * self.mapper.cell
        return self.wheels.toward(to[0] - x, to[1] - y, heading)

    def find(self, told):
        """Update the belief over positions."""
        sensing = told["sensing"]
        if told["put_down"] or self.grid is None:
            self.path = None
            map = self.mapper.map()
            _, walls, corner = self.mapper.maps.grid()
            cell, graph = self.mapper.cell, self.mapper.graph
            self.ids = [place["id"] for place in map["places"]]
            self.spots = self.mapper.spots
            self.grid = PositionGrid(graph.fits, walls, corner, cell, self.hello.corridor_width)
            return
        if sensing["odometry"]:
            self.grid.move(wire.motion(sensing), sensing["compass"])
        scan = wire.scan(sensing)
        if scan:
            self.grid.look(scan, sensing["compass"])

    def places(self):
        """Return how much weight the belief gives to each place."""
        weights = self.grid.at(self.spots)
        order = (-weights).argsort()[:8]
        return [{"place": self.ids[at], "weight": min(1.0, float(weights[at]))} for at in order]

    def localize(self, sensing):
        """Be done where the belief is sure, or drive where its entropy is expected to fall."""
        weights = self.grid.at(self.spots)
        if self.grid.likeliest()[1] > SURE and weights.max() > SURE:
            return {"done": True}
        if self.steps > MOST_STEPS:
            return {"give_up": "places look alike"}
        return self.look_around(sensing)

    def look_around(self, sensing):
        """Drive where entropy is expected to fall, and choose again when it is there."""
        scan, rolled, heading = wire.scan(sensing), wire.motion(sensing), sensing["compass"]
        if rolled and self.path:
            ahead = np.array([math.sin(heading), math.cos(heading)])
            self.gone += rolled.distance * ahead / self.mapper.cell
        if sensing["bump"]:
            self.path = None
            return self.wheels.command(0.5, -0.1 * self.hello.corridor_width)
        if self.path:
            off = np.hypot(*(np.array(self.path) - self.gone).T)
            if off[-1] < 1:
                self.path = None
        if not self.path and scan:
            self.path, self.gone = self.grid.action(scan, heading, self.random), np.zeros(2)
            off = np.arange(len(self.path or ()))
        if not self.path:
            return self.wheels.command(1.0, 0.0)
        ahead = min(len(self.path) - 1, off.argmin() + self.stride)
        dy, dx = (self.path[ahead] - self.gone) * self.mapper.cell
        return self.wheels.toward(dx, dy, heading)

    def home(self, told):
        """Find the robot, and drive to the goal on the grid."""
        sensing = told["sensing"]
        if told["landmark"] == "Goal":
            return {"done": True}
        (row, column), weight = self.grid.likeliest()
        goals = [position for name, position in self.mapper.marks.all() if name == "Goal"]
        if weight < SURE or not goals:
            return self.look_around(sensing)
        if sensing["bump"]:
            return self.wheels.command(0.5, -0.1 * self.hello.corridor_width)
        floor, walls, corner = self.mapper.maps.grid()
        cost = drivable(floor, walls, self.hello.radius / self.mapper.cell)
        x, y = (np.array([column, row]) + corner + 0.5 + self.grid.offset) * self.mapper.cell
        ends = {self.nearest(cost, *goal, corner) for goal in goals}
        path = way(self.nearest(cost, x, y, corner), lambda at: at in ends, cost)
        if path is None:
            return {"give_up": "no way to the goal on the map"}
        return self.along(path, x, y, sensing["compass"], corner)


if __name__ == "__main__":
    wire.drive(ActiveBrain(wire.hello()))
