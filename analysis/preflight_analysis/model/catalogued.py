"""Findings that rest on the catalogue: a package may be another on the robot."""

from __future__ import annotations

import json

from preflight_analysis.catalogue.launches import catalogued_file
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.findings.doubt import Doubt, doubts
from preflight_analysis.model.context import Context
from preflight_analysis.robot.of_launch import robots_of


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
