"""Names that the files around a launch file write, whatever launch they are of."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Mapping
from itertools import chain

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.launch.recognize import launch_files_of
from preflight_analysis.model.context import Context

Patterns = tuple[re.Pattern[str], ...]
"""Several: one that begins with a certain text is found faster than a choice of them."""
_MOST = 500
"""Files of one package that are read."""
_MOST_PACKAGES = 30
"""Packages beside one that are looked at."""


def in_package(context: Context, patterns: Patterns) -> Mapping[str, int]:
    """In how many launch files of the package of the root each name is that a pattern finds, as its group."""
    package = package_around(context.environment, context.root)
    return _in_folder(context.disk.db, package.share, patterns, None) if package is not None else {}


def around(context: Context, patterns: Patterns, suffixes: tuple[str, ...] | None = None) -> Mapping[str, int]:
    """As `in_package`, with the packages beside that: a robot's description, navigation, ... mostly are. Files with
    other `suffixes` are read likewise in the place of launch files."""
    return _around(context.disk.db, context.environment, context.root, patterns, suffixes)


def in_workspace(context: Context, patterns: Patterns) -> bool:
    """Whether a pattern finds something in a launch file of any package of the workspace."""
    return _in_workspace(context.disk.db, context.environment, patterns)


@query
def _in_workspace(db: Database, environment: Environment, patterns: Patterns) -> bool:
    shares = sorted({each.share for each in environment.own_packages})
    return any(_in_folder(db, share, patterns, None) for share in shares)


@query
def _around(
    db: Database, environment: Environment, root: str, patterns: Patterns, suffixes: tuple[str, ...] | None
) -> Mapping[str, int]:
    package = package_around(environment, root)
    if package is None:
        return {}
    beside = os.path.dirname(package.share)
    shares = {each.share for each in environment.packages.values() if os.path.dirname(each.share) == beside}
    counts: Counter[str] = Counter()
    for share in shares if len(shares) <= _MOST_PACKAGES else (package.share,):
        counts.update(_in_folder(db, share, patterns, suffixes))
    return dict(counts)


@query
def _in_folder(db: Database, folder: str, patterns: Patterns, suffixes: tuple[str, ...] | None) -> Mapping[str, int]:
    there = files_in(Disk(db), folder, deep=True)
    paths = launch_files_of(db, there) if suffixes is None else [path for path in there if path.endswith(suffixes)]
    return dict(Counter(chain.from_iterable(_in_file(db, path, patterns) for path in paths[:_MOST])))


@query
def _in_file(db: Database, path: str, patterns: Patterns) -> frozenset[str]:
    document = Disk(db).text(path)
    text = document.text if isinstance(document, Document) else ""
    return frozenset(match[1] for pattern in patterns for match in pattern.finditer(text))
