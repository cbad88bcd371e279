"""TRC001: a node crashed when it was run."""

import json
from dataclasses import replace
from pathlib import Path

import pytest
from preflight_analysis.environment.executables import ExecutableIndex
from preflight_analysis.environment.model import Package, Packages
from preflight_analysis.findings.lack import Lack
from preflight_analysis.model.installed import lack_of_build, lack_of_made, lack_said
from preflight_analysis.tracing.interface import telling_line
from support.check import analyse, check, findings_of, read_fixture, run_rules


def test_where_a_node_is_not_known_a_global_parameter_may_be_its() -> None:
    check("""
        <launch>
          <param name="rate" value="20"/>
          <node pkg="p" type="t" name="n"/>
          <node pkg="p" type="t" name="m"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TRC001]
        </launch>
        //- interfaces
        {"/n": {"params": {"~rate": 10}}, "/m": {"status": "crashed", "exit_code": 1}}
    """)


@pytest.mark.parametrize(
    ("module", "lack"),
    [
        ("torch", Lack("module", "torch")),
        ("p", Lack("build", "p", "catkin build p")),
        ("p.msg", Lack("build", "p", "catkin build p")),
        ("p.utlis", None),
    ],
)
def test_a_crash_for_a_module_that_is_not_here_is_none_of_the_robot(module: str, lack: Lack | None) -> None:
    severity = "hint" if lack else "warning"
    (finding,) = check(f"""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ {severity}[TRC001] No module named '{module}'
        </launch>
        //- interfaces
        {{"/n": {{"status": "crashed", "exit_code": 1, "stderr": ["ModuleNotFoundError: No module named '{module}'"]}}}}
    """)
    assert finding.lack == lack


def test_a_crash_says_why() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TRC001] exit code 1; FileNotFoundError: no such file: '/m.json'
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "stderr":
                ["Traceback (most recent call last):", "FileNotFoundError: no such file: '/m.json'", "[shutdown]", ""]}}
    """)


def test_a_crash_after_a_made_up_answer_may_be_our_doing() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001] killed by SIGSEGV
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "signal": "SIGSEGV", "publishers": {"/tf": "x/Y"}, "speculative": ["/tf"]}}
    """)


