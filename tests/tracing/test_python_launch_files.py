"""Python launch files: run in the sandbox against our fake of launch, evaluated like any other launch file."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.evaluation.problems import PythonException, WithheldVariable
from preflight_analysis.tracing import launch_files, run
from preflight_analysis.workspace.sources import Sources
from support.python_launch_harness import PythonHarness, line_of

pytestmark = pytest.mark.ros

HEAD = """\
from launch import LaunchDescription, Substitution
from launch.actions import *
from launch.conditions import IfCondition, LaunchConfigurationEquals, UnlessCondition
from launch.event_handlers import OnProcessExit
from launch.launch_description_sources import AnyLaunchDescriptionSource, PythonLaunchDescriptionSource
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.descriptions import ComposableNode, ParameterFile, ParameterValue
from launch_ros.substitutions import FindPackageShare
from ament_index_python.packages import get_package_share_directory
"""


@pytest.fixture
def harness(tmp_path: Path) -> PythonHarness:
    return PythonHarness(tmp_path)


def _described(harness: PythonHarness, *actions: str, before: str = "", name: str = "launch/a.launch.py") -> Path:
    text = HEAD + before + "\ndef generate_launch_description():\n    return LaunchDescription([\n"
    return harness.write(name, text + "".join(f"        {action},\n" for action in actions) + "    ])\n")


def test_a_program_may_have_a_name_that_says_no_format(harness: PythonHarness) -> None:
    _described(harness, "Node(package='p', executable='x', name='n')", name="launch/inner.launch")
    include = "IncludeLaunchDescription(PythonLaunchDescriptionSource(FindPackageShare('p').find('p') + '{}'))"
    path = _described(harness, include.format("/launch/inner.launch"), name="launch/outer.launch")
    analysis = harness.launch(path)
    assert analysis.tree.complete and not analysis.tree.problems
    assert [node.name for node in analysis.tree.nodes] == ["/n"]


def test_a_text_that_is_set_for_all_nodes_is_read_as_yaml(harness: PythonHarness) -> None:
    """launch_ros passes it as `-p name:=value`; a component gets it as the text that it is."""
    path = _described(
        harness,
        "SetParameter(name='use_sim_time', value='false')",
        "SetParameter(name='frame', value='map')",
        "Node(package='p', executable='x', name='one')",
        "ComposableNodeContainer(package='rclcpp_components', executable='component_container', name='c', namespace='',"
        " composable_node_descriptions=[ComposableNode(package='p', plugin='p::N', name='n')])",
    )
    nodes = {node.name: {p.name: p.value for p in node.params} for node in harness.launch(path).tree.nodes}
    assert nodes["/one"] == {"use_sim_time": False, "frame": "map"}
    assert nodes["/n"] == {"use_sim_time": "false", "frame": "map"}


def test_actions_are_evaluated_like_those_of_xml(harness: PythonHarness) -> None:
    params = harness.write("config/p.yaml", "/**:\n  ros__parameters:\n    rate: 5\n")
    path = _described(
        harness,
        "DeclareLaunchArgument('robot', default_value='r1', choices=['r1', 'r2'])",
        "PushRosNamespace(LaunchConfiguration('robot'))",
        "SetParameter('use_sim_time', True)",
        "Node(package='p', executable='x', name='one', arguments=['-a', '', ['--id=', LaunchConfiguration('robot')]],"
        " remappings=[('scan', '/lidar')], parameters=[PathJoinSubstitution([FindPackageShare('p'), 'config',"
        " 'p.yaml']), {'count': 1, 'text': '1', 'list': [1, 2.5], 'of': LaunchConfiguration('robot'),"
        " 'in': {'side': True}}])",
        "Node(package='p', executable='y', name='two', condition=IfCondition('false'))",
        "Node(package='p', executable='y', name='three', condition=LaunchConfigurationEquals('robot', 'r2'))",
        "ComposableNodeContainer(package='rclcpp_components', executable='component_container', name='c', namespace='',"
        " composable_node_descriptions=[ComposableNode(package='p', plugin='p::N', name='n')])",
        "LifecycleNode(package='p', executable='z', name='four', namespace='/other')",
        "TimerAction(period=2.0, actions=[Node(package='p', executable='x', name='later')])",
        "ExecuteProcess(cmd=['echo', 'hello'])",
    )
    tree = harness.launch(path, {"robot": "r2"}).tree
    assert not tree.problems
    found = {node.name: node for node in tree.nodes if node.kind != "process"}
    assert {name: node.kind for name, node in found.items()} == {
        "/r2/one": "node",
        "/r2/three": "node",
        "/r2/c": "container",
        "/r2/n": "composable",
        "/other/four": "lifecycle",
        "/r2/later": "node",
    }
    one = found["/r2/one"]
    assert one.args == "-a '' --id=r2"
    assert [(remap.source, remap.target) for remap in one.remaps] == [("scan", "/lidar")]
    assert {param.name: param.value for param in one.params} == {
        "use_sim_time": True,
        "rate": 5,
        "count": 1,
        "text": "1",
        "list": [1.0, 2.5],
        "of": "r2",
        "in.side": True,
    }
    assert str(params) in [source.path for source in one.param_sources]
    kinds = {child.kind for child in one.action.children}
    assert kinds == {"argument", "param", "param_dict", "remap"}, "none of them is an annotation"
    assert found["/r2/later"].deferred
    assert not one.deferred
    assert [node.args for node in tree.nodes if node.kind == "process"] == ["hello"]
    text = path.read_text()
    where = {name: text[node.location.span.start : node.location.span.end] for name, node in found.items()}
    assert where["/r2/one"] == "Node"
    assert where["/r2/n"] == "ComposableNode"
    count = next(p for p in one.params if p.name == "count").name_location
    assert count is not None
    assert text[count.span.start : count.span.end] == "count"


@pytest.mark.parametrize(
    ("text", "near"),
    [("", ""), ("def generate_launch_descripton(): pass", "; did you mean 'generate_launch_descripton'?")],
)
def test_a_launch_file_without_its_function(harness: PythonHarness, text: str, near: str) -> None:
    (finding,) = harness.launch(harness.write("a.launch.py", text)).findings
    assert finding.rule == "LCH032"
    assert finding.message.endswith(f": the launch file has no function 'generate_launch_description'{near}")


def test_the_text_of_an_action_is_the_same_in_each_run(harness: PythonHarness) -> None:
    """Else the nodes that get it by mistake would never be found in the cache, nor their findings in a baseline."""
    path = _described(harness, "Node(package='p', executable='x', arguments=[str(DeclareLaunchArgument('port'))])")
    (node,) = harness.launch(path).tree.nodes
    assert node.args == "<DeclareLaunchArgument object>"


def test_a_wrong_keyword_is_a_finding_on_its_line(harness: PythonHarness) -> None:
    path = _described(harness, "Node(package='p', executable='x', name='a')", "Node(package='p', node_executable='y')")
    analysis = harness.launch(path)
    assert [(f.rule, f.stops_launch) for f in analysis.findings] == [("LCH032", True)]
    assert "node_executable" in analysis.findings[0].message or "executable" in analysis.findings[0].message
    text = path.read_text().splitlines()
    assert "node_executable" in text[line_of(analysis)[1] - 1]


def test_an_error_names_classes_as_launch_does(harness: PythonHarness) -> None:
    line = "Node(package='p', executable='x', arguments=[ParameterValue('a')])"
    path = _described(harness, line, before="from launch_ros.parameter_descriptions import ParameterValue\n")
    (finding,) = [each for each in harness.launch(path).findings if each.rule == "LCH032"]
    assert "preflight" not in finding.message


def test_a_function_is_no_condition(harness: PythonHarness) -> None:
    analysis = harness.launch(_described(harness, "Node(package='p', executable='x', condition=lambda context: True)"))
    (finding,) = [each for each in analysis.findings if each.rule == "LCH032"]
    assert finding.message == "AttributeError: 'function' object has no attribute 'evaluate'"


def test_an_exception_in_a_helper_leads_to_the_call(harness: PythonHarness) -> None:
    harness.write("p/__init__.py", "")
    harness.write("p/helper.py", "def made():\n    return {}['nothing']\n")
    path = _described(harness, "made()", before="from p.helper import made\n")
    analysis = harness.launch(path)
    assert [f.rule for f in analysis.findings] == ["LCH032"]
    assert "made()" in path.read_text().splitlines()[line_of(analysis)[1] - 1]
    assert "KeyError" in analysis.findings[0].message


@pytest.mark.parametrize(
    ("looks", "severity"),
    [
        ("os.path.exists('/srv/robot/calibration.yaml')", "info"),
        ("pathlib.Path('/srv/robot/calibration.yaml').is_file()", "info"),
        ("glob.glob('/srv/robot/recordings/**/cloud-*.ply', recursive=True)", "info"),
        ("shutil.which('no-such-program')", "info"),
        ("os.path.exists(os.path.join(os.path.dirname(__file__), 'calibration.yaml'))", "error"),
        ("os.path.sep == 'x'", "error"),
    ],
)
def test_a_launch_file_refuses_for_what_it_does_not_find(harness: PythonHarness, looks: str, severity: str) -> None:
    refuses = "import glob, os, pathlib, shutil\ndef check():\n"
    refuses += f"    if not ({looks}):\n        raise RuntimeError('calibrate first')\n"
    analysis = harness.launch(_described(harness, "check()", before=refuses))
    assert [(f.rule, f.severity) for f in analysis.findings] == [("LCH032", severity)]
    assert ("this machine has no '" in analysis.findings[0].message) == (severity == "info")


def test_what_is_not_there_is_told(harness: PythonHarness) -> None:
    path = _described(harness, before="SHARE = get_package_share_directory('missing_package')\n")
    analysis = harness.launch(path)
    assert [f.rule for f in analysis.findings] == ["PKG001"]
    path = _described(harness, "Node(package='p', executable='x', name='n')", before="import no_such_module\n")
    analysis = harness.launch(path)
    assert [(f.rule, f.severity) for f in analysis.findings if f.rule == "LCH032"] == [("LCH032", "hint")]
    assert [node.name for node in analysis.tree.nodes] == ["/n"], "what does not need it is known"
    assert analysis.tree.complete


OPAQUE = """
def setup(context, prefix):
    robot = LaunchConfiguration('robot').perform(context)
    context.launch_configurations['found'] = robot.upper()
    inner = OpaqueFunction(function=lambda c: [
        Node(package='p', executable='x', name=LaunchConfiguration('found').perform(c).lower() + '_inner')])
    return [Node(package='p', executable='x', name=prefix + robot), inner]
