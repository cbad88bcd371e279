"""PRM004: parameters that are not valid YAML."""

import pytest
from support.check import check, findings_of


def test_parameters_that_are_not_yaml() -> None:
    findings = findings_of("<launch><rosparam>{a: [1}</rosparam></launch>")
    assert [finding.rule for finding in findings] == ["PRM004"]
    assert check("<launch><rosparam>{a: [1]}</rosparam></launch>") == []


@pytest.mark.silent
def test_parameters_that_are_yaml() -> None:
    check("""
        <launch>
          <rosparam>{a: [1], b: !!float 2, c: ~}</rosparam>
          <rosparam file="/a.yaml"/>
          <rosparam param="d">text</rosparam>
        </launch>
        //- /a.yaml
        # only a comment
    """)


@pytest.mark.silent
def test_a_tab_before_a_comment_is_a_blank_to_rcl() -> None:
    check(
        """
        //- /main.launch.xml
        <launch><node pkg="p" exec="t" name="n"><param from="/p/a.yaml"/></node></launch>
        //- /p/a.yaml
        n:
          ros__parameters:
            rate: 10 TAB # Hz
            name: a
    """.replace("TAB", "\t")
    )


SEVERAL = """
        //- /p/a.yaml
        --- # of the driver
        n:
          ros__parameters:
            rate: 10
        ---
        m:
          ros__parameters:
            rate: 20
"""


@pytest.mark.silent
def test_several_documents_are_one_to_rcl() -> None:
    check(
        """
        //- /main.launch.xml
        <launch>
          <node pkg="p" exec="t" name="n"><param from="/p/a.yaml"/></node>
          <node pkg="p" exec="t" name="m"><param from="/p/a.yaml"/></node>
        </launch>"""
        + SEVERAL
    )


def test_several_documents_are_none_to_launch() -> None:
    """It reads the files of components itself."""
    findings = findings_of(
        """
        //- /main.launch.xml
        <launch>
          <node_container pkg="rclcpp_components" exec="component_container" name="c" namespace="">
            <composable_node pkg="p" plugin="p::N" name="n"><param from="/p/a.yaml"/></composable_node>
          </node_container>
        </launch>"""
        + SEVERAL
    )
    (found,) = (each for each in findings if each.rule == "PRM004")
    assert (found.severity, found.location.file) == ("error", "/p/a.yaml")
