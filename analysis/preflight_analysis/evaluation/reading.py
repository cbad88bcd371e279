"""Reading launch files of all formats."""

from __future__ import annotations

import os
from functools import partial

from preflight_analysis.documents.disk import text_of
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.environment.packages import MANIFEST
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import Input, query
from preflight_analysis.launch import read
from preflight_analysis.launch.model import LaunchFile


def _undecided() -> int:
    return 1


UNDECIDED = Input(_undecided)
"""The generation of ROS that a launch file is of which shows none."""


@query
def launch_file_of(db: Database, path: str, generation: int | None) -> LaunchFile | Unreadable:
    """The launch file at `path`, read as that generation of ROS reads it; None: as the file looks."""
    text = text_of(db, path)
    if isinstance(text, Unreadable):
        return text
    before = known if isinstance(known := db.previous, LaunchFile) else None
    if generation is None:
        return read.read_launch(text, undecided=UNDECIDED(db), of_package=partial(generation_around, db), before=before)
    looks = launch_file_of(db, path, None)
    if not isinstance(looks, Unreadable) and looks.generation == generation:
        return looks
    return read.read_launch(text, generation, before=before)


@query
def generation_around(db: Database, path: str) -> int | None:
    """The generation of the package around a file, by its manifest as it is on the disk."""
    folder = os.path.dirname(path)
    if folder == path:
        return None
    manifest = text_of(db, os.path.join(folder, MANIFEST))
    return (
        generation_around(db, folder)
        if isinstance(manifest, Unreadable)
        else read.generation_of_manifest(manifest.text)
    )
