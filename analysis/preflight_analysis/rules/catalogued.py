"""Findings that rest on the catalogue: a package may be another on the robot."""

from __future__ import annotations

import json
from collections.abc import Iterator

from preflight_analysis.catalogue.launches import catalogued_file
from preflight_analysis.catalogue.packages import distribution_of, interfaces_of
from preflight_analysis.catalogue.renamed import other_names
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject, SubjectKind
from preflight_analysis.findings.doubt import Doubt, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.robot.of_launch import robots_of
from preflight_analysis.rules.nearest import did_you_mean, is_slip, nearest
from preflight_analysis.rules.places import attribute_location
from preflight_analysis.rules.problems import include_chain, rename
from preflight_analysis.rules.rule import Context, Rule


def is_of_distribution(context: Context, distro: str) -> bool:
    """Whether what the catalogue has of a distribution is of the one that is used."""
    return context.environment.distro == distro


def catalogue_doubts(context: Context, distro: str) -> tuple[Doubt, ...]:
    """Those about what the catalogue has of a distribution."""
    same = is_of_distribution(context, distro)
    return doubts(CATALOGUE=same, OTHER_DISTRIBUTION=not same)


def doubts_of_file(context: Context, path: str) -> tuple[Doubt, ...]:
    """Those about what follows from what a file says: none where it is here."""
    file = catalogued_file(path)
    return catalogue_doubts(context, file.distro) if file is not None else ()


def by_catalogue(context: Context, path: str) -> str:
    """What a message adds about a file: where its content is known from, "" for one that is here."""
    file = catalogued_file(path)
    text = context.disk.text(path) if file is not None else None
    if file is None or text is None or isinstance(text, Unreadable):
        return ""
    repository, commit, *_ = json.loads(text.text)[0]
    return f" (from the catalogue of {file.distro}, {repository} at {commit[:7]})"


def robots_by_catalogue(context: Context) -> bool | None:
    """Whether robot descriptions have parts from the catalogue that are of the distribution in use; False where some
    are of another one, None where no description has any."""
    found = [robot.description.catalogued for robot in robots_of(context.tree)]
    distros = {each.distro for each in found if each is not None}
    return all(is_of_distribution(context, distro) for distro in distros) if distros else None


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
