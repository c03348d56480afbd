"""The environments of robots that move from cell to cell, one and many."""

import copy
import pickle
import subprocess
import sys
import warnings

import numpy as np
import pytest
from tolman import Maze

gymnasium = pytest.importorskip("gymnasium")

from tolman.gym import GridEnv, GridVectorEnv  # noqa: E402

TASKS = ("errand", "learn", "locate")
AHEAD, RIGHT, LEFT = range(3)
STEP = {0: (0, 1), 1: (1, 0), 2: (0, -1), 3: (-1, 0)}
NAMES = ("north", "east", "south", "west")

HOOK = """\
+---+---+---+
|           |
+   +---+   +
| S |     G |
+---+---+---+
"""


def drawn(task, count, seed=0):
    """Return actions at random, most of them moves."""
    rng = np.random.default_rng(seed)
    top = GridEnv(task).action_space.n
    moves = rng.integers(0, 3, count)
    return np.where(rng.random(count) < 0.03, rng.integers(0, top, count), moves)


@pytest.mark.parametrize("rays", [False, True])
@pytest.mark.parametrize("task", TASKS)
def test_they_keep_to_the_interface(task, rays):
    from gymnasium.utils.env_checker import check_env

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        made = gymnasium.make(f"tolman/{task.title()}-v0", rays=rays, render_mode="rgb_array")
        check_env(made.unwrapped)
        many = gymnasium.make_vec(f"tolman/{task.title()}-v0", num_envs=3, vectorization_mode="vector_entry_point", rays=rays)
        seen, _ = many.reset(seed=1)
        assert isinstance(many.unwrapped, GridVectorEnv) and many.observation_space.contains(seen)
        seen, rewards, ended, cut, _ = many.step(many.action_space.sample())
        assert many.observation_space.contains(seen) and rewards.shape == ended.shape == cut.shape == (3,)


@pytest.mark.parametrize("task", TASKS)
def test_many_are_what_one_is(task):
    count, steps = 5, 400
    many = GridVectorEnv(task, count, rays=True, errands=2, max_steps=60)
    ones = [GridEnv(task, rays=True, errands=2, max_steps=60) for _ in range(count)]
    seen, _ = many.reset(seed=7)
    singles = [env.reset(seed=7 + at)[0] for at, env in enumerate(ones)]
    over = [False] * count
    episodes = 0
    for actions in drawn(task, (steps, count)):
        for name, part in seen.items():
            assert all((part[at] == single[name]).all() for at, single in enumerate(singles))
        assert many.poses.tolist() == [list(env._known()["pose"]) for env in ones]
        seen, rewards, ended, cut, _ = many.step(actions)
        for at, env in enumerate(ones):
            if over[at]:
                singles[at], given, over[at] = env.reset()[0], (0.0, False, False), False
                episodes += 1
            else:
                singles[at], *given, _ = env.step(actions[at])
                over[at] = given[1] or given[2]
            assert (rewards[at], ended[at], cut[at]) == tuple(given)
    assert episodes > 10


@pytest.mark.parametrize("task", TASKS)
def test_runs_repeat_by_their_seed_and_mazes_change(task):
    def run(seed):
        many = GridVectorEnv(task, 4, "braided", width=6, height=5, max_steps=30)
        told = [many.reset(seed=seed)[0]["sides"].tolist()]
        mazes = [maze.to_array().tolist() for maze in many.mazes]
        for actions in drawn(task, (50, 4)):
            seen, rewards, *_ = many.step(actions)
            told.append((seen["sides"].tolist(), rewards.tolist()))
        assert [maze.to_array().tolist() for maze in many.mazes] != mazes
        return told, mazes

    assert run(1) == run(1) != run(2)
    assert len(set(map(str, run(3)[1]))) == 4


