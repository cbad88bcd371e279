"""Claims about the files of robot descriptions and worlds, each for itself, whatever launch reads them."""

from __future__ import annotations

import os
from collections.abc import Iterable

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.edits.writer import replaced
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.doubt import Doubt, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.model.context import Context
from preflight_analysis.model.descriptions import tops_of
from preflight_analysis.model.problems import fix
from preflight_analysis.robot.xacro import Around, XacroFile, xacro_file
from preflight_analysis.rules.rule import OfDescription, Rule

LOOSE = doubts(NOT_GIVEN=True)
"""Of a rule that has something to say of launched descriptions, too: that no launch is known to read the file."""


def check_nothing(rule: Rule, context: Context) -> Iterable[Finding]:
    """The check of a rule that speaks of files alone."""
    return ()


@query
def said_of_description(
    db: Database, of_description: OfDescription, rule: Rule, environment: Environment, path: str
) -> tuple[Finding, ...]:
    """What is said of one: it is made again where something that it was read from has changed."""
    return tuple(of_description(rule, Disk(db), environment, path))


def rename(document: Document, span: Span, old: str, new: str | None) -> tuple[Fix, ...]:
    """A fix that writes `new` for `old`; none where nothing is meant."""
    return fix(f"Replace '{old}' with '{new}'", replaced(document, span, old, new), preferred=True) if new else ()


def is_part(db: Database, environment: Environment, path: str) -> bool:
    """Whether a file is made to be included, and nobody of the workspace does so or who does is made for it, too:
    others may define what it asks for."""
    files = (xacro_file(db, each) for each in tops_of(db, environment, path))
    return not any(file is not None and _is_robot(file) for file in files)


def _is_robot(file: XacroFile) -> bool:
    root = file.document.root
    return root is not None and root.get("name") is not None


def may_be_other(db: Database, environment: Environment, path: str, around: Around) -> bool:
    """Whether what is defined for a place in a file may not be all: it is in a macro that others may call."""
    return bool(around.macro) or is_part(db, environment, path)


def doubts_of(around: Around, *, other: bool) -> tuple[Doubt, ...]:
    """Those about something that stands there in a file."""
    return doubts(OTHER_ARGUMENTS=around.conditional and not around.macro, UNSEEN=other)


def below_package(environment: Environment, path: str) -> str:
    """A path as a message shows it: with the folder of its package."""
    package = package_around(environment, path)
    if package is None:
        return path
    return os.path.join(os.path.basename(package.share.rstrip("/")), os.path.relpath(path, package.share))
