"""Shortest paths on graphs of one's own."""

import random

import pytest
from tolman import Path, shortest_path


def test_a_cheap_detour_is_taken():
    graph = {"a": {"b": 2, "c": 9}, "b": {"c": 2}, "c": {}}
    assert shortest_path(graph, "a", "c") == Path(["a", "b", "c"], 4)
    assert shortest_path(graph, "c", "a") is None
    assert shortest_path(graph, "b", "b") == (["b"], 0)
    assert shortest_path({"a": ["b", "c"], "b": ["c"], "c": []}, "a", "c") == (["a", "c"], 1)


def test_it_is_as_short_as_that_of_networkx():
    networkx = pytest.importorskip("networkx")
    rng = random.Random(5)
    graph = networkx.gnp_random_graph(60, 0.06, seed=5, directed=True)
    for edge in graph.edges.values():
        edge["metres"] = rng.randrange(20)
    found = 0
    for target in range(1, 60):
        for weight in ("metres", None):
            path = shortest_path(graph, 0, target, weight=weight)
            if path is None:
                assert not networkx.has_path(graph, 0, target)
                continue
            found += 1
            assert path.cost == networkx.shortest_path_length(graph, 0, target, weight=weight)
            assert path.nodes[0] == 0 and path.nodes[-1] == target
    assert found > 40


def test_it_is_faster_than_networkx_on_its_own_graph():
    import time

    networkx = pytest.importorskip("networkx")
    grid = networkx.grid_2d_graph(150, 150)
    for number, ends in enumerate(grid.edges):
        grid.edges[ends]["metres"] = 1 + number % 9
    ends = ((0, 0), (149, 149))
    for weight in (None, "metres"):
        times: dict = {shortest_path: [], networkx.shortest_path: []}
        for _ in range(5):
            for search, taken in times.items():
                begun = time.process_time()
                search(grid, *ends, weight=weight)
                taken.append(time.process_time() - begun)
        ours, theirs = map(min, times.values())
        assert ours < theirs, (weight, ours, theirs)


@pytest.mark.parametrize(
    ("graph", "source", "target", "weight", "said"),
    [
        ({"a": []}, "z", "a", None, "source is 'z'"),
        ({"a": []}, "a", "z", None, "target is 'z'"),
        ({"a": ["z"], "b": []}, "a", "b", None, "graph: 'a' leads to 'z'"),
        ({"a": {"b": -1}, "b": {}}, "a", "b", None, "the cost from 'a' to 'b' is -1"),
        ({"a": {"b": 0.5}, "b": {}}, "a", "b", None, "the cost from 'a' to 'b' is 0.5"),
        ({"a": {"b": "x"}, "b": {}}, "a", "b", None, "the cost from 'a' to 'b' is 'x'"),
        ({"a": {"b": {"m": 1}}, "b": {}}, "a", "b", "km", "weight: the arc from 'a' to 'b' has no attribute 'km'"),
        ({"a": {"b": 1}, "b": {}}, "a", "b", "km", "weight is for graphs"),
    ],
)
def test_wrong_input_is_named(graph, source, target, weight, said):
    with pytest.raises(ValueError, match=said):
        shortest_path(graph, source, target, weight=weight)


def test_a_graph_of_networkx_may_be_of_any_kind():
    networkx = pytest.importorskip("networkx")
    grid = networkx.grid_2d_graph(30, 30)
    path = shortest_path(grid, (0, 0), (29, 29))
    assert path.cost == 58 and all(grid.has_edge(*pair) for pair in zip(path.nodes, path.nodes[1:]))
    assert shortest_path(grid.to_directed(), (0, 0), (29, 29)).cost == 58
    assert shortest_path(networkx.Graph([("a", "b", {"m": 2.0}), ("b", "c", {"m": 3})]), "a", "c", weight="m").cost == 5
    apart = networkx.DiGraph([("a", "b"), ("c", "b")])
    assert shortest_path(apart, "a", "c") is None and shortest_path(apart, "a", "a") == (["a"], 0)
    assert shortest_path(apart, "a", "b") == (["a", "b"], 1)
    assert shortest_path(networkx.subgraph_view(grid, filter_node=lambda node: node[0] < 3), (0, 0), (2, 9)).cost == 11
