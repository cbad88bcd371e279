"""What a signature is made of."""

from __future__ import annotations

from preflight_analysis.dataclass import dataclass


@dataclass(frozen=True, slots=True)
class Parameter:
    """An argument; `start` and `end` are where it stands in the label."""

    name: str
    doc: str
    start: int
    end: int


@dataclass(frozen=True, slots=True)
class Signature:
    """What can be passed. `active` is the index of the argument that the cursor is in, None if in none."""

    label: str
    doc: str
    parameters: tuple[Parameter, ...]
    active: int | None
