"""How many Python launch files of public ROS 2 projects are evaluated where no ROS is installed, and what stops others.

The projects are git repositories in one folder, as `<owner>+<name>/repo`; each file is a root without arguments.
One is wholly evaluated if it ran to its end, and so did all that it asks of its own code: opaque functions,
substitutions, conditions. It is complete if besides nothing of its tree is unknown, of what it includes neither.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import sys
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1]))

from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.evaluation.problems import ArgumentNeeded
from preflight_analysis.evaluation.ros2.python_runs import parse_request
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.tracing.commands import CommandCache, CommandRunner
from preflight_analysis.workspace.commands import CommandResults
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.resolve_commands import Resolving, resolve_together
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

from tools.ros2_python_corpus import take_over

DEFINES = re.compile(r"^def generate_launch_description\b", re.MULTILINE)


def main() -> int:
    """Evaluate the launch files of all projects, print a line for each project and what was met most."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("projects", nargs="*", help="<owner>+<name>; all that have Python launch files without")
    parser.add_argument("--sources", type=Path, required=True, help="the folder with the git repositories")
    parser.add_argument("--out", type=Path, default=Path("out/python-launch"), help="failed.tsv there has each failure")
    parser.add_argument("--show", type=int, default=25, help="how many reasons")
    options = parser.parse_args()
    named = options.projects or sorted(path.parent.name for path in options.sources.glob("*/repo"))
    sums: Counter[str] = Counter()
    reasons: Counter[str] = Counter()
    unknown: Counter[str] = Counter()
    examples: dict[str, str] = {}
    options.out.mkdir(parents=True, exist_ok=True)
    failures = options.out / "failed.tsv"
    failures.write_text("")
    print(f"{'project':48} files whole partly not complete seconds", flush=True)
    for project in named:
        folder = options.out / "src" / project
        take_over(options.sources / project / "repo", "HEAD", folder)
        started = time.monotonic()
        counts: Counter[str] = Counter()
        for path, tree in _trees(folder, options.out / "cache"):
            failed = list(_failures(path, tree))
            kind = "not" if any(root for root, _ in failed) else "partly" if failed else "whole"
            counts[kind] += 1
            counts["complete"] += tree.complete or (not failed and _only_needs_arguments(tree))
            for _, why in failed:
                reasons[why] += 1
                examples.setdefault(why, path)
                with failures.open("a") as table:
                    table.write(f"{os.path.relpath(path, options.out / 'src')}\t{kind}\t{why}\n")
            unknown.update({re.sub(r"'[^']*'|/\S+", "...", each.reason) for each in tree.unknowns})
        total = counts["whole"] + counts["partly"] + counts["not"]
        if total:
            sums.update(counts)
            sums["files"] += total
            _print(project, total, counts, time.monotonic() - started)
    _print("all", sums["files"], sums, 0)
    print(f"\nwholly evaluated: {sums['whole'] / max(sums['files'], 1):.1%}\n\nwhat stopped one:")
    for why, count in reasons.most_common(options.show):
        print(f"{count:5}  {why}\n       {examples[why]}")
    print("\nwhat is unknown, by files:")
    for why, count in unknown.most_common(options.show):
        print(f"{count:5}  {why}")
    return 0


def _print(project: str, total: int, counts: Counter[str], seconds: float) -> None:
    kinds = (counts[kind] for kind in ("whole", "partly", "not", "complete"))
    print(f"{project:48} {total:5} {'{:5} {:6} {:3} {:8}'.format(*kinds)} {seconds:7.1f}", flush=True)


def _trees(folder: Path, cache: Path) -> Iterator[tuple[str, LaunchTree]]:
    """Each launch file of a project with its tree, as on a machine with Python and nothing of ROS."""
    paths = [
        str(path)
        for path in sorted(folder.rglob("*.py"))
        if path.is_file() and DEFINES.search(path.read_text(encoding="utf-8", errors="replace"))
    ]
    if not paths:
        return
    empty = cache / "empty"
    empty.mkdir(parents=True, exist_ok=True)
    variables = {"PATH": "/usr/bin:/bin", "LANG": "C.UTF-8", "HOME": os.environ.get("HOME", "/")}
    environment = detect_environment(str(folder), variables, (str(folder),), (), root=str(empty))
    results = CommandResults(lambda: None)
    workspace = Workspace(environment, Sources(), str(folder), results)
    runner = CommandRunner(environment, str(folder), CommandCache(cache / "commands"))
    for start in range(0, len(paths), 8):
        roots = [Root.of(path, {}) for path in paths[start : start + 8]]
        resolve_together(workspace, roots, Resolving(results, runner))
        for root in roots:
            yield root.path, workspace.static(root.path, {}).tree


def _failures(path: str, tree: LaunchTree) -> Iterator[tuple[bool, str]]:
    """What of a launch file itself did not run to its end: whether that is all of it, and why."""
    for command in tree.commands:
        asked = parse_request(command.line) if command.launch_file else None
        if asked is None or asked["file"] != path:
            continue
        why = _why(command.result.output) if command.result and command.result.status == "done" else None
        if command.result is None or command.result.status != "done":
            why = f"not run: {command.result.reason if command.result else ''}"
        if why is not None:
            yield not asked["calls"], why


def _why(output: str) -> str | None:
    answer: Any = json.loads(output)
    error = answer.get("error")
    if error is None:
        return None
    message = re.sub(r"(?<=/)\S*/", ".../", str(error["message"]).partition("\n")[0])
    return f"{error['type']}: {message[:150]}"


def _only_needs_arguments(tree: LaunchTree) -> bool:
    return not tree.unknowns and all(isinstance(p.kind, ArgumentNeeded) for p in tree.problems if p.fatal)


if __name__ == "__main__":
    sys.exit(main())
