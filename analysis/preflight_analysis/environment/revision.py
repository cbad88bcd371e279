"""A revision of a git repository as a folder, and the environment of a workspace with that folder in the repository's
place.

The files are written as they are stored: no filters.
"""

from __future__ import annotations

import contextlib
import os
import re
import subprocess
from collections.abc import Iterable, Iterator
from dataclasses import replace

from preflight_analysis.dataclass import dataclass
from preflight_analysis.environment.detect import BUILT
from preflight_analysis.environment.git import GitError, Repository, open_repository
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.packages import find_packages

_MOST_BYTES = 4 << 30
"""The files of a revision together: a few kilobytes of a repository can have as many as they like."""
_PIECE = 1 << 20
_COMMIT = re.compile(r"[0-9a-f]{40,64}")


class NoRevisionError(Exception):
    """What was asked for is not there; says what, in a sentence."""


@dataclass(frozen=True, slots=True)
class Revision:
    """A commit of the repository at `repository`, and the path of a file in it, relative to that."""

    repository: str
    commit: str
    file: str


def find_revision(text: str, folder: str) -> Revision:
    """What `REV:path` means in `folder`. As for git the path is one from the top of the repository, or with `./` from
    the folder; without it that is tried too. Raises `NoRevisionError`."""
    name, _, path = text.partition(":")
    try:
        with open_repository(folder) as repository:
            return _find(repository, name, path, folder)
    except GitError as error:
        raise NoRevisionError(str(error)) from None


def _find(repository: Repository, name: str, path: str, folder: str) -> Revision:
    top = repository.top
    try:
        found = repository.ask("rev-parse", "--verify", "--quiet", "--end-of-options", f"{name}^{{commit}}")
    except GitError:
        found = b""
    commit = found.decode("ascii", "replace").strip()
    if not name or not _COMMIT.fullmatch(commit):
        raise NoRevisionError(f"{name!r} is no revision of {top}")
    here = os.path.normpath(os.path.join(os.path.relpath(os.path.realpath(folder), top), path))
    for candidate in (here,) if path.startswith("./") else (os.path.normpath(path), here):
        if not candidate.startswith(("..", "/")):
            with contextlib.suppress(GitError):
                repository.ask("cat-file", "-e", f"{commit}:{candidate}")
                return Revision(top, commit, candidate)
    raise NoRevisionError(f"{path} is not in {name}")


def write_revision(revision: Revision, folder: str) -> None:
    """All files of the revision, below an empty folder. What lies in submodules is not there. Raises `NoRevisionError`
    if git fails, and `OSError`."""
    try:
        with open_repository(revision.repository) as repository:
            _write_all(repository, revision.commit, folder)
    except GitError as error:
        raise NoRevisionError(str(error)) from None


def _write_all(repository: Repository, commit: str, folder: str) -> None:
    listed = repository.ask("ls-tree", "-r", "-z", "--full-tree", commit)
    with subprocess.Popen(
        repository.command("cat-file", "--batch"),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env=repository.environment,
    ) as git:
        assert git.stdin is not None
        assert git.stdout is not None
        left = _MOST_BYTES
        for mode, name, path in _entries(listed):
            git.stdin.write(name + b"\n")
            git.stdin.flush()
            answer = git.stdout.readline().split()
            if not answer or not answer[-1].isdigit():
                raise NoRevisionError(f"git does not have {os.fsdecode(path)} of {commit}")
            size = int(answer[-1])
            left -= size
            if left < 0:
                git.kill()
                raise NoRevisionError(f"the files of {commit} are more than {_MOST_BYTES >> 30} GiB")
            pieces = (git.stdout.read(min(_PIECE, size - at)) for at in range(0, size, _PIECE))
            _write(folder, os.fsdecode(path), mode, pieces)
            git.stdout.read(1)


def environment_at(environment: Environment, repository: str, folder: str) -> Environment:
    """The environment with `folder` in the place of the repository. What was built of it, or lies outside, is that of
    now."""

    def moved(path: str) -> str:
        return os.path.normpath(os.path.join(folder, os.path.relpath(path, repository)))

    entries = [
        (moved(path) if _is_below(path, repository) else folder, path)
        for path in environment.package_path
        if _is_below(path, repository) or _is_below(repository, path)
    ]
    known: dict[str, list[Package]] = {}
    for name, package in environment.packages.items():
        known[name] = [package, *environment.shadowed.get(name, ())]
    elsewhere = {
        name: others[0]
        for name, packages in known.items()
        if (others := [p for p in packages if not _is_below(p.share, repository)])
    }
    overlaid = {name for name, packages in known.items() if not _is_below(packages[0].share, repository)}
    there = find_packages(dict.fromkeys(place for place, _ in entries), skip=BUILT)
    packages = {**elsewhere, **{name: p for name, p in there.packages.items() if name not in overlaid}}
    path = [*dict.fromkeys(place for place, _ in entries)]
    path += [entry for entry in environment.package_path if not _is_below(entry, repository)]
    workspace = environment.workspace
    variables = dict(environment.variables)
    if "ROS_PACKAGE_PATH" in variables:
        variables["ROS_PACKAGE_PATH"] = os.pathsep.join(path)
    return replace(
        environment,
        packages=packages,
        shadowed={},
        package_path=tuple(path),
        variables=variables,
        workspace=moved(workspace) if workspace and _is_below(workspace, repository) else workspace,
        workspace_folders=(*environment.workspace_folders, folder, os.path.realpath(folder)),
    )


def _is_below(path: str, folder: str) -> bool:
    return path == folder or path.startswith(folder.rstrip("/") + "/")


def _entries(listed: bytes) -> Iterator[tuple[bytes, bytes, bytes]]:
    """Mode, object and path of each file; without what git itself would not check out."""
    for entry in listed.split(b"\0"):
        about, _, path = entry.partition(b"\t")
        parts = path.split(b"/")
        if path and about.split()[1] == b"blob" and not {b"", b".", b"..", b".git"} & {part.lower() for part in parts}:
            yield about.split()[0], about.split()[2], path


def _write(top: str, name: str, mode: bytes, content: Iterable[bytes]) -> None:
    path = os.path.join(top, name)
    parent = os.path.dirname(path)
    # A tree that was made by hand may have a link and a folder of one name.
    if os.path.realpath(parent) != os.path.join(os.path.realpath(top), os.path.dirname(name)).rstrip("/"):
        raise NoRevisionError(f"{name} lies behind a link")
    os.makedirs(parent, exist_ok=True)
    if mode == b"120000":
        os.symlink(b"".join(content), os.fsencode(path))
        return
    # Never through a link that the tree has put there.
    descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o755 if mode == b"100755" else 0o644)
    with open(descriptor, "wb") as file:
        file.writelines(content)
