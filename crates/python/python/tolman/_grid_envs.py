"""Robots that move from cell to cell, as environments of gymnasium: one, and many at once."""

from __future__ import annotations

import math
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from ._above import GOAL, Colour, from_above
from ._options import check_render_mode, maze_option
from ._tolman import Grids, Maze

_Observation = dict[str, Any]

# Steps in which a robot that knows nothing does its task with time to spare, for each cell, and
# in errands for each of them.
_PATIENCE = {"errand": 4, "learn": 10, "locate": 10}

# Number of the seeds that robots take.
_SEEDS = 2**63

# Colour of a landmark to which the robot does not drive.
_LANDMARK: Colour = (225, 225, 240)


class _Grid:
    """What one environment and many have in common: robots of Rust, and the spaces."""

    def __init__(
        self,
        task: str,
        maze: Maze | str,
        width: int,
        height: int,
        rays: bool,
        landmarks: int,
        errands: int,
        max_steps: int | None,
        count: int,
    ) -> None:
        if isinstance(maze, Maze):
            width, height = maze.width, maze.height
        patience = _PATIENCE.get(task, 1) * (errands if task == "errand" else 1)
        self.max_steps = patience * width * height if max_steps is None else max_steps
        self.robots = Grids(
            task,
            maze,
            [0] * count,
            width=width,
            height=height,
            rays=rays,
            landmarks=landmarks,
            errands=errands,
            max_steps=self.max_steps,
        )
        self.is_seeded = False
        self.actions = spaces.Discrete(self.robots.action_count)
        parts: dict[str, spaces.Space[Any]] = {"sides": spaces.Box(0, max(width, height) - 1 if rays else 1, (4,), np.uint8)}
        if task == "errand":
            parts.update(here=spaces.Discrete(landmarks + 1), wanted=spaces.Discrete(landmarks + 1))
        if task == "locate":
            parts["walls"] = spaces.Box(0, 1, (2 * height + 1, 2 * width + 1), np.uint8)
        self.observations = spaces.Dict(parts)

    def reset(self, seeds: list[int | None], chance: np.random.Generator, options: dict[str, Any] | None) -> None:
        """Begin episodes. The first ones need seeds: `chance` has those that are not given."""
        maze = maze_option(options)
        for seed in seeds:
            if seed is not None and not 0 <= seed < _SEEDS:
                raise ValueError(f"seed is {seed} but has to be from 0 to {_SEEDS - 1}")
        if not self.is_seeded:
            seeds = [int(chance.integers(_SEEDS)) if seed is None else seed for seed in seeds]
        self.robots.reset(seeds, maze)
        self.is_seeded = True