def test_an_end_after_a_made_up_answer_may_be_our_doing_even_if_nothing_was_found_after_it() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001] IndexError
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "stderr": ["IndexError: 0"], "answers": ["it got an empty scan"]}}
    """)


def test_a_crash_for_want_of_a_command_that_was_not_run_is_our_doing() -> None:
    check("""
        <launch>
          <param name="robot_description" command="xacro robot.xacro"/>
                                                   ^^^^^^^^^^^^^^^^^ hint[LCH018] command not run, its value is
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001] /n crashes on start: exit code 1; it reads
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "params": {"/robot_description": null}}}
        //- commands
        {"xacro robot.xacro": {"status": "not-run", "reason": "--no-run was given"}}
    """)


@pytest.mark.parametrize("ros", [1, 2])
def test_a_description_of_which_only_the_structure_is_known_is_not_given_to_a_run(ros: int) -> None:
    text = "<!-- from the catalogue of ros-preflight for noetic, parts --><robot><link name='a'/></robot>"
    if ros == 1:
        launch = """<launch>
          <param name="robot_description" command="xacro r"/>
          <node pkg="p" type="t" name="n"/></launch>"""
    else:
        launch = """//- /main.launch.xml
        <launch><node pkg="p" exec="t" name="n">
          <param name="robot_description" type="str" value="$(command 'xacro r')"/></node></launch>"""
    told = "Could not find parameter robot_description on parameter server"
    interfaces = {"/n": {"status": "crashed", "exit_code": 1, "params": {}, "stderr": [told]}}
    commands = {"xacro r": {"status": "not-run", "reason": "package 'parts' is not installed here", "output": text}}
    found = findings_of(f"{launch}\n//- interfaces\n{json.dumps(interfaces)}\n//- commands\n{json.dumps(commands)}")
    (crash,) = (each for each in found if each.rule == "TRC001")
    assert (crash.severity, crash.confidence) == ("info", "possible")
    assert "robot_description', which is unresolved" in crash.message


@pytest.mark.parametrize(
    "setting",
    [
        '<param name="robot_description" command="$(find nowhere)/xacro r.xacro"/>',
        '<param name="robot_description" textfile="$(find p)/r.urdf"/>',
        '<param name="robot_description" value="$(env NOT_SET_HERE)"/>',
        '<param name="robot_description" type="int" value="none"/>',
        '<rosparam param="robot_description" command="load" file="$(find p)/r.yaml"/>',
        '<rosparam file="$(find p)/r.yaml"/>',
        '<rosparam param="robot_description">{</rosparam>',
    ],
)
@pytest.mark.parametrize("access", ["get", "has"])
def test_a_crash_for_want_of_a_value_that_is_reported_itself_is_a_consequence(setting: str, access: str) -> None:
    found = findings_of(f"""
        <launch>
          {setting}
          <node pkg="p" type="t" name="n"/>
        </launch>
        //- interfaces
        {{"/n": {{"status": "crashed", "exit_code": 1, "params": {{"/robot_description": {{"access": "{access}"}}}},
                 "stderr": ["Could not find parameter robot_description on parameter server"]}}}}
    """)
    (crash,) = (each for each in found if each.rule != "PRM010" and each.rule.startswith(("TRC", "PRM01")))
    assert (crash.rule, crash.severity, crash.confidence) == ("TRC001", "info", "possible")
    assert "it reads '/robot_description', which is unresolved: " in crash.message
    assert any(each.stops_launch for each in found)


def test_the_description_under_the_name_that_a_remap_gives() -> None:
    (crash,) = (
        each
        for each in findings_of("""
        <launch>
          <node pkg="p" type="t" name="n"><remap from="robot_description" to="arm_description"/></node>
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "params": {"/arm_description": {"access": "search"}},
                "stderr": ["Could not find parameter robot_description on parameter server"]}}
    """)
        if each.rule == "TRC001"
    )
    assert (crash.severity, crash.confidence) == ("info", "possible")
    assert "'/arm_description', which another launch may set" in crash.message


def test_a_crash_for_want_of_a_private_value_that_is_reported_itself_is_a_consequence() -> None:
    check("""
        <launch>
          <param name="~model" value="$(find nowhere)/m"/>
                                      ^^^^^^^^^^^^^^^ info[PKG001] package 'nowhere' is neither
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001] /n crashes on start: exit code 1; it reads '/n/model', which
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "params": {"~model": null}}}
    """)


def test_a_crash_for_another_reason_stays_a_warning_where_a_value_is_missing() -> None:
    check("""
        <launch>
          <param name="robot_description" value="$(find nowhere)/m"/>
                                                 ^^^^^^^^^^^^^^^ info[PKG001] package 'nowhere' is neither
          <param name="model" value="x"/>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TRC001] exit code 1
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "params": {"/model": null}}}
    """)


def test_a_crash_for_what_only_the_sandbox_lacks_is_no_warning() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001] /n needs a network; it exited with exit code 1; OSError:
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "lacks": "a network",
                 "stderr": ["OSError: [Errno 101] Network is unreachable"]}}
    """)


@pytest.mark.silent
def test_a_node_that_spins_is_not_mentioned() -> None:
    assert (
        findings_of("""
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {"/n": {}}
    """)
        == []
    )


