"""The system calls that a node may not make, as a filter that the kernel applies (seccomp, classic BPF).

A deny list, since nodes are arbitrary programs: what reaches other processes or the kernel past the name spaces, what
makes new name spaces or mounts, what talks through sockets that a network name space does not confine. Everything
refused fails as it would without the right to it (`EPERM`), or as on a kernel without it (`ENOSYS`), so that libraries
take their other way. A call by another processor's numbers (32-bit programs on a 64-bit kernel) ends the process.

Numbers are from the kernel's `arch/x86/entry/syscalls/syscall_64.tbl` and `scripts/syscall.tbl` (arm64), the data
that the program sees and its answers from `linux/seccomp.h`.
"""

from __future__ import annotations

import errno
import functools
import os
from collections.abc import Callable, Sequence

from preflight_analysis.dataclass import dataclass
from preflight_analysis.tracing.bpf import Instruction, Line, any_bit, assemble, at_least, equal, give, jump, load, mask

_ALLOW = 0x7FFF0000
_KILL = 0x80000000
_ERRNO = 0x00050000
_ASK = 0x7FC00000

_NUMBER, _ARCHITECTURE, _ARGUMENTS = 0, 4, 16
"""Offsets in `struct seccomp_data`; of an argument the lower half comes first on both processors."""

_MACHINES = {"x86_64": (0, 0xC000003E), "aarch64": (1, 0xC00000B7)}
"""The column in the tables below, and the kernel's AUDIT_ARCH_*."""
_X32 = 0x40000000
"""x86-64: the bit of the numbers of the x32 ABI, which has doubles of most calls."""

_REFUSED: dict[str, tuple[int | None, int | None]] = {
    # Other processes: their memory, descriptors and registers.
    "ptrace": (101, 117),
    "process_vm_readv": (310, 270),
    "process_vm_writev": (311, 271),
    "kcmp": (312, 272),
    "pidfd_getfd": (438, 438),
    # The kernel's key rings belong to no name space.
    "add_key": (248, 217),
    "request_key": (249, 218),
    "keyctl": (250, 219),
    # Name spaces and mounts; clone and unshare are looked at below.
    "setns": (308, 268),
    "mount": (165, 40),
    "umount2": (166, 39),
    "pivot_root": (155, 41),
    "chroot": (161, 51),
    "open_tree": (428, 428),
    "open_tree_attr": (467, 467),
    "move_mount": (429, 429),
    "fsopen": (430, 430),
    "fsconfig": (431, 431),
    "fsmount": (432, 432),
    "fspick": (433, 433),
    "mount_setattr": (442, 442),
    # Files by handle, past every mask over them.
    "open_by_handle_at": (304, 265),
    # Programs in the kernel, its events, and a way to stop it in the middle of a copy.
    "bpf": (321, 280),
    "perf_event_open": (298, 241),
    "userfaultfd": (323, 282),
    "fanotify_init": (300, 262),
    "init_module": (175, 105),
    "finit_module": (313, 273),
    "delete_module": (176, 106),
    "kexec_load": (246, 104),
    "kexec_file_load": (320, 294),
    "lookup_dcookie": (212, 18),
    "nfsservctl": (180, 42),
    "syslog": (103, 116),
    # The machine as a whole.
    "reboot": (169, 142),
    "swapon": (167, 224),
    "swapoff": (168, 225),
    "settimeofday": (164, 170),
    "clock_settime": (227, 112),
    "clock_adjtime": (305, 266),
    "adjtimex": (159, 171),
    "sethostname": (170, 161),
    "setdomainname": (171, 162),
    "acct": (163, 89),
    "quotactl": (179, 60),
    "quotactl_fd": (443, 443),
    "vhangup": (153, 58),
    "iopl": (172, None),
    "ioperm": (173, None),
    "modify_ldt": (154, None),
}
_UNKNOWN: dict[str, tuple[int | None, int | None]] = {
    # Its flags lie in memory, which no filter can read; the C libraries then use clone.
    "clone3": (435, 435),
    # Does other calls' work where no filter looks.
    "io_uring_setup": (425, 425),
    "io_uring_enter": (426, 426),
    "io_uring_register": (427, 427),
}

