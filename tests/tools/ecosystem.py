"""What changed in the findings of public projects: `make ecosystem`.

`bench/ecosystem/projects.tsv` names repositories and commits. Those that lie in one folder, as `<owner>+<name>/repo`,
are checked as on a machine without ROS 2. `bench/ecosystem/findings/<owner>+<name>.jsonl` has what was found there: the
code and the day of the check with the counts of hints, then a line for each other finding, named by its fingerprint.
One that somebody judged has a verdict and
a reason, and stays listed, with `severity` null, when it is gone. It is a failure when a false one comes back or a true
one goes.
"""

from __future__ import annotations

import argparse
import csv
import datetime
import json
import os
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Literal, NamedTuple, Protocol, TypeVar, get_args

sys.path.insert(0, str(Path(__file__).parents[1]))

from preflight_analysis.findings.sarif import FINGERPRINT

from tools.ros2_python_corpus import repository, take_over

DATA = Path(__file__).parents[2] / "bench" / "ecosystem"
_MOST = 200
"""Characters that are kept of a message, for reading."""
Verdict = Literal["true", "trivial", "false", "machine"]
"""`trivial` is true and nobody mends it; `machine` speaks of what this machine lacks and not of the project."""


class Project(NamedTuple):
    """A row of `projects.tsv`."""

    repository: str
    commit: str
    generation: str

    @property
    def name(self) -> str:
        """That of its folder and of the file with its findings."""
        return self.repository.replace("/", "+")


class Listed(Protocol):
    """A row of a list."""

    @property
    def repository(self) -> str:
        """`<owner>/<name>`."""


Row = TypeVar("Row", bound=Listed)


@dataclass(frozen=True)
class Options:
    """What to check, and how."""

    projects: Sequence[str]
    sources: Path
    part: int
    of: int
    command: Sequence[str]
    out: Path
    write: bool

    def piece(self, rows: Sequence[Row]) -> Sequence[Row]:
        """Those of a list that are asked for."""
        chosen = [each for each in rows if not self.projects or each.repository in self.projects]
        return chosen[self.part - 1 :: self.of]


@dataclass(frozen=True)
class Entry:
    """A finding of a project, and what was judged of it. `severity` is null once a judged one is gone; `cell` is the
    row of docs/severity.md that decides it."""

    rule: str
    fingerprint: str
    file: str
    line: int
    message: str
    severity: str | None
    confidence: str | None
    cell: str = ""
    verdict: Verdict | Literal[""] = ""
    reason: str = ""


@dataclass(frozen=True)
class Snapshot:
    """What is found in a project, by fingerprint; `hints` are counts by rule. With `code` of `date` it was checked."""

    entries: dict[str, Entry] = field(default_factory=dict)
    hints: dict[str, int] = field(default_factory=dict)
    code: str = ""
    date: str = ""


@dataclass(frozen=True)
class Change:
    """A finding before and after. `fails` where it contradicts what was judged."""

    before: Entry | None
    after: Entry | None

    @property
    def fails(self) -> bool:
        """Whether a false finding came back, or a true one went."""
        verdict = self.before.verdict if self.before else ""
        was, now = _shown(self.before), _shown(self.after)
        return (verdict == "false" and was is None and now is not None) or (
            verdict in ("true", "trivial") and was is not None and now is None
        )

    def __str__(self) -> str:
        known = self.after or self.before
        assert known is not None
        was, now = _shown(self.before), _shown(self.after)
        what = f"+ {now}" if was is None else f"- {was}" if now is None else f"~ {was} -> {now}"
        verdict = f" [{self.before.verdict}: {self.before.reason}]" if self.before and self.before.verdict else ""
        return f"{'FAIL ' if self.fails else ''}{what} {known.rule} {known.file}:{known.line} {known.message}{verdict}"


def _shown(entry: Entry | None) -> str | None:
    return f"{entry.severity} ({entry.confidence})" if entry is not None and entry.severity is not None else None


def main() -> int:
    """Check the projects that are at hand, print what is new, gone and of another severity."""
    options = read_options(__doc__)
    listed = read_projects()
    chosen = options.piece(listed)
    missing, failed, found = [], [], False
    code, date = code_of_today()
    (options.out / "src").mkdir(parents=True, exist_ok=True)

    def checked(project: Project) -> tuple[Project, Path | None, Snapshot | str]:
        git = repository(options.sources, project.repository, project.commit)
        if git is None:
            return project, None, "not in the folder of sources"
        folder = lay_out(git, project.commit, options.out / "src" / project.name)
        found = check(options.command, folder)
        return project, git, found if isinstance(found, str) else snapshot_of(found)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for project, git, snapshot in pool.map(checked, chosen):
            if isinstance(snapshot, str):
                (missing if git is None else failed).append(f"{project.repository}: {snapshot}")
                continue
            before = read_findings(project)
            changes = list(compare(before, snapshot))
            found = found or any(each.fails for each in changes)
            if changes or before.hints != snapshot.hints:
                print(f"{project.repository}: {_hints(before, snapshot)}")
                print("".join(f"  {change}\n" for change in changes), end="", flush=True)
            if options.write:
                write_findings(project, replace(merged(before, snapshot), code=code, date=date))
    print("".join(f"not checked: {each}\n" for each in [*missing, *failed]), end="")
    print(f"{len(chosen) - len(missing) - len(failed)} of {len(listed)} projects were checked")
    return 1 if found or failed else 0


