"""An editor's day, 100,000 edits long, in one server: `make endurance`.

  python tests/tools/endurance [--edits N] [--seed N] [--minutes N] [--source FOLDER]... [--write]
  python tests/tools/endurance --replay FILE [--shrink SECONDS]

Real packages of ROS 1 and ROS 2 are edited as people do, through the protocol of the real server process: typed
character by character, pasted, cut, undone, with several cursors; requests are asked in between and half of them
cancelled; files come, go, are renamed, become folders, links, rings of links, pipes or no text. Every now and then a
fresh server reads the same texts and files: findings and answers must be the same, nothing may be logged as an error,
no process be left, and memory, descriptors and threads be what they were. Then the server and the command meet what is
not as usual (`conditions.py`): they are killed, share a cache, have no disk, no HOME, odd paths.

Everything follows from the seed. What fails is written to `out/endurance`, to be replayed and shortened. Packages are
those of ../shared/corpus, and of the fixtures, where there are no corpora, alone.
"""

from __future__ import annotations

import argparse
import contextlib
import gzip
import json
import math
import os
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))  # tests/, as pytest has it

from tools.endurance import materials, table
from tools.endurance.conditions import Row, conditions
from tools.endurance.lsp_process import Failure
from tools.endurance.scripted_editor import Step
from tools.endurance.shrink import shrunk
from tools.endurance.sitting import Figures, Runner

OUT = materials.REPOSITORY / "out" / "endurance"
REPLAY_SECONDS = 15.0
"""For both servers to come to the same in a replay, of which there are many."""
TRUSTED = 50
"""One edit of so many is made once more in a server that runs launch files and commands in the sandbox."""
SITTING = 1_000
"""Edits until all is closed and as it was."""


def edits(
    packages: Sequence[materials.Package],
    seed: int,
    wanted: int,
    compare_every: int,
    *,
    minutes: float = math.inf,
    trusted: bool = False,
) -> Figures | None:
    """All sittings in one server, none begun after so many minutes. None after a failure, which is printed and written
    down."""
    seeds = range(seed, seed + 1 + -(-wanted // SITTING))
    with tempfile.TemporaryDirectory(prefix="preflight-endurance-") as scratch:
        runner = Runner(packages, Path(scratch), seeds, trusted=trusted)
        began = time.monotonic()
        for each in seeds[1:]:
            if (left := wanted - runner.editor.edits) <= 0 or time.monotonic() - began > 60 * minutes:
                break
            try:
                runner.sit(each, min(SITTING, left), compare_every)
            except Failure as error:
                runner.kill()
                _report(runner, seed, each, str(error))
                return None
            figures = runner.figures
            figures.seconds = time.monotonic() - began
            print(
                f"{figures.edits:>7,} edits {figures.edits / figures.seconds:5.0f}/s"
                f" {figures.megabytes[figures.edits]:6.0f} MB {figures.descriptors[-1]:3} descriptors"
                f" {figures.threads[-1]:3} threads",
                flush=True,
            )
        runner.close()
        return runner.figures


def _report(runner: Runner, base: int, seed: int, error: str) -> None:
    OUT.mkdir(parents=True, exist_ok=True)
    path = OUT / f"seed-{seed}.json.gz"
    with gzip.open(path, "wt") as output:
        written = {"base": base, "seed": seed, "trusted": runner.trusted, "steps": runner.steps, "error": error}
        json.dump(written, output)
    print(f"FAILED: seed {seed} beside {base}, step {len(runner.steps)} of its sitting:\n{error}")
    print(f"the steps are in {path}; shorten them with: python tests/tools/endurance --replay {path} --shrink 600")


def replay(packages: Sequence[materials.Package], path: Path, seconds: float) -> int:
    """Whether what was written down fails in a server of its own, and then what of it does."""
    with gzip.open(path, "rt") as file:
        written = json.load(file)

    def failure(steps: Sequence[Step]) -> str | None:
        with tempfile.TemporaryDirectory(prefix="preflight-endurance-") as scratch:
            seeds = [written["base"], written["seed"]]
            trusted = written.get("trusted", False)
            runner = Runner(packages, Path(scratch), seeds, trusted=trusted, equal_seconds=REPLAY_SECONDS)
            try:
                runner.replay(written["seed"], steps)
            except Failure as error:
                return str(error)
            finally:
                runner.kill()
        return None

    steps = written["steps"]
    if (found := failure(steps)) is None:
        print("it does not fail in a server of its own")
        return 0
    if seconds:
        steps = shrunk(steps, lambda some: failure(some) is not None, seconds)
        found = failure(steps) or found
        with gzip.open(path.with_suffix(".short.gz"), "wt") as output:
            json.dump({**written, "steps": steps}, output)
    print(found)
    for step in steps[-40:]:
        print(json.dumps(step, ensure_ascii=False)[:200])
    return 1


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--edits", type=int, default=table.WHOLE)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--minutes", type=float, default=math.inf, help="begin nothing new after so many")
    parser.add_argument("--compare", type=int, default=1_000, help="edits between two comparisons")
    parser.add_argument("--source", type=Path, action="append", default=[], help="a folder with packages")
    parser.add_argument("--write", action="store_true", help=f"write {table.PAGE}")
    parser.add_argument("--only", choices=("edits", "conditions"))
    parser.add_argument("--replay", type=Path)
    parser.add_argument("--shrink", type=float, default=0, metavar="SECONDS")
    args = parser.parse_args()
    sources, where = materials.sources(args.source)
    packages = materials.packages_of(sources)
    if args.replay:
        return replay(packages, args.replay, args.shrink)
    figures = ran = None
    grown: str | None = None
    rows: list[Row] = []
    if args.only != "conditions":
        print(f"{args.edits:,} edits in files of {len(packages)} packages ({where}), seed {args.seed}", flush=True)
        figures = edits(packages, args.seed, args.edits, args.compare, minutes=args.minutes)
        if figures is None:
            return 1
        grown = table.grown(figures)
        print("the same where launch files and commands are run in the sandbox", flush=True)
        ran = edits(packages, args.seed, max(args.edits // TRUSTED, 200), args.compare, trusted=True)
        if ran is None:
            return 1
    if args.only != "edits":
        rows = conditions()
    text = table.text(figures, ran, rows, where)
    print(text)
    if args.write:
        table.PAGE.write_text(text)
    if grown:
        print(f"FAILED: {grown}")
    return int(grown is not None or any(row.failure for row in rows))


if __name__ == "__main__":
    with contextlib.suppress(BrokenPipeError):
        os.umask(0o022)
        sys.exit(main())