"""


def test_an_opaque_function_gets_the_context(harness: PythonHarness) -> None:
    path = _described(
        harness,
        "DeclareLaunchArgument('robot', default_value='r1')",
        "OpaqueFunction(function=setup, args=['my_'])",
        "Node(package='p', executable='x', name=LaunchConfiguration('found'))",
        before=OPAQUE,
    )
    assert [n.name for n in harness.launch(path).tree.nodes] == ["/my_r1", "/r1_inner", "/R1"]
    analysis = harness.launch(path, {"robot": "r2"})
    assert [n.name for n in analysis.tree.nodes] == ["/my_r2", "/r2_inner", "/R2"]
    assert analysis.tree.complete


CUSTOM = """
import tempfile
import yaml


class Rewritten(Substitution):
    def __init__(self, source_file, values):
        super().__init__()
        self.source_file, self.values = source_file, values

    def perform(self, context):
        source = context.perform_substitution(self.source_file)
        content = yaml.safe_load(open(source))
        for section in content.values():
            section['ros__parameters'].update({k: v.perform(context) for k, v in self.values.items()})
        made = tempfile.NamedTemporaryFile('w', delete=False)
        yaml.safe_dump(content, made)
        made.close()
        return made.name


class Twice(Action):
    def __init__(self, name, **kwargs):
        super().__init__(**kwargs)
        self.name = name

    def execute(self, context):
        name = self.name.perform(context)
        return [Node(package='p', executable='x', name=name + side) for side in ('_left', '_right')]
