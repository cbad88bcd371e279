from __future__ import annotations

import sys
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect, detect_environment, workspace_of
from preflight_analysis.environment.doctor import describe
from preflight_analysis.environment.view import of_generation
from support.package_folders import file, package, script, space


def install_ros(prefix: Path, python: str = "python3") -> None:
    """What of an installed ROS is looked at."""
    package(prefix / "share" / "catkin")
    package(prefix / "share" / "rospy")
    file(prefix / ".catkin")
    file(prefix / "lib" / python / "dist-packages" / "rospy" / "__init__.py")


def install_debian(root: Path, version: str = "1.15.15") -> None:
    package(root / "usr" / "share" / "rospy", version=version)
    file(root / "usr" / "lib" / "python3" / "dist-packages" / "rospy" / "__init__.py")
    script(root / "usr" / "bin" / "python3")


def test_machine_without_ros_is_usable_and_told_what_to_install(tmp_path: Path) -> None:
    workspace = tmp_path / "ws"
    package(workspace / "src" / "p")
    environment = detect_environment(str(workspace), {}, root=str(tmp_path))
    assert list(environment.packages) == ["p"]
    assert (environment.distro, environment.python, environment.system_prefixes) == (None, None, ())
    [problem] = environment.problems
    assert "apt install python3-rospy" in problem
    assert of_generation(environment, 1).problems == environment.problems
    assert of_generation(environment, 2).problems == (), "a launch file of ROS 2 needs no rospy"


def test_a_folder_that_is_one_package_of_ros_2(tmp_path: Path) -> None:
    body = "<export><build_type>ament_cmake</build_type></export>"
    environment = detect_environment(str(package(tmp_path / "p", body=body)), {}, root=str(tmp_path / "nothing"))
    assert environment.generation == 2
    assert environment.problems == ()


def test_debian(tmp_path: Path) -> None:
    install_debian(tmp_path)
    usr = tmp_path / "usr"
    environment = detect_environment(None, {"A": "b"}, root=str(tmp_path))
    assert environment.package_path == (str(usr / "share"),)
    assert (environment.generation, environment.distro) == (1, "noetic")
    assert environment.python == str(usr / "bin" / "python3")
    assert environment.system_prefixes == (str(usr),)
    assert environment.variables == {"A": "b"}
    assert environment.problems == ()
    assert environment.debians
    (tmp_path / "opt/ros/noetic").mkdir(parents=True)
    assert not detect_environment(None, {"ROS_DISTRO": "noetic"}, root=str(tmp_path)).debians


@pytest.mark.parametrize(
    ("release", "debians"),
    [
        ('PRETTY_NAME="Debian"\nID=debian\n', True),
        ("ID=raspbian\nID_LIKE=debian\n", True),
        ('NAME="Ubuntu"\nID=ubuntu\nID_LIKE=debian\n', False),
        ('ID=linuxmint\nID_LIKE="ubuntu debian"\n', False),
        ("ID=fedora\n", False),
    ],
)
def test_whose_packages_a_machine_without_ros_would_install(tmp_path: Path, release: str, debians: bool) -> None:
    (tmp_path / "etc").mkdir()
    (tmp_path / "etc/os-release").write_text(release)
    assert detect_environment(None, {}, root=str(tmp_path)).debians == debians


@pytest.mark.parametrize(("version", "distro"), [("1.14.3", "melodic"), ("1.12.17", "kinetic"), ("1.17.0", "noetic")])
def test_debian_packages_are_of_the_distribution_of_their_version(tmp_path: Path, version: str, distro: str) -> None:
    install_debian(tmp_path, version)
    assert detect_environment(None, {}, root=str(tmp_path)).distro == distro


