"""Scores in `tolman/Errand-v0`, `tolman/Learn-v0` and `tolman/Locate-v0`: an oracle's, and those of simple robots.

    python crates/python/examples/grid_scores.py [--episodes N] [--seed N] [--size N]
"""

from __future__ import annotations

import argparse
import random
from collections.abc import Callable
from typing import Any

import numpy as np
import tolman
from tolman.gym import GridEnv

AHEAD, RIGHT, LEFT = range(3)
TURNS: list[list[int]] = [[], [RIGHT], [RIGHT, RIGHT], [LEFT]]
STEPS = [(0, 1), (1, 0), (0, -1), (-1, 0)]
NAMES = ["north", "east", "south", "west"]

Cell = tuple[int, int]
# A cell, and quarter turns to the right from north: by the robot's own count, from where it began.
Stand = tuple[Cell, int]
Policy = Callable[[Any], int]
# What a robot may be told: its environment, where it begins, and a seed.
Maker = Callable[[GridEnv, tuple[int, int, int], int], Policy]


def beyond(cell: Cell, heading: int) -> Cell:
    return cell[0] + STEPS[heading][0], cell[1] + STEPS[heading][1]


def after(stand: Stand, action: int) -> Stand:
    cell, heading = stand
    return (beyond(cell, heading), heading) if action == AHEAD else (cell, (heading + (1 if action == RIGHT else 3)) % 4)


class Chance:
    """Moves at random; in Locate it tells a pose at random after some moves."""

    def __init__(self, env: GridEnv, pose: tuple[int, int, int], seed: int) -> None:
        self.random, self.actions = random.Random(seed), env.action_count

    def __call__(self, seen: Any) -> int:
        return self.random.randrange(3 if self.random.random() < 0.95 else self.actions)


class Planner:
    """Goes to the wanted landmark by ways that it knows, or to the nearest cell where it has not been."""

    def __init__(self, env: GridEnv, pose: tuple[int, int, int], seed: int) -> None:
        self.stand: Stand = ((0, 0), 0)
        self.open: dict[Cell, list[bool]] = {}
        self.landmarks: dict[int, Cell] = {}

    def __call__(self, seen: Any) -> int:
        cell, heading = self.stand
        self.open[cell] = [bool(seen["sides"][(turn - heading) % 4]) for turn in range(4)]
        if seen.get("here"):
            self.landmarks[int(seen["here"])] = cell
        wanted = self.landmarks.get(int(seen.get("wanted", 0)))
        path = tolman.shortest_path(self.ways(wanted), self.stand, "there")
        next_stand = path.nodes[1] if path and len(path.nodes) > 2 else after(self.stand, RIGHT)
        action = next(action for action in range(3) if after(self.stand, action) == next_stand)
        self.stand = next_stand
        return action

    def ways(self, wanted: Cell | None) -> dict[Any, dict[Any, int]]:
        """Return the stands that it knows, with an arc of no cost to "there" from where it wants to be."""
        ways: dict[Any, dict[Any, int]] = {"there": {}}
        for cell, sides in self.open.items():
            for heading in range(4):
                moves = [RIGHT, LEFT, AHEAD] if sides[heading] else [RIGHT, LEFT]
                ways[cell, heading] = {after((cell, heading), move): 1 for move in moves}
                if wanted == cell:
                    ways[cell, heading]["there"] = 0
                ahead = after((cell, heading), AHEAD)
                if sides[heading] and ahead[0] not in self.open:
                    ways[ahead] = {} if wanted else {"there": 0}
        return ways


class Bumps:
    """Follows the advice of a `BumpMap`, which learns from moves and bumps alone."""

    def __init__(self, env: GridEnv, pose: tuple[int, int, int], seed: int) -> None:
        self.map, self.heading, self.tried, self.could = tolman.BumpMap(), 0, False, False

    def __call__(self, seen: Any) -> int:
        if self.tried:
            self.map.learn(NAMES[self.heading], self.could)
        turn = (NAMES.index(self.map.advice()) - self.heading) % 4
        self.tried, self.could = turn == 0, bool(seen["sides"][0])
        action = {0: AHEAD, 1: RIGHT, 2: RIGHT, 3: LEFT}[turn]
        self.heading = after(((0, 0), self.heading), action)[1]
        return action


