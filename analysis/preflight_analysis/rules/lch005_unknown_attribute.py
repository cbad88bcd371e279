"""LCH005: an attribute that roslaunch does not know."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.claim import Kind, Subject
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.launch.problems import UnknownAttribute
from preflight_analysis.model.context import Context
from preflight_analysis.model.misspelt_attributes import explained
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import problems_of, rename
from preflight_analysis.model.syntax import Tags
from preflight_analysis.rules.further_reading import LAUNCH_XML_DESIGN, ROSLAUNCH
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    tags = Tags(context.launch_files)
    elsewhere = explained(context)
    for problem in problems_of(context, UnknownAttribute):
        if problem.location in elsewhere:
            continue
        name = problem.kind.name
        near = nearest(name, problem.kind.allowed)
        fixes: tuple[Fix, ...] = ()
        if near is not None:
            tag = tags.around(problem.location)
            if tag is None or tag.action.attribute(near) is None:  # a second one of the name would be malformed
                fixes = rename(context, problem.location, name, near)
        message = f"unknown attribute '{name}' of <{problem.kind.tag}>{did_you_mean(near)}"
        kind: Kind = "invalid" if near is None else "near"
        about = Subject("attribute", name)
        yield problem_claim(rule, problem, message, subject=about, kind=kind, candidates=(near,), fixes=fixes)


RULE = Rule(
    id="LCH005",
    name="unknown-attribute",
    effect="no-effect",
    kind="near",
    sometimes=("stops-launch",),
    what="Checks for an attribute that the element does not have. The finding names the nearest valid attribute.",
    why="`roslaunch` prints a warning and ignores the attribute. `ros2 launch` stops and starts nothing from the file.",
    example='<node pkg="camera" type="driver" name="camera" respwan="true"/>',
    instead='<node pkg="camera" type="driver" name="camera" respawn="true"/>',
    references=(
        ROSLAUNCH,
        LAUNCH_XML_DESIGN,
    ),
    check=_check,
    problems=(UnknownAttribute,),
    in_branches=True,
)
