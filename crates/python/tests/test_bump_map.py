"""Maps of actions and bumps alone."""

import pytest
from tolman import BumpMap, Maze

STEPS = {"north": (0, 1), "east": (1, 0), "south": (0, -1), "west": (-1, 0)}


def move(maze, cell, action):
    """Return the cell behind an open way, or `None`."""
    if not maze.is_open(cell, action):
        return None
    return tuple(at + step for at, step in zip(cell, STEPS[action]))


def test_a_robot_that_takes_its_advice_learns_the_maze():
    maze, cell, bumps = Maze.generate("braided", 6, 6, seed=3), (0, 0), BumpMap()
    while not bumps.is_tested:
        action = bumps.advice()
        beside = move(maze, cell, action)
        bumps.learn(action, beside is not None)
        cell = beside or cell
    assert (len(bumps.places), bumps.untried) == (36, 0)
    assert bumps.start in bumps.places
    # The map and the maze, side by side.
    pairs, waiting = {bumps.here: cell}, [bumps.here]
    while waiting:
        place = waiting.pop()
        for action in STEPS:
            beside = move(maze, pairs[place], action)
            assert bumps.way(place, action) == ("closed" if beside is None else "open")
            beyond = bumps.beyond(place, action)
            if beside is None:
                assert beyond is None
            elif beyond not in pairs:
                pairs[beyond] = beside
                waiting.append(beyond)
            else:
                assert pairs[beyond] == beside
    assert len(pairs) == 36
    assert str(bumps) == "<tolman.BumpMap: 36 places, 0 ways untried>"


def test_wrong_parameters_are_named():
    bumps = BumpMap()
    bumps.learn("north", False)
    with pytest.raises(ValueError, match="action is 'up'"):
        bumps.learn("up", True)
    with pytest.raises(ValueError, match="contradicts an earlier one"):
        bumps.learn("north", True)
    with pytest.raises(ValueError, match="place is 7"):
        bumps.way(7, "north")
    assert bumps.way(bumps.here, "north") == "closed"
    assert bumps.way(bumps.here, "east") == "untried"
