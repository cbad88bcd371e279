"""Isolation by bubblewrap: name spaces of its own for everything, the first choice.

Inside: the host's files read-only; the masked folders and shared memory empty and of bounded size, with only the named
folders below them bound back read-only; own process, network, IPC and host name spaces, so no network but an own
loopback and no other process to see; no capabilities; no environment variable but those given; the system calls that
lead past this refused (`seccomp`).
"""

from __future__ import annotations

import contextlib
import os
import shutil
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from preflight_analysis.tracing import mounts, seccomp, sockets
from preflight_analysis.tracing.backend import TEMPORARY_BYTES, Backend, Isolated, View
from preflight_analysis.tracing.interior import PRIVATE

_USERNS_SWITCHES = (
    ("/proc/sys/kernel/unprivileged_userns_clone", "0", "sysctl kernel.unprivileged_userns_clone=1"),
    ("/proc/sys/user/max_user_namespaces", "0", "sysctl user.max_user_namespaces=10000"),
    (
        "/proc/sys/kernel/apparmor_restrict_unprivileged_userns",
        "1",
        "an AppArmor profile for bwrap (Ubuntu: apt install apparmor-profiles), "
        "or sysctl kernel.apparmor_restrict_unprivileged_userns=0",
    ),
)


@contextlib.contextmanager
def isolated(argv: Sequence[str], view: View) -> Iterator[Isolated]:
    """The way to run `argv`, once, until the end of the block."""
    program = shutil.which("bwrap")
    if program is None:
        raise FileNotFoundError("bubblewrap is not installed: apt install bubblewrap")
    with contextlib.ExitStack() as at_end:
        texts = {path: _handed(text, at_end) for path, text in view.replaced().items()}
        options, descriptors = _options(view, texts), list(texts.values())
        calls = seccomp.open_program()
        if calls is not None:
            at_end.callback(os.close, calls)
            options += ["--seccomp", str(calls)]
            descriptors.append(calls)
        yield Isolated([program, *options, "--", *argv], tuple(descriptors), own_users=True)


def _handed(text: str, at_end: contextlib.ExitStack) -> int:
    """A descriptor to read a text from."""
    descriptor = os.memfd_create("text")
    at_end.callback(os.close, descriptor)
    with os.fdopen(descriptor, "wb", closefd=False) as file:
        file.write(text.encode("utf-8", "replace"))
    os.lseek(descriptor, 0, os.SEEK_SET)
    return descriptor


def _explained(said: str) -> str:
    for switch, off, remedy in _USERNS_SWITCHES:
        try:
            if Path(switch).read_text().strip() == off:
                return f"user namespaces are switched off ({said}); needed: {remedy}"
        except OSError:
            continue
    return f"bubblewrap does not work here ({said}); in a container, user namespaces must be allowed"


def _options(view: View, texts: Mapping[str, int]) -> list[str]:
    size = str(TEMPORARY_BYTES)
    options = ["--unshare-user", "--unshare-pid", "--unshare-net", "--unshare-ipc", "--unshare-uts"]
    options += ["--unshare-cgroup-try", "--hostname", "localhost", "--clearenv", "--die-with-parent", "--new-session"]
    options += ["--cap-drop", "ALL", "--ro-bind", "/", "/"]
    options += ["--dev", "/dev", "--size", size, "--tmpfs", "/dev/shm"]  # noqa: S108
    # Root in a container could else write through a fresh /proc, core_pattern for one.
    options += ["--proc", "/proc", "--ro-bind", "/proc/sys", "/proc/sys"]
    # bubblewrap's own first process: with its memory changed it would not end when the run does.
    options += ["--size", "4096", "--perms", "0555", "--tmpfs", "/proc/1", "--remount-ro", "/proc/1"]
    for root in view.masks:
        options += ["--size", size, "--tmpfs", root]
    options += ["--dir", view.home, "--chmod", "0700", view.home]
    for path in view.secrets:
        options += ["--ro-bind", "/dev/null", path]
    for path in view.shown:
        options += ["--ro-bind", path, path]
    for path, descriptor in texts.items():
        options += ["--ro-bind-data", str(descriptor), path]
    for path in sockets.reachable(view.shown, view.masks):
        options += ["--ro-bind", "/dev/null", path]
    for path in mounts.leading_out(view.shown, view.masks):
        options += ["--size", "4096", "--perms", "0555", "--tmpfs", path, "--remount-ro", path]
    for path in view.hidden_repositories():
        if os.path.isdir(path):
            options += ["--size", "4096", "--perms", "0555", "--tmpfs", path, "--remount-ro", path]
        else:
            options += ["--ro-bind", "/dev/null", path]
    options += ["--ro-bind", str(view.agents.library), PRIVATE + "/lib/preflight_agents"]
    options += ["--ro-bind", str(view.agents.aspectlib), PRIVATE + "/lib/aspectlib"]
    for name in view.agents.site_names:
        options += ["--ro-bind", str(view.agents.site / name), f"{PRIVATE}/site/{name}"]
    return options


BACKEND = Backend("bubblewrap", isolated, _explained, ("files read-only, no network, own processes",), replaces=True)
