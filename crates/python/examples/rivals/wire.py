"""The arena's lines of JSON, for a mapper or a brain. docs/brain.md has them all."""

import json
import math
import sys
from typing import NamedTuple, Optional

import numpy as np


class Hello(NamedTuple):
    """The robot's measures, m."""

    corridor_width: float
    radius: float


class Motion(NamedTuple):
    """What odometry counted since the step before: a turn, rad, and then a way, m."""

    turn: float
    distance: float


class Scan(NamedTuple):
    """Bearings from ahead, rad counter-clockwise, ranges, m, and which of them met something."""

    bearings: np.ndarray
    ranges: np.ndarray
    met: np.ndarray


def hello():
    """Read the first line."""
    said = json.loads(sys.stdin.readline())["hello"]
    return Hello(said["corridor_width"], said["radius"])


def told():
    """Yield what the arena tells, line by line."""
    yield from map(json.loads, sys.stdin)


def answer(answers, **command):
    """Answer a line, with the command of a brain."""
    print(json.dumps({"answer": answers, **command}), flush=True)


def watch(mapper):
    """Answer each line for a mapper that watches, with its map and its belief."""
    for line in told():
        answers = {}
        if "map" in line["ask"]:
            answers["map"] = mapper.map()
        if "belief" in line["ask"]:
            answers["belief"] = mapper.explore(line) if line["task"] == "explore" else mapper.localize(line)
        answer(answers)


def drive(brain):
    """Answer each line for a brain that drives, with its map, its belief and its command."""
    for line in told():
        answers, command = {}, {}
        if "map" in line["ask"]:
            answers["map"] = brain.map()
        if "sensing" in line:
            belief, command = brain.act(line)
            if "belief" in line["ask"]:
                answers["belief"] = belief
        answer(answers, **command)


def motion(sensing) -> Optional[Motion]:
    """Return the motion, or `None` where its reading is missing."""
    rolled = sensing["odometry"]
    return rolled and Motion(rolled["turn"], rolled["distance"])


def scan(sensing) -> Optional[Scan]:
    """Return the scan, or `None` where its reading is missing."""
    seen = sensing["scan"]
    if not seen:
        return None
    ranges, ring = np.array(seen["ranges"]), seen["ring"]
    bearings = ring["first_bearing"] + ring["spacing"] * np.arange(len(ranges))
    return Scan(bearings, ranges, (ranges > 0) & (ranges < ring["max_range"] - 1e-9))


def wrapped(angle):
    """Return an angle, or an array of them, from -π to π."""
    return (angle + math.pi) % (2 * math.pi) - math.pi
