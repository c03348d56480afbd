"""Mazes, robots and the environment."""

import pickle
from pathlib import Path

import numpy as np
import pytest
from tolman import Maze, Robot

MAZES = Path(__file__).parents[3] / "mazes"

HOOK = """\
name = Hook
corridor_width = 0.95

+---+---+---+
|           |
+   +---+   +
| S |     G |
+---+---+---+
"""


def test_a_maze_of_a_text():
    hook = Maze(HOOK)
    assert (hook.name, hook.width, hook.height, hook.start, hook.goals) == ("Hook", 3, 2, (0, 0), [(2, 0)])
    assert hook.is_open((0, 0), "north") and not hook.is_open((0, 0), "east")
    assert sorted(hook.neighbours((2, 0))) == [(1, 0), (2, 1)]
    assert hook.shortest_path() == [(0, 0), (0, 1), (1, 1), (2, 1), (2, 0)]
    assert hook.shortest_path((1, 0), (2, 0)) == [(1, 0), (2, 0)]
    assert "S" in str(hook) and "Hook" in repr(hook)
    again = pickle.loads(pickle.dumps(hook))
    assert str(again) == str(hook) and again.name == "Hook"


def test_mazes_of_files():
    for path in (MAZES / "demo.maze", str(MAZES / "demo.maze")):
        assert Maze(path).name == "Demo"
    with pytest.raises(FileNotFoundError, match="nowhere.maze"):
        Maze("nowhere.maze")
    with pytest.raises(ValueError, match="maze: line 2"):
        Maze("+---+\n| S  \n")


def test_mazes_are_drawn_again_by_their_seed():
    for family in ("perfect", "braided", "office"):
        one, same, other = (Maze.generate(family, 8, 9, seed=seed) for seed in (1, 1, 2))
        assert str(one) == str(same) != str(other)
    with pytest.raises(ValueError, match="family is 'round' but has to be one of perfect"):
        Maze.generate("round")
    with pytest.raises(ValueError, match="width 0"):
        Maze.generate("perfect", 0, 5)


def test_shortest_paths_are_those_of_networkx():
    networkx = pytest.importorskip("networkx")
    maze = Maze.generate("braided", 12, 12, seed=4)
    graph = maze.to_networkx()
    for cell in list(graph)[::7]:
        path = maze.shortest_path(cell, (11, 11))
        assert len(path) - 1 == networkx.shortest_path_length(graph, cell, (11, 11))
        assert all(graph.has_edge(*step) for step in zip(path, path[1:]))


@pytest.mark.parametrize(
    ("ask", "said"),
    [
        (lambda m: m.shortest_path((9, 0)), r"start is \(9, 0\), which lies outside of 3 x 2"),
        (lambda m: m.shortest_path(None, (0, 2)), r"goal is \(0, 2\)"),
        (lambda m: m.is_open((0, 0), "up"), "direction is 'up'"),
        (lambda m: m.neighbours((3, 0)), r"cell is \(3, 0\)"),
        (lambda m: Robot(m, start="there"), "start is 'there'"),
        (lambda m: Robot(m, start=(0.0, 0.0, 0.0)), "start: "),
        (lambda m: Robot(m, start=(float("nan"), 0.0, 0.0)), "start has a part that is not finite"),
        (lambda m: Robot(m).step(float("inf"), 0.0), "turn is inf"),
    ],
)
def test_wrong_input_is_named(ask, said):
    with pytest.raises(ValueError, match=said):
        ask(Maze(HOOK))


def test_a_robot_without_noise_drives_as_told():
    robot = Robot(Maze(HOOK), noise=False)
    x, y, heading = robot.pose
    assert robot.ranges.shape == (robot.beams,) and 0 < robot.ranges.min() and robot.ranges.max() <= robot.reach
    assert robot.compass == heading == pytest.approx(np.pi / 2)
    robot.step(0.0, 0.5)
    assert robot.steps == 1 and not robot.bump and not robot.at_goal
    assert robot.pose[1] - y == pytest.approx(robot.odometry[0]) and robot.pose[1] > y
    assert robot.pose[0] == pytest.approx(x)
    turned = robot.pose[2]
    robot.step(0.5, 0.0)
    assert robot.odometry[1] > 0 and robot.compass - turned == pytest.approx(robot.odometry[1])


def test_runs_repeat_by_their_seed():
    def run(seed):
        robot = Robot(Maze(MAZES / "demo.maze"), seed=seed, start="random")
        for _ in range(30):
            robot.step(0.1, 0.3)
        return robot.pose, robot.ranges.tolist()

    assert run(1) == run(1) != run(2)


class TestEnvironment:
    @pytest.fixture(autouse=True)
    def needs_gymnasium(self):
        pytest.importorskip("gymnasium")

    def test_it_keeps_to_the_interface(self):
        import gymnasium
        import tolman.gym  # noqa: F401
        from gymnasium.utils.env_checker import check_env

        check_env(gymnasium.make("tolman/Maze-v0", maze=Maze(HOOK)).unwrapped, skip_render_check=True)

    def test_who_drives_to_the_goal_arrives(self):
        from tolman.gym import MazeEnv

        env = MazeEnv(Maze(HOOK), start="marked", noise=False, max_steps=60)
        _, known = env.reset(seed=3)
        cells = [(0.475 + 0.95 * x, 0.475 + 0.95 * y) for x, y in env.maze.shortest_path()]
        rewards, ended = [], False
        while not ended:
            x, y, heading = known["pose"]
            reached = [at for at in range(len(cells)) if np.hypot(cells[at][0] - x, cells[at][1] - y) < 0.2]
            goal = cells[min(max(reached, default=0) + 1, len(cells) - 1)]
            if len(cells) > 2 and reached:
                del cells[: max(reached)]
            bearing = np.arctan2(goal[1] - y, goal[0] - x) - heading
            bearing = np.arctan2(np.sin(bearing), np.cos(bearing))
            ahead = np.cos(bearing) > 0.95
            action = [np.clip(bearing / 1.5, -1, 1), 0.2 if ahead else 0.0]
            seen, reward, arrived, cut, known = env.step(np.asarray(action, np.float32))
            assert env.observation_space.contains(seen)
            rewards.append(reward)
            ended = arrived or cut
        assert arrived and not cut and sum(rewards) == -len(rewards)

    def test_time_is_up_after_max_steps(self):
        from tolman.gym import MazeEnv

        env = MazeEnv(Maze(HOOK), start="marked", max_steps=3)
        env.reset(seed=1)
        ends = [env.step(np.zeros(2, np.float32))[2:4] for _ in range(3)]
        assert ends == [(False, False), (False, False), (False, True)]
        with pytest.raises(ValueError, match="max_steps is 0"):
            MazeEnv(Maze(HOOK), max_steps=0)
