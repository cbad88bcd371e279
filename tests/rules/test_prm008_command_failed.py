"""PRM008: the command of a parameter has no success."""

import json
from dataclasses import replace
from pathlib import Path

import pytest
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.lack import Lack
from preflight_analysis.rules.registry import run_rules
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import analyse, apply, check, findings_of, read_fixture


@pytest.mark.silent
def test_a_command_that_was_not_run_yet_is_no_news() -> None:
    check('<launch><param name="robot_description" command="xacro robot.xacro"/></launch>')


@pytest.mark.silent
def test_a_command_with_success_is_no_news() -> None:
    check("""
        <launch><param name="robot_description" command="xacro robot.xacro"/></launch>
        //- commands
        {"xacro robot.xacro": {"output": "<robot/>"}}
    """)


def test_a_command_that_fails_stops_the_launch() -> None:
    (found,) = check("""
        <launch>
          <param name="robot_description" command="xacro robot.xacro"/>
                                                   ^^^^^^^^^^^^^^^^^ error[PRM008] code 2; no macro; when in x
        </launch>
        //- commands
        {"xacro robot.xacro": {"status": "failed", "reason": "exit code 2",
         "stderr_tail": ["", "no macro", "  when in x"]}}
    """)
    assert found.stops_launch


def test_advice_after_the_error_is_left_out() -> None:
    (found,) = check("""
        <launch>
          <param name="a" command="xacro a.xacro"/>
                                   ^^^^^^^^^^^^^ error[PRM008] code 2; parsing error: x; in file: a.xacro
        </launch>
        //- commands
        {"xacro a.xacro": {"status": "failed", "reason": "exit code 2", "stderr_tail":
         ["warning: old", "parsing error: x", "in file: a.xacro", "", "Check:", "- this", "- that"]}}
    """)
    assert found.message.endswith("a.xacro; Check:")


def test_of_a_traceback_the_last_line_is_told() -> None:
    check("""
        <launch>
          <param name="a" command="./make.py"/>
                                   ^^^^^^^^^ error[PRM008] the command failed: exit code 1; KeyError: 'x'
        </launch>
        //- commands
        {"./make.py": {"status": "failed", "reason": "exit code 1",
         "stderr_tail": ["Traceback (most recent call last):", "  File ...", "KeyError: 'x'"]}}
    """)


def test_a_command_in_an_included_file_is_reported_there() -> None:
    (found,) = check("""
        <launch><include file="/inc.launch"/></launch>
        //- /inc.launch
        <launch>
          <node pkg="p" type="t" name="n"><param name="a" command="false"/></node>
                                                                   ^^^^^ error[PRM008] exit code 1
        </launch>
        //- commands
        {"false": {"status": "failed", "reason": "exit code 1"}}
    """)
    assert [related.location.file for related in found.related] == ["/main.launch"]


def test_a_command_that_cannot_be_split() -> None:
    check("""
        <launch>
          <param name="a" command="echo 'one"/>
                                   ^^^^^^^^^ error[PRM008] malformed command: No closing quotation
        </launch>
    """)


def test_a_program_that_is_not_on_the_path() -> None:
    check("""
        <launch>
          <param name="a" command="xacro arm.xacro"/>
                                   ^^^^^^^^^^^^^^^ hint[PRM008] install ros-noetic-xacro
        </launch>
        //- commands
        {"xacro arm.xacro": {"status": "missing"}}
    """)


def test_a_command_that_lacks_a_package_or_a_module_of_this_machine() -> None:
    for said, lack in (
        ("resource not found: arm_description", Lack("package", "arm_description")),
        ("ModuleNotFoundError: No module named 'lxml'", Lack("module", "lxml")),
        ("resource not found: q", None),
    ):
        commands = {"xacro a": {"status": "failed", "reason": "exit code 2", "stderr_tail": [said]}}
        (finding,) = findings_of(f"""
            <launch><param name="a" command="xacro a"/></launch>
            //- /q/package.xml
            <package/>
            //- commands
            {json.dumps(commands)}
        """)
        assert (finding.severity, finding.lack) == ("hint" if lack else "error", lack)
        assert said in finding.message


def _of_xacro(said: str, more: str = "") -> Finding:
    commands = {"xacro a": {"status": "failed", "reason": "exit code 2", "stderr_tail": [said]}}
    (finding,) = [
        each
        for each in findings_of(f"""
            <launch>{more}<param name="a" command="xacro a"/></launch>
            //- /p/.gitignore
            *.urdf
            //- commands
            {json.dumps(commands)}
        """)
        if each.rule == "PRM008"
    ]
    return finding


def test_a_file_that_is_made_on_each_machine_is_for_information() -> None:
    missing = "error: No such file or directory: /p/arm.{} [Errno 2] No such file or directory: '/p/arm.{}'"
    assert _of_xacro(missing.format("urdf", "urdf")).severity == "info"
    assert _of_xacro(missing.format("xacro", "xacro")).severity == "error"


def test_a_file_of_the_robot() -> None:
    finding = _of_xacro("/usr/bin/cat: /var/lib/robot/password.txt: No such file or directory")
    assert finding.lack == Lack("file", "/var/lib/robot/password.txt")


def test_a_path_that_is_made_of_a_variable_that_is_not_set() -> None:
    missing = "error: No such file or directory: /p/None.xacro"
    finding = _of_xacro(missing, "<!-- os.getenv('ROBOT_BASE') -->")
    assert finding.lack == Lack("variable", "ROBOT_BASE")
    for source in ("<!-- os.getenv('ROBOT_BASE', 'x') -->", "<!-- getenv('PATH_OF') -->", ""):
        found = _of_xacro(missing.replace("None", "Nones" if source else "None"), source)
        assert (found.lack, found.severity) == (None, "error")


