"""Claims about files that are checked for themselves, whatever launch reaches them: those by which a package is built
and installed, and those of robot descriptions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.environment.build import Said
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.findings.finding import Finding
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.model.context import Context
from preflight_analysis.model.installation import packages_of
from preflight_analysis.rules.rule import Check, OfDescription, OfPackage, Rule


def check_packages(of_package: OfPackage) -> Check:
    """The check of a rule about packages: those that the launch files are in and those of the nodes."""

    def check(rule: Rule, context: Context) -> Iterator[Finding]:
        for package in packages_of(context):
            if package.generation in rule.generations:
                yield from said_of_package(context.disk.db, of_package, rule, context.environment, package)

    return check


@query
def said_of_package(
    db: Database, of_package: OfPackage, rule: Rule, environment: Environment, package: Package
) -> tuple[Finding, ...]:
    """What is said of one: it is made again where something that it was read from has changed."""
    return tuple(of_package(rule, Disk(db), environment, package))


def check_nothing(rule: Rule, context: Context) -> Iterable[Finding]:
    """The check of a rule that speaks of files alone."""
    return ()


@query
def said_of_description(
    db: Database, of_description: OfDescription, rule: Rule, environment: Environment, path: str
) -> tuple[Finding, ...]:
    """What is said of one: it is made again where something that it was read from has changed."""
    return tuple(of_description(rule, Disk(db), environment, path))


def line_of(document: Document, line: int, part: str = "") -> Location:
    """A part of a line, counted from 0; all of it where the part is not there."""
    whole = document.lines.line_span(line)
    text = document.text[whole.start : whole.end]
    at = text.find(part) if part else -1
    if at >= 0:
        return document.location(Span(whole.start + at, whole.start + at + len(part)))
    stripped = text.strip()
    start = whole.start + (text.index(stripped) if stripped else 0)
    return document.location(Span(start, start + len(stripped)))


def said_at(disk: Disk, said: Said, part: str = "") -> Location | None:
    """Where a command of `CMakeLists.txt` has a part; where it starts if that is not written so."""
    document = disk.text(said.file)
    if not isinstance(document, Document):
        return None
    opened = document.text.find("(", said.at)
    end = document.text.find(")", said.at) if opened >= 0 else -1
    at = document.text.find(part, opened, end) if part and end >= 0 else -1
    if at >= 0:
        return document.location(Span(at, at + len(part)))
    return document.location(Span(said.at, opened if opened >= 0 else said.at))
