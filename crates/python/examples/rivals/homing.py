"""Maps without odometry: AALpy's hW-inference beside the bump map, in the same mazes.

    pip install tolman aalpy
    python3 homing.py --mazes 10 --side 4 --seed 1

Source: Groz, Bremond, Simao, Oriat, "hW-inference: A heuristic approach to retrieve models through
black box testing", Journal of Systems and Software 159 (2020), as AALpy (`run_hW`) has it. Both
drive themselves, observe bumps alone, and may not be carried back to the start.
"""

import argparse
import random
import signal
import statistics
import time

from aalpy.base import SUL
from aalpy.learning_algs.resetless.hW import run_hW
from aalpy.learning_algs.resetless.resetless_oracles import RandomWphWOracle
from tolman import BumpMap, Maze

STEPS = {"north": (0, 1), "east": (1, 0), "south": (0, -1), "west": (-1, 0)}


class OutOfTime(Exception):
    """A learner has used its seconds."""


class Robot(SUL):
    """A robot in a maze that only notices whether it moved."""

    def __init__(self, maze):
        super().__init__()
        self.maze, self.cell, self.moves = maze, (0, 0), 0

    def pre(self):
        """Stay: nobody carries the robot back."""

    def post(self):
        """Stay."""

    def step(self, letter):
        """Make a move. Return whether the way was open."""
        self.moves += 1
        before = self.cell
        self.cell = beyond(self.maze, before, letter)
        return self.cell != before


def beyond(maze, cell, action):
    """Return the cell behind a way, or the same where it is closed."""
    return tuple(at + by for at, by in zip(cell, STEPS[action])) if maze.is_open(cell, action) else cell


def is_exact(maze, cell, place, follow):
    """Return whether each walk bumps on the map as in the maze.

    `follow` returns for a place and an action whether the way is open, and the place beyond.
    """
    seen, waiting = {(place, cell)}, [(place, cell)]
    while waiting:
        place, cell = waiting.pop()
        for action in STEPS:
            is_open, after = follow(place, action)
            to = beyond(maze, cell, action)
            if is_open != (to != cell):
                return False
            if (after, to) not in seen:
                seen.add((after, to))
                waiting.append((after, to))
    return True


def bump_map(maze):
    """Learn by the advice of a bump map. Return whether it is exact, and the moves."""
    robot, bumps = Robot(maze), BumpMap()
    while not bumps.is_tested:
        action = bumps.advice()
        bumps.learn(action, robot.step(action))

    def follow(place, action):
        to = bumps.beyond(place, action)
        return bumps.way(place, action) == "open", place if to is None else to

    return is_exact(maze, robot.cell, bumps.here, follow), robot.moves


def homing(maze):
    """Learn by hW-inference. It is exact if any of its states fits where the robot is."""
    robot = Robot(maze)
    oracle = RandomWphWOracle(random_walk_length=20, num_test_origin_states=20)
    learned = run_hW(list(STEPS), robot, oracle, "mealy", query_for_initial_state=False, print_level=0)

    def follow(state, action):
        return state.output_fun[action], state.transitions[action]

    return any(is_exact(maze, robot.cell, state, follow) for state in learned.states), robot.moves


def timed(learn, maze, seconds):
    """Return what a learner found, and its CPU seconds; `None` where they were not enough."""

    def stop(*_):
        raise OutOfTime

    signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    begun = time.process_time()
    try:
        return (*learn(maze), time.process_time() - begun)
    except OutOfTime:
        return None
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)


def main():
    options = argparse.ArgumentParser(description="Compare hW-inference with the bump map.")
    options.add_argument("--family", choices=["perfect", "braided"], default="braided")
    options.add_argument("--side", type=int, default=4)
    options.add_argument("--mazes", type=int, default=10)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--seconds", type=float, default=20)
    given = options.parse_args()
    print("| learner | exact | ended in time | moves, median | CPU seconds, mean |")
    print("| --- | ---: | ---: | ---: | ---: |")
    for learn in (bump_map, homing):
        random.seed(given.seed)
        seeds = range(given.seed, given.seed + given.mazes)
        mazes = [Maze.generate(given.family, given.side, given.side, seed=seed) for seed in seeds]
        ended = [run for run in (timed(learn, maze, given.seconds) for maze in mazes) if run]
        exact = sum(run[0] for run in ended)
        moves, seconds = ([run[at] for run in ended] for at in (1, 2))
        middle = f"{statistics.median(moves):.0f} | {statistics.mean(seconds):.2g}" if ended else "– | –"
        print(f"| {learn.__name__} | {exact} of {len(mazes)} | {len(ended)} | {middle} |")


if __name__ == "__main__":
    main()
