"""Which processes there are in the sandbox, and how many and how much memory where nothing outside limits them."""

from __future__ import annotations

import os
import time
from typing import Optional

_FORKED = "/proc/loadavg"
"""Its last field is the last process number given in this pid namespace (proc(5))."""
_MEMORY_INTERVAL = 0.1
"""Seconds between looks at the memory."""


def left_behind(ours: Optional[int]) -> list[int]:
    """The processes beside our own, bubblewrap's and the one that is `ours` too."""
    return sorted(int(name) for name in _processes() if int(name) not in (1, os.getpid(), ours))


class Census:
    """Looks at all processes of the sandbox, each as often as it is worth. None: no limit."""

    def __init__(self, most_processes: Optional[int], most_memory: Optional[int]) -> None:
        self.most_processes = most_processes
        self.most_memory = most_memory
        self.next_memory = 0.0

    def exceeded(self) -> str:
        """`crowded` if there are too many processes and threads, `heavy` if they have too much memory, else ""."""
        if self.most_processes is not None and _crowded(self.most_processes):
            return "crowded"
        now = time.monotonic()
        if self.most_memory is not None and now >= self.next_memory:
            self.next_memory = now + _MEMORY_INTERVAL
            if _heavy(self.most_memory):
                return "heavy"
        return ""


def _processes() -> list[str]:
    return [name for name in os.listdir("/proc") if name.isdigit()]


def _crowded(most: int) -> bool:
    """Cheap as long as not so many have ever been started."""
    try:
        with open(_FORKED) as file:
            if int(file.read().split()[-1]) <= most:
                return False
    except (OSError, ValueError, IndexError):
        pass
    count = 0
    for name in _processes():
        count += 1
        if count > most:
            return True
        try:
            count += len(os.listdir("/proc/%s/task" % name)) - 1
        except OSError:
            continue
    return count > most


def _heavy(most: int) -> bool:
    """What processes share after a fork counts once; that is looked at only if it would be too much counted twice."""
    page = os.sysconf("SC_PAGE_SIZE")
    total = 0
    for name in _processes():
        try:
            with open("/proc/%s/statm" % name) as file:
                fields = file.read().split()
            total += (int(fields[1]) - int(fields[2])) * page
        except (OSError, ValueError, IndexError):
            continue
    return total > most and _proportional() > most


def _proportional() -> int:
    total = 0
    for name in _processes():
        try:
            with open("/proc/%s/smaps_rollup" % name) as file:
                for line in file:
                    if line.startswith("Pss_Anon:"):
                        total += int(line.split()[1]) * 1024
        except (OSError, ValueError, IndexError):
            continue
    return total
