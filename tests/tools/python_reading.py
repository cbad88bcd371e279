"""How far the reading of Python launch files agrees with their runs, over public ROS 2 projects.

The projects are git repositories in one folder, as `<owner>+<name>/repo`. What a run in the sandbox answers is kept, so
that a second time only the reading is done. Answers are compared part by part: one without anything unread has to be
that of the run, in another one what is known.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import logging
import re
import sys
import time
from collections import Counter
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1]))

from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.evaluation.ros2.python_agreement import differences
from preflight_analysis.evaluation.ros2.python_runs import parse_request
from preflight_analysis.tracing.commands import CommandCache, CommandRunner
from preflight_analysis.tracing.reading.answers import answer
from preflight_analysis.workspace.commands import CommandResults
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.resolve_commands import Resolving, resolve_together
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

from tools.python_launch_coverage import DEFINES
from tools.ros2_python_corpus import take_over


def main() -> int:
    """Run, read and compare."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("projects", nargs="*", help="<owner>+<name>; all without")
    parser.add_argument("--sources", type=Path, required=True)
    parser.add_argument("--out", type=Path, default=Path("out/python-reading"))
    parser.add_argument("--half", choices=("even", "odd", "all"), default="all", help="of the projects, by their names")
    parser.add_argument("--seconds", type=float, default=1e9, help="no further project is begun after so long")
    parser.add_argument("--show", type=int, default=30)
    options = parser.parse_args()
    options.out = options.out.resolve()
    logging.basicConfig(level=logging.WARNING, format="    %(message)s")
    logging.getLogger("preflight_analysis.tracing.reading").setLevel(logging.DEBUG)
    named = options.projects or sorted(path.parent.name for path in options.sources.glob("*/repo"))
    if options.half != "all":
        named = [n for n in named if hashlib.md5(n.encode()).digest()[0] % 2 == (options.half == "odd")]
    begun, sums, reasons, wrong = time.monotonic(), Counter(), Counter(), []
    for project in named:
        if time.monotonic() - begun > options.seconds:
            break
        counts = compare(project, options, reasons, wrong)
        sums.update(counts)
        print(f"{project:45} {dict(counts)}", flush=True)
    print(f"all: {dict(sums)}\n\nwhat is not read, by requests:")
    for why, count in reasons.most_common(options.show):
        print(f"{count:5}  {why}")
    print("\nwhat differs:")
    for line in wrong[: options.show]:
        print(line)
    return 0


def compare(project: str, options: Any, reasons: Counter[str], wrong: list[str]) -> Counter[str]:
    """The requests of a project, counted by how their readings are."""
    folder = options.out / "src" / project
    if not folder.is_dir():
        take_over(options.sources / project / "repo", "HEAD", folder)
    variables = {"PATH": "/usr/bin:/bin", "LANG": "C.UTF-8", "HOME": "/root"}
    empty = options.out / "cache" / "empty"
    empty.mkdir(parents=True, exist_ok=True)
    environment = detect_environment(str(folder), variables, (str(folder),), (), root=str(empty))
    sources = Sources()
    kept = options.out / "runs" / f"{project}.json"
    if not kept.is_file():
        kept.parent.mkdir(parents=True, exist_ok=True)
        kept.write_text(json.dumps(_run(folder, environment, options.out / "cache")))
    counts: Counter[str] = Counter()
    for line, output in json.loads(kept.read_text()).items():
        request = parse_request(line)
        assert request is not None
        kind = "call" if request["calls"] else "file"
        counts[kind] += 1
        began = time.perf_counter()
        given = answer(environment, sources, request)
        counts["ms"] += int(1000 * (time.perf_counter() - began))
        run = json.loads(output)
        if "error" in run and kind == "file":
            counts["file raises"] += 1
        if given is None:
            counts[f"{kind} not read"] += 1
            reasons["not read at all"] += 1
            continue
        for name, reason, _ in given["unread"]:
            reasons[f"{re.sub(r'[0-9]+', '0', name)[:60]}: {reason[:60]}"] += 1
        found = list(differences(given, run))
        complete = not given["unread"]
        counts[f"{kind} {'whole' if complete else 'partly'}{' WRONG' if found else ''}"] += 1
        if found:
            where = f"{request['file']} {[c['name'] for c in request['calls']]}"
            wrong.append(f"{'whole' if complete else 'partly'} {where}\n      {found[0][:400]}")
    return counts


def _run(folder: Path, environment: Any, cache: Path) -> dict[str, str]:
    results = CommandResults(lambda: None)
    workspace = Workspace(environment, Sources(), str(folder), results, reads=False)
    runner = CommandRunner(environment, str(folder), CommandCache(cache / "commands"))
    paths = [
        str(path)
        for path in sorted(folder.rglob("*.py"))
        if path.is_file() and DEFINES.search(path.read_text(encoding="utf-8", errors="replace"))
    ]
    found: dict[str, str] = {}
    for start in range(0, len(paths), 8):
        roots = [Root.of(path, {}) for path in paths[start : start + 8]]
        resolve_together(workspace, roots, Resolving(results, runner))
        for root in roots:
            for command in workspace.static(root.path, {}).tree.commands:
                if command.launch_file and command.result is not None and command.result.status == "done":
                    found[command.line] = command.result.output
    return found


if __name__ == "__main__":
    sys.exit(main())
