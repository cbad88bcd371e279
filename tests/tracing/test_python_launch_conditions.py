"""Python launch files: a condition that is not known is said, and what depends on it is not claimed to be certain."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.workspace.workspace import Analysis
from support.python_launch_harness import PythonHarness

pytestmark = pytest.mark.ros

HEAD = """\
import os
from launch import LaunchDescription, Substitution
from launch.actions import *
from launch.conditions import IfCondition
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.descriptions import ParameterFile
from ament_index_python.packages import get_package_share_directory


def n(name):
    return Node(package='p', executable='x', name=name)
"""


@pytest.fixture
def harness(tmp_path: Path) -> PythonHarness:
    return PythonHarness(tmp_path)


def _launched(harness: PythonHarness, text: str) -> tuple[Path, Analysis]:
    path = harness.write("launch/a.launch.py", HEAD + text)
    return path, harness.launch(path)


def _guessed(path: Path, analysis: Analysis) -> list[str]:
    """The lines where a condition is not known."""
    text = path.read_text()
    places = [unknown.location.span for unknown in analysis.tree.unknowns if unknown.decides]
    return [text[place.start : place.end] for place in places]


def _confidence(analysis: Analysis) -> set[str]:
    """That of the finding of the argument that is not declared."""
    return {finding.confidence for finding in analysis.findings if "'undeclared'" in finding.message}


CONDITIONS = {
    "a stand-in": ("import no_such_module as unknown", "if unknown.is_real():"),
    "a comparison of it": ("import no_such_module as unknown", "if unknown.LEVEL > 2:"),
    "whether it equals": ("import no_such_module as unknown", "if unknown.robot() == 'r1':"),
    "an item of it": ("import no_such_module as unknown", "if 'r1' in unknown.robots():"),
    "a variable": ("unknown = os.environ['NOT_SET_ANYWHERE']", "if unknown == 'r1':"),
    "what is made of one": ("unknown = os.environ['NOT_SET_ANYWHERE']", "if ('/' + unknown).strip().lower() == 'r1':"),
    "a part of one": ("unknown = os.environ['NOT_SET_ANYWHERE']", "if unknown.startswith('r'):"),
    "a file": ("unknown = get_package_share_directory('not_here')", "if os.path.isfile(unknown + '/a.yaml'):"),
}


@pytest.mark.parametrize(("before", "condition"), CONDITIONS.values(), ids=CONDITIONS.keys())
def test_a_condition_that_is_not_known_is_said_at_its_line(harness: PythonHarness, before: str, condition: str) -> None:
    text = f"""
def generate_launch_description():
    {before}
    found = [n('always')]
    {condition}
        found.append(n('one'))
    else:
        found.append(n('other'))
    return LaunchDescription([*found, n(LaunchConfiguration('undeclared'))])
"""
    path, analysis = _launched(harness, text)
    assert _guessed(path, analysis) == [condition]
    assert not analysis.tree.complete
    names = [node.name for node in analysis.tree.nodes]
    assert "/always" in names
    assert ("/one" in names) != ("/other" in names)
    assert _confidence(analysis) == {"likely"}


def test_one_that_is_known_is_not(harness: PythonHarness) -> None:
    text = """
def generate_launch_description():
    import no_such_module
    share = get_package_share_directory('not_here')
    found = []
    if os.environ.get('NOT_SET_ANYWHERE') == 'r1':
        found.append(n('one'))
    if os.path.isfile('/no/such/file') or share is None:
        found.append(n('other'))
    return LaunchDescription([
        n(os.path.join('r1', no_such_module.NAME)), *found, n('always'), n(LaunchConfiguration('undeclared'))
    ])
"""
    path, analysis = _launched(harness, text)
    assert _guessed(path, analysis) == []
    assert "/always" in [node.name for node in analysis.tree.nodes]
    assert _confidence(analysis) == {"certain"}


OWN = """
class IsRobot(Substitution):
    def perform(self, context):
        return 'True' if LaunchConfiguration('robot').perform(context) in ('r1', 'r2') else 'False'


def setup(context):
    if LaunchConfiguration('robot').perform(context) == 'r1':
        return [n('one')]
    return [n('other')]


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('robot', default_value=VALUE),
        Node(package='p', executable='x', name='own', condition=IfCondition(IsRobot())),
        OpaqueFunction(function=setup),
    ])