def test_a_long_last_line_is_told_once_and_without_its_time() -> None:
    line = "[FATAL] [1795283767.248522279]: " + "no such device, " * 40
    reason = "it ended with exit code 1: " + ("no such device, " * 40)[:200]
    text = """
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "reason": "REASON", "stderr": ["LINE"]}}
    """
    (finding,) = findings_of(text.replace("LINE", line).replace("REASON", reason))
    assert finding.message == "/n crashes on start: " + ("no such device, " * 40)[:200]
    (finding,) = findings_of(text.replace("LINE", line).replace('"reason": "REASON", ', ""))
    assert finding.message == "/n crashes on start: exit code 1; " + ("no such device, " * 40)[:200]


def test_an_early_end_with_an_error() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="failed"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TRC001] exit code 3
        </launch>
        //- interfaces
        {"/failed": {"status": "exited", "exit_code": 3}}
    """)


def test_a_crash_for_want_of_what_an_unknown_include_may_set() -> None:
    text = """
        <launch>
          <include file="$(find {package})/launch/model.launch"/>
          <node pkg="p" type="t" name="n"/>
        </launch>
        //- /p/launch/model.launch
        <launch/>
        //- interfaces
        {{"/n": {{"status": "crashed", "exit_code": 1, "params": {{"/board_description": {{"access": "has"}}}},
                  "stderr": ["RuntimeError: board_description is required and not set"]}}}}
    """
    (found,) = [f for f in findings_of(text.format(package="panda_moveit_config")) if f.rule == "TRC001"]
    assert (found.severity, found.confidence) == ("info", "possible")
    assert "'/board_description', which an unresolved part of the launch may set" in found.message
    (found,) = [f for f in findings_of(text.format(package="p")) if f.rule == "TRC001"]
    assert "may set" not in found.message


@pytest.mark.parametrize(
    ("said", "lack"),
    [
        (
            "If this is a valid message type, perhaps you need to type 'rosmake ackermann_msgs'",
            ("package", "ackermann_msgs"),
        ),
        ("/a/b.sh: line 5: v4l2-ctl: command not found", ("program", "v4l2-ctl")),
        ("/a/b.sh: line 5: pyhton: command not found", None),
        ("/a/b.sh: 17: /usr/sbin/mini-httpd: not found", ("program", "mini-httpd")),
        ("/a/b.sh: 17: v4l2-ctl: not found", ("program", "v4l2-ctl")),
        ("/a/b.sh: 17: ./driver: not found", None),
        ("RLException: [x.launch] is neither a launch file in package [elsewhere] nor is", ("package", "elsewhere")),
        ("Could not find library corresponding to plugin p/Logger. Make sure that", ("build", "p")),
        (
            "  File \"/usr/lib/python3.11/os.py\", in __getitem__, os.environ\nKeyError: 'ROS_DISTRO'",
            ("variable", "ROS_DISTRO"),
        ),
        ("KeyError: 'ROS_DISTRO'", None),
        ("    sys.modules['simple_pid.PID'].x = 1\nKeyError: 'simple_pid.PID'", ("module", "simple_pid")),
        ("Environment configuration is invalid: cannot locate rospack ([Errno 2])", ("program", "rospack")),
        ("    f'at {\n    ^\nSyntaxError: unterminated string literal", ("program", "python3.12")),
        ('    f"{Duration.of(\n    ^\nSyntaxError: unterminated string literal', ("program", "python3.12")),
        ("    f'at {rate} Hz)\n    ^\nSyntaxError: unterminated string literal", None),
        ("""    x = f"{a["b"]}"\n    ^\nSyntaxError: f-string: unmatched '['""", ("program", "python3.12")),
        ("""    x = f"\\"{a + "b"}\\""\n    ^\nSyntaxError: f-string: expecting '}'""", ("program", "python3.12")),
        (
            """    x = f"{get(f"{a}.b").c} d"\n    ^\nSyntaxError: f-string: unmatched '('""",
            ("program", "python3.12"),
        ),
        ("""    x = f"{a" + "b"\n    ^\nSyntaxError: f-string: expecting '}'""", None),
        (
            "    x = f'{'\\n'}'\n    ^\nSyntaxError: f-string expression part cannot include a backslash",
            ("program", "python3.12"),
        ),
        ("    type Point = tuple\n         ^^^^^\nSyntaxError: invalid syntax", ("program", "python3.12")),
        ("    typo Point = tuple\n         ^^^^^\nSyntaxError: invalid syntax", None),
        (
            "  subprocess.run(['sudo'])\nFileNotFoundError: [Errno 2] No such file or directory: 'sudo'",
            ("program", "sudo"),
        ),
        ("FileNotFoundError: [Errno 2] No such file or directory: 'model'", None),
        ("ModuleNotFoundError: No module named 'django'\nImportError: Couldn't import Django.", ("module", "django")),
        ("ModuleNotFoundError: No module named 'django'\nValueError: 3", None),
    ],
)
def test_what_programs_say_of_this_machine(said: str, lack: tuple[str, str] | None) -> None:
    interface = {"status": "crashed", "exit_code": 1, "stderr": said.splitlines()}
    found = findings_of(f"""
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {json.dumps({"/n": interface})}
    """)
    (finding,) = [each for each in found if each.rule == "TRC001"]
    assert (finding.lack and (finding.lack.kind, finding.lack.name)) == lack
    assert finding.severity == ("hint" if lack else "warning")


def test_a_node_that_refuses_a_parameter_that_has_to_be_given() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="poses" default=""/>
          <node pkg="p" exec="t" name="n">
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001] ValueError: poses_file is required; parameter 'poses_file'
            <param name="poses_file" value="$(var poses)"/>
            <param name="mode" value="fast"/>
          </node>
          <node pkg="p" exec="t" name="m">
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TRC001] ValueError: mode is not known
            <param name="poses_file" value="$(var poses)"/>
            <param name="mode" value="fast"/>
          </node>
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "stderr": ["ValueError: poses_file is required"],
                "params": {"~poses_file": "", "~mode": ""}},
         "/m": {"status": "crashed", "exit_code": 1, "stderr": ["ValueError: mode is not known"],
                "params": {"~poses_file": "", "~mode": ""}}}
    """)


