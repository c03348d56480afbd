"""A mapper for the arena: particles with grid maps, and places on the skeleton of the floor.

    tolman arena --mapper 'python3 grid_mapper.py' --family office

Sources: particle_maps.py, floor_places.py and monte_carlo.py name them. It needs a laser and
odometry, and numpy. A compass helps. The world need have no cells.
"""

import numpy as np
import wire
from floor_places import FloorPlaces
from landmarks import Landmarks
from monte_carlo import MonteCarlo
from particle_maps import ParticleMaps

# Cells of the map in the width of a corridor, and how often it looks on such a way.
FINE, LOOKS = 10, 4


class GridMapper:
    def __init__(self, hello):
        self.hello, self.cell = hello, hello.corridor_width / FINE
        self.maps, self.graph, self.samples = None, None, None
        self.marks = Landmarks(hello.corridor_width)
        self.trail, self.spots = [], []

    def explore(self, told):
        """Learn from a step, and return where the robot is."""
        sensing = told["sensing"]
        compass = sensing["compass"]
        if self.maps is None:
            heading = 0.0 if compass is None else compass
            self.maps = ParticleMaps(self.cell, self.hello.corridor_width / LOOKS, heading)
        else:
            self.maps.move(wire.motion(sensing), compass)
        scan = wire.scan(sensing)
        if scan:
            self.maps.look(scan, compass)
        pose = self.maps.poses[self.maps.best]
        self.marks.note(told["landmark"], pose)
        self.trail.append((float(pose[0]), float(pose[1])))
        return [{"point": [float(pose[0]), float(pose[1])]}]

    def map(self):
        """Return places and links of the likeliest map."""
        floor, walls, corner = self.maps.grid()
        radius, stride = self.hello.radius, self.hello.corridor_width
        self.graph = FloorPlaces(floor, walls, corner, self.cell, radius, stride, self.marks.all())
        map = self.graph.map()
        self.spots = stood_at([place["position"] for place in map["places"]], self.trail)
        return map

    def localize(self, told):
        """Return how much weight the samples give to each place."""
        sensing, map = told["sensing"], self.map() if self.graph is None else self.graph.map()
        if not map["places"]:
            return []
        if told["put_down"]:  # This reading is still from before the lift.
            self.samples = None
            return []
        if self.samples is None:
            _, walls, corner = self.maps.grid()
            self.samples = MonteCarlo(walls, self.graph.fits, corner, self.cell, sensing["compass"])
        else:
            self.samples.move(wire.motion(sensing))
        scan = wire.scan(sensing)
        if scan:
            self.samples.look(scan)
        weights = self.samples.at(self.spots)
        order = (-weights).argsort()[:8]
        return [{"place": map["places"][at]["id"], "weight": min(1.0, float(weights[at]))} for at in order]


def stood_at(positions, trail):
    """Return where the robot stood on average when it was nearest to each place.

    A place stands for that; where the robot never was, for its position.
    """
    if not positions:
        return []
    spots, trail = np.array(positions), np.array(trail)
    nearest = ((trail[:, None] - spots) ** 2).sum(axis=2).argmin(axis=1)
    return [trail[nearest == at].mean(axis=0) if at in nearest else spots[at] for at in range(len(spots))]


if __name__ == "__main__":
    wire.watch(GridMapper(wire.hello()))
