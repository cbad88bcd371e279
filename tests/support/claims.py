"""What a rule says of its claims, beside those that it makes."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.policy import OF_ANY_RULE, judge
from preflight_analysis.rules.registry import rule_by_id


def undeclared(finding: Finding) -> Iterator[str]:
    """What a finding has that its rule does not say of it: another effect, a doubt, a severity of its own."""
    rule = rule_by_id(finding.rule)
    if rule is None:
        return
    known = {rule.effect, *rule.always, *rule.sometimes, *OF_ANY_RULE}
    of = [finding.effect, *(doubt.reason for doubt in finding.doubts)]
    yield from (f"{finding.rule} does not say that it has {each}" for each in of if each not in known)
    if finding.severity != judge(finding.effect, finding.doubts)[0]:
        yield f"{finding.rule}: its severity is not the policy's"
