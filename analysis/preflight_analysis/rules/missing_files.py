"""Claims about files that are not there, or cannot be read."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from preflight_analysis.documents.span import Location, Span
from preflight_analysis.environment.git_history import formerly
from preflight_analysis.evaluation.problems import UnreadablePath
from preflight_analysis.findings.claim import Effect, Subject
from preflight_analysis.findings.doubt import Doubt, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.model.context import Context
from preflight_analysis.model.files import (
    doubts_of_file,
    in_namesake,
    leads_elsewhere,
    meant_file,
    nearest_file,
    package_folder,
    stem,
)
from preflight_analysis.model.installed import lack_of_file, lack_of_made
from preflight_analysis.model.nearest import is_slip
from preflight_analysis.model.problems import problems_of, rename, replacement, shown
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Check, Rule


def check_missing_files(what: Mapping[type[UnreadablePath], str]) -> Check:
    """The check of a rule about files that are not there, by what they are: the nearest one is named and offered."""

    def check(rule: Rule, context: Context) -> Iterator[Finding]:
        for problem in problems_of(context, *what):
            path = problem.kind.path
            near = nearest_file(context.disk, path, context.environment)
            message = f"{what[type(problem.kind)]} '{shown(path, context)}' does not exist"
            fixes: tuple[Fix, ...] = ()
            message += meant_file(context, path, near)
            if near is not None:
                fixes = correct_path(context, problem.location, path, near)
            # ros2 launch goes on without the parameter file of a node, or what a process would launch: nothing stops.
            effect: Effect = "stops-launch" if problem.fatal else "misbehaves"
            found: tuple[Doubt, ...] = ()
            if (other := in_namesake(context, path)) is not None:
                # Which of the two packages is found depends on the package path.
                effect, message = "misbehaves", f"{message}; another package of that name has it in '{other}'"
            else:
                found, why = doubts_of_file(context, problem, near)
                message += why
            lack = lack_of_made(context, path) or (lack_of_file(context, path) if near is None else None)
            yield problem_claim(
                rule,
                problem,
                message,
                subject=Subject("file", path),
                kind="near" if near is not None else "absent",
                effect=effect,
                doubts=found,
                candidates=(near,),
                fixes=fixes,
                lack=lack,
            )

    return check


def check_unreadable_files(kind: type[UnreadablePath], what: str) -> Check:
    """The check of a rule about files that are there and cannot be read, `what` they are."""

    def check(rule: Rule, context: Context) -> Iterator[Finding]:
        for problem in problems_of(context, kind):
            path, reason = shown(problem.kind.path, context), problem.kind.reason
            # ros2 launch warns of the file of a node and goes on.
            effect: Effect = "stops-launch" if problem.fatal else "misbehaves"
            # The reason of a file goes on from its name, that of a path without one is a sentence.
            told = f"'{path}' {reason}" if path else f"'' cannot be read: {reason}"
            yield problem_claim(
                rule,
                problem,
                f"{what} {told}",
                subject=Subject("file", problem.kind.path),
                effect=effect,
                doubts=doubts(NOT_SET=not problem.fatal and not path),
            )

    return check


def correct_path(context: Context, location: Location, path: str, near: str) -> tuple[Fix, ...]:
    """A fix that makes what is written at `location`, and came to `path`, lead to `near`.

    None if the names of the files are more than a slip apart and git knows of no renaming, or if the text does not hold
    what differs: the name of the file, or of its folders below the package. Nor if the text leads to another file for
    other values of its arguments.
    """
    old, new = Path(path), Path(near)
    if leads_elsewhere(context, location, old):
        return ()
    change = formerly(context.disk, path)
    was_renamed = change is not None and change.path == near
    if old.name != new.name and not was_renamed and not is_slip(stem(old.name), stem(new.name)):
        return ()
    if old.parent == new.parent:
        return rename(context, location, old.name, new.name)
    share = package_folder(path, context.environment)
    if share is None or old.name != new.name or old.parent == share:
        return ()
    folders = f"/{old.parent.relative_to(share)}/"
    below = new.parent.relative_to(share)
    written = context.text(location)
    if written.count(folders) != 1:
        return ()
    start = location.span.start + written.index(folders)
    text = "/" if below == Path() else f"/{below}/"
    place = context.location(location.file, Span(start, start + len(folders)))
    return replacement(context, place, text, f"Replace '{folders}' with '{text}'")
