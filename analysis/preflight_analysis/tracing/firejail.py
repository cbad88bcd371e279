"""Isolation by firejail, which is installed with root's rights and needs no user namespaces: the second choice.

Inside as with bubblewrap, with what firejail's options can say: an own network, process and IPC name space, the system
directories read-only, `/tmp` and the home folder empty but for what is shown, the other masked folders shut. firejail
takes no filter of system calls: it applies its own, and the supervisor applies ours (`seccomp`).
"""

from __future__ import annotations

import contextlib
import os
import pwd
import re
import shutil
from collections.abc import Iterable, Iterator, Sequence

from preflight_analysis.documents.secrets import within
from preflight_analysis.tracing import mounts, seccomp, sockets
from preflight_analysis.tracing.backend import (
    Backend,
    Isolated,
    View,
    lay_agents,
    run_folder,
)
from preflight_analysis.tracing.interior import PRIVATE

_TMP = "/tmp"  # noqa: S108
_OWN = ("/proc", "/dev", "/sys", "/run")
"""Folders that firejail makes itself, or works with; nobody but root may write to them."""
_NOT_IN_NAMES = re.compile(r"[^\w/.:@+=~ \x80-\U0010ffff-]|(?<=\.)\.")
_WRITTEN = (_TMP, "/dev/shm", "/run/firejail/mnt")  # noqa: S108
"""File systems of the run's own, the last of them root's."""


@contextlib.contextmanager
def isolated(argv: Sequence[str], view: View) -> Iterator[Isolated]:
    """The way to run `argv`, once, until the end of the block."""
    program = shutil.which("firejail")
    if program is None:
        raise FileNotFoundError("firejail is not installed: apt install firejail")
    # Its /tmp is seen by the run, but read-only: only what is ours lies in it.
    calls = seccomp.program(os.uname().machine)
    with run_folder(_TMP) as folder:
        lay_agents(folder + "/own", view.agents)
        os.mkfifo(folder + "/own/events", 0o600)
        moved = {PRIVATE: folder + "/own"}
        command = [program, *_options(view, folder), "--"]
        command += [argument.replace(PRIVATE, moved[PRIVATE]) for argument in argv]
        yield Isolated(command, (), moved, written=(*_WRITTEN, view.home), filter=calls or b"")


def _options(view: View, folder: str) -> list[str]:
    home = os.path.realpath(pwd.getpwuid(os.getuid()).pw_dir)
    options = ["--quiet", "--noprofile", "--net=none", "--ipc-namespace", "--private-dev", "--nonewprivs"]
    options += ["--caps.drop=all", "--restrict-namespaces", "--seccomp"]
    options += ["--protocol=unix,inet,inet6,netlink", "--hostname=localhost"]
    if not within(view.home, home) and not within(view.home, _TMP):
        raise OSError(f"firejail knows {home} as the home folder, not {view.home}")
    agents = (view.agents.library, view.agents.aspectlib, view.agents.site)
    ours = [str(path) for path in agents if any(within(str(path), root) for root in view.masks)]
    shown = _outermost([*view.shown, *ours])
    elsewhere = [path for path in shown if not within(path, _TMP) and not within(path, home)]
    if elsewhere:
        raise OSError(f"firejail cannot show {elsewhere[0]}")
    options += [f"--whitelist={path}" for path in (folder, *shown)]
    if not any(within(path, home) for path in shown):
        options.append("--private")
    if os.getuid() == 0:
        # What is root's it could change everywhere. Others are not allowed to have /tmp back.
        options += ["--read-only=/", f"--read-write={_TMP}", f"--read-write={home}", "--read-write=/dev/shm"]
    # `/` alone would be the file system that is mounted there, without those that are mounted below.
    options += [f"--read-only={entry.path}" for entry in _folders("/") if not _kept(entry.path, (_TMP, home))]
    options += [f"--read-only={path}" for path in (folder, *shown)]
    for root in view.masks:
        if root not in (_TMP, home):
            options += [f"--blacklist={path}" for path in _shut(root, home)]
    leading_out = [*sockets.reachable(shown, view.masks), *mounts.leading_out(shown, view.masks)]
    leading_out += view.hidden_repositories()
    options += [f"--blacklist={_pattern(path)}" for path in (*view.secrets, *leading_out)]
    return options


def _pattern(path: str) -> str:
    """What firejail shuts by this name: it takes it as a pattern, and refuses many characters outside of one."""
    return _NOT_IN_NAMES.sub("?", path)


def _shut(root: str, home: str) -> list[str]:
    """What to shut so that nothing of a masked folder can be seen but the home folder and firejail's own."""
    if root != "/run" and not within(home, root):
        return [root]
    # Not links: firejail would shut what they lead to, as /run/shm does to shared memory.
    inside = [entry.path for entry in os.scandir(root) if not entry.is_symlink()]
    return [path for path in inside if not within(home, path) and path != "/run/firejail"]


def _kept(path: str, writable: Iterable[str]) -> bool:
    return path in _OWN or any(within(folder, path) for folder in writable)


def _folders(root: str) -> Iterator[os.DirEntry[str]]:
    with os.scandir(root) as entries:
        for entry in entries:
            if entry.is_dir(follow_symlinks=False):
                yield entry


def _outermost(paths: Iterable[str]) -> list[str]:
    kept: list[str] = []
    for path in sorted(set(paths)):
        if not any(within(path, outer) for outer in kept):
            kept.append(path)
    return kept


def _explained(said: str) -> str:
    return f"firejail does not work here ({said})"


BACKEND = Backend("firejail", isolated, _explained, ("files read-only, no network, own processes",))