"""


def test_a_function_that_waits_for_a_device_goes_on(harness: PythonHarness) -> None:
    path = harness.write(
        "launch/a.launch.py",
        """\
        import os, time
        from launch import LaunchDescription
        from launch.actions import LogInfo, OpaqueFunction

        def wait(context):
            deadline = time.time() + 60
            while not os.path.exists('/dev/robot') and time.time() < deadline:
                time.sleep(0.5)
            return [LogInfo(msg='waited' if time.time() >= deadline else 'there')]

        def generate_launch_description():
            return LaunchDescription([OpaqueFunction(function=wait)])
        """,
    )
    analysis = harness.launch(path)
    assert [each for each in analysis.findings if each.rule == "LCH018"] == []
    assert analysis.tree.complete


def test_names_that_a_class_keeps_for_itself(harness: PythonHarness) -> None:
    """https://github.com/yukaitung/lgdxrobot2-ros2"""
    path = harness.write(
        "launch/private.launch.py",
        """
        from launch import LaunchDescription
        from launch_ros.actions import Node

        class Names:
            __prefix = "arm"

            @classmethod
            def __of(cls, side):
                return cls.__prefix + "_" + side

            def both(self):
                return [self.__of("left"), self._Names__of("right")]

        def generate_launch_description():
            return LaunchDescription([Node(package="p", executable="x", name=name) for name in Names().both()])
        """,
    )
    tree = harness.launch(path).tree
    assert not tree.problems
    assert [node.name for node in tree.nodes] == ["/arm_left", "/arm_right"]


