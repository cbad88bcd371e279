"""Each action of ROS 2 is declared once, and what is declared is read, evaluated, outlined and imitated."""

from __future__ import annotations

import contextlib
import inspect
import re
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.documents.reading import Text
from preflight_analysis.documents.span import LineIndex, Span
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.evaluation.ros2.actions import registry
from preflight_analysis.evaluation.ros2.check_language import check_language_ros2
from preflight_analysis.evaluation.ros2.check_values import check_values_ros2
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.launch.model import NODE_KINDS
from preflight_analysis.launch.python_actions import actions_of
from preflight_analysis.launch.python_api import BY_NAME, parameters
from preflight_analysis.launch.python_source import PythonSource
from preflight_analysis.launch.read import read_launch
from preflight_analysis.launch.schema import Tag
from preflight_analysis.launch.substitutions_ros2 import SUBSTITUTIONS_ROS2
from preflight_analysis.queries.symbols import symbols
from preflight_analysis.tracing.agents.fake_launch.api import CALLS, CHILDREN, Call
from preflight_analysis.tracing.agents.fake_launch.base import Action as FakeAction
from preflight_analysis.tracing.agents.fake_launch.base import Substitution as FakeSubstitution
from preflight_analysis.tracing.agents.fake_launch.modules import TABLE
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

TAGS = registry.tags()
VALUES = {"condition": "true", "flag": "true", "integer": "1", "number": "1.5"}
"""A value of each kind that takes not any text."""
TYPED = ("flag", "integer", "number")
TRACING = Path(__file__).parent.parent / "tracing"


def _parents(kind: str) -> str:
    """A tag that takes one of the kind."""
    return next(name for name, tag in TAGS.items() if kind in tag.children)


def _required(tag: Tag, kind: str) -> dict[str, str]:
    given = {name: VALUES.get(tag.attributes[name].kind, "x") for name in tag.required}
    return {"name": "x", "value": "x"} if kind == "param" else given


def _xml(kind: str) -> str:
    attributes = "".join(f' {name}="{value}"' for name, value in _required(TAGS[kind], kind).items())
    text = f"<{kind}{attributes}/>"
    while (parent := _parents(kind)) != "launch":
        needed = "".join(f' {name}="{value}"' for name, value in _required(TAGS[parent], parent).items())
        text, kind = f"<{parent}{needed}>{text}</{parent}>", parent
    return f"<launch>{text}</launch>"


def _yaml(kind: str) -> str:
    """The same; actions are items of `children`, parts are items of a list that has their name."""
    path = [kind]
    while path[0] != "launch":
        path.insert(0, _parents(path[0]))
    lines, indent = ["launch:"], 0
    for each in path[1:]:
        tag = TAGS[each]
        prefix = "- "
        if each in registry.actions():
            lines.append(f"{'  ' * indent}- {each}:")
            indent += 2
            prefix = ""
        else:
            lines.append(f"{'  ' * indent}{each}:")
        for name, value in _required(tag, each).items():
            plain = value if tag.attributes[name].kind in TYPED else f'"{value}"'
            lines.append(f"{'  ' * indent}{prefix}{name}: {plain}")
            prefix = "  " if prefix else ""
        indent += 1 if each not in registry.actions() else 0
    return "\n".join(lines) + (" {}\n" if lines[-1].endswith(":") else "\n")


@pytest.mark.parametrize("write", [_xml, _yaml])
@pytest.mark.parametrize("kind", [kind for kind in TAGS if kind != "launch"])
def test_it_is_read_in_both_formats_and_is_in_the_outline(kind: str, write: Any) -> None:
    path = f"/w/a.launch.{'xml' if write is _xml else 'yaml'}"
    found = read_launch(Text.of(path, write(kind)), 2)
    assert found.root is not None
    actions = [action for action in found.root.walk() if action.kind == kind]
    assert [set(_required(TAGS[kind], kind)) <= {a.name for a in action.attributes} for action in actions] == [True]
    assert check_language_ros2(found) == ()
    assert check_values_ros2(found) == ()
    assert _outlined(symbols(found), kind)


def _outlined(found: Any, kind: str) -> bool:
    return any(symbol.kind == kind or _outlined(symbol.children, kind) for symbol in found)


