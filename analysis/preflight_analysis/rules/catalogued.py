"""Claims that rest on the catalogue."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.catalogue.packages import distribution_of, interfaces_of
from preflight_analysis.catalogue.renamed import other_names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject, SubjectKind
from preflight_analysis.findings.doubt import doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.catalogued import catalogue_doubts, is_of_distribution
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, is_slip, nearest
from preflight_analysis.model.places import attribute_location
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.rules.rule import Rule


def slips(rule: Rule, context: Context, node: LaunchNode, kind: str, attribute: str) -> Iterator[Finding]:
    """What is said of a node whose package is not here, and has none of that name but one of which it is a slip. `kind`
    is `executables` or `components`; `attribute` names it. Without a near one it may be of another version."""
    name = node.plugin if kind == "components" else node.executable
    distro = distribution_of(context.tree.generation, context.environment.distro)
    known = interfaces_of(node.package, distro).get(kind, {})
    if not name or name in known or any(other_names(node.package, kind, name, distro)):
        return
    near = nearest(name, known)
    if near is None or not is_slip(name, near):
        return
    location = attribute_location(context, node, attribute)
    what: SubjectKind = "component" if kind == "components" else "executable"
    yield rule.claim(
        f"package '{node.package}' of {distro} has no {what} '{name}'{did_you_mean(near)}",
        location,
        subject=Subject(what, name),
        kind="near",
        doubts=(*catalogue_doubts(context, distro), *doubts(UNSEEN=True)),
        candidates=(near,),
        related=include_chain(node.origin),
        fixes=rename(context, location, name, near, preferred=is_of_distribution(context, distro)),
    )
