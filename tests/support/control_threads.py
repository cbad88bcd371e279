"""Workspaces as in public threads about ros_control, ros2_control and MoveIt, for `check`."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable

_PACKAGES = (
    "controller_manager",
    "gazebo_ros",
    "ros_gz_sim",
    "robot_state_publisher",
    "joint_state_publisher",
    "moveit_ros_move_group",
)


def workspace(launch: str, files: dict[str, str], *, name: str = "/main.launch.xml") -> str:
    """A fixture with the launch file, further files and the packages that they start programs of."""
    packages = {f"/{each}/package.xml": f"<package><name>{each}</name></package>" for each in _PACKAGES}
    texts = {name: launch, **packages, **files}
    return "\n".join(f"//- {path}\n{textwrap.dedent(text).strip()}" for path, text in texts.items()) + "\n"


def launch(*tags: str) -> str:
    """A launch file of these tags."""
    return "\n".join(("<launch>", *tags, "</launch>"))


def urdf(joints: Iterable[str], more: str = "", *, name: str = "robot", types: dict[str, str] | None = None) -> str:
    """A robot with these joints, one behind the other, each continuous unless `types` says more of its element."""
    known = types or {}
    links = ["base_link", *(f"{joint}_link" for joint in joints)]
    parts = [f"<link name='{link}'/>" for link in links]
    for joint, parent in zip(joints, links, strict=False):
        element = known.get(joint, "type='continuous'>")
        parts.append(f"<joint name='{joint}' {element}<parent link='{parent}'/><child link='{joint}_link'/></joint>")
    return f"<robot name='{name}'>{''.join(parts)}{more}</robot>"


def hardware(joints: Iterable[str], command: str = "position", *, name: str = "hw") -> str:
    """The element of ros2_control that has these joints."""
    each = "".join(
        f"<joint name='{joint}'><command_interface name='{command}'/><state_interface name='position'/></joint>"
        for joint in joints
    )
    plugin = "<hardware><plugin>mock_components/GenericSystem</plugin></hardware>"
    return f"<ros2_control name='{name}' type='system'>{plugin}{each}</ros2_control>"


def publisher(description: str, namespace: str = "/") -> str:
    """The tag of robot_state_publisher, which has the description."""
    escaped = description.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
    return (
        f'<node pkg="robot_state_publisher" exec="robot_state_publisher" name="rsp" namespace="{namespace}">'
        f'<param name="robot_description" value="{escaped}"/></node>'
    )


def manager(file: str | None = "/p/controllers.yaml", namespace: str = "/") -> str:
    """The tag of the controller manager."""
    param = f'<param from="{file}"/>' if file else ""
    program = 'pkg="controller_manager" exec="ros2_control_node" name="controller_manager"'
    return f'<node {program} namespace="{namespace}">{param}</node>'


def spawner(args: str, namespace: str = "/", name: str = "s") -> str:
    """The tag of a spawner."""
    return f'<node pkg="controller_manager" exec="spawner" name="{name}" namespace="{namespace}" args="{args}"/>'