"""


def test_own_code_that_asks_for_what_is_not_known(harness: PythonHarness) -> None:
    path, analysis = _launched(harness, OWN.replace("VALUE", "EnvironmentVariable('NOT_SET_ANYWHERE')"))
    assert "/own" not in [node.name for node in analysis.tree.nodes], "'False' is not what it gives for certain"
    assert any("IfCondition" in unknown.reason or "condition" in unknown.reason for unknown in analysis.tree.unknowns)
    assert "if LaunchConfiguration('robot').perform(context) == 'r1':" in _guessed(path, analysis)
    path, analysis = _launched(harness, OWN.replace("VALUE", "'r1'"))
    assert [node.name for node in analysis.tree.nodes] == ["/own", "/one"]
    assert _guessed(path, analysis) == []


def test_what_a_text_that_is_not_known_is_written_into_stays(harness: PythonHarness) -> None:
    text = """
import tempfile
import yaml


class Rewritten(Substitution):
    def perform(self, context):
        robot = LaunchConfiguration('robot').perform(context)
        value = True if robot.lower() == 'true' else robot
        with tempfile.NamedTemporaryFile('w', delete=False) as file:
            yaml.dump({'n': {'ros__parameters': {'rate': 5, 'robot': value}}}, file)
        return file.name


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('robot', default_value=EnvironmentVariable('NOT_SET_ANYWHERE')),
        Node(package='p', executable='x', name='n', parameters=[ParameterFile(Rewritten(), allow_substs=True)]),
    ])
"""
    _, analysis = _launched(harness, text)
    (node,) = analysis.tree.nodes
    assert {param.name: param.value for param in node.params}["rate"] == 5


def test_a_question_that_is_asked_until_it_is_answered_has_an_end(harness: PythonHarness) -> None:
    text = """
def generate_launch_description():
    robot = ''
    while robot != '1' and robot != '2':
        print('1: one robot, 2: two robots')
        robot = input('Please select: ')
    return LaunchDescription([n('always'), n('robot_' + robot)])
"""
    path, analysis = _launched(harness, text)
    assert "/always" in [node.name for node in analysis.tree.nodes]
    assert _guessed(path, analysis) == ["while robot != '1' and robot != '2':"]


def test_the_distribution_is_there_whatever_it_is(harness: PythonHarness) -> None:
    """`ros2 launch` runs where one is sourced."""
    text = """
def generate_launch_description():
    old = os.environ.get('ROS_DISTRO')[0] <= 'e'
    return LaunchDescription([n('old' if old else 'new')])
"""
    path = harness.write("launch/a.launch.py", HEAD + text)
    known = harness.launch(path)
    assert [node.name for node in known.tree.nodes] == ["/new"]
    assert _guessed(path, known) == []
    none = harness.launch(path, variables={"ROS_DISTRO": ""})
    assert [node.name for node in none.tree.nodes] == ["/new"]
    assert _guessed(path, none) == []


@pytest.mark.parametrize(
    ("condition", "value", "rules"),
    [
        ("PythonExpression(['\"\" != \"', sensor, '\"'])", "sensor", []),
        ("LaunchConfiguration('on')", "'s3'", ["ARG009"]),
    ],
)
def test_a_value_may_be_made_of_the_same_as_the_condition(
    harness: PythonHarness, condition: str, value: str, rules: list[str]
) -> None:
    harness.write(
        "launch/b.launch.xml",
        '<launch><arg name="sensor"><choice value="a1"/></arg><log message="$(var sensor)"/></launch>',
    )
    _, analysis = _launched(
        harness,
        f"""\
def generate_launch_description():
    sensor = os.environ.get('SENSOR', '')
    inner = IncludeLaunchDescription(
        os.path.dirname(__file__) + '/b.launch.xml',
        condition=IfCondition({condition}),
        launch_arguments={{'sensor': {value}}}.items(),
    )
    return LaunchDescription([DeclareLaunchArgument('on', default_value='false'), inner])
""",
    )
    assert harness.workspace is not None
    assert [finding.rule for finding, _ in harness.workspace.branches(analysis).findings] == rules
