"""Search on graphs of one's own."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from typing import Any, NamedTuple

from ._tolman import cheapest_path

_DEAREST = 2**32 - 1


class Path(NamedTuple):
    """A cheapest path."""

    nodes: list[Any]
    """From the source to the target, both among them."""
    cost: int
    """The sum of the costs of its arcs."""


def shortest_path(graph: Mapping[Any, Any], source: Hashable, target: Hashable, *, weight: str | None = None) -> Path | None:
    """Return a cheapest path, or None where no way leads to the target.

    `graph` names for each node those that its arcs lead to; as a mapping of mappings, with the
    costs of the arcs, whole numbers from 0. A graph of networkx is such a mapping: then
    `weight` names the attribute that holds the cost, and without it each arc costs 1.
    """
    numbers: dict[Any, int] = {}
    for node in graph:
        numbers.setdefault(node, len(numbers))
    arcs = []
    for tail in graph:
        heads = graph[tail]
        for head in heads:
            if head not in numbers:
                raise ValueError(f"graph: {tail!r} leads to {head!r}, which is no node of it")
            cost = heads[head] if isinstance(heads, Mapping) else 1
            arcs.append((numbers[tail], numbers[head], _cost(cost, weight, tail, head)))
    for name, node in (("source", source), ("target", target)):
        if node not in numbers:
            raise ValueError(f"{name} is {node!r}, which is no node of the graph")
    found = cheapest_path(len(numbers), arcs, numbers[source], numbers[target])
    if found is None:
        return None
    nodes = list(numbers)
    return Path([nodes[number] for number in found[0]], found[1])


def _cost(cost: Any, weight: str | None, tail: Any, head: Any) -> int:
    if isinstance(cost, Mapping):
        if weight is None:
            return 1
        if weight not in cost:
            raise ValueError(f"weight: the arc from {tail!r} to {head!r} has no attribute {weight!r}")
        cost = cost[weight]
    elif weight is not None:
        raise ValueError("weight is for graphs whose arcs have attributes, as those of networkx")
    try:
        whole = int(cost)
    except (TypeError, ValueError, OverflowError):
        whole = -1
    if whole != cost or not 0 <= whole <= _DEAREST:
        raise ValueError(f"the cost from {tail!r} to {head!r} is {cost!r} but has to be a whole number from 0 to {_DEAREST}")
    return whole
