"""What changed since a revision, as git has it: `check --changed-since`."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Collection
from functools import cache

from preflight_analysis.environment.git import GitError, Repository, open_repository
from preflight_analysis.environment.packages import MANIFEST, crawl
from preflight_analysis.launch.recognize import LAUNCH_SUFFIXES
from preflight_analysis.workspace.workspace import Analysis

from preflight_server.cli.errors import CannotDoError


def changed_since(revision: str, folder: str) -> frozenset[str]:
    """The files of the repository around `folder` that are not as they were where the current branch left `revision`:
    committed since, changed, deleted, or new and not ignored. Raises `CannotDoError` where git cannot tell."""
    if revision.startswith("-"):
        raise CannotDoError(f"{revision} is no revision")
    try:
        with open_repository(folder) as repository:
            return _changed(repository, revision)
    except GitError as error:
        raise CannotDoError(str(error)) from None


def _changed(repository: Repository, revision: str) -> frozenset[str]:
    top = repository.top
    try:
        commit = repository.ask("rev-parse", "--verify", f"{revision}^{{commit}}").decode().strip()
    except GitError:
        raise CannotDoError(f"'{revision}' is no revision of {top}, or this clone does not have it") from None
    with contextlib.suppress(GitError):  # nothing in common that this clone has, a shallow one for instance
        commit = repository.ask("merge-base", commit, "HEAD").decode().strip()
    # Git would ask for changes within submodules in a process that obeys the submodule's configuration.
    changed = repository.ask("diff", "--name-only", "-z", "--no-renames", "--ignore-submodules=dirty", commit, "--")
    new = repository.ask("ls-files", "--others", "--exclude-standard", "-z")
    names = os.fsdecode(b"%b\0%b" % (changed, new)).split("\0")
    return frozenset(os.path.realpath(os.path.join(top, name)) for name in names if name)


def touched(analysis: Analysis, changed: Collection[str], settings: str) -> bool:
    """Whether a change may matter to a launch: to a file that it was read from, the `settings` file, or any file of a
    package of which it starts a node, other launch files aside."""
    if os.path.realpath(settings) in changed:
        return True
    if any(os.path.realpath(path) in changed for path in analysis.tree.inputs):
        return True
    made_of = (file for file in changed if not file.endswith(LAUNCH_SUFFIXES))
    packages = {name for file in made_of if (name := _package_of(os.path.dirname(file))) is not None}
    return any(node.package in packages for node in analysis.tree.nodes)


@cache
def _package_of(folder: str) -> str | None:
    """The name of the package that a folder is in, by its manifest."""
    if os.path.isfile(os.path.join(folder, MANIFEST)):
        package = next(crawl(folder, metapackages=True), None)
        return package.name if package is not None else None
    parent = os.path.dirname(folder)
    return None if parent == folder else _package_of(parent)
