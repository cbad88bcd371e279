"""What a report says of a rule. How a rule checks is in `rules/`."""

from __future__ import annotations

from dataclasses import field

from preflight_analysis.dataclass import dataclass
from preflight_analysis.findings.claim import Effect, Kind
from preflight_analysis.findings.doubt import Doubt, Reason
from preflight_analysis.findings.finding import Severity
from preflight_analysis.findings.policy import judge


@dataclass(frozen=True, slots=True)
class RuleDescription:
    """Identity and documentation of a rule: `id` such as `TOP001`, `name` such as `subscribed-not-published`. The
    texts are Markdown.

    `effect` and `kind` are those of most of its claims, `always` the doubts of each; `sometimes` are other effects and
    doubts that some have. `severity` is the usual one, by the policy.
    """

    id: str
    name: str
    what: str
    why: str
    example: str
    instead: str
    effect: Effect
    kind: Kind
    always: tuple[Reason, ...] = ()
    sometimes: tuple[Effect | Reason, ...] = ()
    severity: Severity = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "severity", judge(self.effect, map(Doubt, self.always))[0])
