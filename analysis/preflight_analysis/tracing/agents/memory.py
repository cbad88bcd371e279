"""How much memory the processes of the sandbox have together, where no control group counts it: what is theirs alone,
and what they share by files without a name, mappings, file systems in memory and buffers of sockets and pipes.

Sources: proc(5), `linux/sock_diag.h`, `linux/unix_diag.h`.
"""

from __future__ import annotations

import os
import re
import socket
import struct
from typing import Optional

_PAGE = os.sysconf("SC_PAGE_SIZE")
_SHARED_MAPPING = re.compile(
    r"^([0-9a-f]+)-([0-9a-f]+) ...s ([0-9a-f]+) (\S+ [0-9]+) +(?:/dev/zero|/memfd:.*) \(deleted\)$", re.MULTILINE
)
"""Of a file in memory that has no name anywhere: start, end, offset, device and inode."""
_UNIX_SOCKETS = struct.pack(
    "=IHHIIBBHIIIII", 40, 20, 0x301, 1, 0, socket.AF_UNIX, 0, 0, 0xFFFFFFFF, 0, 0x30, 0xFFFFFFFF, 0xFFFFFFFF
)
"""SOCK_DIAG_BY_FAMILY for all Unix sockets, with UDIAG_SHOW_RQLEN and UDIAG_SHOW_MEMINFO."""
_DIAG, _QUEUE, _MEMORY = 4, 4, 5
_FILLED = 212_992
"""What a socket that is not empty counts at least: the kernel's usual bound, as small messages take much more than
their bytes."""
_UNKNOWN_SOCKET = 1 << 20
"""What a socket counts at most where the kernel says no more than that it is there."""
_PIPE = 65536


def private(processes: list[int]) -> tuple[int, int]:
    """What processes have for themselves, in bytes, where what they share after a fork counts for each; and the size of
    all that they have mapped."""
    own = mapped = 0
    for process in processes:
        try:
            with open("/proc/%d/statm" % process) as file:
                size, resident, shared = map(int, file.read().split()[:3])
        except (OSError, ValueError):
            continue
        own += (resident - shared) * _PAGE
        mapped += size * _PAGE
    return own, mapped


def proportional(processes: list[int]) -> int:
    """The same where what several have counts once."""
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


def shared_mappings(processes: list[int]) -> dict[str, int]:
    """Bytes by what is mapped, whether or not a process has it in its tables now."""
    found: dict[str, int] = {}
    for process in processes:
        try:
            with open("/proc/%d/maps" % process, errors="surrogateescape") as file:
                text = file.read()
        except OSError:
            continue
        for start, end, offset, which in _SHARED_MAPPING.findall(text):
            reaches = int(offset, 16) + int(end, 16) - int(start, 16)
            found[which] = max(found.get(which, 0), reaches)
    return found


def own_file_systems() -> list[str]:
    """Where the file systems in memory are that can be written to."""
    found: dict[int, str] = {}
    try:
        with open("/proc/self/mountinfo", errors="surrogateescape") as file:
            for line in file:
                about, _, kind = line.partition(" - ")
                place = re.sub(r"\\([0-7]{3})", lambda code: chr(int(code[1], 8)), about.split(" ")[4])
                # What is said of a mount need not be so of what was mounted over it.
                try:
                    if kind.startswith("tmpfs ") and not os.statvfs(place).f_flag & os.ST_RDONLY:
                        found[os.stat(place).st_dev] = place
                except OSError:
                    continue  # of another user
    except OSError:
        pass
    return list(found.values())


def used(folder: str) -> int:
    """Bytes in the file system of a folder."""
    try:
        found = os.statvfs(folder)
    except OSError:
        return 0
    return (found.f_blocks - found.f_bfree) * found.f_frsize


def system_v() -> int:
    """Bytes in segments of System V's shared memory."""
    total = 0
    try:
        with open("/proc/sysvipc/shm") as file:
            place = file.readline().split().index("rss")
            for line in file:
                total += sum(map(int, line.split()[place : place + 2]))  # and what was swapped out
    except (OSError, ValueError):
        pass
    return total


def socket_buffers(seen: set[int], alone: bool) -> int:
    """Bytes in the sockets that were seen, by inode, or in all of the network name space if it is the sandbox's alone.
    Where the kernel does not say, a bound by how many were seen."""
    which = None if alone else seen
    try:
        return _unix_sockets(which) + sum(_queues(protocol, which) for protocol in ("tcp", "tcp6", "udp", "udp6"))
    except (OSError, struct.error):
        return len(seen) * min(_UNKNOWN_SOCKET, 2 * _most_buffered())


def _unix_sockets(which: Optional[set[int]]) -> int:
    total = 0
    with socket.socket(socket.AF_NETLINK, socket.SOCK_RAW, _DIAG) as asking:
        asking.send(_UNIX_SOCKETS)
        while True:
            answer = asking.recv(1 << 18)
            at = 0
            while at + 16 <= len(answer):
                length, kind = struct.unpack_from("=IH", answer, at)
                if kind == 3:  # NLMSG_DONE
                    return total
                if kind == 2 or length < 16:  # NLMSG_ERROR
                    raise OSError("no answer about sockets")
                if which is None or struct.unpack_from("=I", answer, at + 20)[0] in which:
                    total += _of_unix_socket(answer[at + 32 : at + length])
                at += (length + 3) & ~3


def _of_unix_socket(attributes: bytes) -> int:
    queued = sent = at = 0
    while at + 4 <= len(attributes):
        length, kind = struct.unpack_from("=HH", attributes, at)
        if length < 4:
            break
        if kind == _QUEUE:
            queued = struct.unpack_from("=I", attributes, at + 4)[0]
        elif kind == _MEMORY:
            received, _, sent = struct.unpack_from("=III", attributes, at + 4)
            sent += received
        at += (length + 3) & ~3
    # What a socket sent counts there, as long as that is open; what was sent to it may be of one that is closed.
    return max(sent, max(queued, _FILLED) if queued else 0)


def _queues(protocol: str, which: Optional[set[int]]) -> int:
    total = 0
    try:
        with open("/proc/net/" + protocol) as file:
            for line in file.readlines()[1:]:
                fields = line.split()
                sent, _, received = fields[4].partition(":")
                if which is None or int(fields[9]) in which:
                    total += int(sent, 16) + int(received, 16)
    except OSError:
        pass  # no IPv6
    return total


def _most_buffered() -> int:
    try:
        with open("/proc/sys/net/core/wmem_max") as file:
            return int(file.read())
    except (OSError, ValueError):
        return _UNKNOWN_SOCKET


def pipe_buffers(pipes: int) -> int:
    """A bound for the bytes in so many pipes."""
    return pipes * _PIPE


def shared_on_machine() -> int:
    """Bytes of all shared memory and files in memory on this machine."""
    try:
        with open("/proc/meminfo") as file:
            for line in file:
                if line.startswith("Shmem:"):
                    return int(line.split()[1]) * 1024
    except (OSError, ValueError):
        pass
    return 0