class GridEnv(gymnasium.Env[_Observation, Any]):
    """A robot moves from cell to cell: `tolman/Errand-v0`, `tolman/Learn-v0`, `tolman/Locate-v0`.

    Actions are 0, a cell ahead, 1, a quarter turn to the right, and 2, to the left. Ahead of a
    wall the robot stays. `sides` are the robot's four sides, clockwise from ahead: 1 if there is
    no wall, or with `rays` the number of cells that it can look along. Each step costs 0.01.

    - errand: it drives to one of `landmarks` after another, `errands` in all, in a maze that it
      does not know. `here` is the landmark of its cell, `wanted` the one to drive to; 0 means no
      landmark. Each wanted one that it comes to gives 1.
    - learn: each cell and each opening between two cells gives 1 when it is first seen; what is
      seen from the start is known. It ends when all is seen.
    - locate: it is put down in any cell with any heading of a maze that it knows, `walls` as
      `Maze.to_array` gives them. The action 3 + 4 (width y + x) + heading tells where it is, with
      0 to 3 for north, east, south and west. That ends it, and gives 1 if it is right, else −1.

    `maze` is a maze, or the name of a family as `Maze.generate` takes it: then each episode has
    another maze, of `width` by `height` cells. `reset(options={"maze": maze})` changes it. After
    `max_steps` an episode is cut off: by default 10 for each cell, 4 for each cell and errand. An
    environment can be copied and pickled in the midst of an episode, and goes on alike.

    Parameters
    ----------
    task : {"errand", "learn", "locate"}
        What the robot has to do.
    maze : Maze or str
        A maze, or the name of a family.
    width, height : int
        The size in cells, for a family.
    rays : bool
        Whether `sides` are the numbers of cells that the robot can look along.
    landmarks, errands : int
        The number of landmarks, from 2, and of drives in an episode, for errands.
    max_steps : int or None
        The number of steps after which an episode is cut off.
    render_mode : {None, "rgb_array"}
        What `render` returns.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 10}

    def __init__(
        self,
        task: str,
        maze: Maze | str = "perfect",
        *,
        width: int = 5,
        height: int = 5,
        rays: bool = False,
        landmarks: int = 4,
        errands: int = 8,
        max_steps: int | None = None,
        render_mode: str | None = None,
    ) -> None:
        check_render_mode(render_mode)
        self._grid = _Grid(task, maze, width, height, rays, landmarks, errands, max_steps, 1)
        self.task = task
        self.max_steps = self._grid.max_steps
        self.render_mode = render_mode
        self.action_space = self._grid.actions
        self.observation_space = self._grid.observations

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[_Observation, dict[str, Any]]:
        """Begin another episode.

        Parameters
        ----------
        seed : int or None
            With the same seed, from 0 to 2⁶³ − 1, what follows repeats.
        options : dict or None
            It may have "maze": a Maze for this episode and those after it, or the name of a family.

        Returns
        -------
        (dict, dict)
            The observation, and `pose`, which the robot does not sense: column, row, and quarter turns to the right
            from north.

        Raises
        ------
        ValueError
            If an option is not known, or the seed or the size of the maze is another.
        """
        super().reset(seed=seed)
        self._grid.reset([seed], self.np_random, options)
        return self._observed(), self._known()

    def step(self, action: Any) -> tuple[_Observation, float, bool, bool, dict[str, Any]]:
        """Move, turn or tell.

        Parameters
        ----------
        action : int
            0 a cell ahead, 1 a quarter turn to the right, 2 to the left; to locate, 3 and more tell a pose.

        Returns
        -------
        (dict, float, bool, bool, dict)
            The observation, the reward, whether the task is done, whether the time is up, and `pose`.

        Raises
        ------
        RuntimeError
            If no episode is under way.
        ValueError
            If there is no such action.
        """
        robots = self._grid.robots
        if not self._grid.is_seeded or robots.ended[0]:
            raise RuntimeError("no episode is under way: call reset")
        rewards, ended, cut = robots.step(_whole(action).reshape(1))
        return self._observed(), float(rewards[0]), bool(ended[0]), bool(cut[0]), self._known()

    def render(self) -> Any:
        """Return a picture from above, if `render_mode` is "rgb_array", as `tolman/Maze-v0` does.

        The landmark to drive to is green, others are blue.
        """
        if self.render_mode != "rgb_array":
            return None
        robots = self._grid.robots
        x, y, heading = robots.poses[0]
        floors = dict.fromkeys(robots.landmarks[0], _LANDMARK)
        wanted = robots.observed()["wanted"][0] if floors else 0
        if wanted:
            floors[robots.landmarks[0][wanted - 1]] = GOAL
        return from_above(self.maze, (x + 0.5, y + 0.5, math.pi / 2 * (1 - heading)), floors)

    @property
    def maze(self) -> Maze:
        """The maze of this episode."""
        return self._grid.robots.mazes[0]

    @property
    def action_count(self) -> int:
        """The number of actions."""
        return self._grid.robots.action_count

    @property
    def oracle_steps(self) -> int:
        """Steps in which one who knows all would do the rest. See `GridVectorEnv.oracle_steps`."""
        return int(self._grid.robots.oracle_steps[0])

    @property
    def oracle_rewards(self) -> float:
        """Sum of the rewards that follow for one who does the rest in these steps."""
        return float(self._grid.robots.oracle_rewards[0])

    def _observed(self) -> _Observation:
        return {name: part[0] for name, part in self._grid.robots.observed().items()}

    def _known(self) -> dict[str, Any]:
        """Return what the robot does not sense."""
        x, y, heading = self._grid.robots.poses[0].tolist()
        return {"pose": (x, y, heading)}


class GridVectorEnv(VectorEnv[_Observation, Any, npt.NDArray[Any]]):
    """Many environments like `GridEnv`, of which one call steps all, in Rust.

    `gymnasium.make_vec("tolman/Learn-v0", num_envs=64, vectorization_mode="vector_entry_point")`
    makes it. With the seed s, environment number i is `GridEnv` with the seed s + i. The step after
    the last one of an episode begins another, whatever its action, and has no reward.

    Parameters
    ----------
    task : {"errand", "learn", "locate"}
        What the robots have to do.
    num_envs : int
        The number of robots, each in an environment of its own.
    maze : Maze or str
        A maze, or the name of a family.
    width, height : int
        The size in cells, for a family.
    rays : bool
        Whether `sides` are the numbers of cells that the robot can look along.
    landmarks, errands : int
        The number of landmarks, from 2, and of drives in an episode, for errands.
    max_steps : int or None
        The number of steps after which an episode is cut off.
    """

    metadata: dict[str, Any] = {"render_modes": [], "autoreset_mode": AutoresetMode.NEXT_STEP}

    def __init__(
        self,
        task: str,
        num_envs: int = 1,
        maze: Maze | str = "perfect",
        *,
        width: int = 5,
        height: int = 5,
        rays: bool = False,
        landmarks: int = 4,
        errands: int = 8,
        max_steps: int | None = None,
    ) -> None:
        if num_envs < 1:
            raise ValueError(f"num_envs is {num_envs} but has to be at least 1")
        self._grid = _Grid(task, maze, width, height, rays, landmarks, errands, max_steps, num_envs)
        self.task = task
        self.num_envs = num_envs
        self.max_steps = self._grid.max_steps
        self.single_action_space = self._grid.actions
        self.single_observation_space = self._grid.observations
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[_Observation, dict[str, Any]]:
        """Begin other episodes of all.

        Parameters
        ----------
        seed : int or list of int or None
            A seed, to which each robot adds its number, or one for each.
        options : dict or None
            As for `GridEnv.reset`.

        Returns
        -------
        (dict, dict)
            The observations, arrays with a row for each robot, and an empty dict.

        Raises
        ------
        ValueError
            As `GridEnv.reset` does.
        """
        if isinstance(seed, list):
            seeds = seed
            super().reset()
        else:
            super().reset(seed=seed)
            seeds = [None if seed is None else seed + number for number in range(self.num_envs)]
        self._grid.reset(seeds, self.np_random, options)
        return self._grid.robots.observed(), {}

    def step(self, actions: Any) -> tuple[_Observation, Any, Any, Any, dict[str, Any]]:
        """Make a step of all.

        Parameters
        ----------
        actions : array of shape (num_envs,), of whole numbers
            What each does, as for `GridEnv.step`.

        Returns
        -------
        (dict, array, array, array, dict)
            The observations, and for each robot the reward, whether its task is done and whether its time is up.

        Raises
        ------
        RuntimeError
            Before the first `reset`.
        ValueError
            If an action is not one of those, or their number is another.
        """
        if not self._grid.is_seeded:
            raise RuntimeError("no episode is under way: call reset")
        rewards, ended, cut = self._grid.robots.step(_whole(actions))
        return self._grid.robots.observed(), rewards, ended, cut, {}

    @property
    def poses(self) -> npt.NDArray[np.int64]:
        """Where the robots are: a row (column, row, quarter turns to the right from north) for each."""
        return self._grid.robots.poses

    @property
    def mazes(self) -> list[Maze]:
        """The maze of each."""
        return self._grid.robots.mazes

    @property
    def oracle_steps(self) -> npt.NDArray[np.uint32]:
        """Steps in which one who knows all would do the rest, for each.

        For errands and to locate it is the least number. For learn it is that of one who always
        goes where something new is seen soonest; a cleverer order may be shorter.
        """
        return self._grid.robots.oracle_steps

    @property
    def oracle_rewards(self) -> npt.NDArray[np.float64]:
        """Sum of the rewards that follow for one who does the rest in these steps, for each."""
        return self._grid.robots.oracle_rewards


def _whole(actions: Any) -> npt.NDArray[np.int64]:
    """Return actions as an array, if they are whole numbers."""
    array = np.asarray(actions)
    if array.dtype.kind not in "iu":
        raise ValueError(f"action is {actions!r} but has to be whole numbers")
    return array.astype(np.int64, copy=False)
