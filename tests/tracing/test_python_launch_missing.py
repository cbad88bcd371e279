"""Python launch files that use what is not installed here: they are run to the end, and what depends on it is
unknown."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.evaluation.problems import (
    CommandFailed,
    PackageNotFound,
    PythonException,
    PythonImportFailed,
    UndeclaredArgument,
    UnsetVariable,
)
from preflight_analysis.evaluation.ros2 import unknown_text
from preflight_analysis.evaluation.ros2.params import given_within, of_name
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.tracing.agents import anything
from support.python_launch_harness import PythonHarness

pytestmark = pytest.mark.ros

HEAD = """\
import os
from launch import LaunchDescription
from launch.actions import *
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.descriptions import ParameterValue
from ament_index_python.packages import get_package_share_directory
"""


@pytest.fixture
def harness(tmp_path: Path) -> PythonHarness:
    return PythonHarness(tmp_path)


def tree_of(harness: PythonHarness, text: str, **options: object) -> LaunchTree:
    path = harness.write("launch/a.launch.py", HEAD + text)
    return harness.launch(path, **options).tree  # type: ignore[arg-type]


def names(tree: LaunchTree) -> list[str]:
    return [node.name for node in tree.nodes]


def test_marks_are_those_that_the_runs_make() -> None:
    assert (unknown_text.BEGIN, unknown_text.END) == (anything.BEGIN, anything.END)
    assert unknown_text.unknown_text("x") == anything.unknown_text("x")


def test_what_depends_on_a_missing_module_is_unknown_and_the_rest_is_known(harness: PythonHarness) -> None:
    tree = tree_of(
        harness,
        """
from robot_helpers.launch import Robot, things

robot = Robot("arm").parameters(file="x.yaml")

def generate_launch_description():
    description = LaunchDescription([
        Node(package="p", executable="x", name="one", parameters=[robot.all, {"rate": 5, "limit": robot.limit}],
             remappings=[("scan", robot.scan), ("odom", "/odom")], arguments=["-a", robot.name]),
        Node(package="p", executable="y", name="two", condition=IfCondition(robot.has_two)),
        things(robot),
        *robot.actions,
        OpaqueFunction(function=lambda context: [Node(package="p", executable="z", name="three")]),
    ])
    description.add_action(robot.more())
    return description
""",
    )
    assert [p.kind for p in tree.problems] == [
        PythonImportFailed("robot_helpers", "No module named 'robot_helpers'", stood_in_for=True)
    ]
    assert names(tree) == ["/one", "/three"], "whether there is a second one is not known"
    one = tree.nodes[0]
    assert [(param.name, param.value) for param in one.params] == [("rate", 5)]
    assert [(remap.source, remap.target) for remap in one.remaps][-1] == ("odom", "/odom")
    assert not tree.complete


def test_a_package_that_is_missing_has_a_folder_that_is_not_known(harness: PythonHarness) -> None:
    tree = tree_of(
        harness,
        """
import yaml
SHARE = get_package_share_directory("missing_bringup")
with open(os.path.join(SHARE, "config", "robot.yaml")) as file:
    CONFIG = yaml.safe_load(file)
with open(os.path.join(get_package_share_directory("missing_description"), "robot.urdf")) as file:
    URDF = file.read()

def generate_launch_description():
    if not os.path.exists(SHARE):
        raise RuntimeError("no folder")
    return LaunchDescription([
        DeclareLaunchArgument("params", default_value=os.path.join(SHARE, "params.yaml")),
        IncludeLaunchDescription(PythonLaunchDescriptionSource([SHARE, "/launch/other.launch.py"])),
        Node(package="p", executable="x", name="one", parameters=[LaunchConfiguration("params"), {"rate": 5}]),
        Node(package="p", executable="y", name="two", parameters=[{"robot_description": URDF,
             "of_config": CONFIG["robot"]["name"], "typed": ParameterValue(URDF, value_type=str)}]),
    ])
""",
    )
    assert {p.kind for p in tree.problems} == {
        PackageNotFound("missing_bringup"),
        PackageNotFound("missing_description"),
    }
    assert names(tree) == ["/one", "/two"]
    assert [(param.name, param.value) for param in tree.nodes[0].params] == [("rate", 5)]
    assert not tree.nodes[1].params


def test_what_a_file_does_without_a_package_it_does(harness: PythonHarness) -> None:
    tree = tree_of(
        harness,
        """
from ament_index_python.packages import PackageNotFoundError
try:
    get_package_share_directory("missing_bringup")
    name = "there"
except PackageNotFoundError:
    name = "not_there"

def generate_launch_description():
    return LaunchDescription([Node(package="p", executable="x", name=name)])
""",
    )
    assert names(tree) == ["/not_there"]
    assert tree.complete


def test_a_variable_that_is_not_set_is_unknown(harness: PythonHarness) -> None:
    text = """
MODEL = os.environ["ROBOT_MODEL"]

def generate_launch_description():
    return LaunchDescription([
        Node(package="p", executable="x", name="one", arguments=["--model", MODEL]),
        Node(package="p", executable="x", name=os.environ.get("ROBOT_NAME", "two")),
    ])
