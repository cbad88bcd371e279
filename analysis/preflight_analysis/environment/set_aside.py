"""Folders that a workspace leaves out on purpose: colcon ignores what is below a marker."""

from __future__ import annotations

import os

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.packages import IGNORED_BY_COLCON
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query


def is_set_aside(disk: Disk, environment: Environment, path: str) -> bool:
    """Whether a file is below a marker of colcon's in a workspace that builds packages of ROS 2: in one of ROS 1 the
    marker says that colcon leaves it to catkin."""
    workspace = environment.workspace
    if workspace is None or not path.startswith(inside := workspace.rstrip("/") + "/"):
        return False
    if not _has_marker(disk.db, os.path.dirname(path), workspace.rstrip("/")):
        return False
    return any(package.is_ament and package.share.startswith(inside) for package in environment.packages.values())


@query
def _has_marker(db: Database, folder: str, top: str) -> bool:
    if folder in (top, "/") or len(folder) < len(top):  # the workspace may be the root of the disk
        return False
    return not IGNORED_BY_COLCON.isdisjoint(Disk(db).names(folder)) or _has_marker(db, os.path.dirname(folder), top)
