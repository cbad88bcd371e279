"""The filter of system calls: as a program, for both processors, and as what a node in the sandbox sees."""

from __future__ import annotations

import ast
import errno
import platform
import struct
from pathlib import Path

import pytest
from preflight_analysis.tracing import seccomp
from support.tracing_harness import trace, write_node

pytestmark = pytest.mark.ros

ALLOW, KILL = 0x7FFF0000, 0x80000000
X86, ARM, I386 = 0xC000003E, 0xC00000B7, 0x40000003


def refused(number: int) -> int:
    return 0x00050000 | number


def verdict(machine: str, architecture: int, call: int, *arguments: int, shared: bool = False) -> int:
    """What the kernel would answer: the few instructions of classic BPF that are used, one by one."""
    code = seccomp.program(machine, shared)
    assert code is not None
    data = struct.pack("=IIQ6Q", call, architecture, 0, *(*arguments, *[0] * (6 - len(arguments))))
    accumulator, at = 0, 0
    while True:
        operation, then, otherwise, value = struct.unpack_from("=HBBI", code, at * 8)
        at += 1
        if operation == 0x20:
            (accumulator,) = struct.unpack_from("=I", data, value)
        elif operation == 0x06:
            return int(value)
        elif operation == 0x54:
            accumulator &= value
        else:
            holds = {0x15: accumulator == value, 0x35: accumulator >= value, 0x45: bool(accumulator & value)}[operation]
            at += then if holds else otherwise


@pytest.mark.parametrize(
    ("machine", "architecture", "ptrace", "clone", "ioctl", "read", "socket"),
    [("x86_64", X86, 101, 56, 16, 0, 41), ("aarch64", ARM, 117, 220, 29, 63, 198)],
)
def test_the_program_on_each_processor(
    machine: str, architecture: int, ptrace: int, clone: int, ioctl: int, read: int, socket: int
) -> None:
    def answer(call: int, *arguments: int) -> int:
        return verdict(machine, architecture, call, *arguments)

    assert answer(read) == ALLOW
    assert answer(ptrace) == refused(errno.EPERM)
    assert answer(435) == refused(errno.ENOSYS)
    assert answer(clone, 0x003D0F00) == ALLOW, "a thread"
    assert answer(clone, 17) == ALLOW, "a fork"
    assert answer(clone, 0x10000000 | 17) == refused(errno.EPERM)
    terminals, size, waiting, flags, descriptors = 0x5413, 0x541B, 0x8905, 0x80086601, 0x5451
    assert [answer(ioctl, 0, which) for which in (terminals, size, waiting, flags, descriptors)] == [ALLOW] * 5
    changes = (0x40086602, 0x40046602, 0x401C5820, 0x40087602, 0x40047602, 0x40086604, 0x40806685, 0xC0406618)
    assert [answer(ioctl, 0, which) for which in changes] == [refused(errno.ENOTTY)] * len(changes)
    assert answer(ioctl, 0, 1 << 32 | 0x40086602) == refused(errno.ENOTTY)
    control = 25 if machine == "aarch64" else 72
    assert [answer(control, 3, which) for which in (3, 6, 1024, 1026, 1040)] == [ALLOW] * 2 + [refused(errno.EPERM)] * 3
    assert answer(ioctl, 0, 0x5412) == refused(errno.EPERM)
    assert answer(ioctl, 0, 1 << 32 | 0x5412) == refused(errno.EPERM), "the kernel looks at the lower half only"
    assert [answer(socket, family) for family in (1, 2, 10, 16)] == [ALLOW] * 4
    assert answer(socket, 40) == refused(errno.EAFNOSUPPORT)
    assert verdict(machine, I386, 1) == KILL


def test_numbers_of_the_x32_abi_kill() -> None:
    assert verdict("x86_64", X86, 0x40000000 | 520) == KILL


def test_every_refused_call_is_refused_by_the_whole_program() -> None:
    for column, (machine, architecture) in enumerate([("x86_64", X86), ("aarch64", ARM)]):
        for calls, number in ((seccomp._REFUSED, errno.EPERM), (seccomp._UNKNOWN, errno.ENOSYS)):
            for name, numbers in calls.items():
                call = numbers[column]
                assert call is None or verdict(machine, architecture, call) == refused(number), name