"""
    tree = tree_of(harness, text)
    assert [p.kind for p in tree.problems] == [UnsetVariable("ROBOT_MODEL")]
    assert names(tree) == ["/one", "/two"]
    tree = tree_of(harness, text, variables={"ROBOT_MODEL": "burger"})
    assert tree.complete
    assert tree.nodes[0].args == "--model burger"


def test_functions_run_with_what_is_configured_and_not_known(harness: PythonHarness) -> None:
    tree = tree_of(
        harness,
        """
def start(context):
    name = LaunchConfiguration("robot").perform(context)
    return [
        SetLaunchConfiguration("file", name + ".yaml"),
        Node(package="p", executable="x", name="one", namespace=LaunchConfiguration("space").perform(context)),
        Node(package="p", executable="y", name="two", arguments=[name]),
    ]

def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("robot"),
        DeclareLaunchArgument("space", default_value="front"),
        OpaqueFunction(function=start),
    ])
""",
    )
    assert names(tree) == ["/front/one", "/two"]


def test_an_error_after_something_unknown_is_no_finding_but_one_of_an_action_is(harness: PythonHarness) -> None:
    after = "def generate_launch_description():\n    return LaunchDescription([{}])\n"
    tree = tree_of(harness, "import robot_helpers\n'abc'.index(str(robot_helpers.count))\n" + after.format(""))
    assert not [p for p in tree.problems if isinstance(p.kind, PythonException)]
    assert not tree.complete
    node = "Node(package='p', node_executable='x')"
    tree = tree_of(harness, "import robot_helpers\n" + after.format(node))
    assert [p.kind.error for p in tree.problems if isinstance(p.kind, PythonException)] == ["TypeError"]


def test_modules_of_packages_that_are_only_source_are_imported(harness: PythonHarness) -> None:
    other = harness.folder / "src" / "common"
    for name, text in {
        "package.xml": "<package format='3'><name>common</name></package>",
        "CMakeLists.txt": "project(common)\nament_python_install_package(${PROJECT_NAME})\n",
        "common/__init__.py": "",
        "common/launch/__init__.py": "from .helpers import name_of\n",
        "common/launch/helpers.py": "def name_of(x):\n    return 'of_' + x\n",
    }.items():
        path = other / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    tree = tree_of(
        harness,
        """
from common.launch import name_of

def generate_launch_description():
    return LaunchDescription([Node(package="p", executable="x", name=name_of("x"))])
""",
    )
    assert names(tree) == ["/of_x"]
    assert tree.complete


ROBOT = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="side" default="left"/>
  <xacro:include filename="$(find {})/urdf/parts.xacro"/>
  <link name="$(arg side)"/>
</robot>
"""


def test_xacro_is_there_without_ros(harness: PythonHarness) -> None:
    harness.write("urdf/parts.xacro", '<robot><link name="wheel"/></robot>')
    harness.write("urdf/robot.xacro", ROBOT.format("p"))
    harness.write("urdf/broken.xacro", ROBOT.format("missing_parts"))
    tree = tree_of(
        harness,
        """
import xacro
URDF = os.path.join(get_package_share_directory("p"), "urdf")

def start(context):
    text = Command(["xacro ", URDF + "/robot.xacro", " side:=", "right"]).perform(context)
    return [Node(package="p", executable="x", name="three", parameters=[{"robot_description": text}])]

def generate_launch_description():
    one = xacro.process_file(URDF + "/robot.xacro", mappings={"side": "front"}).toxml()
    two = ParameterValue(Command([FindExecutable(name="xacro"), " ", URDF + "/robot.xacro"]), value_type=str)
    four = ParameterValue(Command(["xacro ", URDF + "/broken.xacro"]), value_type=str)
    return LaunchDescription([
        Node(package="p", executable="x", name="one", parameters=[{"robot_description": one}]),
        Node(package="p", executable="x", name="two", parameters=[{"robot_description": two}]),
        OpaqueFunction(function=start),
        Node(package="p", executable="x", name="four", parameters=[{"robot_description": four, "rate": 5}]),
        Node(package="p", executable="x", name="five", parameters=[
            {"robot_description": xacro.process_file(URDF + "/broken.xacro").toxml()}]),
    ])
""",
    )
    values = {node.name: str([param.value for param in node.params]) for node in tree.nodes}
    for name, side in {"/one": "front", "/two": "left", "/three": "right"}.items():
        assert '"wheel"' in values[name]
        assert f'"{side}"' in values[name]
    for name in ("/four", "/five"):
        assert "incomplete for ros-preflight without missing_parts" in values[name]
        assert '"left"' in values[name]
    assert {each.reason for each in tree.unknowns} == {"package 'missing_parts' is not installed here"}
    assert not [p for p in tree.problems if isinstance(p.kind, PythonException)]


