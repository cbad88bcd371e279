"""Launch files of ROS 2 whose nodes broadcast frames and ask for them."""

from __future__ import annotations

import json
from collections.abc import Mapping

_PACKAGES = ("robot_state_publisher", "tf2_ros", "robot_localization")
_OUTSIDE = ("/joint_states", "/robot_description", "/set_pose", "/odometry/filtered", "/scan", "/map_metadata", "/pose")
"""Topics that are no matter here."""
EKF = """<node pkg="robot_localization" exec="ekf_node" name="ekf"><param name="publish_tf" value="false"/>
<param name="base_link_frame" value="{}"/>{}</node>"""
"""A node that asks for the frame of the base and broadcasts none, with more in its tag."""
EKF_COLUMN = len('<param name="base_link_frame" value="')
"""Where that frame begins in the second line."""


def fixture(lines: str, interfaces: Mapping[str, object] | None = None, files: str = "") -> str:
    """A fixture with these lines in `<launch>`, and what is seen of the nodes."""
    packages = "".join(f"\n//- /{name}/package.xml\n<package><name>{name}</name></package>" for name in _PACKAGES)
    graph = f"\n//- interfaces\n{json.dumps(interfaces)}" if interfaces is not None else ""
    settings = (
        f"\n//- /workspace/.ros-preflight.yaml\nexternal: {{topics: {json.dumps([*_OUTSIDE, '/slam_toolbox/*'])}}}"
    )
    return f"//- /main.launch.xml\n<launch>\n{lines}\n</launch>{packages}{settings}{graph}{files}"


def static(name: str, parent: str, child: str, more: str = "") -> str:
    """A static transform."""
    args = f"0 0 0 0 0 0 {parent} {child}"
    return f'<node pkg="tf2_ros" exec="static_transform_publisher" name="{name}" args="{args}">{more}</node>'


def robot(*joints: tuple[str, str], more: str = "") -> str:
    """A robot_state_publisher of links with fixed joints from the first to the second."""
    links = "".join(f'<link name="{name}"/>' for name in dict.fromkeys(end for pair in joints for end in pair))
    joint = '<joint name="j{}" type="fixed"><parent link="{}"/><child link="{}"/></joint>'
    made = "".join(joint.format(at, *pair) for at, pair in enumerate(joints))
    text = f"<robot>{links}{made}</robot>".replace("<", "&lt;").replace('"', "&quot;")
    return f"""<node pkg="robot_state_publisher" exec="robot_state_publisher" name="rsp">{more}
<param name="robot_description" value="{text}"/></node>"""


def below(column: int, length: int, text: str) -> str:
    """The line of an expected finding."""
    return " " * column + "^" * length + " " + text
