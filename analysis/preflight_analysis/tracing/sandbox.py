"""The sandbox in which other people's code runs: which of the ways to isolate works here, and what it keeps from whom.

There is no other way to run anything: where `probe` says no, nothing runs. The ways are tried in order, the one that
isolates best first, and each has to show that it works with an empty run. All hide the same: `/tmp`, `/run`, the home
folders and shared memory are empty inside, with only the named folders below them shown, read-only; there is no network
but an own loopback, and no environment variable but those given. What is guaranteed to users is written in
`docs/security.md`.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from pathlib import Path

from preflight_analysis.dataclass import dataclass
from preflight_analysis.tracing import bubblewrap, cgroup, firejail, interior, landlock, seccomp
from preflight_analysis.tracing.backend import AGENTS, Agents, Backend, Isolated, View, Visible
from preflight_analysis.tracing.once_per_process import once_per_process

PROCESSES = 512
"""How many processes and threads a run may have at once."""
MEMORY_BYTES = 4 << 30
"""How much memory all processes of a run may have together; half of the machine's, if that is less."""

BACKENDS = (bubblewrap.BACKEND, firejail.BACKEND, landlock.BACKEND)
"""The ways to isolate, in the order in which they are tried."""
CHOICE = "ROS_PREFLIGHT_SANDBOX"
"""The environment variable that names the only one to try; `auto` or nothing for all."""

_SECRET_FILES = ("/etc/shadow", "/etc/shadow-", "/etc/gshadow", "/etc/gshadow-", "/etc/sudoers")


@dataclass(frozen=True, slots=True)
class SandboxStatus:
    """Whether nodes can be run, and by which `backend`. `reason` is a sentence that says why not and what to do about
    it, `guarantees` what holds where they can, one sentence each. `narrow` and `replaces` are as in `Backend`."""

    works: bool
    reason: str | None = None
    guarantees: tuple[str, ...] = ()
    backend: str | None = None
    narrow: bool = False
    replaces: bool = False


@dataclass(frozen=True, slots=True)
class Start:
    """How to run something isolated: `command` is that of `isolated`, put into the control groups `groups`, as far as
    there are some.

    `counting`: nothing outside binds the number of processes, the supervisor inside has to look after it.
    """

    command: list[str]
    counting: bool
    isolated: Isolated
    groups: Sequence[Path]


def probe() -> SandboxStatus:
    """Try empty runs, once per process and choice (`forget` forgets the answers)."""
    return _probed(os.environ.get(CHOICE, ""))


def forget() -> None:
    """Try again at the next `probe`."""
    _probed.cache_clear()


@once_per_process
def _probed(choice: str) -> SandboxStatus:
    wanted = [each for each in BACKENDS if choice in ("", "auto", each.name)]
    if not wanted:
        known = ", ".join(each.name for each in BACKENDS)
        return SandboxStatus(False, f"{CHOICE} is {choice!r}, which is none of auto, {known}")
    reasons = []
    for each in wanted:
        reason = _tried(each)
        if reason is None:
            return SandboxStatus(
                True, guarantees=_guarantees(each), backend=each.name, narrow=each.narrow, replaces=each.replaces
            )
        reasons.append(reason)
    return SandboxStatus(False, "; ".join(reasons))


def _tried(chosen: Backend) -> str | None:
    """Why a backend does not work here."""
    try:
        with _prepared(chosen, [shutil.which("true") or "/bin/true"], Visible(), AGENTS) as start:
            done = subprocess.run(
                start.command,
                stdin=subprocess.DEVNULL,
                capture_output=True,
                timeout=10,
                env={},
                check=False,
                cwd="/",
                pass_fds=start.isolated.descriptors,
            )
    except FileNotFoundError as error:
        return str(error)
    except (OSError, subprocess.TimeoutExpired) as error:
        return f"{chosen.name} cannot be run: {error}"
    if done.returncode == 0:
        return None
    said = done.stderr.decode(errors="replace").strip().splitlines()
    return chosen.explained(said[-1][:300] if said else f"exit code {done.returncode}")


@contextlib.contextmanager
def prepared(argv: Sequence[str], visible: Visible, agents: Agents = AGENTS) -> Iterator[Start]:
    """The way to run `argv` isolated, once, until the end of the block. What is `visible` can only be read. Raises
    `OSError` if there is none."""
    status = probe()
    chosen = next((each for each in BACKENDS if each.name == status.backend), None)
    if chosen is None:
        raise FileNotFoundError(status.reason)
    with _prepared(chosen, argv, visible, agents) as start:
        yield start


@contextlib.contextmanager
def _prepared(chosen: Backend, argv: Sequence[str], visible: Visible, agents: Agents) -> Iterator[Start]:
    secrets = tuple(path for path in _SECRET_FILES if os.path.exists(path))
    view = View(
        interior.mask_roots(),
        secrets,
        tuple(interior.needs_binding(visible.paths)),
        interior.home(),
        agents,
        visible.repositories,
        visible.texts,
    )
    with chosen.isolated(argv, view) as found, contextlib.ExitStack() as at_end:
        places = cgroup.places()
        groups = at_end.enter_context(cgroup.groups(places, PROCESSES, most_memory()))
        counting = not any(each.processes for each in places) and (os.geteuid() == 0 or not found.own_users)
        yield Start(cgroup.entering(groups, found.command), counting, found, groups)


def most_memory() -> int:
    """How much a run may have on this machine, in bytes."""
    return min(MEMORY_BYTES, os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2)


def _guarantees(chosen: Backend) -> tuple[str, ...]:
    """What of docs/security.md depends on the machine, as it is here."""
    machine = seccomp.this_machine()
    calls = f"system calls filtered ({machine})" if machine else f"no filter of system calls for {os.uname().machine}"
    places = cgroup.places()
    if any(each.processes for each in places):
        count = f"at most {PROCESSES} processes, by a control group"
    elif os.geteuid() == 0 or chosen.name != "bubblewrap":
        count = f"no limit of processes that binds; a run is ended once it has more than {PROCESSES}"
    else:
        count = f"at most {PROCESSES} processes, by RLIMIT_NPROC"
    memory = f"a run is ended once it has more than {most_memory() / (1 << 30):.1f} GiB of memory"
    if any(each.memory for each in places):
        memory += ", and gets no more by a control group"
    return (*chosen.guarantees, calls, count, memory)