def test_the_program_for_the_hosts_name_spaces() -> None:
    """Only what connects is left of sockets, and a keeper is asked where to."""
    ask = 0x7FC00000
    for column, (machine, architecture) in enumerate([("x86_64", X86), ("aarch64", ARM)]):

        def answer(numbers: tuple[int | None, int | None], *arguments: int) -> int:
            number = numbers[column]  # noqa: B023
            return ALLOW if number is None else verdict(machine, architecture, number, *arguments, shared=True)  # noqa: B023

        for name, numbers in seccomp._REFUSED_SHARED.items():
            assert numbers[column] is None or answer(numbers) == refused(errno.EPERM), name
        for name, numbers in seccomp._ASKED.items():
            assert answer(numbers) == ask, name
        for name, numbers in seccomp._REFUSED.items():
            assert numbers[column] is None or answer(numbers) == refused(errno.EPERM), name
        opened, relative, write, create, truncate = (2, None), (257, 56), 1, 0o100, 0o1000
        for flags, expected in (
            (truncate, refused(errno.EPERM)),
            (truncate | create, refused(errno.EPERM)),
            (truncate | write | create, ALLOW),
            (truncate | 2, ALLOW),
            (create, ALLOW),
            (0, ALLOW),
        ):
            assert answer(relative, 3, 0, flags) == expected
            assert opened[column] is None or answer(opened, 0, flags) == expected
        assert answer((437, 437)) == refused(errno.ENOSYS)
        made, pair, sent, control = (41, 198), (53, 199), (44, 206), (72, 25)
        stream, datagram, raw, ordered, closing = 1, 2, 3, 5, 0o2000000
        no_such = refused(errno.EPROTONOSUPPORT)
        assert [answer(made, family, stream | closing) for family in (1, 2, 10)] == [ALLOW] * 3
        assert [answer(made, family, datagram | closing) for family in (1, 2, 10, 16)] == [no_such] * 4
        assert [answer(made, family, raw) for family in (1, 2, 10, 16)] == [no_such] * 3 + [ALLOW]
        assert [answer(made, family, ordered) for family in (1, 2, 10)] == [ALLOW, no_such, no_such]
        assert [answer(made, 2, stream, protocol) for protocol in (0, 6, 262)] == [ALLOW, ALLOW, no_such]
        assert answer(made, 40, stream) == refused(errno.EAFNOSUPPORT)
        assert [answer(pair, 1, kind) for kind in (stream, ordered, datagram)] == [ALLOW, ALLOW, no_such]
        assert [answer(sent, 3, 0, 0, flags) for flags in (0, 0x20000000)] == [ALLOW, refused(errno.EOPNOTSUPP)]
        assert [answer(control, 3, which) for which in (3, 8, 15)] == [ALLOW] + [refused(errno.EPERM)] * 2


def test_an_unknown_processor_has_no_program() -> None:
    assert seccomp.program("riscv64") is None


CALLS = r"""
import ctypes, errno, platform, sys
libc = ctypes.CDLL(None, use_errno=True)
column = ["x86_64", "aarch64"].index(platform.machine())
def call(numbers, *arguments):
    ctypes.set_errno(0)
    given = [ctypes.c_long(a) for a in arguments] + [ctypes.c_long(0)] * (6 - len(arguments))
    done = libc.syscall(ctypes.c_long(numbers[column]), *given)
    return errno.errorcode.get(ctypes.get_errno(), "done") if done == -1 else "done"
"""


def answers(folder: Path, *calls: str) -> list[str]:
    """What a node gets from these calls, each the arguments of `call` above."""
    body = CALLS + "print([" + ", ".join(f"call({c})" for c in calls) + "], file=sys.stderr)\n"
    found: list[str] = ast.literal_eval(trace(write_node(folder, body)).outcome.stderr_tail[-1])
    return found


@pytest.mark.usefixtures("each_backend")
def test_a_node_cannot_trace_or_read_other_processes(tmp_path: Path) -> None:
    calls = ["(101, 117), 16, 1", "(310, 270), 1", "(311, 271), 1", "(438, 438), 0, 0", "(312, 272), 1, 1"]
    assert answers(tmp_path, *calls) == ["EPERM"] * 5


@pytest.mark.usefixtures("each_backend")
def test_a_node_cannot_reach_the_kernels_key_rings(tmp_path: Path) -> None:
    assert answers(tmp_path, "(248, 217)", "(249, 218)", "(250, 219), 0, -3") == ["EPERM"] * 3


@pytest.mark.usefixtures("each_backend")
def test_a_node_has_no_io_uring(tmp_path: Path) -> None:
    assert answers(tmp_path, "(425, 425), 1", "(426, 426), 0", "(427, 427), 0") == ["ENOSYS"] * 3


@pytest.mark.usefixtures("each_backend")
def test_a_node_makes_no_name_spaces_and_no_mounts(tmp_path: Path) -> None:
    new_user, new_mount, new_time = 0x10000000, 0x20000, 0x80
    calls = [f"(272, 97), {flag}" for flag in (new_user, new_mount, new_time)]
    calls += [f"(56, 220), {new_user} | 17", "(308, 268), 0", "(165, 40)", "(161, 51)", "(428, 428)", "(430, 430)"]
    assert answers(tmp_path, *calls) == ["EPERM"] * 9
    assert answers(tmp_path, "(272, 97), 0x400", "(435, 435)") == ["done", "ENOSYS"]


def test_a_node_reaches_neither_the_kernels_machinery_nor_the_machine(tmp_path: Path, each_backend: str) -> None:
    calls = ["(321, 280)", "(298, 241)", "(323, 282)", "(304, 265)", "(246, 104)", "(175, 105)", "(313, 273)"]
    calls += ["(169, 142)", "(167, 224)", "(164, 170)", "(227, 112)", "(135, 92), 0x40000", "(16, 29), 0, 0x5412"]
    assert answers(tmp_path, *calls) == ["EPERM"] * 13
    assert answers(tmp_path, "(41, 198), 40, 1", "(41, 198), 38, 1") == ["EAFNOSUPPORT"] * 2
    # firejail's own filter does not even let it ask.
    assert answers(tmp_path, "(135, 92), -1") == ["EPERM" if each_backend == "firejail" else "done"]


@pytest.mark.usefixtures("each_backend")
def test_a_program_of_another_abi_is_killed(tmp_path: Path) -> None:
    found = trace(write_node(tmp_path, CALLS + "call((0x40000000 | 39, 39))\n"))
    expected = ("crashed", "SIGSYS") if platform.machine() == "x86_64" else ("exited", None)
    assert (found.outcome.status, found.outcome.signal) == expected
