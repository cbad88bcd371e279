"""Tags and attributes that the ROS 2 launch language does not know. launch reads a file whole before it executes any
of it, and stops at the first of them."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.evaluation.ros2.actions.registry import tags
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import NODE_KINDS, Action, LaunchFile
from preflight_analysis.launch.problems import (
    ConflictingAttributes,
    LanguageProblem,
    MissingAttribute,
    UnknownAttribute,
    UnknownElement,
)

_ANNOTATIONS = ("topics", "services", "params", "actions")


@derived
def check_language_ros2(launch_file: LaunchFile) -> tuple[LanguageProblem, ...]:
    """Everything in the file at which launch would stop while it reads it, in document order."""
    if launch_file.root is None:
        return ()
    # In the middle of typing the line that has the attribute may be the one that is left out.
    typing = bool(launch_file.document.problems)
    found = _check(launch_file.root, None)
    return tuple(problem for problem in found if not (typing and isinstance(problem.kind, MissingAttribute)))


def _check(action: Action, parent: str | None) -> Iterator[LanguageProblem]:
    tag = tags()[action.kind]
    allowed = tag.attributes
    given = {attribute.name for attribute in action.attributes}
    # `Parser.parse_description` asks an action for what was not read of it, not the root: `<launch version="0.1.0">`.
    for attribute in action.attributes if parent is not None else ():
        name = attribute.name
        if name in allowed and not _is_elsewhere(action.kind, parent, name):
            continue
        if name.endswith("-sep") and name.removesuffix("-sep") in given and action.head_span != action.kind_span:
            continue  # launch_xml reads it; in YAML, where the head of an entity is its name, a list is a list
        yield LanguageProblem(UnknownAttribute(name, action.kind, tuple(allowed)), attribute.name_span)
    required = ("name", "value") if (action.kind, parent) == ("arg", "include") else tag.required
    missing = next((name for name in required if name not in given), None)
    if missing is not None:
        yield LanguageProblem(MissingAttribute(action.kind, (missing,)), action.kind_span)
    if given.issuperset(("if", "unless")):
        yield LanguageProblem(ConflictingAttributes(action.kind, ("if", "unless")), action.kind_span)
    yield from _check_param(action, given)
    for child in action.children:
        if child.kind in tag.children:
            yield from _check(child, action.kind)
        elif not (action.kind in NODE_KINDS and child.kind in _ANNOTATIONS):
            yield LanguageProblem(UnknownElement(child.kind, action.kind, tuple(tag.children)), child.kind_span)


def _is_elsewhere(kind: str, parent: str | None, name: str) -> bool:
    """An `<arg>` has a value in an include only, and nothing but that there."""
    if kind != "arg":
        return False
    return (name not in ("name", "value")) if parent == "include" else name == "value"


def _check_param(action: Action, given: set[str]) -> Iterator[LanguageProblem]:
    """`Node.parse_nested_parameters`."""
    if action.kind != "param":
        return
    nested = any(child.kind == "param" for child in action.children)
    if "from" in given and "name" in given:
        yield LanguageProblem(ConflictingAttributes("param", ("name", "from")), action.kind_span)
    elif "from" not in given and "name" not in given:
        yield LanguageProblem(MissingAttribute("param", ("name", "from")), action.kind_span)
    elif "name" in given and "value" not in given and not nested:
        yield LanguageProblem(MissingAttribute("param", ("value",)), action.kind_span)
