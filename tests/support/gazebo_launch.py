"""A launch that starts Gazebo with a world, spawns a robot in it, and bridges topics."""

from __future__ import annotations

from pathlib import Path

from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.registry import run_rules

from support import package_elsewhere

SYSTEMS = "".join(
    f'<plugin filename="gz-sim-{name}-system" name="{name}"/>'
    for name in ("physics", "user-commands", "scene-broadcaster", "sensors", "imu")
)
WORLD = f'<sdf version="1.9"><world name="w">{SYSTEMS}</world></sdf>'
DRIVE = '<plugin filename="gz-sim-diff-drive-system" name="d">{}</plugin>'


def robot(content: str) -> str:
    """A model 'bot' with plugins, and sensors of its only link."""
    return f'<sdf version="1.9"><model name="bot">{content}</model></sdf>'


def sensor(type_: str, content: str = "") -> str:
    """A sensor 's' in its link 'l'."""
    return f'<link name="l"><sensor name="s" type="{type_}">{content}</sensor></link>'


def row(topic: str, types: str, direction: str, ros_topic: str = "/t") -> str:
    """An entry of a bridge's file; `types` is that of ROS and that of Gazebo."""
    ros, gazebo = types.split()
    return (
        f"- {{ros_topic_name: {ros_topic}, gz_topic_name: {topic}, ros_type_name: {ros}, "
        f"gz_type_name: gz.msgs.{gazebo}, direction: {direction}}}\n"
    )


def findings(
    folder: Path,
    rule: str,
    rows: str,
    model: str = "",
    *,
    world: str = WORLD,
    start: str = "gz sim -r $(dirname)/w.sdf",
    spawn: str = "-file $(dirname)/bot.sdf",
    more: str = "",
) -> list[Finding]:
    """Those of a rule, where `model` is spawned and the bridge has `rows`."""
    started = f'<executable cmd="{start}"/>' if start else ""
    launch = f"""<launch>{started}
      <node pkg="ros_gz_sim" exec="create" args="{spawn}"/>
      <node pkg="ros_gz_bridge" exec="parameter_bridge" name="bridge">
        <param name="config_file" value="$(dirname)/b.yaml"/></node>{more}</launch>"""
    files = {"w.sdf": world, "bot.sdf": robot(model), "b.yaml": rows}
    analysis = package_elsewhere.analysed(folder, launch, "a.launch.xml", "jazzy", **files)
    return [each for each in run_rules(analysis.context) if each.rule == rule]
