"""PKG008: a middleware that is not there (ROS 2)."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.lack import Lack
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

NODES = "<node pkg='rclcpp' exec='a' name='a'/><node pkg='rclcpp' exec='b' name='b'/>"
SET = "<set_env name='RMW_IMPLEMENTATION' value='{}'/>"
CYCLONE = "rmw_cyclonedds_cpp"


def found(folder: Path, launch: str, *installed: str, variables: dict[str, str] | None = None) -> list[Finding]:
    for name in installed:
        path = folder / "install/share/ament_index/resource_index/packages" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    file = folder / "src/p/main.launch.xml"
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(f"<launch>{launch}</launch>")
    given = {"ROS_DISTRO": "kilted", **(variables or {})}
    environment = detect_environment(str(folder), given, root=str(folder / "nothing"))
    findings = Workspace(environment, Sources()).static(str(file)).findings
    return [each for each in findings if each.rule == "PKG008"]


def test_a_middleware_that_the_launch_sets_is_said_to_be_missing_once(tmp_path: Path) -> None:
    (finding,) = found(tmp_path, SET.format(CYCLONE) + NODES, "rclcpp")
    message = "middleware 'rmw_cyclonedds_cpp' is not installed; the launch sets it for /a and 1 more"
    assert (finding.message, finding.severity) == (message, "hint")
    assert finding.lack == Lack("package", CYCLONE, "apt install ros-kilted-rmw-cyclonedds-cpp")


def test_so_is_one_of_the_users_environment(tmp_path: Path) -> None:
    (finding,) = found(tmp_path, NODES, "rclcpp", variables={"RMW_IMPLEMENTATION": CYCLONE})
    assert "your environment sets it for /a and 1 more" in finding.message


def test_a_slip_is_an_error(tmp_path: Path) -> None:
    (finding,) = found(tmp_path, SET.format("rmw_cyclonedd_cpp") + NODES, "rclcpp")
    assert (finding.severity, finding.lack) == ("error", None)
    assert finding.message.endswith("; did you mean 'rmw_cyclonedds_cpp'?")


@pytest.mark.silent
def test_nothing_is_said_of_one_that_is_there_or_where_no_ros_is(tmp_path: Path) -> None:
    assert found(tmp_path, SET.format(CYCLONE) + NODES) == []
    assert found(tmp_path, NODES, "rclcpp") == []
    assert found(tmp_path, SET.format(CYCLONE) + "<executable cmd='ls' name='ls'/>", "rclcpp") == []
    library = tmp_path / "install" / "lib" / "librmw_own_cpp.so"
    library.parent.mkdir()
    library.touch()
    assert found(tmp_path, SET.format("rmw_own_cpp") + NODES, "rclcpp") == []
    assert found(tmp_path, SET.format(CYCLONE) + NODES, "rclcpp", CYCLONE) == []