_NEW_NAMESPACES = 0x7E020000
"""CLONE_NEWNS, NEWCGROUP, NEWUTS, NEWIPC, NEWUSER, NEWPID, NEWNET."""
_CLONE_NEWTIME = 0x80
"""Not in clone, where these bits are the signal at the end."""
_TIOCSTI, _TIOCLINUX = 0x5412, 0x541C
"""Input put into a terminal, as if typed."""
_CONTROL_TYPES = (0x5400, 0x8900)
"""The types of the controls (`ioctl`) that everything but a file has: terminals, pipes, timers and sockets."""
_CONTROLS = (2, 0x80086601, 0x801C581F, 0xC020660B, 0x80045200)
"""FIGETBSZ, FS_IOC_GETFLAGS, FS_IOC_FSGETXATTR, FS_IOC_FIEMAP and RNDGETENTCNT, which only ask. What changes a file's
flags, version or keys needs no more than to have it open for reading, in each file system by numbers of its own."""
_F_SETLEASE, _F_NOTIFY, _F_SETDELEG = 1024, 1026, 1040
"""Have the host's programs wait until the holder of a file lets it go; signal what becomes of a folder."""
_FAMILIES = (0, 1, 2, 10, 16)
"""AF_UNSPEC, UNIX, INET, INET6, and NETLINK, by which the C library lists interfaces. Of the others some are not
confined by a network name space: AF_VSOCK leads from a virtual machine to its host."""
_PERSONALITIES = (0, 0xFFFFFFFF)
"""The usual one, and the question which it is."""


@dataclass(frozen=True, slots=True)
class _Argument:
    """A call that depends on the lower half of one of its arguments: what the tests that hold mean, and what else."""

    numbers: tuple[int, int]
    index: int
    test: Callable[[int, str], Instruction]
    values: Sequence[int]
    holds: int
    otherwise: int


_EPERM = _ERRNO | errno.EPERM
_LOOKED_AT = (
    _Argument((56, 220), 0, any_bit, (_NEW_NAMESPACES,), _EPERM, _ALLOW),  # clone
    _Argument((272, 97), 0, any_bit, (_NEW_NAMESPACES | _CLONE_NEWTIME,), _EPERM, _ALLOW),  # unshare
    _Argument((72, 25), 1, equal, (_F_SETLEASE, _F_NOTIFY, _F_SETDELEG), _EPERM, _ALLOW),  # fcntl
    _Argument((41, 198), 0, equal, _FAMILIES, _ALLOW, _ERRNO | errno.EAFNOSUPPORT),  # socket
    _Argument((135, 92), 0, equal, _PERSONALITIES, _ALLOW, _EPERM),  # personality
)