def test_substitutions_and_actions_of_the_users_own(harness: PythonHarness) -> None:
    params = harness.write("config/p.yaml", "/**:\n  ros__parameters:\n    rate: 5\n    frame: x\n")
    path = _described(
        harness,
        "DeclareLaunchArgument('robot', default_value='r1')",
        f"Node(package='p', executable='x', name='n', parameters=[Rewritten(TextSubstitution(text={str(params)!r}),"
        " {'frame': LaunchConfiguration('robot')})])",
        "Twice(LaunchConfiguration('robot'))",
        before="from launch import Action\n" + CUSTOM,
    )
    tree = harness.launch(path, {"robot": "r7"}).tree
    assert not tree.problems
    assert {p.name: p.value for p in tree.nodes[0].params} == {"rate": 5, "frame": "r7"}
    assert [n.name for n in tree.nodes] == ["/n", "/r7_left", "/r7_right"]


@pytest.mark.parametrize("written", ["n: {ros__parameters: {rate: 5}}", "n: [1, 2", "[]"])
def test_nothing_points_into_a_file_that_is_gone(harness: PythonHarness, written: str) -> None:
    """What a run wrote into a temporary file belongs to the call that wrote it."""
    own = f"""
class Rewritten(Substitution):
    def perform(self, context):
        with open('/tmp/rewritten.yaml', 'w') as file:
            file.write({written!r})
        return file.name
"""
    path = _described(harness, "Node(package='p', executable='x', name='n', parameters=[Rewritten()])", before=own)
    analysis = harness.launch(path)
    (node,) = analysis.tree.nodes
    assert bool(node.params) == ("rate" in written)
    problems = [problem.origin for problem in analysis.tree.problems]
    assert bool(problems) == (written == "n: [1, 2")
    for origin in (*problems, *(param.origin for param in node.params)):
        assert [place.file for place in origin] == [str(path)]
        assert path.read_text()[origin[-1].span.start : origin[-1].span.end] == "Rewritten()"
    places = [param.name_location for param in node.params] + [finding.location for finding in analysis.findings]
    assert {place.file for place in places if place is not None} <= {str(path)}


def test_includes_of_all_four_formats(harness: PythonHarness) -> None:
    harness.write("launch/b.launch.xml", '<launch><arg name="n"/><node pkg="p" exec="x" name="$(var n)_xml"/></launch>')
    harness.write(
        "launch/c.launch.yaml",
        "launch:\n- arg: {name: n}\n- node: {pkg: p, exec: x, name: $(var n)_yaml}\n"
        "- include: {file: $(dirname)/d.launch.py, arg: [{name: n, value: $(var n)}]}\n",
    )
    _described(
        harness,
        "DeclareLaunchArgument('n')",
        "Node(package='p', executable='x', name=[LaunchConfiguration('n'), '_python'])",
        name="launch/d.launch.py",
    )
    include = "IncludeLaunchDescription(AnyLaunchDescriptionSource([ThisLaunchFileDir(), '/{}']), launch_arguments={})"
    path = _described(
        harness,
        include.format("b.launch.xml", "{'n': 'one'}.items()"),
        include.format("c.launch.yaml", "[('n', 'two')]"),
        include.format("d.launch.py", "{}.items()"),
    )
    analysis = harness.launch(path)
    assert [n.name for n in analysis.tree.nodes][:3] == ["/one_xml", "/two_yaml", "/two_python"]
    found = {(f.rule, line_of(analysis, i)[1]) for i, f in enumerate(analysis.findings)}
    assert found == {("ARG002", 16), ("LCH016", 15)}, "launch wants each include to pass it, and then uses what is set"


