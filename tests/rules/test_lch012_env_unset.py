"""LCH012: $(env) of a variable that is not set."""

from pathlib import Path

import pytest
from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.lack import Lack
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import check


def test_an_environment_variable_that_is_not_set() -> None:
    (finding,) = check("""
        <launch>
          <param name="a" value="$(env NOT_SET_ANYWHERE)"/>
                                 ^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH012] 'NOT_SET_ANYWHERE' is not set
        </launch>
    """)
    assert finding.stops_launch
    assert finding.lack == Lack("variable", "NOT_SET_ANYWHERE")


def test_a_slip_of_the_name_of_one_that_is_set(launch: Path) -> None:
    launch.write_text('<launch><param name="a" value="$(env ROBOT_MDOEL)"/></launch>')
    environment = Environment(1, "noetic", {"ROBOT_MODEL": "waffle"}, (), {}, {}, (), (), None)
    (finding,) = Workspace(environment, Sources(), str(launch.parent)).static(str(launch)).findings
    assert (finding.severity, finding.lack) == ("warning", None)
    assert finding.message == "environment variable 'ROBOT_MDOEL' is not set; did you mean 'ROBOT_MODEL'?"
    assert [fix.title for fix in finding.fixes] == ["Replace 'ROBOT_MDOEL' by 'ROBOT_MODEL'"]


@pytest.mark.silent
def test_a_variable_that_need_not_be_set() -> None:
    check("""
        <launch>
          <arg name="more" default="false"/>
          <param name="a" value="$(optenv NOT_SET_ANYWHERE none)"/>
          <param name="b" value="$(env NOT_SET_ANYWHERE)" if="$(arg more)"/>
        </launch>
    """)
