"""What evaluating a value comes to."""

from __future__ import annotations

from typing import NamedTuple


class Resolved(NamedTuple):
    """The text a value came to. Where `known` is false it still has the unresolved substitutions in it."""

    text: str
    known: bool = True