def test_what_xacro_writes_of_a_file_that_is_not_known_is_a_text(harness: PythonHarness) -> None:
    """`xacro.process` gives a text, the other functions a document."""
    tree = tree_of(
        harness,
        """
import xacro

def generate_launch_description():
    urdf = os.path.join(get_package_share_directory("gone"), "urdf", "robot.xacro")
    return LaunchDescription([
        Node(package="p", executable="x", name="one", parameters=[{"robot_description": xacro.process(urdf)}]),
        Node(package="p", executable="x", name="two", parameters=[
            {"robot_description": xacro.process_file(urdf).toxml()}]),
    ])
""",
    )
    assert {node.name for node in tree.nodes} == {"/one", "/two"}
    assert not [p for p in tree.problems if isinstance(p.kind, PythonException)]


def test_xacro_names_the_file_that_does_not_exist(harness: PythonHarness) -> None:
    tree = tree_of(
        harness,
        """
def generate_launch_description():
    urdf = os.path.join(get_package_share_directory("p"), "urdf", "gone.xacro")
    return LaunchDescription([
        Node(package="p", executable="x", parameters=[{"robot_description": Command(["xacro ", urdf])}])])
""",
    )
    (failed,) = (problem.kind for problem in tree.problems if isinstance(problem.kind, CommandFailed))
    said = " ".join(failed.stderr)
    assert "No such file or directory" in said
    assert "gone.xacro" in said
    assert "Traceback" not in said


def test_helpers_of_navigation_that_are_not_here_have_their_behaviour(harness: PythonHarness) -> None:
    harness.write(
        "params.yaml",
        """
        amcl:
          ros__parameters:
            use_sim_time: false
            scan_topic: <robot>/scan
            limits: {speed: 0.5}
            kept: 3
        """,
    )
    tree = tree_of(
        harness,
        """
from nav2_common.launch import HasNodeParams, LaunchConfigAsBool, ReplaceString, RewrittenYaml

def generate_launch_description():
    file = os.path.join(get_package_share_directory("p"), "params.yaml")
    rewritten = RewrittenYaml(
        source_file=ReplaceString(source_file=file, replacements={"<robot>": LaunchConfiguration("robot")}),
        root_key=LaunchConfiguration("robot"),
        param_rewrites={"use_sim_time": LaunchConfiguration("sim"), "amcl.ros__parameters.limits.speed": "0.25",
                        "amcl.ros__parameters.added": "1"},
        convert_types=True,
    )
    return LaunchDescription([
        DeclareLaunchArgument("robot", default_value="r1"),
        DeclareLaunchArgument("sim", default_value="True"),
        Node(package="p", executable="x", name="amcl", namespace="r1", parameters=[rewritten],
             condition=IfCondition(LaunchConfigAsBool("sim"))),
        Node(package="p", executable="x", name="other", condition=IfCondition(HasNodeParams(file, "other"))),
    ])
""",
    )
    assert names(tree) == ["/r1/amcl"]
    values = {param.name: param.value for param in tree.nodes[0].params}
    assert values == {"use_sim_time": True, "scan_topic": "r1/scan", "limits.speed": 0.25, "added": 1, "kept": 3}
    places = {param.name: param.name_location for param in tree.nodes[0].params}
    kept = places.pop("kept")
    assert kept is not None
    assert kept.file.endswith("/params.yaml")
    assert set(places.values()) == {None}
    assert tree.complete


def test_a_rewritten_file_has_parameters_for_nodes_whose_names_are_found_later(harness: PythonHarness) -> None:
    harness.write(
        "params.yaml",
        """
        server: {ros__parameters: {rate: 20.0}}
        map: {map: {ros__parameters: {layers: [scan]}}}
        """,
    )
    tree = tree_of(
        harness,
        """
from nav2_common.launch import RewrittenYaml

def generate_launch_description():
    file = os.path.join(get_package_share_directory("p"), "params.yaml")
    rewritten = RewrittenYaml(source_file=file, root_key="r1", param_rewrites={})
    return LaunchDescription([Node(package="p", executable="x", namespace="r1", parameters=[rewritten])])
""",
    )
    (node,) = tree.nodes
    assert node.params == ()
    named = of_name(node, "/r1/server", {}, inferred=True)
    assert [(param.name, param.value, param.owner) for param in named.params] == [("rate", 20.0, "/r1/server")]
    assert named.params[0].place.file.endswith("/params.yaml")
    within = given_within(named, "/r1/map/map", {})
    assert [(param.name, param.value) for param in within] == [("layers", ["scan"])]
    assert within[0].place.file.endswith("/params.yaml")
    assert given_within(named, "/map/map", {}) == ()