HOSTILE = {
    "hangs": "while True: pass",
    "sleeps": "import time; time.sleep(10_000)",
    "floods": "import os\nwhile True: os.write(1, b'x' * 100_000)",
    "forks": "import os\nfor _ in range(40):\n    if os.fork() == 0:\n        while True: pass",
    "kills": "import os, signal; os.kill(os.getpid(), signal.SIGKILL)",
    "exits": "raise SystemExit(0)",
    "leaves": "import os; os._exit(0)",
    "lies": "import os\nfor n in range(3, 30):\n    try: os.write(n, b'[1, {')\n    except OSError: pass\nos._exit(0)",
}


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_file_is_stopped(harness: PythonHarness, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run, "COMMAND_SECONDS", 1.0)
    path = _described(harness, "Node(package='p', executable='x', name='n')", before=HOSTILE[name] + "\n")
    analysis = harness.launch(path)
    assert not analysis.tree.complete
    assert {f.rule for f in analysis.findings} <= {"LCH018", "LCH032", "PKG002"}
    assert [node.name for node in analysis.tree.nodes] == ["/n"]


def test_the_home_folder_is_hidden_and_nothing_is_written(harness: PythonHarness, tmp_path: Path) -> None:
    victim = tmp_path / "src" / "p" / "victim"
    secret = tmp_path.parent / f"secret of {tmp_path.name}"
    secret.write_text("password")
    path = _described(
        harness,
        f"Node(package='p', executable='x', name=('seen' if os.path.exists({str(secret)!r}) else 'hidden'))",
        before=f"import os\ntry: open({str(victim)!r}, 'w')\nexcept OSError: pass\n",
    )
    assert [n.name for n in harness.launch(path).tree.nodes] == ["/hidden"]
    assert not victim.exists()


def test_a_file_that_is_not_run_is_read_as_far_as_it_goes(harness: PythonHarness) -> None:
    ran = harness.folder / "ran"
    path = _described(
        harness,
        "DeclareLaunchArgument('model', default_value='s1', choices=['a1', 's2'])",
        "Node(package='p', executable='x', name='a')",
        "Node(package=NAME, executable=EXE, name='b')",
        "Node(package='p', executable='x', name=LaunchConfiguration('never_declared'))",
        before=f"open({str(ran)!r}, 'w')\nNAME = 'p'\nEXE = NAME + 'x'\n",
    )
    analysis = harness.launch(path, why_not="not trusted")
    assert sorted({f.rule for f in analysis.findings}) == ["ARG009", "LCH018"]
    assert [node.name for node in analysis.tree.nodes][:2] == ["/a", "/b"]
    assert all(node.unknowns for node in analysis.tree.nodes)
    assert not ran.exists()


def test_a_half_typed_file(harness: PythonHarness) -> None:
    path = _described(
        harness, "DeclareLaunchArgument('model', default_value='a1')", "Node(package='p', executable='x', name='a')"
    )
    path.write_text(path.read_text().replace("    ])", "        Node(package='p', na\n    ])"))
    analysis = harness.launch(path)
    assert [f.rule for f in analysis.findings] == ["LCH001"]
    assert [node.name for node in analysis.tree.nodes] == ["/a"]
    assert list(analysis.tree.args) == ["model"]


def test_the_editors_text_counts(harness: PythonHarness) -> None:
    path = _described(harness, "Node(package='p', executable='x', name='disk')")
    sources = Sources()
    sources.open(str(path), path.read_text().replace("disk", "buffer"))
    assert [n.name for n in harness.launch(path, sources=sources).tree.nodes] == ["/buffer"]


def test_a_module_that_changed_is_run_again(harness: PythonHarness) -> None:
    harness.write("p/__init__.py", "")
    helper = harness.write("p/names.py", "NAME = 'before'\n")
    path = _described(harness, "Node(package='p', executable='x', name=NAME)", before="from p.names import NAME\n")
    assert [n.name for n in harness.launch(path).tree.nodes] == ["/before"]
    helper.write_text("NAME = 'afterwards'\n")
    assert [n.name for n in harness.launch(path).tree.nodes] == ["/afterwards"]


def test_what_the_file_sets_in_the_environment_stays(harness: PythonHarness) -> None:
    path = _described(
        harness,
        "Node(package='p', executable='x', name=EnvironmentVariable('ROBOT'))",
        before="import os\nos.environ['ROBOT'] = 'r9'\n",
    )
    (node,) = harness.launch(path).tree.nodes
    assert node.name == "/r9"
    assert dict(node.env) == {"ROBOT": "r9"}


