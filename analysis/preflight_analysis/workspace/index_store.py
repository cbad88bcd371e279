"""The workspace index from one start to the next: what was made of files that are still the same is not made again.

It is kept as plain data. An entry holds exactly while all that was looked at for it (`observations.py`) is as it was:
contents are compared, not times. Whatever cannot be read or understood is made anew.
"""

from __future__ import annotations

import functools
import hashlib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import preflight_analysis
from preflight_analysis.tracing.store import Place, Store, digest_of
from preflight_analysis.workspace.index import Root, WorkspaceIndex
from preflight_analysis.workspace.index_data import data_of_index, index_of_data
from preflight_analysis.workspace.index_processes import parts_by_processes
from preflight_analysis.workspace.indexing import Earlier, Report, Watch, build_index, launch_files
from preflight_analysis.workspace.workspace import Workspace

SCHEMA = "ros-preflight/index/2"
MAX_BYTES = 256 << 20
MAX_ENTRY_BYTES = 64 << 20
"""Of one workspace. One of 1,000 launch files has some 4 MB."""
MANY = 100
"""Launch files of which nothing is known: so many are given to processes of their own."""


def build_from_kept(
    store: IndexStore,
    workspace: Workspace,
    folder: str,
    named: Sequence[Root] = (),
    *,
    report: Report = lambda done, total, path: None,
    cancelled: Callable[[], bool] = lambda: False,
) -> WorkspaceIndex | None:
    """The index of a folder as `build_index` makes it, with what of a kept one is still right; and keep it. Where much
    is lacking, other processes make most of it, so that this one has time for who is waiting for an answer."""
    kept = known = store.load(workspace, folder, cancelled)
    paths = launch_files(folder, workspace)
    lacking = [path for path in paths if path not in known.files]
    if len(lacking) >= MANY:
        for part in parts_by_processes(workspace, lacking, named, cancelled):
            known = known.with_part(part)
            report(len(known.files), len(paths), next(iter(part.files), folder))
    watch = Watch(report, cancelled)
    index = build_index(workspace, folder, named, paths=paths, earlier=Earlier(known), watch=watch)
    if index is not None and not (_same(index.files, kept.files) and _same(index.entries, kept.entries)):
        store.save(workspace, folder, index)
    return index


def _same(some: Mapping[Any, object], others: Mapping[Any, object]) -> bool:
    return len(some) == len(others) and all(others.get(key) is each for key, each in some.items())


class IndexStore(Store):
    """Kept indexes, one of each workspace in each environment."""

    variants = 4

    def __init__(self, folder: Path | None = None, max_bytes: int = MAX_BYTES) -> None:
        super().__init__("indexes", SCHEMA, MAX_ENTRY_BYTES, folder, max_bytes)

    def load(self, workspace: Workspace, folder: str, cancelled: Callable[[], bool] = lambda: False) -> WorkspaceIndex:
        """What of the index of `folder` is still right; nothing is ever raised."""
        wanted = _key(workspace)
        for path, entry in self._entries(self._place(folder)):
            if entry.get("key") == wanted:
                self._used(path)
                return index_of_data(entry, workspace, cancelled)
        return WorkspaceIndex()

    def save(self, workspace: Workspace, folder: str, index: WorkspaceIndex) -> bool:
        """Keep an index. False if it is too large or the disk refused. What has changed by now is left out."""
        key = _key(workspace)
        return self._keep(self._place(folder), key, {"key": key, **data_of_index(workspace.sources, index)})

    def _place(self, folder: str) -> Place:
        return Place(self._folder_of(digest_of({"workspace": folder})), "index")


def _key(workspace: Workspace) -> str:
    """Of what an index is made from beside what is noted for each entry: our own code, and what there is of ROS."""
    environment = workspace.environment
    packages = {
        name: [[p.share, p.manifest, p.build_type] for p in (first, *environment.shadowed.get(name, ()))]
        for name, first in environment.packages.items()
    }
    places = [
        environment.package_path,
        environment.devel_spaces,
        environment.system_prefixes,
        environment.ament_prefixes,
    ]
    named = {
        "code": _own_code(),
        "generation": environment.generation,
        "distro": environment.distro,
        "meant_for": environment.meant_for,
        "packages": packages,
        "places": places,
        "cwd": workspace.cwd,
        "placeholder": workspace.commands.placeholder,
    }
    return digest_of(named)


@functools.cache
def _own_code() -> str:
    """Another version of it makes other indexes."""
    folder = Path(preflight_analysis.__file__).parent
    found = hashlib.blake2b(digest_size=20)
    for name in ("documents", "environment", "evaluation", "launch", "workspace"):
        for path in sorted((folder / name).glob("**/*.py")):
            found.update(path.read_bytes())
    return found.hexdigest()