def test_helpers_of_moveit_that_are_not_here_have_their_behaviour(harness: PythonHarness) -> None:
    harness.write("config/arm.urdf.xacro", '<robot name="arm"><link name="base"/></robot>')
    harness.write("config/arm.srdf", '<robot name="arm"><virtual_joint parent_frame="map" child_link="base"/></robot>')
    harness.write("config/moveit_controllers.yaml", "moveit_simple_controller_manager:\n  controller_names: [one]\n")
    harness.write(
        "launch/rsp.launch.py",
        "from launch import *\ndef generate_launch_description():\n    return LaunchDescription([])\n",
    )
    tree = tree_of(
        harness,
        """
from moveit_configs_utils import MoveItConfigsBuilder
from moveit_configs_utils.launches import *

def generate_launch_description():
    config = MoveItConfigsBuilder("arm", package_name="p").to_moveit_configs()
    return LaunchDescription([
        generate_rsp_launch(config), generate_static_virtual_joint_tfs_launch(config),
        generate_spawn_controllers_launch(config), generate_move_group_launch(config),
        generate_moveit_rviz_launch(config), generate_setup_assistant_launch(config),
        generate_warehouse_db_launch(config), Node(package="p", executable="x", parameters=[config.to_dict()]),
    ])
""",
    )
    started = [node.executable for node in tree.nodes]
    assert started[:6] == [
        "robot_state_publisher",
        "static_transform_publisher",
        "spawner",
        "spawner",
        "move_group",
        "rviz2",
    ]
    assert '"base"' in {param.name: str(param.value) for param in tree.nodes[0].params}["robot_description"]
    assert tree.nodes[1].args == "--frame-id map --child-frame-id base"
    assert [node.args for node in tree.nodes[2:4]] == ["one", "joint_state_broadcaster"]
    assert not [p for p in tree.problems if isinstance(p.kind, PythonException)]


def test_what_a_known_helper_package_has_besides_is_unknown(harness: PythonHarness) -> None:
    tree = tree_of(
        harness,
        """
from nav2_common.launch import SomethingNew
from launch_pal.robot_utils import get_robot_name

def generate_launch_description():
    return LaunchDescription([get_robot_name("x"), Node(package="p", executable="x", name="one",
                              parameters=[{"a": SomethingNew("b"), "c": 1}])])
""",
    )
    assert {p.kind.module for p in tree.problems if isinstance(p.kind, PythonImportFailed)} == {
        "nav2_common",
        "launch_pal",
    }
    assert [(param.name, param.value) for param in tree.nodes[0].params] == [("c", 1)]


def test_a_configuration_that_nobody_declares_is_unknown_in_a_function(harness: PythonHarness) -> None:
    tree = tree_of(
        harness,
        """
def start(context):
    name = LaunchConfiguration("robot_nam").perform(context)
    return [Node(package="p", executable="x", name="one", arguments=[name])]

def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("robot_name", default_value="r"), OpaqueFunction(function=start)])
""",
    )
    assert [(p.kind, p.fatal) for p in tree.problems] == [(UndeclaredArgument("robot_nam", ("robot_name",)), True)]
    assert names(tree) == ["/one"]


def test_a_module_that_building_makes_is_unknown(harness: PythonHarness) -> None:
    harness.write("p/__init__.py", "")
    harness.write("p/options.py", "from p._compiled import LEVEL\nNAME = 'known'\n")
    tree = tree_of(
        harness,
        """
from p.options import LEVEL, NAME

def generate_launch_description():
    return LaunchDescription([Node(package="p", executable="x", name=NAME, arguments=[str(LEVEL)])])
""",
    )
    assert names(tree) == ["/known"]


def test_a_module_that_building_compiles_is_unknown_and_a_misspelt_one_is_not_there(harness: PythonHarness) -> None:
    harness.write("CMakeLists.txt", "project(p)\n# add_library(other)\npybind11_add_module(names src/names.cpp)\n")
    harness.write("p/__init__.py", "")
    text = """
from p.{} import LEVEL

def generate_launch_description():
    return LaunchDescription([Node(package="p", executable="x", name="one", arguments=[str(LEVEL)])])
"""
    tree = tree_of(harness, text.format("names"))
    assert names(tree) == ["/one"]
    assert not tree.complete
    for name in ("name", "other"):
        tree = tree_of(harness, text.format(name))
        assert [getattr(p.kind, "stood_in_for", None) for p in tree.problems] == [False]


def test_a_class_of_a_missing_module_has_what_is_asked_of_it(harness: PythonHarness) -> None:
    tree = tree_of(
        harness,
        """
import abc
import enum
from no_such_module import Base, Other

class Payload(Base, abc.ABC):
    limit = 5

class Kind(Other, enum.Enum):
    A = 1

Payload.update_forward_refs()

def generate_launch_description():
    return LaunchDescription([
        Node(package="p", executable="x", name="one", parameters=[{"a": Payload.limit, "b": Payload.more}])])
""",
    )
    assert names(tree) == ["/one"]
    assert [(param.name, param.value) for param in tree.nodes[0].params] == [("a", 5)]


def test_what_is_made_of_a_text_that_is_not_known_is_not_known(harness: PythonHarness) -> None:
    tree = tree_of(
        harness,
        """
import re
FILES = {"a": "file_a"}

def start(context):
    robot = LaunchConfiguration("robot").perform(context)
    count = int(LaunchConfiguration("count").perform(context)) + 1
    known = f"{FILES['a']}_{len('abc'):02d}"
    if f"of_{robot}" == "of_r1" or robot in FILES or IfCondition(LaunchConfiguration("sim")).evaluate(context):
        known = "wrong"
    pairs = dict(each.split(":=") for each in robot.split())
    version = re.findall(r"v(\\d+)", robot)[0]
    return [
        Node(package="p", executable="x", name=known, parameters=[
            {"file": FILES[robot], "count": count, "rate": float(robot) * 2, "version": version, "known": int("7")}]),
        Node(package="p", executable="x", name=FILES.get(robot, "none"), parameters=[pairs]),
    ]

def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("robot"), DeclareLaunchArgument("count"), DeclareLaunchArgument("sim"),
        OpaqueFunction(function=start)])
""",
    )
    assert names(tree) == ["/file_a_03", "/none"]
    assert [(param.name, param.value) for param in tree.nodes[0].params] == [("known", 7)]
    decided = {unknown.what for unknown in tree.unknowns if unknown.decides}
    assert len(decided) >= 3