def test_a_node_that_is_started_again_until_somebody_has_set_its_parameter() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n" respawn="true"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001]
          <node pkg="p" type="t" name="m"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TRC001]
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "stderr": ["Could not find parameter x on parameter server"]},
         "/m": {"status": "crashed", "exit_code": 1, "stderr": ["Could not find parameter x on parameter server"]}}
    """)


def test_a_package_that_is_not_built_is_told_by_its_library_and_its_files(tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text("""
        add_library(planner_nodelet planner.cpp)
        install(FILES ${CMAKE_BINARY_DIR}/arm.urdf DESTINATION share/${PROJECT_NAME})""")
    manifest = f"{tmp_path}/package.xml"
    packages = {"robot": Package("robot", str(tmp_path), manifest, build_type="ament_cmake")}
    context = analyse(read_fixture("<launch/>"))
    built = replace(context, environment=replace(context.environment, packages=packages))
    built = replace(built, executables=ExecutableIndex(built.environment))
    lack = Lack("build", "robot", "catkin build robot")
    assert lack_of_made(built, f"{tmp_path}/arm.urdf") == lack
    for said in (
        "for plugin Planner. Make sure that the library 'lib/libplanner_nodelet' actually exists.",
        "Failed to load library /ws/devel/lib//libplanner_nodelet.so. Make sure that you are calling the macro",
    ):
        assert lack_said(built, [said]) == lack
        assert lack_said(built, [said.replace("planner", "other")]) is None
    assert lack_of_made(built, f"{tmp_path}/other.urdf") is None


def test_a_file_that_is_installed_from_another_folder_is_not_built(tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text("install(DIRECTORY arm/urdf DESTINATION share/${PROJECT_NAME})")
    (tmp_path / "arm/urdf").mkdir(parents=True)
    (tmp_path / "arm/urdf/arm.xacro").write_text("<robot/>")
    packages = {"robot": Package("robot", str(tmp_path), f"{tmp_path}/package.xml", build_type="ament_cmake")}
    context = analyse(read_fixture("<launch/>"))
    here = replace(context, environment=replace(context.environment, packages=packages))
    assert lack_of_made(here, f"{tmp_path}/urdf/arm.xacro") == Lack("build", "robot", "catkin build robot")
    assert lack_of_made(here, f"{tmp_path}/urdf/leg.xacro") is None


def test_what_an_installed_package_lacks_is_not_built_in_the_workspace() -> None:
    context = analyse(read_fixture("<launch/>\n//- /usr/share/tf/package.xml\n<package/>"))
    installed = replace(context, environment=replace(context.environment, system_prefixes=("/usr",)))
    assert lack_of_build(installed, "tf") == Lack("package", "tf", "apt install ros-noetic-tf")
    assert lack_of_build(installed, "p") == Lack("build", "p", "catkin build p")
    of_rosbuild = Packages({"p": Package("p", "/ws/p", "/ws/p/manifest.xml")})
    legacy = replace(installed, environment=replace(installed.environment, packages=of_rosbuild))
    assert lack_of_build(legacy, "p") == Lack("build", "p", "rosmake p")


@pytest.mark.parametrize(
    ("said", "severity"),
    [
        ("FileNotFoundError: /sim_ws/src/racing/racelines/track.csv not found.", "info"),
        ("FileNotFoundError: [Errno 2] No such file or directory: '/sim_ws/maps/hall.yaml'", "info"),
        ("[ERROR] failed to open /sim_ws/src/map.pgm", "info"),
        ("Error opening file: drive.bag", "info"),
        ("Error reading from file: drive.bag", "warning"),
        ("Error reading version line", "info"),
        ("The traceback for the exception was written to the log file", "info"),
        ("RLException: environment variable 'LD_LIBRARY_PATH' is not set", "hint"),
        ("Error opening file: /home/somebody/Datasets/drive.bag", "info"),
        ("Error writing: Error opening file: /mnt/recordings/drive.bag.active", "info"),
        ("Invalid target directory '/home/somebody/Documents/Data'.", "info"),
        ("/bin/sh: 33: .: cannot open /share/gazebo//setup.sh: No such file", "info"),
        ("FileNotFoundError: [Errno 2] No such file or directory: '/home/missing.yaml'", "warning"),
        ("FileNotFoundError: [Errno 2] No such file or directory: '/usr/share/robot_maps/hall.yaml'", "warning"),
        ("FileNotFoundError: [Errno 2] No such file or directory: 'maps/hall.yaml'", "warning"),
        ("ValueError: /camera/image is no topic of this robot", "warning"),
    ],
)
def test_a_file_in_a_folder_of_another_machine(said: str, severity: str) -> None:
    """A container has it, where the workspace is mounted."""
    found = findings_of(f"""
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {json.dumps({"/n": {"status": "crashed", "exit_code": 1, "stderr": [said]}})}
    """)
    (finding,) = [each for each in found if each.rule == "TRC001"]
    assert finding.severity == severity


def test_a_signal_that_killed_another_program_of_a_script() -> None:
    for program, severity in (("chromium", "info"), ("./detector", "warning")):
        check(f"""
            <launch>
              <node pkg="p" type="t" name="n"/>
              ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ {severity}[TRC001] Trace/breakpoint trap
            </launch>
            //- interfaces
            {{"/n": {{"status": "crashed", "exit_code": 133,
                     "stderr": ["/p/gui.sh: line 9:     7 Trace/breakpoint trap   {program} --app=$1"]}}}}
        """)


@pytest.mark.parametrize(("ignored", "severity"), [("*.dat", "info"), ("*.txt", "warning")])
def test_a_file_that_git_ignores_is_made_on_each_machine(tmp_path: Path, ignored: str, severity: str) -> None:
    (tmp_path / ".gitignore").write_text(ignored)
    check(f"""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ {severity}[TRC001] Error opening file
        </launch>
        //- interfaces
        {{"/n": {{"status": "crashed", "exit_code": 1, "stderr": ["Error opening file: {tmp_path}/drive.dat"]}}}}
    """)


@pytest.mark.parametrize(("file", "severity"), [("com.yaml", "hint"), ("../com.yaml", "warning")])
def test_a_file_of_a_submodule_that_is_not_checked_out(tmp_path: Path, file: str, severity: str) -> None:
    (tmp_path / ".gitmodules").write_text('[submodule "messages"]\n\tpath = messages\n')
    path = (tmp_path / "messages" / file).resolve()
    (finding,) = check(f"""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ {severity}[TRC001] Error opening file
        </launch>
        //- interfaces
        {{"/n": {{"status": "crashed", "exit_code": 1, "stderr": ["Error opening file: {path}"]}}}}
    """)
    lack = Lack("submodule", "messages", "git submodule update --init messages")
    assert finding.lack == (lack if severity == "hint" else None)


@pytest.mark.parametrize(("said", "lacks"), [("submodule aioice is empty", True), ("no device", False)])
def test_a_node_that_names_a_submodule_of_its_package(tmp_path: Path, said: str, lacks: bool) -> None:
    (tmp_path / ".gitmodules").write_text('[submodule "x"]\n\tpath = p/libraries/aioice\n')
    context = analyse(
        read_fixture(f"""
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {{"/n": {{"status": "crashed", "exit_code": 1, "stderr": ["{said}"]}}}}
    """)
    )
    package = Package("p", f"{tmp_path}/p", f"{tmp_path}/p/package.xml")
    environment = replace(context.environment, packages=Packages({"p": package}))
    (finding,) = [each for each in run_rules(replace(context, environment=environment)) if each.rule == "TRC001"]
    assert (finding.lack is not None) is lacks


@pytest.mark.parametrize(
    ("path", "severity"), [("/tmp/made_robot.sdf", "info"), ("robot.sdf", "warning"), ("/tmp", "warning")]
)
def test_a_temporary_file_that_the_launch_file_may_write(path: str, severity: str) -> None:
    check(f"""
        <launch>
          <node pkg="p" type="t" name="n" args="-file {path}"/>
          {"^" * (len(path) + 47)} {severity}[TRC001] %s does not exist
        </launch>
        //- interfaces
        {{"/n": {{"status": "crashed", "exit_code": 1, "stderr": ["Error: file %s does not exist"]}}}}
    """)


@pytest.mark.parametrize(("name", "severity"), [("map_place", "hint"), ("map_origin", "warning")])
def test_a_parameter_that_is_empty_as_a_variable_is_not_set(name: str, severity: str) -> None:
    check(f"""
        //- /a.launch.py
        import os
        from launch import LaunchDescription
        from launch.actions import IncludeLaunchDescription
        PLACE = os.environ.get('MAP_PLACE', '')
        def generate_launch_description():
            return LaunchDescription([IncludeLaunchDescription('/n.launch.xml')])
        //- /n.launch.xml
        <launch>
          <node pkg="p" exec="e" name="n">
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ {severity}[TRC001] exit code 1
            <param name="{name}" value="''"/>
          </node>
        </launch>
        //- interfaces
        {{"/n": {{"status": "crashed", "exit_code": 1}}}}
    """)


def test_a_file_of_the_home_folder_that_is_not_here() -> None:
    said = "FileNotFoundError: [Errno 2] No such file or directory: '{}/.ros/data'"
    for folder, lacks in (("/home/me", True), ("/p", False), ("/home/you", False)):
        context = analyse(
            read_fixture(f"""
            <launch><node pkg="p" type="t" name="n"/></launch>
            //- interfaces
            {{"/n": {{"status": "crashed", "exit_code": 1, "stderr": ["{said.format(folder)}"]}}}}
        """)
        )
        environment = replace(context.environment, variables={"HOME": "/home/me"})
        (finding,) = [each for each in run_rules(replace(context, environment=environment)) if each.rule == "TRC001"]
        assert (finding.lack is not None) is lacks


@pytest.mark.parametrize("name", ["/robot_description", "/boat/robot_description"])
@pytest.mark.parametrize("known", ["~", "/"])
def test_the_description_of_the_robot_may_be_set_by_another_launch(known: str, name: str) -> None:
    text = """
        <launch>
          SETTING
          <node pkg="p" type="t" name="n"/>
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "params": {PRIVATE"NAME": {"access": "has"}},
                "stderr": ["RuntimeError: robot_description is required and not set"]}}
    """.replace("PRIVATE", '"~robot_description": {"access": "has"}, ' if known == "~" else "").replace("NAME", name)
    (found,) = [f for f in findings_of(text.replace("SETTING", "")) if f.severity not in ("hint",)]
    assert (found.rule, found.severity, found.confidence) == ("TRC001", "info", "possible")
    assert "robot_description', which another launch may set" in found.message
    elsewhere = findings_of(text.replace("SETTING", '<param name="arm/robot_description" value="x"/>'))
    assert "warning" in [f.severity for f in elsewhere if f.rule in ("TRC001", "PRM010")]


def test_a_test_that_fails_alone() -> None:
    check("""
        <launch>
          <test test-name="n" pkg="p" type="t"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001] exit code 1
        </launch>
        //- interfaces
        {"/n": {"status": "exited", "exit_code": 1}}
    """)


def test_a_crash_with_an_argument_that_is_not_known() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n" args="$(env NOT_SET)"/>
                                                ^^^^^^^^^^^^^^ hint[LCH012]
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001]
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 2}}
    """)


