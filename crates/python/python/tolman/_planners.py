"""Search on graphs of one's own."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from typing import Any, NamedTuple

from ._tolman import cheapest_path


class Path(NamedTuple):
    """A cheapest path: `nodes` from the source to the target, both among them, and `cost`, the sum of its arcs' costs."""

    nodes: list[Any]
    """From the source to the target, both among them."""
    cost: int
    """The sum of the costs of its arcs."""


def shortest_path(graph: Mapping[Any, Any], source: Hashable, target: Hashable, *, weight: str | None = None) -> Path | None:
    """Return a cheapest path, or None where no way leads to the target.

    Only the part of the graph that the search reaches is looked up.

    Parameters
    ----------
    graph : mapping
        For each node those that its arcs lead to; as a mapping of mappings, with the costs of the arcs: whole numbers
        from 0. A graph of networkx is such a mapping.
    source, target : hashable
        Nodes of the graph.
    weight : str or None
        For a graph of networkx, the attribute that holds the cost. Without it each arc costs 1.

    Returns
    -------
    Path or None
        The nodes and the sum of the costs.

    Raises
    ------
    ValueError
        If the source or the target is no node, an arc leads to none, or a cost is not whole.
    """
    found = cheapest_path(graph, source, target, weight)
    return None if found is None else Path(*found)
