"""Findings of endpoints that nobody is at the other end of, for topics, services and actions alike."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

from preflight_analysis.findings.claim import Text
from preflight_analysis.findings.doubt import Doubt, doubts
from preflight_analysis.findings.finding import Finding, Fix, Related
from preflight_analysis.graph.model import Connection
from preflight_analysis.model.channels import doubts_of_ends
from preflight_analysis.model.near_miss import NearMiss
from preflight_analysis.model.places import Verbs, connection_location, endpoints_of, related_endpoint, subject_of
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.rule import Rule


def near_miss_finding(
    rule: Rule, near: NearMiss, said: Text, verbs: Verbs, fixes: Iterable[Fix], why: Iterable[Doubt]
) -> Finding:
    """The finding for two endpoints that were probably meant to meet, at that of them whose name the launch sets. `why`
    they may not be."""
    subject = subject_of(near.site)
    ends = (near.consumer, near.provider)
    return rule.claim(
        said,
        connection_location(near.site),
        subject=subject,
        kind="near",
        doubts=why,
        candidates=(next((each.name for each in ends if each.name != subject.name), None),),
        related=(
            related_endpoint(near.other, verbs.provides if near.other is near.provider else verbs.consumes),
            *include_chain(near.site.node.origin),
        ),
        fixes=fixes,
        endpoints=endpoints_of(*ends),
    )


def lone_finding(
    rule: Rule,
    connection: Connection,
    said: Text,
    *,
    lacks: str | bool,
    meant: Connection | None = None,
    related: Iterable[Related] = (),
) -> Finding:
    """The finding for an endpoint that has nobody, or was `meant` for another one. `lacks` as of `not_all_known`."""
    assumed: Literal["ASSUMED", "DEPENDS"] = "ASSUMED" if meant is None else "DEPENDS"
    return rule.claim(
        said,
        connection_location(connection),
        subject=subject_of(connection),
        kind="absent" if meant is None else "near",
        doubts=(*doubts(OTHER_LAUNCH=meant is None), *doubts_of_ends(connection, assumed=assumed, lacks=lacks)),
        candidates=(meant.name,) if meant is not None else (),
        related=(*related, *include_chain(connection.node.origin)),
        endpoints=endpoints_of(connection),
    )


def with_type(connection: Connection) -> str:
    """The name in quotes, with the type if it is known."""
    kind = f" ({connection.endpoint.type})" if connection.endpoint.type not in (None, "*") else ""
    return f"'{connection.name}'{kind}"
