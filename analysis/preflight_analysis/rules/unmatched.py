"""Findings of endpoints that nobody is at the other end of, for topics, services and actions alike."""

from __future__ import annotations

from collections.abc import Iterable

from preflight_analysis.findings.finding import Confidence, Finding, Fix, Related, Severity
from preflight_analysis.graph.model import Connection
from preflight_analysis.rules.near_miss import NearMiss
from preflight_analysis.rules.places import Verbs, connection_location, endpoints_of, related_endpoint
from preflight_analysis.rules.problems import include_chain
from preflight_analysis.rules.rule import Rule


def near_miss_finding(
    rule: Rule, near: NearMiss, message: str, verbs: Verbs, fixes: Iterable[Fix], weight: tuple[Severity, Confidence]
) -> Finding:
    """The finding for two endpoints that were probably meant to meet."""
    severity, confidence = weight
    return rule.finding(
        message,
        connection_location(near.site),
        severity=severity,
        confidence=confidence,
        related=(
            related_endpoint(near.other, verbs.provides if near.other is near.provider else verbs.consumes),
            *include_chain(near.site.node.origin),
        ),
        fixes=fixes,
        endpoints=endpoints_of(near.consumer, near.provider),
    )


def lone_finding(
    rule: Rule,
    connection: Connection,
    message: str,
    *,
    whole: bool,
    severity: Severity = "hint",
    related: Iterable[Related] = (),
) -> Finding:
    """The finding for an endpoint that has nobody. `whole`: the graph is complete."""
    return rule.finding(
        message,
        connection_location(connection),
        severity=severity,
        confidence="likely" if whole and not connection.endpoint.uncertain else "possible",
        related=(*related, *include_chain(connection.node.origin)),
        endpoints=endpoints_of(connection),
    )


def with_type(connection: Connection) -> str:
    """The name in quotes, with the type if it is known."""
    kind = f" ({connection.endpoint.type})" if connection.endpoint.type not in (None, "*") else ""
    return f"'{connection.name}'{kind}"
