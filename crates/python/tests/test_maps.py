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
        (lambda: tolman.map_log(LOG, "mslst"), "system is 'mslst' but has to be one of odometry"),
        (lambda: tolman.map_log(ROOT / "README.md"), "path: .*no scan can be used"),
    ],
)
def test_wrong_input_is_named(ask, said):
    with pytest.raises(ValueError, match=said):
        ask()


def test_a_log_that_is_not_there():
    with pytest.raises(FileNotFoundError, match="nowhere.clf"):
        tolman.map_log("nowhere.clf")
