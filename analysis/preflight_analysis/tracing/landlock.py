"""Isolation by Landlock and a filter of system calls: for machines where user namespaces are off and nothing that is
installed with root's rights helps.

The run shares the host's name spaces. What keeps it in: Landlock for what it may open and, in its later versions,
signals and Unix sockets; the filter (`seccomp`) for what Landlock does not know; and for connections and signals the
process around it, `landlock_launcher`, which also ends it. What it writes goes to a folder of its own on the disk.
"""

from __future__ import annotations

import contextlib
import ctypes
import functools
import json
import os
import stat
import sys
import tempfile
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path

from preflight_analysis.documents.secrets import within
from preflight_analysis.tracing import mounts, seccomp
from preflight_analysis.tracing.backend import (
    Backend,
    Isolated,
    View,
    any_within,
    lay_agents,
    run_folder,
)
from preflight_analysis.tracing.interior import PRIVATE

_LAUNCHER = Path(__file__).parent / "landlock_launcher.py"
_CREATE_RULESET, _VERSION = 444, 1
_DEVICES = ("/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom")


@functools.lru_cache(maxsize=1)
def version() -> int:
    """The version of Landlock's interface that the kernel has switched on, 0 for none."""
    found = int(ctypes.CDLL(None).syscall(_CREATE_RULESET, None, 0, _VERSION))
    return max(found, 0)


def readable(view: View) -> tuple[list[str], list[str]]:
    """The outermost files and folders that together hold what may be read: Landlock only knows what is allowed. And
    the folders with a repository in them, which may be listed, though so its names can be."""
    leading_out = mounts.leading_out(view.shown, view.masks)
    repositories = view.hidden_repositories()
    found: list[str] = []
    listed: list[str] = []

    def look(path: str, hidden: Sequence[str], *, directory: bool) -> None:
        if any(within(path, root) for root in (*hidden, *repositories)):
            return
        if not directory or not any_within((*hidden, *repositories), path):
            found.append(path)
            return
        if not any_within(hidden, path) and not any(within(path, folder) for folder in listed):
            listed.append(path)
        try:
            entries = sorted(os.scandir(path), key=lambda entry: entry.name)
        except OSError:
            return
        for entry in entries:
            directory = entry.is_dir(follow_symlinks=False)
            if directory or (not entry.is_symlink() and stat.S_ISREG(entry.stat(follow_symlinks=False).st_mode)):
                look(entry.path, hidden, directory=directory)

    look("/", (*view.masks, *view.secrets, *leading_out, "/dev"), directory=True)
    for path in view.shown:
        look(path, leading_out, directory=os.path.isdir(path))
    return found, listed


def _tracing_scope() -> int:
    """Who may look into whom: up to 1 a process into its descendants, as `landlock_launcher` has to."""
    try:
        return int(Path("/proc/sys/kernel/yama/ptrace_scope").read_text())
    except (OSError, ValueError):
        return 0


@contextlib.contextmanager
def isolated(argv: Sequence[str], view: View) -> Iterator[Isolated]:
    """The way to run `argv`, once, until the end of the block."""
    agents, landlock, machine = view.agents, version(), os.uname().machine
    code = seccomp.program(machine, shared=True)
    if not landlock:
        raise OSError("the kernel has no Landlock (Linux 5.13 or later, with landlock in the kernel's lsm= list)")
    if code is None:
        raise OSError(f"Landlock needs the filter of system calls, and there is none for {machine}")
    if not os.path.exists(f"/proc/self/task/{threading.get_native_id()}/children"):
        raise OSError("the kernel does not tell the children of a process (CONFIG_PROC_CHILDREN)")
    tracing = _tracing_scope()
    if tracing > 2 or (tracing == 2 and os.geteuid() != 0):
        raise OSError(f"kernel.yama.ptrace_scope is {tracing}: connections of the run cannot be looked at")
    with contextlib.ExitStack() as at_end:
        folder = at_end.enter_context(run_folder(tempfile.gettempdir()))
        moved = {inside: folder + inside for inside in (PRIVATE, "/tmp", view.home)}  # noqa: S108
        for place in moved.values():
            os.makedirs(place, exist_ok=True)
        own = moved[PRIVATE]
        lay_agents(own, view.agents)
        read_end, write_end = os.pipe()
        at_end.callback(os.close, read_end)
        leash = at_end.enter_context(os.fdopen(write_end, "wb", buffering=0))
        read, listed = readable(view)
        order = {
            "argv": [argument.replace(PRIVATE, own) for argument in argv],
            "version": landlock,
            "filter": code.hex(),
            "asked": seccomp.asked(machine),
            "list": listed,
            "read": [*read, *map(str, (agents.library, agents.aspectlib, agents.site))],
            "write": [moved["/tmp"], moved[view.home]],  # noqa: S108
            "pipes": [own],
            "devices": _DEVICES,
            "folder": folder,
            "leash": read_end,
        }
        handed = os.memfd_create("order")
        at_end.callback(os.close, handed)
        os.write(handed, json.dumps(order).encode())
        os.lseek(handed, 0, os.SEEK_SET)
        command = [sys.executable, "-I", "-S", str(_LAUNCHER), str(handed)]
        yield Isolated(command, (handed, read_end), moved, leash, alone=False, written=tuple(moved.values()))


def _explained(said: str) -> str:
    return f"Landlock does not work here ({said})"


BACKEND = Backend(
    "landlock",
    isolated,
    _explained,
    (
        "only what is on a list can be opened; sizes, times and names of other files can be asked for by whoever "
        "knows their path",
        "connections only to what the run itself listens on, on this machine's loopback, where other programs of the "
        "machine can connect to it; no datagrams, no Unix sockets with a name",
        "the names and command lines of the machine's processes can be seen; signals reach the run's own only",
        "no semaphores of multiprocessing, no changes of files' modes and times: a node that needs them fails",
    ),
    narrow=True,
)