def test_installed_distribution_that_is_not_sourced(tmp_path: Path) -> None:
    install_ros(tmp_path / "opt" / "ros" / "melodic", "python2.7")
    install_ros(tmp_path / "opt" / "ros" / "noetic")
    script(tmp_path / "usr" / "bin" / "python3")
    noetic = str(tmp_path / "opt" / "ros" / "noetic")
    environment = detect_environment(None, {"PATH": "/bin"}, root=str(tmp_path))
    assert environment.distro == "noetic"
    assert environment.package_path == (f"{noetic}/share",)
    assert environment.python == str(tmp_path / "usr" / "bin" / "python3")
    assert environment.system_prefixes == (noetic,)
    assert environment.problems == ()
    given = environment.variables
    assert (given["ROS_DISTRO"], given["ROS_PACKAGE_PATH"]) == ("noetic", f"{noetic}/share")
    assert given["PYTHONPATH"] == f"{noetic}/lib/python3/dist-packages"
    assert given["CMAKE_PREFIX_PATH"] == noetic


def test_rospy_for_python_2_cannot_be_traced(tmp_path: Path) -> None:
    install_ros(tmp_path / "opt" / "ros" / "melodic", "python2.7")
    environment = detect_environment(None, {}, root=str(tmp_path))
    assert environment.python is None
    [problem] = environment.problems
    assert "Python 2.7" in problem


def test_ros_2_that_is_sourced_counts_and_ros_1_is_found_beside_it(tmp_path: Path) -> None:
    install_debian(tmp_path)
    environment = detect_environment(None, {"ROS_DISTRO": "humble", "ROS_VERSION": "2"}, root=str(tmp_path))
    assert (environment.generation, environment.distro, environment.problems) == (2, "humble", ())
    assert environment.system_prefixes == (str(tmp_path / "usr"),)


def ament(prefix: Path, name: str) -> Path:
    """An installed package of ROS 2."""
    file(prefix / "share" / "ament_index" / "resource_index" / "packages" / name)
    return package(prefix / "share" / name)


def test_packages_of_ros_2(tmp_path: Path) -> None:
    opt = tmp_path / "opt" / "ros" / "jazzy"
    for name in ("rclpy", "mine", "other"):
        ament(opt, name)
    ament(tmp_path / "opt" / "ros" / "humble", "rclpy")
    ament(tmp_path / "ws" / "install" / "other", "other")
    mine = package(tmp_path / "ws" / "src" / "mine")
    (mine / "package.xml").write_text(
        "<package><name>mine</name><export><build_type>ament_python</build_type></export></package>"
    )
    environment = detect_environment(str(tmp_path / "ws"), {}, root=str(tmp_path))
    assert (environment.generation, environment.distro) == (2, "jazzy")
    assert environment.ament_prefixes == (str(tmp_path / "ws/install/other"), str(opt))
    assert {name: found.share for name, found in environment.packages.items()} == {
        "mine": str(mine),
        "other": str(tmp_path / "ws/install/other/share/other"),
        "rclpy": str(opt / "share/rclpy"),
    }
    assert environment.packages["mine"].generation == 2
    (tmp_path / "ws" / "src" / "mine" / "COLCON_IGNORE").touch()
    environment = detect_environment(str(tmp_path / "ws"), {"AMENT_PREFIX_PATH": str(opt)}, root=str(tmp_path))
    assert environment.packages["mine"].share == str(opt / "share/mine")


def test_a_workspace_of_ros_2_does_not_see_the_packages_of_ros_1(tmp_path: Path) -> None:
    install_debian(tmp_path)
    install_ros(tmp_path / "opt" / "ros" / "noetic")
    ament(tmp_path / "opt" / "ros" / "humble", "rviz2")
    source = tmp_path / "ws" / "src"
    manifest = "<package><name>{}</name><export><build_type>{}</build_type></export></package>"
    for name, build_type in (("mine", "ament_python"), ("vendored", "cmake")):
        (package(source / name) / "package.xml").write_text(manifest.format(name, build_type))
    packages = detect_environment(str(tmp_path / "ws"), {}, root=str(tmp_path)).packages
    assert sorted(packages) == ["mine", "rviz2", "vendored"]
    for name, build_type in (("old", "catkin"), ("other", "ament_cmake")):
        (package(source / name) / "package.xml").write_text(manifest.format(name, build_type))
    packages = detect_environment(str(tmp_path / "ws"), {}, root=str(tmp_path)).packages
    assert {"rospy", "catkin"} <= set(packages), "launch files of ROS 1 are beside them"


