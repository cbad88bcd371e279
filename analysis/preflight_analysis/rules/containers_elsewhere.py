"""What the other launch files of a package call the containers and nodelet managers that they start or load into."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.evaluation import names
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.launch.read import LAUNCH_SUFFIXES
from preflight_analysis.rules.nearest import is_slip
from preflight_analysis.rules.rule import Context

_NAMES = re.compile(
    r"""\bargs\s*=\s*["']\s*load\s+\S+\s+([\w/]+)\s*["'\s]|\btarget(?:_container)?\s*=\s*["']([\w/]+)["']"""
)
"""In XML and in Python; only names that are written out."""
_ENOUGH = 2
"""Files that have to agree on a name."""
_MOST = 500
"""Launch files of one package that are read."""


def called_elsewhere(context: Context, name: str) -> str | None:
    """The name by which other launch files of the package call what this one calls `name`, as a slip of it; None where
    another file calls it so, too."""
    package = package_around(context.environment, context.root)
    if package is None:
        return None
    known = _known(context.disk.db, package.share)
    leaf = names.leaf(name)
    if known.get(leaf, 0) > 1:
        return None
    near = [
        (-count, other) for other, count in known.items() if count >= _ENOUGH and is_slip(leaf, other) and other != leaf
    ]
    return min(near)[1] if near else None


@query
def _known(db: Database, folder: str) -> Mapping[str, int]:
    """In how many launch files of a package each name is."""
    paths = [path for path in files_in(Disk(db), folder, deep=True) if path.endswith(LAUNCH_SUFFIXES)]
    return Counter(name for path in paths[:_MOST] for name in _of_file(db, path))


@query
def _of_file(db: Database, path: str) -> frozenset[str]:
    document = Disk(db).text(path)
    text = document.text if isinstance(document, Document) else ""
    return frozenset(names.leaf(found[1] or found[2]) for found in _NAMES.finditer(text))
