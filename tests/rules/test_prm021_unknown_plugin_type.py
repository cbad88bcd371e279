"""PRM021: a type of controller or plugin that its package does not have."""

from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.registry import run_rules
from support import package_elsewhere
from support.check import check
from support.descriptions import said, xacro

FIXTURE = """
    //- /robot.launch.xml
    <launch>
      <node pkg="controller_manager" exec="ros2_control_node" name="controller_manager">
        <param from="/p/controllers.yaml"/>
      </node>
    </launch>
    //- /controller_manager/package.xml
    <package><name>controller_manager</name></package>
    //- /p/controllers.yaml
    controller_manager:
      ros__parameters:
        one:
          type: {}
"""


@pytest.mark.parametrize(
    ("type_", "meant"),
    [
        (
            "force_torque_sensor_broadcaster/ForceTorqueStateBroadcaster",
            "force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster",
        ),
        ("diff_drive_controller/DiffDriveControler", "diff_drive_controller/DiffDriveController"),
        ("imu_sensor_broadcaster/ImuSensorBroadcaster", "imu_sensor_broadcaster/IMUSensorBroadcaster"),
    ],
)
def test_a_type_that_is_nearly_the_packages_own(type_: str, meant: str) -> None:
    said = f"warning[PRM021] unknown controller '{type_}'"
    (finding,) = check(FIXTURE.format(type_) + f"                {'^' * len(type_)} {said}\n")
    assert f"did you mean '{meant}'?" in finding.message
    assert finding.confidence == "likely"
    assert [edit.text for fix in finding.fixes for edit in fix.edits] == [meant]


def test_the_only_controller_of_its_package_without_some_words() -> None:
    """In another version of the package it may have been called so."""
    type_ = "picknik_reset_fault_controller/FaultController"
    (finding,) = check(FIXTURE.format(type_) + f"                {'^' * len(type_)} info[PRM021] unknown controller\n")
    assert "did you mean 'picknik_reset_fault_controller/PicknikResetFaultController'?" in finding.message
    assert finding.confidence == "possible"


@pytest.mark.silent
@pytest.mark.parametrize(
    "type_",
    [
        "picknik_reset_fault_controller/Controller",
        "picknik_reset_fault_controller/OwnFaultController",
        "diff_drive_controller/DiffDriveController",
        "position_controllers/GripperActionController",
        "nobody_knows/DiffDriveControler",
        "../controllers/DiffDriveControler",
        "DiffDriveControler",
        "[]",
        ".nan",
    ],
)
def test_what_is_known_or_unlike_all_that_is(type_: str) -> None:
    check(FIXTURE.format(type_))


@pytest.mark.silent
def test_the_workspaces_own_package_may_be_another_version() -> None:
    manifest = (
        "    //- /src/diff_drive_controller/package.xml\n    <package><name>diff_drive_controller</name></package>\n"
    )
    check(FIXTURE.format("diff_drive_controller/DiffDriveControler") + manifest)


PLUGIN = """
    //- /robot.launch.xml
    <launch><node pkg="p" exec="e" name="planner"><param from="/p/planner.yaml"/></node></launch>
    //- /p/planner.yaml
    planner:
      ros__parameters:
        GridBased:
          plugin: {}
"""


@pytest.mark.parametrize("mark", ["::", "/"])
def test_a_plugin_that_is_nearly_the_packages_own(mark: str) -> None:
    type_ = f"nav2_navfn_planner{mark}NavfnPlaner"
    (finding,) = check(PLUGIN.format(type_) + f"                  {'^' * len(type_)} warning[PRM021] unknown plugin\n")
    assert f"did you mean 'nav2_navfn_planner{mark}NavfnPlanner'?" in finding.message


@pytest.mark.silent
@pytest.mark.parametrize(
    "type_",
    [
        "nav2_navfn_planner::NavfnPlanner",
        "nav2_navfn_planner/NavfnPlanner",
        "nav2_behaviors::Spin",
        "nav2_navfn_planner::Planner",
        "mine::NavfnPlaner",
        "NavfnPlaner",
        "::NavfnPlaner",
        '"nav2_navfn_planner::"',
    ],
)
def test_plugins_that_are_known_or_unlike_all_that_are(type_: str) -> None:
    check(PLUGIN.format(type_))


def test_a_manager_whose_name_only_its_own_code_knows() -> None:
    text = FIXTURE.replace(' name="controller_manager"', "").replace("ros2_control_node", "own_control_node")
    check(text.format("diff_drive_controller/DiffDriveControler") + f"                {'^' * 40} warning[PRM021]\n")


