"""Mazes as environments of gymnasium: `gymnasium.make("tolman.gym:tolman/Maze-v0", maze=maze)` and others."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

try:
    import gymnasium
    from gymnasium import spaces
except ImportError as error:
    raise ImportError("tolman.gym needs gymnasium: pip install gymnasium") from error

from ._above import GOAL, from_above
from ._grid_envs import GridEnv, GridVectorEnv
from ._options import check_render_mode, maze_option
from ._tolman import Maze, Robot

__all__ = ["GridEnv", "GridVectorEnv", "MazeEnv", "register"]

_Observation = dict[str, Any]


class MazeEnv(gymnasium.Env[_Observation, Any]):
    """The laser Pioneer has to find the goal of a maze.

    An action is (turn, translate), each a share from −1 to 1 of what a step can do. An
    observation has `ranges`, the laser's beams as shares of their reach, counter-clockwise from
    ahead, and `compass`, the cosine and sine of the heading. Each step costs 1, also the last.
    The episode ends at the goal, and is cut off after `max_steps`: by default as many, for the
    length of the corridors, as MSLST's paper allows.

    `maze` is a maze, or the name of a family as `Maze.generate` takes it: then each episode has
    another maze, of 5 by 5 cells. `reset(options={"maze": maze})` changes it in between. An
    environment can be copied and pickled in the midst of an episode, and goes on alike.

    Parameters
    ----------
    maze : Maze or str or None
        A maze, a family, or None for one perfect maze.
    start : {"random", "marked"}
        Where the robot begins: anywhere, or at the maze's start.
    noise : bool
        Whether motors and sensors err, as the Pioneer's do.
    max_steps : int or None
        The number of time steps after which an episode is cut off, from 1.
    render_mode : {None, "rgb_array"}
        What `render` returns.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 10}

    def __init__(
        self,
        maze: Maze | str | None = None,
        *,
        start: str = "random",
        noise: bool = True,
        max_steps: int | None = None,
        render_mode: str | None = None,
    ) -> None:
        check_render_mode(render_mode)
        if max_steps is not None and max_steps < 1:
            raise ValueError(f"max_steps is {max_steps} but has to be at least 1")
        self.family = maze if isinstance(maze, str) else None
        self.maze = Maze.generate(self.family or "perfect", 5, 5, seed=1) if maze is None or isinstance(maze, str) else maze
        self.start = start
        self.noise = noise
        self._steps_asked = max_steps
        self.render_mode = render_mode
        self._begin(seed=0)
        self.action_space = spaces.Box(-1.0, 1.0, (2,), np.float32)
        self.observation_space = spaces.Dict(
            {
                "ranges": spaces.Box(0.0, 1.0, (self._robot.beams,), np.float32),
                "compass": spaces.Box(-1.0, 1.0, (2,), np.float32),
            }
        )

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[_Observation, dict[str, Any]]:
        """Put the robot down again.

        Parameters
        ----------
        seed : int or None
            With the same seed, what follows repeats.
        options : dict or None
            It may have "maze": a Maze for this episode and those after it, or the name of a family.

        Returns
        -------
        (dict, dict)
            The observation, and `pose` and `bump`, which the robot does not sense: x and y in metres, heading in rad.

        Raises
        ------
        ValueError
            If an option is not known, or there is no such family.
        """
        super().reset(seed=seed)
        asked = maze_option(options)
        if asked is not None:
            self.family = asked if isinstance(asked, str) else None
            self.maze = self.maze if isinstance(asked, str) else asked
        chance = int(self.np_random.integers(2**63))
        if self.family is not None:
            self.maze = Maze.generate(self.family, 5, 5, seed=chance)
        self._begin(chance)
        return self._observed(), self._known()

    def _begin(self, seed: int) -> None:
        self._robot = Robot(self.maze, seed=seed, start=self.start, noise=self.noise)
        self.max_steps = self._robot.step_limit if self._steps_asked is None else self._steps_asked

    def step(self, action: Any) -> tuple[_Observation, float, bool, bool, dict[str, Any]]:
        """Turn and drive for one step.

        Parameters
        ----------
        action : array of shape (2,)
            Turn, counter-clockwise, and translation ahead, as shares from −1 to 1 of what a step can do.

        Returns
        -------
        (dict, float, bool, bool, dict)
            The observation, the reward −1, whether the robot is at the goal, whether the time is up, and `pose` and `bump`.

        Raises
        ------
        ValueError
            If the action is not two numbers from −1 to 1.
        """
        turn, translate = (float(part) for part in np.asarray(action).reshape(2))
        self._robot.step(turn, translate)
        arrived = self._robot.at_goal
        late = self._robot.steps >= self.max_steps
        return self._observed(), -1.0, arrived, late and not arrived, self._known()

    def render(self) -> Any:
        """Return a picture from above, if `render_mode` is "rgb_array": an array of shape (rows, columns, 3) of uint8.

        A cell has 24 pixels. Walls are black, goals are green, the robot is red, and a white dot is its front.
        """
        if self.render_mode != "rgb_array":
            return None
        x, y, heading = self._robot.pose
        robot = (x / self._robot.pitch, y / self._robot.pitch, heading)
        return from_above(self.maze, robot, dict.fromkeys(self.maze.goals, GOAL))

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


def register() -> None:
    """Let `gymnasium.make` know the four environments: called on import."""
    if "tolman/Maze-v0" in gymnasium.registry:
        return
    enter = gymnasium.register  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
    enter(id="tolman/Maze-v0", entry_point="tolman.gym:MazeEnv")
    for name in ("Errand", "Learn", "Locate"):
        enter(
            id=f"tolman/{name}-v0",
            entry_point="tolman.gym:GridEnv",
            vector_entry_point="tolman.gym:GridVectorEnv",
            kwargs={"task": name.lower()},
        )


register()
