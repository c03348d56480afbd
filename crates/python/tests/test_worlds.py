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


class TestWalls:
    def test_an_array_there_and_back(self):
        hook = Maze(HOOK)
        walls = hook.to_array()
        assert walls.shape == (5, 7) and walls[-2, 1] == 0 and walls[-2, 2] == 1 and walls[-3, 1] == 0
        for same in (walls, walls.tolist(), walls.astype(bool), walls.astype(float)):
            again = Maze(same)
            assert (again.to_array() == walls).all() and again.shortest_path((0, 0), (2, 0)) == hook.shortest_path()

    @pytest.mark.parametrize(
        ("change", "said"),
        [
            (lambda walls: walls[:4], r"shape \(4, 7\)"),
            (lambda walls: walls[0], "two dimensions"),
            (lambda walls: walls * 2, "has 2 at row 0, column 0"),
            (lambda walls: 1 - walls, "has a wall at row 3, column 1|open at row"),
            (lambda walls: np.ones((5, 5)), "the middle of a cell"),
            (lambda walls: None, "has to be a text .* with two dimensions"),
            (lambda walls: 3.5, "two dimensions"),
            (lambda walls: {"a": 1}, "has to be a text .* not dict"),
        ],
    )
    def test_wrong_arrays_are_named(self, change, said):
        with pytest.raises(ValueError, match=said):
            Maze(change(Maze(HOOK).to_array()))

    def test_copies_are_equal(self, tmp_path):
        import copy

        hook = Maze(HOOK)
        assert copy.deepcopy(hook) == hook == pickle.loads(pickle.dumps(hook)) and hash(copy.copy(hook)) == hash(hook)
        assert hook != Maze(MAZES / "demo.maze") and hook != 3
        hook.save(tmp_path / "hook.maze")
        assert Maze(tmp_path / "hook.maze") == hook
        with pytest.raises(OSError, match="nowhere"):
            hook.save(tmp_path / "nowhere" / "hook.maze")

    def test_a_notebook_draws_it(self):
        drawn = Maze(HOOK)._repr_html_()
        assert drawn.startswith("<svg") and ">S<" in drawn and ">G<" in drawn
        matplotlib = pytest.importorskip("matplotlib")
        matplotlib.use("Agg")
        axes = Maze(HOOK).plot()
        assert {text.get_text() for text in axes.texts} == {"S", "G"} and Maze(HOOK).plot(axes) is axes


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

    def test_a_copy_goes_on_alike(self):
        import copy

        import gymnasium
        import tolman.gym  # noqa: F401

        env = gymnasium.make("tolman/Maze-v0", maze=Maze(HOOK))
        env.reset(seed=1)
        moves = np.random.default_rng(0).uniform(-1, 1, (20, 2)).astype(np.float32)
        for move in moves[:10]:
            env.step(move)
        copies = [copy.deepcopy(env), pickle.loads(pickle.dumps(env.unwrapped))]
        for move in moves[10:]:
            seen = env.step(move)[0]["ranges"]
            assert all((other.step(move)[0]["ranges"] == seen).all() for other in copies)
        assert env.reset()[1]["pose"] == copies[1].reset()[1]["pose"]

    def test_mazes_change_by_episode_or_option(self):
        from tolman.gym import MazeEnv

        env = MazeEnv("braided")
        mazes = {str((env.reset(seed=seed), env.maze)[1]) for seed in (1, 2, 3)}
        assert len(mazes) == 3
        limit = env.max_steps
        env.reset(seed=1, options={"maze": Maze.generate("perfect", 9, 9, seed=4)})
        assert env.maze.width == 9 and env.max_steps > limit
        env.reset(seed=2)
        assert env.maze.width == 9
        for wrong in ({"maze": 3}, {"maize": Maze(HOOK)}):
            with pytest.raises(ValueError, match="options has"):
                env.reset(options=wrong)

    def test_a_picture_shows_walls_goals_and_the_robot(self):
        from tolman.gym import MazeEnv

        env = MazeEnv(Maze(HOOK), start="marked", noise=False, render_mode="rgb_array")
        env.reset(seed=1)
        picture = env.render()
        assert picture.shape == (2 * 24 + 3, 3 * 24 + 3, 3) and picture.dtype == np.uint8
        assert (picture[0] == 0).all() and (picture[:, -1] == 0).all()
        x, y, _ = env._robot.pose
        at = (len(picture) - round(y / env._robot.pitch * 24) - 2, round(x / env._robot.pitch * 24) + 1)
        assert tuple(picture[at]) == (210, 40, 40)
        assert (picture == (190, 235, 190)).all(axis=2).sum() > 100
        before = picture.copy()
        env.step(np.array([0.0, 1.0], np.float32))
        assert (env.render() != before).any() and MazeEnv(Maze(HOOK)).render() is None
        with pytest.raises(ValueError, match="render_mode is 'human'"):
            MazeEnv(render_mode="human")

    def test_time_is_up_after_max_steps(self):
        from tolman.gym import MazeEnv

        env = MazeEnv(Maze(HOOK), start="marked", max_steps=3)
        env.reset(seed=1)
        ends = [env.step(np.zeros(2, np.float32))[2:4] for _ in range(3)]
        assert ends == [(False, False), (False, False), (False, True)]
        with pytest.raises(ValueError, match="max_steps is 0"):
            MazeEnv(Maze(HOOK), max_steps=0)