def test_workspace_comes_before_what_is_installed_and_after_what_is_sourced(tmp_path: Path) -> None:
    install_debian(tmp_path)
    overlay = package(tmp_path / "overlay" / "p")
    package(tmp_path / "ws" / "src" / "p")
    package(tmp_path / "ws" / "src" / "rospy")
    variables = {"ROS_PACKAGE_PATH": f"{tmp_path}/usr/share:{overlay.parent}::{tmp_path}/gone"}
    environment = detect_environment(str(tmp_path / "ws"), variables, root=str(tmp_path))
    assert environment.package_path == tuple(
        str(tmp_path / folder) for folder in ("overlay", "gone", "ws/src", "usr/share")
    )
    assert environment.packages["p"].share == str(overlay)
    assert environment.packages["rospy"].share == str(tmp_path / "ws" / "src" / "rospy")
    assert environment.problems == (f"The package path names {tmp_path}/gone, which is not a folder.",)


def test_given_package_path_is_the_only_one(tmp_path: Path) -> None:
    install_debian(tmp_path)
    package(tmp_path / "ws" / "src" / "p")
    package(tmp_path / "other" / "q")
    variables = {"ROS_PACKAGE_PATH": str(tmp_path / "ws" / "src")}
    environment = detect_environment(str(tmp_path / "ws"), variables, [str(tmp_path / "other")], root=str(tmp_path))
    assert list(environment.packages) == ["q"]
    assert environment.package_path == (str(tmp_path / "other"),)
    assert environment.variables["ROS_PACKAGE_PATH"] == str(tmp_path / "other")
    assert list(detect_environment(None, variables, [], root=str(tmp_path)).packages) == []


def test_built_workspace_is_used_without_being_sourced(tmp_path: Path) -> None:
    install_ros(tmp_path / "opt" / "ros" / "noetic")
    source = tmp_path / "ws" / "src"
    package(source / "p")
    (source / "p" / "msg").mkdir()
    devel = space(tmp_path / "ws" / "devel", source)
    file(devel / "lib" / "python3" / "dist-packages" / "p" / "__init__.py")
    package(tmp_path / "ws" / "install" / "share" / "p")
    noetic = tmp_path / "opt" / "ros" / "noetic"
    variables = {"CMAKE_PREFIX_PATH": str(noetic), "PYTHONPATH": "/mine"}
    environment = detect_environment(str(tmp_path / "ws"), variables, root=str(tmp_path))
    assert environment.devel_spaces == (str(devel),)
    assert environment.shadowed == {}
    python = "lib/python3/dist-packages"
    assert environment.variables["PYTHONPATH"] == f"{devel}/{python}:/mine:{noetic}/{python}"
    assert environment.variables["CMAKE_PREFIX_PATH"] == f"{devel}:{noetic}"
    assert not any("not built" in problem for problem in environment.problems)


def test_sourced_devel_space_keeps_its_place(tmp_path: Path) -> None:
    devel = space(tmp_path / "ws" / "devel", tmp_path / "ws" / "src")
    other = space(tmp_path / "other" / "devel")
    variables = {"CMAKE_PREFIX_PATH": f"{other}:{devel}:{tmp_path}/no-space"}
    environment = detect_environment(str(tmp_path / "ws"), variables, root=str(tmp_path))
    assert environment.devel_spaces == (str(other), str(devel))


def test_workspace_with_messages_that_is_not_built(tmp_path: Path) -> None:
    install_debian(tmp_path)
    package(tmp_path / "ws" / "src" / "p")
    (tmp_path / "ws" / "src" / "p" / "msg").mkdir()
    [problem] = detect_environment(str(tmp_path / "ws"), {}, root=str(tmp_path)).problems
    assert "is not built, so the messages of p are not there" in problem


def test_open_folder_may_be_a_package_of_a_workspace(tmp_path: Path) -> None:
    source = tmp_path / "ws" / "src"
    space(tmp_path / "ws" / "devel", source)
    opened = package(source / "repository" / "p")
    file(opened / "src" / "main.cpp")
    package(source / "q")
    environment = detect_environment(str(opened), {}, root=str(tmp_path))
    assert environment.package_path == (str(opened), str(source))
    assert sorted(environment.packages) == ["p", "q"]
    assert environment.devel_spaces == (str(tmp_path / "ws" / "devel"),)


