"""What changed since a revision, as git has it: `check --changed-since`."""

from __future__ import annotations

import contextlib
import os
import subprocess
from collections.abc import Collection
from functools import cache

from preflight_analysis.environment.packages import MANIFEST, crawl
from preflight_analysis.launch.read import LAUNCH_SUFFIXES
from preflight_analysis.workspace.workspace import Analysis

from preflight_server.cli.errors import CannotDoError

_TIMEOUT = 60


def changed_since(revision: str, folder: str) -> frozenset[str]:
    """The files of the repository around `folder` that are not as they were where the current branch left `revision`:
    committed since, changed, deleted, or new and not ignored. Raises `CannotDoError` where git cannot tell."""
    if revision.startswith("-"):
        raise CannotDoError(f"{revision} is no revision")
    top = _git(folder, "rev-parse", "--show-toplevel").rstrip("\n")
    try:
        commit = _git(top, "rev-parse", "--verify", f"{revision}^{{commit}}").strip()
    except CannotDoError:
        raise CannotDoError(f"'{revision}' is no revision of {top}, or this clone does not have it") from None
    with contextlib.suppress(CannotDoError):  # nothing in common that this clone has, a shallow one for instance
        commit = _git(top, "merge-base", commit, "HEAD").strip()
    changed = _git(top, "diff", "--name-only", "-z", "--no-renames", "--no-ext-diff", "--no-textconv", commit, "--")
    new = _git(top, "ls-files", "--others", "--exclude-standard", "-z")
    return frozenset(os.path.realpath(os.path.join(top, name)) for name in f"{changed}\0{new}".split("\0") if name)


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


def _git(folder: str, *arguments: str) -> str:
    # A repository's own configuration may name a program to ask what changed.
    command = ["git", "-C", folder, "-c", "core.fsmonitor=false", *arguments]
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, timeout=_TIMEOUT, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise CannotDoError(f"git does not answer: {error}") from None
    if done.returncode:
        said = done.stderr.decode(errors="replace").strip().splitlines()
        raise CannotDoError(f"git: {said[0] if said else arguments[0]}")
    return os.fsdecode(done.stdout)
