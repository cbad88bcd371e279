"""Python launch files that are not run: any text is read, and what is written out is found."""

from __future__ import annotations

import gc
import weakref
from pathlib import Path

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from preflight_analysis.documents.reading import Text
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.read import read_launch

WHOLE = """\
from launch import LaunchDescription
import launch_ros.actions as ros

MODEL = "a1"

def generate_launch_description():
    größe = DeclareLaunchArgument("model", default_value=MODEL, choices=["a1", "s2"], description="é")
    ld = LaunchDescription([größe, GroupAction([
        PushRosNamespace(LaunchConfiguration("model")),
        ros.Node(package="p", executable="x", name="n" + "m"),
    ])])
    ld.add_action(IncludeLaunchDescription(
        PythonLaunchDescriptionSource(os.path.join(get_package_share_directory("p"), "launch", "b.launch.py")),
        launch_arguments={"model": LaunchConfiguration("model"), "n": "1"}.items(),
    ))
    return ld
"""


def _read(text: str) -> tuple[Action, ...]:
    found = read_launch(Text.of("/a.launch.py", text))
    assert found.partial
    assert found.root is not None
    return found.root.children


def test_what_is_written_out() -> None:
    arg, group, include = _read(WHOLE)
    assert (arg.kind, [c.attributes[0].value.text for c in arg.children]) == ("arg", ["a1", "s2"])
    default = arg.value("default")
    assert default is not None
    assert (default.text, WHOLE[default.span.start : default.span.end]) == ("a1", "a1")
    description = arg.value("description")
    assert description is not None
    assert WHOLE[description.span.start : description.span.end] == "é"
    assert [c.kind for c in group.children] == ["push_ros_namespace", "node"]
    node = group.children[1]
    assert WHOLE[node.head_span.start : node.head_span.end] == "Node"
    name = node.value("name")
    assert name is not None
    assert not name.is_literal, "what is computed is not known"
    file = include.value("file")
    assert file is not None
    assert file.text == "$(path-join $(find-pkg-share p) launch b.launch.py)"
    assert [(c.attributes[0].value.text, c.attributes[1].value.text) for c in include.children] == [
        ("model", "$(var model)"),
        ("n", "1"),
    ]


def test_half_of_it() -> None:
    """Each call counts, wherever the text breaks off, with what it was given until then."""
    cut = WHOLE[: WHOLE.index('name="n"')]
    assert [action.kind for action in _read(cut)] == ["arg", "push_ros_namespace", "node"]
    node = _read(cut)[-1]
    assert [(a.name, a.value.text) for a in node.attributes] == [("pkg", "p"), ("exec", "x")]
    held = "GroupAction(actions=[Node(package='p', executable='x')], forwarding=\nNode(package='q', executable="
    assert [(a.kind, [c.kind for c in a.children]) for a in _read(held)] == [("group", ["node"]), ("node", [])]


@settings(max_examples=150, derandomize=True, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.integers(0, len(WHOLE)), st.integers(0, 40), st.text(max_size=20))
def test_any_text_is_read(at: int, removed: int, added: str) -> None:
    text = WHOLE[:at] + added + WHOLE[at + removed :]
    for action in _read(text):
        assert 0 <= action.span.start <= action.span.end <= len(text)


def test_strange_texts() -> None:
    for text in ("", "\f\r\n\r", "Node(" * 3000, "(" * 100_000, "[" * 500 + "]" * 500, "x = '\ud800'"):
        assert _read(text) == (), text[:20]
    assert [action.kind for action in _read("\ufeffNode()")] == ["node"]
    deep = "Node(name=" + "[" * 80 + "'x'" + "]" * 80 + ")"
    assert [action.kind for action in _read(deep)] == ["node"]
    assert _read(Path(__file__).read_text(encoding="utf-8")) == ()


def test_what_is_remembered_of_a_mistake_keeps_nothing_of_who_asked() -> None:
    class Local:
        pass

    def ask() -> weakref.ref[Local]:
        local = Local()
        read_launch(Text.of("/a.launch.py", "x = (only here"))
        return weakref.ref(local)

    local = ask()
    gc.collect()
    assert local() is None
