"""ARG005: an argument is declared or passed twice."""

import pytest
from support.check import apply, check


def test_an_argument_declared_twice() -> None:
    (finding,) = check("""
        <launch>
          <arg name="a" default="1"/>
          <arg name="a" default="2"/>
                     ^ error[ARG005] duplicate argument 'a': it is declared twice
          <param name="b" value="$(arg a)"/>
        </launch>
    """)
    assert finding.related[0].message == "declared here"


def test_an_argument_that_is_passed_twice() -> None:
    text = """
        <launch>
          <include file="/inc.launch">
            <arg name="a" value="1"/>
            <arg name="a" value="2"/>
                       ^ error[ARG005] duplicate argument 'a': it is passed twice
          </include>
        </launch>
        //- /inc.launch
        <launch><arg name="a"/><param name="b" value="$(arg a)"/></launch>
    """
    (finding,) = check(text)
    assert finding.related[0].message == "passed here"
    assert 'value="2"' not in apply(text, finding.fixes[0].edits)["/main.launch"]


@pytest.mark.silent
def test_of_two_declarations_under_conditions_one_counts() -> None:
    check("""
        <launch>
          <arg name="real" default="true"/>
          <arg name="a" default="1" if="$(arg real)"/>
          <arg name="a" default="2" unless="$(arg real)"/>
          <param name="b" value="$(arg a)"/>
        </launch>
    """)


def test_a_second_declaration_under_a_condition() -> None:
    check(
        """
        <launch>
          <arg name="side" default=""/>
          <arg name="port" default="0"/>
          <arg name="port" value="2" if="$(eval side == 'rear')"/>
                     ^^^^ error[ARG005] duplicate argument 'port': it is declared twice (if side:=rear)
          <param name="port" value="$(arg port)"/>
        </launch>
        """,
        branches=True,
    )


def test_of_two_declarations_under_conditions_one_counts_whichever_is_taken() -> None:
    check(
        """
        <launch>
          <arg name="sim" default="true"/>
          <arg name="side" default="rear"/>
          <arg name="port" value="1" if="$(arg sim)"/>
          <arg name="port" value="2" unless="$(arg sim)"/>
          <arg name="scan" value="1" if="$(eval side == 'rear')"/>
          <arg name="scan" value="2" if="$(eval side == 'front')"/>
          <arg name="user" value="1" if="$(eval optenv('A', 'x').startswith('y'))"/>
          <arg name="user" value="2" unless="$(eval optenv('A', 'x').startswith('y'))"/>
          <param name="port" value="$(arg port)$(arg scan)$(arg user)"/>
        </launch>
        """,
        branches=True,
    )
