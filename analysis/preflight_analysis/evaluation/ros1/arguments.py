"""The arguments of a launch file: those that it is given, and those that it declares or asks for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation.problems import FixedArgument, IncludeArgumentWithoutValue, RedeclaredArgument
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.ros1.attributes import Attributes, applies
from preflight_analysis.evaluation.ros1.scope import Scope
from preflight_analysis.evaluation.ros1.scope_arguments import ArgValue
from preflight_analysis.evaluation.ros1.state import State
from preflight_analysis.evaluation.ros1.tags import evaluate_env
from preflight_analysis.evaluation.tree import Arg, Use
from preflight_analysis.launch.model import Action, LaunchFile
from preflight_analysis.launch.problems import ConflictingAttributes


class _ArgTag(NamedTuple):
    """An `<arg>`, in a file or in an include. `span` is that of its name."""

    name: str
    span: Span
    value: Resolved | None
    default: Resolved | None


def _read_arg(state: State, scope: Scope, action: Action) -> _ArgTag | None:
    """None where it has no name."""
    attributes = Attributes(state, scope, action)
    found = attributes.require("name")
    if found is None:
        return None
    value, default = attributes.get("value"), attributes.get("default")
    attributes.get("doc")
    written = action.attribute("name")
    return _ArgTag(found[0].text, written.value.span if written else action.kind_span, value, default)


def evaluate_arg(state: State, scope: Scope, action: Action) -> None:
    """The declaration of an argument in a launch file (http://wiki.ros.org/roslaunch/XML/arg)."""
    if not applies(state, scope, action):
        return
    tag = _read_arg(state, scope, action)
    if tag is None:
        return
    name, span, value, default = tag
    location = scope.location(span)
    if value is not None and default is not None:
        state.problem(ConflictingAttributes("arg", ("value", "default")), scope.origin(action.kind_span))
        default = None
    arguments = scope.arguments
    if (first := arguments.declaration(name)) is not None and not scope.pass_all_args:
        state.problem(RedeclaredArgument(name, first, passed=False), scope.origin(span))
        return
    arguments.declare(name, location)
    given = arguments.get(name)
    if value is not None:
        if given is not None and not scope.pass_all_args:
            state.problem(FixedArgument(name), scope.chain or scope.origin(span))
        else:
            arguments.set(name, ArgValue(value.text if value.known else None, scope.origin(span)))
    elif default is not None and given is None:
        arguments.set(name, ArgValue(default.text if default.known else None, scope.origin(span)))
    now = arguments.get(name)
    state.uses.append(
        Use("declaration", location, name, now.text if now else None, None, (now.origin if now else None) or ())
    )


def passed_args(
    state: State, scope: Scope, inside: Scope, action: Action, pass_all: bool
) -> tuple[dict[str, ArgValue], dict[str, Location]]:
    """The arguments given to an included file, and where those are written that have a value in the `<include>`.

    They are evaluated in the includer's file and do not see each other.
    """
    passed: dict[str, ArgValue] = {}
    seen: dict[str, Location] = {}
    if pass_all:
        passed = dict(scope.arguments.given)
    without: list[tuple[str, Span]] = []
    for child in action.children:
        kind = child.kind.lower()
        if kind == "env":
            evaluate_env(state, inside, child)
            continue
        if kind != "arg" or not applies(state, inside, child):
            continue
        tag = _read_arg(state, inside, child)
        if tag is None:
            continue
        name, span, value, default = tag
        if value is not None and default is not None:
            state.problem(ConflictingAttributes("arg", ("value", "default")), scope.origin(child.kind_span))
            continue
        if name in seen and not pass_all:
            state.problem(RedeclaredArgument(name, seen[name], passed=True), scope.origin(span))
            continue
        seen.setdefault(name, scope.location(span))
        given = value if value is not None else default
        if given is None:
            if name not in passed:
                without.append((name, span))
                passed[name] = ArgValue(None, scope.origin(span))
        elif value is not None or name not in passed:
            passed[name] = ArgValue(given.text if given.known else None, scope.origin(span))
        now = passed.get(name)
        state.uses.append(Use("argument", scope.location(span), name, now.text if now else None))
    # roslaunch looks at all of them first.
    for name, span in without:
        state.problem(IncludeArgumentWithoutValue(name), scope.origin(span))
        del seen[name]
    return passed, seen


def are_those_of(scope: Scope, path: str, passed: Mapping[str, ArgValue]) -> bool:
    """Whether the file is being evaluated already with these very arguments: then it would never end."""
    at: Scope | None = scope
    wanted = {name: value.text for name, value in passed.items()}
    while at is not None:
        if at.file == path and all((v := at.arguments.get(n)) is not None and v.text == t for n, t in wanted.items()):
            return True
        at = at.parent
    return False


def declared_args(scope: Scope, launch_file: LaunchFile) -> dict[str, Arg]:
    """The arguments that the file of a scope declares, with what they are there."""
    found: dict[str, Arg] = {}
    tags = [a for a in (launch_file.root.children if launch_file.root else ()) if a.kind == "arg"]
    for name, location in scope.arguments.declared.items():
        tag = next((t for t in tags if (n := t.attribute("name")) and n.value.span == location.span), None)
        default = tag.value("default") if tag else None
        fixed = tag.value("value") if tag else None
        doc = tag.value("doc") if tag else None
        given = scope.arguments.get(name)
        found[name] = Arg(
            name,
            given.text if given else None,
            default.text if default else None,
            default is None and fixed is None,
            (location,),
            location,
            given.origin if given else None,
            doc.text if doc else None,
        )
    return found


def names_asked_for(launch_file: LaunchFile) -> set[str] | None:
    """The names of all `<arg>`s of a file, taken or not; None if an include may hand on what it does not declare, or a
    name is made up, or half typed."""
    if launch_file.document.problems:
        return None
    asked_for = launch_file.root.gather(_asked_by) if launch_file.root is not None else []
    return None if None in asked_for else {*filter(None, asked_for)}


def _asked_by(action: Action) -> Iterator[str | None]:
    """The name of an `<arg>`; None where it is made up, and for an include that hands on what it does not declare."""
    if action.kind == "include" and action.attribute("pass_all_args") is not None:
        yield None
    elif action.kind == "arg" and (value := action.value("name")) is not None:
        yield value.text if value.is_literal else None
