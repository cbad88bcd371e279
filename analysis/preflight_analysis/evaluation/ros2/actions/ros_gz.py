"""`<ros_gz_bridge>`, `<gz_server>` and `<gz_spawn_model>`, which packages of ros_gz add from Jazzy on.

Each includes a launch file of its package with what it is given: `execute` in ros_gz_bridge/actions/ros_gz_bridge.py,
ros_gz_sim/actions/gzserver.py and gz_spawn_model.py of gazebosim/ros_gz, ros2 a4d00a90.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from preflight_analysis.evaluation.ros2.actions import include
from preflight_analysis.evaluation.ros2.entity import CONDITIONS, action_tag
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.launch.model import Action, ActionAttribute, Literal, Substitution, Value
from preflight_analysis.launch.schema import Attribute

_LEFT_OUT = frozenset((*(attribute.name for attribute in CONDITIONS), "roll", "pitch", "yaw"))
"""What the launch files do not know: they have R, P and Y."""
_COMPOSITION = (
    Attribute("container_name", "The container to load it into.", default="ros_gz_container"),
    Attribute("create_own_container", "Whether to start that container.", default="False"),
    Attribute("use_composition", "Whether to load it into a container.", default="False"),
)


def _including(package: str, file: str) -> Callable[[Walk, Performer, Action], None]:
    def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
        given = (each for each in action.attributes if each.name not in _LEFT_OUT)
        path = ActionAttribute("file", action.kind_span, _path(package, file, action), action.kind_span)
        passed = tuple(_argument(each, action) for each in given)
        include.evaluate(walk, performer, replace(action, kind="include", attributes=(path,), children=passed))

    return evaluate


def _path(package: str, file: str, action: Action) -> Value:
    span, found = action.kind_span, f"$(find-pkg-share {package})"
    share = Substitution("find-pkg-share", span, package, span, found, span, ((Literal(package, span),),))
    rest = f"/launch/{file}"
    return Value(found + rest, span, (share, Literal(rest, span)))


def _argument(given: ActionAttribute, action: Action) -> Action:
    name = Value(given.name, given.name_span, (Literal(given.name, given.name_span),))
    attributes = (
        ActionAttribute("name", given.name_span, name, given.name_span),
        ActionAttribute("value", given.name_span, given.value, given.span),
    )
    return replace(
        action,
        kind="arg",
        kind_span=given.name_span,
        attributes=attributes,
        children=(),
        head_span=given.span,
        span=given.span,
    )


ENTITIES = (
    LaunchAction(
        kind="ros_gz_bridge",
        tag=action_tag(
            "Starts a bridge between ROS and Gazebo (`ros_gz_bridge`, from Jazzy on).",
            Attribute("bridge_name", "The name of the node.", "node", required=True),
            Attribute("config_file", "The YAML file with the bridged topics.", required=True),
            *_COMPOSITION,
            Attribute("namespace", "The namespace of the node.", "namespace"),
            Attribute("use_respawn", "Whether to start it again when it ends.", default="False"),
            Attribute("log_level", "Its log level.", default="info"),
            named_by=("bridge_name",),
            starts=True,
        ),
        evaluate=_including("ros_gz_bridge", "ros_gz_bridge.launch.py"),
        offered=300,
        configures=True,
    ),
    LaunchAction(
        kind="gz_server",
        tag=action_tag(
            "Starts the server of Gazebo (`ros_gz_sim`, from Jazzy on).",
            Attribute("world_sdf_file", "The world's file."),
            Attribute("world_sdf_string", "The world as SDF."),
            *_COMPOSITION,
            named_by=("world_sdf_file",),
            starts=True,
        ),
        evaluate=_including("ros_gz_sim", "gz_server.launch.py"),
        offered=310,
        configures=True,
    ),
    LaunchAction(
        kind="gz_spawn_model",
        tag=action_tag(
            "Spawns a model in Gazebo (`ros_gz_sim`, from Jazzy on).",
            Attribute("world", "The name of the world."),
            Attribute("file", "The SDF file of the model."),
            Attribute("model_string", "The model as SDF."),
            Attribute("topic", "The topic that has the model."),
            Attribute("entity_name", "The name of the model in the world."),
            Attribute("allow_renaming", "Whether it gets another name where that one is taken."),
            *(Attribute(name, f"Its position: {name}.") for name in ("x", "y", "z")),
            *(Attribute(name, f"Its orientation: {name}.") for name in ("roll", "pitch", "yaw")),
            named_by=("entity_name",),
            starts=True,
        ),
        evaluate=_including("ros_gz_sim", "gz_spawn_model.launch.py"),
        offered=320,
        configures=True,
    ),
)
