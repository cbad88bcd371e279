"""The file that a wrong path was meant to name."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from preflight_analysis.environment.model import Environment
from preflight_analysis.rules.nearest import nearest

_MOST_ENTRIES = 5000
"""A package has fewer; a path into a home directory must not lead to reading all of it."""


def nearest_file(path: str, environment: Environment) -> str | None:
    """The path of an existing file that `path` is probably meant to be, None if nothing is near.

    First a file of a like name in the same folder; then the same name, or one like it, elsewhere in the package.
    """
    wanted = Path(path)
    siblings = {entry.name: entry for entry in _files(wanted.parent, deep=False)}
    near = nearest(wanted.name, siblings)
    if near is not None:
        return str(siblings[near])
    share = _package_folder(path, environment)
    if share is None:
        return None
    elsewhere = {entry.name: entry for entry in _files(share, deep=True) if entry.suffix == wanted.suffix}
    near = wanted.name if wanted.name in elsewhere else nearest(wanted.name, elsewhere)
    return str(elsewhere[near]) if near is not None else None


def _package_folder(path: str, environment: Environment) -> Path | None:
    holders = [p.share for p in environment.packages.values() if path.startswith(p.share.rstrip("/") + "/")]
    return Path(max(holders, key=len)) if holders else None


def _files(folder: Path, *, deep: bool) -> Iterator[Path]:
    """Files in `folder`, those of its sub-folders too if `deep`; folders that cannot be read have none."""
    seen = 0
    for directory, folders, files in os.walk(folder):
        folders[:] = sorted(f for f in folders if not f.startswith(".")) if deep else []
        for name in sorted(files):
            seen += 1
            if seen > _MOST_ENTRIES:
                return
            yield Path(directory, name)
