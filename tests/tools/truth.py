"""How many findings are true, and how many mistakes are found: `make truth` writes docs/truth.md and docs/severity.md.

Everything in it is in `bench/ecosystem`: verdicts beside the findings of public projects (`findings/*.jsonl`), fixes of
public histories with what is found before them (`fixes.tsv`), and rounds of projects that were unseen when they were
checked (`rounds/rounds.tsv`; beside it their projects, what was false there and why, readings of single rules, and
what lists of fixes found when they were new).
"""

from __future__ import annotations

import csv
import sys
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby, islice
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).parents[1]))

from preflight_analysis.findings import policy_page

from tools.ecosystem import DATA, Project, Snapshot, read_findings, read_projects
from tools.ecosystem_fixes import NOTHING, Fix, read_fixes

PAGE = Path(__file__).parents[2] / "docs" / "truth.md"
SEVERITY = PAGE.with_name("severity.md")
_SEVERITIES = {"error": "errors", "warning": "warnings", "info": "information"}
_ROUNDS = 7
"""How many rows of samples are shown, the newest."""
_TRUE = ("true", "trivial")


class Round(NamedTuple):
    """A row of `rounds.tsv`: a sample of projects, checked unseen or with the causes of what was false fixed."""

    round: str
    generation: str
    sample: str
    state: str
    projects: str
    code: str
    errors: str
    errors_true: str
    warnings: str
    warnings_true: str


class FixList(NamedTuple):
    """A row of `fix_lists.tsv`: fixes that were chosen by their differences, before anything was run on them.

    `unseen` of `checked_unseen` were found when the list was new; of a list with a `code`, as an error or a warning, of
    those that the repository shows.
    """

    list: str
    kind: str
    fixes: str
    unseen: str
    checked_unseen: str
    now: str
    repositories: str
    code: str


def main() -> int:
    """Write the pages."""
    found = {each: read_findings(each) for each in read_projects()}
    PAGE.write_text(page(found, read_fixes(), read_rounds(), read_fix_lists()))
    SEVERITY.write_text(policy_page.page(judged(found.values())))
    return 0


def judged(found: Iterable[Snapshot]) -> dict[str, policy_page.Judged]:
    """By rows of the policy, how many of the findings that it decides were judged, and are true. What this machine
    lacks is not true; what a robot's makers leave as it is is."""
    rows: dict[str, policy_page.Judged] = {}
    for entry in (each for snapshot in found for each in snapshot.entries.values()):
        if entry.severity is not None and entry.verdict:
            row = rows.get(entry.cell, policy_page.Judged())
            rows[entry.cell] = policy_page.Judged(row.true + (entry.verdict in _TRUE), row.all + 1)
    return rows


def read_rounds() -> list[Round]:
    """The samples, the newest first."""
    with (DATA / "rounds" / "rounds.tsv").open(newline="") as table:
        return [Round(**row) for row in csv.DictReader(table, delimiter="\t")]


def read_fix_lists() -> list[FixList]:
    """The lists of fixes, the oldest first."""
    with (DATA / "rounds" / "fix_lists.tsv").open(newline="") as table:
        return [FixList(**row) for row in csv.DictReader(table, delimiter="\t")]


def page(
    found: Mapping[Project, Snapshot], fixes: Sequence[Fix], rounds: Sequence[Round], lists: Sequence[FixList] = ()
) -> str:
    """The whole page, of at most 60 lines."""
    return "\n".join(
        [
            "<!-- Written by `make truth` from bench/ecosystem. Do not edit. -->",
            "# How many findings are true",
            *_precision({each: snapshot for each, snapshot in found.items() if snapshot.date}),
            "",
            "## Projects that were never seen before",
            *_unseen(rounds),
            "",
            "## How many mistakes are found",
            *_recall([each for each in fixes if each.found], [each for each in lists if each.code]),
            "",
        ]
    )