class Elimination:
    """Walks along walls until but one pose explains what it saw, and tells that one."""

    def __init__(self, env: GridEnv, pose: tuple[int, int, int], seed: int) -> None:
        self.width, self.height = env.maze.width, env.maze.height
        self.poses: list[Stand] = [((x, y), turn) for x in range(self.width) for y in range(self.height) for turn in range(4)]
        self.turned, self.patience = False, self.width * self.height

    def sides(self, walls: Any, stand: Stand) -> list[int]:
        (x, y), heading = stand
        row, column = 2 * (self.height - y) - 1, 2 * x + 1
        beside = [STEPS[(heading + side) % 4] for side in range(4)]
        return [int(not walls[row - north, column + east]) for east, north in beside]

    def __call__(self, seen: Any) -> int:
        self.poses = [pose for pose in self.poses if self.sides(seen["walls"], pose) == [int(side > 0) for side in seen["sides"]]]
        self.patience -= 1
        if len(self.poses) == 1 or self.patience < 1:
            (x, y), heading = self.poses[0]
            return 3 + 4 * (self.width * y + x) + heading
        # Right where it can, else ahead, else left.
        ahead, right = seen["sides"][0], seen["sides"][1]
        action = RIGHT if right and not self.turned else AHEAD if ahead else LEFT
        self.turned = action == RIGHT
        self.poses = [after(pose, action) for pose in self.poses]
        return action


class Micromouse:
    """Obeys a `Mouse`, which is told the size of the maze and where it begins. It needs rays."""

    def __init__(self, env: GridEnv, pose: tuple[int, int, int], seed: int) -> None:
        x, y, heading = pose
        self.mouse = tolman.Mouse(env.maze.width, env.maze.height, (x, y), NAMES[heading])
        self.believed = 0  # quarter turns from the robot's heading to the mouse's: a mouse can drive back
        self.actions: list[int] = []

    def __call__(self, seen: Any) -> int:
        while not self.actions:
            left, ahead, right = (int(seen["sides"][(self.believed + side) % 4]) for side in (3, 0, 1))
            order = self.mouse.next(left, ahead, right)
            if order is None:
                return RIGHT  # it believes that it has seen all
            degrees, cells = order
            self.believed = (self.believed + degrees // 90) % 4
            if cells:
                turn = (self.believed + (0 if cells > 0 else 2)) % 4
                self.actions = [*TURNS[turn], *[AHEAD] * abs(cells)]
                self.believed = (self.believed - turn) % 4
        return self.actions.pop(0)


POLICIES: dict[str, dict[str, Maker]] = {
    "errand": {"planner": Planner, "chance": Chance},
    "learn": {"planner": Planner, "bump map": Bumps, "chance": Chance},
    "learn, rays": {"micromouse": Micromouse, "planner": Planner, "chance": Chance},
    "locate": {"elimination": Elimination, "chance": Chance},
}
FAMILIES = "perfect, braided, braided rooms, office, blocks, ladder, eight, ring, wings, comb, spiral, star, pillars".split(", ")


# Score, the oracle's, whether the task was done, and steps over the oracle's.
Played = tuple[float, float, bool, float]


def played(env: GridEnv, policy: Maker, seed: int) -> Played:
    """Play an episode."""
    seen, known = env.reset(seed=seed)
    oracle, least = env.oracle_rewards, env.oracle_steps
    robot = policy(env, known["pose"], seed)
    score, steps, reward, ended, cut = 0.0, 0, 0.0, False, False
    while not ended and not cut:
        seen, reward, ended, cut, _ = env.step(robot(seen))
        score, steps = score + reward, steps + 1
    return score, oracle, ended and reward > 0, steps / least


def main() -> None:
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("--episodes", type=int, default=10, help="episodes in each family of mazes")
    asked.add_argument("--seed", type=int, default=1)
    asked.add_argument("--size", type=int, default=8, help="cells on a side")
    given = asked.parse_args()
    seeds = range(given.seed, given.seed + given.episodes)
    print(f"{'task':11} {'robot':11} {'oracle':>7} {'score':>7} {'behind':>14} {'done, %':>8} {'steps / oracle':>15}  farthest behind")
    for task, policies in POLICIES.items():
        size = {"width": given.size, "height": given.size}
        envs = {family: GridEnv(task.split(",")[0], family, **size, rays="rays" in task) for family in FAMILIES}
        for name, policy in policies.items():
            scores = {family: np.array([played(env, policy, seed) for seed in seeds], float) for family, env in envs.items()}
            every = np.concatenate(list(scores.values()))
            score, oracle, done, _ = every.mean(axis=0)
            behind = every[:, 1] - every[:, 0]
            error = 1.96 * behind.std(ddof=1) / len(behind) ** 0.5
            is_done = every[:, 2] > 0
            steps = f"{every[is_done, 3].mean():.2f}" if is_done.any() else "–"
            means = {family: one.mean(axis=0) for family, one in scores.items()}
            worst = min(means, key=lambda family: float(means[family][0] - means[family][1]))
            lowest = f"{worst}: {means[worst][0]:.2f} of {means[worst][1]:.2f}"
            scored = f"{oracle:7.2f} {score:7.2f} {behind.mean():6.2f} ± {error:5.2f}"
            print(f"{task:11} {name:11} {scored} {100 * done:8.0f} {steps:>15}  {lowest}")


if __name__ == "__main__":
    main()
