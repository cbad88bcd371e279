"""How sure findings are that rest on the catalogue: a package may be another on the robot."""

from __future__ import annotations

import json

from preflight_analysis.catalogue.launches import catalogued_file
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.findings.finding import Confidence, Severity
from preflight_analysis.rules.rule import Context


def is_of_distribution(context: Context, distro: str) -> bool:
    """Whether what the catalogue has of a distribution is of the one that is used."""
    return context.environment.distro == distro


def as_sure(context: Context, path: str, severity: Severity) -> tuple[Severity, Confidence]:
    """Severity and confidence of what is otherwise certain and follows from what the file says: what the catalogue
    says of another distribution is no more than a hint."""
    file = catalogued_file(path)
    if file is None:
        return severity, "certain"
    return (severity, "likely") if is_of_distribution(context, file.distro) else ("hint", "possible")


def by_catalogue(context: Context, path: str) -> str:
    """What a message adds about a file: where its content is known from, "" for one that is here."""
    file = catalogued_file(path)
    text = context.disk.text(path) if file is not None else None
    if file is None or text is None or isinstance(text, Unreadable):
        return ""
    repository, commit, *_ = json.loads(text.text)[0]
    return f" (from the catalogue of {file.distro}, {repository} at {commit[:7]})"
