"""A robot like a TurtleBot3 Burger in a maze of real walls, in MuJoCo.

It has two driven wheels, a caster and a laser behind the axle. It slips, scrubs and pushes as the physics has it. Metres,
radians, seconds. Only the driver's part of this file is known to a brain: motions, encoders, ranges, compass, bumper.
"""

import math

import mujoco
import numpy as np

DIAMETER = 0.247  # of the circle in which it turns, m
WHEEL_RADIUS, TRACK = 0.033, 0.160
LASER_X, LASER_Z = -0.032, 0.172
BEAMS, LEAST_RANGE, MAX_RANGE = 360, 0.12, 3.5
TICK = 2 * math.pi / 4096  # of an encoder, rad
SPEED, ACCELERATION = 0.22, 1.0  # of a wheel's rim, m/s and m/s²
PHYSICS_STEP, CONTROL_STEPS = 0.004, 5
WALL = 0.012  # thickness, m

# What is wrong with floor, wheels and sensors. Angles in degrees.
REAL = dict(range_sd=0.010, lost=0.005, compass_sd=1.5, iron=3.0, odometry=0.01, turns=0.03)
NOISE = {
    "none": {},
    "real": REAL,
    "late": REAL | dict(scan_age=0.7),  # a driver that does not wait for a scan at rest
    "hard": dict(
        range_sd=0.015, range_share=0.01, lost=0.03, compass_sd=1.5, iron=5.0, compass_bias=3.0,
        odometry=0.02, turns=0.03, left_wheel=1.01, friction=0.5, scan_age=0.1,
    ),
}  # fmt: skip
EXACT = dict(
    range_sd=0.0, range_share=0.0, lost=0.0, compass_sd=0.0, iron=0.0, compass_bias=0.0,
    odometry=0.0, turns=0.0, left_wheel=1.0, friction=0.9, scan_age=0.0,
)  # fmt: skip


def model(walls, pitch, thickness, noise):
    """Returns the XML of the robot in a maze. `walls` are pairs of corners, in cells."""
    corners = {corner for wall in walls for corner in wall}
    boxes = [(x * pitch, y * pitch, thickness / 2, thickness / 2) for x, y in corners]
    for (x, y), (to_x, to_y) in walls:
        length = (pitch - thickness) / 2
        half = (length, thickness / 2) if to_x != x else (thickness / 2, length)
        boxes.append(((x + to_x) / 2 * pitch, (y + to_y) / 2 * pitch, *half))
    wall = '<geom type="box" pos="{:.5f} {:.5f} 0.15" size="{:.5f} {:.5f} 0.15" friction="0.5"/>'

    def wheel(name, y, scale):
        return f"""<body name="{name}" pos="0 {y} 0.023">
          <joint name="{name}" type="hinge" axis="0 1 0" damping="0.001" armature="0.0005"/>
          <inertial pos="0 0 0" mass="0.03" diaginertia="1.1e-5 2.1e-5 1.1e-5"/>
          <geom type="cylinder" group="1" size="{WHEEL_RADIUS * scale} 0.009" zaxis="0 1 0"/></body>"""

    return f"""<mujoco><compiler angle="radian" inertiafromgeom="false"/>
      <option timestep="{PHYSICS_STEP}" integrator="implicitfast" cone="elliptic" impratio="3"/>
      <worldbody>
        <geom type="plane" group="2" size="50 50 0.1" friction="{noise["friction"]} 0.005 0.0001"/>
        {"".join(wall.format(*box) for box in boxes)}
        <body name="base" pos="0 0 0.0105"><freejoint/>
          <inertial pos="-0.012 0 0.03" mass="0.94" diaginertia="0.0024 0.0024 0.0022"/>
          <geom type="box" group="1" pos="-0.032 0 0.07" size="0.07 0.07 0.07" friction="0.3"/>
          <geom type="sphere" group="1" pos="-0.081 0 -0.0025" size="0.0075" condim="1"/>
          {wheel("left", TRACK / 2, noise["left_wheel"])}
          {wheel("right", -TRACK / 2, 1.0)}
        </body>
      </worldbody>
      <actuator>
        <velocity joint="left" kv="0.12" forcerange="-0.6 0.6"/>
        <velocity joint="right" kv="0.12" forcerange="-0.6 0.6"/>
      </actuator></mujoco>"""


