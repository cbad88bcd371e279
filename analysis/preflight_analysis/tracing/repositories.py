"""The git folders of a workspace, and files with keys in it: what a checkout keeps in them, such as a token in
`.git/config`, is not for nodes.

They are hidden in the sandbox wherever they would be seen.
"""

from __future__ import annotations

import contextlib
import os
from collections import deque
from collections.abc import Iterable, Iterator

from preflight_analysis.documents.secrets import is_key_file, within
from preflight_analysis.environment.git import GitError, folders_of
from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.reach import is_wide

NAME = ".git"
MOST_FOLDERS = 20_000
"""How many folders of a workspace are looked into, the outermost first."""
MOST_KEYS = 1000
_NEVER = frozenset((NAME, "node_modules", "__pycache__"))


def hidden_paths(environment: Environment) -> tuple[str, ...]:
    """The real paths of git's folders and files in and around the workspace and the packages that are not installed,
    and of the folders elsewhere that they name; and those of files with keys."""
    system = (*environment.system_prefixes, "/usr", "/opt/ros")
    given = (*environment.workspace_folders, *environment.package_path)
    shares = (package.share for package in environment.packages.values())
    real = [path for path in map(os.path.realpath, (*given, *shares)) if not any(within(path, s) for s in system)]
    folders = list(dict.fromkeys(real))
    tops = [
        folder
        for folder in folders
        if not is_wide(folder) and not any(within(folder, o) for o in folders if o != folder)
    ]
    found: dict[str, None] = {}
    keys: dict[str, None] = {}
    for folder in (*_above(folders), *_below(tops, keys)):
        for path in _of(folder):
            # A workspace may lie in the folder of a bare repository.
            holds = any(within(each, path) for each in folders)
            found[os.path.join(path, "config") if holds else path] = None
    found.update((os.path.realpath(key), None) for key in keys if environment.access.refusal(key) is not None)
    return tuple(path for path in found if os.path.exists(path))


def _above(folders: Iterable[str]) -> Iterator[str]:
    """The folders, and those around them, that have a repository."""
    seen: set[str] = set()
    for folder in folders:
        at = folder
        while at not in seen:
            seen.add(at)
            if os.path.lexists(os.path.join(at, NAME)):
                yield at
            at = os.path.dirname(at)


def _below(folders: Iterable[str], keys: dict[str, None]) -> Iterator[str]:
    """The folders below that have a repository, links not followed. The first of the files with keys that are there are
    added to `keys`."""
    pending = deque(folders)
    for _ in range(MOST_FOLDERS):
        if not pending:
            return
        folder = pending.popleft()
        with contextlib.suppress(OSError), os.scandir(folder) as entries:
            for entry in entries:
                if entry.name == NAME:
                    yield folder
                elif entry.name not in _NEVER and entry.is_dir(follow_symlinks=False):
                    pending.append(entry.path)
                elif is_key_file(entry.name) and len(keys) < MOST_KEYS:
                    keys[entry.path] = None


def _of(top: str) -> Iterator[str]:
    """What git has of a working tree: its `.git`, and where that says that the rest is."""
    yield os.path.realpath(os.path.join(top, NAME))
    with contextlib.suppress(GitError, OSError, ValueError):
        for folder in folders_of(top):
            if os.path.isdir(os.path.join(folder, "objects")) or os.path.isfile(os.path.join(folder, "HEAD")):
                yield os.path.realpath(folder)
