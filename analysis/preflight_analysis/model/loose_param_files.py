"""Where parameter files lie that no node of a launch is known to get."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import PurePath

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.evaluation.ros2.param_files import MARK
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.model.context import Context
from preflight_analysis.model.sections import first_getters

YAML_SUFFIXES = (".yaml", ".yml")
_FOLDERS = frozenset({"config", "configs", "param", "params", "parameters", "cfg", "launch"})
"""Where packages have their parameter files, below other folders or not."""
_NOT_OURS = frozenset({"test", "tests", "build", "install", "log"})
_ABOVE = 3
"""Folders above a package that may be those of its repository."""
_MOST = 200
"""Files of one package that are read."""
_LONGEST = 200_000
"""Characters of one."""
_TEMPLATE = re.compile(r"\$\(|:[ \t]+['\"]?<\w+>['\"]?[ \t]*$", re.MULTILINE)
"""What is replaced before a node gets the file: substitutions, and whole values as `ReplaceString` of Nav2 has them."""
_MAY_BE_MARK = re.compile(r"^[ \t]+ro?s?_*pa?ra?m\w*:", re.MULTILINE)


def loose_param_files(context: Context) -> list[str]:
    """The parameter files of the package of ROS 2 that the launch file is in which no node of the launch gets."""
    package = package_around(context.environment, context.root)
    if package is None or context.environment.is_installed(package) or not context.tree.ros.own_parameters:
        return []
    return sorted(param_files_around(context, package.share) - first_getters(context).keys())


def is_template(text: str) -> bool:
    """Whether no node gets the file as it is: something else puts values in it first."""
    return _TEMPLATE.search(text) is not None


def param_files_around(context: Context, share: str) -> frozenset[str]:
    """Those of a package of ROS 2, and of the folders of such files beside the packages of its repository."""
    folders = _folders(context, share)
    return frozenset(path for folder, base in folders for path in _param_files(context.disk.db, folder, base))


def _folders(context: Context, share: str) -> Iterator[tuple[str, str]]:
    """That of the package, and those of parameter files beside the packages of its repository; what they are below."""
    yield share, share
    workspace = (context.environment.workspace or "").rstrip("/")
    above = os.path.dirname(share)
    for _ in range(_ABOVE):
        if not workspace or not f"{above}/".startswith(f"{workspace}/"):
            return
        found = [os.path.join(above, name) for name in context.disk.names(above) if name in _FOLDERS]
        yield from ((path, above) for path in found if not context.disk.is_link(path))
        above = os.path.dirname(above)


@query
def _param_files(db: Database, folder: str, base: str) -> tuple[str, ...]:
    """Those below a folder that may be parameter files, by how they are called from `base`."""
    return tuple(path for path in sorted(files_in(Disk(db), folder, deep=True)) if _is_one(db, path, base))[:_MOST]


@query
def yaml_files_of(db: Database, folder: str) -> tuple[str, ...]:
    """Those below a package of ROS 1 that may have parameters."""
    disk = Disk(db)
    paths = (path for path in sorted(files_in(disk, folder, deep=True)) if is_in_their_folder(path, folder))
    texts = ((path, disk.text(path)) for path in paths)
    return tuple(path for path, text in texts if isinstance(text, Document) and len(text.text) <= _LONGEST)[:_MOST]


def is_in_their_folder(path: str, base: str) -> bool:
    """Whether a YAML file is where packages have parameters, below the folder `base`."""
    folders = frozenset(PurePath(os.path.relpath(path, base)).parts[:-1])
    return path.endswith(YAML_SUFFIXES) and not folders.isdisjoint(_FOLDERS) and folders.isdisjoint(_NOT_OURS)


@query
def _is_one(db: Database, path: str, base: str) -> bool:
    if not is_in_their_folder(path, base):
        return False
    document = Disk(db).text(path)
    text = document.text if isinstance(document, Document) else ""
    return len(text) <= _LONGEST and not is_template(text) and (MARK in text or _MAY_BE_MARK.search(text) is not None)