def test_the_type_of_what_is_not_known(harness: PythonHarness) -> None:
    tree = tree_of(
        harness,
        """
import nowhere

def generate_launch_description():
    config = nowhere.load()
    if type(config) == list:
        name = "several"
    elif type(config) == dict:
        name = "one"
    else:
        raise TypeError("neither")
    return LaunchDescription([Node(package="p", executable=type("x").__name__, name=name)])
""",
    )
    assert (names(tree), tree.nodes[0].executable) == (["/one"], "str")
    assert [unknown for unknown in tree.unknowns if unknown.decides]
    assert not [p for p in tree.problems if isinstance(p.kind, PythonException)]


def test_what_a_known_collection_does_not_have_is_an_error(harness: PythonHarness) -> None:
    for expression, error in {
        "{'a': 1}[name]": "KeyError",
        "[1][len(name) + 5]": "IndexError",
        "int(name)": "ValueError",
        "dict(name)": "ValueError",
        "{}[[]]": "TypeError",
        "name in 5": "TypeError",
    }.items():
        text = f"""
def generate_launch_description():
    name = "known"
    value = {expression}
    return LaunchDescription([Node(package="p", executable="x", name="one")])
"""
        analysis = harness.launch(harness.write("launch/a.launch.py", HEAD + text))
        (raised,) = (p for p in analysis.tree.problems if isinstance(p.kind, PythonException))
        assert raised.kind.error == error
        span = raised.location.span
        assert (HEAD + text)[span.start : span.end].strip() == f"value = {expression}"


def test_xacro_as_a_program_is_there_without_ros(harness: PythonHarness) -> None:
    harness.write("urdf/parts.xacro", '<robot><link name="wheel"/></robot>')
    harness.write("urdf/robot.xacro", ROBOT.format("p"))
    tree = tree_of(
        harness,
        """
import subprocess
FILE = os.path.join(get_package_share_directory("p"), "urdf", "robot.xacro")
LINE = ["xacro", FILE, "side:=front"]

def generate_launch_description():
    with subprocess.Popen(LINE, stdout=subprocess.PIPE, text=True) as process:
        texts = [process.communicate()[0]]
    texts.append(subprocess.check_output(LINE).decode())
    texts.append(subprocess.run(" ".join(LINE), shell=True, capture_output=True, text=True).stdout)
    texts.append(subprocess.check_output(["xacro", os.path.join(FILE, "gone")], text=True))
    process = subprocess.Popen(["no_such_program"], stdout=subprocess.PIPE)
    texts.append(process.communicate()[0].decode())
    return LaunchDescription([
        Node(package="p", executable="x", name=f"n{i}", parameters=[{"robot_description": text}])
        for i, text in enumerate(texts)])
""",
    )
    values = [str([param.value for param in node.params]) for node in tree.nodes]
    assert ['"front"' in value and '"wheel"' in value for value in values] == [True, True, True, False, False]
    assert values[3:] == ["[]", "[]"]


def test_what_a_program_that_is_not_here_prints_is_unknown(harness: PythonHarness) -> None:
    tree = tree_of(
        harness,
        """
import json
import subprocess
import no_such_module

def generate_launch_description():
    printed = subprocess.check_output(["no_such_program", "a"], text=True)
    done = subprocess.run(["no_such_program"], capture_output=True)
    try:
        subprocess.run(["no_such_program"])
        found = "there"
    except FileNotFoundError:
        found = "missing"
    try:
        subprocess.run(["no_such_program"], check=True)
    except subprocess.CalledProcessError:
        pass
    return LaunchDescription([
        Node(package="p", executable="x", name="one", arguments=[printed.strip(), json.dumps({"a": no_such_module.B})]),
        Node(package="p", executable="x", name=found),
    ])
""",
    )
    assert names(tree) == ["/one", "/missing"]