def _precision(found: Mapping[Project, Snapshot]) -> list[str]:
    entries = [each for snapshot in found.values() for each in snapshot.entries.values() if each.severity]
    judged = [each for each in entries if each.verdict]
    verdicts = {verdict: sum(each.verdict == verdict for each in judged) for verdict in (*_TRUE, "false", "machine")}
    families = sorted({each.rule[:3] for each in entries})
    rows = []
    for name, of in [("all", entries), *((name, [e for e in entries if e.rule.startswith(name)]) for name in families)]:
        cells = [
            _share(
                sum(each.verdict in _TRUE for each in of if each.severity == severity),
                sum(bool(each.verdict) for each in of if each.severity == severity),
            )
            for severity in _SEVERITIES
        ]
        rows.append([name, *cells, str(sum(not each.verdict for each in of))])
    ros2 = sum(each.generation == "2" for each in found)
    return [
        f"On a machine without ROS 2, `ros-preflight check .` was run in {len(found)} public projects. "
        f"Of these, {ros2} are ROS 2 projects.",
        f"That was {_when((each.code, each.date) for each in found.values())}. "
        f"Of {len(entries)} findings {len(judged)} were judged in the project's files.",
        f"{verdicts['true']} are true, {verdicts['trivial']} trivial (true, and nobody fixes it), "
        f"{verdicts['false']} false, {verdicts['machine']} of the machine (of what it lacks: not true either).",
        "Hints are only counted. Many of the projects were used to fix what was false: they were seen before.",
        "",
        *_table(["true of those judged", *_SEVERITIES.values(), "not judged"], rows),
    ]


def _unseen(rounds: Sequence[Round]) -> list[str]:
    rows = []
    for (name, generation), group in islice(groupby(rounds, lambda each: (each.round, each.generation)), _ROUNDS):
        samples = list(group)
        cells = []
        for state in ("unseen", "fixed"):
            of = [each for each in samples if each.state == state]
            cells += [
                _share(sum(int(e.errors_true) for e in of), sum(int(e.errors) for e in of)),
                _share(sum(int(e.warnings_true) for e in of), sum(int(e.warnings) for e in of)),
            ]
        count = sum(int(each.projects) for each in samples if each.state == "unseen")
        rows.append([name, generation or "1 and 2", str(count), *cells])
    return [
        f"The last {_ROUNDS} rows. One reader judged every error and warning. "
        "`again`: most of them, with the causes of what was false fixed.",
        "",
        *_table(["round", "ROS", "projects", "errors", "warnings", "errors again", "warnings again"], rows),
    ]


def _recall(fixes: Sequence[Fix], lists: Sequence[FixList]) -> list[str]:
    by_kind = defaultdict(list)
    hidden = [each for each in fixes if each.visible == "no"]
    for fix in fixes:
        if fix.visible == "yes":
            by_kind["all"].append(fix)
            by_kind[fix.kind].append(fix)
    severities = (*_SEVERITIES, "hint", NOTHING)
    rows = [
        [kind, str(len(of)), *(str(sum(each.severity == severity for each in of)) for severity in severities)]
        for kind, of in sorted(by_kind.items(), key=lambda each: (each[0] != "all", each[0]))
    ]
    return [
        f"Commits that fix a launch configuration were checked {_when((each.code, each.date) for each in fixes)}, "
        "before and after the fix.",
        "The worst finding that goes away with the fix counts, unless a reader saw that it has another cause "
        f"({sum(each.mistake == 'no' for each in fixes)}). The table has lists of fixes together, most of them known: "
        "causes of misses were fixed before.",
        " ".join(
            f"The {each.list} list has {each.fixes} fixes of {each.repositories} repositories. When it was new (code "
            f"{each.code}), {_share(int(each.unseen), int(each.checked_unseen))} of the visible ones were found above "
            "information."
            for each in lists[::-1]
        ),
        f"In {len(hidden)} further fixes nothing in the repository shows the mistake; "
        f"found above a hint: {sum(each.severity not in ('hint', NOTHING) for each in hidden)}.",
        "",
        *_table(["kind of mistake", "fixes", "error", "warning", "information", "hint", NOTHING], rows),
    ]


def _when(checks: Iterable[tuple[str, str]]) -> str:
    codes = sorted(set(checks), key=lambda each: (each[1], each[0]))
    if not codes:
        return "not yet"
    days = sorted({date for _, date in codes})
    return (
        f"on {' to '.join(dict.fromkeys((days[0], days[-1])))} with the code at {', '.join(code for code, _ in codes)}"
    )


def _share(part: int, whole: int) -> str:
    return f"{part} of {whole} ({100 * part // whole} %)" if whole else "–"


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    return [f"| {' | '.join(cells)} |" for cells in (head, ["---"] * len(head), *rows)]


if __name__ == "__main__":
    sys.exit(main())
