"""A micromouse that visits every cell."""

import pytest
from tolman import Maze, Mouse

STEPS = {"north": (0, 1), "east": (1, 0), "south": (0, -1), "west": (-1, 0)}
NAMES = list(STEPS)


def sight(maze, cell, turn):
    count = 0
    while maze.is_open(cell, NAMES[turn % 4]):
        east, north = STEPS[NAMES[turn % 4]]
        cell, count = (cell[0] + east, cell[1] + north), count + 1
    return count


@pytest.mark.parametrize("family", ["perfect", "braided", "pillars"])
def test_it_visits_every_cell(family):
    maze = Maze.generate(family, 7, 6, seed=3)
    at, turn = maze.start, 0
    mouse, visited, orders = Mouse(7, 6, at), {maze.start}, 0
    while (order := mouse.next(*(sight(maze, at, turn + side) for side in (3, 0, 1)))) is not None:
        degrees, cells = order
        assert degrees in (-90, 0, 90) and -3 <= cells <= 3
        turn += degrees // 90
        east, north = STEPS[NAMES[(turn + (2 if cells < 0 else 0)) % 4]]
        for _ in range(abs(cells)):
            at = (at[0] + east, at[1] + north)
            visited.add(at)
        orders += 1
        assert orders < 400
    # Some cells of a drawing may be walled in.
    assert visited == {(x, y) for x in range(7) for y in range(6) if maze.shortest_path(maze.start, (x, y))}
    assert mouse.next(0, 0, 0) is None


@pytest.mark.parametrize(
    ("ask", "said"),
    [
        (lambda: Mouse(33, 5), "width is 33 but has to be from 1 to 32"),
        (lambda: Mouse(5, 0), "height is 0"),
        (lambda: Mouse(5, 5, (5, 0)), r"start is \(5, 0\), which lies outside of 5 x 5"),
        (lambda: Mouse(5, 5, heading="up"), "heading is 'up'"),
        (lambda: Mouse(5, 5).next(0, 9, 0), "left, ahead, right: the mouse has lost its way"),
    ],
)
def test_wrong_input_is_named(ask, said):
    with pytest.raises(ValueError, match=said):
        ask()