WHAT_IS_DONE_WITH_IT = {
    "a text is taken apart": "package, plugin = text.split('/')",
    "to more": "x, y, z = [float(each) for each in text.split()]",
    "by map": "x, y, z = map(float, unknown.split(','))",
    "its parts": "text.split('/')[2], text.split(':')[-2]",
    "pairs": "for key, value in (pair.split('=') for pair in text.split(',')): key + value",
    "a mapping for a call": "Node(**unknown), Node(package='p', **config['node'])",
    "a list for a call": "(lambda a, b, c: a)(*unknown)",
    "a default among choices": "DeclareLaunchArgument('a', default_value=unknown.a, choices=['a', 'b'])",
    "choices": "DeclareLaunchArgument('a', default_value='c', choices=unknown.kinds())",
    "a text in a list": "', '.join([unknown.name, 'a']), ' '.join(unknown)",
    "compared with several": "'a.yaml'.endswith(('.yaml', '.yml')), text.startswith(('a', unknown.name()))",
    "replaced": "'/sensing/CAMERA'.replace('CAMERA', unknown.name()), 'a'.startswith(unknown.name())",
    "joined to a path": "os.path.join(share, 'a', unknown.name(), *['b', 'c'])",
    "written": "open('/tmp/a.txt', 'w').write(unknown.text())",
    "written as YAML": "import yaml; yaml.safe_dump({'a': unknown, 'b': config})",
    "a substitution": "TextSubstitution(text=unknown.name())",
    "evaluated": "eval(text), eval(unknown)",
    "a literal": "import ast; ast.literal_eval(text)[0]",
    "a folder": "os.listdir(share)[0], [each for each in sorted(os.listdir(share)) if each.endswith('.yaml')][0]",
    "a tree of folders": "for root, folders, files in os.walk(share): os.path.join(root, files[0])",
    "a pattern": "import glob; glob.glob(share + '/*.yaml')[0]",
    "a path": "import pathlib; next(pathlib.Path(share).glob('*')).stem, pathlib.Path(share).stat().st_size",
    "a size": "os.path.getsize(share) + os.stat(share).st_mtime",
    "a module at it": "import importlib.machinery as i; i.SourceFileLoader('m', share + '/m.py').load_module().f()[0]",
    "a program in a shell": "import subprocess; subprocess.check_output('no_such_program | head -1', shell=True)[3]",
    "a number that a program prints": "import subprocess; int(subprocess.check_output(['no_such_program']).strip())",
    "a number that is read": "import subprocess as s; int(s.Popen(['no_such'], stdout=s.PIPE).communicate()[0])",
    "a program that os starts": "os.popen('no_such_program -L').read().split(':')[1]",
    "who is logged in": "os.getlogin() + '/'",
    "an address": "import socket; socket.gethostbyname('no.such.host').split('.')[3]",
    "deleted": "del config['a']",
}


@pytest.mark.parametrize("statement", WHAT_IS_DONE_WITH_IT.values(), ids=WHAT_IS_DONE_WITH_IT.keys())
def test_whatever_is_done_with_something_unknown_goes_on(harness: PythonHarness, statement: str) -> None:
    tree = tree_of(
        harness,
        f"""
import no_such_module as unknown
text = os.environ['NOT_SET_ANYWHERE']
share = get_package_share_directory('not_here')
config = unknown.load()

def generate_launch_description():
    {statement}
    return LaunchDescription([Node(package="p", executable="x", name="one")])
""",
    )
    assert not [p.kind for p in tree.problems if isinstance(p.kind, PythonException)]
    assert names(tree) == ["/one"]


def test_what_a_known_text_does_not_have_is_an_error(harness: PythonHarness) -> None:
    for statement, error in {
        "a, b = 'a b c'.split()": "ValueError",
        "'a/b'.split('/')[2]": "IndexError",
        "for a, b in [(1, 2, 3)]: pass": "ValueError",
        "(lambda a, b: a)(*[1])": "TypeError",
        "(lambda a: a)(**{'b': 1})": "TypeError",
        "{'a': 1}['b']": "KeyError",
        "import subprocess; subprocess.check_output('false | false', shell=True)": "CalledProcessError",
        "DeclareLaunchArgument('a', default_value='c', choices=['a', 'b'])": "RuntimeError",
    }.items():
        text = f"""
def generate_launch_description():
    {statement}
    return LaunchDescription([Node(package="p", executable="x", name="one")])
"""
        analysis = harness.launch(harness.write("launch/a.launch.py", HEAD + text))
        raised = [p.kind.error for p in analysis.tree.problems if isinstance(p.kind, PythonException)]
        assert raised == [error], statement


def test_annotations_of_a_file_are_what_they_are(harness: PythonHarness) -> None:
    tree = tree_of(
        harness,
        """
from typing import Dict, List, Optional, Type

def named(kind: type[Node], names: list[str], more: dict[str, Optional[int]], old: Dict[str, List[Type[Node]]]) -> Node:
    first, *rest = names
    return kind(package="p", executable="x", name=first, **more)

def generate_launch_description():
    return LaunchDescription([named(Node, ["one", "other"], {}, {})])
""",
    )
    assert names(tree) == ["/one"]


def test_a_file_may_write_into_a_share_folder(harness: PythonHarness) -> None:
    harness.write("models/old.yaml", "old: 1\n")
    tree = tree_of(
        harness,
        """
import pathlib
SHARE = get_package_share_directory("p")
MODELS = os.path.join(SHARE, "models", "tmp")

def generate_launch_description():
    if not os.path.isdir(MODELS):
        pathlib.Path(MODELS).mkdir(parents=True, exist_ok=True)
    os.makedirs(MODELS, exist_ok=True)
    path = os.path.join(MODELS, "a.yaml")
    with open(path, "w") as file:
        file.write("one: {ros__parameters: {rate: 5}}")
    with open(path) as file:
        assert file.read().startswith("one:")
    link = os.path.join(SHARE, "models", "tmp", "link")
    os.symlink(SHARE, link)
    assert os.path.lexists(link)
    assert os.path.isfile(path) and pathlib.Path(path).is_file() and sorted(os.listdir(MODELS)) == ["a.yaml", "link"]
    with open(os.path.join(SHARE, "models", "old.yaml")) as file:
        assert file.read() == "old: 1\\n"
    return LaunchDescription([Node(package="p", executable="x", name="one", parameters=[path])])
""",
    )
    assert [(param.name, param.value) for param in tree.nodes[0].params] == [("rate", 5)]
    assert not (harness.package / "models" / "tmp").exists()


