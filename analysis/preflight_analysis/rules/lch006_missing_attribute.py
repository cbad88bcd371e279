"""LCH006: an element lacks an attribute that it needs."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.tree import Problem
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.findings.insertion import insert_attribute
from preflight_analysis.launch.schema_ros1 import TAGS
from preflight_analysis.launch.schema_ros2 import TAGS_ROS2
from preflight_analysis.rules.nearest import nearest
from preflight_analysis.rules.problems import problem_finding, problems_of, rename
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.rules.syntax import Tag, Tags


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    tags = Tags(context.launch_files)
    for problem in problems_of(rule, context):
        tag = tags.named_at(problem.location)
        needed = [str(name) for name in problem.data["names"]]
        message = _message(problem)
        fixes: tuple[Fix, ...] = ()
        if tag is not None:
            mistaken, fixes = _misspelt(context, problem, tag, needed)
            if mistaken is not None:
                message += f"; is '{mistaken}' meant to be it?"
            fixes = fixes or _insertion(context, problem, tag, needed[0])
        yield problem_finding(rule, problem, message, fixes=fixes)


def _message(problem: Problem) -> str:
    needed = [f"'{name}'" for name in problem.data["names"]]
    return f"<{problem.data['tag']}> needs {'one of ' if len(needed) > 1 else ''}{', '.join(needed)}"


def _misspelt(context: Context, problem: Problem, tag: Tag, needed: list[str]) -> tuple[str | None, tuple[Fix, ...]]:
    """An attribute of the tag that nobody knows and whose name is near to one that is missing, and its correction."""
    kind = tag.action.kind
    schema = TAGS_ROS2.get(kind) if context.tree.generation == 2 else TAGS.get(kind.lower())
    known = schema.attributes if schema is not None else {}
    unknown = {attribute.name: attribute for attribute in tag.action.attributes if attribute.name not in known}
    for name in needed:
        near = nearest(name, unknown)
        if near is not None:
            location = Location(problem.location.file, unknown[near].name_span)
            return near, rename(context, location, near, name)
    return None, ()


def _insertion(context: Context, problem: Problem, tag: Tag, name: str) -> tuple[Fix, ...]:
    document = context.documents.get(problem.location.file)
    if document is None or document.path.endswith((".yaml", ".yml", ".py")):
        return ()
    return (Fix(f"Add '{name}'", (insert_attribute(tag.action, document, name),), True),)


RULE = Rule(
    id="LCH006",
    name="missing-attribute",
    severity="error",
    what="Reports an element without an attribute that it cannot do without.",
    why="`roslaunch` stops and starts nothing.",
    example='<node pkg="camera" name="camera"/>',
    instead='<node pkg="camera" type="driver" name="camera"/>',
    check=_check,
    problems=("missing-attribute",),
)
