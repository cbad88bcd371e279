"""Controller managers that Gazebo runs for the robots that a launch file spawns in it."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.evaluation.ros2.simulated import plugins_in
from preflight_analysis.graph.model import Graph
from preflight_analysis.workspace.workspace import Analysis
from support import package_elsewhere

PLUGIN = """
<gazebo>
  <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">{}</plugin>
</gazebo>
"""
CONTROLLERS = """
controller_manager:
  ros__parameters:
    update_rate: 100
    base: {type: diff_drive_controller/DiffDriveController}
base:
  ros__parameters: {wheel_radius: 0.1}
"""
SPAWN = '<node pkg="ros_gz_sim" exec="create" args="-topic robot_description"/>'
PUBLISHER = """
<node pkg="robot_state_publisher" exec="robot_state_publisher"><param from="$(dirname)/urdf.yaml"/></node>
"""


def graph_of(folder: Path, plugin: str, launch: str = PUBLISHER + SPAWN, **files: str) -> Graph:
    graph = analysed(folder, plugin, launch, **files).graph
    assert graph is not None
    return graph


def analysed(folder: Path, plugin: str, launch: str = PUBLISHER + SPAWN, **files: str) -> Analysis:
    """The analysis of a launch file that has a robot with this in the plugin's tag; `@` is the launch file's folder."""
    place = str(folder / "ws" / "src" / "robot")
    text = "\n".join(f"      {line}" for line in (f"<robot>{PLUGIN.format(plugin)}</robot>").splitlines())
    return package_elsewhere.analysed(
        folder,
        f"<launch>{launch}</launch>",
        "a.launch.xml",
        "jazzy",
        **{
            "urdf.yaml": f"/**:\n  ros__parameters:\n    robot_description: |\n{text.replace('@', place)}\n",
            "c.yaml": CONTROLLERS,
            **files,
        },
    )


def simulated(graph: Graph) -> list[str]:
    return [node.name for node in graph.tree.nodes if node.kind == "simulated"]


def test_the_manager_and_its_controllers_are_nodes(tmp_path: Path) -> None:
    graph = graph_of(tmp_path, "<parameters>@/c.yaml</parameters>")
    assert simulated(graph) == ["/controller_manager", "/base"]
    assert {"/base/cmd_vel", "/base/odom"} <= graph.topics.keys()
    by_name = {node.name: node for node in graph.tree.nodes}
    assert {param.name: param.value for param in by_name["/base"].params} == {"wheel_radius": 0.1, "use_sim_time": True}
    assert by_name["/base"].within == "/controller_manager"
    # They are not what the launch starts, of which each has an outcome of its own.
    assert len(graph.processes) == 2


def test_namespace_name_several_files_and_remaps(tmp_path: Path) -> None:
    graph = graph_of(
        tmp_path,
        "<parameters>@/c.yaml</parameters><parameters>@/more.yaml</parameters>"
        "<controller_manager_name>cm</controller_manager_name>"
        "<ros><namespace>left</namespace><remapping>base/cmd_vel:=/cmd_vel</remapping></ros>",
        **{"more.yaml": "/left/cm: {ros__parameters: {base: {type: diff_drive_controller/DiffDriveController}}}"},
    )
    assert simulated(graph) == ["/left/cm", "/left/base"]
    assert [each.node.name for each in graph.topics["/cmd_vel"].consumers] == ["/left/base"]


@pytest.mark.parametrize(
    "launch",
    [
        PUBLISHER,
        SPAWN,
        PUBLISHER + SPAWN + '<node pkg="controller_manager" exec="ros2_control_node" name="controller_manager"/>',
    ],
    ids=["no-simulator", "no-description", "a-manager-of-the-launch"],
)
def test_there_is_none(tmp_path: Path, launch: str) -> None:
    assert simulated(graph_of(tmp_path, "<parameters>@/c.yaml</parameters>", launch)) == []


def test_a_slip_in_the_parameters_of_a_controller(tmp_path: Path) -> None:
    controllers = CONTROLLERS.replace("wheel_radius: 0.1", "wheel_raduis: 0.1, wheel_separation: 0.3, own: {a: 1}")
    analysis = analysed(tmp_path, "<parameters>@/c.yaml</parameters>", **{"c.yaml": controllers})
    messages = [finding.message for finding in analysis.findings if finding.rule == "PRM013"]
    assert messages == [
        "parameter 'wheel_raduis' is not declared by /base; its value is ignored; did you mean 'wheel_radius'?"
    ]


def test_what_a_spawner_brings(tmp_path: Path) -> None:
    spawner = (
        '<node pkg="controller_manager" exec="spawner" '
        "args=\"drive -p $(dirname)/drive.yaml --controller-ros-args '-r ~/cmd_vel:=/cmd_vel'\"/>"
    )
    graph = graph_of(
        tmp_path,
        "<parameters>@/c.yaml</parameters>",
        PUBLISHER + SPAWN + spawner,
        **{
            "drive.yaml": "drive:\n  ros__parameters:\n    type: diff_drive_controller/DiffDriveController\n"
            "    wheel_radius: 1.0"
        },
    )
    assert simulated(graph) == ["/controller_manager", "/base", "/drive"]
    assert [each.node.name for each in graph.topics["/cmd_vel"].consumers] == ["/drive"]
    assert [each.node.name for each in graph.topics["/base/cmd_vel"].consumers] == ["/base"]
    (drive,) = (node for node in graph.tree.nodes if node.name == "/drive")
    assert ("wheel_radius", 1.0) in {(param.name, param.value) for param in drive.params}


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("", 0),
        ("<plugin", 0),
        ('<plugin name="gz_ros2_control"/>', 0),
        ('<plugin name="gz_ros2_control">', 0),
        ('<plugin name="x"></plugin><plugins name="gz_ros2_control"></plugins>', 0),
        ('<!-- <plugin name="gz_ros2_control"></plugin> -->', 0),
        ('<plugin filename="libgazebo_ros2_control.so" name="g"><parameters/></plugin>', 1),
        ('<plugin filename="ign_ros2_control-system"><ros></ros></plugin>' * 2, 2),
    ],
)
def test_what_of_a_description_is_a_plugin(text: str, count: int) -> None:
    assert len(plugins_in(text)) == count


def test_a_description_of_unclosed_tags_is_read_in_linear_time() -> None:
    assert plugins_in('<plugin name="gz_ros2_control"><ros><parameters>' * 100_000) == ()


def test_a_manager_that_the_launch_starts_beside_the_simulator(tmp_path: Path) -> None:
    node = '<node pkg="controller_manager" exec="ros2_control_node"><param from="$(dirname)/c.yaml"/></node>'
    found = analysed(tmp_path, "<parameters>@/c.yaml</parameters>", PUBLISHER + SPAWN + node).findings
    (twice,) = [each for each in found if each.rule == "LCH016"]
    assert twice.severity == "warning"
    assert twice.message.startswith("duplicate node name '/controller_manager': the simulator creates it for the robot")
    assert [each.message for each in twice.related] == ["the robot is spawned here"]
