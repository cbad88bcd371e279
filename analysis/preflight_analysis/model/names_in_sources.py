"""The topics and services that the sources of a workspace name as they make them, whatever launch starts the nodes."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.evaluation import names
from preflight_analysis.graph.model import Connection
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.launch.recognize import launch_files_of
from preflight_analysis.model.context import Context
from preflight_analysis.model.dangling import GENERIC_PACKAGES
from preflight_analysis.model.nearest import likeness

_SUFFIXES = (".py", ".cpp", ".cc", ".hpp", ".h")
_MOST = 400
"""Source files of one package that are read; of more nothing is said."""
_MOST_PACKAGES = 60
_ENOUGH = 2
"""Files that have to agree on a name where none offers it."""
_NAME = r"""["'](?P<name>[~/]?\w[\w/]*)["']"""
_CALLS = (
    re.compile(rf"\b(?P<call>Publisher|Subscriber|ServiceProxy|Service)\(\s*{_NAME}\s*,\s*(?P<type>[\w.]+)"),
    re.compile(rf"\bcreate_(?P<call>publisher|subscription|service|client)\(\s*(?P<type>[\w.]+)\s*,\s*{_NAME}"),
    re.compile(rf"\b(?P<call>advertise|subscribe|serviceClient)\s*<\s*(?P<type>[\w:]+)\s*>\s*\(\s*{_NAME}"),
    re.compile(rf"\bcreate_(?P<call>publisher|subscription|service|client)\s*<\s*(?P<type>[\w:]+)\s*>\(\s*{_NAME}"),
)
_OFFER = ("Publisher", "Service", "publisher", "service", "advertise")


class Named(NamedTuple):
    """A name in a source, without `~` and slashes at its ends, with the last part of its type."""

    name: str
    type: str
    offers: bool


def meant_in_sources(context: Context, connection: Connection) -> tuple[str, int] | None:
    """The name of which that of a consumer is a slip, by what the sources of the workspace make with that type, and how
    many of them do. None where one of them offers the consumer's own."""
    type_ = connection.endpoint.type
    if connection.remap is not None or type_ is None or type_ == "*" or type_.startswith(GENERIC_PACKAGES):
        return None
    own, kind = connection.endpoint.name.strip("~/"), type_.rpartition("/")[2]
    known = _in_workspace(context.disk.db, context.environment)
    # What a node takes in and what it gives out have like names on purpose.
    source = connection.endpoint.source_file
    beside = {each.name for each in _in_file(context.disk.db, source)} if source is not None else set()
    files: Counter[str] = Counter()
    for each, count in known.items():
        alike = likeness(f"/{own}", f"/{each.name}")
        if alike is None or alike[0] != "typo":
            if each.offers and names.leaf(each.name) == names.leaf(own):
                return None
            continue
        # Without an offer it is a word of several against one.
        enough = each.name not in beside and (
            each.offers or (count >= _ENOUGH and known.get(Named(own, kind, offers=False), 0) <= 1)
        )
        if each.type == kind and enough:
            files[each.name] += count
    return next(iter(files.items())) if len(files) == 1 else None


@query
def writes_name(db: Database, share: str, name: str) -> bool:
    """Whether a source of the package, beside its launch files, has the name in quotes, without regard to `~` and
    slashes at its ends."""
    files = files_in(Disk(db), share, deep=True)
    paths = [path for path in files if path.endswith(_SUFFIXES)]
    launches = set(launch_files_of(db, paths))
    pattern = re.compile(rf"""["'][~/]*{re.escape(name.strip("~/"))}/?["']""")
    texts = (Disk(db).text(path) for path in paths[:_MOST] if path not in launches)
    return any(isinstance(each, Document) and pattern.search(each.text) is not None for each in texts)


@query
def _in_workspace(db: Database, environment: Environment) -> Mapping[Named, int]:
    shares = {each.share for each in environment.own_packages}
    counts: Counter[Named] = Counter()
    for share in sorted(shares) if len(shares) <= _MOST_PACKAGES else ():
        # A package within another one is looked at with that.
        if os.path.dirname(share) not in shares:
            counts.update(_in_folder(db, share))
    return dict(counts)


@query
def _in_folder(db: Database, folder: str) -> Mapping[Named, int]:
    paths = [path for path in files_in(Disk(db), folder, deep=True) if path.endswith(_SUFFIXES)]
    counts: Counter[Named] = Counter()
    for path in paths if len(paths) <= _MOST else ():
        counts.update(_in_file(db, path))
    return dict(counts)


@query
def _in_file(db: Database, path: str) -> frozenset[Named]:
    document = Disk(db).text(path)
    return frozenset(_named(document.text)) if isinstance(document, Document) else frozenset()


def _named(text: str) -> Iterator[Named]:
    for pattern in _CALLS:
        for found in pattern.finditer(text):
            yield Named(found["name"].strip("~/"), re.split(r"[.:]", found["type"])[-1], found["call"] in _OFFER)
