"""ARG002: an include does not pass an argument that the file requires."""

import pytest
from support.check import apply, check


def test_a_required_argument_that_is_not_passed() -> None:
    check("""
        <launch>
          <include file="/inc.launch"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[ARG002] required argument 'serial' of '/inc.launch' is not passed
        </launch>
        //- /inc.launch
        <launch><arg name="serial"/><param name="a" value="$(arg serial)"/></launch>
    """)


def test_a_required_argument_is_passed_by_a_fix() -> None:
    text = """
        <launch>
          <arg name="serial" default="7"/>
          <param name="a" value="$(arg serial)"/>
          <include file="/inc.launch"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[ARG002] required argument 'serial' of '/inc.launch' is not passed
        </launch>
        //- /inc.launch
        <launch><arg name="serial"/><param name="a" value="$(arg serial)"/></launch>
    """
    (finding,) = check(text)
    assert finding.fixes[0].preferred
    changed = apply(text, finding.fixes[0].edits)["/main.launch"]
    assert '<include file="/inc.launch">\n    <arg name="serial" value="$(arg serial)"/>\n  </include>' in changed
    unknown = text.replace('name="serial" default', 'name="other" default').replace(
        '"a" value="$(arg serial)', '"a" value="$(arg other)', 1
    )
    (finding,) = check(unknown)
    assert finding.fixes == ()  # an empty value would start a robot without one


def test_a_required_argument_counts_only_where_the_include_passes_it() -> None:
    """launch looks at what the include itself passes, whatever is set already."""
    check("""
        //- /robot.launch.xml
        <launch>
          <let name="serial" value="7"/>
          <include file="/camera.launch.xml"/>
                         ^^^^^^^^^^^^^^^^^^ error[ARG002] required argument 'serial' of '/camera.launch.xml' is not
          <include file="/camera.launch.xml"><arg name="serial" value="8"/></include>
        </launch>
        //- /camera.launch.xml
        <launch>
          <arg name="serial"/>
          <node pkg="p" exec="camera" name="camera_$(var serial)"/>
        </launch>
    """)


@pytest.mark.silent
def test_arguments_that_are_passed_or_have_a_default() -> None:
    check("""
        <launch>
          <arg name="more" default="false"/>
          <include file="/inc.launch"><arg name="rate" value="1"/></include>
          <include file="/inc.launch" if="$(arg more)"/>
        </launch>
        //- /inc.launch
        <launch>
          <arg name="rate"/>
          <arg name="mode" default="slow"/>
          <param name="mode" value="$(arg mode) $(arg rate)"/>
        </launch>
    """)


def test_what_the_command_line_can_give() -> None:
    check("""
        <launch>
          <include file="/inc.launch" pass_all_args="true"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[ARG002] required argument 'bag' of '/inc.launch' is
          <include file="/between.launch"/>
        </launch>
        //- /inc.launch
        <launch><arg name="bag"/><param name="p" value="$(arg bag)"/></launch>
        //- /between.launch
        <launch>
          <include file="/inc.launch" pass_all_args="true"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[ARG002] required argument 'bag' of '/inc.launch' is
        </launch>
    """)
