"""A complete body for `tolman brain`: a disc with a laser in a ring of corridors.

`python3 examples/body.py tolman` starts the brain and shows what it says. Your robot's driver goes
in the place of `go` and `sense`.
"""

import json, math, subprocess, sys
from pathlib import Path

# The floor is 4 × 3 cells of 0.5 m; two of them are solid. The goal is a cell.
SIDE, COLUMNS, ROWS, SOLID, GOAL = 0.5, 4, 3, {(1, 1), (2, 1)}, (3, 2)
RADIUS, BEAMS, REACH = 0.125, 72, 1.0  # as in robot.toml
x, y, heading, time_us = 0.5 * SIDE, 0.5 * SIDE, 0.0, 0


def cell(x, y):
    return math.floor(x / SIDE), math.floor(y / SIDE)


def is_free(column, row):
    return 0 <= column < COLUMNS and 0 <= row < ROWS and (column, row) not in SOLID


def room(angle):
    """Returns how far it is to the next wall, m, to the nearest 5 mm."""
    dx, dy, most = 0.005 * math.cos(angle), 0.005 * math.sin(angle), int(REACH / 0.005)
    steps = (i for i in range(most) if not is_free(*cell(x + i * dx, y + i * dy)))
    return 0.005 * next(steps, most)


def go(distance, turn):
    """Turns by `turn`, rad, and rolls `distance`, m, or as far as the wall lets it."""
    global x, y, heading
    heading = math.remainder(heading + turn, 2 * math.pi)
    way = heading if distance > 0 else heading + math.pi
    free = min(room(way + side) for side in (-0.3, 0.0, 0.3)) - RADIUS
    distance = math.copysign(min(abs(distance), max(free, 0.0)), distance)
    x, y = x + distance * math.cos(heading), y + distance * math.sin(heading)
    return {"distance": distance, "turn": turn}


def sense(odometry):
    global time_us
    time_us += 100_000
    ranges = [room(heading + 2 * math.pi * beam / BEAMS) for beam in range(BEAMS)]
    return {"time_us": time_us, "ranges": ranges, "compass": heading, "odometry": odometry}


call = [sys.argv[1], "brain", "--system", "mslst-better", "--task", "explore", "--task", "reach-goal"]
call += ["--robot", Path(__file__).with_name("robot.toml")]
with subprocess.Popen(call, stdin=-1, stdout=-1, text=True, bufsize=1) as brain:  # two pipes
    for line in brain.stdout:
        said = json.loads(line)
        if "go" in said:
            answer = {"sensing": sense(go(**said["go"]))}
            answer["landmark"] = "Goal" if cell(x, y) == GOAL else None
            print(json.dumps(answer), file=brain.stdin)
        else:
            print(line, end="")
sys.exit(brain.returncode)  # The brain has ended: the robot stands still.