# Where processes, IPC and network are the host's (no name spaces of their own), besides all of the above.
_REFUSED_SHARED: dict[str, tuple[int | None, int | None]] = {
    # Landlock looks at what is opened, not at a file's mode, owner, times and attributes; nor, at first, at its length.
    "chmod": (90, None),
    "fchmod": (91, 52),
    "fchmodat": (268, 53),
    "fchmodat2": (452, 452),
    "chown": (92, None),
    "fchown": (93, 55),
    "lchown": (94, None),
    "fchownat": (260, 54),
    "utime": (132, None),
    "utimes": (235, None),
    "futimesat": (261, None),
    "utimensat": (280, 88),
    "setxattr": (188, 5),
    "lsetxattr": (189, 6),
    "fsetxattr": (190, 7),
    "removexattr": (197, 14),
    "lremovexattr": (198, 15),
    "fremovexattr": (199, 16),
    "setxattrat": (463, 463),
    "removexattrat": (466, 466),
    "file_setattr": (469, 469),
    "truncate": (76, 45),
    # Memory, semaphores and queues that have a name for all.
    "shmget": (29, 194),
    "shmat": (30, 196),
    "shmctl": (31, 195),
    "semget": (64, 190),
    "semop": (65, 193),
    "semctl": (66, 191),
    "semtimedop": (220, 192),
    "msgget": (68, 186),
    "msgsnd": (69, 189),
    "msgrcv": (70, 188),
    "msgctl": (71, 187),
    "mq_open": (240, 180),
    "mq_unlink": (241, 181),
    # What changes other processes in ways that nobody needs to change its own.
    "pidfd_send_signal": (424, 424),
    "setpriority": (141, 140),
    "ioprio_set": (251, 30),
    "migrate_pages": (256, 238),
    "move_pages": (279, 239),
    "process_madvise": (440, 440),
    "process_mrelease": (448, 448),
}
_ASKED = {
    "connect": (42, 203),
    "bind": (49, 200),
    "listen": (50, 201),
    "kill": (62, 129),
    "tkill": (200, 130),
    "tgkill": (234, 131),
    "rt_sigqueueinfo": (129, 138),
    "rt_tgsigqueueinfo": (297, 240),
    "sched_setparam": (142, 118),
    "sched_setscheduler": (144, 119),
    "sched_setaffinity": (203, 122),
    "sched_setattr": (314, 274),
    "prlimit64": (302, 261),
}
"""What the process that holds the filter's listener decides (`landlock_launcher`): where to, or whom."""
_OPENAT2 = (437, 437)
_OPENS = (((2, None), 1), ((257, 56), 2))
"""open, openat, and which argument has the flags."""
_ACCESS_MODE_AND_TRUNCATE, _TRUNCATE = 0o1003, 0o1000
"""O_TRUNC empties a file that is opened for reading, too, which Landlock does not see before its version 3."""
_CONTROL = (16, 29)
_SOCKET, _SOCKETPAIR = (41, 198), (53, 199)
_MSG_FASTOPEN = 0x20000000
_SENDS = (((44, 206), 3), ((46, 211), 2), ((307, 269), 3))
"""sendto, sendmsg, sendmmsg, and which argument has the flags: with one of them TCP connects in passing."""
_F_SETOWN, _F_SETOWN_EX, _FIOSETOWN, _SIOCSPGRP = 8, 15, 0x8901, 0x8902
"""Whom the kernel signals when something can be read."""
_STREAM, _RAW, _SEQPACKET, _TYPE = 1, 3, 5, 0xF
_TCP = 6
_SOCKET_DIAGNOSIS = 4
"""Of netlink: how much is in a socket, for who counts memory. No other family has streams of this number."""
_AF_UNIX, _AF_NETLINK = 1, 16


@functools.lru_cache(maxsize=4)
def program(machine: str, shared: bool = False) -> bytes | None:
    """The filter for a processor (`os.uname().machine`) as an array of `struct sock_filter`, None where none is known.
    `shared`: the one for processes that share the host's name spaces. It needs a listener that answers what `asked`
    says.

    The order does not matter for speed: since Linux 5.11 the kernel remembers which calls are always allowed.
    """
    if machine not in _MACHINES:
        return None
    column, architecture = _MACHINES[machine]
    code: list[Line] = [load(_ARCHITECTURE), equal(architecture, then="ours"), give(_KILL), "ours", load(_NUMBER)]
    if machine == "x86_64":
        code += [at_least(_X32, otherwise="native"), give(_KILL), "native"]
    for calls, answer in ((_REFUSED, _EPERM), (_UNKNOWN, _ERRNO | errno.ENOSYS)):
        for numbers in calls.values():
            code += _answered(numbers[column], answer)
    if shared:
        code += _shared(column)
    code += _controls(column)
    for call in _LOOKED_AT:
        code += [
            equal(call.numbers[column], otherwise="other call"),
            load(_argument(call.index)),
            *(call.test(value, "holds") for value in call.values),
            give(call.otherwise),
            "holds",
            give(call.holds),
            "other call",
        ]
    code.append(give(_ALLOW))
    return assemble(code)


def _argument(index: int) -> int:
    """Where the lower half of an argument is."""
    return _ARGUMENTS + 8 * index


def _answered(number: int | None, answer: int) -> list[Line]:
    """One answer to a call, whatever its arguments are; nothing if the processor has no such call."""
    return [] if number is None else [equal(number, otherwise="other call"), give(answer), "other call"]