@pytest.mark.parametrize("kind", TAGS)
def test_each_tag_and_attribute_says_what_it_is(kind: str) -> None:
    tag = TAGS[kind]
    assert tag.doc.endswith(".")
    assert set(tag.children) <= TAGS.keys()
    assert {*tag.named_by, *tag.detail} <= tag.attributes.keys()
    for attribute in tag.attributes.values():
        assert attribute.doc.endswith("."), attribute.name


def test_parts_belong_to_what_takes_them() -> None:
    known = registry.entities()
    for part in registry.parts().values():
        assert set(part.of) <= known.keys()
        assert part.of or part.kind == "launch"
        for owner in part.of if part.tag is not None else ():
            assert owner in ("set_parameter",) or part.kind in TAGS[owner].children, (part.kind, owner)


def test_what_starts_nodes_is_known_by_all() -> None:
    """`NODE_KINDS` is for both generations and for layers that have no language."""
    nodes = {"node", "node_container", "lifecycle_node", "composable_node"}
    assert {kind for kind, tag in TAGS.items() if tag.attributes.keys() & {"exec", "plugin"}} == nodes
    assert nodes == NODE_KINDS - {"test"}


# What each does, told by what differs without it

NODE = '<node pkg="p" exec="x" name="{}"/>'


def _names(tree: LaunchTree) -> list[str]:
    return [f"({node.name})" if node.deferred else node.name for node in tree.nodes]


def _wrong(tree: LaunchTree) -> list[str]:
    return [type(problem.kind).__name__ for problem in tree.problems]


SPEAKS: dict[str, tuple[str, Any, Any]] = {
    "arg": ('<arg name="a" default="b"/>' + NODE.format("$(var a)"), _names, ["/b"]),
    "let": ('<let name="a" value="b"/>' + NODE.format("$(var a)"), _names, ["/b"]),
    "include": ('<include file="/dev/null/b.launch.xml"/>', _wrong, ["IncludeNotFound"]),
    "group": (
        '<let name="a" value="b"/><group><let name="a" value="c"/><node pkg="p" exec="x" name="m$(var a)"/></group>'
        + NODE.format("n$(var a)"),
        _names,
        ["/mc", "/nb"],
    ),
    "reset": ('<let name="a" value="b"/><reset/>' + NODE.format("$(var a c)"), _names, ["/c"]),
    "node": (NODE.format("n"), _names, ["/n"]),
    "lifecycle_node": (
        '<lifecycle_node pkg="p" exec="x" name="n" namespace=""/>',
        lambda tree: [node.kind for node in tree.nodes],
        ["lifecycle"],
    ),
    "node_container": (
        '<node_container pkg="p" exec="x" name="n" namespace="">'
        '<composable_node pkg="p" plugin="p::C" name="c"/></node_container>',
        lambda tree: [(node.kind, node.container) for node in tree.nodes],
        [("container", None), ("composable", "/n")],
    ),
    "load_composable_node": (
        '<load_composable_node target="/n"><composable_node pkg="p" plugin="p::C" name="c"/></load_composable_node>',
        lambda tree: [node.container for node in tree.nodes],
        ["/n"],
    ),
    "executable": ('<executable cmd="ls -l"/>', lambda tree: [node.args for node in tree.nodes], ["-l"]),
    "push_ros_namespace": ('<push_ros_namespace namespace="s"/>' + NODE.format("n"), _names, ["/s/n"]),
    "push-ros-namespace": ('<push-ros-namespace namespace="s"/>' + NODE.format("n"), _names, ["/s/n"]),
    "set_remap": (
        '<set_remap from="a" to="b"/>' + NODE.format("n"),
        lambda tree: [(remap.source, remap.target) for remap in tree.nodes[0].remaps],
        [("a", "b")],
    ),
    "set_parameter": (
        '<set_parameter name="a" value="1"/>' + NODE.format("n"),
        lambda tree: [(param.name, param.value) for param in tree.nodes[0].params],
        [("a", 1)],
    ),
    "set_parameters_from_file": (
        '<set_parameters_from_file filename="/dev/null/a.yaml"/>' + NODE.format("n"),
        _wrong,
        ["ParameterFileNotFound"],
    ),
    "set_use_sim_time": ('<set_use_sim_time value="true"/>', _wrong, ["BadValue"]),
    "set_ros_log_dir": (
        '<set_ros_log_dir new_log_dir="/a"/>' + NODE.format("n$(env ROS_LOG_DIR)"),
        _wrong,
        ["InvalidName"],
    ),
    "timer": (f'<timer period="1">{NODE.format("n")}</timer>', _names, ["(/n)"]),
    "ros_timer": (f'<ros_timer period="1.5">{NODE.format("n")}</ros_timer>', _names, ["(/n)"]),
    "for": (f'<for len="2" name="i">{NODE.format("n$(index i)")}</for>', _names, ["/n0", "/n1"]),
    "for_each": (
        f'<for_each values="{{i: a}};{{i: b}}">{NODE.format("n$(for-var i)")}</for_each>',
        _names,
        ["/na", "/nb"],
    ),
    "set_env": ('<set_env name="A" value="b"/>' + NODE.format("n$(env A c)"), _names, ["/nb"]),
    "unset_env": ('<set_env name="A" value="b"/><unset_env name="A"/>' + NODE.format("n$(env A c)"), _names, ["/nc"]),
    "append_env": (
        '<set_env name="A" value="b"/><append_env name="A" value="d" separator="_"/>' + NODE.format("n$(env A c)"),
        _names,
        ["/nb_d"],
    ),
    "reset_env": ('<set_env name="A" value="b"/><reset_env/>' + NODE.format("n$(env A c)"), _names, ["/nc"]),
    **{kind: (f'<{kind} message="$(var a)"/>', _wrong, ["UndeclaredArgument"]) for kind in TAGS if kind[:3] == "log"},
    "ros_gz_bridge": ('<ros_gz_bridge bridge_name="b" config_file="/b.yaml" namespace="r"/>', _names, ["/r/b"]),
    "gz_server": ('<gz_server world_sdf_file="/a.sdf"/>', _names, ["/gzserver"]),
    "gz_spawn_model": ('<gz_spawn_model entity_name="a" yaw="1"/>', _names, ["/create"]),
    "shutdown": ('<shutdown reason="$(var a)"/>', _wrong, ["UndeclaredArgument"]),
}


