"""Python launch files that raise after a condition that is not known: the other answer is tried."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.evaluation.problems import PythonException, UnsetVariable
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.tracing import run
from support.python_launch_harness import PythonHarness

pytestmark = pytest.mark.ros

HEAD = """\
import os
import sys
from launch import LaunchDescription
from launch.actions import *
from launch.substitutions import *
from launch_ros.actions import *
from ament_index_python.packages import get_package_share_directory


def n(name):
    return Node(package='p', executable='x', name=name)
"""


@pytest.fixture
def harness(tmp_path: Path) -> PythonHarness:
    return PythonHarness(tmp_path)


def _tree(harness: PythonHarness, text: str, **options: object) -> LaunchTree:
    path = harness.write("launch/a.launch.py", HEAD + text)
    return harness.launch(path, **options).tree  # type: ignore[arg-type]


def _raised(tree: LaunchTree) -> list[str]:
    return [p.kind.error for p in tree.problems if isinstance(p.kind, PythonException)]


def test_a_condition_that_is_not_known_gets_the_other_answer(harness: PythonHarness) -> None:
    tree = _tree(
        harness,
        """
import no_such_module

def generate_launch_description():
    model = no_such_module.model()
    if not os.path.isdir(get_package_share_directory('not_here')):
        found = [n('without')]
    elif model == 'a':
        found = [n('a')]
    elif model in ('b', 'c'):
        found = [n('c')]
    else:
        raise ValueError('unknown model')
    if no_such_module.sides() > 2:
        found.append(n('more'))
    else:
        sys.exit('too few')
    return LaunchDescription(found)
""",
    )
    assert [node.name for node in tree.nodes] == ["/c", "/more"]
    assert any(unknown.decides for unknown in tree.unknowns)
    assert not _raised(tree)


def test_in_functions_too(harness: PythonHarness) -> None:
    functions = [
        f"""
def start{number}(context):
    robot = LaunchConfiguration('robot').perform(context)
    if robot not in ('r{number}', 'r9'):
        raise RuntimeError('unknown robot ' + robot)
    return [n('of_{number}')]
"""
        for number in range(3)
    ]
    tree = _tree(
        harness,
        "\n".join(functions)
        + """
def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('robot'), OpaqueFunction(function=start0), OpaqueFunction(function=start1),
        OpaqueFunction(function=start2), n('last')])
""",
    )
    assert [node.name for node in tree.nodes] == ["/of_0", "/of_1", "/of_2", "/last"]


@pytest.mark.parametrize(
    "condition",
    [
        "os.environ.get('ROBOT_MODEL') is None",
        "os.getenv('ROBOT_MODEL') is None",
        "not os.getenv('ROBOT_MODEL', '')",
        "'ROBOT_MODEL' not in os.environ",
    ],
)
def test_a_variable_that_a_file_cannot_do_without(harness: PythonHarness, condition: str) -> None:
    text = f"""
def generate_launch_description():
    if os.environ.get('DEBUGGING') is not None:
        return LaunchDescription([n('debug')])
    if {condition}:
        raise RuntimeError('set ROBOT_MODEL')
    return LaunchDescription([n('one'), Node(package='p', executable='x', name=os.environ['ROBOT_MODEL'])])
"""
    tree = _tree(harness, text)
    assert [p.kind for p in tree.problems] == [UnsetVariable("ROBOT_MODEL")]
    assert "/one" in [node.name for node in tree.nodes]
    tree = _tree(harness, text, variables={"ROBOT_MODEL": "burger"})
    assert [node.name for node in tree.nodes] == ["/one", "/burger"]
    assert tree.complete


def test_several_variables_that_a_file_cannot_do_without(harness: PythonHarness) -> None:
    tree = _tree(
        harness,
        """
def generate_launch_description():
    values = [os.getenv(name) for name in ('ROBOT_HOST', 'ROBOT_PORT', 'ROBOT_USER', 'ROBOT_MODEL', 'ROBOT_WORLD')]
    if not all(values):
        raise ValueError('set all of them')
    return LaunchDescription([n('one')])
