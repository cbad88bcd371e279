"""SRV002: client and server of a service have different types."""

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.places import Verbs
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.rules.type_mismatch import mismatches


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    return mismatches(rule, context, "services", Verbs("offers", "calls"))


RULE = Rule(
    id="SRV002",
    name="service-type-mismatch",
    severity="error",
    what="Reports a service that one node offers with another type than a second one calls it with, or with another "
    "definition (MD5 sum) of the same type.",
    why="Every call fails.",
    example='<!-- /reset: std_srvs/Empty offered, std_srvs/Trigger called -->\n<remap from="restart" to="/reset"/>',
    instead='<remap from="restart" to="/restart"/>',
    check=_check,
    needs_graph=True,
    every_root=True,
)
