"""LCH019: a suppression comment that silences nothing."""

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.findings.suppression import Suppression, read_suppressions
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import rename
from preflight_analysis.rules import registry
from preflight_analysis.rules.further_reading import ANNOTATIONS
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    """Comments that cannot silence anything; those that merely did not are reported after all rules have run."""
    known = {r.id for r in registry.all_rules()}
    for suppressions, malformed in context.each(read_suppressions, context.documents.values()):
        for each in malformed:
            message = "'preflight: ignore' names no rule; write ignore[TOP001]"
            yield rule.claim(message, each.location, subject=Subject("suppression"), kind="invalid")
        for each_rule in suppressions:
            if each_rule.rule not in known:
                near = nearest(each_rule.rule.upper(), known)
                fixes: tuple[Fix, ...] = rename(context, each_rule.location, each_rule.rule, near) if near else ()
                yield rule.claim(
                    f"unknown rule '{each_rule.rule}'{did_you_mean(near)}",
                    each_rule.location,
                    subject=Subject("suppression", each_rule.rule),
                    kind="near" if near else "absent",
                    candidates=(near,),
                    fixes=fixes,
                )


def _unused(rule: Rule, suppression: Suppression) -> Finding:
    fix = Fix(f"Remove the suppression of {suppression.rule}", (suppression.removal,), True)
    return rule.claim(
        f"unused suppression of '{suppression.rule}': it has no finding here",
        suppression.location,
        subject=Subject("suppression", suppression.rule),
        fixes=(fix,),
    )


RULE = Rule(
    id="LCH019",
    name="unused-suppression",
    effect="no-effect",
    kind="unused",
    what="Checks for a `preflight: ignore[...]` comment that suppresses no finding or names no rule. It is checked "
    "only if the named rule could run.",
    why="A comment that is left over suppresses the next finding on that line, which may be real.",
    example='<!-- preflight: ignore[LCH004] -->\n<param name="rate" value="30"/>',
    instead='<param name="rate" value="30"/>',
    references=(ANNOTATIONS,),
    check=_check,
    every_root=True,
    unused_suppression=_unused,
)
