"""Starts tolman-ros2: ros2 launch tolman.launch.py params_file:=turtlebot3_burger.yaml"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument("params_file", description="parameters of the node, a file of YAML"),
            DeclareLaunchArgument("scan_topic", default_value="/scan", description="topic of the laser's scans"),
            ExecuteProcess(
                cmd=[
                    "tolman-ros2", "--ros-args",
                    "--params-file", LaunchConfiguration("params_file"),
                    "-p", ["scan_topic:=", LaunchConfiguration("scan_topic")],
                ],
                output="screen",
            ),
        ]
    )
