"""What a report says of a rule. How a rule checks is in `rules/`."""

from __future__ import annotations

from preflight_analysis.dataclass import dataclass
from preflight_analysis.findings.finding import Severity


@dataclass(frozen=True, slots=True)
class RuleDescription:
    """Identity and documentation of a rule: `id` such as `TOP001`, `name` such as `subscribed-not-published`. The
    texts are Markdown, `severity` is the usual one."""

    id: str
    name: str
    severity: Severity
    what: str
    why: str
    example: str
    instead: str
