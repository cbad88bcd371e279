"""A disk on which an editor has texts open, whether their files are there or not."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from preflight_analysis.documents.disk import Disk


def disk_with(texts: Mapping[str | Path, str]) -> Disk:
    """The disk with these texts over it, by their paths."""
    disk = Disk()
    for path, text in texts.items():
        disk.open(str(path), text)
    return disk
