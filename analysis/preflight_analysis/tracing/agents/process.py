"""The processes of the sandbox: how one becomes the node, how it ended, and what the kernel counts of it."""

from __future__ import annotations

import os
import resource
import select
import signal
import time
from typing import Any, Optional


def limit(limits: dict[str, int]) -> None:
    """Set limits of resources by name (`NPROC`), as far as the hard ones of this process allow."""
    for name, wanted in limits.items():
        which = getattr(resource, "RLIMIT_" + name)
        hard = resource.getrlimit(which)[1]
        value = wanted if hard == resource.RLIM_INFINITY else min(wanted, hard)
        resource.setrlimit(which, (value, value))


def _first_to_go() -> None:
    """Where the machine's memory ends all the same, the kernel ends us and not the user's programs."""
    try:
        with open("/proc/self/oom_score_adj", "w") as file:
            file.write("1000")
    except OSError:
        pass


def become(job: dict[str, Any], failure: int, output: Optional[int]) -> None:
    """In the child: become the node or command. Returns never; what went wrong is written to the pipe `failure`."""
    try:
        os.setsid()
        _first_to_go()
        null = os.open(os.devnull, os.O_RDWR)
        os.dup2(null, 0)
        os.dup2(null if output is None else output, 1)
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # Python ignores it, and what is ignored stays so over an exec
        os.chdir(job["cwd"])
        limit(job["rlimits"])
        os.execve(job["argv"][0], job["argv"], job["env"])  # noqa: S606
    except OSError as error:
        os.write(failure, str(error.strerror).encode())
    finally:
        os._exit(127)


def host_is_gone() -> bool:
    """Whether nobody reads our output any more."""
    poll = select.poll()
    poll.register(1, 0)
    return bool(poll.poll(0))


def exit_code(pid: int) -> Optional[int]:
    """The exit code of a child that has ended, minus the signal if one ended it."""
    done, status = os.waitpid(pid, os.WNOHANG)
    if done != pid:
        return None
    return -os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)


def cpu_seconds(pid: int) -> float:
    """The processor time that a process has used; 0 where it is gone."""
    try:
        with open(f"/proc/{pid}/stat") as stat:
            fields = stat.read().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    except (OSError, IndexError, ValueError):
        return 0.0


def queued_seconds(pid: int) -> float:
    """How long the main thread of a process has waited for a processor; 0 where the kernel does not count it."""
    try:
        with open(f"/proc/{pid}/schedstat") as stat:
            return int(stat.read().split()[1]) * 1e-9
    except (OSError, IndexError, ValueError):
        return 0.0


def own_seconds(pid: int) -> float:
    """A clock that stands still while the main thread of a process waits for a processor: what is allowed to take so
    long does not depend on what else the machine does."""
    return time.monotonic() - queued_seconds(pid)


def shared_objects(pid: int) -> list[str]:
    """The files that a process has mapped, sorted; none where it is gone."""
    try:
        with open(f"/proc/{pid}/maps") as maps:
            paths = {line.rstrip("\n").partition("/")[2] for line in maps if "/" in line}
    except OSError:
        return []
    return sorted("/" + path for path in paths if not path.endswith("(deleted)"))
