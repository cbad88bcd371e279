"""Programs of classic BPF, with labels: instructions to the array of `struct sock_filter` that the kernel takes.

The form is that of `linux/filter.h`. A program only jumps forward, by at most 255 instructions.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable

from preflight_analysis.dataclass import dataclass

_LOAD = 0x20  # BPF_LD | BPF_W | BPF_ABS
_EQUAL = 0x15  # BPF_JMP | BPF_JEQ | BPF_K
_AT_LEAST = 0x35  # BPF_JMP | BPF_JGE | BPF_K
_ANY_BIT = 0x45  # BPF_JMP | BPF_JSET | BPF_K
_RETURN = 0x06  # BPF_RET | BPF_K
_AND = 0x54  # BPF_ALU | BPF_AND | BPF_K


@dataclass(frozen=True, slots=True)
class Instruction:
    """`then` and `otherwise` are the labels that a test jumps to, None for what follows it."""

    operation: int
    value: int
    then: str | None = None
    otherwise: str | None = None


Line = Instruction | str
"""An instruction, or the label of the one that follows. A jump leads to the nearest label of its name further on, so a
part may have labels of its own (as `1:` and `1f` in an assembler)."""


def load(offset: int) -> Instruction:
    """Put the word at an offset in the data into the accumulator, which all others work on."""
    return Instruction(_LOAD, offset)


def mask(bits: int) -> Instruction:
    """Keep these bits only."""
    return Instruction(_AND, bits)


def equal(value: int, then: str | None = None, otherwise: str | None = None) -> Instruction:
    """Jump by whether it is this value."""
    return Instruction(_EQUAL, value, then, otherwise)


def at_least(value: int, then: str | None = None, otherwise: str | None = None) -> Instruction:
    """Jump by whether it is this value or a larger one."""
    return Instruction(_AT_LEAST, value, then, otherwise)


def any_bit(bits: int, then: str | None = None, otherwise: str | None = None) -> Instruction:
    """Jump by whether one of these bits is set."""
    return Instruction(_ANY_BIT, bits, then, otherwise)


def jump(label: str) -> Instruction:
    """Go on at a label."""
    return equal(0, label, label)


def give(value: int) -> Instruction:
    """End the program with this answer."""
    return Instruction(_RETURN, value)


def assemble(lines: Iterable[Line]) -> bytes:
    """The program. Raises KeyError for a label that is not further on, `struct.error` for one that is too far."""
    code: list[bytes] = []
    labels: dict[str, int] = {}
    for line in reversed(list(lines)):  # distances are to what follows
        if isinstance(line, str):
            labels[line] = len(code)
        else:
            jumps = (0 if label is None else len(code) - labels[label] for label in (line.then, line.otherwise))
            code.append(struct.pack("=HBBI", line.operation, *jumps, line.value))
    return b"".join(reversed(code))
