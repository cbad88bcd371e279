"""PKG002: an executable that its package does not have."""

from pathlib import Path
from shutil import rmtree

import pytest
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import findings_of
from support.demo_package import judge
from support.package_elsewhere import analysed
from support.packaging import CMAKE, PYTHON, SETUP, findings


@pytest.mark.parametrize(
    ("written", "meant"), [("talkr.py", "talker.py"), ("talker", "talker.py"), ("Listener", "listener")]
)
def test_an_executable_that_is_not_there_and_the_nearest_one(launch: Path, written: str, meant: str) -> None:
    (finding,) = judge(launch, written)
    assert (finding.rule, finding.severity, finding.stops_launch) == ("PKG002", "error", False)
    assert f"executable '{written}' not found" in finding.message
    assert finding.message.endswith(f"did you mean '{meant}'?")
    assert [edit.text for edit in finding.fixes[0].edits] == [meant]


def test_an_executable_without_a_near_name(launch: Path) -> None:
    (finding,) = judge(launch, "completely_different")
    assert "did you mean" not in finding.message
    assert finding.fixes == ()


def test_a_file_without_the_permission_to_be_executed(launch: Path) -> None:
    (finding,) = judge(launch, "plain.py")
    assert "is not executable; run `chmod +x" in finding.message
    assert (finding.severity, finding.confidence) == ("error", "certain")


def test_a_file_that_only_the_installed_package_may_execute(launch: Path) -> None:
    (launch.parent / "CMakeLists.txt").write_text("install(PROGRAMS nodes/plain.py DESTINATION lib/demo)\n")
    (finding,) = judge(launch, "plain.py")
    assert "start it from the install space" in finding.message
    assert (finding.severity, finding.confidence) == ("warning", "likely")


def test_a_package_whose_build_file_git_ignores(launch: Path) -> None:
    launch.parent.joinpath(".gitignore").write_text("CMakeLists.txt\n")
    rmtree(launch.parent / "nodes")
    (finding,) = judge(launch, "exported")
    assert (finding.rule, finding.severity, finding.fixes) == ("PKG002", "info", ())
    launch.parent.joinpath(".gitignore").write_text("other\n")
    (finding,) = judge(launch, "exported")
    assert finding.severity == "error"


@pytest.mark.silent
def test_an_executable_that_is_there(launch: Path) -> None:
    assert judge(launch, "listener") == []


def test_an_executable_that_is_still_to_be_built(launch: Path) -> None:
    cmake = launch.parent / "CMakeLists.txt"
    cmake.write_text("add_executable(${PROJECT_NAME}_node src/node.cpp)\n# add_executable(gone src/gone.cpp)\n")
    (finding,) = judge(launch, "demo_node")
    assert (finding.rule, finding.severity) == ("PKG002", "hint")
    assert "is not built yet" in finding.message
    (finding,) = judge(launch, "gone")
    assert finding.severity == "error"
    below = launch.parent / "src" / "gone"
    below.mkdir(parents=True)
    (below / "CMakeLists.txt").write_text("add_executable(gone gone.cpp)\n")
    (finding,) = judge(launch, "gone")
    assert finding.severity == "hint"


def test_a_library_is_no_executable(launch: Path) -> None:
    cmake = launch.parent / "CMakeLists.txt"
    cmake.write_text("add_library(${PROJECT_NAME} src/core.cpp)\nadd_executable(demo_node src/node.cpp)\n")
    (finding,) = judge(launch, "demo")
    assert finding.severity == "error"
    assert finding.message.endswith("did you mean 'demo_node'?")


def test_what_an_executable_that_is_not_built_is_made_of(launch: Path) -> None:
    (launch.parent / "CMakeLists.txt").write_text(
        """
        project(demo)
        set(NAME driver)
        add_executable(${NAME}_target src/driver.cpp)
        set_target_properties(${NAME}_target PROPERTIES OUTPUT_NAME ${NAME})
        catkin_install_python(PROGRAMS plain.py)
        install(PROGRAMS tools/calibrate.py RENAME calibrate DESTINATION bin)
        """
    )
    for name, meant in (
        ("driver", "'driver' is not built yet: CMakeLists.txt of package 'demo' builds it from src/driver.cpp"),
        ("plain.py", "'plain.py' is not built yet: CMakeLists.txt of package 'demo' builds it from plain.py"),
        (
            "calibrate",
            "'calibrate' is not installed yet: CMakeLists.txt of package 'demo' installs it from tools/calibrate.py",
        ),
    ):
        (finding,) = judge(launch, name)
        assert (finding.severity, finding.stops_launch) == ("hint", False)
        assert meant in finding.message
    (finding,) = judge(launch, "drivr")
    assert finding.severity == "error"
    assert finding.message.endswith("did you mean 'driver'?")


