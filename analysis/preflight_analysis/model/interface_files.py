"""The files in which packages of the workspace define messages, services and actions."""

from __future__ import annotations

import os
import re

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.model.context import Context

_SUFFIXES = (".msg", ".srv", ".action")
_OF_ACTION = re.compile(r"(?:Action)?(?:Goal|Result|Feedback)?\Z")
"""How the names go on that are made of an action's."""


def lacks_type(context: Context, type_: str | None) -> bool:
    """Whether a type is named after a package that has files of such definitions, and none for it."""
    package_name, _, name = (type_ or "").partition("/")
    package = context.environment.packages.get(package_name)
    if package is None or not name:
        return False
    defined, leaf = _defined(context.disk.db, package.share), name.rpartition("/")[2]
    return bool(defined) and leaf not in defined and _OF_ACTION.sub("", leaf) not in defined


@query
def _defined(db: Database, share: str) -> frozenset[str]:
    files = (os.path.splitext(os.path.basename(path)) for path in files_in(Disk(db), share, deep=True))
    return frozenset(name for name, suffix in files if suffix in _SUFFIXES)