def test_variables_that_the_file_names_are_those_of_the_environment(harness: PythonHarness) -> None:
    path = _described(
        harness,
        "Node(package='p', executable='x', name=MODEL + os.getenv('SIZE', '_small') + str(len(OTHERS)))",
        before="import os\nMODEL = os.environ['ROBOT']\nOTHERS = [v for v in os.environ if v.startswith('NOT_N')]\n",
    )
    for robot in ("r7", "r8"):
        tree = harness.launch(path, variables={"ROBOT": robot, "NOT_NAMED": "x"}).tree
        assert [node.name for node in tree.nodes] == [f"/{robot}_small0"]


@pytest.mark.parametrize(("name", "value"), [("MY_TOKEN", "hidden"), ("MIRROR", "https://me:hidden@host/path")])
def test_secrets_are_not_handed_on_and_not_said_to_be_unset(harness: PythonHarness, name: str, value: str) -> None:
    path = _described(
        harness, "Node(package='p', executable='x', name='n')", before=f"import os\nos.environ['{name}']\n"
    )
    tree = harness.launch(path, variables={name: value}).tree
    assert [problem.kind for problem in tree.problems] == [WithheldVariable(name)]
    assert f"environment variable '{name}' is a secret" in [unknown.reason for unknown in tree.unknowns]
    assert "hidden" not in repr(tree)


def test_a_file_that_an_earlier_run_wrote_is_there_in_the_next(harness: PythonHarness) -> None:
    params = harness.write("config/p.yaml", "/**:\n  ros__parameters:\n    rate: 5\n    frame: x\n")
    _described(
        harness,
        "DeclareLaunchArgument('params')",
        "Node(package='p', executable='x', name='n', parameters=["
        "Rewritten(LaunchConfiguration('params'), {'rate': TextSubstitution(text='7')})])",
        before=CUSTOM.replace("class Twice(Action)", "class Twice"),
        name="launch/inner.launch.py",
    )
    path = _described(
        harness,
        f"SetLaunchConfiguration('params', Rewritten(TextSubstitution(text={str(params)!r}),"
        " {'frame': TextSubstitution(text='base')}))",
        "IncludeLaunchDescription(PythonLaunchDescriptionSource([ThisLaunchFileDir(), '/inner.launch.py']),"
        " launch_arguments={'params': LaunchConfiguration('params')}.items())",
        before=CUSTOM.replace("class Twice(Action)", "class Twice"),
    )
    (node,) = harness.launch(path).tree.nodes
    assert {p.name: p.value for p in node.params} == {"rate": "7", "frame": "base"}


def test_a_file_that_the_build_makes(harness: PythonHarness) -> None:
    harness.write("launch/made.launch.xml.in", '<launch><node pkg="p" exec="x" name="v@VERSION@"/></launch>')
    path = _described(
        harness, "IncludeLaunchDescription(AnyLaunchDescriptionSource([ThisLaunchFileDir(), '/made.launch.xml']))"
    )
    tree = harness.launch(path).tree
    assert [n.name for n in tree.nodes] == ["/v0"]
    assert [u.what for u in tree.unknowns] == ["@VERSION@"]


def test_a_file_of_a_test_framework(harness: PythonHarness) -> None:
    path = _described(
        harness,
        "Node(package='p', executable='x', name='n')",
        "launch_testing.actions.ReadyToTest()",
        before="import launch_testing.actions\n"
        + "from launch_testing.legacy import LaunchTestService\nfrom launch_testing.markers import keep_alive\n",
    )
    analysis = harness.launch(path)
    assert [n.name for n in analysis.tree.nodes] == ["/n"]
    assert analysis.findings == ()


def test_what_only_the_sandbox_refuses_is_no_error(harness: PythonHarness, tmp_path: Path) -> None:
    hidden = tmp_path.parent / f"hidden from {tmp_path.name}"
    hidden.write_text("x")
    removed = harness.write("removed", "")
    for before in (f"open({str(hidden)!r})\n", f"import os\nos.unlink({str(removed)!r})\n"):
        path = _described(harness, "Node(package='p', executable='x', name='n')", before=before)
        analysis = harness.launch(path)
        assert [(f.rule, f.severity) for f in analysis.findings] == [("LCH018", "hint")]
        assert "the sandbox" in analysis.findings[0].message
    assert removed.exists()