def test_an_argument_that_is_empty_has_to_be_given() -> None:
    said = "xacro: error: expected exactly one input file as argument"
    finding = _of_xacro(said, '<arg name="model" default=""/><arg name="rate" default="1"/>')
    assert finding.severity == "info"
    assert finding.message.endswith("; set argument 'model'")
    assert _of_xacro(said).severity == "error"


def test_a_program_that_is_missing_in_its_package_is_found_without_running_anything(tmp_path: Path) -> None:
    package = tmp_path / "xacro"
    package.mkdir()
    (package / "xacro").write_text("#!/bin/sh\n")
    (package / "xacro").chmod(0o755)
    text = f"""
        <launch>
          <param name="a" command="$(find xacro)/xacro.py arm.xacro"/>
                                   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[PRM008] program 'xacro/xacro.py' does not
          <param name="b" command="$(find xacro)/xacro arm.xacro"/>
        </launch>
        //- {package}/package.xml
        <package/>
    """
    (found,) = check(text)
    assert not found.stops_launch, "tree's errors are what was seen to stop it"
    (fix,) = found.fixes
    assert 'command="$(find xacro)/xacro arm.xacro"/>\n  <param name="b"' in apply(text, fix.edits)["/main.launch"]


def test_that_of_a_package_which_is_not_here_has_one_in_its_place() -> None:
    found = findings_of('<launch><param name="a" command="$(find xacro)/xacro.py arm.xacro"/></launch>')
    assert [each.rule for each in found if each.rule != "PKG001"] == ["LCH027"], "which says that it is removed"


def test_a_program_without_permission_to_be_executed(tmp_path: Path) -> None:
    script = tmp_path / "make.py"
    script.write_text("")
    check(f"""
        <launch>
          <param name="a" command="{script}"/>
                                   {"^" * len(str(script))} error[PRM008] is not executable; run `chmod +x {script}
        </launch>
    """)


def test_a_program_that_is_not_built_yet(tmp_path: Path) -> None:
    package = tmp_path / "maker"
    package.mkdir()
    (package / "CMakeLists.txt").write_text("add_executable(make_urdf make_urdf.cpp)\n")
    check(f"""
        <launch>
          <param name="a" command="$(find maker)/make_urdf"/>
                                   ^^^^^^^^^^^^^^^^^^^^^^^ hint[PRM008] is not built yet
        </launch>
        //- {package}/package.xml
        <package/>
    """)


def test_a_file_that_the_build_makes(tmp_path: Path) -> None:
    made = "install(FILES ${CMAKE_CURRENT_BINARY_DIR}/arm.urdf DESTINATION share/arm)"
    (tmp_path / "CMakeLists.txt").write_text(made)
    message = f"/usr/bin/cat: {tmp_path}/arm.urdf: No such file or directory"
    failed = {"status": "failed", "reason": "code 1", "stderr_tail": [message]}
    context = analyse(
        read_fixture(f"""
            <launch><param name="d" command="cat {tmp_path}/arm.urdf"/></launch>
            //- commands
            {json.dumps({f"cat {tmp_path}/arm.urdf": failed})}
        """)
    )
    packages = {"arm": Package("arm", str(tmp_path), f"{tmp_path}/package.xml", build_type="ament_cmake")}
    there = replace(context, environment=replace(context.environment, packages=packages))
    assert [f.severity for f in run_rules(context) if f.rule == "PRM008"] == ["error"]
    (finding,) = [f for f in run_rules(there) if f.rule == "PRM008"]
    assert (finding.severity, finding.lack) == ("hint", Lack("build", "arm", "catkin build arm"))


def test_a_node_that_crashes_without_the_value_of_a_failed_command_is_no_news_of_the_node() -> None:
    check("""
        <launch>
          <param name="model" command="xacro a.xacro"/>
                                       ^^^^^^^^^^^^^ error[PRM008] code 2
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001] /n crashes on start: exit code 1; it reads '/model', which is
        </launch>
        //- commands
        {"xacro a.xacro": {"status": "failed", "reason": "exit code 2"}}
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "params": {"/model": null}}}
    """)


def test_a_file_that_is_found_where_the_launch_file_is() -> None:
    said = ["/usr/bin/cat: r.urdf: No such file or directory"]
    command = {"status": "failed", "reason": "exit code 1", "stderr_tail": said}
    check(f"""
        <launch><param name="robot_description" command="cat r.urdf"/></launch>
                                                         ^^^^^^^^^^ info[PRM008] depends on the folder
        //- /r.urdf
        <robot/>
        //- commands
        {json.dumps({"cat r.urdf": command})}
    """)


def test_a_program_that_another_package_of_the_same_name_has(tmp_path: Path) -> None:
    for folder in ("new", "old"):
        (tmp_path / folder).mkdir()
    (tmp_path / "old" / "set_up.sh").touch()
    new, old = (Package("p", str(tmp_path / each), str(tmp_path / each / "package.xml")) for each in ("new", "old"))
    launch = tmp_path / "main.launch"
    launch.write_text('<launch><param name="a" command="$(find p)/set_up.sh"/></launch>')
    environment = Environment(1, "noetic", {}, (), {"p": new}, {"p": (old,)}, (), (), None)
    findings = Workspace(environment, Sources(), str(tmp_path)).static(str(launch)).findings
    (finding,) = (each for each in findings if each.rule == "PRM008")
    assert finding.severity == "warning"
    assert finding.message.endswith(f"another package of that name has it in '{old.share}'")
