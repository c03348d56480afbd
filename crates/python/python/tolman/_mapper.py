"""A mapper for the arena: a class of four methods."""

from __future__ import annotations

import contextlib
import json
import sys
from collections.abc import Iterable
from typing import IO, Any, TypedDict, Union, cast

import numpy as np


class Hello(TypedDict):
    """What a mapper is told of its robot, once.

    `radius` of the robot and `corridor_width`, from wall to wall, are in metres. A time step takes `step_us`
    microseconds, and there are at most `step_limit` of them, or None. `protocol` is 1.
    """

    protocol: int
    robot: str
    radius: float
    step_us: int
    step_limit: int | None
    corridor_width: float


class Step(TypedDict):
    """What a mapper is told after a time step.

    `step` counts from 0. `sensing` has what the robot's sensors gave: "compass", rad; "odometry", "distance" in metres
    and "turn" in rad since the step before; "scan", with "ranges" in metres, counter-clockwise from ahead, and "ring",
    the "spacing" of its beams in rad and its "max_range". `landmark` is "Start", "Goal", {"Numbered": 7} or None.
    `task` is "explore", "localize" or "reach-goal". `put_down` says that the robot was carried elsewhere: this sensing is
    from before.
    """

    step: int
    sensing: dict[str, Any]
    landmark: Any
    task: str
    put_down: bool


class Guess(TypedDict, total=False):
    """Where the robot may be: `place`, an id, or `point`, x and y, m. `weight` is from 0 to 1."""

    place: int
    point: tuple[float, float]
    weight: float


class _Numbered(TypedDict):
    id: int


class Place(_Numbered, total=False):
    """A place of a map: its `position`, m, from where the robot started, and its `landmark`."""

    position: tuple[float, float]
    landmark: Any


class PlaceMap(TypedDict):
    """A map: `places`, and `links`, the pairs of their ids that a way joins, one for each direction."""

    places: list[Place]
    links: list[tuple[int, int]]


Belief = Union[tuple[float, float], int, list[Guess], None]


class Mapper:
    """A mapper for the arena. Write its four methods, and let its file end with `Mine.run()`.

    `tolman arena --mapper 'python3 mine.py'` sends it into worlds of every kind, and
    `tolman.arena(Mine)` returns the rows. Each world has a process of its own, and a mapper that
    is made without arguments. What it prints goes to stderr.
    """

    def begin(self, hello: Hello) -> None:
        """Begin a world. Called once, before the first step; by default it does nothing.

        Parameters
        ----------
        hello : Hello
            The robot and its corridors.

        Raises
        ------
        Exception
            Whatever a method raises ends the mapper in this world, whose row says so in `why`.
        """

    def step(self, told: Step) -> Belief:
        """Take what the robot senses after a time step, and return where it is believed to be.

        Parameters
        ----------
        told : Step
            What the robot senses.

        Returns
        -------
        (float, float) or int or list of Guess or None
            A point, x east and y north in metres from where the robot started; or the id of a place of the map; or
            guesses; or None, if it is not known.

        Raises
        ------
        NotImplementedError
            If a mapper has no such method.
        """
        raise NotImplementedError(f"{type(self).__name__} has no method step(self, told)")

    def map(self) -> PlaceMap:
        """Return the map. It counts when the robot has learned; a replay asks for it before, too."""
        raise NotImplementedError(f"{type(self).__name__} has no method map(self)")

    def certainty(self) -> float | None:
        """Return the probability that the map is right. By default None, which claims the map."""
        return None

    @classmethod
    def run(cls, lines: Iterable[str] | None = None, out: IO[str] | None = None) -> None:
        """Answer the arena's lines until they end.

        Parameters
        ----------
        lines : iterable of str or None
            Lines of JSON; None reads stdin.
        out : text file or None
            Where the answers go; None writes to stdout.

        Raises
        ------
        ValueError, TypeError
            If a line is not JSON, or an answer cannot be written as JSON.
        """
        out = sys.stdout if out is None else out
        mapper = cls()
        with contextlib.redirect_stdout(sys.stderr):
            for line in sys.stdin if lines is None else lines:
                told = json.loads(line)
                if "hello" in told:
                    mapper.begin(told["hello"])
                else:
                    print(_written(_answer(mapper, told)), file=out, flush=True)


def _answer(mapper: Mapper, told: Any) -> dict[str, Any]:
    """Return what a line asks for, and no more."""
    asked = told.pop("ask")
    answer: dict[str, Any] = {}
    if "belief" in asked:
        answer["belief"] = _guesses(mapper.step(told))
    if "map" in asked:
        answer["map"] = mapper.map()
    if "verdict" in asked:
        answer["verdict"] = {"certainty": mapper.certainty()}
    return {"answer": answer}


def _guesses(belief: Belief) -> list[Guess]:
    """Return a belief as the arena reads it. A point may be an array of numpy."""
    if belief is None:
        return []
    if isinstance(belief, list):
        return belief
    if np.ndim(belief) == 0:
        return [{"place": cast(int, belief)}]
    return [{"point": cast("tuple[float, float]", belief)}]


def _written(answer: dict[str, Any]) -> str:
    """Return a line of JSON. Numbers and arrays of numpy are written as Python's own."""

    def plain(value: Any) -> Any:
        if hasattr(value, "tolist"):
            return value.tolist()
        raise TypeError(f"the mapper answers with {value!r}, a {type(value).__name__}, which JSON has not")

    return json.dumps(answer, default=plain, allow_nan=False)
