"""LCH015: files that include each other."""

import pytest
from support.check import check, findings_of


def test_a_file_that_includes_itself() -> None:
    findings = findings_of("""
        <launch><include file="/inc.launch"/></launch>
        //- /inc.launch
        <launch><include file="/main.launch"/></launch>
    """)
    (finding,) = findings
    assert (finding.rule, finding.severity) == ("LCH015", "error")
    assert "/main.launch -> /inc.launch -> /main.launch" in finding.message


@pytest.mark.silent
def test_a_file_that_is_included_twice_or_ends_the_circle_by_a_condition() -> None:
    check("""
        <launch>
          <arg name="deeper" default="true"/>
          <include file="/inc.launch"/>
          <include file="/inc.launch"/>
          <include file="/main.launch" if="$(arg deeper)"><arg name="deeper" value="false"/></include>
        </launch>
        //- /inc.launch
        <launch/>
    """)
