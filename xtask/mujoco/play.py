"""Plays mazes with the robot of MuJoCo: a brain learns each, then goes to the goal from elsewhere.

The brain is `tolman brain`, another process, and the judge is `tolman judge`. Only this file knows where the robot truly is.
Prints a line of JSON for each maze.
"""

import argparse
import json
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

import robot as turtle

HEADINGS = {"east": 0.0, "north": math.pi / 2, "west": math.pi, "south": -math.pi / 2}
MOTIONS = 60_000  # most in one task
FAR = 10  # most, in lengths of all corridors; on the way home in shortest ways, and all corridors once


class Maze:
    """A drawing of cells, as in `mazes/`: o---o, |, S and G."""

    def __init__(self, path):
        lines = Path(path).read_text().splitlines()
        settings = dict(line.split(" = ", 1) for line in lines if " = " in line and line[0] != "#")
        rows = [line.ljust(400) for line in lines if line.lstrip().startswith(("o", "|")) or line.startswith(" ")]
        rows.reverse()  # from the south
        width = max(len(row.rstrip()) for row in rows) // 4
        height = len(rows) // 2
        self.cells = [(x, y) for x in range(width) for y in range(height)]
        self.walls = []
        for y in range(height + 1):
            self.walls += [((x, y), (x + 1, y)) for x in range(width) if rows[2 * y][4 * x + 2] == "-"]
        for y in range(height):
            line = rows[2 * y + 1]
            self.walls += [((x, y), (x, y + 1)) for x in range(width + 1) if line[4 * x] == "|"]
        marks = {cell: rows[2 * cell[1] + 1][4 * cell[0] + 2] for cell in self.cells}
        self.goals = [cell for cell, mark in marks.items() if mark == "G"]
        starts = [cell for cell, mark in marks.items() if mark == "S"]
        self.start, self.heading = starts[0] if starts else None, None
        if "start" in settings:
            x, y, towards = settings["start"].split()
            self.start, self.heading = (int(x), int(y)), HEADINGS[towards]
        if "goal" in settings or "goals" in settings:
            words = (settings.get("goal") or settings["goals"]).replace(",", " ").split()
            self.goals = list(zip(map(int, words[::2]), map(int, words[1::2])))
        assert self.goals, f"{path} has no goal"

    def ways(self, cell):
        x, y = cell
        sides = {
            "east": ((x + 1, y), ((x + 1, y), (x + 1, y + 1))),
            "north": ((x, y + 1), ((x, y + 1), (x + 1, y + 1))),
            "west": ((x - 1, y), ((x, y), (x, y + 1))),
            "south": ((x, y - 1), ((x, y), (x + 1, y))),
        }
        return {side: to for side, (to, wall) in sides.items() if wall not in self.walls}

    def steps_to_goal(self):
        steps, edge = dict.fromkeys(self.goals, 0), list(self.goals)
        for cell in edge:
            for to in self.ways(cell).values():
                if to not in steps:
                    steps[to] = steps[cell] + 1
                    edge.append(to)
        return steps