""",
    )
    assert [node.name for node in tree.nodes] == ["/one"]
    assert len([p for p in tree.problems if isinstance(p.kind, UnsetVariable)]) == 5


def test_what_raises_in_any_case_is_said_of_the_first_run(harness: PythonHarness) -> None:
    text = """
def generate_launch_description():
    if os.environ.get('ROBOT_MODEL'):
        raise OSError('with it')
    raise ValueError('without it')
"""
    assert _raised(_tree(harness, text)) == ["ValueError"]
    text = """
def generate_launch_description():
    robot = os.environ.get('ROBOT_MODEL')
    return LaunchDescription([n('burger') if robot else misspelt('burger')])
"""
    assert _raised(_tree(harness, text)) == ["NameError"], "no variable of the environment is to blame"


def test_what_does_not_raise_is_run_once(harness: PythonHarness) -> None:
    tree = _tree(
        harness,
        """
def generate_launch_description():
    robot = os.environ.get('ROBOT_MODEL')
    return LaunchDescription([n('one') if robot is None else n('two')])
""",
    )
    assert [node.name for node in tree.nodes] == ["/one"]
    assert tree.complete


def test_trying_has_an_end(harness: PythonHarness) -> None:
    tree = _tree(
        harness,
        """
import no_such_module

def generate_launch_description():
    open('/tmp/written', 'w').close()
    while True:
        for number in range(2000):
            if no_such_module.value() == number:
                raise RuntimeError('it is')
        if no_such_module.ready():
            raise SystemError('no')
""",
    )
    assert not tree.complete
    assert not _raised(tree), "it comes of what is not known"


@pytest.mark.parametrize(("otherwise", "names"), [("return LaunchDescription([n('one')])", ["/one"]), ("pass", None)])
def test_a_try_that_does_not_end_is_given_up(harness: PythonHarness, otherwise: str, names: list[str] | None) -> None:
    tree = _tree(
        harness,
        f"""
import threading
import no_such_module

def generate_launch_description():
    if no_such_module.is_ready():
        raise ValueError('it is')
    if no_such_module.answer() == 'yes':
        {otherwise}
    threading.Event().wait(100)
""",
    )
    if names is None:
        assert "ValueError" in {unknown.what for unknown in tree.unknowns}, "the first run told"
    else:
        assert [node.name for node in tree.nodes] == names


def test_a_try_has_the_time_that_the_first_run_took(harness: PythonHarness) -> None:
    """As of a file that imports much."""
    tree = _tree(
        harness,
        """
import threading
import no_such_module
threading.Event().wait(2.5)

def generate_launch_description():
    if no_such_module.is_ready():
        raise ValueError('it is')
    return LaunchDescription([n('one')])
""",
    )
    assert [node.name for node in tree.nodes] == ["/one"]


STARVED = """
import signal
import time

def starve(seconds):
    os.sched_setaffinity(0, [min(os.sched_getaffinity(0))])
    others = []
    for _ in range(9):
        others.append(os.fork())
        if not others[-1]:
            while True:
                pass
    while time.process_time() < seconds:
        pass
    for other in others:
        os.kill(other, signal.SIGKILL)
    for other in others:  # only now: waiting for one while the rest goes on is time of the run's own
        os.waitpid(other, 0)
"""


def test_a_busy_machine_takes_no_try_away(harness: PythonHarness) -> None:
    tree = _tree(
        harness,
        STARVED
        + """
import no_such_module

def generate_launch_description():
    if no_such_module.is_ready():
        raise ValueError('it is')
    starve(time.process_time() + 0.3)
    return LaunchDescription([n('one')])
""",
    )
    assert [node.name for node in tree.nodes] == ["/one"]


def test_a_busy_machine_takes_no_time_from_a_run(harness: PythonHarness, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run, "COMMAND_SECONDS", 3.0)
    tree = _tree(
        harness,
        STARVED
        + """