@pytest.mark.parametrize(
    "action",
    [
        "IncludeLaunchDescription(get_package_share_directory(name) + '/b.launch.py')",
        "ExecuteProcess(cmd=['ros2', 'launch', name, 'b.launch.py'])",
        "IncludeLaunchDescription(os.environ[name] + '/b.launch.py')",
    ],
)
def test_a_name_that_is_known_in_part_is_not_missing(harness: PythonHarness, action: str) -> None:
    text = f"""
from missing_module import thing
name = f'{{thing}}_description'
def generate_launch_description():
    return LaunchDescription([{action}])
"""
    path = harness.write("launch/a.launch.py", HEAD + text)
    analysis = harness.launch(path)
    assert {finding.rule for finding in analysis.findings} == {"LCH032"}
    assert not analysis.tree.complete


def test_files_that_are_written_into_the_share_folder_are_there(harness: PythonHarness) -> None:
    source = harness.write("urdf/a.urdf.xacro", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="a"/>')
    path = harness.write(
        "launch/a.launch.py",
        f"""
        import os, subprocess
        from launch import LaunchDescription
        from launch_ros.actions import Node

        SOURCE = {str(source)!r}
        FOLDER = os.path.dirname(SOURCE)

        def generate_launch_description():
            made = [os.path.join(FOLDER, f"{{name}}.urdf") for name in ("opened", "option", "shell", "missing")]
            with open(made[0], "w") as file:
                file.write("<robot/>")
            subprocess.run(["xacro", SOURCE, "-o", made[1]], check=True)
            os.system(f"xacro {{SOURCE}} > {{made[2]}}")
            return LaunchDescription([Node(package="p", executable="x", name="n", arguments=made)])
        """,
    )
    findings = [each for each in harness.launch(path).findings if each.rule == "PRM005"]
    assert ["missing.urdf" in each.message for each in findings] == [True]


def test_the_actions_of_ros_gz_are_known_where_they_are_not_installed(harness: PythonHarness) -> None:
    tree = tree_of(
        harness,
        """
from ros_gz_bridge.actions import RosGzBridge
from ros_gz_sim.actions import GzServer

def generate_launch_description():
    return LaunchDescription([
        GzServer(world_sdf_file="/a.sdf"),
        RosGzBridge(bridge_name="b", config_file="/b.yaml", namespace="r", condition=IfCondition("true"),
                    extra_bridge_params={"expand_gz_topic_names": True}),
        RosGzBridge(bridge_name="c", config_file="/c.yaml", condition=IfCondition("false"))])
""",
    )
    assert [node.name for node in tree.nodes] == ["/gzserver", "/r/b"]
    assert [(param.name, param.value) for param in tree.nodes[1].params] == [("config_file", "/b.yaml")]


PAL = """
from dataclasses import dataclass
from launch_pal.actions import CheckPublicSim
from launch_pal.arg_utils import LaunchArgumentsBase, read_launch_argument
from launch_pal.composition_utils import generate_component_list
from launch_pal.include_utils import include_scoped_launch_py_description
from launch_pal.param_utils import merge_param_files, parse_parametric_yaml
from launch_pal.robot_arguments import CommonArgs, RobotArgs

SHARE = get_package_share_directory("p")


@dataclass(frozen=True)
class Arguments(LaunchArgumentsBase):
    side: DeclareLaunchArgument = DeclareLaunchArgument("side", default_value="left")
    robot_name: DeclareLaunchArgument = CommonArgs.robot_name
    laser_model: DeclareLaunchArgument = RobotArgs.laser_model


def start(context):
    name = read_launch_argument("robot_name", context)
    files = [os.path.join(SHARE, each) for each in ("a.yaml", "b.yaml")]
    params = [merge_param_files(files), parse_parametric_yaml([os.path.join(SHARE, "c.yaml")], {"RATE": 4})]
    return [Node(package="p", executable="x", name=name, parameters=params)]


def generate_launch_description():
    description = LaunchDescription()
    Arguments().add_to_launch_description(description)
    description.add_action(CheckPublicSim())
    description.add_action(OpaqueFunction(function=start))
    description.add_action(
        include_scoped_launch_py_description(
            "p",
            ["launch", "inner.launch.py"],
            launch_arguments={"of": Arguments.side, "where": PathJoinSubstitution(["a", LaunchConfiguration("side")])},
            namespace="robot",
        )
    )
    components = generate_component_list(os.path.join(SHARE, "d.yaml"), "cams")
    description.add_action(
        ComposableNodeContainer(
            package="rclcpp_components", executable="component_container", name="c", namespace="",
            composable_node_descriptions=components)
    )
    return description
"""
PAL_INNER = """
def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("of"), DeclareLaunchArgument("where"),
        Node(package="p", executable="x", name=[LaunchConfiguration("of"), "_arm"],
             arguments=[LaunchConfiguration("where")])])
"""


def test_launch_pal_is_known_where_it_is_not_installed(harness: PythonHarness) -> None:
    harness.write("a.yaml", "tiago: {ros__parameters: {speed: 1, turn: 2}}\n")
    harness.write("b.yaml", "tiago: {ros__parameters: {speed: 3}}\n")
    harness.write("c.yaml", "tiago: {ros__parameters: {rate: ${RATE}, size: ${SIZE|7}}}\n")
    harness.write("d.yaml", "components: {cam: {package: p, type: Cam, ros__parameters: {fps: 5}}}\n")
    harness.write("launch/inner.launch.py", HEAD + PAL_INNER)
    analysis = harness.launch(
        harness.write("launch/a.launch.py", HEAD + PAL), {"robot_name": "tiago", "laser_model": "sick"}
    )
    tree = analysis.tree
    assert [p.kind for p in tree.problems] == []
    assert names(tree) == ["/tiago", "/robot/left_arm", "/c", "/cams/cam"]
    assert {p.name: p.value for p in tree.nodes[0].params} == {"speed": 3, "turn": 2, "rate": 4, "size": 7}
    assert tree.nodes[1].args.split()[0] == "a/left"
    assert (tree.nodes[3].plugin, [(p.name, p.value) for p in tree.nodes[3].params]) == ("p::Cam", [("fps", 5)])
    assert tree.args["laser_model"].value == "sick"


AGAIN = """
import json, tempfile, yaml

def again(data, package):
    with tempfile.NamedTemporaryFile("w", delete=False) as file:
        package.dump(data, file)
    with open(file.name) as file:
        return package.load(file, yaml.FullLoader) if package is yaml else package.load(file)

def keys(data, package):
    return list(again(data, package).keys())
"""


def test_a_file_with_nothing_but_something_unknown_is_an_unknown_document(harness: PythonHarness) -> None:
    harness.write("p/__init__.py", "")
    harness.write("p/again.py", AGAIN)
    tree = tree_of(
        harness,
        """
import json, yaml
from p.again import keys

def generate_launch_description():
    share = get_package_share_directory("not_here")
    with open(os.path.join(share, "params.yaml")) as file:
        data = yaml.safe_load(file)
    keys(data, yaml), keys(data, json)
    return LaunchDescription([Node(package="p", executable="x", name="n")])
""",
    )
    assert "AttributeError" not in {each.what for each in tree.unknowns}
    assert names(tree) == ["/n"]


IMPORTS = {
    "from launch.actions import Node": (
        "cannot import name 'Node' from 'launch.actions'; it is in 'launch_ros.actions'",
        "error",
    ),
    "from launch.substitutions import FindPackageShar": (
        "cannot import name 'FindPackageShar' from 'launch.substitutions'; "
        "no launch of Humble, Jazzy, Kilted or Rolling has it",
        "error",
    ),
    "from launch_ros.actions.node import Nodee": (
        "cannot import name 'Nodee' from 'launch_ros.actions.node'; "
        "no launch_ros of Humble, Jazzy, Kilted or Rolling has it",
        "error",
    ),
    "from p.utlis import helper": ("module 'p.utlis' does not exist; did you mean 'p.utils'?", "error"),
    "from p import utlis": ("module 'p.utlis' does not exist; did you mean 'p.utils'?", "error"),
    "import numpyy": ("module 'numpyy' is not known; did you mean 'numpy'?", "warning"),
}


@pytest.mark.parametrize("line", IMPORTS)
def test_an_import_that_no_machine_can_do_is_certain(harness: PythonHarness, line: str) -> None:
    harness.write("setup.py", "from setuptools import setup\nsetup(name='p', packages=['p'])\n")
    harness.write("p/__init__.py", "")
    harness.write("p/utils.py", "def helper(): pass\n")
    text = f"from launch import LaunchDescription\n{line}\n\ndef generate_launch_description():\n    "
    path = harness.write("launch/a.launch.py", f"{text}return LaunchDescription([])\n")
    (finding,) = harness.launch(path).findings
    assert (finding.rule, finding.message, finding.severity) == ("LCH032", *IMPORTS[line])


def test_a_module_of_the_implementation_has_what_it_imports(harness: PythonHarness) -> None:
    """`launch_ros/actions/node.py` imports what others define: no release says that it goes on doing so."""
    names = (
        "launch_ros.actions.node import ExecuteProcess",
        "launch_ros.substitutions.find_package import get_package_share_directory",
        "launch.actions.declare_launch_argument import LaunchContext",
        "launch.frontend.parse_substitution import TextSubstitution",
    )
    lines = "\n".join(f"from {each}" for each in names)
    text = f"from launch import LaunchDescription\n{lines}\n\ndef generate_launch_description():\n    "
    path = harness.write("launch/a.launch.py", f"{text}return LaunchDescription([])\n")
    assert harness.launch(path).findings == ()