def test_an_executable_of_another_package_of_the_workspace(launch: Path) -> None:
    """Of one that it depends on, or of the only one."""
    for name in ("more", "other"):
        nodes = launch.parent.parent / name / "nodes"
        nodes.mkdir(parents=True)
        (nodes / "filter").write_text("#!/bin/sh\n")
        (nodes / "filter").chmod(0o755)
    launch.write_text('<launch><node pkg="demo" type="filter" name="n"/></launch>')
    has_it, nobody = ("; package 'other' has it", ["other"]), ("spaces)", list[str]())
    for dependencies, others, (hint, meant) in (
        (frozenset({"other"}), ("more", "other"), has_it),
        (frozenset[str](), ("other",), has_it),
        (frozenset[str](), ("more", "other"), nobody),
    ):
        packages = {
            "demo": Package("demo", str(launch.parent), "", dependencies),
            **{name: Package(name, str(launch.parent.parent / name), "") for name in others},
        }
        environment = Environment(1, "noetic", {}, (str(launch.parent.parent),), packages, {}, (), (), None)
        (finding,) = Workspace(environment, Sources(), str(launch.parent)).static(str(launch)).findings
        assert (finding.rule, finding.severity) == ("PKG002", "error")
        assert finding.message.endswith(hint)
        assert [edit.text for fix in finding.fixes for edit in fix.edits] == meant


def test_an_installed_package_without_its_executables_is_a_lack(tmp_path: Path) -> None:
    share = tmp_path / "usr" / "share" / "tf"
    share.mkdir(parents=True)
    (share / "package.xml").write_text("<package/>")
    launch = tmp_path / "ws" / "a.launch"
    launch.parent.mkdir()
    launch.write_text('<launch><node pkg="tf" type="tf_echo" name="n"/></launch>')
    packages = {"tf": Package("tf", str(share), str(share / "package.xml"))}
    for prefixes, severity in (((str(tmp_path / "usr"),), "hint"), ((), "error")):
        environment = Environment(1, "noetic", {}, (str(tmp_path),), packages, {}, (), prefixes, None)
        (finding,) = Workspace(environment, Sources(), str(launch.parent)).static(str(launch)).findings
        assert (finding.rule, finding.severity, finding.lack is not None) == ("PKG002", severity, severity == "hint")


@pytest.mark.parametrize(
    ("name", "text"),
    [
        (
            "a.launch.xml",
            '<launch><arg name="ns"/><node pkg="demo" exec="drivr" namespace="$(var ns)" name="$(var ns)"/></launch>',
        ),
        ("a.launch.py", 'from launch_ros.actions import Node\nnode = Node(package="demo", executable="drivr")\n'),
    ],
)
def test_a_node_of_which_no_more_is_known_than_its_program(tmp_path: Path, name: str, text: str) -> None:
    share = tmp_path / "src" / "demo"
    share.mkdir(parents=True)
    (share / "package.xml").write_text("<package><name>demo</name></package>")
    (share / "CMakeLists.txt").write_text(
        "add_executable(driver a.cpp)\ninstall(TARGETS driver DESTINATION lib/demo)\n"
    )
    (share / name).write_text(text)
    packages = {"demo": Package("demo", str(share), str(share / "package.xml"))}
    environment = Environment(2, "jazzy", {}, (str(tmp_path / "src"),), packages, {}, (), (), None)
    findings = Workspace(environment, Sources(), str(tmp_path)).static(str(share / name)).findings
    (finding,) = (each for each in findings if each.rule == "PKG002")
    assert (finding.severity, finding.confidence) == ("error", "likely")
    assert "did you mean 'driver'?" in finding.message


