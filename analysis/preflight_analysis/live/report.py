"""What is not as expected, as text for people and as JSON for programs (schema `ros-preflight/watch/1`)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from preflight_analysis.documents.span import Place
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import relative
from preflight_analysis.live.model import Comparison, Issue
from preflight_analysis.live.watcher import Attached, Event, State, Waiting
from preflight_analysis.tracing.interface import DOES

SCHEMA = "ros-preflight/watch/1"

_DOES_NOT = {
    "publisher": "does not publish",
    "subscriber": "does not subscribe to",
    "service": "does not offer the service",
    "client": "does not call the service",
    "action_server": "does not offer the action",
    "action_client": "does not use the action",
}


def message(issue: Issue) -> str:
    """One sentence, without the place."""
    node, name = issue.node, issue.name
    if issue.what == "node":
        sandbox = f"; in the sandbox {issue.actual}" if issue.actual else ""
        return {
            "missing": f"{node} is not running{sandbox if issue.counts else ', which may be intended'}",
            "extra": f"{node} is running but is not in the launch file",
            "dead": f"{node} is registered and does not answer: {issue.actual}",
            "twice": f"{node} runs {issue.actual} times",
        }[issue.kind]
    kind = f" ({known})" if (known := issue.expected or issue.actual) else ""
    if issue.kind == "missing":
        why = f"the lifecycle node is {issue.inactive}" if issue.inactive else "it may not do so in every run"
        unsure = "" if issue.counts else f"; {why}"
        instead = f"; it {DOES[issue.what]} {issue.similar}" if issue.similar else unsure
        return f"{node} {_DOES_NOT[issue.what]} {name}{kind}{instead}"
    if issue.kind == "extra":
        return f"{node} {DOES[issue.what]} {name}{kind}, which is unexpected"
    what = "with the type " if issue.kind == "wrong-type" else "with "
    return f"{node} {DOES[issue.what]} {name} {what}{issue.actual}; expected {issue.expected}"


def line(issue: Issue, base: str | None) -> str:
    """The line of a terminal: place, kind and sentence. Files below the folder `base` are shown relative to it."""
    place = f"{relative(issue.place.file, base)}:{issue.place.line}: " if issue.place is not None else ""
    made = f" (made at {relative(issue.source.file, base)}:{issue.source.line})" if issue.source is not None else ""
    kind = issue.kind if issue.counts else f"{issue.kind} (info)"
    return printable(f"{place}{kind}: {message(issue)}{made}")


def summary(found: Comparison) -> str:
    """How much is not as expected."""
    count = sum(issue.counts for issue in found.issues)
    running = sum(state == "present" for state in found.nodes.values())
    nodes = f"{running} node{'' if running == 1 else 's'} as expected"
    return f"{count} difference{'' if count == 1 else 's'}, {nodes}" if count else f"no differences, {nodes}"


def event_json(event: Event) -> dict[str, Any]:
    """The object of one line of the stream."""
    head = {"schema": SCHEMA}
    if isinstance(event, Waiting):
        return {**head, "event": "waiting", "reason": event.reason}
    if isinstance(event, Attached):
        return {**head, "event": "restarted" if event.again else "attached", "to": event.place}
    return {**head, "event": "state", **state_json(event)}


def state_json(event: State) -> dict[str, Any]:
    """A comparison as plain data: the issues, and the state of each node, topic, service and action by full name."""
    found = event.comparison
    return {
        "same": found.same,
        "issues": [_issue_json(issue) for issue in found.issues],
        "nodes": dict(found.nodes),
        "topics": dict(found.topics),
        "services": dict(found.services),
        "actions": dict(found.actions),
    }


def _issue_json(issue: Issue) -> dict[str, Any]:
    return {
        "kind": issue.kind,
        "what": issue.what,
        "node": issue.node,
        "name": issue.name,
        "expected": issue.expected,
        "actual": issue.actual,
        "similar": issue.similar,
        "counts": issue.counts,
        "message": message(issue),
        "place": _place_json(issue.place),
        "source": _place_json(issue.source),
    }


def _place_json(place: Place | None) -> Mapping[str, Any] | None:
    return None if place is None else {"file": place.file, "line": place.line, "column": place.column}
