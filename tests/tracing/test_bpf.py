"""Labels in programs of classic BPF; what the programs do is asked in `test_seccomp.py`."""

from __future__ import annotations

import struct

import pytest
from preflight_analysis.tracing.bpf import Line, assemble, equal, give, jump, load


def decoded(*lines: Line) -> list[tuple[int, ...]]:
    """The instructions, each `(code, jump if true, jump if false, value)`."""
    return list(struct.iter_unpack("=HBBI", assemble(lines)))


def test_a_jump_is_counted_to_its_label() -> None:
    found = decoded(load(4), equal(7, then="far", otherwise="near"), "near", give(1), jump("far"), "far", give(2))
    assert found == [(0x20, 0, 0, 4), (0x15, 2, 0, 7), (0x06, 0, 0, 1), (0x15, 0, 0, 0), (0x06, 0, 0, 2)]


def test_a_jump_leads_to_the_nearest_label_of_its_name() -> None:
    part: list[Line] = [equal(1, then="end"), give(1), "end"]
    assert decoded(*part, *part, give(0)) == [(0x15, 1, 0, 1), (0x06, 0, 0, 1)] * 2 + [(0x06, 0, 0, 0)]


def test_no_program_jumps_back_or_too_far() -> None:
    with pytest.raises(KeyError):
        assemble(["before", give(0), jump("before")])
    with pytest.raises(struct.error):
        assemble([jump("end"), *[give(0)] * 256, "end", give(1)])
    assert assemble([jump("end"), *[give(0)] * 255, "end", give(1)])
