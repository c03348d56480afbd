"""The robot of MuJoCo as its ROS 2 driver shows it: /scan at 5 Hz, /odom at 25 Hz, /tf_static, /cmd_vel with a watchdog.

Its heading comes from a gyro that drifts by 1° a minute, as a TurtleBot3's does; it has no compass and no bumper.
"""

import math

from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic

import messages as ros
import robot as turtle

TICK = turtle.PHYSICS_STEP * turtle.CONTROL_STEPS  # s
ODOMETRY_EACH, SCAN_EACH = 2, 10  # ticks
WATCHDOG = 0.5  # without a command it stops, s
DRIFT = math.radians(1 / 60)  # of the gyro, rad/s


class Peer:
    """A participant of DDS with topics by the names of ROS."""

    def __init__(self, domain):
        self.participant = DomainParticipant(domain)

    def topic(self, name, kind):
        return Topic(self.participant, name, kind)

    def writer(self, name, kind, qos=ros.RELIABLE):
        return DataWriter(self.participant, self.topic("rt/" + name, kind), qos=qos)

    def reader(self, name, kind, qos=ros.RELIABLE):
        return DataReader(self.participant, self.topic("rt/" + name, kind), qos=qos)


class TurtleBot:
    def __init__(self, peer, robot, stamped=False):
        self.robot, self.stamped = robot, stamped
        self.scans = peer.writer("scan", ros.LaserScan, ros.SENSOR)
        self.odometry = peer.writer("odom", ros.Odometry)
        self.statics = peer.writer("tf_static", ros.TFMessage, ros.LATCHED)
        self.landmarks = peer.writer("landmark", ros.String)
        self.commands = peer.reader("cmd_vel", ros.TwistStamped if stamped else ros.Twist)
        laser = ros.Transform(ros.Vector3(turtle.LASER_X, 0.0, 0.17), ros.Quaternion())
        self.statics.write(
            ros.TFMessage([ros.TransformStamped(ros.Header(frame_id="base_footprint"), "base_scan", laser)])
        )
        self.drift = DRIFT * robot.random.choice([-1, 1])
        self.seconds, self.ticks = 0.0, 0
        self.wanted, self.heard = (0.0, 0.0), -math.inf
        self.landmark = None
        self.x = self.y = 0.0
        # The gyro begins at 0, and feels it when the robot is carried. The wheels do not.
        self.zero = -robot.pose()[2]
        self.heading = 0.0

    def tick(self, landmark):
        """Lets 20 ms pass."""
        for command in self.commands.take(10):
            twist = command.twist if self.stamped else command
            self.wanted, self.heard = (twist.linear.x, twist.angular.z), self.seconds
        if self.seconds - self.heard > WATCHDOG:
            self.wanted = (0.0, 0.0)
        self.robot.cruise(*self.wanted)
        self.seconds += TICK
        self.ticks += 1
        if landmark != self.landmark or self.ticks % SCAN_EACH == 0:
            self.landmark = landmark
            self.landmarks.write(ros.String((landmark or "").lower()))
        if self.ticks % ODOMETRY_EACH == 0:
            self.say_odometry()
        if self.ticks % SCAN_EACH == 0:
            self.robot.look()
            self.say_scan()

    def say_odometry(self):
        rolled = self.robot.sense()["odometry"]["distance"]
        before, self.heading = self.heading, self.robot.pose()[2] + self.zero + self.drift * self.seconds
        middle = before + math.remainder(self.heading - before, 2 * math.pi) / 2
        self.x += rolled * math.cos(middle)
        self.y += rolled * math.sin(middle)
        half = self.heading / 2
        pose = ros.Pose(ros.Point(self.x, self.y, 0.0), ros.Quaternion(0.0, 0.0, math.sin(half), math.cos(half)))
        still = ros.Twist(ros.Vector3(), ros.Vector3())
        none = [0.0] * 36
        self.odometry.write(
            ros.Odometry(
                ros.Header(ros.stamp(self.seconds), "odom"),
                "base_footprint",
                ros.PoseWithCovariance(pose, none),
                ros.TwistWithCovariance(still, none),
            )
        )

    def say_scan(self):
        between = 2 * math.pi / turtle.BEAMS
        header = ros.Header(ros.stamp(self.seconds), "base_scan")
        ranges = [float(reading) for reading in self.robot.ranges]
        last = 2 * math.pi - between
        self.scans.write(
            ros.LaserScan(header, 0.0, last, between, 0.0, 0.0, turtle.LEAST_RANGE, turtle.MAX_RANGE, ranges, [])
        )
