"""PKG007: a package.xml names a package that there is nowhere."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.check import apply, check
from support.packaging import LAUNCH, of_packages, said
from support.unbuilt_packages import manifest


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
        <package><name>robot</name><depend>libdmtx-dev</depend><depend>param_io</depend></package>
    """)


LAUNCHED = {"launch/arm.launch.xml": LAUNCH}
OF_ROS2 = "<export><build_type>ament_cmake</build_type></export></package>"


def test_a_manifest_of_a_package_that_has_no_launch_file(tmp_path: Path) -> None:
    files = {"package.xml": f"<package><name>arm</name><depend>geometry_msg</depend>{OF_ROS2}"}
    assert of_packages(tmp_path, files, "PKG007") == [
        "package.xml:1 warning unknown package 'geometry_msg': not in the workspace nor any distribution; did you mean "
        "'geometry_msgs'?"
    ]


@pytest.mark.parametrize(
    ("build_type", "old", "new", "at", "other"),
    [
        ("ament_cmake", "roscpp", "rclcpp", 2, 1),
        ("ament_python", "tf", "tf2_ros", 2, 1),
        ("ament_cmake", "message_generation", "rosidl_default_generators", 2, 1),
        ("catkin", "rclpy", "rospy", 1, 2),
    ],
)
def test_a_package_of_the_other_generation(
    tmp_path: Path, build_type: str, old: str, new: str, at: int, other: int
) -> None:
    text = manifest("arm", build_type).replace("</name>", f"</name>\n<depend>{old}</depend>")
    assert of_packages(tmp_path, {"package.xml": text}, "PKG007") == [
        f"package.xml:2 warning '{old}' is a package of ROS {other}, and {build_type} builds 'arm' for ROS {at}; use "
        f"'{new}'"
    ]


@pytest.mark.silent
@pytest.mark.parametrize(
    "text",
    [
        f'<depend condition="$ROS_VERSION == 1">roscpp</depend>{OF_ROS2}',
        "<depend>roscpp</depend><export><build_type condition='$ROS_VERSION == 1'>catkin</build_type>"
        "<build_type condition='$ROS_VERSION == 2'>ament_cmake</build_type></export></package>",
        f"<depend>std_msgs</depend><depend>tf2_ros</depend>{OF_ROS2}",
        f"<depend>hector_slam</depend>{OF_ROS2}",
        f"<depend>robot_description</depend>{OF_ROS2}",
        "<buildtool_depend>catkin</buildtool_depend><depend>tf2_ros</depend></package>",
    ],
)
def test_both_generations_and_what_has_no_successor(tmp_path: Path, text: str) -> None:
    assert said(tmp_path, {**LAUNCHED, "package.xml": f"<package><name>arm</name>{text}"}, "PKG007") == []


@pytest.mark.silent
def test_a_package_of_the_workspace_with_a_name_of_ros1(tmp_path: Path) -> None:
    (tmp_path / "src/tf").mkdir(parents=True)
    (tmp_path / "src/tf/package.xml").write_text(manifest("tf", "ament_cmake"))
    files = {**LAUNCHED, "package.xml": f"<package><name>arm</name><depend>tf</depend>{OF_ROS2}"}
    assert said(tmp_path, files, "PKG007") == []
