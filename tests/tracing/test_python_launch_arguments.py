"""Arguments that are passed to a Python launch file with code of its own: what no text in the code can name has no
effect."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.evaluation.problems import UnknownIncludeArgument, UnknownLaunchArgument
from support.python_launch_harness import PythonHarness

pytestmark = pytest.mark.ros

INCLUDED = """\
{imports}
from launch import LaunchDescription
from launch.actions import *
from launch.substitutions import *
from launch_ros.actions import *


def start(context, *arguments):
{code}
    return [Node(package='p', executable='x', name='sensor', arguments=[LaunchConfiguration('sensor_ip')])]


def generate_launch_description():
    found = []

    def add(name, value=None):
        found.append(DeclareLaunchArgument(name, default_value=value))

    add('sensor_ip', '10.0.0.1')
    return LaunchDescription([*found, OpaqueFunction(function=start)])
"""
ROOT = """\
<launch>
  <include file="$(dirname)/sensor.launch.py">
    <arg name="device_ip" value="10.0.0.7"/>
    <arg name="sensor_ip" value="10.0.0.7"/>
  </include>
</launch>
"""


def _unknown(folder: Path, code: str = "pass", imports: str = "") -> list[tuple[str, tuple[str, ...]]]:
    harness = PythonHarness(folder)
    harness.write("launch/sensor.launch.py", INCLUDED.format(code=f"    {code}", imports=imports))
    tree = harness.launch(harness.write("launch/root.launch.xml", ROOT)).tree
    assert [node.name for node in tree.nodes] == ["/sensor"]
    return [(p.kind.name, p.kind.declared) for p in tree.problems if isinstance(p.kind, UnknownIncludeArgument)]


def test_what_no_code_names_has_no_effect(tmp_path: Path) -> None:
    assert _unknown(tmp_path) == [("device_ip", ("sensor_ip",))]


SILENT = {
    "it names it": "LaunchConfiguration('device_ip').perform(context)",
    "it names it where it does not get": "\n    if len(arguments) > 3: LaunchConfiguration('device_ip')",
    "a name is put together": "LaunchConfiguration(f'{\"device\"}_ip', default='').perform(context)",
    "by format": "LaunchConfiguration('{}_ip'.format('device'), default='').perform(context)",
    "by percent": "LaunchConfiguration('%s_ip' % 'device', default='').perform(context)",
    "by adding": "LaunchConfiguration('dev' + 'ice' + '_ip', default='').perform(context)",
    "of two that are not known": "LaunchConfiguration(f'{\"device\"}{\"_ip\"}', default='').perform(context)",
    "all at once": "dict(context.launch_configurations)",
    "another file, not this time": "\n    if len(arguments) > 3: IncludeLaunchDescription('other.launch.py')",
}


@pytest.mark.parametrize("code", SILENT.values(), ids=SILENT.keys())
@pytest.mark.silent
def test_what_code_may_name_may_have_an_effect(tmp_path: Path, code: str) -> None:
    assert not _unknown(tmp_path, code)


@pytest.mark.silent
def test_what_modules_of_others_name_is_not_known(tmp_path: Path) -> None:
    (tmp_path / "src/p/p").mkdir(parents=True)
    (tmp_path / "src/p/p/__init__.py").write_text("")
    assert not _unknown(tmp_path, imports="try:\n    import p.helpers\nexcept ImportError:\n    pass")


def test_the_same_on_the_command_line(tmp_path: Path) -> None:
    harness = PythonHarness(tmp_path)
    path = harness.write("launch/sensor.launch.py", INCLUDED.format(code="    pass", imports=""))
    problems = harness.launch(path, {"device_ip": "1", "sensor_ip": "2"}).tree.problems
    assert [p.kind.name for p in problems if isinstance(p.kind, UnknownLaunchArgument)] == ["device_ip"]
