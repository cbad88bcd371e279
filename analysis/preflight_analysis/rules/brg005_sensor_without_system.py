"""BRG005: a bridge to a sensor of Gazebo that no plugin makes work.

https://gazebosim.org/docs/harmonic/sensors/: each kind of sensor needs a system plugin in the world.
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.gazebo_side import gazebo_of, to_gazebo
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import ROS_GZ_BRIDGE
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    gazebo = gazebo_of(context)
    # A plugin that is not known, or is within what is not known, may load others.
    if gazebo is None or not gazebo.whole:
        return
    for bridge in to_gazebo(context):
        makers = gazebo.named(bridge.gazebo_topic, bridge.direction) if bridge.direction != "ROS_TO_GZ" else ()
        needed = {each.needs for each in makers}
        if not needed or "" in needed or needed & gazebo.systems:
            continue
        plugin = f"gz-sim-{min(needed)}-system"
        yield rule.claim(
            f"{makers[0].maker} publishes nothing on '{bridge.gazebo_topic}': '{plugin}' is not loaded",
            bridge.gazebo_place,
            subject=Subject("plugin", plugin),
            related=(*gazebo.related, *include_chain(bridge.node.origin)),
        )


RULE = Rule(
    id="BRG005",
    name="sensor-without-system",
    effect="breaks",
    kind="absent",
    always=(Reason.LIBRARY,),
    what="Checks for a topic of `ros_gz_bridge` that a sensor of Gazebo has, while no plugin runs such sensors. There "
    "is no finding if a part of Gazebo is not known.",
    why="Gazebo loads the sensor without an error, and the sensor publishes nothing.",
    example='<world name="w">\n  <plugin filename="gz-sim-physics-system" name="gz::sim::systems::Physics"/>\n'
    '  <!-- a robot with <sensor type="imu"> -->',
    instead='<world name="w">\n  <plugin filename="gz-sim-physics-system" name="gz::sim::systems::Physics"/>\n'
    '  <plugin filename="gz-sim-imu-system" name="gz::sim::systems::Imu"/>',
    references=(ROS_GZ_BRIDGE,),
    generations=(2,),
    check=_check,
    every_root=True,
)