def test_workspace_without_a_source_folder_is_searched_but_for_what_was_built(tmp_path: Path) -> None:
    package(tmp_path / "ws" / "p")
    package(tmp_path / "ws" / "build" / "q")
    assert list(detect_environment(str(tmp_path / "ws"), {}, root=str(tmp_path)).packages) == ["p"]


def test_workspace_of_a_file(tmp_path: Path) -> None:
    launch = file(tmp_path / "ws" / "src" / "repository" / "p" / "launch" / "a.launch")
    assert workspace_of(str(launch)) == str(launch.parent)
    package(launch.parents[1])
    assert workspace_of(str(launch)) == str(tmp_path / "ws"), "what has a src is a workspace, built or not"
    (launch.parents[2] / ".git").mkdir()
    assert workspace_of(str(launch)) == str(launch.parents[2])
    space(tmp_path / "ws" / "devel")
    assert workspace_of(str(launch)) == str(tmp_path / "ws")


def test_the_nearest_of_several_workspaces_in_one_repository(tmp_path: Path) -> None:
    (tmp_path / ".git").mkdir()
    for name in ("one", "two"):
        package(tmp_path / name / "src" / "group" / "p")
        launch = file(tmp_path / name / "src" / "group" / "p" / "launch" / "a.launch")
        assert workspace_of(str(launch)) == str(tmp_path / name)
        assert workspace_of(str(tmp_path / name / "_")) == str(tmp_path / name), "checked from that folder"
        environment = detect(str(launch), None)
        assert environment.packages["p"].share == str(launch.parents[1])
    assert workspace_of(str(file(tmp_path / "other" / "a.launch"))) == str(tmp_path)
    package(tmp_path / "nodes" / "q")
    (tmp_path / "nodes" / "q" / "src").mkdir()
    assert workspace_of(str(file(tmp_path / "nodes" / "q" / "a.launch"))) == str(tmp_path)
    (tmp_path / ".ros-preflight.yaml").touch()
    assert workspace_of(str(tmp_path / "one" / "_")) == str(tmp_path), "the settings say what belongs together"


def test_a_package_of_ros_2_is_not_hidden_by_one_of_ros_1_that_is_installed(tmp_path: Path) -> None:
    install_debian(tmp_path)
    package(tmp_path / "usr" / "share" / "topic_tools")
    prefix = tmp_path / "opt" / "ros" / "jazzy"
    ament(prefix, "topic_tools")
    variables = {"ROS_VERSION": "2", "ROS_DISTRO": "jazzy", "AMENT_PREFIX_PATH": str(prefix)}
    environment = detect_environment(None, variables, root=str(tmp_path))
    assert {name: found.share for name, found in environment.packages.items()} == {
        "topic_tools": str(prefix / "share" / "topic_tools")
    }


def test_each_generation_has_its_packages_where_both_are(tmp_path: Path) -> None:
    install_debian(tmp_path)
    package(tmp_path / "usr" / "share" / "topic_tools")
    prefix = tmp_path / "opt" / "ros" / "jazzy"
    for name in ("topic_tools", "nav2_util"):
        ament(prefix, name)
    manifest = "<package><name>{}</name><export><build_type>{}</build_type></export></package>"
    for name, build_type in (("old", "catkin"), ("new", "ament_cmake"), ("newer", "ament_cmake")):
        (package(tmp_path / "ws" / "src" / name) / "package.xml").write_text(manifest.format(name, build_type))
    environment = detect_environment(str(tmp_path / "ws"), {}, root=str(tmp_path))
    ros1, ros2 = (of_generation(environment, generation).packages for generation in (1, 2))
    assert ros1["topic_tools"].share == str(tmp_path / "usr" / "share" / "topic_tools")
    assert ros2["topic_tools"].share == str(prefix / "share" / "topic_tools")
    assert {"rospy", "old", "new"} <= set(ros1), "rospkg takes what its path has"
    assert {"nav2_util", "old", "new"} <= set(ros2)
    assert "nav2_util" not in ros1
    assert "rospy" not in ros2


