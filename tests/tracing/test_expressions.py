"""Expressions of ROS 2 launch files: each as `eval` has it, by our own evaluator or in the sandbox."""

from __future__ import annotations

import json
import textwrap
from pathlib import Path
from xml.sax.saxutils import quoteattr

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.commands import CommandCache, CommandRunner
from preflight_analysis.workspace.commands import CommandResults
from preflight_analysis.workspace.resolve_commands import Resolving, resolve_commands
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace

pytestmark = pytest.mark.ros

EXPRESSIONS = {
    "list(set('ndt_gnss'.split('_')).intersection(['ndt', 'yabloc']))": "['ndt']",
    "'/home/me/my__robot' != ''": "True",
    "[n for n in (1, 2) if n > 1]": "[2]",
    "f'{1 + 1}'": "2",
    "isinstance('a', str)": "True",
    "(lambda: 'a')()": "a",
    "'a.b'.encode()": "b'a.b'",
    "math.cos(0) + pi - math.pi": "1.0",
    "'math.pi'": "math.pi",
    "True and not False": "True",
    "__import__('os').sep": "/",
}
FAILING = {
    "true and 1": "name 'true' is not defined",
    "1 if false else 2": "name 'false' is not defined",
    "math.tau2": "module 'math' has no attribute 'tau2'",
    "[true for n in (1,)]": "name 'true' is not defined",
    "set(1)": "'int' object is not iterable",
}


def xml(expression: str) -> str:
    return f"<launch><let name='v' value={quoteattr(f'$(eval {json.dumps(expression)})')}/>{NODE}</launch>"


NODE = '<node pkg="p" exec="e" name="n" args="$(var v)"/>'
PYTHON = """
from launch import LaunchDescription
from launch.substitutions import PythonExpression
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([Node(package="p", executable="e", name="n", arguments=[PythonExpression([{!r}])])])
"""


class Harness:
    """A folder for launch files."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.cache = CommandCache(folder / "cache")

    def launch(
        self, text: str, name: str = "a.launch.xml", distro: str = "jazzy", why_not: str | None = None
    ) -> Analysis:
        path = self.folder / name
        path.write_text(textwrap.dedent(text))
        variables = {"PATH": "/usr/bin:/bin", "ROS_DISTRO": distro, "ROS_VERSION": "2"}
        environment = detect_environment(None, variables, [])
        results = CommandResults(lambda: why_not)
        workspace = Workspace(environment, Sources(), str(self.folder), results)
        if why_not is not None:
            return workspace.static(str(path))
        runner = CommandRunner(environment, str(self.folder), self.cache)
        return resolve_commands(workspace, str(path), {}, Resolving(results, runner))


@pytest.fixture
def harness(tmp_path: Path) -> Harness:
    return Harness(tmp_path)


def args(analysis: Analysis) -> list[str]:
    return [node.args for node in analysis.tree.nodes]


def told(analysis: Analysis) -> list[tuple[str, str]]:
    return [(f.rule, f.message.rpartition(": ")[2]) for f in analysis.findings if f.rule.startswith("LCH")]


def test_in_xml(harness: Harness) -> None:
    for expression, value in EXPRESSIONS.items():
        analysis = harness.launch(xml(expression))
        assert (args(analysis), told(analysis)) == ([value], []), expression


def test_in_python(harness: Harness) -> None:
    for expression, value in EXPRESSIONS.items():
        analysis = harness.launch(PYTHON.format(expression), "a.launch.py")
        assert (args(analysis), told(analysis)) == ([value], []), expression


def test_what_fails_is_an_error(harness: Harness) -> None:
    for expression, message in FAILING.items():
        analysis = harness.launch(xml(expression))
        assert told(analysis) == [("LCH011", message)], expression
        assert analysis.findings[0].stops_launch


def test_modules(harness: Harness) -> None:
    text = """<launch><node pkg="p" exec="e" args="$(eval 'os.sep' 'os')"/></launch>"""
    assert args(harness.launch(text)) == ["/"]
    assert told(harness.launch(text.replace("os.sep", "pi"))) == [("LCH011", "name 'pi' is not defined")]
    assert told(harness.launch(text, distro="humble")) == [("LCH011", "$(eval) takes 1 argument in ROS 2 humble")]
    of_math = """<launch><node pkg="p" exec="e" args="$(eval 'math.floor(1.5)')"/></launch>"""
    assert args(harness.launch(of_math)) == ["1"]
    assert told(harness.launch(of_math, distro="humble")) == [("LCH011", "name 'math' is not defined")]
    assert args(harness.launch(of_math.replace("math.", ""), distro="humble")) == ["1"]


def test_where_nothing_is_run_it_is_said(harness: Harness) -> None:
    analysis = harness.launch(xml("set()"), why_not="nobody trusts it")
    assert told(analysis) == [("LCH018", "nobody trusts it")]
    assert analysis.findings[0].severity == "info"


def test_what_the_machine_lacks_is_no_error_of_the_file(harness: Harness) -> None:
    analysis = harness.launch(xml("open('/nowhere').read()"))
    assert [(f.rule, f.severity) for f in analysis.findings if f.rule.startswith("LCH")] == [("LCH018", "info")]
    text = """<launch><node pkg="p" exec="e" args="$(eval '1' 'no_such_module')"/></launch>"""
    assert [rule for rule, _ in told(harness.launch(text))] == ["LCH018"]
