"""Texts that are not known, in what a run of a Python launch file is given and answers: those of
`tracing/agents/anything.py`, which stay so in every text that the file makes of them."""

from __future__ import annotations

BEGIN, END = "\ufdd0", "\ufdd1"


def unknown_text(name: str) -> str:
    """What stands for a text that is not known, by a name for it."""
    return f"{BEGIN}{name}{END}"


def is_unknown(value: object) -> bool:
    """Whether it is a text of which some is not known."""
    return isinstance(value, str) and BEGIN in value


def readable(text: str) -> str:
    """For people: with the names in place of what is not known."""
    return text.replace(BEGIN, "<").replace(END, ">")