@pytest.mark.parametrize("source", ["office", Maze(HOOK)], ids=["family", "maze"])
@pytest.mark.parametrize("task", TASKS)
def test_a_copy_goes_on_alike(task, source):
    env = gymnasium.make(f"tolman/{task.title()}-v0", maze=source, landmarks=3, errands=9, max_steps=40)
    many = GridVectorEnv(task, 3, source, landmarks=3, errands=9, max_steps=40)
    env.reset(seed=4)
    many.reset(seed=4)
    actions = np.random.default_rng(1).integers(0, 3, (120, 3))
    for row in actions[:17]:
        env.step(row[0])
        many.step(row)
    ones = [env, copy.deepcopy(env), pickle.loads(pickle.dumps(env.unwrapped))]
    batches = [many, copy.deepcopy(many), pickle.loads(pickle.dumps(many))]
    for row in actions[17:]:
        told = [str(one.step(row[0])) for one in ones]
        assert told[0] == told[1] == told[2]
        if "True" in told[0]:
            assert len({str(one.reset()) for one in ones}) == 1
        told = [str(one.step(row)) for one in batches]
        assert told[0] == told[1] == told[2]


def drive(env, cells):
    """Drive through cells side by side, and return the sum of rewards and the number of steps."""
    rewards, steps = 0.0, 0
    for to in cells:
        x, y, heading = env._known()["pose"]
        turn = next(turn for turn in range(4) if (x + STEP[turn][0], y + STEP[turn][1]) == to)
        turns = {0: [], 1: [RIGHT], 2: [RIGHT, RIGHT], 3: [LEFT]}[(turn - heading) % 4]
        for action in [*turns, AHEAD]:
            seen, reward, ended, cut, _ = env.step(action)
            rewards, steps = rewards + reward, steps + 1
            if ended or cut:
                return rewards, steps, ended
    return rewards, steps, False


@pytest.mark.parametrize("seed", range(5))
def test_sides_are_those_of_the_maze(seed):
    env, far = (GridEnv("learn", "braided", width=7, height=6, rays=rays) for rays in (False, True))
    env.reset(seed=seed)
    far.reset(seed=seed)
    assert env.maze == far.maze
    for action in np.random.default_rng(seed).integers(0, 3, 60):
        seen, long = env._observed()["sides"], far._observed()["sides"]
        x, y, heading = env._known()["pose"]
        for side in range(4):
            at, count, turn = (x, y), 0, (heading + side) % 4
            while env.maze.is_open(at, NAMES[turn]):
                at, count = (at[0] + STEP[turn][0], at[1] + STEP[turn][1]), count + 1
            assert (seen[side], long[side]) == (min(count, 1), count)
        if env.step(action)[2] or far.step(action)[2]:
            break


@pytest.mark.parametrize("seed", range(6))
def test_errands_are_delivered_in_order_and_no_way_is_shorter_than_the_oracles(seed):
    env = GridEnv("errand", "braided", errands=3, landmarks=4)
    seen, _ = env.reset(seed=seed)
    oracle, delivered, steps, rewards, ended = env.oracle_steps, [], 0, 0.0, False
    assert env.oracle_rewards == pytest.approx(3 - 0.01 * oracle)
    while not ended:
        wanted = int(seen["wanted"])
        x, y, _ = env._known()["pose"]
        goal = env._grid.robots.landmarks[0][wanted - 1]
        reward, more, ended = drive(env, env.maze.shortest_path((x, y), goal)[1:])
        seen = env._observed()
        assert seen["here"] == wanted != seen["wanted"]
        delivered.append(wanted)
        steps, rewards = steps + more, rewards + reward
    assert len(delivered) == 3 and seen["wanted"] == 0 and env.oracle_steps == 0
    assert rewards == pytest.approx(3 - 0.01 * steps)
    # Shortest paths may have more turns, and may end with another heading.
    assert oracle <= steps <= oracle + 12
    with pytest.raises(RuntimeError, match="call reset"):
        env.step(0)


