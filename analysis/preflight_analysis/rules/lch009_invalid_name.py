"""LCH009: a name that ROS does not allow."""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.problems import InvalidName, Problem
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Action, LaunchFile, Value
from preflight_analysis.model.arguments import empty_arguments
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import all_of, as_written, fix, problems_of, quoted, replacement
from preflight_analysis.model.syntax import Tags
from preflight_analysis.rules.further_reading import NAMES, TOPIC_NAMES
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule

_ILLEGAL = re.compile(r"[^A-Za-z0-9_/]+")


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    tags = Tags(context.launch_files)
    # One is enough of a place that is read with several values.
    first = {problem.location: problem for problem in reversed(list(problems_of(context, InvalidName)))}
    for problem in first.values():
        invalid = problem.kind
        message = f"invalid {invalid.what} name '{as_written(invalid.name)}': {invalid.reason}"
        empty = empty_arguments(context, problem.location)
        if empty:
            message += f"; set argument {quoted(empty)}"
        yield problem_claim(
            rule,
            problem,
            message,
            subject=Subject("name", as_written(invalid.name)),
            effect="stops-launch" if problem.fatal else "misbehaves",
            doubts=doubts(NOT_SET=empty and f"argument {quoted(empty)}"),
            fixes=_fixes(context, tags, problem),
        )
    # In ROS 1 roslaunch stops at such an argument.
    for path, launch_file in context.launch_files.items() if context.tree.ros.shared_configurations else ():
        for value in _with_blanks(launch_file):
            place, name = context.location(path, value.span), value.text.strip()
            yield rule.claim(
                f"blanks around the argument name '{name}': launch takes them as a part of it, so '{name}' is not set",
                place,
                subject=Subject("argument", name),
                effect="misbehaves",
                fixes=replacement(context, place, name, f"Replace '{value.text}' with '{name}'"),
            )


@derived
def _with_blanks(launch_file: LaunchFile) -> tuple[Value, ...]:
    return tuple(launch_file.root.gather(_named_with_blanks)) if launch_file.root is not None else ()


def _named_with_blanks(action: Action) -> tuple[Value, ...]:
    name = action.value("name") if action.kind in ("arg", "let") else None
    blanks = name is not None and name.is_literal and name.text.strip() not in ("", name.text)
    return (name,) if name is not None and blanks else ()


def _fixes(context: Context, tags: Tags, problem: Problem[InvalidName]) -> Iterator[Fix]:
    """The name without what is not allowed in it, if it is written as it is; a namespace in it becomes `ns`."""
    location = problem.location
    writer, written = context.writer(location.file), context.text(location)
    if writer is None or names.canonicalize(written) != problem.kind.name:
        return
    legal = _legal(written)
    if problem.kind.what == "node" and legal in {names.leaf(node.name) for node in context.tree.nodes}:
        return  # the other node has it
    if problem.kind.what == "node" and "/" in legal:
        ns, _, name = legal.rstrip("/").rpartition("/")
        tag = tags.around(location)
        if tag is None or _has_namespace(tag.action) or not ns or not names.is_legal(name):
            return
        attribute = "namespace" if context.tree.ros.shared_configurations else "ns"
        edits = all_of(writer.replace(location.span, name), writer.set_attribute(tag.action, attribute, ns))
        yield from fix(f'Use {attribute}="{ns}" and name="{name}"', edits, preferred=True)
    elif legal and legal != written and names.is_legal(legal):
        yield from replacement(context, location, legal, f"Replace '{written}' with '{legal}'")


def _has_namespace(action: Action) -> bool:
    return any(action.attribute(name) is not None for name in ("ns", "namespace"))


def _legal(written: str) -> str:
    mark = "~" if written.startswith("~") else ""
    plain = _ILLEGAL.sub("_", written[len(mark) :].strip()).replace("//", "/")
    return mark + (plain.lstrip("0123456789_") if not mark else plain)


RULE = Rule(
    id="LCH009",
    name="invalid-name",
    effect="stops-launch",
    kind="invalid",
    sometimes=("misbehaves", Reason.NOT_SET),
    what="Checks for the name of a node, argument, remap or parameter that ROS does not allow. In ROS 2 it checks "
    "for blanks around an argument's name.",
    why="`roslaunch` stops. For other characters in a node's name it only warns, but other tools fail. Names start "
    "with a letter, or with `/` or `~` for a graph resource. They continue with letters, digits, `_` and `/`. The "
    "name of a node has no `/`: its namespace is the attribute `ns`.",
    example='<node pkg="camera" type="driver" name="front/camera"/>',
    instead='<node pkg="camera" type="driver" name="camera" ns="front"/>',
    references=(
        NAMES,
        TOPIC_NAMES,
    ),
    check=_check,
    problems=(InvalidName,),
    in_branches=True,
)
