"""Isolation by bubblewrap: the command line in which other people's code runs, and whether it works here.

There is no other way to run anything: where `probe` says no, nothing runs.

Inside: the host's files read-only; `/tmp`, `/run`, the home folders and shared memory empty and of bounded size, with
only the named folders below them bound back read-only; own process, network, IPC and host name spaces, so no network
but an own loopback and no other process to see; no capabilities; no environment variable but those given; the system
calls that lead past this refused (`seccomp`). What is guaranteed to users is written in `docs/security.md`.
"""

from __future__ import annotations

import contextlib
import functools
import os
import shutil
import subprocess
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import aspectlib  # type: ignore[import-untyped]

from preflight_analysis.tracing import cgroup, seccomp, sockets

ROOT = "/run/preflight"
"""All that is ours, inside."""
LIBRARY = f"{ROOT}/lib"
"""Where the agents (as package `preflight_agents`) and aspectlib are, inside."""
SITE = f"{ROOT}/site"
"""The folder with `sitecustomize.py`, inside."""
TEMPORARY_BYTES = 64 << 20
"""Size of each writable file system inside: /tmp, /dev/shm, the home folder."""

PROCESSES = 512
"""How many processes and threads a run may have at once."""
MEMORY_BYTES = 4 << 30
"""How much memory all processes of a run may have together; half of the machine's, if that is less."""

_SECRET_FILES = ("/etc/shadow", "/etc/shadow-", "/etc/gshadow", "/etc/gshadow-", "/etc/sudoers")
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


@dataclass(frozen=True, slots=True)
class Agents:
    """Where our own code for the inside is: the package of agents, aspectlib, and the folder with `sitecustomize.py`.

    They are bound to `LIBRARY` and `SITE`.
    """

    library: Path
    aspectlib: Path
    site: Path


_AGENTS = Path(__file__).parent / "agents"
AGENTS = Agents(_AGENTS, Path(aspectlib.__file__).parent, _AGENTS)
"""The sources, as installed."""


@dataclass(frozen=True, slots=True)
class SandboxStatus:
    """Whether nodes can be run. `reason` is a sentence that says why not and what to do about it, `guarantees` what
    holds where they can, one sentence each."""

    works: bool
    reason: str | None = None
    guarantees: tuple[str, ...] = ()


@functools.lru_cache(maxsize=1)
def probe() -> SandboxStatus:
    """Try an empty run, once per process (`probe.cache_clear()` forgets the answer)."""
    program = shutil.which("bwrap")
    if program is None:
        return SandboxStatus(False, "bubblewrap is not installed: apt install bubblewrap")
    try:
        with prepared([shutil.which("true") or "/bin/true"], ()) as start:
            done = subprocess.run(
                start.command,
                stdin=subprocess.DEVNULL,
                capture_output=True,
                timeout=10,
                env={},
                check=False,
                cwd="/",
                pass_fds=start.descriptors,
            )
    except (OSError, subprocess.TimeoutExpired) as error:
        return SandboxStatus(False, f"bubblewrap cannot be run: {error}")
    if done.returncode == 0:
        return SandboxStatus(True, guarantees=_guarantees())
    said = done.stderr.decode(errors="replace").strip().splitlines()
    why = said[-1][:300] if said else f"exit code {done.returncode}"
    for switch, off, remedy in _USERNS_SWITCHES:
        try:
            if Path(switch).read_text().strip() == off:
                return SandboxStatus(False, f"user namespaces are switched off ({why}); needed: {remedy}")
        except OSError:
            continue
    return SandboxStatus(
        False, f"bubblewrap does not work here ({why}); in a container, user namespaces must be allowed"
    )


@dataclass(frozen=True, slots=True)
class Start:
    """A command line that runs something isolated, and the descriptors that it must inherit.

    `counting`: nothing outside binds the number of processes, the supervisor inside has to look after it.
    """

    command: list[str]
    descriptors: tuple[int, ...]
    counting: bool


@contextlib.contextmanager
def prepared(argv: Sequence[str], visible: Iterable[str], agents: Agents = AGENTS) -> Iterator[Start]:
    """The way to run `argv` isolated, once, until the end of the block. `visible` are paths below the masked folders to
    show, read-only. Raises `OSError` if there is none."""
    program = shutil.which("bwrap")
    if program is None:
        raise FileNotFoundError("bwrap")
    with contextlib.ExitStack() as at_end:
        options = _isolation(visible, agents)
        descriptors: tuple[int, ...] = ()
        calls = seccomp.open_program()
        if calls is not None:
            at_end.callback(os.close, calls)
            options += ["--seccomp", str(calls)]
            descriptors = (calls,)
        command = [program, *options, "--", *argv]
        place = cgroup.place()
        if place is not None:
            command = cgroup.entering(at_end.enter_context(cgroup.group(place, PROCESSES, most_memory())), command)
        yield Start(command, descriptors, counting=place is None and os.geteuid() == 0)