@pytest.mark.parametrize("kind", [kind for kind in registry.actions() if kind in TAGS])
def test_each_action_of_xml_does_something(kind: str, tmp_path: Path) -> None:
    text, asked, expected = SPEAKS[kind]
    path = tmp_path / "a.launch.xml"
    path.write_text(f"<launch>{text}</launch>")
    workspace = Workspace(detect_environment(None, {"ROS_VERSION": "2"}, ()), Sources())
    assert asked(workspace.static(str(path)).tree) == expected
    never = re.sub(f"<{kind}(?=[ />])", f'<{kind} if="false"', text)
    path.write_text(f"<launch>{never}</launch>")
    with contextlib.suppress(IndexError):
        assert asked(workspace.static(str(path)).tree) != expected


@pytest.mark.parametrize("kind", [kind for kind in registry.actions() if kind not in TAGS])
def test_each_action_of_python_alone_is_run_in_a_test(kind: str) -> None:
    """`tests/tracing` runs launch files in the sandbox."""
    names = [each.short_name for each in CALLS if each.kind == kind]
    texts = [path.read_text() for path in TRACING.glob("test_python*.py")]
    is_made = any(f"{name}(" in text for name in names for text in texts)
    assert is_made or kind in ("unknown", "test", "stand_in", "branch")


# What a Python launch file gets in place of `launch`

MODULES = ("launch.actions", "launch_ros.actions", "launch.substitutions", "launch_ros.substitutions")


@pytest.mark.parametrize("call", [each for each in CALLS if each.name.startswith("launch")], ids=lambda each: each.name)
def test_a_class_is_made_of_what_is_declared(call: Call) -> None:
    module, _, short = call.name.rpartition(".")
    fake = TABLE[module][short]
    assert (fake.preflight_call.kind, parameters(fake.preflight_call)) == (call.kind, parameters(call))
    above = next((each for each in fake.__mro__ if each.__name__ == call.of), None)
    assert (above is not None) == bool(call.of)
    handed_on = parameters(above.preflight_call) if above is not None else ()
    assert set(call.gives) <= {each.name for each in handed_on or ()}
    taken = {each.name for each in parameters(call) or ()}
    assert set(call.attributes.values()) <= taken


def test_python_says_what_is_wrong_with_a_call() -> None:
    node, remap = TABLE["launch_ros.actions"]["Node"], TABLE["launch_ros.actions"]["SetRemap"]
    with pytest.raises(TypeError, match=r"__init__\(\) missing 1 required keyword-only argument: 'executable'"):
        node(package="p")
    with pytest.raises(TypeError, match=r"__init__\(\) got an unexpected keyword argument 'pkg'"):
        node(executable="x", pkg="p")
    with pytest.raises(TypeError, match=r"__init__\(\) missing 1 required positional argument: 'dst'"):
        remap("a")


