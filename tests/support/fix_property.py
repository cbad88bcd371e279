"""Every fix of every finding is tried: the files parse, the finding is gone, and no error is new.

An error is new if it is said of something that was evaluated before, too. Two kinds are not, and say nothing against a
fix, which has only come to them:

- those of a file that the launch did not read before, as its include was not found;
- those of what the package has whose name the fix corrects. Nothing is looked up in a package that is not found:
  whether it has that executable or file was not asked before (`_LOOKED_UP`). They name the package, or are of the path
  in which the fix is; those of the rest of the tag count.

Each try is a line of the file that `FIX_TALLY` names, where it is set: `tests/tools/fixes.py` counts them.
"""

from __future__ import annotations

import json
import os
from collections import Counter
from collections.abc import Callable, Collection, Generator, Iterable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from contextlib import closing
from dataclasses import dataclass
from pathlib import PurePosixPath

from preflight_analysis.edits.edit import applied, by_file
from preflight_analysis.edits.gate import refusal
from preflight_analysis.findings.finding import Finding, Fix

TALLY = "FIX_TALLY"

_PACKAGE_NAMES = ("PKG001", "LCH027")
"""What is said of the name of a package that is not found, or has another one now."""
_LOOKED_UP = ("LCH013", "PKG002", "PRM002", "PRM005", "PRM008")
"""Errors of what is looked up in a package: files, executables and what a command makes of such a file."""

TextOf = Callable[[str], str | None]


@dataclass(frozen=True)
class Launch:
    """A launch file in which fixes are tried: what is found in it, and the files that it reads. What is wrong in other
    files, to which only a fix leads, was so before."""

    name: str
    found: Sequence[Finding]
    read: AbstractSet[str]


Again = Callable[[Mapping[str, str], Sequence[Launch]], Generator[Iterable[Finding]]]
"""The findings in each launch with these texts in place of those of before."""


@dataclass(frozen=True)
class Try:
    """A fix that was tried, and what is wrong with it; None for one that mends its finding."""

    rule: str
    format: str
    title: str
    wrong: str | None


def tries(
    findings: Sequence[Finding],
    text_of: TextOf,
    again: Again,
    launch: Launch,
    others: Sequence[Launch] = (),
    unlooked: Collection[str] = (),
) -> list[Try]:
    """All fixes of findings of a launch, each tried by itself, there and in those of the `others` that read what it
    edits. Edits of the files `unlooked` are only parsed."""

    def wrong(finding: Finding, fix: Fix) -> str | None:
        if any(edit.location.file in unlooked for edit in fix.edits):
            return refusal(fix.edits, text_of)
        return _wrong(finding, fix, text_of, again, launch, others)

    found = [
        Try(finding.rule, _format(fix), fix.title, wrong(finding, fix)) for finding in findings for fix in finding.fixes
    ]
    if (tally := os.environ.get(TALLY)) is not None:
        with open(tally, "a", encoding="utf-8") as file:
            file.writelines(json.dumps([t.rule, t.format, t.title, t.wrong, where()]) + "\n" for t in found)
    return found


def where() -> str:
    return os.environ.get("PYTEST_CURRENT_TEST", "")


def _format(fix: Fix) -> str:
    names = sorted({PurePosixPath(edit.location.file).name for edit in fix.edits})
    kinds = {"CMakeLists.txt": "CMake", "package.xml": "package.xml", "setup.py": "setup.py"}
    return "+".join(dict.fromkeys(kinds.get(name) or PurePosixPath(name).suffix or name for name in names))


def _wrong(
    finding: Finding, fix: Fix, text_of: TextOf, again: Again, launch: Launch, others: Sequence[Launch]
) -> str | None:
    why = refusal(fix.edits, text_of)
    if why is not None:
        return why
    texts = {file: applied(text_of(file) or "", edits) for file, edits in by_file(fix.edits).items()}
    launches = [launch, *(other for other in others if texts.keys() & other.read)]
    with closing(again(texts, launches)) as found_again:
        for each, found in zip(launches, found_again, strict=True):
            after = list(found)
            if each is launch and _count(after)[_key(finding)] >= _count(launch.found)[_key(finding)]:
                return "the finding is still there"
            if errors := _new_errors(finding, fix, each, after):
                return f"new errors in {each.name}: {errors}"
    return None


def _new_errors(mended: Finding, fix: Fix, launch: Launch, after: Iterable[Finding]) -> list[tuple[str, str, str]]:
    looked_up = (each for each in after if not _only_uncovered(each, mended, fix))
    return sorted(_errors(looked_up, launch.read) - _errors(launch.found, launch.read))


def _only_uncovered(error: Finding, mended: Finding, fix: Fix) -> bool:
    """Whether an error is of what could not be looked up before, in the package that the fix names."""
    if mended.rule not in _PACKAGE_NAMES or error.rule not in _LOOKED_UP or len(fix.edits) != 1:
        return False
    (edit,) = fix.edits
    start, end = error.location.span
    is_of_path = error.location.file == edit.location.file and start <= edit.location.span.start < end
    return is_of_path or f"package {edit.text!r}" in error.message


def _errors(findings: Iterable[Finding], read: AbstractSet[str]) -> Counter[tuple[str, str, str]]:
    """Those of the files that were read, but for what this machine lacks: only of a package that is known can it be."""
    wrong = (each for each in findings if each.severity == "error" and each.lack is None)
    return _count(each for each in wrong if each.location.file in read)


def _key(finding: Finding) -> tuple[str, str, str]:
    return finding.rule, finding.location.file, finding.message


def _count(findings: Iterable[Finding]) -> Counter[tuple[str, str, str]]:
    return Counter(map(_key, findings))
