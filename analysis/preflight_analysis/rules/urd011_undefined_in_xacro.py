"""URD011: a xacro file uses a macro, property, argument or block that nothing defines."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.span import Span
from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.claim import Subject, SubjectKind, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.descriptions import (
    Defined,
    defined_anywhere,
    defined_for,
    doubts_of,
    is_passed,
    may_be_other,
)
from preflight_analysis.model.nearest import did_you_mean, nearest, nearest_slip
from preflight_analysis.model.problems import rename_in
from preflight_analysis.robot.xacro import Around, Use, XacroFile, xacro_file
from preflight_analysis.rules.further_reading import XACRO
from preflight_analysis.rules.packages import check_nothing
from preflight_analysis.rules.rule import Rule

_FAILS = re.compile(r"(?i)error|undefined|invalid|unknown|missing|unsupported|fatal|abort")
"""In the name of a macro that is called where xacro is to stop: older ones have no other way."""


class _Asked(NamedTuple):
    """What is asked for, and what there is of its kind: in the files around it, and in those of the workspace."""

    what: str
    subject: SubjectKind
    name: str
    span: Span
    around: Around
    known: Iterable[str]
    anywhere: Iterable[str]


def _of_description(rule: Rule, disk: Disk, environment: Environment, path: str) -> Iterator[Finding]:
    file = xacro_file(disk.db, path)
    if file is None or not file.is_xacro or file.document.problems:
        return
    defined = defined_for(disk.db, environment, path)
    used: dict[str, set[str]] = {}
    for use in file.uses:
        used.setdefault(use.around.macro, set()).add(use.name)
        if use.kind == "expression" and _is_computed(use, defined):
            text = say("'{name}' is not a Python expression: {quoted}", name=use.name, quoted=use.refused)
            doubted = doubts_of(use.around, other=False)
            about = Subject("expression", use.name)
            yield rule.claim(text, file.document.location(use.span), subject=about, kind="invalid", doubts=doubted)
    for each in _asked(disk, environment, file):
        if each.name in each.known:
            continue
        other = may_be_other(disk.db, environment, path, each.around)
        near = nearest(each.name, each.known)
        meant_to_fail = each.around.conditional and _FAILS.search(each.name) is not None
        doubted = (*doubts_of(each.around, other=other), *doubts(INTENDED=meant_to_fail))
        if not defined.whole:
            # The parameters of the macro around that its body has no use for.
            near = nearest_slip(each.name, each.around.names - used.get(each.around.macro, set()))
            doubted = (*doubted, *doubts(PARTLY_READ=True))
        if (near is None and not defined.whole) or (other and each.name in each.anywhere):
            continue
        yield rule.claim(
            f"{each.what} '{each.name}' is not defined in this file or in those that it includes{did_you_mean(near)}"
            if not each.around.names or near is None
            else f"{each.what} '{each.name}' is not defined{did_you_mean(near)}",
            file.document.location(each.span),
            subject=Subject(each.subject, each.name),
            kind="absent" if near is None else "near",
            doubts=doubted,
            candidates=(near,),
            fixes=rename_in(file.document, each.span, each.name, near),
        )


def _asked(disk: Disk, environment: Environment, file: XacroFile) -> Iterator[_Asked]:
    db = disk.db
    defined = defined_for(db, environment, file.document.path)
    anywhere = defined_anywhere(db, environment)
    for call in file.calls:
        if call.prefixed and "." not in call.name and "$" not in call.name:
            yield _Asked("macro", "name", call.name, call.span, call.around, defined.macros, anywhere.macros)
    properties: dict[tuple[str, frozenset[str]], frozenset[str]] = {}
    for use in file.uses:
        if not _is_computed(use, defined):
            continue
        if use.kind == "argument":
            if not _is_known_argument(disk, environment, use, defined.arguments):
                yield _Asked(
                    "argument", "argument", use.name, use.span, use.around, defined.arguments, anywhere.arguments
                )
        elif use.kind in ("property", "block"):
            macro, names = use.around.macro, use.around.names
            known = properties.get((macro, names))
            if known is None:
                known = names | defined.of_callers.get(macro, frozenset()) | defined.properties
                properties[macro, names] = known
            what = "property" if use.kind == "property" else "block"
            yield _Asked(what, "name", use.name, use.span, use.around, known, anywhere.properties)


def _is_computed(use: Use, defined: Defined) -> bool:
    """Whether xacro ever computes the value in which it is: not that of a property that nobody uses."""
    return not use.value_of or use.value_of in defined.used or "$" in use.value_of


def _is_known_argument(disk: Disk, environment: Environment, use: Use, declared: frozenset[str]) -> bool:
    """Whether the argument has a default, or somebody may give it."""
    return use.name in declared or is_passed(disk.db, environment, use.name)


RULE = Rule(
    id="URD011",
    name="undefined-in-xacro",
    effect="breaks",
    kind="absent",
    always=(Reason.NOT_GIVEN,),
    sometimes=(Reason.UNSEEN, Reason.INTENDED, Reason.EXPLAINED),
    what="Checks for a xacro file that uses a macro, property, argument or block that is defined nowhere: not in the "
    "file, not in what it includes, and not in the files that include it. An expression must be one of Python. Files "
    "that include what is not known are not checked.",
    why="xacro stops with an error, and the robot has no description. It evaluates a macro only where it is called, so "
    "the mistake in it may wait for a long time.",
    example='<xacro:macro name="fin" params="min_limit">\n  <limit lower="${min_limi}"/>\n</xacro:macro>',
    instead='<xacro:macro name="fin" params="min_limit">\n  <limit lower="${min_limit}"/>\n</xacro:macro>',
    references=(XACRO,),
    check=check_nothing,
    of_description=_of_description,
)