def test_the_oracles_steps_of_an_errand_are_the_least():
    """A search through all sequences of moves of the robot itself finds no shorter one."""
    env = GridEnv("errand", Maze(HOOK), landmarks=2, errands=2)
    for seed in range(4):
        env.reset(seed=seed)
        least, states = 0, [env]
        while not any(state._grid.robots.ended[0] for state in states):
            after = {}
            for state in states:
                for action in range(3):
                    other = copy.deepcopy(state)
                    other.step(action)
                    after.setdefault((other._known()["pose"], int(other._observed()["wanted"])), other)
            least, states = least + 1, list(after.values())
        assert env.oracle_steps == least > 0


def test_who_sees_all_has_a_reward_for_each_place_and_link():
    env = GridEnv("learn", Maze(HOOK), max_steps=50)
    env.reset(seed=1)
    # Of six cells and five openings, the start shows two cells and one opening.
    rewards, steps, ended = drive(env, [(0, 1), (1, 1), (2, 1), (2, 0)])
    assert ended and rewards == pytest.approx(6 + 5 - 3 - 0.01 * steps)
    far = GridEnv("learn", Maze(HOOK), rays=True)
    far.reset(seed=1)
    assert far.oracle_steps == steps == 6
    rewards = [far.step(action)[1] for action in (AHEAD, RIGHT, AHEAD, AHEAD)]
    assert rewards == pytest.approx([4 - 0.01, -0.01, -0.01, 2 - 0.01])


@pytest.mark.parametrize("task", ["errand", "learn"])
def test_the_oracles_steps_can_be_driven(task):
    """In a corridor there is but one way."""
    corridor = Maze("+---+---+---+---+\n| S           G |\n+---+---+---+---+\n")
    env = GridEnv(task, corridor, landmarks=3, errands=1)
    env.reset(seed=0)
    oracle, actions = env.oracle_steps, [RIGHT] + [AHEAD] * 3
    if task == "learn":
        assert oracle == 3
    else:
        cell = env._grid.robots.landmarks[0][int(env._observed()["wanted"]) - 1]
        assert oracle == 1 + cell[0]
    ends = [env.step(action)[2] for action in actions[:oracle]]
    assert ends == [False] * (oracle - 1) + [True]


def test_a_pose_is_told_once():
    for is_right in (True, False):
        env = GridEnv("locate", "braided", width=6, height=4)
        seen, known = env.reset(seed=3)
        x, y, heading = known["pose"]
        assert (seen["walls"] == env.maze.to_array()).all() and env.oracle_steps == 1
        told = 3 + 4 * (6 * y + x) + (heading if is_right else (heading + 1) % 4)
        _, reward, ended, cut, _ = env.step(told)
        assert (reward, ended, cut) == (pytest.approx(0.99 if is_right else -1.01), True, False)
    poses = {env.reset(seed=seed)[1]["pose"] for seed in range(300)}
    assert len({pose[:2] for pose in poses}) == 24 and len({pose[2] for pose in poses}) == 4


def test_time_is_up_after_max_steps():
    env = GridEnv("locate", max_steps=3)
    env.reset(seed=1)
    assert [env.step(RIGHT)[2:4] for _ in range(3)] == [(False, False), (False, False), (False, True)]
    assert GridEnv("learn", width=4, height=3).max_steps == 120 and GridEnv("errand", width=4, height=3, errands=5).max_steps == 240


def test_mazes_change_by_option():
    env = GridEnv("learn", Maze(HOOK))
    env.reset(seed=1, options={"maze": "braided"})
    assert (env.maze.width, env.maze.height) == (3, 2) and env.maze != Maze(HOOK)
    env.reset(options={"maze": Maze(HOOK)})
    env.reset()
    assert (env.maze.to_array() == Maze(HOOK).to_array()).all()
    many = GridVectorEnv("learn", 2)
    many.reset(seed=[5, None], options={"maze": Maze.generate("ring", 5, 5, seed=1)})
    assert all((maze.to_array() == Maze.generate("ring", 5, 5, seed=1).to_array()).all() for maze in many.mazes)


