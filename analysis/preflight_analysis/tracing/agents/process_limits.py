"""Which processes there are in the sandbox, and how many, with how much memory and disk where nothing outside limits
them, and how much of what the user has only so many of."""

from __future__ import annotations

import os
import stat
import time
from typing import Any, Optional

from . import memory

_FORKED = "/proc/loadavg"
"""Its last field is the last process number given in this pid namespace (proc(5))."""
_INTERVAL = 0.1
"""Seconds between looks at memory and disk."""


class Open:
    """What processes have open, each thing once, as far as it matters here."""

    def __init__(self, processes: list[int]) -> None:
        self.nameless: dict[tuple[int, int], int] = {}
        """Bytes of files that have no name any more, by device and inode."""
        self.sockets: set[int] = set()
        self.pipes: set[int] = set()
        self.watchers = self.watches = 0
        """Instances of inotify, and the files and folders that they watch; those that a process inherited count for
        it, too."""
        self.in_flight = False
        """Whether descriptors wait in a socket for somebody to take them: nobody has them open meanwhile."""
        for process in processes:
            folder = "/proc/%d/fd/" % process
            try:
                names = os.listdir(folder)
            except OSError:
                continue
            for name in names:
                try:
                    self._add(process, name, os.stat(folder + name))
                except OSError:
                    continue

    def _add(self, process: int, name: str, status: os.stat_result) -> None:
        kind = stat.S_IFMT(status.st_mode)
        if kind == stat.S_IFREG and not status.st_nlink:
            self.nameless[status.st_dev, status.st_ino] = status.st_blocks * 512
        elif kind == stat.S_IFSOCK:
            self.sockets.add(status.st_ino)
            self.in_flight = self.in_flight or any(
                line.startswith("scm_fds:") and line.split()[1] != "0" for line in _about(process, name)
            )
        elif kind == stat.S_IFIFO:
            self.pipes.add(status.st_ino)
        elif kind == 0 and os.readlink("/proc/%d/fd/%s" % (process, name)) == "anon_inode:inotify":
            self.watchers += 1
            self.watches += sum(line.startswith("inotify") for line in _about(process, name))


def _about(process: int, name: str) -> list[str]:
    with open("/proc/%d/fdinfo/%s" % (process, name)) as file:
        return file.readlines()


class ProcessLimits:
    """Looks at all processes of the sandbox, each as often as it is worth. Of the job: `most_processes` and
    `most_memory`, None for no limit; `most_disk`; `most_watchers` and `most_watches`. `alone`: there are no others to
    be seen. `written` are the folders that the sandbox may write to, where nothing outside bounds them: file systems
    of its own if it is alone, else folders on the host's disk."""

    def __init__(self, job: dict[str, Any]) -> None:
        self.most_processes: Optional[int] = job["most_processes"]
        self.most_memory: Optional[int] = job["most_memory"]
        self.most_disk: int = job["most_disk"]
        self.most_watchers: int = job["most_watchers"]
        self.most_watches: int = job["most_watches"]
        self.alone: bool = job["alone"]
        self.folders: list[str] = job["written"]
        self.file_systems = memory.own_file_systems() if self.alone else []
        self.files_before = sum(map(memory.used, self.file_systems))
        self.shared_before = memory.shared_on_machine()
        self.next_look = 0.0

    def exceeded(self) -> str:
        """`crowded` if there are too many processes and threads, `heavy` if they have too much memory, `full` if they
        wrote too much, `watching` if they watch too many files, else ""."""
        if self.most_processes is not None and self._crowded(self.most_processes):
            return "crowded"
        now = time.monotonic()
        if now < self.next_look:
            return ""
        self.next_look = now + _INTERVAL
        processes = self._processes()
        opened = Open(processes)
        if self.most_memory is not None and self._heavy(self.most_memory, processes, opened):
            return "heavy"
        if self.folders and self._written(opened) > self.most_disk:
            return "full"
        if opened.watchers > self.most_watchers or opened.watches > self.most_watches:
            return "watching"
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

    def _heavy(self, most: int, processes: list[int], opened: Open) -> bool:
        """What costs more to find out is looked at only where it could matter."""
        devices = self._devices()
        files = {key: size for key, size in opened.nameless.items() if key[0] not in devices}
        private, mapped = memory.private(processes)
        shared = sum(files.values()) + memory.pipe_buffers(len(opened.pipes))
        shared += memory.socket_buffers(opened.sockets, self.alone)
        if self.alone:
            shared += sum(map(memory.used, self.file_systems)) - self.files_before + memory.system_v()
        if mapped > most:
            known = {"%02x:%02x %d" % (os.major(device), os.minor(device), inode) for device, inode in files}
            mappings = memory.shared_mappings(processes)
            shared += sum(size for key, size in mappings.items() if key not in known)
        if private + shared > most and memory.proportional(processes) + shared > most:
            return True
        # What is in no process's hands is seen in the sum of the machine alone.
        return opened.in_flight and private + memory.shared_on_machine() - self.shared_before > most

    def _devices(self) -> set[int]:
        """Those of the folders that it may write to and of its own file systems."""
        found = set()
        for folder in (*self.folders, *self.file_systems):
            try:
                found.add(os.stat(folder).st_dev)
            except OSError:
                continue
        return found

    def _written(self, opened: Open) -> int:
        """Bytes on disk, files without a name that somebody still holds among them."""
        if self.alone:
            return sum(map(memory.used, self.folders))
        devices = self._devices()
        nameless = sum(size for (device, _), size in opened.nameless.items() if device in devices)
        return sum(map(_size, self.folders)) + nameless


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