OWN = """    //- /src/own_controllers/package.xml
    <package><name>own_controllers</name><depend>pluginlib</depend></package>
    //- /src/own_controllers/CMakeLists.txt
    project(own_controllers)
    add_library(own SHARED src/own.cpp)
    pluginlib_export_plugin_description_file(controller_interface plugins.xml)
    //- /src/own_controllers/plugins.xml
    <library path="own">
      <class name="own_controllers/StateBroadcaster" type="own_controllers::StateBroadcaster"
             base_class_type="controller_interface::ControllerInterface"/>
      <class name="own_controllers/Left" type="own_controllers::Left" base_class_type="anything::Base"/>
    </library>
"""


def test_a_slip_of_what_a_package_of_the_workspace_has() -> None:
    type_ = "own_controllers/StateBroadCaster"
    said = f"{'^' * len(type_)} warning[PRM021] unknown controller '{type_}'"
    (finding,) = check(FIXTURE.format(type_) + f"                {said}\n" + OWN)
    assert finding.confidence == "likely"
    assert [edit.text for fix in finding.fixes for edit in fix.edits] == ["own_controllers/StateBroadcaster"]


def test_the_other_mark_than_that_of_the_packages_own_description() -> None:
    """As in MonashNovaRover/nova, 84bb3169."""
    type_ = "own_controllers::StateBroadcaster"
    (finding,) = check(FIXTURE.format(type_) + f"                {'^' * len(type_)} warning[PRM021] unknown\n" + OWN)
    assert [edit.text for fix in finding.fixes for edit in fix.edits] == ["own_controllers/StateBroadcaster"]


@pytest.mark.silent
@pytest.mark.parametrize(
    "type_", ["own_controllers/StateBroadcaster", "own_controllers/Left", "own_controllers/Right", "other/Lefft"]
)
def test_what_a_package_of_the_workspace_has_or_may_have(type_: str) -> None:
    check(FIXTURE.format(type_) + OWN)


_SERVER = """<launch><node pkg="nav2_planner" exec="planner_server" name="planner_server">
<param from="$(dirname)/nav2.yaml"/></node></launch>"""


def _of_distribution(folder: Path, distro: str | None, type_: str, **files: str) -> list[Finding]:
    params = f"planner_server:\n  ros__parameters:\n    GridBased:\n      plugin: {type_}\n"
    analysis = package_elsewhere.analysed(folder, _SERVER, "a.launch.xml", distro, **{"nav2.yaml": params, **files})
    return [each for each in run_rules(analysis.context) if each.rule == "PRM021"]


@pytest.mark.parametrize(
    ("distro", "type_", "message"),
    [
        # space-ros/demos, issue 133
        (
            "jazzy",
            "nav2_navfn_planner/NavfnPlanner",
            "unknown plugin 'nav2_navfn_planner/NavfnPlanner': Nav2 does not have it in jazzy; "
            "did you mean 'nav2_navfn_planner::NavfnPlanner'?",
        ),
        # ros-navigation/navigation2, issue 4571
        (
            "humble",
            "nav2_smac_planner::SmacPlannerHybrid",
            "unknown plugin 'nav2_smac_planner::SmacPlannerHybrid': Nav2 does not have it in humble; "
            "did you mean 'nav2_smac_planner/SmacPlannerHybrid'?",
        ),
        (
            "humble",
            "nav2_recoveries/Spin",
            "unknown plugin 'nav2_recoveries/Spin': Nav2 does not have it in humble; "
            "did you mean 'nav2_behaviors/Spin'?",
        ),
        (
            "humble",
            "nav2_costmap_2d::PluginContainerLayer",
            "unknown plugin 'nav2_costmap_2d::PluginContainerLayer': Nav2 does not have it in humble, but in jazzy, "
            "kilted, lyrical",
        ),
    ],
)
def test_a_plugin_of_nav2_that_another_distribution_has(tmp_path: Path, distro: str, type_: str, message: str) -> None:
    (found,) = _of_distribution(tmp_path, distro, type_)
    assert (found.message, found.severity, found.confidence) == (message, "warning", "likely")
    assert bool(found.fixes) == ("did you mean" in message)


@pytest.mark.silent
@pytest.mark.parametrize(
    ("distro", "type_"),
    [
        ("jazzy", "nav2_navfn_planner::NavfnPlanner"),
        ("humble", "nav2_navfn_planner/NavfnPlanner"),
        ("galactic", "nav2_recoveries/Spin"),
        (None, "nav2_navfn_planner/NavfnPlanner"),
        ("jazzy", "nav2_own_planner/NavfnPlanner"),
        ("humble", "nav2_bt_navigator::NavigateToPoseNavigator"),
    ],
)
def test_a_plugin_that_the_distribution_has(tmp_path: Path, distro: str | None, type_: str) -> None:
    assert not _of_distribution(tmp_path, distro, type_)


