"""The page of the policy: docs/severity.md."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from preflight_analysis.findings.policy import EFFECTS, LIMITS, USUAL, limit_in_words


class Judged(NamedTuple):
    """How many findings of a row of the tables were judged, and how many of them are true."""

    true: int = 0
    all: int = 0

    def __str__(self) -> str:
        return f"{self.true} of {self.all}" if self.all else ""


def page(judged: Mapping[str, Judged]) -> str:
    """The page in Markdown. `judged` by row: the name of an effect or of a doubt."""
    return "\n".join(_lines(judged)) + "\n"


def _lines(judged: Mapping[str, Judged]) -> Iterator[str]:
    yield "<!-- Written by `make truth`. Do not edit. -->\n"
    yield "# Severity and confidence\n"
    yield "What a mistake does to the robot gives the severity of a finding. Each doubt limits it, and the confidence."
    yield "`ros-preflight explain FINDING` shows the doubts of a finding, and what removes each."
    yield "The last column counts those in [public projects](truth.md) that were judged by hand: how many are true.\n"
    yield "## What the mistake does\n"
    yield "| effect | severity | when | true |"
    yield "| --- | --- | --- | --- |"
    for effect, severity in USUAL.items():
        yield f"| {effect} | {severity} | {EFFECTS[effect]} | {judged.get(effect, Judged())} |"
    yield "\n## What speaks against it\n"
    yield "| doubt | at most | what removes it | true |"
    yield "| --- | --- | --- | --- |"
    for reason in LIMITS:
        remedy = reason.remedy.replace("{of}", "it")
        yield f"| {reason.sentence} | {limit_in_words(reason)} | {remedy} | {judged.get(reason.name, Judged())} |"