def _controls(column: int) -> list[Line]:
    """The part for `ioctl`: what is not on the list fails as with a file that has no such control."""
    which = load(_argument(1))
    return [
        equal(_CONTROL[column], otherwise="other call"),
        which,
        equal(_TIOCSTI, then="typed"),
        equal(_TIOCLINUX, then="typed"),
        mask(0xFF00),
        *(equal(kind, then="allowed") for kind in _CONTROL_TYPES),
        which,
        *(equal(control, then="allowed") for control in _CONTROLS),
        give(_ERRNO | errno.ENOTTY),
        "typed",
        give(_EPERM),
        "allowed",
        give(_ALLOW),
        "other call",
    ]


def _shared(column: int) -> list[Line]:
    """The part for processes in the host's name spaces; what it lets pass goes on to what follows."""
    code: list[Line] = []
    for refused in _REFUSED_SHARED.values():
        code += _answered(refused[column], _EPERM)
    for asked_about in _ASKED.values():
        code += _answered(asked_about[column], _ASK)
    for numbers, at in _SENDS:
        code += _refused_if(numbers[column], at, any_bit, (_MSG_FASTOPEN,), _ERRNO | errno.EOPNOTSUPP)
    code += _refused_if((72, 25)[column], 1, equal, (_F_SETOWN, _F_SETOWN_EX), _EPERM)  # fcntl
    code += _refused_if(_CONTROL[column], 1, equal, (_FIOSETOWN, _SIOCSPGRP), _EPERM)
    code += _answered(_OPENAT2[column], _ERRNO | errno.ENOSYS)  # has its flags in memory
    for opens, at in _OPENS:
        if (number := opens[column]) is not None:
            code += [
                equal(number, otherwise="other call"),
                load(_argument(at)),
                mask(_ACCESS_MODE_AND_TRUNCATE),
                equal(_TRUNCATE, otherwise="passes"),
                give(_EPERM),
                "passes",
                load(_NUMBER),
                "other call",
            ]
    family, kind, protocol = (_argument(index) for index in range(3))
    refuse = give(_ERRNO | errno.EPROTONOSUPPORT)
    # Streams; messages in order between Unix sockets; netlink. No datagrams: those need no connection to be refused.
    code += [
        equal(_SOCKET[column], otherwise="other call"),
        load(kind),
        mask(_TYPE),
        equal(_STREAM, then="protocol"),
        equal(_SEQPACKET, then="in order"),
        equal(_RAW, otherwise="refused"),
        load(family),
        equal(_AF_NETLINK, then="protocol", otherwise="refused"),
        "in order",
        load(family),
        equal(_AF_UNIX, then="protocol"),
        "refused",
        refuse,
        "protocol",
        load(protocol),
        equal(0, then="passes"),
        equal(_TCP, then="passes"),
        equal(_SOCKET_DIAGNOSIS, then="passes"),
        refuse,
        "passes",
        load(_NUMBER),
        "other call",
    ]
    code += [
        equal(_SOCKETPAIR[column], otherwise="other call"),
        load(kind),
        mask(_TYPE),
        equal(_STREAM, then="passes"),
        equal(_SEQPACKET, then="passes"),
        refuse,
        "passes",
        load(_NUMBER),
        "other call",
    ]
    return code


def _refused_if(
    number: int, index: int, test: Callable[[int, str], Instruction], values: Sequence[int], answer: int
) -> list[Line]:
    """Refuse a call if one of the tests of an argument holds, else go on."""
    return [
        equal(number, otherwise="other call"),
        load(_argument(index)),
        *(test(value, "holds") for value in values),
        jump("passes"),
        "holds",
        give(answer),
        "passes",
        load(_NUMBER),
        "other call",
    ]


def asked(machine: str) -> dict[int, str]:
    """The calls that the shared filter asks about, by their numbers on this processor."""
    column = _MACHINES[machine][0]
    return {numbers[column]: name for name, numbers in _ASKED.items()}


def this_machine() -> str | None:
    """The processor that the filter is for; None where none is known and nodes run without."""
    machine = os.uname().machine
    return machine if program(machine) is not None else None


def open_program() -> int | None:
    """The filter for this machine in a file without a name, for one reader to read from its start."""
    code = program(os.uname().machine)
    if code is None:
        return None
    descriptor = os.memfd_create("seccomp")
    os.write(descriptor, code)
    os.lseek(descriptor, 0, os.SEEK_SET)
    return descriptor