@pytest.mark.parametrize(
    ("name", "args"),
    [
        ("SetEnvironmentVariable", ("A", 5)),
        ("SetLaunchConfiguration", ("a", True)),
        ("UnsetEnvironmentVariable", (None,)),
        ("AppendEnvironmentVariable", ("A", "b", 1)),
        ("SetRemap", ("a", 2.0)),
        ("SetUseSimTime", (1,)),
        ("PushROSNamespace", (None,)),
        ("AndSubstitution", ("a", None)),
        ("EnvironmentVariable", (None,)),
        ("FindPackageShare", (1,)),
    ],
)
def test_what_is_kept_has_to_be_a_text(name: str, args: tuple[object, ...]) -> None:
    made = next(TABLE[module][name] for module in MODULES if name in TABLE[module])
    with pytest.raises(TypeError, match="Failed to normalize"):
        made(*args)


def test_flags_are_kept_as_they_are() -> None:
    assert TABLE["launch_ros.actions"]["SetUseSimTime"](True).value is True
    assert TABLE["launch.actions"]["AppendEnvironmentVariable"]("A", "b", prepend=True).prepend is True
    assert TABLE["launch.substitutions"]["EnvironmentVariable"]("A").default_value is None


def test_each_fake_action_is_declared() -> None:
    fakes = {
        f"{module}.{name}"
        for module in MODULES
        for name, thing in TABLE[module].items()
        if isinstance(thing, type) and issubclass(thing, (FakeAction, FakeSubstitution))
    }
    assert fakes > {"launch.actions.PushEnvironment", "launch_ros.actions.Node", "launch.substitutions.AnonName"}
    assert fakes - BY_NAME.keys() == set()


def test_what_is_declared_is_evaluated() -> None:
    substitutions = {*SUBSTITUTIONS_ROS2, "find-pkg", "local"}
    assert {each.kind for each in CALLS if each.kind} - registry.entities().keys() - substitutions == set()
    assert CHILDREN.keys() <= registry.entities().keys()


def test_a_kind_is_declared_once(monkeypatch: pytest.MonkeyPatch) -> None:
    registry.entities.cache_clear()
    modules = list(registry._modules())
    monkeypatch.setattr(registry, "_modules", lambda: [*modules, modules[0]])
    with pytest.raises(ValueError, match="declared twice"):
        registry.entities()


def test_a_module_without_entities_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    registry.entities.cache_clear()
    monkeypatch.setattr(registry, "_modules", lambda: [inspect])
    with pytest.raises(TypeError, match="inspect declares no ENTITIES"):
        registry.entities()


def test_nodes_in_a_loop_are_in_the_outline() -> None:
    text = f'<launch><for len="1" name="i">{NODE.format("n")}</for></launch>'
    (loop,) = symbols(read_launch(Text.of("/w/a.launch.xml", text), 2))
    assert [(child.name, child.kind) for child in loop.children] == [("n", "node")]


@pytest.mark.parametrize("call", ["SetRemap('a', 'b')", "SetRemap(dst='b', src='a')"])
def test_the_names_of_a_remap_are_where_they_are_written(call: str) -> None:
    source = PythonSource(call, LineIndex(call))
    record = {"k": "set_remap", "n": "SetRemap", "p": [1, 0], "a": {"from": ["a"], "to": ["b"]}, "c": []}
    (action,) = actions_of([record], source, Span(0, 0))
    spans = [attribute.value.span for attribute in action.attributes]
    assert [call[span.start : span.end].strip("'") for span in spans] == ["a", "b"]


@pytest.mark.parametrize("kind", ["group", "timer", "ros_timer", "for", "for_each", "include", "node", "executable"])
def test_what_is_left_out_is_noted_where_it_would_start_something(kind: str, tmp_path: Path) -> None:
    path = tmp_path / "a.launch.xml"
    path.write_text(_xml(kind).replace(f"<{kind}", f'<{kind} if="false"'))
    workspace = Workspace(detect_environment(None, {"ROS_VERSION": "2"}, ()), Sources())
    assert [left_out.action.kind for left_out in workspace.static(str(path)).tree.not_taken] == [kind]
