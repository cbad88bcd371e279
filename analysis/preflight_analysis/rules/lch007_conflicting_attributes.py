"""LCH007: attributes that exclude each other."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.evaluation.problems import Problem
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.launch.problems import ConflictingAttributes
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import all_of, fix, problems_of, quoted
from preflight_analysis.model.syntax import Tags
from preflight_analysis.rules.further_reading import ROSLAUNCH, ROSLAUNCH_PARAM
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    tags = Tags(context.launch_files)
    for problem in problems_of(context, ConflictingAttributes):
        message = f"conflicting attributes {quoted(problem.kind.names)} of <{problem.kind.tag}>: only one is allowed"
        about = Subject("attribute", problem.kind.names[0])
        yield problem_claim(rule, problem, message, subject=about, fixes=_fixes(context, tags, problem))


def _fixes(context: Context, tags: Tags, problem: Problem[ConflictingAttributes]) -> Iterator[Fix]:
    """One for each of the attributes, which removes the others."""
    tag, writer = tags.named_at(problem.location), context.writer(problem.location.file)
    if tag is None or writer is None:
        return
    attributes = {name: tag.action.attribute(name) for name in problem.kind.names}
    for name in attributes:
        others = [attribute for other, attribute in attributes.items() if other != name and attribute is not None]
        edits = all_of(*(writer.remove_attribute(attribute) for attribute in others))
        yield from fix(f"Keep only '{name}'", edits)


RULE = Rule(
    id="LCH007",
    name="conflicting-attributes",
    effect="stops-launch",
    kind="conflict",
    what="Checks for attributes of one element that exclude each other.",
    why="`roslaunch` does not choose between them. It stops.",
    example='<param name="rate" value="30" textfile="rate.txt"/>',
    instead='<param name="rate" value="30"/>',
    references=(
        ROSLAUNCH,
        ROSLAUNCH_PARAM,
    ),
    check=_check,
    problems=(ConflictingAttributes,),
    in_branches=True,
)
