"""Systems learn maps of mazes and of logs."""

from pathlib import Path

import numpy as np
import pytest
import tolman
from tolman import Maze

ROOT = Path(__file__).parents[3]
LOG = ROOT / "logs" / "office.clf.gz"


@pytest.mark.parametrize("system", ["mslst-better", "cpm-better", "diktiometry-better"])
def test_a_system_learns_a_star(system):
    maze = Maze.generate("star", seed=3)
    learned = tolman.learn(maze, system, seed=3)
    assert learned.is_right and learned.outcome == "done", learned
    assert len(learned) == len(learned.places) > 4 and len(learned.links) > 4
    assert learned.path.shape[1] == 3 and len(learned.path) > 20
    again = tolman.learn(maze, system, seed=3)
    assert (again.path == learned.path).all() and again.links == learned.links


def test_all_systems_learn_something():
    maze = Maze.generate("ring", 5, 5, seed=1)
    assert len(tolman.systems()) == 10
    for system in tolman.systems():
        if system == "gng-slam-better":
            continue  # It takes some seconds.
        learned = tolman.learn(maze, system)
        assert len(learned.path) > 1, system


def test_a_map_is_a_graph():
    networkx = pytest.importorskip("networkx")
    learned = tolman.learn(Maze.generate("star", seed=3), "mslst-better", 3)
    graph = learned.to_networkx()
    assert set(graph.edges) == set(learned.links) and set(graph) == set(learned.places)
    assert networkx.is_weakly_connected(graph)
    goals = [place for place, known in graph.nodes(data=True) if known.get("landmark") == "goal"]
    assert goals and all(isinstance(known["x"], float) for _, known in graph.nodes(data=True))
    import io

    for write in (networkx.write_graphml, networkx.write_gexf, networkx.write_gml):
        write(graph, io.BytesIO())
    assert learned._repr_html_().count("<circle") == len(learned)


@pytest.fixture(scope="module")
def star():
    maze = Maze.generate("star", seed=3)
    return maze, tolman.learn(maze, "mslst-better", 3)


def test_a_map_is_saved_opened_and_driven_by(star, tmp_path):
    maze, learned = star
    learned.save(tmp_path / "map.json")
    again = tolman.Map.open(tmp_path / "map.json")
    assert again.links == learned.links and list(again.places) == list(learned.places) and len(again.path) == 0
    drives = [learned.drive(seed=4), again.drive(maze, seed=4)]
    for drive in drives:
        assert drive.reached and drive.outcome == "done" and drive.steps == len(drive.path) - 1 and drive.metres > 1
        assert "<svg" in drive._repr_html_() and "at the goal" in repr(drive)
    assert (drives[0].path == drives[1].path).all()
    assert not np.array_equal(drives[0].path, learned.drive(seed=5).path)


def test_a_replay_is_shown_and_saved(star, tmp_path):
    _, learned = star
    replay = learned.replay()
    assert replay._repr_html_().startswith("<svg") and f"{len(learned.path) - 1} steps" in repr(replay)
    replay.save(tmp_path / "replay.html")
    assert "<!DOCTYPE html>" in (tmp_path / "replay.html").read_text(encoding="utf-8")


def test_a_frame_and_a_drawing_have_the_places(star):
    _, learned = star
    pandas = pytest.importorskip("pandas")
    frame = learned.to_frame()
    assert list(frame.index) == list(learned.places) and list(frame.columns) == ["x", "y", "landmark"]
    assert (frame.landmark == "goal").sum() == 1 and pandas.notna(frame.x).all()
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    assert len(learned.plot().collections) == 2
    assert len(tolman.map_log(LOG, "odometry").plot().lines) == 1


def test_progress_is_told_and_control_c_ends_learning():
    import os
    import signal

    told = []

    def tell(steps, words):
        told.append((steps, words))
        if len(told) == 2:
            os.kill(os.getpid(), signal.SIGINT)

    # A shell lets what it starts in the background ignore Ctrl-C.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    with pytest.raises(KeyboardInterrupt):
        tolman.learn(Maze.generate("ring", 5, 5, seed=1), "gng-slam-better", progress=tell)
    assert told[0][0] < told[1][0] and all(isinstance(words, str) for _, words in told)
    with pytest.raises(ZeroDivisionError):
        tolman.learn(Maze.generate("ring", 5, 5, seed=1), "gng-slam-better", progress=lambda steps, words: 1 // 0)


def test_a_log_is_mapped():
    found = tolman.map_log(LOG)
    wheels = tolman.map_log(str(LOG), "odometry")
    assert found.closures > 0 and wheels.closures == 0
    assert found.path.shape == wheels.path.shape and np.isfinite(found.path).all()
    assert found.is_right is None and len(wheels) == 0
    places = tolman.map_log(LOG, "places")
    assert len(places) > 3 and len(places.to_networkx()) == len(places)


@pytest.mark.parametrize(
    ("ask", "said"),
    [
        (lambda: tolman.learn(Maze.generate(), "magic"), "system is 'magic' but has to be one of mslst"),
        (lambda: tolman.learn(Maze.generate(), "oracle"), "system is 'oracle'"),
        (lambda: tolman.learn(Maze.generate(), "cpm", robot="horse"), "robot is 'horse'"),
        (lambda: tolman.learn(Maze.generate("pillars", 5, 5), "cpm"), "maze: CPM cannot learn it: .*open square"),
        (lambda: tolman.map_log(LOG, "mslst"), "system is 'mslst' but has to be one of .*odometry"),
        (lambda: tolman.map_log(ROOT / "README.md"), "path: .*no scan can be used"),
        (lambda: tolman.map_log(LOG, "odometry").save("map.json"), "this map has no file: it comes from a log"),
        (lambda: tolman.map_log(LOG, "odometry").replay(), "there is no replay of a map from a log or a file"),
        (lambda: tolman.map_log(LOG, "odometry").drive(), "maze: the map does not know its maze"),
        (lambda: tolman.Map.open(ROOT / "README.md"), "path: this is not a learned map"),
        (
            lambda: tolman.learn(Maze.generate("star", seed=3), seed=3).drive(Maze.generate("perfect", 5, 5)),
            "maze is perfect 5x5, seed 1, and the map was learned in another, star",
        ),
        (lambda: tolman.learn(Maze.generate("star", seed=3), "micromouse").drive(), "does not drive by a map"),
    ],
)
def test_wrong_input_is_named(ask, said):
    with pytest.raises(ValueError, match=said):
        ask()


def test_a_log_that_is_not_there():
    with pytest.raises(FileNotFoundError, match="nowhere.clf"):
        tolman.map_log("nowhere.clf")
    with pytest.raises(FileNotFoundError, match="nowhere.json"):
        tolman.Map.open("nowhere.json")
