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
