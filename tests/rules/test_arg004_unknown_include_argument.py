"""ARG004: an include passes an argument that the file does not declare."""

import pytest
from support.check import apply, check


def test_an_argument_that_the_included_file_does_not_declare() -> None:
    text = """
        <launch>
          <include file="/inc.launch">
            <arg name="frame" value="map"/>
                       ^^^^^ error[ARG004] argument 'frame' is not declared by '/inc.launch'; did you mean 'frames'?
          </include>
        </launch>
        //- /inc.launch
        <launch><arg name="frames" default="odom"/><param name="a" value="$(arg frames)"/></launch>
    """
    (finding,) = check(text)
    assert '<arg name="frames" value="map"/>' in apply(text, finding.fixes[0].edits)["/main.launch"]
    without = '<launch>\n  <include file="/inc.launch">\n  </include>'
    assert apply(text, finding.fixes[1].edits)["/main.launch"].startswith(without)


@pytest.mark.silent
def test_pass_all_args_passes_what_nobody_declares() -> None:
    check("""
        <launch>
          <arg name="other" default="1"/>
          <include file="/inc.launch" pass_all_args="true"/>
        </launch>
        //- /inc.launch
        <launch><arg name="frames" default="odom"/><param name="a" value="$(arg frames)"/></launch>
    """)


def test_an_argument_that_nobody_below_uses() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="deep" default="1"/>
          <include file="/arm.launch.xml">
            <arg name="robot_address" value="10.0.0.2"/>
                       ^^^^^^^^^^^^^ warning[ARG004] argument 'robot_address' has no effect: neither '/arm.launch.xml'
            <arg name="speed" value="1"/>
            <arg name="deeper" value="2"/>
            <arg name="late" value="2"/>
          </include>
          <log message="$(var late)"/>
          <include file="/open.launch.xml"><arg name="any" value="1"/></include>
        </launch>
        //- /arm.launch.xml
        <launch>
          <arg name="robot_ip" default="10.0.0.1"/>
          <include file="/drive.launch.yaml"/>
          <group if="false"><log message="$(var speed)"/></group>
        </launch>
        //- /drive.launch.yaml
        launch:
          - arg: {name: deeper, default: '0'}
        //- /open.launch.xml
        <launch>
          <arg name="extra" default="false"/>
          <include file="$(find-pkg-share p)/extra.launch.py" if="$(var extra)"/>
        </launch>
    """)
