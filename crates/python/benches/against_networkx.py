"""Paths in graphs of networkx: `tolman.shortest_path` beside networkx's own, in turn, medians of processor time.

    python crates/python/benches/against_networkx.py
"""

import random
import time

import networkx
import numpy as np
import tolman


def taken(search):
    begun = time.process_time()
    search()
    return 1000 * (time.process_time() - begun)


def compare(name, graph, source, target, weight=None):
    ends = (graph, source, target)
    searches = [lambda: tolman.shortest_path(*ends, weight=weight), lambda: networkx.shortest_path(*ends, weight=weight)]
    ours, theirs = np.median([[taken(search) for search in searches] for _ in range(5)], axis=0)
    print(f"| {name} | {ours:.1f} | {theirs:.1f} | {theirs / ours:.1f} |", flush=True)


def with_costs(graph):
    rng = random.Random(1)
    for _, _, known in graph.edges(data=True):
        known["cost"] = rng.randint(1, 100)
    return graph


if __name__ == "__main__":
    print("| graph | ours, ms | networkx, ms | times as fast |\n| --- | ---: | ---: | ---: |")
    grid = with_costs(networkx.grid_2d_graph(300, 300))
    compare("grid 300 × 300, steps", grid, (0, 0), (299, 299))
    compare("grid 300 × 300, costs 1 to 100", grid, (0, 0), (299, 299), "cost")
    drawn = with_costs(networkx.gnm_random_graph(100_000, 500_000, seed=1, directed=True))
    compare("random, 100,000 nodes and 500,000 arcs, steps", drawn, 0, 77_777)
    compare("the same, costs 1 to 100", drawn, 0, 77_777, "cost")
    compare("a path of 200,000 nodes", networkx.path_graph(200_000), 0, 199_999)
