"""What is found in commits before they were fixed: `make ecosystem FIXES=1`.

`bench/ecosystem/fixes.tsv` names commits of public projects that fix a launch configuration, and their parents. Both
are checked as the projects of `make ecosystem` are, in the files that the row names. What is found at the parent, is
gone with the fix, and is in one of these files or in one that the commit changes, may be the mistake. `found` has the
worst severity of it and its rules; `mistake` is what a reader says of it ("yes" or "no", empty until somebody read it).
It is a failure when the mistake was found above a hint and no longer is.
"""

from __future__ import annotations

import csv
import os
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).parents[1]))

from tools.ecosystem import DATA, Entry, Options, check, code_of_today, lay_out, read_options
from tools.ros2_python_corpus import repository

NOTHING = "nothing"
_SEVERITIES = (NOTHING, "hint", "info", "warning", "error")


class Fix(NamedTuple):
    """A row of `fixes.tsv`. `visible` is "no" where nothing in the repository shows the mistake."""

    repository: str
    generation: str
    buggy: str
    fixed: str
    files: str
    kind: str
    description: str
    visible: str
    code: str
    date: str
    found: str
    mistake: str

    @property
    def severity(self) -> str:
        """The worst of what is found, if that is the mistake; empty of one that was never checked."""
        return NOTHING if self.found and self.mistake == "no" else self.found.partition(" ")[0]

    def with_found(self, found: str, code: str, date: str) -> Fix:
        """What a check found; what was read of another finding says nothing of it."""
        return self._replace(found=found, code=code, date=date, mistake=self.mistake if found == self.found else "")


def main() -> int:
    """Check the commits that are at hand, print of which something else is found than before."""
    options = read_options(__doc__)
    listed = read_fixes()
    chosen = options.piece(listed)
    now, missing, failed, lost = {}, [], [], False
    code, date = code_of_today()
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for fix, found in zip(chosen, pool.map(lambda each: goes_away(each, options), chosen), strict=True):
            name = f"{fix.repository} {fix.buggy[:8]}"
            if found is None:
                missing.append(f"{name}: not in the folder of sources")
            elif isinstance(found, str):
                failed.append(f"{name}: {found}")
            else:
                now[fix] = fix.with_found(worst(found), code, date)
                lost = lost or is_lost(fix, now[fix])
                if fix.found != now[fix].found:
                    mark = "FAIL " if is_lost(fix, now[fix]) else ""
                    print(f"{mark}{name} ({fix.description}): {fix.found or 'never checked'} -> {now[fix].found}")
                    print("".join(f"  {e.severity} {e.rule} {e.file}:{e.line} {e.message}\n" for e in found), end="")
                    sys.stdout.flush()
    if options.write:
        write_fixes([now.get(each, each) for each in listed])
    print("".join(f"not checked: {each}\n" for each in [*missing, *failed]), end="")
    counts = Counter(each.severity for each in now.values())
    print(f"{len(now)} of {len(listed)} fixes were checked: {', '.join(f'{counts[s]} {s}' for s in _SEVERITIES[::-1])}")
    return 1 if lost or failed else 0


def goes_away(fix: Fix, options: Options) -> list[Entry] | str | None:
    """What goes away with a fix, or why that is not known; None without a repository."""
    git = repository(options.sources, fix.repository, fix.fixed)
    if git is None:
        return None
    found = []
    for commit in (fix.buggy, fix.fixed):
        base = options.out / "fixes" / fix.repository.replace("/", "+") / commit
        base.mkdir(parents=True, exist_ok=True)
        # The folder is called as the repository: that is the name of a package that is one.
        folder = lay_out(git, commit, base / fix.repository.partition("/")[2])
        files = [each for each in fix.files.split(",") if (folder / each).exists()]
        each = check(options.command, folder, files or ["."])
        if isinstance(each, str):
            return each
        found.append(each)
    changed = subprocess.run(
        ["git", f"--git-dir={git}", "diff", "--name-only", "--no-renames", "-z", fix.buggy, fix.fixed],
        capture_output=True,
        check=True,
    ).stdout.decode(errors="surrogateescape")
    return sorted(gone(*found, {*changed.split("\0"), *fix.files.split(",")}), key=lambda each: -_rank(each.severity))


def gone(buggy: Sequence[Entry], fixed: Sequence[Entry], places: Collection[str]) -> Iterator[Entry]:
    """What only the first has, in some files or folders, other than by its line or the numbers in its message."""
    after = Counter(map(_signature, fixed))
    for entry in buggy:
        if after[_signature(entry)]:
            after[_signature(entry)] -= 1
        elif any(place in (".", entry.file) or entry.file.startswith(f"{place}/") for place in places if place):
            yield entry


def _signature(entry: Entry) -> tuple[str, str, str]:
    return entry.rule, entry.file, re.sub(r"\d+", "#", entry.message)


def worst(found: Sequence[Entry]) -> str:
    """The worst severity, and the rules of that."""
    severity = max((str(each.severity) for each in found), key=_rank, default=NOTHING)
    return " ".join([severity, *sorted({each.rule for each in found if each.severity == severity})])


def is_lost(before: Fix, after: Fix) -> bool:
    """Whether what was found above a hint no longer is."""
    return _rank(before.severity) > _rank("hint") >= _rank(after.severity)


def _rank(severity: str | None) -> int:
    return _SEVERITIES.index(severity) if severity else -1


def read_fixes() -> list[Fix]:
    """The list, in its order."""
    with (DATA / "fixes.tsv").open(newline="") as table:
        return [Fix(**row) for row in csv.DictReader(table, delimiter="\t")]


def write_fixes(fixes: Sequence[Fix]) -> None:
    """Keep what is found now."""
    with (DATA / "fixes.tsv").open("w", newline="") as table:
        writer = csv.writer(table, delimiter="\t", lineterminator="\n")
        writer.writerows([Fix._fields, *fixes])


if __name__ == "__main__":
    sys.exit(main())
