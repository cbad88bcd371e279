"""LCH006: an element lacks an attribute that it needs."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.launch.problems import MissingAttribute
from preflight_analysis.model.context import Context
from preflight_analysis.model.misspelt_attributes import misspelt
from preflight_analysis.model.problems import problems_of, rename
from preflight_analysis.model.syntax import Tags
from preflight_analysis.rules.further_reading import LAUNCH_XML_DESIGN, ROSLAUNCH
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    tags = Tags(context.launch_files)
    for problem in problems_of(context, MissingAttribute):
        tag = tags.named_at(problem.location)
        needed = problem.kind.names
        message = _message(problem.kind)
        fixes: tuple[Fix, ...] = ()
        candidates: tuple[str, ...] = ()
        if tag is not None:
            mistaken = misspelt(context, tag, problem.location.file, needed)
            if mistaken is not None:
                candidates = (mistaken.meant,)
                message += f"; did you mean it by '{mistaken.name}'?"
                fixes = rename(context, mistaken.location, mistaken.name, mistaken.meant)
        yield problem_claim(
            rule,
            problem,
            message,
            subject=Subject("attribute", needed[0]),
            kind="near" if candidates else "absent",
            candidates=candidates,
            fixes=fixes,
        )


def _message(missing: MissingAttribute) -> str:
    needed = [f"'{name}'" for name in missing.names]
    if len(needed) == 1:
        return f"required attribute {needed[0]} of <{missing.tag}> is missing"
    return f"required attribute of <{missing.tag}> is missing: one of {', '.join(needed)}"


RULE = Rule(
    id="LCH006",
    name="missing-attribute",
    effect="stops-launch",
    kind="absent",
    what="Checks for an element without a required attribute.",
    why="The launcher stops and starts nothing.",
    example='<node pkg="camera" name="camera"/>',
    instead='<node pkg="camera" type="driver" name="camera"/>',
    references=(
        ROSLAUNCH,
        LAUNCH_XML_DESIGN,
    ),
    check=_check,
    problems=(MissingAttribute,),
    in_branches=True,
)