@pytest.mark.parametrize(
    ("package", "executable", "fixed"),
    [
        ("demo", "listner", ["listener"]),
        ("$(arg of)", "listner", []),
        ("demo", "filter", ["other"]),
        ("demo", "$(arg what)", []),
    ],
)
def test_a_program_that_another_launch_makes_of_other_arguments(
    launch: Path, package: str, executable: str, fixed: list[str]
) -> None:
    """What is corrected for one value of an argument does not break those of others."""
    other = launch.parent.parent / "other" / "nodes"
    other.mkdir(parents=True)
    (other / "filter").write_text("#!/bin/sh\n")
    (other / "filter").chmod(0o755)
    launch.write_text(f"""
        <launch>
          <arg name="of" default="demo"/>
          <arg name="what" default="filter"/>
          <node pkg="{package}" type="{executable}" name="n" args="$(arg of) $(arg what)"/>
        </launch>
    """)
    packages = {
        "demo": Package("demo", str(launch.parent), "", frozenset({"other"})),
        "other": Package("other", str(other.parent), ""),
    }
    environment = Environment(1, "noetic", {}, (str(launch.parent.parent),), packages, {}, (), (), None)
    (finding,) = Workspace(environment, Sources(), str(launch.parent)).static(str(launch)).findings
    assert finding.rule == "PKG002"
    assert [edit.text for fix in finding.fixes for edit in fix.edits] == fixed


@pytest.mark.parametrize(
    "rest",
    [
        ' args="$(env UNSET)"/>',
        ' output="$(arg undeclared)"/>',
        '><rosparam file="$(env UNSET)/a.yaml"/></node>',
        '><param name="a" value="$(env UNSET)"/></node>',
        '><remap from="a" to="$(env UNSET)"/></node>',
        '><env name="A" value="$(env UNSET)"/></node>',
    ],
)
def test_a_node_whose_program_is_known_whatever_else_is_not(launch: Path, rest: str) -> None:
    """In ROS 1: what is wrong beside the program does not hide that this is not there."""
    findings = judge(launch, "listner", rest)
    (finding,) = (each for each in findings if each.rule == "PKG002")
    assert (finding.severity, finding.message.rpartition("; ")[2]) == ("error", "did you mean 'listener'?")


@pytest.mark.silent
def test_a_node_whose_program_is_not_known(launch: Path) -> None:
    assert [each.rule for each in judge(launch, "$(env UNSET)")] == ["LCH012"]


def test_a_blank_name() -> None:
    (finding,) = (
        each
        for each in findings_of("""
            //- /robot.launch.xml
            <launch><node pkg="not_here" exec="  " name="spawner"/></launch>
        """)
        if each.rule == "PKG002"
    )
    assert (finding.severity, finding.message) == ("error", "executable name of /spawner is blank")


def test_a_name_that_has_to_be_given(launch: Path) -> None:
    (finding,) = judge(launch, "/dev/null")
    assert finding.severity == "info"
    assert finding.message.endswith("; set the argument that names it")


@pytest.mark.parametrize(("distro", "sure"), [("noetic", ("warning", "likely")), (None, ("hint", "possible"))])
def test_a_slip_of_an_executable_of_the_catalogue(tmp_path: Path, distro: str | None, sure: tuple[str, str]) -> None:
    analysis = analysed(tmp_path, '<launch><node pkg="joy" type="joy_nod" name="j"/></launch>', distro=distro)
    (finding,) = (f for f in analysis.findings if f.rule == "PKG002")
    assert (finding.severity, finding.confidence) == sure
    assert finding.message == "package 'joy' of noetic has no executable 'joy_nod'; did you mean 'joy_node'?"
    assert [edit.text for edit in finding.fixes[0].edits] == ["joy_node"]


@pytest.mark.silent
@pytest.mark.parametrize("name", ["joy_node", "another_node", "joy_node2"])
def test_an_executable_that_another_version_may_have(tmp_path: Path, name: str) -> None:
    analysis = analysed(tmp_path, f'<launch><node pkg="joy" type="{name}" name="j"/></launch>', distro="noetic")
    assert [f for f in analysis.findings if f.rule == "PKG002"] == []