def test_a_recording_on_a_disk_that_is_not_here() -> None:
    said = "Error opening file: /media/patrick/RPNG FLASH 3/outdoor.bag"
    check(f"""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001] this machine has no '/media/patrick'
        </launch>
        //- interfaces
        {{"/n": {{"status": "crashed", "exit_code": 1, "stderr": ["{said}"]}}}}
    """)


def test_a_crash_for_what_the_launch_sets_to_a_value_that_is_not_known() -> None:
    (crash,) = [
        f
        for f in findings_of("""
        <launch>
          <param name="robot_description" command="$(find nowhere)/xacro r.xacro"/>
          <node pkg="p" type="t" name="n"/>
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1,
                "stderr": ["Could not find parameter robot_description on parameter server"]}}
    """)
        if f.rule == "TRC001"
    ]
    assert crash.severity == "info"
    assert crash.message.endswith("it reads '/robot_description', which is unresolved")


def test_a_crash_for_a_parameter_that_an_unresolved_include_may_set() -> None:
    found = findings_of("""
        <launch>
          <include file="$(find nowhere)/launch/load.launch"/>
          <node pkg="p" type="t" name="n"/>
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1,
                "stderr": ["Could not find parameter robot_description on parameter server"]}}
    """)
    (crash,) = [f for f in found if f.rule == "TRC001"]
    assert crash.severity == "info"
    assert crash.message.endswith("it reads a parameter, which an unresolved part of the launch may set")


