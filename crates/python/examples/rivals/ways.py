"""Shortest ways on grids."""

import heapq
import math

STEPS = [(dy, dx, math.hypot(dx, dy)) for dy in (-1, 0, 1) for dx in (-1, 0, 1) if dx or dy]


def way(start, is_goal, cost):
    """Return the cheapest way from a cell to the nearest goal, by Dijkstra's algorithm, or `None`.

    A cell is a row and a column; `cost` has what a step into it costs, infinity where none leads.
    """
    found = ways(start, cost, is_goal)
    goal = next((at for at in found if is_goal(at)), None)
    return None if goal is None else back(found, goal)


def ways(start, cost, ends=lambda at: False):
    """Return for each cell that is reached its cost and the cell before, until one ends it."""
    height, width = cost.shape
    found, waiting = {}, [(0.0, start, start)]
    while waiting:
        spent, at, before = heapq.heappop(waiting)
        if at in found:
            continue
        found[at] = spent, before
        if ends(at):
            return found
        for dy, dx, far in STEPS:
            row, column = at[0] + dy, at[1] + dx
            if 0 <= row < height and 0 <= column < width and (row, column) not in found:
                more = far * cost[row, column]
                if more < math.inf:
                    heapq.heappush(waiting, (spent + more, (row, column), at))
    return found


def back(found, goal):
    """Return the way to a cell that was found."""
    path = [goal]
    while found[path[-1]][1] != path[-1]:
        path.append(found[path[-1]][1])
    return path[::-1]
