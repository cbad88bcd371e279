"""Where the Python modules of a catkin package lie before it is built: what `catkin_python_setup()` will make known.

http://docs.ros.org/en/noetic/api/catkin/html/user_guide/setup_dot_py.html. `setup.py` is read as text, nothing is run.
"""

from __future__ import annotations

import ast
import contextlib
import os
import re
from collections.abc import Iterator, Mapping

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.build import LISTS
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query

_CALL = re.compile(r"^\s*catkin_python_setup\s*\(", re.MULTILINE | re.IGNORECASE)
_MADE_OF = {"msg": ".msg", "srv": ".srv", "action": ".action", "cfg": ".cfg"}
"""The folders of what modules are made of when a package is built, and the ends of the names of the files."""
_MAX_TEXT = 200_000


def source_folders(disk: Disk, environment: Environment) -> tuple[str, ...]:
    """The folders of the module search path once the workspace is built, as they are in the source."""
    return _source_folders(disk.db, environment)


@query
def _source_folders(db: Database, environment: Environment) -> tuple[str, ...]:
    packages = workspace_packages(environment)
    return tuple(dict.fromkeys(folder for package in packages for folder in _folders(db, package.share)))


def generates_modules(package: Package) -> bool:
    """Whether a build makes modules of it, of messages, services, actions or dynamic parameters."""
    return any(
        name.endswith(end) for folder, end in _MADE_OF.items() for name in _names(os.path.join(package.share, folder))
    )


def workspace_packages(environment: Environment) -> Iterator[Package]:
    """The packages of ROS 1 that are there as source."""
    installed = tuple(os.path.join(prefix, "") for prefix in environment.system_prefixes)
    for package in environment.packages.values():
        if not package.is_ament and not package.share.startswith(installed):
            yield package


@query
def _folders(db: Database, folder: str) -> tuple[str, ...]:
    disk = Disk(db)
    setup = disk.content(os.path.join(folder, "setup.py"))
    if setup is None or not _CALL.search(disk.content(os.path.join(folder, LISTS)) or ""):
        return ()
    given = _package_dir(setup[:_MAX_TEXT])
    roots = [given.get("", "")]
    # A package by name: what it is imported from is the folder above, where that is called the same.
    for name, place in given.items():
        above, _, last = os.path.normpath(place).rpartition("/")
        if name and last == name:
            roots.append(above)
    return tuple(dict.fromkeys(os.path.normpath(os.path.join(folder, root)) for root in roots))


def _package_dir(text: str) -> Mapping[str, str]:
    """`package_dir` of the `setup.py`, however that is given to `setup`."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return {}
    for node in ast.walk(tree):
        given = isinstance(node, ast.keyword) and node.arg == "package_dir"
        assigned = isinstance(node, ast.Assign) and any(map(_is_item, node.targets))
        if given or assigned:
            assert isinstance(node, (ast.keyword, ast.Assign))
            with contextlib.suppress(ValueError, TypeError, SyntaxError, RecursionError, MemoryError):
                found = ast.literal_eval(node.value)
                if isinstance(found, dict):
                    return {k: v for k, v in found.items() if isinstance(k, str) and isinstance(v, str)}
    return {}


def _is_item(target: ast.expr) -> bool:
    """Whether it is `d['package_dir']`."""
    key = target.slice if isinstance(target, ast.Subscript) else None
    return isinstance(key, ast.Constant) and key.value == "package_dir"


def _names(folder: str) -> list[str]:
    try:
        return os.listdir(folder)
    except OSError:
        return []