class Robot:
    def __init__(self, walls, pitch, thickness, noise, seed):
        self.noise = EXACT | NOISE[noise]
        self.random = np.random.default_rng(seed)
        xml = model(walls, pitch, thickness, self.noise)
        self.model = mujoco.MjModel.from_xml_string(xml)
        self.data = mujoco.MjData(self.model)
        joints = [self.model.joint(name) for name in ("left", "right")]
        self.angles = [joint.qposadr[0] for joint in joints]
        self.is_wall = self.model.geom_group == 0
        angle = np.arange(BEAMS) * 2 * math.pi / BEAMS
        self.beams = np.stack([np.cos(angle), np.sin(angle), np.zeros(BEAMS)], 1)
        # A run's own calibration: as much too large as too small.
        sign = lambda: self.random.choice([-1, 1])
        self.odometry_scale = 1 + self.noise["odometry"] * sign()
        self.turn_scale = 1 + self.noise["turns"] * sign()
        self.compass_bias = self.noise["compass_bias"] * sign()
        self.iron_at = self.random.uniform(0, 2 * math.pi)
        self.seconds, self.touches = 0.0, 0

    def place(self, x, y, heading):
        """Puts the robot down."""
        mujoco.mj_resetData(self.model, self.data)
        half = heading / 2
        self.data.qpos[:7] = [x, y, 0.0105, math.cos(half), 0, 0, math.sin(half)]
        mujoco.mj_step(self.model, self.data, 50)
        self.before = self.ticks()
        self.touched = False
        self.rims = np.zeros(2)  # speeds that the driver asks for, m/s
        self.look()

    def pose(self):
        """Returns the true x, y and heading, which no brain sees."""
        x, y, _, w, i, j, k = self.data.qpos[:7]
        return x, y, math.atan2(2 * (w * k + i * j), 1 - 2 * (j * j + k * k))

    def ticks(self):
        return [round(self.data.qpos[angle] / TICK) for angle in self.angles]

    def go(self, distance, turn):
        """Rolls `distance` while it turns by `turn`: both wheels reach their ends together."""
        ways = np.array([distance - turn * TRACK / 2, distance + turn * TRACK / 2]) / WHEEL_RADIUS
        start = self.data.qpos[self.angles]
        far = np.abs(ways).max() * WHEEL_RADIUS
        if far > 1e-6:
            speed = min(SPEED, math.sqrt(far * ACCELERATION))
            rise = speed / ACCELERATION
            whole = far / speed + rise
            control = PHYSICS_STEP * CONTROL_STEPS
            look_at = whole - self.noise["scan_age"]
            for tick in range(1, math.ceil(whole / control) + 1):
                time = min(tick * control, whole)
                end = whole - time
                if time < rise:
                    gone, now = ACCELERATION * time**2 / 2, ACCELERATION * time
                elif end > rise:
                    gone, now = speed * (time - rise / 2), speed
                else:
                    gone, now = far - ACCELERATION * end**2 / 2, ACCELERATION * end
                behind = start + ways * gone / far - self.data.qpos[self.angles]
                self.data.ctrl[:] = ways * now / far + 10 * behind
                self.advance()
                if self.noise["scan_age"] > 0 and time >= look_at:
                    self.look()
                    look_at = math.inf
        for _ in range(15):
            behind = start + ways - self.data.qpos[self.angles]
            self.data.ctrl[:] = 10 * behind if far > 1e-6 else 0
            self.advance()
            if np.abs(behind).max() < 0.01:
                break
        self.data.ctrl[:] = 0
        if self.noise["scan_age"] == 0 or far <= 1e-6:
            self.look()

    def cruise(self, linear, angular):
        """Drives towards these velocities for one step of the wheels' control."""
        wanted = np.array([linear - angular * TRACK / 2, linear + angular * TRACK / 2])
        most = ACCELERATION * PHYSICS_STEP * CONTROL_STEPS
        self.rims += np.clip(wanted - self.rims, -most, most)
        self.data.ctrl[:] = self.rims / WHEEL_RADIUS
        self.advance()

    def advance(self):
        mujoco.mj_step(self.model, self.data, CONTROL_STEPS)
        self.seconds += PHYSICS_STEP * CONTROL_STEPS
        pairs = self.data.contact.geom
        self.touched |= bool(len(pairs)) and bool(self.is_wall[pairs].any())

    def look(self):
        """Takes a scan. A beam that meets nothing, or is lost, reads 0."""
        turned = self.data.body("base").xmat.reshape(3, 3)
        eye = self.data.body("base").xpos + turned @ np.array([LASER_X, 0, LASER_Z])
        met, ranges = np.full(BEAMS, -1, np.int32), np.full(BEAMS, -1.0)
        group = np.array([1, 0, 0, 0, 0, 0], np.uint8)
        beams = (self.beams @ turned.T).reshape(-1)
        mujoco.mj_multiRay(
            self.model, self.data, eye, beams, group, True, -1, met, ranges, None, BEAMS, MAX_RANGE
        )
        spread = self.noise["range_sd"] + self.noise["range_share"] * ranges
        ranges = ranges + self.random.normal(size=BEAMS) * spread
        lost = self.random.random(BEAMS) < self.noise["lost"]
        ranges[(met < 0) | lost | (ranges < LEAST_RANGE) | (ranges > MAX_RANGE)] = 0
        self.ranges = ranges

    def sense(self):
        """Returns the readings since the last call, as a brain gets them."""
        now = self.ticks()
        left, right = [(a - b) * TICK * WHEEL_RADIUS for a, b in zip(now, self.before)]
        self.before = now
        _, _, heading = self.pose()
        off = self.compass_bias + self.noise["iron"] * math.sin(heading + self.iron_at)
        off += self.random.normal() * self.noise["compass_sd"]
        compass = math.remainder(heading + math.radians(off), 2 * math.pi)
        touched, self.touched = self.touched, False
        self.touches += touched
        return {
            "time_us": round(self.seconds * 1e6),
            "ranges": [round(float(reading), 4) for reading in self.ranges],
            "compass": compass,
            "odometry": {
                "distance": (left + right) / 2 * self.odometry_scale,
                "turn": (right - left) / TRACK * self.turn_scale,
            },
            "bump": touched,
        }
