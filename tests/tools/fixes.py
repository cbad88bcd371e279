"""Every fix of every finding in real projects, tried: `make fixes`.

  python tests/tools/fixes.py FOLDER... [--run] [--sample N] [--only REGEX] [--rules REGEX] [--processes N]

A FOLDER is a workspace, or one with a `jobs*.jsonl` of launch files with arguments and package paths, or one with cases
(`<id>/buggy`). Each is copied, and after each fix looked at again, in all launches that read what it edits: every file
parses, the finding is gone, and no error is new. Nothing is run but, with --run, Python launch files and commands.
Prints what failed, how many fixes were tried in each workspace, and a table by rule and format. The exit code is 0 only
if all are right.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import re
import shutil
import sys
import tempfile
from collections import Counter, defaultdict
from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))  # tests/, as pytest has it

from preflight_analysis.documents.document import Document
from preflight_analysis.environment.detect import detect
from preflight_analysis.environment.packages import MANIFEST
from preflight_analysis.findings.contexts import RootFindings
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.merged import merged
from preflight_analysis.workspace.workspace import Analysis
from preflight_server.cli.project import OpenWorkspace, open_workspace, run_nodes_together
from support.fix_property import Launch, Try, tries

_LAUNCH = re.compile(r".*(\.launch|\.launch\.(py|xml|yaml|yml)|_launch\.(py|xml|yaml))\Z")


@dataclass(frozen=True)
class Job:
    """A launch file to look at, with the folders in which its packages are."""

    file: Path
    args: tuple[tuple[str, str], ...] = ()
    package_path: tuple[str, ...] = ()


def main() -> int:
    """Try all fixes of the findings of the jobs."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", type=Path, nargs="+")
    parser.add_argument("--run", action="store_true", help="run Python launch files and commands, in the sandbox")
    parser.add_argument("--sample", type=int, help="only so many launch files, always the same")
    parser.add_argument("--only", default="", help="launch files whose path has this in it")
    parser.add_argument("--rules", default="", help="fixes of the rules whose id begins so")
    parser.add_argument("--processes", type=int, default=2, help="each with a copy of the folder (default: 2)")
    options = parser.parse_args()
    tasks = [(folder, part, options) for folder in options.folders for part in range(options.processes)]
    with ProcessPoolExecutor(options.processes) as pool:
        tried = [each for found in pool.map(_in_a_copy, tasks) for each in found]
    return report(tried)


def _in_a_copy(task: tuple[Path, int, argparse.Namespace]) -> list[Try]:
    folder, part, options = task
    with tempfile.TemporaryDirectory() as temporary:
        copy = Path(temporary, folder.resolve().name)
        shutil.copytree(folder, copy, symlinks=True, ignore_dangling_symlinks=True)
        parts = (part, options.processes)
        return tried_in(
            copy, run=options.run, sample=options.sample, only=options.only, rules=options.rules, part=parts
        )


def tried_in(
    folder: Path,
    *,
    run: bool = False,
    sample: int | None = None,
    only: str = "",
    rules: str = "",
    part: tuple[int, int] = (0, 1),
) -> list[Try]:
    """What comes of all fixes in a folder, which they may write to; or of the `part` (number, of how many) of them."""
    chosen = [job for job in jobs(folder) if re.search(only, str(job.file))]
    if sample is not None and sample < len(chosen):
        chosen = random.Random(0).sample(chosen, sample)
    workspaces = defaultdict[object, list[Job]](list)
    for job in chosen:
        workspaces[job.package_path or job.file.relative_to(folder).parts[0]].append(job)
    known: set[object] = set()
    found: list[Try] = []
    number, parts = part
    for jobs_of_one in sorted(workspaces.values(), key=len, reverse=True)[number::parts]:
        found += _tried_in_workspace(jobs_of_one, known, folder, run=run, rules=rules)
    return found


def opened(job: Job, *, run: bool) -> OpenWorkspace:
    """The workspace of a launch file."""
    environment = detect(str(job.file), package_path=job.package_path or None)
    return open_workspace(environment, argparse.Namespace(no_run=not run), similar=False)


