"""Snapshots of public repositories: git directories without a work tree, `OWNER+NAME/repo` below one folder."""

from __future__ import annotations

import io
import subprocess
import tarfile
from dataclasses import dataclass
from pathlib import Path

from typing_extensions import Self


@dataclass(frozen=True, slots=True)
class Snapshot:
    """One commit of a repository."""

    repository: str
    """`owner/name`."""
    git: Path
    commit: str
    date: str

    @classmethod
    def of(cls, sources: Path, repository: str, ref: str = "HEAD") -> Self:
        """The commit that a branch or tag is at. Raises `FileNotFoundError` where the snapshot is not there, and
        `KeyError` where it has no such branch."""
        folder = sources / repository.replace("/", "+") / "repo"
        git = folder / ".git" if (folder / ".git").is_dir() else folder
        if not git.is_dir():
            raise FileNotFoundError(f"no snapshot of {repository} in {sources}")
        for each in (ref, f"origin/{ref}"):
            found = _git(git, "log", "-1", "--format=%H %cs", each, "--", check=False).decode().split()
            if found:
                return cls(repository, git, found[0], found[1])
        raise KeyError(f"{repository} has no {ref}")

    def text(self, path: str) -> str:
        """The text of a file."""
        return _git(self.git, "show", f"{self.commit}:{path}").decode("utf-8", "replace")

    def files(self) -> list[str]:
        """The paths of all files."""
        return _git(self.git, "ls-tree", "-r", "--name-only", "-z", self.commit).decode().split("\0")[:-1]

    def unpack(self, into: Path) -> None:
        """Write its files below a folder, which is made."""
        into.mkdir(parents=True, exist_ok=True)
        with tarfile.open(fileobj=io.BytesIO(_git(self.git, "archive", self.commit))) as archive:
            archive.extractall(into, filter="data")


def _git(git: Path, *arguments: str, check: bool = True) -> bytes:
    done = subprocess.run(["git", "--git-dir", git, *arguments], capture_output=True, check=check)
    return done.stdout