@pytest.mark.silent
def test_a_package_of_nav2_in_the_workspace(tmp_path: Path) -> None:
    own = {"../nav2_navfn_planner/package.xml": "<package><name>nav2_navfn_planner</name></package>"}
    assert not _of_distribution(tmp_path, "jazzy", "nav2_navfn_planner/NavfnPlanner", **own)


_VALUE = """
    <launch>
      <node pkg="{}" exec="{}" name="a"><param name="{}" value="{}"/></node>
    </launch>
"""


def _of_value(folder: Path, place: tuple[str, str, str], value: str, distro: str | None) -> list[str]:
    analysis = package_elsewhere.analysed(folder, _VALUE.format(*place, value), "a.launch.xml", distro)
    return [f.message.partition(" Source")[0] for f in run_rules(analysis.context) if f.rule == "PRM021"]


@pytest.mark.parametrize(
    ("place", "value", "said"),
    [
        (
            ("nav2_amcl", "amcl", "robot_model_type"),
            "omnidirectional",
            "is that of an older distribution; did you mean 'nav2_amcl::OmniMotionModel'?",
        ),
        (
            ("nav2_amcl", "amcl", "robot_model_type"),
            "nav2_amcl::OmniMotionModle",
            "names no plugin; did you mean 'nav2_amcl::OmniMotionModel'?",
        ),
        (
            ("mavros", "mavros_node", "plugin_denylist"),
            "setpoint_velocty",
            "names no plugin; did you mean 'setpoint_velocity'?",
        ),
    ],
)
def test_a_value_that_names_no_plugin_of_a_node(
    tmp_path: Path, place: tuple[str, str, str], value: str, said: str
) -> None:
    assert _of_value(tmp_path, place, value, "jazzy") == [f"value '{value}' of '{place[2]}' {said}"]


@pytest.mark.silent
@pytest.mark.parametrize(
    ("place", "value", "distro"),
    [
        (("nav2_amcl", "amcl", "robot_model_type"), "differential", "foxy"),
        (("nav2_amcl", "amcl", "robot_model_type"), "nav2_amcl::DifferentialMotionModel", "humble"),
        (("nav2_amcl", "amcl", "robot_model_type"), "own::MotionModel", "humble"),
        (("mavros", "mavros_node", "plugin_allowlist"), "setpoint_*", "humble"),
        (("mavros", "mavros_node", "plugin_allowlist"), "SYS_status", "humble"),
        (("mavros", "mavros_node", "plugin_allowlist"), "our_plugin", "humble"),
    ],
)
def test_a_value_that_names_a_plugin_or_may_name_one(
    tmp_path: Path, place: tuple[str, str, str], value: str, distro: str
) -> None:
    assert _of_value(tmp_path, place, value, distro) == []


HARDWARE = """
<ros2_control name="arm" type="system"><hardware>
  <plugin>{}</plugin>
</hardware></ros2_control>
"""
EXPORTED = {
    "CMakeLists.txt": "project(arm)\nfind_package(hardware_interface)\n"
    "pluginlib_export_plugin_description_file(hardware_interface plugins.xml)\nament_package()\n",
    "plugins.xml": '<library path="arm"><class name="arm/ArmHardware" type="arm::ArmHardware" '
    'base_class_type="hardware_interface::SystemInterface"/></library>\n',
}


@pytest.mark.parametrize("named", ["arm/ArmHardwar", "arm::ArmHardware", "arm_driver/ArmHardware"])
def test_hardware_of_a_description(named: str) -> None:
    files = {**EXPORTED, "urdf/arm.xacro": xacro(HARDWARE.format(named))}
    (found,) = said(files, "PRM021")
    assert found == (
        f"urdf/arm.xacro:4 warning unknown plugin '{named}' of ros2_control; did you mean 'arm/ArmHardware'? Source: "
        "the plugin descriptions of the workspace"
    )


@pytest.mark.parametrize("named", ["arm/ArmHardware", "mock_components/GenericSystem", "other/Hand", "${plugin}"])
def test_hardware_that_is_there_or_elsewhere(named: str) -> None:
    assert not said({**EXPORTED, "urdf/arm.xacro": xacro(HARDWARE.format(named))}, "PRM021")


@pytest.mark.silent
def test_a_value_of_a_package_in_the_workspace(tmp_path: Path) -> None:
    """https://github.com/zhj-buffer/AMR_ros2_slam_nav2: it has the Navigation2 of Foxy."""
    manifest = tmp_path / "ws" / "src" / "nav2_amcl" / "package.xml"
    manifest.parent.mkdir(parents=True)
    manifest.write_text("<package><name>nav2_amcl</name></package>")
    assert _of_value(tmp_path, ("nav2_amcl", "amcl", "robot_model_type"), "differential", "humble") == []
