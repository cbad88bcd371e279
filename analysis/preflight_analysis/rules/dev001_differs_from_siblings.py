"""DEV001: one of several nodes or includes that are alike is written otherwise."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.deviations import Deviation, deviating_includes, deviating_nodes
from preflight_analysis.rules.further_reading import DEVIANT_BEHAVIOR
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for each in chain(deviating_nodes(context), deviating_includes(context)):
        yield rule.claim(
            _message(each),
            each.place,
            subject=Subject(each.what, each.name),
            kind="absent" if each.value is None else "near",
            candidates=(each.expected,),
            doubts=doubts(SIBLINGS=True),
        )


def _message(each: Deviation) -> str:
    who = f" of {each.name_of}" if each.name_of else ""
    after = f"after the {each.siblings - 1} others like it, it would be '{each.expected}'"
    if each.value is None:
        return f"{each.what} '{each.name}'{who} is missing; {after}"
    return f"{each.what} '{each.name}'{who} is '{each.value}', where '{each.other}' is of another one; {after}"


RULE = Rule(
    id="DEV001",
    name="differs-from-siblings",
    effect="misbehaves",
    kind="near",
    always=(Reason.SIBLINGS,),
    what="Checks for the one of at least four nodes of one executable, or includes of one file, that lacks what all "
    "others have, or has the name of another one in a value.",
    why="A block is copied, and one of its names is not changed: two drivers open one port, or one node gets no remap.",
    example='<node pkg="p" exec="wheel" name="wheel_3"><param name="port" value="/dev/ttyUSB2"/></node>',
    instead='<node pkg="p" exec="wheel" name="wheel_3"><param name="port" value="/dev/ttyUSB3"/></node>',
    references=(DEVIANT_BEHAVIOR,),
    check=_check,
    every_root=True,
)