def test_what_another_version_of_ours_told_is_not_kept(harness: PythonHarness, monkeypatch: pytest.MonkeyPatch) -> None:
    path = _described(harness, "Node(package='p', executable='x', name='n')")
    harness.launch(path)
    runs: list[object] = []
    execute = run.execute_command
    monkeypatch.setattr(run, "execute_command", lambda *args: runs.append(args) or execute(*args))
    harness.launch(path)
    assert not runs, "it is cached"
    monkeypatch.setattr(launch_files, "_edition", lambda: "another")
    harness.launch(path)
    assert len(runs) == 1


def test_what_is_not_installed_and_what_is_no_container(harness: PythonHarness) -> None:
    harness.write("setup.py", "from setuptools import setup\nsetup(name='p', data_files=[('share/p', ['package.xml']), "
               "('share/p/launch', ['launch/a.launch.py'])])\n")  # fmt: skip
    harness.write("config/p.yaml", "n:\n  ros__parameters: {a: 1}\n")
    path = _described(
        harness,
        "Node(package='p', executable='x', name='n', "
        "parameters=[PathJoinSubstitution([FindPackageShare('p'), 'config', 'p.yaml'])])",
        "ComposableNodeContainer(package='p', executable='component_container', name='camera_container', namespace='')",
        "LoadComposableNodes(target_container='cam_container', "
        "composable_node_descriptions=[ComposableNode(package='p', plugin='p::A', name='a')])",
    )
    found = {f.rule: f for f in harness.launch(path).findings if f.rule in ("PKG005", "LCH034")}
    assert {rule: finding.severity for rule, finding in found.items()} == {"PKG005": "warning", "LCH034": "warning"}
    span = found["LCH034"].location.span
    assert path.read_text()[span.start : span.end] == "cam_container"
    path.write_text(path.read_text().replace("cam_container", "camera_container") + "HERE = __file__\n")
    assert not {f.rule for f in harness.launch(path).findings} & {"PKG005", "LCH034"}


def test_what_a_newer_launch_has(harness: PythonHarness) -> None:
    harness.write("a/b", "")
    path = _described(
        harness,
        "ForLoop('2', function=lambda i: [Node(package='p', executable='x', name=f'loop{i}')])",
        "ForEach(\"{name: 'a'};{name: 'b'}\", function=lambda name: [Node(package='p', executable='x', name=name)])",
        "Node(package='p', executable='x', name='n', parameters=[PathSubstitution(FindPackageShare('p')) / 'a' / 'b'])",
    )
    tree = harness.launch(path).tree
    assert [node.name for node in tree.nodes] == ["/loop0", "/loop1", "/a", "/b", "/n"]
    assert [source.path for source in tree.nodes[-1].param_sources] == [str(harness.package / "a" / "b")]


def test_a_class_that_finds_no_package(harness: PythonHarness) -> None:
    """launch_ros raises NotImplementedError when it is performed; a class made from it says where to look."""
    before = (
        "from launch_ros.substitutions import FindPackage\n"
        "class Lib(FindPackage):\n    def find(self, name):\n        return '/lib_of_' + name\n"
    )
    path = _described(harness, "LogInfo(msg=[FindPackage('p'), '/x'])", before=before)
    (finding,) = harness.launch(path).findings
    expected = "FindPackage finds no folder by itself; use FindPackageShare or FindPackagePrefix"
    assert (finding.rule, finding.message) == ("LCH011", expected)
    path = _described(harness, "ExecuteProcess(cmd=['ls', Lib('p')])", before=before)
    assert [node.args for node in harness.launch(path).tree.nodes] == ["/lib_of_p"]


def test_a_file_for_launch_test_is_a_launch_file(harness: PythonHarness) -> None:
    path = harness.write(
        "test/test_launch.py",
        HEAD
        + """
import launch_testing
import unittest

def generate_test_description(ready_fn):
    node = Node(package='p', executable='x', name='n')
    keep = launch_testing.util.KeepAliveProc()
    return LaunchDescription([node, keep, launch_testing.actions.ReadyToTest()]), locals()

@launch_testing.post_shutdown_test()
class Ends(unittest.TestCase):
    pass
""",
    )
    analysis = harness.launch(path)
    assert [node.name for node in analysis.tree.nodes] == ["/n"]
    assert [finding.message for finding in analysis.findings if finding.rule == "LCH032"] == []


def test_an_include_that_raises_and_is_never_executed(harness: PythonHarness) -> None:
    """launch looks into it for required arguments, and says nothing of what it raises."""
    harness.write("launch/broken.launch.py", "def generate_launch_description():\n    raise ValueError('no')\n")
    include = "IncludeLaunchDescription([FindPackageShare('p'), '/launch/broken.launch.py']"
    path = _described(harness, f"{include}, condition=IfCondition('false'))")
    assert not harness.launch(path).tree.problems
    path = _described(harness, f"{include})")
    assert [type(problem.kind) for problem in harness.launch(path).tree.problems] == [PythonException]


