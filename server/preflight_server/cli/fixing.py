"""`check --fix`, `--diff` and `--add-noqa`: which edits of findings are made, all at once, and written or shown."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from difflib import unified_diff
from pathlib import Path

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import digest
from preflight_analysis.documents.span import LineIndex, Span
from preflight_analysis.edits.edit import Edit, applied, by_file
from preflight_analysis.edits.gate import refusal
from preflight_analysis.environment.writing import write_file
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.findings.report import Report, relative
from preflight_analysis.queries.suppressing import suppress_on_line

_BOM = "\ufeff"
Key = tuple[str, str, str]
"""Rule, file and message of a finding."""


@dataclass(frozen=True, slots=True)
class Change:
    """The text of a file before and after."""

    before: str
    after: str


@dataclass(frozen=True, slots=True)
class Planned:
    """What would be done: the findings with their fixes, the files as they would be, and why others are left alone."""

    fixes: tuple[tuple[Finding, Fix], ...]
    changes: Mapping[str, Change]
    left: Mapping[str, str]

    def write(self) -> None:
        """Write the files: all of them, or none. Raises OSError."""
        _write({file: change.after for file, change in self.changes.items()}, self.changes)

    def undo(self, files: Iterable[str]) -> frozenset[str]:
        """Write these files as they were, with those that a fix changes together with one of them; which they are."""
        undone = set(files)
        for _, fix in self.fixes:
            touched = {edit.location.file for edit in fix.edits}
            undone |= touched if touched & undone else set()
        undone &= self.changes.keys()
        _write({file: self.changes[file].before for file in undone}, self.changes)
        return frozenset(undone)

    def futile(self, after: Report) -> list[tuple[Finding, Fix]]:
        """The findings that are still where they were, by a report of the files as they are now, with their fixes."""
        found = {(each.rule, each.location.file, each.location.span.start) for each in after.findings}
        edits = by_file(edit for _, fix in self.fixes for edit in fix.edits)
        return [each for each in self.fixes if (each[0].rule, *_place_after(each[0], edits)) in found]

    def patches(self, base: str) -> Iterator[tuple[str, str]]:
        """Each file with the patch of it that `patch -p0` and `git apply -p0` take."""
        for file, change in sorted(self.changes.items()):
            name = relative(file, base)
            before, after = (_lines(text) for text in (change.before, change.after))
            lines = unified_diff(before, after, name, name)
            yield (
                file,
                "".join(line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n" for line in lines),
            )


def planned(
    report: Report,
    homes: Sequence[str],
    left: Mapping[str, str],
    futile: Collection[Key] = (),
    *,
    typed: Mapping[str, str],
    unsafe: bool,
) -> Planned:
    """The fixes of findings that do not touch the same text, the most severe first, in files of the workspaces `homes`
    that are not `left` alone; none of findings that are `futile` to fix. Of files in `typed` that text counts."""
    texts = dict(typed)
    edits: dict[str, list[Edit]] = {}
    left = dict(left)
    chosen: list[tuple[Finding, Fix]] = []
    known: set[tuple[Edit, ...]] = set()
    for finding in report.findings:
        fix = finding.safe_fix
        if unsafe and fix is None:
            # What an editor would make unasked, else the first.
            fix = next((each for each in finding.fixes if each.preferred), next(iter(finding.fixes), None))
        if fix is None or fix.edits in known or key_of(finding) in futile:
            continue
        known.add(fix.edits)
        new = by_file(fix.edits)
        for file in new:
            if file not in texts and file not in left:
                text, reason = _text(file, report.documents, homes)
                (left if text is None else texts)[file] = reason if text is None else text
        if left.keys().isdisjoint(new) and all(_fits(texts[file], edits.get(file, []), new[file]) for file in new):
            chosen.append((finding, fix))
            for file, each in new.items():
                edits.setdefault(file, []).extend(each)
    while True:  # until no file is refused: what is not made in one may be half of what is made in another
        kept = [(finding, fix) for finding, fix in chosen if left.keys().isdisjoint(by_file(fix.edits))]
        final = by_file(edit for _, fix in kept for edit in fix.edits)
        refused = {file: why for file, each in final.items() if (why := refusal(each, texts.get)) is not None}
        if not refused:
            break
        left |= {file: f"fixes of it cannot be made together: {why}" for file, why in refused.items()}
    changes = {file: Change(texts[file], applied(texts[file], each)) for file, each in final.items()}
    return Planned(tuple(kept), changes, left)


def suppressed(report: Report, homes: Sequence[str]) -> tuple[Planned, int]:
    """The files with a comment for each finding that suppresses it there, and for how many none can be written."""
    left: dict[str, str] = {}
    changes: dict[str, Change] = {}
    without = 0
    by_path: dict[str, list[Finding]] = {}
    for finding in report.findings:
        by_path.setdefault(finding.location.file, []).append(finding)
    for file, findings in by_path.items():
        text, why = _text(file, report.documents, homes)
        if text is None:
            left[file] = why
            without += len(findings)
            continue
        now, written = text, list[Edit]()
        for finding in {(each.location.span, each.rule): each for each in findings}.values():
            document = Document(file, now, digest(now), (), (), LineIndex(now))
            edit = suppress_on_line(document, _moved(finding, written, document))
            without += edit is None
            if edit is not None:
                written.append(edit)
                now = applied(now, [edit])
        if now != text:
            changes[file] = Change(text, now)
    return Planned((), changes, left), without


def _place_after(finding: Finding, edits: Mapping[str, Sequence[Edit]]) -> tuple[str, int]:
    """The file of a finding, and the offset in it that its start has after all edits."""
    file, start = finding.location.file, finding.location.span.start
    before = [edit for edit in edits.get(file, ()) if edit.location.span.end <= start]
    return file, start + sum(len(edit.text) - (edit.location.span.end - edit.location.span.start) for edit in before)


def key_of(finding: Finding) -> Key:
    """What a finding is known by while its file changes."""
    return finding.rule, finding.location.file, finding.message


def _lines(text: str) -> list[str]:
    """The lines as patches have them: other characters that Python takes for the end of one are text."""
    return [f"{line}\n" for line in text.split("\n")[:-1]] + [last for last in text.split("\n")[-1:] if last]


def _fits(text: str, edits: Sequence[Edit], more: Sequence[Edit]) -> bool:
    """Whether edits of a file can be made with others."""
    try:
        applied(text, [*edits, *more])
    except ValueError:
        return False
    written_over = {edit.location.span for edit in edits if edit.location.span.start < edit.location.span.end}
    return not any(edit.location.span in written_over for edit in more)


def _moved(finding: Finding, inserted: Sequence[Edit], document: Document) -> Finding:
    """The finding where its place in the document is, after one insertion after the other."""
    start, end = finding.location.span
    for edit in inserted:
        by = len(edit.text) if edit.location.span.start <= start else 0
        start, end = start + by, end + by
    return replace(finding, location=document.location(Span(start, end)))


def _text(file: str, documents: Mapping[str, Document], homes: Sequence[str]) -> tuple[str | None, str]:
    """The text of a file, or why it is not to be changed."""
    real = os.path.realpath(file)
    if not any(os.path.commonpath((real, os.path.realpath(home))) == os.path.realpath(home) for home in homes):
        return None, "it is outside of the workspace"
    try:
        text = Path(file).read_bytes().decode("utf-8").removeprefix(_BOM)
    except OSError as error:
        return None, f"it cannot be read: {error.strerror}"
    except UnicodeDecodeError:
        return None, "it is not in UTF-8"
    document = documents.get(file)
    if document is not None and document.text != text:
        return None, "it has changed since it was checked"
    return text, ""


def _write(texts: Mapping[str, str], changes: Mapping[str, Change]) -> None:
    done: list[str] = []
    try:
        for file, text in texts.items():
            done.append(file)
            _write_one(file, text)
    except OSError:
        for file in done:
            now = Path(file).read_bytes().decode("utf-8").removeprefix(_BOM)
            if now != changes[file].before:
                _write_one(file, changes[file].before)
        raise


def _write_one(file: str, text: str) -> None:
    mark = _BOM if Path(file).read_bytes().startswith(_BOM.encode()) else ""
    write_file(file, (mark + text).encode())
