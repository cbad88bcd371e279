"""Which processes there are in the sandbox, and how many, with how much memory and disk where nothing outside limits
them."""

from __future__ import annotations

import os
import stat
import time
from typing import Optional

_FORKED = "/proc/loadavg"
"""Its last field is the last process number given in this pid namespace (proc(5))."""
_INTERVAL = 0.1
"""Seconds between looks at memory and disk."""


class ProcessLimits:
    """Looks at all processes of the sandbox, each as often as it is worth. A limit of None: none. `alone`: there are no
    others to be seen. `folders` are those that the sandbox may write to, where nothing outside bounds them: file
    systems of its own if it is alone, else folders on the host's disk."""

    def __init__(
        self,
        most_processes: Optional[int],
        most_memory: Optional[int],
        alone: bool,
        folders: list[str],
        most_disk: int,
    ) -> None:
        self.most_processes = most_processes
        self.most_memory = most_memory
        self.most_disk = most_disk
        self.alone = alone
        self.folders = folders
        self.next_look = 0.0

    def exceeded(self) -> str:
        """`crowded` if there are too many processes and threads, `heavy` if they have too much memory, `full` if they
        wrote too much, else ""."""
        if self.most_processes is not None and self._crowded(self.most_processes):
            return "crowded"
        now = time.monotonic()
        if now >= self.next_look:
            self.next_look = now + _INTERVAL
            if self.most_memory is not None and self._heavy(self.most_memory):
                return "heavy"
            if self.folders and self._written() > self.most_disk:
                return "full"
        return ""

    def left_behind(self, ours: Optional[int]) -> list[int]:
        """The processes beside our own, those that it descends from and the one that is `ours` too. firejail has it
        started by the user's shell, and not every shell gives way to the last program that it starts."""
        above = _ancestors(os.getpid()) if self.alone else [os.getppid()]
        return sorted(process for process in self._processes() if process not in (*above, os.getpid(), ours))

    def _processes(self) -> list[int]:
        return everybody() if self.alone else descendants(os.getppid())

    def _crowded(self, most: int) -> bool:
        """Cheap as long as not so many have ever been started."""
        try:
            with open(_FORKED) as file:
                if int(file.read().split()[-1]) <= most:
                    return False
        except (OSError, ValueError, IndexError):
            pass
        count = 0
        for process in self._processes():
            count += 1
            if count > most:
                return True
            try:
                count += len(os.listdir("/proc/%d/task" % process)) - 1
            except OSError:
                continue
        return count > most

    def _heavy(self, most: int) -> bool:
        """What processes share after a fork counts once; that is looked at only if it would be too much counted
        twice."""
        page = os.sysconf("SC_PAGE_SIZE")
        total = 0
        processes = self._processes()
        for process in processes:
            try:
                with open("/proc/%d/statm" % process) as file:
                    fields = file.read().split()
                total += (int(fields[1]) - int(fields[2])) * page
            except (OSError, ValueError, IndexError):
                continue
        return total > most and _proportional(processes) > most

    def _written(self) -> int:
        """Bytes on disk, files without a name that somebody still holds among them."""
        total = sum(map(_used if self.alone else _size, self.folders))
        nameless = {}
        for process in self._processes():
            opened = "/proc/%d/fd" % process
            try:
                names = os.listdir(opened)
            except OSError:
                continue
            for name in names:
                try:
                    found = os.stat(opened + "/" + name)
                except OSError:
                    continue
                if stat.S_ISREG(found.st_mode) and not found.st_nlink:
                    nameless[found.st_dev, found.st_ino] = found.st_blocks * 512
        return total + sum(nameless.values())


def everybody() -> list[int]:
    """All processes that can be seen."""
    return [int(name) for name in os.listdir("/proc") if name.isdigit()]


def _ancestors(process: int) -> list[int]:
    """Those that can be seen, the nearest first."""
    found: list[int] = []
    while process > 1:
        try:
            with open("/proc/%d/stat" % process) as file:
                process = int(file.read().rpartition(")")[2].split()[1])
        except (OSError, ValueError, IndexError):
            process = 1  # the first hides from us with bubblewrap, and is the parent of whoever lost theirs
        found.append(process)
    return found


def descendants(ancestor: int) -> list[int]:
    """A process and those that descend from it. Those that lost their parent were adopted by the ancestor."""
    found = [ancestor]
    for process in found:
        try:
            for thread in os.listdir("/proc/%d/task" % process):
                with open("/proc/%d/task/%s/children" % (process, thread)) as file:
                    found += [int(child) for child in file.read().split()]
        except OSError:
            continue
    return found


def _used(folder: str) -> int:
    try:
        found = os.statvfs(folder)
    except OSError:
        return 0
    return (found.f_blocks - found.f_bfree) * found.f_frsize


def _size(folder: str) -> int:
    total, waiting = 0, [folder]
    while waiting:
        try:
            with os.scandir(waiting.pop()) as entries:
                for entry in entries:
                    total += entry.stat(follow_symlinks=False).st_blocks * 512
                    if entry.is_dir(follow_symlinks=False):
                        waiting.append(entry.path)
        except OSError:
            continue
    return total


def _proportional(processes: list[int]) -> int:
    total = 0
    for process in processes:
        try:
            with open("/proc/%d/smaps_rollup" % process) as file:
                for line in file:
                    if line.startswith("Pss_Anon:"):
                        total += int(line.split()[1]) * 1024
        except (OSError, ValueError, IndexError):
            continue
    return total