def generate_launch_description():
    starve(time.process_time() + 0.5)  # five seconds, as one of ten at a processor
    return LaunchDescription([n('one')])
""",
    )
    assert [node.name for node in tree.nodes] == ["/one"]


NASTY = {
    "it starts other programs": "os.execve = os.memfd_create = None",
    "it names another program": "sys.orig_argv = ['/no/such/program']; sys.executable = '/no/such/program'",
    "its folder is gone": "os.makedirs('/tmp/gone'); os.chdir('/tmp/gone'); os.rmdir('/tmp/gone')",
    "a thread goes on": "import threading; threading.Thread(target=__import__('time').sleep, args=[3]).start()",
    "it says what was answered": "os.environ['PREFLIGHT_ANSWERS'] = 'x'",
}


@pytest.mark.parametrize("before", NASTY.values(), ids=NASTY.keys())
def test_whatever_a_file_does_there_is_an_answer(harness: PythonHarness, before: str) -> None:
    tree = _tree(
        harness,
        f"""
import no_such_module
{before}

def generate_launch_description():
    if no_such_module.is_ready():
        raise ValueError('it is')
    return LaunchDescription([n('one')])
""",
    )
    assert [node.name for node in tree.nodes] == ["/one"] or "ValueError" in {each.what for each in tree.unknowns}


@pytest.mark.parametrize(
    "looked_for",
    [
        "dict(context.launch_configurations.get('of_the_vehicle', {}))",
        "context.launch_configurations['of_the_vehicle']",
        "context.launch_configurations['of_the_vehicle'] if 'of_the_vehicle' in context.launch_configurations else {}",
    ],
)
def test_a_configuration_that_an_includer_sets(harness: PythonHarness, looked_for: str) -> None:
    tree = _tree(
        harness,
        f"""
def start(context):
    vehicle = {looked_for}
    return [Node(package='p', executable='x', name='one', parameters=[{{'length': vehicle['front'] + 1, 'a': 5}}])]

def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=start)])
""",
    )
    assert [node.name for node in tree.nodes] == ["/one"]
    assert [(param.name, param.value) for param in tree.nodes[0].params] == [("a", 5)]
    assert not _raised(tree)
    assert not tree.complete


def test_a_configuration_that_a_file_can_do_without_is_not_set(harness: PythonHarness) -> None:
    tree = _tree(
        harness,
        """
def start(context):
    name = context.launch_configurations.get('no_such', 'default')
    if 'no_such' in context.launch_configurations or context.launch_configurations.get('no_such'):
        name = 'wrong'
    return [n(name)]

def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=start)])
""",
    )
    assert [node.name for node in tree.nodes] == ["/default"]


def test_a_list_that_is_asked_whether_it_is_one(harness: PythonHarness) -> None:
    tree = _tree(
        harness,
        """
import yaml

def start(context):
    cameras = yaml.safe_load(LaunchConfiguration('cameras').perform(context))
    if not isinstance(cameras, list):
        raise ValueError('no list')
    return [n('one')] if all(isinstance(each, str) for each in cameras) else []

def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument('cameras'), OpaqueFunction(function=start)])
""",
    )
    assert [node.name for node in tree.nodes] == ["/one"]
    assert not _raised(tree)
    assert any(unknown.decides for unknown in tree.unknowns)


def test_a_name_that_a_branch_sets(harness: PythonHarness) -> None:
    tree = _tree(
        harness,
        """
MODEL = os.environ['NOT_SET_ANYWHERE']
if MODEL == 'a':
    name = 'of_a'
elif MODEL == 'b':
    name = 'of_b'

def generate_launch_description():
    return LaunchDescription([n(name)])
""",
    )
    assert [node.name for node in tree.nodes] == ["/of_b"]
    assert not _raised(tree)
