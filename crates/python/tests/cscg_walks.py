"""Walks from which both sides of the comparison with CSCG learn, and the worlds in which they were walked."""

import json
import os
import subprocess
from pathlib import Path
from typing import NamedTuple, Optional

import numpy as np
from tolman import Maze

ACTIONS = ["north", "east", "south", "west"]
STEPS = [(0, 1), (1, 0), (0, -1), (-1, 0)]
# Share of the passages of an office that are walled up, and the distance between its corridors, m.
WALLED_UP, PITCH = 0.25, 4
COMMAND = os.environ.get("TOLMAN", str(Path(__file__).parents[3] / "target" / "release" / "tolman"))


class Mazelike:
    """A maze whose cells are the places."""

    def __init__(self, maze):
        self.maze = maze
        self.size = maze.width * maze.height

    def look(self, cell):
        """Return the ways that are open, as bits."""
        return sum(self.maze.is_open(cell, action) << bit for bit, action in enumerate(ACTIONS))

    def beyond(self, cell, action):
        """Return the place to which an action leads: the same if it bumps."""
        if not self.look(cell) >> action & 1:
            return cell
        return cell[0] + STEPS[action][0], cell[1] + STEPS[action][1]


class Office(Mazelike):
    """A maze whose bends, junctions and ends are the places. Cells with a way straight on alone are passed."""

    def beyond(self, cell, action):
        beside = super().beyond(cell, action)
        corridor = 0b0101 << action % 2
        return self.beyond(beside, action) if beside != cell and self.look(beside) == corridor else beside


class Walk(NamedTuple):
    """What a robot did and observed, and where it truly was. Looks and cells are one more than actions."""

    world: Mazelike
    actions: list
    moved: list
    looks: list
    cells: list
    # Whether the looks are the open ways.
    sees: bool
    # Length of each move by odometry, in cells.
    lengths: Optional[list] = None
    # File of the robot with odometry.
    survey: Optional[Path] = None


def in_a_maze(side, moves, sees, seed):
    """Walk at random through a braided maze. The robot observes the open ways, or only whether it bumped."""
    world = Mazelike(Maze.generate("braided", side, side, seed=seed))
    actions = np.random.default_rng(seed).integers(4, size=moves).tolist()
    cells = [(0, 0)]
    for action in actions:
        cells.append(world.beyond(cells[-1], action))
    moved = [before != after for before, after in zip(cells, cells[1:])]
    looks = [world.look(cell) for cell in cells] if sees else [0] + [int(not went) for went in moved]
    return Walk(world, actions, moved, looks, cells, sees)


def in_an_office(side, moves, seed, folder):
    """Let the robot of the diktiometry walk at random through an office whose places all look alike."""
    maze, survey = folder / f"{seed}.maze", folder / f"{seed}.json"
    maze.write_text(blocks(side, seed))
    learn = [COMMAND, "learn", "--system", "diktiometry", "--maze", maze, "--out", survey, "--seed", str(seed)]
    # Exits with 1 if the walk has not reached all places, which it need not.
    subprocess.run([*learn, "--set", f"moves={moves}", "--set", "heed=0"], capture_output=True)
    file = json.loads(survey.read_text())
    journal = file["map"]["journal"]
    steps = journal["moves"]
    actions = [step["action"] for step in steps]
    looks = [sum(1 << way for way in seen["exits"]["Seen"]) for seen in [journal["start"], *steps]]
    boxes = [step["odometry"]["position"]["yx"[step["action"] % 2]] for step in steps]
    lengths = [round(abs(sum(box)) / 2 / PITCH) for box in boxes]
    cells = [(site % side, site // side) for site, _ in file["visits"]]
    return Walk(Office(Maze(maze)), actions, [True] * moves, looks, cells, True, lengths, survey)


def blocks(side, seed):
    """Draw corridors between square blocks. Passages are walled up except for those that would cut a cell off."""
    random = np.random.default_rng(seed)
    walls = set()
    for cell in np.ndindex(side, side):
        for action in (0, 1):
            beside = cell[0] + STEPS[action][0], cell[1] + STEPS[action][1]
            if max(beside) < side and random.random() < WALLED_UP:
                walls.add((cell, action))
                if Maze(drawn(side, walls)).shortest_path(cell, beside) is None:
                    walls.remove((cell, action))
    return drawn(side, walls)


def drawn(side, walls):
    """Return a maze file. It needs a goal, which means nothing here."""
    lines = ["o" + "---o" * side]
    for y in range(side):
        cells = [f" {'G' if x == y == 0 else ' '} " + ("|" if ((x, y), 1) in walls else " ") for x in range(side)]
        lines.append("|" + "".join(cells)[:-1] + "|")
        lines.append("o" + "".join("---o" if ((x, y), 0) in walls or y == side - 1 else "   o" for x in range(side)))
    return "\n".join(reversed(lines)) + "\n"