def test_of_two_sources_of_one_name_each_generation_means_its_own(tmp_path: Path) -> None:
    manifest = "<package><name>{}</name><export><build_type>{}</build_type></export></package>"
    for folder, build_type in (("a/ros2/one", "ament_cmake"), ("b/ros1/one", "catkin")):
        (package(tmp_path / "ws" / "src" / folder) / "package.xml").write_text(manifest.format("one", build_type))
    environment = detect_environment(str(tmp_path / "ws"), {}, root=str(tmp_path))
    found = [of_generation(environment, generation).packages["one"].share for generation in (1, 2)]
    assert found == [str(tmp_path / "ws/src/b/ros1/one"), str(tmp_path / "ws/src/a/ros2/one")]


def test_a_package_that_both_generations_build_is_seen_by_each_as_it_builds_it(tmp_path: Path) -> None:
    manifest = """<package format="3"><name>both</name><export>
      <build_type condition="$ROS_VERSION == 1">catkin</build_type>
      <build_type condition="$ROS_VERSION == 2">ament_python</build_type></export></package>"""
    (package(tmp_path / "ws" / "src" / "both") / "package.xml").write_text(manifest)
    for version in ("1", "2"):
        environment = detect_environment(str(tmp_path / "ws"), {"ROS_VERSION": version}, root=str(tmp_path))
        built = [of_generation(environment, generation).packages["both"].build_type for generation in (1, 2)]
        assert built == ["catkin", "ament_python"]


def test_a_folder_inside_of_a_package_is_not_taken_for_the_workspace(tmp_path: Path) -> None:
    """Editors that know of no project name the folder of the file that was opened first."""
    launch = tmp_path / "ws" / "robot" / "launch"
    launch.mkdir(parents=True)
    (launch.parent / "package.xml").write_text("<package><name>robot</name></package>")
    assert "robot" in detect(str(launch)).packages
    assert detect(str(launch.parent)).workspace == str(launch.parent)
    assert detect(str(tmp_path / "ws")).workspace == str(tmp_path / "ws")


def test_this_process_s_environment(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package(tmp_path / "p")
    monkeypatch.setenv("ROS_PREFLIGHT_TEST", "here")
    environment = detect(str(file(tmp_path / "p" / "a.launch")), [str(tmp_path)])
    assert environment.workspace == str(tmp_path / "p")
    assert environment.variables["ROS_PREFLIGHT_TEST"] == "here"


def test_rospy_beside_its_own_interpreter(tmp_path: Path) -> None:
    version = f"python3.{sys.version_info.minor}"
    library = tmp_path / "conda" / "lib" / version / "site-packages"
    file(library / "rospy" / "__init__.py")
    interpreter = script(tmp_path / "conda" / "bin" / version)
    assert detect_environment(None, {"PYTHONPATH": str(library)}, root=str(tmp_path)).python == str(interpreter)
    interpreter.unlink()
    environment = detect_environment(None, {"PYTHONPATH": str(library)}, root=str(tmp_path))
    assert environment.python is None
    assert "Python interpreter" in environment.problems[0]


def test_doctor_shows_all_of_it(tmp_path: Path) -> None:
    install_debian(tmp_path)
    package(tmp_path / "ws" / "src" / "p")
    package(tmp_path / "ws" / "src" / "rospy")
    package(tmp_path / "ws" / "src" / "x" / "p")
    rows = describe(detect_environment(str(tmp_path / "ws"), {"ROS_PACKAGE_PATH": "/gone"}, root=str(tmp_path)))
    by_name: dict[str, list[str]] = {}
    for what, value in rows:
        by_name.setdefault(what, []).append(value)
    assert by_name["distribution"] == ["ROS 1 Noetic"]
    assert by_name["workspace"] == [str(tmp_path / "ws")]
    assert by_name["package path"] == [
        "/gone (0 packages)",
        f"{tmp_path}/ws/src (2 packages)",
        f"{tmp_path}/usr/share (0 packages)",
    ]
    assert [row.split(":")[0] for row in by_name["shadowed package"]] == ["p", "rospy"]
    assert by_name["devel space"] == ["none found"]
    assert by_name["system prefix"] == [f"{tmp_path}/usr"]
    assert by_name["interpreter"] == [f"{tmp_path}/usr/bin/python3"]
    assert by_name["problem"] == ["The package path names /gone, which is not a folder."]
