"""The outline of a launch file: its tags as they nest, with the names that a reader looks for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.ros2.python_branches import BRANCH
from preflight_analysis.evaluation.tags import tags_of
from preflight_analysis.launch.model import NODE_KINDS, Action, LaunchFile, Value
from preflight_analysis.launch.schema import Tag


@dataclass(frozen=True, slots=True)
class Symbol:
    """One tag. `kind` is the tag's own name; `selection` lies within `span`: an editor puts the cursor there."""

    name: str
    detail: str
    kind: str
    span: Span
    selection: Span
    children: tuple[Symbol, ...] = ()


_UNSEEN = (BRANCH, "inline")
"""What holds actions and is no object of its own for people."""
_OF_PYTHON = NODE_KINDS | {"include"}


def symbols(launch_file: LaunchFile) -> tuple[Symbol, ...]:
    """The outline of the file; empty when it has no `<launch>`. Tags that the launcher does not know are left out. Of a
    Python file only what is ROS's: nodes and includes."""
    root, tags = launch_file.root, tags_of(launch_file.generation)
    if root is not None and launch_file.partial:
        ours = (replace(action, children=()) for action in root.walk() if action.kind in _OF_PYTHON)
        return tuple(sorted((_symbol(launch_file, action, tags) for action in ours), key=lambda symbol: symbol.span))
    return tuple(_below(launch_file, root, tags)) if root else ()


def _below(launch_file: LaunchFile, action: Action, tags: Mapping[str, Tag]) -> Iterator[Symbol]:
    for child in action.children:
        if child.kind in tags:
            yield _symbol(launch_file, child, tags)
        elif child.kind in _UNSEEN:
            yield from _below(launch_file, child, tags)


def _symbol(launch_file: LaunchFile, action: Action, tags: Mapping[str, Tag]) -> Symbol:
    children, tag = tuple(_below(launch_file, action, tags)), tags[action.kind]
    named = next((a for n in tag.named_by if (a := action.attribute(n)) and _is_known(a.value)), None)
    selection = named.value.span if named else action.kind_span
    if not (action.span.start <= selection.start and selection.end <= action.span.end):
        selection = action.span
    return Symbol(
        _written(launch_file, named.value) if named else action.kind,
        _detail(launch_file, action, tag),
        action.kind,
        action.span,
        selection,
        children,
    )


def _is_known(value: Value) -> bool:
    """Whether there is a name, and not only something that a program computes."""
    return bool(value.text.strip()) and not any(part.command == "python" for part in value.substitutions)


def _written(launch_file: LaunchFile, value: Value) -> str:
    """A value as written in the file. What code makes is no text of the launch language there."""
    of_code = launch_file.is_python and bool(value.substitutions)
    return " ".join((launch_file.document.text[slice(*value.span)] if of_code else value.text).split())


def _detail(launch_file: LaunchFile, action: Action, tag: Tag) -> str:
    """What else is worth a glance, as written in the file."""
    given = {a.name: _written(launch_file, a.value) for a in action.attributes}
    if action.kind in NODE_KINDS:
        detail = "/".join(given[n] for n in ("pkg", "type", "exec", "plugin") if n in given)
    else:
        detail = next((given[n] for n in tag.detail if n in given), "")
        detail = f"→ {detail}" if tag.detail == ("to",) and detail else detail
    conditions = [f"{n} {given[n]}" for n in ("if", "unless") if n in given]
    return ", ".join(part for part in (detail, *conditions) if part)
