"""What stands around a node in its launch files, from the outermost include inwards: conditions and namespaces."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import zip_longest

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.launch.model import Action, Value
from preflight_analysis.model.context import Context

_CONDITIONS = ("if", "unless")
_NAMESPACES = ("ns", "namespace")
_PUSHES = ("push_ros_namespace", "push-ros-namespace")


@dataclass(frozen=True, slots=True)
class Written:
    """A condition or a namespace as written, and where."""

    text: str
    place: Location


def conditions_of(context: Context, node: LaunchNode) -> Iterator[Written]:
    """The conditions under which the launch starts the node."""
    for file, around in _around(context, node):
        for action in around:
            for name in _CONDITIONS:
                if (value := action.value(name)) is not None:
                    place = context.location(file, value.span)
                    in_python = context.launch_files[file].is_python
                    text = context.text(place) if in_python else f'{name}="{value.text}"'
                    yield Written(" ".join(text.split()), place)


def namespaces_of(context: Context, node: LaunchNode) -> Iterator[Written]:
    """What puts the node into its namespace."""
    for file, around in _around(context, node):
        for action, inner in zip_longest(around, around[1:]):
            for value in _spaces(action, inner):
                if value.text.strip("/"):
                    yield Written(f"'{value.text}'", context.location(file, value.span))


def _spaces(action: Action, inner: Action | None) -> Iterator[Value]:
    if action.kind != "launch":
        yield from (value for name in _NAMESPACES if (value := action.value(name)) is not None)
    for child in action.children if inner is not None else ():
        if child.span.start >= (inner.span.start if inner is not None else 0):
            break
        if child.kind in _PUSHES:
            yield from (value for name in _NAMESPACES if (value := child.value(name)) is not None)


def _around(context: Context, node: LaunchNode) -> Iterator[tuple[str, Sequence[Action]]]:
    """Of each file on the way to the node the tags around the next one, and that itself."""
    for place in node.origin:
        launch_file = context.launch_files.get(place.file)
        action = launch_file.root if launch_file is not None else None
        around: list[Action] = []
        while action is not None:
            around.append(action)
            at = place.span.start
            action = next((each for each in action.children if each.span.start <= at < each.span.end), None)
        yield place.file, around
