"""Claims about names that other launch files write."""

from __future__ import annotations

from preflight_analysis.findings.claim import Text
from preflight_analysis.findings.doubt import doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Connection
from preflight_analysis.model.context import Context
from preflight_analysis.model.places import connection_location, endpoints_of, subject_of
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.model.remaps_elsewhere import Elsewhere
from preflight_analysis.rules.rule import Rule


def elsewhere_finding(rule: Rule, context: Context, connection: Connection, said: Text, found: Elsewhere) -> Finding:
    """The finding for an end whose other one is most likely started by another launch, under another name."""
    location = connection_location(connection)
    by_launches = found.beside is None and not found.in_source
    if found.beside is not None:
        other = found.beside != found.name
        evidence = f"as in '{found.beside}' of the same node" if other else "which the same node publishes"
    elif found.in_source:
        files = f"{found.files} source files use" if found.files > 1 else "a source file uses"
        evidence = f"which {files} with this type"
    else:
        evidence = f"as in {found.files} launch files nearby"
    return rule.claim(
        said.followed_by("; did you mean '{near}', {evidence}?", near=found.name, evidence=evidence),
        location,
        subject=subject_of(connection),
        kind="near",
        effect="breaks",
        doubts=doubts(OUTSIDE=by_launches, FROM_SOURCE=found.in_source),
        candidates=(found.name,),
        related=include_chain(connection.node.origin),
        fixes=rename(context, location, context.text(location), found.name) if by_launches else (),
        endpoints=endpoints_of(connection),
    )
