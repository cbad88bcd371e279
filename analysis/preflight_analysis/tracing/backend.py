"""What the ways to isolate a run share: what they are given, what they give back. Plain data; `sandbox` chooses."""

from __future__ import annotations

import contextlib
import os
import shutil
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import field
from pathlib import Path
from typing import IO

import aspectlib  # type: ignore[import-untyped]

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.secrets import within


@dataclass(frozen=True, slots=True)
class Agents:
    """Where our own code for the inside is on the host: the package of agents, aspectlib, and the folder with
    `sitecustomize.py`.

    They are shown below `PRIVATE`.
    """

    library: Path
    aspectlib: Path
    site: Path

    @property
    def site_names(self) -> tuple[str, ...]:
        """What of the folder is shown. As a source it has other modules, which would hide those of the same name."""
        return ("sitecustomize.py", "__pycache__") if self is not AGENTS else ("sitecustomize.py",)


_AGENTS = Path(__file__).parent / "agents"
AGENTS = Agents(_AGENTS, Path(aspectlib.__file__).parent, _AGENTS)
"""The sources, as installed."""

_LEFT_OVER_SECONDS = 600
_RUN_FOLDER = "ros-preflight-"
TEMPORARY_BYTES = 64 << 20
"""Size of each writable file system inside: /tmp, /dev/shm, the home folder."""


@dataclass(frozen=True, slots=True)
class Visible:
    """What of the user's files is shown to a run: paths below the masked folders that it sees nevertheless, and the git
    folders that it does not see wherever they are (`repositories.py`). `texts` are read in the place of files that it
    sees, by the real paths of these: what an editor has of them. Only a backend that `replaces` does that."""

    paths: tuple[str, ...] = ()
    repositories: tuple[str, ...] = ()
    texts: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class View:
    """What a run may see: all that the user may read, without what lies below `masks` and without `secrets`, but with
    `shown`. `home` is the home folder, empty and writable inside. `agents` is our own code. `repositories` are what is
    hidden of all that, by its real paths; `texts` are those of `Visible`."""

    masks: tuple[str, ...]
    secrets: tuple[str, ...]
    shown: tuple[str, ...]
    home: str
    agents: Agents
    repositories: tuple[str, ...] = ()
    texts: Mapping[str, str] = field(default_factory=dict)

    def replaced(self) -> dict[str, str]:
        """The texts by where their files would be seen inside."""
        if not self.texts:
            return {}
        seen = Seen.of(self.shown, self.masks)
        files = {path: text for path, text in self.texts.items() if os.path.isfile(path)}
        return {place: text for path, text in files.items() for place in seen.places(path)}

    def hidden_repositories(self) -> list[str]:
        """Where `repositories` would be seen inside, without what lies in another of them."""
        seen = Seen.of(self.shown, self.masks)
        places = {place for path in self.repositories if os.path.exists(path) for place in seen.places(path)}
        return sorted(p for p in places if not any(within(p, other) for other in places if other != p))


@dataclass(frozen=True, slots=True)
class Isolated:
    """A command line that runs something isolated, and the descriptors that it must inherit.

    `moved`: folders that the run has elsewhere than `sandbox` says, from there to the place on the host. `leash`:
    what ends the run when it is closed; None if killing the first process does. `own_users`: whether the kernel counts
    its processes apart from the user's others. `alone`: whether it sees no processes but its own. `written`: the
    folders that it may write to, where nothing but the supervisor inside bounds them. `filter`: the filter of system
    calls, where the supervisor has to apply it.
    """

    command: list[str]
    descriptors: tuple[int, ...] = ()
    moved: Mapping[str, str] = field(default_factory=dict)
    leash: IO[bytes] | None = None
    own_users: bool = False
    alone: bool = True
    written: tuple[str, ...] = ()
    filter: bytes = b""


@dataclass(frozen=True, slots=True)
class Backend:
    """One way to isolate. `isolated` raises `OSError` with a sentence where it is not there; `explained` makes a
    sentence of what it said when an empty run failed; `guarantees` is what holds besides what holds with all, one
    sentence each."""

    name: str
    isolated: Callable[[Sequence[str], View], AbstractContextManager[Isolated]]
    explained: Callable[[str], str]
    guarantees: tuple[str, ...]
    narrow: bool = False
    """Whether a program may fail in it that would not in the others: what failed so is no finding, and not kept."""
    replaces: bool = False
    """Whether a run can have a text in the place of a file."""


@contextlib.contextmanager
def run_folder(below: str) -> Iterator[str]:
    """A folder on the host for one run, until the end of the block. Those of processes that were killed before they
    could remove theirs go with the next."""
    for left in Path(below).glob(_RUN_FOLDER + "*-*"):
        owner = left.name[len(_RUN_FOLDER) :].partition("-")[0]
        with contextlib.suppress(OSError):
            # Of an age that no run reaches: another container's processes cannot be seen.
            old = time.time() - left.lstat().st_mtime > _LEFT_OVER_SECONDS
            if owner.isdigit() and old and not os.path.exists(f"/proc/{owner}"):
                shutil.rmtree(left, ignore_errors=True)
    prefix = f"{_RUN_FOLDER}{os.getpid()}-"
    with tempfile.TemporaryDirectory(prefix=prefix, dir=below, ignore_cleanup_errors=True) as folder:
        yield folder


def lay_agents(folder: str, agents: Agents) -> None:
    """Make what is ours inside in a folder on the host, for a run that has `PRIVATE` there."""
    os.makedirs(folder + "/lib")
    os.makedirs(folder + "/site")
    os.symlink(agents.library, folder + "/lib/preflight_agents")
    os.symlink(agents.aspectlib, folder + "/lib/aspectlib")
    for name in agents.site_names:
        os.symlink(agents.site / name, f"{folder}/site/{name}")


def place(path: str, moved: Mapping[str, str]) -> str:
    """Where something inside lies for the run: itself, or below a folder that was moved."""
    for folder, elsewhere in moved.items():
        if path == folder or path.startswith(folder + "/"):
            return elsewhere + path[len(folder) :]
    return path


def any_within(paths: Iterable[str], folder: str) -> bool:
    """Whether one of `paths` lies at or below `folder`."""
    return any(within(path, folder) for path in paths)


@dataclass(frozen=True, slots=True)
class Seen:
    """Where something of the host is seen inside, when `bound` are folders that are shown, under any name, though they
    lie below one of `masks`."""

    masks: tuple[str, ...]
    bound: tuple[tuple[str, str], ...]
    """Each as it is shown, and its real path."""

    @classmethod
    def of(cls, bound: Iterable[str], masks: Iterable[str]) -> Seen:
        """With the folders as the host has them now."""
        return cls(tuple(masks), tuple((folder, os.path.realpath(folder)) for folder in bound))

    def places(self, path: str) -> list[str]:
        """The paths inside of what has this real path."""
        found = [
            os.path.normpath(os.path.join(folder, os.path.relpath(path, real)))
            for folder, real in self.bound
            if within(path, real)
        ]
        return found if any(within(path, mask) for mask in self.masks) else [*found, path]