def test_an_argument_that_nothing_uses(harness: PythonHarness) -> None:
    actions = (
        "DeclareLaunchArgument('speed', default_value='1')",
        "DeclareLaunchArgument('name', default_value='n')",
        "Node(package='p', executable='x', name=LaunchConfiguration('name'))",
    )
    findings = harness.launch(_described(harness, *actions)).findings
    assert [f.message for f in findings if f.rule == "ARG008"] == [
        "unused argument 'speed': nothing in this launch uses it"
    ]


def test_helpers_of_the_project_may_use_an_argument(harness: PythonHarness) -> None:
    harness.write(
        "launch/helper.py",
        """
        from launch.substitutions import LaunchConfiguration
        SPEED = LaunchConfiguration('speed')
        """,
    )
    path = _described(
        harness,
        "DeclareLaunchArgument('speed', default_value='1')",
        "Node(package='p', executable='x', name='n', parameters=[{'speed': SPEED}])",
        before="import os, sys\nsys.path.insert(0, os.path.dirname(__file__))\nfrom helper import SPEED\n",
    )
    analysis = harness.launch(path)
    assert [node.name for node in analysis.tree.nodes] == ["/n"]
    assert "ARG008" not in {f.rule for f in analysis.findings}


def test_a_parameter_that_is_set_again(harness: PythonHarness) -> None:
    """Which value counts is what real rclpy has: `tests/evaluation/test_params_against_rclpy.py`."""
    harness.write("config/a.yaml", "a:\n  ros__parameters: {rate: 2.0, frame: map}\n")
    file = "PathJoinSubstitution([FindPackageShare('p'), 'config', 'a.yaml'])"
    before = "common = {'rate': 5.0}\ndef of_library():\n    return {'rate': 6.0}\n"
    sources = (
        f"[{{'rate': 7.0}}, {file}]",
        "[{'name': 'one', 'value': 1}, {'name': 'two', 'value': 1}, {'name': 'three', 'value': 2}]",
        "[Parameter('rate', 1.0), {'rate': 2.0}]",
        f"[common, {file}]",
        # What is there to be overridden, and what is the same.
        f"[{file}, {{'rate': 7.0}}]",
        "[common, {'rate': 1.0}]",
        f"[of_library(), {file}]",
        f"[{{'rate': 2.0}}, {file}]",
    )
    nodes = [f"Node(package='p', executable='x', name='a', namespace='', parameters={each})" for each in sources]
    path = _described(harness, *nodes, before="from launch_ros.parameter_descriptions import Parameter\n" + before)
    analysis = harness.launch(path)
    found = []
    for finding in analysis.findings:
        if finding.rule == "PRM006":
            text, at = analysis.documents[finding.location.file].text, finding.location.span.start
            value = finding.message.rpartition(", not ")[2]
            found.append((text[at : text.index("\n", at)].partition("}")[0], finding.severity, value))
    assert found == [
        ("rate': 5.0", "info", "'5.0'"),
        ("rate': 7.0", "warning", "'7.0'"),
        ("name': 'one', 'value': 1", "warning", "'one'"),
        ("value': 1", "warning", "'1'"),
        ("name': 'two', 'value': 1", "warning", "'two'"),
        ("value': 1", "warning", "'1'"),
        ("rate', 1.0), {'rate': 2.0", "warning", "'1.0'"),
    ]


@pytest.mark.parametrize("folder", ["get_package_share_directory('ros_gz_sim')", "FindPackageShare('ros_gz_sim')"])
def test_a_launch_file_of_a_package_that_is_not_here_is_that_of_the_catalogue(
    harness: PythonHarness, folder: str
) -> None:
    file = f"PathJoinSubstitution([{folder}, 'launch', 'gz_sim.launch.py'])"
    if folder.startswith("get"):
        file = f"{folder} + '/launch/gz_sim.launch.py'"
    passed = "launch_arguments={'gz_args': '-r'}.items()"
    include = f"IncludeLaunchDescription(PythonLaunchDescriptionSource({file}), {passed})"
    nodes = harness.launch(_described(harness, include)).tree.nodes
    assert [node.args.split()[:2] for node in nodes] == [["sim", "-r"]]
