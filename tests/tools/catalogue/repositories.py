"""Snapshots of public repositories: git directories without a work tree, `OWNER+NAME/repo` below one folder."""

from __future__ import annotations

import io
import os
import re
import subprocess
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from typing_extensions import Self

_LINK = "120000"
"""The mode of a symbolic link."""
_NO_SOURCE = re.compile(
    r"\.(?:png|jpe?g|gif|svg|stl|dae|obj|mtl|bag|db3|pgm|pdf|mp4|webm|zip|gz|pcd|ply|bin|so|a|js)\Z", re.I
)


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

    @classmethod
    def of_all(cls, sources: Path, branches: Mapping[str, str], only: Collection[str] = ()) -> Iterator[Self]:
        """Those of repositories, each at its branch, that are there; of `only` where any are named."""
        for repository, ref in branches.items():
            if not only or repository in only:
                try:
                    yield cls.of(sources, repository, ref)
                except FileNotFoundError as error:
                    print(f"what is known of it stays: {error}", flush=True)

    def text(self, path: str) -> str:
        """The text of a file."""
        return _git(self.git, "show", f"{self.commit}:{path}").decode("utf-8", "replace")

    def files(self) -> list[str]:
        """The paths of all files."""
        return _git(self.git, "ls-tree", "-r", "--name-only", "-z", self.commit).decode().split("\0")[:-1]

    def unpack(self, into: Path) -> None:
        """Write its files below a folder, which is made: those that launch, build or are source. A snapshot may lack
        large files, which are left out."""
        rows = [
            row.split("\t", 1) for row in _git(self.git, "ls-tree", "-r", "-z", self.commit).decode().split("\0")[:-1]
        ]
        wanted = [(*about.split(), path) for about, path in rows if not _NO_SOURCE.search(path)]
        files = [(mode, name, path) for mode, kind, name, path in wanted if kind == "blob"]
        asked = "".join(f"{name}\n" for _, name, _ in files).encode()
        answers = io.BytesIO(_git(self.git, "cat-file", "--batch", input_=asked, check=False))
        for mode, _, path in files:
            head = answers.readline().split()
            if len(head) < 3:
                continue
            place = into / path
            content = answers.read(int(head[2]))
            answers.read(1)
            if mode == _LINK:
                _link(place, content.decode("utf-8", "surrogateescape"), into)
                continue
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(content)
            if mode == "100755":
                place.chmod(0o755)


def _link(place: Path, target: str, into: Path) -> None:
    """A link that stays within the snapshot; any other is left out."""
    leads_to = Path(os.path.normpath(place.parent / target))
    if into in leads_to.parents and not Path(target).is_absolute():
        place.parent.mkdir(parents=True, exist_ok=True)
        place.symlink_to(target)


def _git(git: Path, *arguments: str, check: bool = True, input_: bytes | None = None) -> bytes:
    environment = {**os.environ, "GIT_NO_LAZY_FETCH": "1"}
    words = ["git", "--git-dir", str(git), *arguments]
    return subprocess.run(words, capture_output=True, check=check, input=input_, env=environment).stdout
