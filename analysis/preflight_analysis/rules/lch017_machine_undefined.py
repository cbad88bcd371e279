"""LCH017: a node on a machine that is not declared."""

from collections.abc import Iterator

from preflight_analysis.evaluation.problems import UndefinedMachine
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import problems_of, rename
from preflight_analysis.rules.further_reading import ROSLAUNCH_MACHINE
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, UndefinedMachine):
        name = problem.kind.name
        near = nearest(name, problem.kind.declared)
        fixes = rename(context, problem.location, name, near) if near else ()
        yield problem_claim(
            rule,
            problem,
            f"machine '{name}' is not declared{did_you_mean(near)}",
            subject=Subject("machine", name),
            kind="near" if near else "absent",
            candidates=(near,),
            fixes=fixes,
        )


RULE = Rule(
    id="LCH017",
    name="machine-undefined",
    effect="stops-launch",
    kind="near",
    what="Checks for a `machine` attribute that names no earlier `<machine>`. The finding names the nearest declared "
    "machine.",
    why="`roslaunch` stops and starts nothing.",
    example='<machine name="base" address="10.0.0.2"/>\n<node pkg="p" type="t" name="n" machine="bse"/>',
    instead='<machine name="base" address="10.0.0.2"/>\n<node pkg="p" type="t" name="n" machine="base"/>',
    references=(ROSLAUNCH_MACHINE,),
    check=_check,
    problems=(UndefinedMachine,),
    in_branches=True,
)