def _tried_in_workspace(of_one: Sequence[Job], known: set[object], folder: Path, *, run: bool, rules: str) -> list[Try]:
    """The fixes of the findings that are shown of the launch files of one workspace. Each is tried in a launch that
    has the finding, and in all others that read what it edits; in no other one of a manifest, which nearly all read."""
    opened_before = opened(of_one[0], run=run)
    jobs_by_name = {_name(job, folder): job for job in of_one}
    launches: list[Launch] = []
    for name, job in jobs_by_name.items():
        analysis = look(opened_before, job)
        launches.append(Launch(name, analysis.findings, frozenset(analysis.documents)))
    sources = opened_before.workspace.sources

    def text_of(path: str) -> str | None:
        found = sources.text(path)
        return found.text if isinstance(found, Document) else None

    def again(texts: Mapping[str, str], launches: Sequence[Launch]) -> Generator[Sequence[Finding]]:
        before = {path: Path(path).read_bytes() for path in texts}
        try:
            for path, text in texts.items():
                Path(path).write_bytes(text.encode())
            opened_before.workspace.refresh()
            workspace = opened(of_one[0], run=run) if _has_manifest(texts) else opened_before
            for number, launch in enumerate(launches):
                # In the others what conditions leave out is as it was: to evaluate that anew takes most of the time.
                yield look(workspace, jobs_by_name[launch.name], branches=number == 0).findings
        finally:
            for path, content in before.items():
                Path(path).write_bytes(content)
            opened_before.workspace.refresh()

    reports = (RootFindings(each.name, frozenset(each.read), tuple(each.found)) for each in launches)
    tried: list[Try] = []
    for finding in (each for found in merged(reports).values() for each in found if re.match(rules, each.rule)):
        if _written(finding) <= known:
            continue
        known |= _written(finding)
        # Of launches that word it differently one is shown.
        having = (each for each in launches if each.name in finding.roots)
        launch = next(each for each in having if finding in (replace(f, roots=finding.roots) for f in each.found))
        only_there = _has_manifest(edit.location.file for fix in finding.fixes for edit in fix.edits)
        others = [] if only_there else [each for each in launches if each is not launch]
        for each in tries([finding], text_of, again, launch, others):
            tried.append(each)
            if each.wrong is not None:
                print(f"{launch.name}: {each.rule} {each.title}: {each.wrong}", flush=True)
    if tried:
        where = os.path.commonpath([os.path.dirname(job.file.relative_to(folder)) for job in of_one])
        print(f"{os.path.join(folder.name, where)}: {len(launches)} launches, {_counted(tried)}", flush=True)
    return tried


def _name(job: Job, folder: Path) -> str:
    return " ".join((os.path.relpath(job.file, folder), *(f"{name}:={value}" for name, value in job.args)))


def _has_manifest(paths: Iterable[str]) -> bool:
    return any(os.path.basename(path) == MANIFEST for path in paths)


def _written(finding: Finding) -> set[object]:
    """What the fixes of a finding write, wherever it was found."""
    return {
        (finding.rule, *((edit.location.file, edit.location.span, edit.text) for edit in fix.edits))
        for fix in finding.fixes
    }


def look(launches: OpenWorkspace, job: Job, *, branches: bool = True) -> Analysis:
    """The analysis of a launch file and of what it leaves out, with what is known of nodes without a run."""
    project = launches.analysed(str(job.file), dict(job.args))
    if branches:
        launches.workspace.set_branches(project.analysis.launch, launches.branches(project.analysis))
    run_nodes_together([project], argparse.Namespace(no_run=True, jobs=1))
    return project.with_results()


def jobs(folder: Path) -> Iterator[Job]:
    """The launch files of a folder."""
    for listed in sorted(folder.glob("jobs*.jsonl")):
        for line in listed.read_text().splitlines():
            job = json.loads(line)
            if (folder / job["file"]).exists():
                args = tuple(tuple(arg.split(":=", 1)) for arg in job["args"])
                yield Job(folder / job["file"], args, tuple(str(folder / each) for each in job["package_path"]))
    for case in sorted(folder.glob("*/case.json")):
        told = json.loads(case.read_text())
        yield Job(case.parent / "buggy" / told["launch"], tuple(told["args"].items()))
    if not any(folder.glob("jobs*.jsonl")) and not any(folder.glob("*/case.json")):
        yield from (Job(path) for path in sorted(folder.rglob("*")) if _LAUNCH.match(path.name) and path.is_file())


def report(tried: Sequence[Try]) -> int:
    """Print the table; the exit code, which is 0 only if there were fixes and all are right."""
    print(table(tried))
    return int(not tried or any(each.wrong is not None for each in tried))


def table(tried: Sequence[Try]) -> str:
    """How many fixes were tried and how many are wrong, by rule and format."""
    total = Counter((each.rule, each.format) for each in tried)
    wrong = Counter((each.rule, each.format) for each in tried if each.wrong is not None)
    rows = [f"{rule}  {form:<24} {count:>5} {wrong[rule, form]:>5}" for (rule, form), count in sorted(total.items())]
    return "\n".join([*rows, _counted(tried)])


def _counted(tried: Sequence[Try]) -> str:
    return f"{len(tried)} fixes tried, {sum(each.wrong is not None for each in tried)} wrong"


if __name__ == "__main__":
    sys.exit(main())
