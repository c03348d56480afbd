"""Plays mazes with the robot of MuJoCo behind topics of ROS 2: the node `tolman-ros2` learns each, then goes home.

Robot and node talk over DDS alone. Only this file knows where the robot truly is; the judge is `tolman judge`. Prints a line
of JSON for each maze.
"""

import argparse
import json
import math
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
import uuid
from pathlib import Path

from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader

sys.path.append(str(Path(__file__).resolve().parent.parent / "mujoco"))

import messages as ros
import robot as turtle
from play import FAR, HEADINGS, Maze
from turtlebot import Peer, TurtleBot

PATIENCE = 60.0  # for an answer, s of the clock


class Service:
    """A service of ROS 2, as Fast DDS maps it."""

    def __init__(self, peer, name, request, response):
        self.requests = DataWriter(peer.participant, peer.topic(f"rq/{name}Request", request), qos=ros.RELIABLE)
        self.replies = DataReader(peer.participant, peer.topic(f"rr/{name}Reply", response), qos=ros.RELIABLE)

    def is_there(self):
        return self.requests.get_matched_subscriptions() and self.replies.get_matched_publications()


class Play:
    def __init__(self, call, maze_path, number):
        self.call, self.maze, self.path_of_maze = call, Maze(maze_path), maze_path
        self.seed = call.seed + number
        self.random = random.Random(self.seed)
        self.corridor = (call.corridor or [1.9, 1.5, 2.4, 3.0][number % 4]) * turtle.DIAMETER
        self.pitch = self.corridor + turtle.WALL
        self.robot = turtle.Robot(self.maze.walls, self.pitch, turtle.WALL, call.noise, self.seed)
        self.steps = self.maze.steps_to_goal()
        start = self.maze.start or self.random.choice(list(self.steps))
        self.place(start, self.maze.heading)
        # Domains keep the mazes apart.
        self.domain = number % 100
        peer = Peer(self.domain)
        self.bot = TurtleBot(peer, self.robot, call.stamped)
        self.states = peer.reader("tolman/state", ros.String)
        self.maps = peer.reader("map", ros.OccupancyGrid, ros.LATCHED)
        self.markers = peer.reader("tolman/places", ros.MarkerArray, ros.LATCHED)
        self.frames = peer.reader("tf", ros.TFMessage)
        trigger = (ros.TriggerRequest, ros.TriggerResponse)
        names = ["explore", "reach_goal", "put_down", "report", "save_map"]
        self.services = {name: Service(peer, f"tolman/{name}", *trigger) for name in names}
        action = "navigate_to_pose/_action/"
        self.send_goal = Service(peer, action + "send_goal", ros.SendGoalRequest, ros.SendGoalResponse)
        self.get_result = Service(peer, action + "get_result", ros.GetResultRequest, ros.GetResultResponse)
        self.feedback = peer.reader(action + "feedback", ros.FeedbackMessage)
        self.path, self.actions, self.ended = [], [], None
        self.grid = self.transform = None
        self.drawn = 0
        self.metres, self.last = 0.0, self.robot.pose()[:2]
        self.began = time.monotonic()

    def place(self, cell, heading=None):
        if heading is None:
            heading = HEADINGS[next(iter(self.maze.ways(cell)))]
        self.robot.place(*[(at + 0.5) * self.pitch for at in cell], heading)

    def cell(self):
        return tuple(math.floor(at / self.pitch) for at in self.robot.pose()[:2])

    def landmark(self):
        cell = self.cell()
        return "Goal" if cell in self.maze.goals else "Start" if cell == self.maze.start else None

    def tick(self):
        """Lets time pass in the world, and hears what the node says."""
        self.bot.tick(self.landmark())
        now = self.robot.pose()[:2]
        self.metres += math.dist(now, self.last)
        self.last = now
        for state in self.states.take(100):
            told = json.loads(state.data)
            if "motions" in told:
                self.path.append(now)
                continue
            place = (told["belief"] or {}).get("place")
            self.actions.append({"motions": len(self.path) - 1, "visits": told["visits"], "place": place})
            if told["standing"] != "under_way":
                self.ended = told
        for grid in self.maps.take(10):
            # A sample that ends a topic has no data.
            self.grid = grid if isinstance(grid, ros.OccupancyGrid) else self.grid
        self.drawn += len(self.markers.take(10))
        for message in self.frames.take(100):
            self.transform = message.transforms[0]
        ahead = self.began + self.bot.seconds / self.call.rate - time.monotonic()
        if ahead > 0:
            time.sleep(ahead)
        else:
            self.began -= ahead

    def until(self, ready, what):
        end = time.monotonic() + PATIENCE
        while not (answer := ready()):
            self.tick()
            if self.node.poll() is not None:
                raise RuntimeError(f"the node ended with exit code {self.node.returncode}")
            if time.monotonic() > end:
                raise RuntimeError(f"no {what} within {PATIENCE:.0f} s")
        return answer

    def ask(self, service, request, what):
        self.until(service.is_there, f"service {what}")
        service.requests.write(request)
        return self.until(lambda: service.replies.take(1), f"answer of {what}")[0]

    def trigger(self, name):
        answer = self.ask(self.services[name], ros.TriggerRequest(), name)
        if not answer.success:
            raise RuntimeError(f"{name}: {answer.message}")
        return answer.message

    def wait(self, metres):
        """Waits for the end of what the robot does. Returns None if its way was too long."""
        self.ended, self.metres = None, 0.0
        while self.ended is None:
            self.tick()
            if self.node.poll() is not None:
                raise RuntimeError(f"the node ended with exit code {self.node.returncode}")
            if self.metres > metres:
                return None
        return self.ended

    def navigate(self, cell):
        """Sends the robot to the middle of a cell, by its pose on the node's own map. Returns whether it got there."""
        at = self.on_map([(part + 0.5) * self.pitch for part in cell])
        goal = ros.UUID(list(uuid.UUID(int=self.random.getrandbits(128)).bytes))
        pose = ros.PoseStamped(ros.Header(frame_id="map"), ros.Pose(ros.Point(*at, 0.0)))
        sent = self.ask(self.send_goal, ros.SendGoalRequest(goal, ros.NavigateGoal(pose)), "send_goal")
        self.get_result.requests.write(ros.GetResultRequest(goal))
        end = self.bot.seconds + 600
        while sent.accepted and self.bot.seconds < end and self.node.poll() is None:
            self.tick()
            if results := self.get_result.replies.take(1):
                succeeded = results[0].status == 4
                return succeeded and math.dist(self.robot.pose()[:2], self.middle(cell)) < 0.6 * self.pitch
        return False

    def middle(self, cell):
        return [(at + 0.5) * self.pitch for at in cell]

    def on_map(self, point):
        """Returns a true point on the node's map, by where the node now believes the robot to be."""
        x, y, heading = self.robot.pose()
        shift = self.transform.transform.translation
        turn = yaw(self.transform.transform.rotation)
        bot = self.bot
        here = [
            shift.x + bot.x * math.cos(turn) - bot.y * math.sin(turn),
            shift.y + bot.x * math.sin(turn) + bot.y * math.cos(turn),
        ]
        # The node's axes are the walls': whole quarter turns from the maze's.
        quarter = math.pi / 2
        turned = round((bot.heading + turn - heading) / quarter) * quarter
        ahead = [point[0] - x, point[1] - y]
        return [
            here[0] + ahead[0] * math.cos(turned) - ahead[1] * math.sin(turned),
            here[1] + ahead[0] * math.sin(turned) + ahead[1] * math.cos(turned),
        ]

    def parameters(self, folder):
        return f"""tolman:
  ros__parameters:
    system: {self.call.system}
    seed: {self.seed}
    diameter: {turtle.DIAMETER}
    corridor_width: {self.corridor}
    max_vel_x: 0.2
    enable_stamped_cmd_vel: {str(self.call.stamped).lower()}
    source_timeout: 5.0
    latency: {0.1 * max(1.0, self.call.rate / 2)}
    map_file_name: {folder}/map
"""

    def run(self):
        with tempfile.TemporaryDirectory() as folder:
            file, record = Path(folder) / "tolman.yaml", Path(folder) / "run.json"
            file.write_text(self.parameters(folder))
            words = [self.call.node, "--ros-args", "--params-file", file]
            environment = dict(os.environ, ROS_DOMAIN_ID=str(self.domain))
            self.node = subprocess.Popen(words, env=environment)
            try:
                return self.play(record, Path(folder))
            finally:
                self.node.send_signal(signal.SIGINT)
                self.node.wait(20)

    def play(self, record, folder):
        self.trigger("explore")
        ended = self.wait(FAR * len(self.steps) * self.pitch)
        report = json.loads(self.trigger("report"))
        run = {"pitch": self.pitch, "path": self.path, "actions": self.actions}
        record.write_text(json.dumps(run | {"map": report["map"], "visits": report["visits"]}))
        if self.call.keep:
            Path(self.call.keep).write_text(record.read_text())
        words = [self.call.tolman, "judge", record, "--system", self.call.system, "--maze", self.path_of_maze, "--json"]
        judged = json.loads(subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout)
        motions, seconds = len(self.path), self.bot.seconds
        self.trigger("save_map")
        saved = (folder / "map.yaml").exists() and (folder / "map.pgm").exists()
        start = self.random.choice([cell for cell in self.steps if cell not in self.maze.goals])
        self.place(start)
        self.trigger("put_down")
        self.trigger("reach_goal")
        home = self.wait((FAR * self.steps[start] + len(self.steps)) * self.pitch)
        is_home = bool(home) and home["standing"] == "done" and self.cell() in self.maze.goals
        navigated = self.navigate(self.random.choice([cell for cell in self.steps if self.steps[cell] > 1])) if is_home else None
        is_done = bool(ended) and ended["standing"] == "done"
        share = 0.0 if self.grid is None else sum(cell >= 0 for cell in self.grid.data) / len(self.grid.data)
        return {
            "right": judged["right"],
            "claimed": report["verdict"]["map"] == "right" if ended else False,
            "done": is_done,
            "home": is_home,
            "navigated": navigated,
            "seconds": round(seconds, 1),
            "motions": motions,
            "corridor": round(self.corridor / turtle.DIAMETER, 2),
            "ended": ended["why"] or ended["standing"] if ended else "too long a way",
            "complaint": judged["complaint"],
            "doubt": report["verdict"]["doubt"],
            "saved": saved,
            "known_share_of_map": round(share, 2),
            "markers": self.drawn > 0,
            "feedback": len(self.feedback.take(1000)),
        }


def yaw(turn):
    return 2 * math.atan2(turn.z, turn.w)


def main():
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("node", help="the program tolman-ros2")
    words.add_argument("--tolman", required=True)
    words.add_argument("--system", default="mslst-better")
    words.add_argument("--noise", default="real", choices=turtle.NOISE)
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--rate", type=float, default=4.0, help="seconds of the world in a second")
    words.add_argument("--corridor", type=float, help="width, robots")
    words.add_argument("--keep", help="file for the last run's record")
    words.add_argument("--stamped", action="store_true", help="velocities are TwistStamped")
    words.add_argument("mazes", nargs="+")
    call = words.parse_args()
    for number, path in enumerate(call.mazes):
        play = Play(call, path, number)
        try:
            run = play.run()
        except RuntimeError as error:
            run = {"right": False, "claimed": False, "done": False, "home": False, "ended": str(error)}
        told = {"system": call.system, "noise": call.noise, "maze": Path(path).stem, "seed": play.seed}
        print(json.dumps(told | run), flush=True)


if __name__ == "__main__":
    main()
