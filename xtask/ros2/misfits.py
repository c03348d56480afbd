"""Topics of other types and of another quality of service: the node says them, and how to repair them.

Exits 1 if it does not.
"""

import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parent.parent / "mujoco"))

import messages as ros
from turtlebot import Peer

DOMAIN = 101
PARAMETERS = "tolman:\n  ros__parameters:\n    diameter: 0.25\n    corridor_width: 0.5\n"
SECONDS = 8
EXPECTED = [
    "waits for a scan on /scan",
    "/cmd_vel has messages of type geometry_msgs/msg/TwistStamped, and this node's are geometry_msgs/msg/Twist",
    "set enable_stamped_cmd_vel to true",
    "/odom has messages of type std_msgs/msg/String",
    "/tf_static does not get through: one side asks for reliable and transient local messages",
]


def main(node):
    peer = Peer(DOMAIN)
    misfits = [
        peer.reader("cmd_vel", ros.TwistStamped),
        peer.writer("odom", ros.String),
        peer.writer("tf_static", ros.TFMessage, ros.SENSOR),
    ]
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        file.write(PARAMETERS)
        file.flush()
        words = [node, "--ros-args", "--params-file", file.name]
        environment = dict(os.environ, ROS_DOMAIN_ID=str(DOMAIN))
        with subprocess.Popen(words, env=environment, stderr=subprocess.PIPE, text=True) as running:
            time.sleep(SECONDS)
            running.send_signal(signal.SIGINT)
            told = running.stderr.read()
        code = running.returncode
    missing = [sentence for sentence in EXPECTED if sentence not in told]
    if missing or code != 130 or not misfits:
        sys.exit(f"exit code {code}, not said: {missing}\n{told}")


if __name__ == "__main__":
    main(sys.argv[1])
