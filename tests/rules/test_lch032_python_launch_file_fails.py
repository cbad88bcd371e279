"""LCH032: a Python launch file raises an exception."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.evaluation.commands import CommandResult
from preflight_analysis.evaluation.ros2.python_runs import parse_request
from preflight_analysis.findings.lack import Lack
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace
from support.check import check

TEXT = """\
from helper import made

def generate_launch_description():
    return made(
        1)
"""
HELPER = "def made(n):\n    return {}[n]\n"


class Answers:
    """The answer of all runs."""

    reader = None
    edition = 0
    placeholder: str | None = None

    def __init__(self, answer: CommandResult | None) -> None:
        self.answer = answer

    def result(self, line: str) -> CommandResult | None:
        """The same to all requests for a run."""
        return self.answer if parse_request(line) is not None else None

    def answering(self, question: str) -> tuple[str, ...]:
        return ()


def _launched(
    folder: Path, answer: Any, packages: Path | None = None, *, text: str = TEXT, helper: str = HELPER
) -> Analysis:
    path = folder / "a.launch.py"
    path.write_text(text)
    (folder / "helper.py").write_text(helper)
    environment = detect_environment(
        None, {"HOME": "/home/me", "PATH": "/usr/bin", "ROS_VERSION": "2"}, (str(packages or folder),)
    )
    result = (
        answer if isinstance(answer, CommandResult) or answer is None else CommandResult("done", json.dumps(answer))
    )
    return Workspace(environment, Sources(), str(folder), Answers(result)).static(str(path))


def _error(folder: Path, error: str, message: str, **more: Any) -> dict[str, Any]:
    path = str(folder / "a.launch.py")
    frames = [[path, 4, "generate_launch_description"], [str(folder / "helper.py"), 2, "made"]]
    return {"error": {"type": error, "message": message, "frames": frames, **more}}


def test_an_exception_is_shown_on_the_line_of_the_launch_file(tmp_path: Path) -> None:
    analysis = _launched(tmp_path, _error(tmp_path, "KeyError", "1"))
    (finding,) = analysis.findings
    assert (finding.rule, finding.message, finding.stops_launch) == ("LCH032", "KeyError: 1", True)
    assert TEXT[finding.location.span.start : finding.location.span.end] == "return made("
    (other,) = finding.related
    helper = analysis.documents[other.location.file]
    assert helper.text[other.location.span.start : other.location.span.end].strip() == "return {}[n]"


def test_a_file_that_is_not_there_may_be_another_one(tmp_path: Path) -> None:
    (tmp_path / "params").mkdir()
    (tmp_path / "params" / "nav2.yaml").touch()
    (tmp_path / "package.xml").write_text("<package><name>robot</name></package>")
    said = f"[Errno 2] No such file or directory: '{tmp_path}/params/{{}}'"
    for name, near in (("nva2.yaml", True), ("slam_toolbox.yaml", False)):
        analysis = _launched(tmp_path, _error(tmp_path, "FileNotFoundError", said.format(name)))
        (finding,) = (finding for finding in analysis.findings if finding.rule == "LCH032")
        assert finding.message.endswith("params/nav2.yaml'?") == near


@pytest.mark.parametrize(
    ("path", "severity"),
    [
        ("/opt/ros/humble/lib/teleop/teleop", "hint"),
        ("/sim_ws/src/robot/params.yaml", "info"),
        ("{}/params.yaml", "error"),
    ],
)
def test_a_file_of_another_machine_is_no_mistake_of_the_launch_file(tmp_path: Path, path: str, severity: str) -> None:
    (tmp_path / "package.xml").write_text("<package><name>robot</name></package>")
    said = f"[Errno 2] No such file or directory: '{path.format(tmp_path)}'"
    analysis = _launched(tmp_path, _error(tmp_path, "FileNotFoundError", said))
    (finding,) = (finding for finding in analysis.findings if finding.rule == "LCH032")
    assert finding.severity == severity


@pytest.mark.parametrize(
    ("kind", "said"),
    [
        ("FileNotFoundError", "[Errno 2] No such file or directory: '/workspaces/bot/src/bot/config/hall.yaml'"),
        ("XacroException", "No such file or directory: /workspaces/bot/src/bot/config/hall.yaml"),
        ("RuntimeError", "map '/workspaces/bot/src/bot/config/hall.yaml' does not exist"),
        ("RuntimeError", "map '/home/nobody-here/bot/config/hall.yaml' does not exist"),
    ],
)
def test_a_path_of_a_container_or_of_somebody_else(tmp_path: Path, kind: str, said: str) -> None:
    (tmp_path / "package.xml").write_text("<package><name>robot</name></package>")
    (tmp_path / "config").mkdir()
    (tmp_path / "config" / "hall.yaml").touch()
    analysis = _launched(tmp_path, _error(tmp_path, kind, said))
    (finding,) = (finding for finding in analysis.findings if finding.rule == "LCH032")
    assert finding.severity == "info"
    assert "this machine has no '/" in finding.message


@pytest.mark.parametrize(
    ("absent", "severity"),
    [("/home/robot/recordings/**/cloud-*.ply", "info"), ("mapproxy-util", "info"), ("{}/maps/hall.yaml", "error")],
)
def test_a_launch_file_that_refuses_for_what_the_machine_lacks(tmp_path: Path, absent: str, severity: str) -> None:
    (tmp_path / "package.xml").write_text("<package><name>robot</name></package>")
    path = absent.format(tmp_path)
    analysis = _launched(tmp_path, _error(tmp_path, "RuntimeError", "record first", absent=path))
    (finding,) = (finding for finding in analysis.findings if finding.rule == "LCH032")
    assert (finding.severity, finding.stops_launch) == (severity, True)
    said = f"RuntimeError: record first; this machine has no '{path}'"
    assert finding.message == (said if severity == "info" else "RuntimeError: record first")


@pytest.mark.parametrize(
    ("data", "severity"), [("files_of_the_web()", "info"), ("[('share/robot', ['package.xml'])]", "error")]
)
def test_a_launch_file_that_refuses_for_what_its_build_makes(tmp_path: Path, data: str, severity: str) -> None:
    build = "<export><build_type>ament_python</build_type></export>"
    (tmp_path / "package.xml").write_text(f"<package><name>robot</name>{build}</package>")
    (tmp_path / "setup.py").write_text(f"from setuptools import setup\nsetup(name='robot', data_files={data})\n")
    analysis = _launched(tmp_path, _error(tmp_path, "RuntimeError", "build first", absent=f"{tmp_path}/web/dist"))
    (finding,) = (finding for finding in analysis.findings if finding.rule == "LCH032")
    assert finding.severity == severity
    assert finding.message.endswith("/web/dist'") == (severity == "info")


@pytest.mark.parametrize(("asked", "lacks"), [("os.environ.get('ROBOT')", True), ("os.environ.get('HOME')", False)])
def test_a_launch_file_that_joins_a_variable_that_is_not_set(tmp_path: Path, asked: str, lacks: bool) -> None:
    error = _error(tmp_path, "TypeError", "expected str, bytes or os.PathLike object, not NoneType")
    analysis = _launched(tmp_path, error, text=f"import os\nNAME = {asked}\n{TEXT}")
    (finding,) = (finding for finding in analysis.findings if finding.rule == "LCH032")
    assert finding.lack == (Lack("variable", "ROBOT") if lacks else None)


def test_a_launch_file_that_refuses_without_a_submodule(tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text("<package><name>robot</name></package>")
    (tmp_path / ".gitmodules").write_text('[submodule "maps"]\n\tpath = maps\n')
    analysis = _launched(tmp_path, _error(tmp_path, "RuntimeError", "no maps", absent=f"{tmp_path}/maps/hall.yaml"))
    (finding,) = (finding for finding in analysis.findings if finding.rule == "LCH032")
    assert finding.lack == Lack("submodule", "maps", "git submodule update --init maps")


@pytest.mark.parametrize(
    ("helper", "said", "severity"),
    [
        ("def made(n):\n    raise ValueError(\n'')\n", "map_file is required for localization", "info"),
        ("def made(n):\n    raise ValueError(\n'')\n", "mode must be one of a and b", "error"),
        ("def made(n):\n    return {}[map_file]\n", "map_file", "error"),
    ],
)
def test_a_launch_file_that_refuses_an_empty_argument(tmp_path: Path, helper: str, said: str, severity: str) -> None:
    text = TEXT + "DeclareLaunchArgument('map_file', default_value='')\n"
    analysis = _launched(tmp_path, _error(tmp_path, "ValueError", said), text=text, helper=helper)
    (finding,) = (finding for finding in analysis.findings if finding.rule == "LCH032")
    assert (finding.severity, finding.stops_launch) == (severity, True)
    assert finding.message.endswith("argument 'map_file' is empty") == (severity == "info")


@pytest.mark.parametrize(
    ("text", "said", "message"),
    [
        (TEXT, "no camera", "the launch file calls exit(): no camera"),
        (
            f"import sys\nWORDS = sys.argv\n{TEXT}",
            "None",
            "the launch file calls exit(); it reads arguments from sys.argv, and none are given",
        ),
    ],
)
def test_a_launch_file_that_ends_itself(tmp_path: Path, text: str, said: str, message: str) -> None:
    frames = [[str(tmp_path / "a.launch.py"), 4, "generate_launch_description"]]
    answer = {"error": {"type": "SystemExit", "message": said, "frames": frames}}
    (finding,) = (each for each in _launched(tmp_path, answer, text=text).findings if each.rule == "LCH032")
    assert (finding.severity, finding.message, finding.stops_launch) == ("info", message, True)


@pytest.mark.parametrize(("path", "severity"), [("/.dockerenv", "info"), ("arm.yaml", "error")])
def test_a_launch_file_that_refuses_the_machine(tmp_path: Path, path: str, severity: str) -> None:
    helper = f"def made(n): os.path.exists('{path}') or stop()\nraise RuntimeError('no')\n"
    analysis = _launched(tmp_path, _error(tmp_path, "RuntimeError", "no"), helper=helper)
    (finding,) = (finding for finding in analysis.findings if finding.rule == "LCH032")
    assert finding.severity == severity
    assert finding.message.endswith("the file asks for the machine that it runs on") == (severity == "info")


@pytest.mark.parametrize(
    ("helper", "severity"),
    [
        ("m = re.match('(.*)/install/.*', get_package_share_directory('p'))\nreturn m.group(1)\n", "info"),
        ("m = re.match('(.*)/share/.*', get_package_share_directory('p'))\nreturn m.group(1)\n", "error"),
        ("m = re.match('(.*)/install/.*', __file__)\nreturn m.group(1)\n", "error"),
    ],
)
def test_a_launch_file_that_takes_the_path_of_a_build_apart(tmp_path: Path, helper: str, severity: str) -> None:
    """Without a build the package lies in its source."""
    (tmp_path / "package.xml").write_text("<package><name>p</name><build_type>ament_cmake</build_type></package>")
    said = "'NoneType' object has no attribute 'group'"
    analysis = _launched(tmp_path, _error(tmp_path, "AttributeError", said), helper=helper)
    (finding,) = (finding for finding in analysis.findings if finding.rule == "LCH032")
    assert finding.severity == severity


def test_a_launch_file_that_asks_for_its_repository(tmp_path: Path) -> None:
    helper = "def made(n): check_output(['git', 'rev-parse', '--show-toplevel'])\nraise RuntimeError('no')\n"
    analysis = _launched(tmp_path, _error(tmp_path, "RuntimeError", "no"), helper=helper)
    (finding,) = (finding for finding in analysis.findings if finding.rule == "LCH032")
    assert finding.severity == "info"


def test_a_file_of_somebodys_home_that_a_package_has(tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text("<package><name>robot</name></package>")
    (tmp_path / "maps").mkdir()
    (tmp_path / "maps" / "levine.yaml").touch()
    said = "[Errno 2] No such file or directory: '/home/somebody/ws/src/robot/maps/{}.yaml'"
    for name, severity in (("levine", "error"), ("other", "hint")):
        analysis = _launched(tmp_path, _error(tmp_path, "FileNotFoundError", said.format(name)))
        (finding,) = (finding for finding in analysis.findings if finding.rule == "LCH032")
        assert finding.severity == severity
        assert finding.message.endswith("maps/levine.yaml'?") == (severity == "error")


def test_a_workspace_that_others_have_elsewhere(tmp_path: Path) -> None:
    """The file asks for the home folder of whoever starts it, and looks for its workspace there."""
    (tmp_path / "package.xml").write_text("<package><name>robot</name></package>")
    (tmp_path / "base.yaml").touch()
    error = _error(
        tmp_path, "FileNotFoundError", "[Errno 2] No such file or directory: '/home/me/ws/src/robot/base.yaml'"
    )
    for text, severity in ((f"from pathlib import Path\nHOME = Path.home()\n{TEXT}", "info"), (TEXT, "error")):
        (finding,) = (each for each in _launched(tmp_path, error, text=text).findings if each.rule == "LCH032")
        assert finding.severity == severity


def test_an_assert_without_a_message_is_shown(tmp_path: Path) -> None:
    text = "import os\nassert os.path.isdir(\n    '/no/such/folder')\nraise StopIteration\n"
    path = str(tmp_path / "a.launch.py")
    for line in (2, 3):
        error = {"error": {"type": "AssertionError", "message": "", "frames": [[path, line, "<module>"]]}}
        (finding,) = _launched(tmp_path, error, text=text).findings
        assert finding.message == "AssertionError: assert os.path.isdir( '/no/such/folder')"
    error = {"error": {"type": "StopIteration", "message": "", "frames": [[path, 4, "<module>"]]}}
    (finding,) = _launched(tmp_path, error, text=text).findings
    assert finding.message == "StopIteration"


def test_the_assert_of_a_helper_is_shown(tmp_path: Path) -> None:
    path, helper = tmp_path / "a.launch.py", tmp_path / "helper.py"
    frames = [[str(path), 4, "generate_launch_description"], [str(helper), 2, "made"]]
    error = {"error": {"type": "AssertionError", "message": "", "frames": frames}}
    (finding,) = _launched(tmp_path, error, helper="def made(n):\n    assert n == 2\n").findings
    assert finding.message == "AssertionError: assert n == 2"


def test_a_module_that_is_missing_here_need_not_be_missing_there(tmp_path: Path) -> None:
    error = _error(tmp_path, "ModuleNotFoundError", "No module named 'x'", module="x")
    (finding,) = _launched(tmp_path, error).findings
    assert (finding.rule, finding.severity, finding.stops_launch) == ("LCH032", "hint", False)
    assert finding.lack == Lack("module", "x")
    assert "ROS is not installed here" in finding.message


def test_with_ros_a_missing_module_has_to_be_installed(tmp_path: Path) -> None:
    manifest = "<package><name>{}</name><exec_depend>nav2_common</exec_depend></package>"
    for name in ("rclpy", "robot"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "package.xml").write_text(manifest.format(name))
    folder = tmp_path / "robot"
    for module, advice in (("nav2_common", "rosdep install"), ("x", "add it to package.xml")):
        said = f"No module named '{module}'"
        (finding,) = _launched(folder, _error(folder, "ModuleNotFoundError", said, module=module), tmp_path).findings
        assert (finding.rule, finding.severity) == ("LCH032", "hint")
        assert advice in finding.message
    said = "cannot import name 'Newer' from 'launch.actions'"
    (finding,) = _launched(folder, _error(folder, "ImportError", said, module="launch.actions"), tmp_path).findings
    assert "no launch of Humble, Jazzy, Kilted or Rolling has it" in finding.message
    (finding,) = _launched(
        folder, _error(folder, "ModuleNotFoundError", "No module named 'launch_pal'", module="launch_pal"), tmp_path
    ).findings
    assert finding.lack is not None
    assert (finding.lack.kind, finding.lack.name) == ("package", "launch_pal")


def test_a_variable_of_the_environment_that_is_not_set(tmp_path: Path) -> None:
    text = "import os\nMODEL = os.environ['MODEL']\nOTHER = {}['MODEL']\n"
    for line, rule, severity in ((2, "LCH012", "hint"), (3, "LCH032", "error")):
        frames = [[str(tmp_path / "a.launch.py"), line, "<module>"]]
        error = {"error": {"type": "KeyError", "message": "'MODEL'", "frames": frames}}
        (finding,) = _launched(tmp_path, error, text=text).findings
        assert (finding.rule, finding.severity, finding.stops_launch) == (rule, severity, True)


def test_a_run_that_ends_badly(tmp_path: Path) -> None:
    (finding,) = _launched(tmp_path, CommandResult("failed", reason="it was killed by SIGSEGV")).findings
    assert (finding.rule, finding.message) == ("LCH032", "launch file cannot be run: it was killed by SIGSEGV")


@pytest.mark.silent
def test_a_run_that_goes_well_is_not_spoken_of(tmp_path: Path) -> None:
    assert _launched(tmp_path, {"actions": [], "files": {}}).findings == ()
    assert _launched(tmp_path, None).findings == (), "it has yet to be run"


@pytest.mark.parametrize(
    "answer",
    [
        [],
        1,
        {"actions": 5},
        {"actions": [1, None, {"k": 2}, {"k": "node", "a": [], "c": {}, "p": "x"}]},
        {
            "actions": [
                {"k": "node", "a": {"pkg": [{"s": "var", "w": 3}], "exec": [{"s": "var", "w": [[]]}], "name": 7}}
            ]
        },
        {"actions": [{"k": "opaque", "i": 10**30, "a": {"id": ["x"]}}]},
        {"actions": [{"k": "arg", "p": [10**9, 10**9], "n": "X", "a": {"name": ["a"]}, "c": []}]},
        {"error": {"frames": [[1, 2, 3], ["/x", -5, ""], ["/nowhere.py", 10**12, ""]]}},
        {"error": {"frames": "x", "type": ["KeyError"]}},
        {"error": {"type": "KeyError", "absent": [7]}},
        {"actions": [], "files": {"/tmp/x": 5, "y": "z"}},
    ],
)
def test_nothing_of_an_answer_is_relied_on(tmp_path: Path, answer: Any) -> None:
    analysis = _launched(tmp_path, answer)
    assert {finding.rule for finding in analysis.findings} <= {"LCH032", "ARG001", "ARG003"}


def test_a_run_cannot_speak_for_the_files_of_the_host(tmp_path: Path) -> None:
    params = tmp_path / "p.yaml"
    params.write_text("/**:\n  ros__parameters:\n    rate: 5\n")
    node = {"pkg": ["q"], "exec": ["x"], "name": ["n"]}
    child = {"k": "param", "a": {"from": [str(params)]}, "c": []}
    answer = {
        "actions": [{"k": "node", "a": node, "c": [child]}],
        "files": {str(params): "/**:\n  ros__parameters:\n    rate: 6\n"},
    }
    (found,) = _launched(tmp_path, answer).tree.nodes
    assert [param.value for param in found.params] == [5]


_NODES = """
        //- /robot.launch.py
        import launch
        from launch import LaunchDescription
        from launch.actions import LogInfo as Said, OpaqueFunction
        from launch.substitutions import LaunchConfiguration
        from launch_ros import actions
        from launch_ros.actions import ComposableNodeContainer, Node
        from launch_ros.descriptions import ComposableNode
        from mine import Node as Mine, more, other, unknown, x