def most_memory() -> int:
    """How much a run may have on this machine, in bytes."""
    return min(MEMORY_BYTES, os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2)


def _guarantees() -> tuple[str, ...]:
    """What of docs/security.md depends on the machine, as it is here."""
    machine = seccomp.this_machine()
    calls = f"system calls filtered ({machine})" if machine else f"no filter of system calls for {os.uname().machine}"
    place = cgroup.place()
    if place is not None:
        count = f"at most {PROCESSES} processes, by a control group"
    elif os.geteuid() == 0:
        count = f"no limit of processes that binds root; a run is ended once it has more than {PROCESSES}"
    else:
        count = f"at most {PROCESSES} processes, by RLIMIT_NPROC"
    memory = f"a run is ended once it has more than {most_memory() / (1 << 30):.1f} GiB of memory"
    if place is not None and place.memory:
        memory += ", and gets no more by a control group"
    return ("files read-only, no network, own processes", calls, count, memory)


def masked(path: str) -> bool:
    """Whether `path` lies in what is hidden inside, unless it is bound back."""
    return any(_within(path, root) for root in _masks())


def shown(path: str, visible: Iterable[str]) -> bool:
    """Whether the host's file is the one that is seen inside, when `visible` is bound back."""
    return not masked(path) or any(_within(path, root) for root in visible)


def needs_binding(paths: Iterable[str]) -> list[str]:
    """Of `paths`, the existing ones that are hidden inside, each as given and resolved, outermost only.

    A folder that holds all of a masked one (a package path of `~`, say) is left out: it would show everything in it.
    """
    wanted: set[str] = set()
    for path in paths:
        if not path or not os.path.isabs(path):
            continue
        for form in (os.path.normpath(path), os.path.realpath(path)):
            too_much = any(_within(root, form) for root in (*_masks(), home()))
            if masked(form) and not too_much and os.path.lexists(form):
                wanted.add(form)
    kept: list[str] = []
    for path in sorted(wanted):
        if not any(_within(path, outer) for outer in kept):
            kept.append(path)
    return kept


def home() -> str:
    """The home folder inside: the user's own, but empty save for what was bound back."""
    found = os.path.realpath(os.path.expanduser("~"))
    return found if os.path.isdir(found) and found != "/" else "/tmp/home"  # noqa: S108


@functools.lru_cache(maxsize=8)
def _masks_for(home_folder: str) -> tuple[str, ...]:
    roots = {"/tmp", "/var/tmp", "/run", "/home", "/root", home_folder}  # noqa: S108
    existing = sorted({os.path.realpath(root) for root in roots if os.path.isdir(root)} - {"/"})
    return tuple(root for root in existing if not any(_within(root, o) for o in existing if o != root))


def _masks() -> tuple[str, ...]:
    return _masks_for(home())


def _within(path: str, folder: str) -> bool:
    return path == folder or path.startswith(folder.rstrip("/") + "/")


def _isolation(visible: Iterable[str], agents: Agents) -> list[str]:
    size = str(TEMPORARY_BYTES)
    options = ["--unshare-user", "--unshare-pid", "--unshare-net", "--unshare-ipc", "--unshare-uts"]
    options += ["--unshare-cgroup-try", "--hostname", "localhost", "--clearenv", "--die-with-parent", "--new-session"]
    options += ["--cap-drop", "ALL", "--ro-bind", "/", "/"]
    options += ["--dev", "/dev", "--size", size, "--tmpfs", "/dev/shm"]  # noqa: S108
    # Root in a container could else write through a fresh /proc, core_pattern for one.
    options += ["--proc", "/proc", "--ro-bind", "/proc/sys", "/proc/sys"]
    # bubblewrap's own first process: with its memory changed it would not end when the run does.
    options += ["--size", "4096", "--perms", "0555", "--tmpfs", "/proc/1", "--remount-ro", "/proc/1"]
    for root in _masks():
        options += ["--size", size, "--tmpfs", root]
    options += ["--dir", home(), "--chmod", "0700", home()]
    for path in _SECRET_FILES:
        if os.path.exists(path):
            options += ["--ro-bind", "/dev/null", path]
    bound = needs_binding(visible)
    for path in bound:
        options += ["--ro-bind", path, path]
    for path in sockets.reachable(bound, _masks()):
        options += ["--ro-bind", "/dev/null", path]
    options += ["--ro-bind", str(agents.library), LIBRARY + "/preflight_agents"]
    options += ["--ro-bind", str(agents.aspectlib), LIBRARY + "/aspectlib"]
    # Not the folder: as a source it has other modules, which would hide those of the same name.
    for name in ("sitecustomize.py", "__pycache__") if agents is not AGENTS else ("sitecustomize.py",):
        options += ["--ro-bind", str(agents.site / name), f"{SITE}/{name}"]
    return options
