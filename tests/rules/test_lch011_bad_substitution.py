"""LCH011: a substitution that cannot be made."""

import pytest
from support.check import check


def test_a_substitution_that_cannot_be_made() -> None:
    check("""
        <launch>
          <arg name="rate" default="1"/>
          <param name="c" value="$(arg rate)"/>
          <param name="a" value="$(args rate)"/>
                                 ^^^^^^^^^^^^ error[LCH011]
          <param name="b" value="$(eval 1 / 0)"/>
                                 ^^^^^^^^^^^^^ error[LCH011] $(eval 1 / 0) fails
        </launch>
    """)


def test_substitutions_of_python() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
        <log message="$(FindPackage p)"/>
                      ^^^^^^^^^^^^^^^^ error[LCH011] 'FindPackage' is not a substitution; did you mean 'find-pkg-share'?
        <log message="$(PythonExpression 1)"/>
                      ^^^^^^^^^^^^^^^^^^^^^ error[LCH011] 'PythonExpression' is not a substitution; did you mean 'eval'?
        </launch>
    """)


def test_substitutions_of_ros1() -> None:
    check("""
        //- /robot.launch.yaml
        launch:
          - include: {file: $(find p)/base.launch.xml}
                            ^^^^^^^^^ error[LCH011] 'find' is not a substitution; did you mean 'find-pkg-share'?
        //- /p/base.launch.xml
        <launch/>
    """)


def test_substitutions_that_launch_cannot_read() -> None:
    check("""
        //- /a.launch.xml
        <launch>
          <log message="$(any true false)"/>
                        ^^^^^^^^^^^^^^^^^ error[LCH011] launch cannot read $(any ...) in XML and YAML files: write $(or ...)
          <log message="$(or true false)"/>
        </launch>
    """)  # noqa: E501


@pytest.mark.silent
def test_substitutions_that_can_be_made() -> None:
    check("""
        <launch>
          <arg name="a" default="2"/>
          <param name="half" value="$(eval 1 / arg('a'))"/>
          <param name="folder" value="$(find p) $(dirname) $(optenv NOT_SET_ANYWHERE none)"/>
          <param name="shell" value="$HOME"/>
        </launch>
    """)


def test_a_parameter_that_nothing_sets() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <set_parameter name="height" value="2"/>
          <log message="$(param height)"/>
          <log message="$(param width)"/>
                        ^^^^^^^^^^^^^^ error[LCH011] parameter 'width' is not set: no <set_parameter> before this line
        </launch>
    """)


def test_a_parameter_that_the_file_which_includes_this_one_may_set() -> None:
    check("""
        //- /part.launch.xml
        <launch>
          <arg name="container"/>
          ^^^^^^^^^^^^^^^^^^^^^^^ info[ARG003] argument 'container' has no default
          <log message="$(param width)"/>
                        ^^^^^^^^^^^^^^ info[LCH011] parameter 'width' is not set: no <set_parameter> before this line;
        </launch>
    """)


def test_a_parameter_that_a_file_which_cannot_be_read_may_set() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <group>
            <include file="/gone.launch.py"/>
                           ^^^^^^^^^^^^^^^ error[LCH013]
            <log message="$(param width)"/>
                          ^^^^^^^^^^^^^^ hint[LCH011] parameter 'width' is not set, unless the unresolved include sets
          </group>
          <log message="$(param width)"/>
                        ^^^^^^^^^^^^^^ error[LCH011] parameter 'width' is not set: no <set_parameter> before this line
        </launch>
    """)