"""


@pytest.mark.parametrize(
    ("call", "message"),
    [
        ('Node(package="p", executable="a", nmae="one")', "'nmae'; did you mean 'name'?"),
        ('Node(package="p", node_executable="a", name="one")', "'node_executable'; did you mean 'executable'?"),
        ('actions.Node(package="p", executable="a", node_name="one")', "'node_name'; did you mean 'name'?"),
        ('actions.LifecycleNode(package="p", executable="a", name="n", namespace="", param=[])', "'param'"),
        ('launch.actions.ExecuteProcess(cmd=["ls"], enviroment={})', "'enviroment'"),
        ('Said(mgs="hello")', "'mgs'; did you mean 'msg'?"),
        ('LaunchConfiguration("x", defualt="1")', "'defualt'; did you mean 'default'?"),
        ('ComposableNode(package="p", node_plugin="a::B", name="b")', "'node_plugin'; did you mean 'plugin'?"),
        ('Node(package="p", executable="a", name="one", zzz=1)', "'zzz'"),
        ('Node(package="p", executable="a", name="one", cmd=["a"])', "'cmd'"),
        ('launch.actions.execute_process.ExecuteProcess(cmd=["ls"], nmae="x")', "'nmae'; did you mean 'name'?"),
        ("launch.event_handlers.OnProcessStart(on_event=[], on_start=[])", "'on_event'"),
    ],
)
def test_a_keyword_that_a_class_of_launch_does_not_take(call: str, message: str) -> None:
    name = message.split("'")[1]
    before, _, _ = call.partition(f"{name}=")
    carets = " " * len(before) + "^" * len(name)
    check(f"""{_NODES}
        def setup(context):
            made = [
                {call},
                {carets} error[LCH032] got an unexpected keyword argument {message}
            ]
            return made

        def generate_launch_description():
            return LaunchDescription([OpaqueFunction(function=setup)])
    """)


@pytest.mark.silent
@pytest.mark.parametrize(
    "statement",
    [
        'Node(package="p", executable="a", name="one", output="screen", respawn=True, prefix="gdb", shell=True)',
        'Node(package="p", executable="a", nmae="one", **more)',
        'Mine(package="p", executable="a", nmae="one")',
        'x and Node(package="p", executable="a", nmae="one")',
        'Node(package="p", executable="a") if x else Node(package="p", node_executable="a")',
        '[Node(package="p", executable="a", nmae="one") for each in x]',
        'other(lambda: Node(package="p", executable="a", nmae="one"))',
        'launch.actions.ExecuteProcess(cmd=["ls"], env={}, additional_env={}, cwd="/", name="ls", prefix="nice")',
        'OpaqueFunction(function=other, args=[1], kwargs={"nmae": 1})',
        'unknown.Node(nmae="one")',
    ],
)
def test_keywords_that_may_be_right(statement: str) -> None:
    check(f"""{_NODES}
        def generate_launch_description():
            made = {statement}
            try:
                node = Node(package="p", executable="a", name="two")
            except TypeError:
                node = Node(package="p", node_executable="a", node_name="two")
            return LaunchDescription([made, node])

        def never():
            return Node(nmae="one")
    """)


def test_a_run_says_of_a_keyword_what_is_known_without_it(tmp_path: Path) -> None:
    head = "from launch_ros.actions import Node\n\n\ndef generate_launch_description():\n"
    text = f"{head}    return Node(\n        nmae=1)\n"
    frames = [[str(tmp_path / "a.launch.py"), 5, "generate_launch_description"]]
    said = "Action.__init__() got an unexpected keyword argument 'nmae'"
    answers = ({"error": {"type": "TypeError", "message": said, "frames": frames}}, None)
    found = [_launched(tmp_path, answer, text=text).findings for answer in answers]
    assert [[f.message for f in each if f.rule == "LCH032"] for each in found] == [
        ["Node() got an unexpected keyword argument 'nmae'; did you mean 'name'?"]
    ] * 2
    (fix,) = next(f for f in found[0] if f.rule == "LCH032").fixes
    assert [edit.text for edit in fix.edits] == ["name"]
