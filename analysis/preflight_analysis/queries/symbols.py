"""The outline of a launch file: its tags as they nest, with the names that a reader looks for."""

from __future__ import annotations

from dataclasses import dataclass, replace

from preflight_analysis.documents.span import Span
from preflight_analysis.launch.model import NODE_KINDS, Action, LaunchFile, Value


@dataclass(frozen=True, slots=True)
class Symbol:
    """One tag. `kind` is the tag's own name; `selection` lies within `span`: an editor puts the cursor there."""

    name: str
    detail: str
    kind: str
    span: Span
    selection: Span
    children: tuple[Symbol, ...] = ()


_NAMED_BY = {
    "node": ("name", "exec", "type"),
    "node_container": ("name", "exec"),
    "composable_node": ("name", "plugin"),
    "load_composable_node": ("target",),
    "lifecycle_node": ("name", "exec"),
    "executable": ("name", "cmd"),
    "let": ("name",),
    "push_ros_namespace": ("namespace",),
    "push-ros-namespace": ("namespace",),
    "set_remap": ("from",),
    "set_parameter": ("name",),
    "set_parameters_from_file": ("filename",),
    "set_env": ("name",),
    "timer": ("period",),
    "ros_timer": ("period",),
    "test": ("test-name", "name", "type"),
    "include": ("file",),
    "group": ("ns",),
    "arg": ("name",),
    "param": ("name", "from"),
    "rosparam": ("param", "file", "ns"),
    "remap": ("from",),
    "env": ("name",),
    "machine": ("name",),
}


_OF_PYTHON = NODE_KINDS | {"include"}


def symbols(launch_file: LaunchFile) -> tuple[Symbol, ...]:
    """The outline of the file; empty when it has no `<launch>`. Tags that the launcher does not know are left out. Of a
    Python file only what is ROS's: nodes and includes."""
    root = launch_file.root
    if root is not None and launch_file.partial:
        ours = (replace(action, children=()) for action in root.walk() if action.kind in _OF_PYTHON)
        return tuple(sorted(map(_symbol, ours), key=lambda symbol: symbol.span))
    return tuple(_symbol(child) for child in root.children if child.kind in _NAMED_BY) if root else ()


def _symbol(action: Action) -> Symbol:
    children = tuple(_symbol(child) for child in action.children if child.kind in _NAMED_BY)
    named = next((a for n in _NAMED_BY[action.kind] if (a := action.attribute(n)) and _is_known(a.value)), None)
    selection = named.value.span if named else action.kind_span
    if not (action.span.start <= selection.start and selection.end <= action.span.end):
        selection = action.span
    return Symbol(
        " ".join(named.value.text.split()) if named else action.kind,
        _detail(action),
        action.kind,
        action.span,
        selection,
        children,
    )


def _is_known(value: Value) -> bool:
    """Whether there is a name, and not only something that a program computes."""
    return bool(value.text.strip()) and not any(part.command == "python" for part in value.substitutions)


def _detail(action: Action) -> str:
    """What else is worth a glance, as written in the file."""
    given = {a.name: " ".join(a.value.text.split()) for a in action.attributes}
    if action.kind in NODE_KINDS:
        detail = "/".join(given[n] for n in ("pkg", "type", "exec", "plugin") if n in given)
    elif action.kind in ("remap", "set_remap"):
        detail = f"→ {given['to']}" if "to" in given else ""
    elif action.kind in ("param", "arg", "env", "let", "set_parameter", "set_env"):
        detail = next((given[n] for n in ("value", "default", "textfile", "binfile", "command") if n in given), "")
    else:
        detail = ""
    conditions = [f"{n} {given[n]}" for n in ("if", "unless") if n in given]
    return ", ".join(part for part in (detail, *conditions) if part)