class Play:
    def __init__(self, maze, system, noise, seed, corridor, spacing):
        self.maze, self.system = maze, system
        self.corridor, self.pitch = corridor, spacing
        self.random = random.Random(seed)
        self.robot = turtle.Robot(maze.walls, spacing, spacing - corridor, noise, seed)

    def middle(self, cell):
        return [(at + 0.5) * self.pitch for at in cell]

    def cell(self):
        return tuple(math.floor(at / self.pitch) for at in self.robot.pose()[:2])

    def put(self, cell, heading=None):
        if heading is None:
            heading = HEADINGS[next(iter(self.maze.ways(cell)))]
        self.robot.place(*self.middle(cell), heading)
        self.path, self.metres = [], 0.0

    def landmark(self):
        cell = self.cell()
        return "Goal" if cell in self.maze.goals else "Start" if cell == self.maze.start else None

    def measures(self):
        return f"""diameter = {turtle.DIAMETER}
corridor_width = {self.corridor}
corridor_spacing = {self.pitch}
compass_error = 0.07
odometry_error = 0.05
[laser]
beams = {turtle.BEAMS}
least_range = {turtle.LEAST_RANGE}
max_range = {turtle.MAX_RANGE}
x = {turtle.LASER_X}
"""

    def say(self, message):
        self.brain.stdin.write(json.dumps(message) + "\n")
        self.brain.stdin.flush()

    def pursue(self, task, metres, put_down=False):
        """Lets the brain carry out a task. Returns its last word, or None if the way was too long."""
        self.say({"task": task, "put_down": put_down})
        self.actions, wanted, too_long = [], ["standing", "belief"], False
        for line in self.brain.stdout:
            said = json.loads(line)
            if "go" in said:
                self.robot.go(said["go"]["distance"], said["go"]["turn"])
                self.path.append(self.robot.pose()[:2])
                self.metres += abs(said["go"]["distance"])  # also if its wheels spin
                too_long = self.metres > metres or len(self.path) > MOTIONS
                sensing = self.robot.sense()
                answer = {"sensing": sensing, "landmark": self.landmark(), "ask": wanted}
                self.say(answer | {"break_off": too_long})
            elif "answer" in said:
                believed = (said["answer"]["belief"] or [{}])[0].get("place")
                visits = said["answer"]["standing"]["visits"]
                self.actions.append({"motions": len(self.path) - 1, "visits": visits, "place": believed})
            elif "ended" in said:
                return None if too_long else said["ended"]
            elif "stop" in said:
                raise RuntimeError(said["stop"])
        raise RuntimeError("the brain has ended")

    def ask(self, *questions):
        self.say({"ask": questions})
        return json.loads(self.brain.stdout.readline())["answer"]

    def run(self, tolman, maze_path, seed, keep=None):
        steps = self.maze.steps_to_goal()
        with tempfile.TemporaryDirectory() as folder:
            measures, record = Path(folder) / "robot.toml", Path(keep or Path(folder) / "run.json")
            measures.write_text(self.measures())
            call = [tolman, "brain", "--system", self.system, "--robot", measures, "--seed", str(seed)]
            self.brain = subprocess.Popen(call, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
            with self.brain:
                self.brain.stdout.readline()
                self.put(self.maze.start or self.random.choice(list(steps)), self.maze.heading)
                ended = self.pursue("explore", FAR * len(steps) * self.pitch)
                learned = self.ask("map", "visits", "verdict")
                run = {"pitch": self.pitch, "path": self.path, "actions": self.actions}
                run |= {"map": learned["map"], "visits": learned["visits"]}
                record.write_text(json.dumps(run))
                motions = len(self.path)
                call = [tolman, "judge", record, "--system", self.system, "--maze", maze_path, "--json"]
                judged = json.loads(subprocess.run(call, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout)
                far = [cell for cell in steps if cell not in self.maze.goals]
                start = self.random.choice(far)
                self.put(start)
                home = self.pursue("reach-goal", (FAR * steps[start] + len(steps)) * self.pitch, put_down=True)
                self.brain.stdin.close()
        is_home = bool(home) and home["standing"] == "done" and self.cell() in self.maze.goals
        verdict = learned["verdict"]
        return {
            "system": self.system,
            "maze": Path(maze_path).stem,
            "right": judged["right"],
            "claimed": verdict["map"] == "right" if ended else False,
            "home": is_home,
            "seconds": round(self.robot.seconds, 1),
            "corridor": round(self.corridor / turtle.DIAMETER, 2),
            "motions": motions,
            "touches": self.robot.touches,
            "ended": ended["why"] or ended["standing"] if ended else "too long a way",
            "complaint": judged["complaint"],
            "doubt": verdict["doubt"],
        }


def main():
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("--tolman", required=True)
    words.add_argument("--system", default="mslst-better")
    words.add_argument("--noise", default="real", choices=turtle.NOISE)
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--corridor", type=float, help="width, robots")
    words.add_argument("--keep", help="file for the last run's record")
    words.add_argument("mazes", nargs="+")
    call = words.parse_args()
    for number, path in enumerate(call.mazes):
        seed = call.seed + number
        # The diktiometry is made for an office: corridors between rooms, far apart.
        is_office = call.system.startswith("diktiometry")
        robots = call.corridor or (2.4 if is_office else [1.9, 1.5, 2.4, 3.0][number % 4])
        corridor = robots * turtle.DIAMETER
        spacing = corridor + (5.6 * turtle.DIAMETER if is_office else turtle.WALL)
        play = Play(Maze(path), call.system, call.noise, seed, corridor, spacing)
        try:
            run = play.run(call.tolman, path, seed, call.keep)
        except RuntimeError as error:
            run = {"system": call.system, "maze": Path(path).stem, "right": False, "claimed": False, "home": False}
            run |= {"seconds": round(play.robot.seconds, 1), "ended": str(error)}
        print(json.dumps({"noise": call.noise, "seed": seed} | run), flush=True)


if __name__ == "__main__":
    main()
