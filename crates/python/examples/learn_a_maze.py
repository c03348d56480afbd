"""A robot learns a maze; its places and what its laser saw are put side by side.

    python crates/python/examples/learn_a_maze.py [MAZE]
"""

import sys

import numpy as np
import numpy.typing as npt
import tolman

maze = tolman.Maze(sys.argv[1]) if len(sys.argv) > 1 else tolman.Maze.generate("office", 6, 6, seed=2)
print(maze)
print("shortest path:", maze.shortest_path())

# A system of a paper explores the maze and draws a map.
learned = tolman.learn(maze, "mslst-better", seed=1)
print(f"{learned}, {learned.outcome}; right: {learned.is_right}")

# What the laser sees on a drive at random, as prototypes.
rng = np.random.default_rng(1)
robot = tolman.Robot(maze, seed=1)
scans: list[npt.NDArray[np.float64]] = []
for _ in range(2000):
    robot.step(*rng.uniform(-1.0, 1.0, 2))
    if robot.ranges is not None:
        scans.append(robot.ranges)
looks = tolman.GNG(max_units=30, growth_period=50).fit(np.array(scans))
error = looks.quantization_error(np.array(scans)) ** 0.5
print(f"{len(scans)} scans of {robot.beams} beams: {len(looks.units_)} prototypes, RMS distance {error:.2f} m")

# The way between the first place of the map and the goal, on the map's own graph.
ways: dict[int, list[int]] = {place: [] for place in learned.places}
for tail, head in learned.links:
    ways[tail].append(head)
goals = [place for place, known in learned.places.items() if known.get("landmark") == "goal"]
if goals:
    path = tolman.shortest_path(ways, next(iter(ways)), goals[0])
    print("way on the map:", path.nodes if path else "none")