@pytest.mark.parametrize(
    ("args", "said", "severity"),
    [
        ("--db $(arg path)", "IOError: no input file", "info"),
        ("--db $(arg path) $(arg other)", "Usage: read FILE", "info"),
        ("--db $(arg other)", "Usage: read FILE", "warning"),
        ("--db $(arg path)", "ValueError: 12", "warning"),
    ],
)
def test_a_crash_for_an_argument_that_is_empty_until_it_is_given(args: str, said: str, severity: str) -> None:
    (finding,) = findings_of(f"""
        <launch>
          <arg name="path" default=""/>
          <arg name="other" default="x"/>
          <param name="other" value="$(arg path)$(arg other)"/>
          <node pkg="p" type="t" name="n" args="{args}"/>
        </launch>
        //- interfaces
        {{"/n": {{"status": "crashed", "exit_code": 1, "stderr": ["{said}"], "params": {{"/other": "x"}}}}}}
    """)
    assert (finding.rule, finding.severity) == ("TRC001", severity)
    assert finding.message.endswith("; argument 'path' is empty") == (severity == "info")


def test_a_crash_of_a_program_that_the_node_starts_does_not_say_what_that_lacks() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001] Command '['git', 'rev-parse']' returned
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "stderr":
                ["subprocess.CalledProcessError: Command '['git', 'rev-parse']' returned non-zero exit status 1"]}}
    """)


def test_what_the_logger_says_of_itself_is_not_why_a_node_ended() -> None:
    lines = ("[ERROR] [1.5]: Error opening file: /x/a.log", "log4cxx: Please initialize the log4cxx system properly.")
    assert telling_line(lines) == "Error opening file: /x/a.log"


@pytest.mark.parametrize(("other", "severity"), [("q", "info"), ("", "warning")])
def test_a_crash_for_a_module_that_two_packages_have(tmp_path: Path, other: str, severity: str) -> None:
    for package in filter(None, ("p", other)):
        (tmp_path / package / "src" / "sonar").mkdir(parents=True)
    said = "ImportError: cannot import name 'sonar' from 'sonar' (unknown location)"
    found = findings_of(f"""
        //- {tmp_path}/main.launch
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- {tmp_path}/p/package.xml
        <package/>
        //- {tmp_path}/q/package.xml
        <package/>
        //- interfaces
        {{"/n": {{"status": "crashed", "exit_code": 1, "stderr": ["{said}"]}}}}
    """)
    assert [f.severity for f in found if f.rule == "TRC001"] == [severity]


def test_a_crash_for_a_file_that_another_program_writes() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001] Input world file is invalid
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "stderr": ["ValueError: Input world file is invalid, /tmp/a"]}}
    """)


