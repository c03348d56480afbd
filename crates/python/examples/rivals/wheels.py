"""Commands for motions."""

import math

import wire

# How far off its heading a robot may drive, rad.
STRAIGHT = 0.3


class Wheels:
    """Commands for motions. What a full command does shows in odometry."""

    def __init__(self):
        self.full, self.asked = [1.0, 0.5], [0.0, 0.0]

    def learn(self, motion, bump):
        """Compare a motion with what was asked."""
        for at, made in enumerate(motion or ()):
            if abs(self.asked[at]) > 0.2 and abs(made) > 1e-3 and not bump:
                self.full[at] = abs(made / self.asked[at])

    def command(self, turn, distance):
        """Return the command of a motion, or of as much of it as one step makes."""
        parts = zip((turn, distance), self.full)
        self.asked = [max(-1.0, min(1.0, part / full)) for part, full in parts]
        return dict(zip(("turn", "translate"), self.asked))

    def toward(self, dx, dy, heading):
        """Return the command to a point beside the robot, m. It turns first."""
        turn = wire.wrapped(math.atan2(dy, dx) - heading)
        if abs(turn) > STRAIGHT:
            return self.command(turn, 0.0)
        return self.command(turn, math.hypot(dx, dy))
