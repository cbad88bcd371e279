"""PKG007: a package.xml names a package that there is nowhere."""

from __future__ import annotations

import pytest
from support.check import apply, check


def test_a_slip_of_a_released_package_of_the_workspace_and_of_the_system() -> None:
    text = """
        //- /robot/launch/all.launch
        <launch/>
        //- /robot/package.xml
        <package format="2">
          <name>robot</name>
          <exec_depend>robot_state_publiser</exec_depend>
                       ^^^^^^^^^^^^^^^^^^^^ warning[PKG007] did you mean 'robot_state_publisher'?
          <!-- <depend>move_bas</depend> -->
          <depend>laser_driverr</depend>
                  ^^^^^^^^^^^^^ warning[PKG007] unknown package 'laser_driverr': not in the workspace nor any
          <build_depend>libopencv-devv</build_depend>
                        ^^^^^^^^^^^^^^ warning[PKG007] did you mean 'libopencv-dev'?
          <exec_depend>robot_state_publiser</exec_depend>
        </package>
        //- /laser_driver/package.xml
        <package/>
    """
    finding = check(text)[0]
    fixed = apply(text, finding.fixes[0].edits)["/robot/package.xml"]
    assert "<exec_depend>robot_state_publisher</exec_depend>" in fixed


@pytest.mark.silent
def test_what_somebody_knows_and_what_is_like_nothing() -> None:
    check("""
        //- /robot/launch/all.launch
        <launch/>
        //- /robot/package.xml
        <package format="2">
          <name>robot</name>
          <buildtool_depend>catkin</buildtool_depend>
          <exec_depend condition="$ROS_VERSION == 2">nav2_bringup</exec_depend>
          <exec_depend>python3-numpy</exec_depend>
          <exec_depend condition="$ROS_PYTHON_VERSION == 2">python-tk</exec_depend>
          <exec_depend>acme_gripper_firmware</exec_depend>
          <exec_depend>laser_driver</exec_depend>
        </package>
        //- /laser_driver/package.xml
        <package/>
        //- /lasr_driver/package.xml
        <package><name>lasr_driver</name><depend>laser_drivr</depend></package>
    """)


@pytest.mark.silent
def test_a_family_of_packages_that_is_not_here() -> None:
    check("""
        //- /mir_teleop/launch/all.launch
        <launch/>
        //- /mir_teleop/package.xml
        <package format="2"><name>mir_teleop</name><depend>mcr_teleop</depend><depend>mcr_arm</depend></package>
        //- /mir_arm/package.xml
        <package/>
    """)


@pytest.mark.silent
def test_a_family_whose_name_is_near_to_a_package_of_the_system() -> None:
    check("""
        //- /skills/launch/all.launch
        <launch/>
        //- /skills/package.xml
        <package format="2"><name>skills</name><depend>ed_python</depend><depend>ed_navigation_msgs</depend></package>
    """)


@pytest.mark.silent
def test_a_package_of_another_repository_of_the_same_project() -> None:
    check("""
        //- /smarc_scenarios/tutorial/launch/all.launch
        <launch/>
        //- /smarc_scenarios/tutorial/package.xml
        <package format="2"><name>tutorial</name><depend>smarc_msgs</depend></package>
    """)


@pytest.mark.silent
def test_a_name_of_the_system_with_another_short_word_is_none_of_a_slip() -> None:
    check("""
        //- /robot/launch/all.launch
        <launch/>
        //- /robot/package.xml
        <package><name>robot</name><depend>libdmtx-dev</depend></package>
    """)