def read_options(description: str) -> Options:
    """Of the command line."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("projects", nargs="*", help="<owner>/<name>; all without")
    parser.add_argument("--sources", type=Path, required=True, help="the folder with the git repositories")
    parser.add_argument("--piece", default="1/1", help="2/8: the second of eight parts of the list")
    parser.add_argument("--command", default=f"{sys.executable} -m preflight_server.cli.main", help="ros-preflight")
    parser.add_argument("--out", type=Path, default=Path("out/ecosystem"), help="where the projects are laid out")
    parser.add_argument("--write", action="store_true", help="keep what is found now")
    given = parser.parse_args()
    part, of = map(int, given.piece.split("/"))
    return Options(given.projects, given.sources, part, of, given.command.split(), given.out, given.write)


def read_projects() -> list[Project]:
    """The list, in its order."""
    with (DATA / "projects.tsv").open() as table:
        return [Project(**row) for row in csv.DictReader(table, delimiter="\t")]


def code_of_today() -> tuple[str, str]:
    """The commit that last changed the code, with `+` if it has changed since, and the day."""
    git = ("git", "-C", str(DATA))
    folders = (":/analysis", ":/server")
    last = subprocess.run(
        [*git, "log", "-1", "--format=%h", "--abbrev=8", "--", *folders], capture_output=True, check=True
    )
    changed = subprocess.run([*git, "diff", "--quiet", "HEAD", "--", *folders], check=False).returncode
    return last.stdout.decode().strip() + "+" * changed, datetime.date.today().isoformat()


def lay_out(git: Path, commit: str, folder: Path) -> Path:
    """A commit as a checkout of its own, large files empty: what this repository ignores is not ignored there."""
    if not (folder / ".git").exists():
        take_over(git, commit, folder)
        subprocess.run(["git", "init", "--quiet"], cwd=folder, check=True)
        subprocess.run(["git", "add", "--all", "--force"], cwd=folder, check=True)
    return folder.resolve()


def check(command: Sequence[str], folder: Path, files: Sequence[str] = (".",)) -> list[Entry] | str:
    """What `check` finds in files of a project, hints too, or why that is not known."""
    with tempfile.TemporaryDirectory() as home:
        try:
            done = subprocess.run(
                [*command, "check", *files, "--format", "sarif"],
                cwd=folder,
                env={"PATH": "/usr/bin:/bin", "HOME": home, "LANG": "C.UTF-8"},
                capture_output=True,
                timeout=900,
                check=False,
            )
        except subprocess.TimeoutExpired:
            return "took more than 15 minutes"
    if done.returncode not in (0, 1):
        return f"exit code {done.returncode}: {done.stderr.decode(errors='replace').strip()[-300:]}"
    entries = []
    for result in json.loads(done.stdout)["runs"][0]["results"]:
        place = result["locations"][0]["physicalLocation"]
        entry = Entry(
            result["ruleId"],
            result["partialFingerprints"][FINGERPRINT],
            place["artifactLocation"]["uri"],
            place["region"]["startLine"],
            result["message"]["text"].replace(f"{folder}/", "")[:_MOST],
            result["properties"]["severity"],
            result["properties"]["confidence"],
            result["properties"]["decidedBy"],
        )
        entries.append(entry)
    return entries


def snapshot_of(found: Sequence[Entry]) -> Snapshot:
    """What is kept of the findings of a project: hints are only counted."""
    hints = Counter(each.rule for each in found if each.severity == "hint")
    return Snapshot({each.fingerprint: each for each in found if each.severity != "hint"}, dict(sorted(hints.items())))


def compare(before: Snapshot, after: Snapshot) -> Iterator[Change]:
    """What is new, gone, or of another severity or confidence."""
    for fingerprint in [*before.entries, *(each for each in after.entries if each not in before.entries)]:
        change = Change(before.entries.get(fingerprint), after.entries.get(fingerprint))
        if _shown(change.before) != _shown(change.after):
            yield change


def merged(before: Snapshot, after: Snapshot) -> Snapshot:
    """What is found now, with what was judged before."""
    entries = {}
    for fingerprint, entry in after.entries.items():
        known = before.entries.get(fingerprint)
        entries[fingerprint] = replace(entry, verdict=known.verdict, reason=known.reason) if known else entry
    for fingerprint, known in before.entries.items():
        if fingerprint not in entries and known.verdict:
            entries[fingerprint] = replace(known, severity=None, confidence=None)
    return Snapshot(entries, after.hints)


def read_findings(project: Project) -> Snapshot:
    """What is kept of a project; nothing of one that was never checked."""
    path = DATA / "findings" / f"{project.name}.jsonl"
    if not path.exists():
        return Snapshot()
    head, *lines = path.read_text().splitlines()
    entries = [Entry(**json.loads(line)) for line in lines]
    for entry in entries:
        if entry.verdict and entry.verdict not in get_args(Verdict):
            raise SystemExit(f"{path}: {entry.verdict!r} is no verdict; write one of {', '.join(get_args(Verdict))}")
    return Snapshot({each.fingerprint: each for each in entries}, **json.loads(head))


def write_findings(project: Project, snapshot: Snapshot) -> None:
    """Keep what is found in a project: when, with the counts of hints, then a line for each finding."""
    entries = sorted(snapshot.entries.values(), key=lambda each: (each.file, each.rule, each.fingerprint))
    head = {"code": snapshot.code, "date": snapshot.date, "hints": snapshot.hints}
    rows = [head, *({k: v for k, v in asdict(each).items() if v != ""} for each in entries)]
    path = DATA / "findings" / f"{project.name}.jsonl"
    path.parent.mkdir(exist_ok=True)
    path.write_text("".join(json.dumps(row, ensure_ascii=False) + "\n" for row in rows))


def _hints(before: Snapshot, after: Snapshot) -> str:
    was, now = sum(before.hints.values()), sum(after.hints.values())
    return f"{now} hints" if was == now else f"{was} -> {now} hints"


if __name__ == "__main__":
    sys.exit(main())
