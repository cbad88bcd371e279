"""How loud a claim is: the one place that says how severe a finding is, and how sure.

What the mistake does to the robot gives the usual severity. Each doubt limits it, and how sure the finding is; the
strongest limit counts. docs/severity.md is written from these tables.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import NamedTuple

from preflight_analysis.findings.claim import Effect
from preflight_analysis.findings.doubt import Doubt, Reason
from preflight_analysis.findings.finding import CONFIDENCES, SEVERITIES, Confidence, Finding, Severity

USUAL: Mapping[Effect, Severity] = {
    "stops-launch": "error",
    "stops-node": "error",
    "breaks": "error",
    "misbehaves": "warning",
    "no-effect": "warning",
    "note": "info",
    "style": "hint",
}
"""How severe a claim without doubts is."""
EFFECTS: Mapping[Effect, str] = {
    "stops-launch": "the launcher stops, or does not load the file",
    "stops-node": "a node does not start, or ends",
    "breaks": "a connection, controller, plugin or description never comes about",
    "misbehaves": "the robot does something else than is written, and nothing says so",
    "no-effect": "what is written is ignored",
    "note": "nothing is wrong by it alone",
    "style": "it works",
}
"""What the effects are, in words for users."""


class Limit(NamedTuple):
    """The most that a claim with a doubt can be. `less`: one step less severe than without it."""

    severity: Severity = "error"
    confidence: Confidence = "certain"
    less: bool = False


LIMITS: Mapping[Reason, Limit] = {
    Reason.NOT_HERE: Limit("hint"),
    Reason.OTHER_LAUNCH: Limit("hint", "possible"),
    Reason.OUTSIDE: Limit("info", "possible"),
    Reason.ON_ROBOT: Limit("info"),
    Reason.MADE_BY_BUILD: Limit("hint", "likely"),
    Reason.MADE_ELSEWHERE: Limit("info"),
    Reason.NOT_SET: Limit("info"),
    Reason.WHERE_STARTED: Limit("info"),
    Reason.OTHER_ARGUMENTS: Limit(confidence="possible", less=True),
    Reason.NOT_GIVEN: Limit("warning", "likely"),
    Reason.CATALOGUE: Limit(confidence="likely"),
    Reason.OTHER_DISTRIBUTION: Limit("hint", "possible"),
    Reason.OTHER_VERSION: Limit("info", "possible"),
    Reason.MEANT_FOR_OTHER: Limit("info", "possible"),
    Reason.LIBRARY: Limit("warning", "likely"),
    Reason.NOT_ANALYSED: Limit(confidence="possible"),
    Reason.FROM_SOURCE: Limit(confidence="likely"),
    Reason.LATER: Limit(confidence="likely"),
    Reason.ASSUMED: Limit("info", "possible"),
    Reason.DEPENDS: Limit(confidence="possible"),
    Reason.COMPUTED: Limit("info", "possible"),
    Reason.PARTLY_READ: Limit("info", "possible"),
    Reason.BRANCHES: Limit(confidence="likely"),
    Reason.SANDBOX: Limit("info", "possible"),
    Reason.LIKE_NAMES: Limit("hint", "possible"),
    Reason.IN_USE: Limit("info"),
    Reason.SHARED: Limit("info"),
    Reason.INTENDED: Limit("info"),
    Reason.SIBLINGS: Limit("info", "possible"),
    Reason.NO_DIFFERENCE: Limit("hint"),
    Reason.EXPLAINED: Limit("info"),
    Reason.SET_ASIDE: Limit("info"),
    Reason.UNSEEN: Limit("warning", "likely"),
}
"""What each doubt makes of a claim."""
OF_ANY_RULE = frozenset(
    Reason[each] for each in ["BRANCHES", "SET_ASIDE", "OTHER_ARGUMENTS", "PARTLY_READ", "CATALOGUE", "OTHER_VERSION"]
)
"""Doubts that come of where a finding is, whatever its rule: no rule says that it has them."""


def judge(effect: Effect, doubts: Iterable[Doubt] = ()) -> tuple[Severity, Confidence]:
    """How severe and how sure a claim is."""
    return _limited(USUAL[effect], "certain", doubts)


def doubted(finding: Finding, *doubts: Doubt) -> Finding:
    """A finding with more doubts."""
    severity, confidence = _limited(finding.severity, finding.confidence, doubts)
    return replace(finding, doubts=(*finding.doubts, *doubts), severity=severity, confidence=confidence)


def _limited(severity: Severity, confidence: Confidence, doubts: Iterable[Doubt]) -> tuple[Severity, Confidence]:
    limits = [LIMITS[doubt.reason] for doubt in doubts]
    rank = min(map(SEVERITIES.index, (severity, *(each.severity for each in limits))))
    rank = max(0, rank - any(each.less for each in limits))
    sure = min(map(CONFIDENCES.index, (confidence, *(each.confidence for each in limits))))
    return SEVERITIES[rank], CONFIDENCES[sure]


def limit_in_words(reason: Reason) -> str:
    """What a doubt makes of a finding: `info, possible`."""
    limit = LIMITS[reason]
    said: list[str] = [] if limit.severity == "error" else [limit.severity]
    said += ["one step less severe"] if limit.less else []
    said += [] if limit.confidence == "certain" else [limit.confidence]
    return ", ".join(said)


def cell(finding: Finding) -> str:
    """Which row of the tables decides how severe it is: the name of a doubt, or else its effect."""
    for doubt in finding.doubts:
        if _limited(USUAL[finding.effect], "certain", (doubt,))[0] == finding.severity != USUAL[finding.effect]:
            return doubt.reason.name
    return finding.effect