def test_a_program_that_a_build_file_names_in_a_way_that_is_not_followed(tmp_path: Path) -> None:
    """A `setup.py` beside a `CMakeLists.txt` that installs the same programs in a loop over texts."""
    share = tmp_path / "src" / "demo"
    share.mkdir(parents=True)
    (share / "package.xml").write_text(
        "<package><name>demo</name><export><build_type>ament_cmake</build_type></export></package>"
    )
    entry = "entry_points={'console_scripts': ['driver = demo.driver:main', 'reader = demo.reader:main']}"
    (share / "setup.py").write_text(f"from setuptools import setup\nsetup(name='demo', packages=['demo'], {entry})\n")
    (share / "CMakeLists.txt").write_text("""
        add_executable(viewer a.cpp)
        install(TARGETS viewer DESTINATION lib/${PROJECT_NAME})
        foreach(each "driver:scripts/driver.py")
          string(SUBSTRING ${each} 0 6 name)
          string(SUBSTRING ${each} 7 -1 file)
          install(PROGRAMS ${file} DESTINATION lib/${PROJECT_NAME} RENAME ${name})
        endforeach()
    """)
    launch = share / "a.launch.xml"
    launch.write_text('<launch><node pkg="demo" exec="driver"/><node pkg="demo" exec="drivr"/></launch>')
    packages = {"demo": Package("demo", str(share), str(share / "package.xml"), build_type="ament_cmake")}
    environment = Environment(2, "jazzy", {}, (str(tmp_path / "src"),), packages, {}, (), (), None)
    findings = Workspace(environment, Sources(), str(tmp_path)).static(str(launch)).findings
    found = [(f.severity, f.message.partition("; ")[2]) for f in findings if f.rule == "PKG002"]
    assert [severity for severity, _ in found] == ["info", "error"]


@pytest.mark.parametrize(
    ("lists", "said"),
    [
        ("project(arm)\nament_package()\n", ["executable 'reader' not found in package 'arm' (0 executables"]),
        ("project(arm)\ninclude(own.cmake)\nmake_programs()\nament_package()\n", []),
    ],
)
def test_a_package_that_has_launch_files_alone(tmp_path: Path, lists: str, said: list[str]) -> None:
    launch = '<launch><node pkg="arm" exec="reader"/></launch>'
    found = findings(tmp_path, {**CMAKE, "CMakeLists.txt": lists, "launch/arm.launch.xml": launch}, "PKG002")
    assert [each.message.startswith(start) for each, start in zip(found, said, strict=True)] == [True] * len(said)


@pytest.mark.parametrize(
    ("setup", "said"),
    [
        (SETUP, 1),
        (SETUP.replace("setup(", "_ = setup(").replace("'driver = ", "'reader = "), 0),
        ("import own\nown.setup_up()\n", 0),
        (None, 0),
    ],
)
def test_a_package_in_python_without_executables(tmp_path: Path, setup: str | None, said: int) -> None:
    """https://github.com/onkoe/auto_ros2; without a setup.py, whatever pyproject.toml says."""
    launch = '<launch><node pkg="arm" exec="reader"/></launch>'
    files = {**PYTHON, "launch/arm.launch.xml": launch}
    files = (
        {**files, "setup.py": setup} if setup else {name: text for name, text in files.items() if name != "setup.py"}
    )
    assert len(findings(tmp_path, files, "PKG002")) == said


IN_BIN = "error CMakeLists.txt of package 'arm' builds it and installs it in bin, not in lib/arm"


@pytest.mark.parametrize(
    ("installs", "said"),
    [
        ("", ["error CMakeLists.txt of package 'arm' builds it and does not install it"]),
        (
            "install(TARGETS driver DESTINATION bin)",
            ["error CMakeLists.txt of package 'arm' builds it and installs it in bin, not in lib/arm"],
        ),
        (
            "install(TARGETS driver)",
            ["error CMakeLists.txt of package 'arm' builds it and installs it in bin, not in lib/arm"],
        ),
        ("install(TARGETS driver RUNTIME DESTINATION lib/${PROJECT_NAME})", ["hint"]),
        ("install(TARGETS driver LIBRARY DESTINATION lib RUNTIME DESTINATION lib/arm)", ["hint"]),
        ("install_all_of_it()", ["hint"]),
    ],
)
def test_a_target_that_is_built_and_not_installed(tmp_path: Path, installs: str, said: list[str]) -> None:
    lists = f"project(arm)\nadd_executable(driver src/driver.cpp)\n{installs}\nament_package()\n"
    launch = '<launch><node pkg="arm" exec="driver"/></launch>'
    found = findings(tmp_path, {**CMAKE, "CMakeLists.txt": lists, "launch/arm.launch.xml": launch}, "PKG002")
    assert len(found) == len(said)
    for finding, expected in zip(found, said, strict=True):
        severity, _, message = expected.partition(" ")
        assert (finding.severity, finding.message.endswith(message)) == (severity, True)


def test_the_name_of_the_project_is_no_executable(launch: Path) -> None:
    cmake = launch.parent / "CMakeLists.txt"
    cmake.write_text("project(demo)\nadd_executable(driver src/node.cpp)\ncatkin_package()\n")
    (finding,) = judge(launch, "demo")
    assert finding.severity == "error"
