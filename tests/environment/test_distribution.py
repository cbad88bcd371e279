"""Which distribution a workspace is for, where none is sourced or installed."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.doctor import describe

MANIFEST = "<package format='3'><name>p</name>{}<export><build_type>{}</build_type></export></package>"
SAYS = {
    "the settings": ({".ros-preflight.yaml": "distribution: jazzy", "Dockerfile": "FROM ros:humble"}, "jazzy"),
    "an image": ({"docker/Dockerfile.dev": "FROM osrf/ros:humble-desktop-full AS base"}, "humble"),
    "packages in an image": ({"Dockerfile": "FROM ubuntu:22.04\nRUN apt install ros-iron-desktop"}, "iron"),
    "a compose file": ({"docker-compose.yml": "services: {a: {image: 'ghcr.io/me/ros2:jazzy'}}"}, "jazzy"),
    "a development container": ({".devcontainer/devcontainer.json": '{"image": "ros:kilted"}'}, "kilted"),
    "a workflow": ({".github/workflows/ci.yml": "with: {required-ros-distributions: humble}"}, "humble"),
    "a variable": ({".gitlab-ci.yml": "variables:\n  ROS_DISTRO: 'foxy'"}, "foxy"),
    "a script": ({"scripts/run.sh": "source /opt/ros/galactic/setup.bash"}, "galactic"),
    "an image before a script": ({"Dockerfile": "FROM ros:humble", "run.sh": "export ROS_DISTRO=jazzy"}, "humble"),
    "a matrix, then a script": ({"ci/Dockerfile": "#ros:humble ros:iron", "a.sh": "ROS_DISTRO=iron"}, "iron"),
    "the branch": ({".git/HEAD": "ref: refs/heads/jazzy-devel\n"}, "jazzy"),
    "a condition": ({"p/package.xml": "<!-- $ROS_DISTRO == humble -->"}, "humble"),
    "copies of others that agree": (
        {"others/a/Dockerfile": "FROM ros:iron", "others/b/README.md": "/opt/ros/iron"},
        "iron",
    ),
    "the workspace before its copies": ({"others/a/Dockerfile": "FROM ros:iron", "README.md": "/opt/ros/foxy"}, "foxy"),
    "no folder of the build": ({"install/setup.sh": "/opt/ros/iron", "README.md": "/opt/ros/foxy"}, "foxy"),
    "words": ({"README.md": "# Robot\nFor **ROS 2 Humble** on Ubuntu"}, "humble"),
    "other words": ({"README.md": "Needs ROS2 (jazzy), not ROS Noetic"}, "jazzy"),
    "a command before words": ({"README.md": "ROS 2 Humble\n source /opt/ros/iron/setup.bash"}, "iron"),
    "one that is old": ({"Dockerfile": "FROM ros:eloquent"}, "eloquent"),
}


def workspace(folder: Path, files: dict[str, str], build: str = "ament_cmake", more: str = "") -> None:
    for name, text in {"p/package.xml": "", **files}.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(MANIFEST.format(more, build) + text if name == "p/package.xml" else text)


@pytest.mark.parametrize("case", SAYS)
def test_what_a_workspace_says(tmp_path: Path, case: str) -> None:
    files, name = SAYS[case]
    workspace(tmp_path / "ws", files)
    found = detect_environment(str(tmp_path / "ws"), {}, root=str(tmp_path / "root"))
    assert found.distro == name
    assert dict(describe(found))["distribution"].startswith(f"ROS 2 {name.capitalize()}, by ")


NOTHING = (
    "FROM ros:humble\nFROM ros:jazzy",
    *("FROM rose:humblebee", "FROM ubuntu:humble", "FROM ros:noetic", "ls /opt/ros/humbler", "apt install ros-humble"),
)


@pytest.mark.parametrize("text", NOTHING)
def test_what_says_nothing_or_two_things(tmp_path: Path, text: str) -> None:
    workspace(tmp_path / "ws", {"Dockerfile": text})
    assert detect_environment(str(tmp_path / "ws"), {}, root=str(tmp_path / "root")).distro is None


def test_copies_of_other_projects_that_do_not_agree(tmp_path: Path) -> None:
    workspace(tmp_path / "ws", {"others/a/Dockerfile": "FROM ros:iron", "others/b/run.sh": "/opt/ros/foxy"})
    assert detect_environment(str(tmp_path / "ws"), {}, root=str(tmp_path / "root")).distro is None


def test_what_is_sourced_comes_first(tmp_path: Path) -> None:
    workspace(tmp_path / "ws", {".ros-preflight.yaml": "distribution: jazzy"})
    found = detect_environment(str(tmp_path / "ws"), {"ROS_DISTRO": "humble"}, root=str(tmp_path / "root"))
    assert (found.distro, found.distro_by, found.meant_for) == ("humble", "", ("jazzy",))


MEANT = {
    "words of a read-me file": ({"README.md": "Works with ROS Jade and ROS Indigo"}, ("indigo", "jade")),
    "a workflow and words": (
        {".travis.yml": "- export ROSDISTRO=kinetic", "README.md": "- ROS Indigo\n- ROS Kinetic"},
        ("indigo", "kinetic"),
    ),
    "the workspace before its copies": (
        {"README.md": "ROS kinetic", "others/a/Dockerfile": "FROM ros:melodic"},
        ("kinetic",),
    ),
    "copies": (
        {"others/a/Dockerfile": "FROM ros:melodic", "others/b/run.sh": "/opt/ros/kinetic"},
        ("kinetic", "melodic"),
    ),
    "the branch": ({".git/HEAD": "ref: refs/heads/kinetic-devel\n"}, ("kinetic",)),
    "nothing": ({"README.md": "ROS, kinetic energy"}, ()),
}


@pytest.mark.parametrize("case", MEANT)
def test_what_it_is_for_beside_what_is_used(tmp_path: Path, case: str) -> None:
    files, names = MEANT[case]
    workspace(tmp_path / "ws", files, "catkin")
    found = detect_environment(str(tmp_path / "ws"), {"ROS_DISTRO": "noetic"}, root=str(tmp_path / "root"))
    assert (found.distro, found.meant_for) == ("noetic", names)


def test_a_workspace_of_ros_1(tmp_path: Path) -> None:
    workspace(tmp_path / "ws", {"Dockerfile": "FROM ros:melodic-robot"}, "catkin")
    found = detect_environment(str(tmp_path / "ws"), {}, root=str(tmp_path / "root"))
    assert (found.generation, found.distro, found.distro_by) == (1, "melodic", "Dockerfile")


def test_packages_that_one_distribution_alone_has(tmp_path: Path) -> None:
    needs = {
        "two": "adi_tmcl adi_3dtof_image_stitching",
        "one": "adi_tmcl rclcpp",
        "both": "adi_tmcl canopen_inventus_driver",
    }
    for name, packages in needs.items():
        workspace(tmp_path / name, {}, more="".join(f"<depend>{each}</depend>" for each in packages.split()))
    found = [detect_environment(str(tmp_path / name), {}, root=str(tmp_path)).distro for name in needs]
    assert found == ["humble", None, None]


def test_links_are_not_followed(tmp_path: Path) -> None:
    workspace(tmp_path / "ws", {})
    (tmp_path / "Dockerfile").write_text("FROM ros:humble")
    (tmp_path / "ws" / "Dockerfile").symlink_to(tmp_path / "Dockerfile")
    assert detect_environment(str(tmp_path / "ws"), {}, root=str(tmp_path / "root")).distro is None