def test_a_picture_shows_landmarks_and_the_robot():
    env = GridEnv("errand", Maze(HOOK), landmarks=3, render_mode="rgb_array")
    env.reset(seed=1)
    picture = env.render()
    assert picture.shape == (2 * 24 + 3, 3 * 24 + 3, 3) and picture.dtype == np.uint8
    assert tuple(picture[24 + 13, 13]) == (210, 40, 40)
    floors = [(picture == colour).all(axis=2).sum() for colour in ((190, 235, 190), (225, 225, 240))]
    assert floors[0] > 300 and floors[1] > 600
    env.step(AHEAD)
    assert (env.render() != picture).any() and GridEnv("learn").render() is None


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: GridEnv("dance"), "task is 'dance' but has to be one of errand, learn, locate"),
        (lambda: GridEnv("learn", "round"), "maze is 'round' but has to be one of perfect"),
        (lambda: GridEnv("learn", "office", width=2, height=2), "width 2, height 2: "),
        (lambda: GridEnv("learn", width=0), "width is 0 but has to be from 1 to 255"),
        (lambda: GridEnv("learn", height=70_000), "height is 70000 but has to be from 1 to 255"),
        (lambda: GridVectorEnv("learn", 2).reset(seed=[-1, 1]), "seed is -1 but has to be from 0"),
        (lambda: GridVectorEnv("learn", 2).reset(seed=2**63 - 1), f"seed is {2**63} but"),
        (lambda: GridEnv("errand", landmarks=1), "landmarks is 1 but has to be from 2"),
        (lambda: GridEnv("errand", landmarks=25), "landmarks is 25, but the maze has only 24 other cells"),
        (lambda: GridEnv("errand", errands=0, max_steps=9), "errands is 0"),
        (lambda: GridEnv("learn", max_steps=0), "max_steps is 0"),
        (lambda: GridEnv("learn", render_mode="human"), "render_mode is 'human'"),
        (lambda: GridVectorEnv("learn", 0), "num_envs is 0"),
        (lambda: GridEnv("learn").reset(options={"maze": Maze(HOOK)}), "maze has 3 x 2 cells, but this environment is of 5 x 5"),
        (lambda: GridEnv("learn").reset(options={"maize": "perfect"}), "options has 'maize'"),
        (lambda: GridVectorEnv("learn", 2).reset(seed=[1]), "seeds has 1 but has to have one, or None, for each of 2"),
        (lambda: ready().step(np.array([0, 3])), "action is 3 but has to be from 0 to 2"),
        (lambda: ready().step(np.array([0, -1])), "action is -1"),
        (lambda: ready().step(np.array([0])), "actions has 1 but has to have one for each of 2"),
        (lambda: ready().step(np.array([0.5, 1.0])), "has to be whole numbers"),
    ],
)
def test_wrong_input_is_named(make, said):
    with pytest.raises(ValueError, match=said):
        make()


def ready():
    many = GridVectorEnv("learn", 2)
    many.reset(seed=1)
    return many


@pytest.mark.parametrize("name", ["Maze", "Errand", "Learn", "Locate"])
def test_gymnasium_finds_them_by_the_name_of_their_module(name):
    code = f"import gymnasium; print(gymnasium.make('tolman.gym:tolman/{name}-v0').reset(seed=1))"
    made = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "pose" in made.stdout and not made.stderr


def test_those_of_gymnasium_can_hold_them():
    sync = gymnasium.make_vec("tolman/Errand-v0", num_envs=3, vectorization_mode="sync", max_steps=30)
    many = gymnasium.make_vec("tolman/Errand-v0", num_envs=3, max_steps=30)
    many = gymnasium.wrappers.vector.RecordEpisodeStatistics(many)
    assert (sync.reset(seed=2)[0]["wanted"] == many.reset(seed=2)[0]["wanted"]).all()
    for actions in np.random.default_rng(1).integers(0, 3, (100, 3)):
        assert (sync.step(actions)[1] == many.step(actions)[1]).all()
    assert many.episode_count == 9


def test_a_reset_comes_first():
    for env, action in ((GridEnv("learn"), 0), (GridVectorEnv("learn", 2), np.array([0, 0]))):
        with pytest.raises(RuntimeError, match="call reset"):
            env.step(action)