@pytest.mark.parametrize(("said", "severity"), [("x: '__X_RATE__' is no double", "info"), ("x is 1", "warning")])
def test_a_value_that_a_program_writes_before(said: str, severity: str) -> None:
    check(f"""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ {severity}[TRC001] exit code 1
        </launch>
        //- interfaces
        {{"/n": {{"status": "crashed", "exit_code": 1, "stderr": ["{said}"]}}}}
    """)


@pytest.mark.parametrize(("said", "severity"), [("bag is required", "info"), ("map is required", "warning")])
def test_a_parameter_whose_argument_nobody_gives(said: str, severity: str) -> None:
    found = findings_of(f"""
        //- /a.launch.xml
        <launch>
          <arg name="file"/>
          <node pkg="p" exec="e" name="n"><param name="bag" value="$(var file)"/></node>
        </launch>
        //- interfaces
        {{"/n": {{"status": "crashed", "exit_code": 1, "stderr": ["{said}"]}}}}
    """)
    assert [each.severity for each in found if each.rule == "TRC001"] == [severity]


@pytest.mark.parametrize(("line", "found"), [("<<<<<<< HEAD", True), ("x = (", False)])
def test_marks_of_a_merge_conflict_are_named(line: str, found: bool) -> None:
    tail = json.dumps(['  File "/p/n.py", line 2', f"    {line}", "    ^^", "SyntaxError: invalid syntax"])
    (finding,) = findings_of(f"""
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {{"/n": {{"status": "crashed", "exit_code": 1, "stderr": {tail}}}}}
    """)
    assert finding.message.endswith("SyntaxError: invalid syntax; its source has marks of a merge conflict") is found
