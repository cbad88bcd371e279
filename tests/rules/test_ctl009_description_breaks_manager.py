"""CTL009: a description that gazebo_ros2_control cannot hand to its controller manager."""

from dataclasses import replace

import pytest
from preflight_analysis.rules.registry import run_rules
from support.check import analyse, read_fixture
from support.robot_launch import of_urdf, robot

_URDF = '<link name="base"/><gazebo><plugin name="c" filename="lib{}.so"/></gazebo>\n{}\n'
_LAUNCH = """
    //- /main.launch.xml
    <launch>
      <node pkg="p" exec="rsp" name="rsp">
        <param name="robot_description" value="$(command 'xacro arm')" type="str"/>
      </node>
    </launch>
"""


def _said(comment: str, plugin: str = "gazebo_ros2_control", distro: str | None = "humble") -> list[str]:
    fixture = of_urdf(_URDF.format(plugin, comment), robot(comment), _LAUNCH)
    context = analyse(read_fixture(fixture))
    used = replace(context, environment=replace(context.environment, distro=distro))
    return [each.message for each in run_rules(used) if each.rule == "CTL009"]


@pytest.mark.parametrize(
    ("comment", "sign"), [("<!-- TODO: mass -->", "': '"), ("<!-- wheel #2 -->", "' #'"), ("<!-- note:\n -->", "': '")]
)
def test_what_yaml_reads_otherwise(comment: str, sign: str) -> None:
    line = comment.partition("\n")[0]
    said = [f"gazebo_ros2_control cannot pass on a description with {sign} in it: '{line}'"]
    assert _said(comment) == _said(comment, distro=None) == said


@pytest.mark.silent
def test_what_is_passed_on() -> None:
    assert _said("<!-- TODO mass, http://a.org/b#c -->") == []
    assert _said("<!-- TODO: mass -->", plugin="gz_ros2_control") == []
    assert _said("<!-- TODO: mass -->", distro="jazzy") == []
