"""SRV002: client and server of a service have different types."""

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.places import Verbs
from preflight_analysis.rules.further_reading import SERVICES, SERVICES_2
from preflight_analysis.rules.rule import Rule
from preflight_analysis.rules.type_mismatch import OF_MISMATCHES, mismatches


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    return mismatches(rule, context, "services", Verbs("serves", "calls"))


RULE = Rule(
    id="SRV002",
    name="service-type-mismatch",
    effect="breaks",
    kind="conflict",
    sometimes=OF_MISMATCHES,
    what="Checks for a service whose server and client have different types, or different definitions (MD5 sums) of "
    "one type.",
    why="Every call fails.",
    example='<!-- /reset: std_srvs/Empty offered, std_srvs/Trigger called -->\n<remap from="restart" to="/reset"/>',
    instead='<remap from="restart" to="/restart"/>',
    references=(
        SERVICES,
        SERVICES_2,
    ),
    settings=("nodes",),
    check=_check,
    needs_graph=True,
    every_root=True,
)
