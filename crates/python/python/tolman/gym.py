"""Mazes as environments of gymnasium: `gymnasium.make("tolman/Maze-v0", maze=maze)`."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

try:
    import gymnasium
    from gymnasium import spaces
except ImportError as error:
    raise ImportError("tolman.gym needs gymnasium: pip install gymnasium") from error

from ._tolman import Maze, Robot

_Observation = dict[str, Any]


class MazeEnv(gymnasium.Env[_Observation, Any]):
    """The laser Pioneer has to find the goal of a maze.

    An action is (turn, translate), each a share from −1 to 1 of what a step can do. An
    observation has `ranges`, the laser's beams as shares of their reach, counter-clockwise from
    ahead, and `compass`, the cosine and sine of the heading. Each step costs 1, also the last.
    The episode ends at the goal, and is cut off after `max_steps`: by default as many, for the
    length of the corridors, as MSLST's paper allows.
    """

    metadata: dict[str, Any] = {"render_modes": []}

    def __init__(self, maze: Maze | None = None, *, start: str = "random", noise: bool = True, max_steps: int | None = None) -> None:
        self.maze = Maze.generate("perfect", 5, 5, seed=1) if maze is None else maze
        self.start = start
        self.noise = noise
        self._robot = Robot(self.maze, seed=0, start=start, noise=noise)
        self.max_steps = self._robot.step_limit if max_steps is None else max_steps
        if self.max_steps < 1:
            raise ValueError(f"max_steps is {max_steps} but has to be at least 1")
        self.action_space = spaces.Box(-1.0, 1.0, (2,), np.float32)
        self.observation_space = spaces.Dict(
            {
                "ranges": spaces.Box(0.0, 1.0, (self._robot.beams,), np.float32),
                "compass": spaces.Box(-1.0, 1.0, (2,), np.float32),
            }
        )

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[_Observation, dict[str, Any]]:
        """Put the robot down again. With a seed, what follows repeats."""
        super().reset(seed=seed)
        chance = int(self.np_random.integers(2**63))
        self._robot = Robot(self.maze, seed=chance, start=self.start, noise=self.noise)
        return self._observed(), self._known()

    def step(self, action: Any) -> tuple[_Observation, float, bool, bool, dict[str, Any]]:
        """Turn and drive for one step."""
        turn, translate = (float(part) for part in np.asarray(action).reshape(2))
        self._robot.step(turn, translate)
        arrived = self._robot.at_goal
        late = self._robot.steps >= self.max_steps
        return self._observed(), -1.0, arrived, late and not arrived, self._known()

    def _observed(self) -> _Observation:
        robot = self._robot
        ranges = robot.ranges
        shares = np.ones(robot.beams) if ranges is None else ranges / robot.reach
        heading = robot.compass
        compass = (0.0, 0.0) if heading is None else (math.cos(heading), math.sin(heading))
        return {
            "ranges": np.clip(shares, 0.0, 1.0).astype(np.float32),
            "compass": np.asarray(compass, np.float32),
        }

    def _known(self) -> dict[str, Any]:
        """Return what the robot does not sense."""
        return {"pose": self._robot.pose, "bump": self._robot.bump}


gymnasium.register(id="tolman/Maze-v0", entry_point="tolman.gym:MazeEnv")
