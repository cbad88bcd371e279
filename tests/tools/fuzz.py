#!/usr/bin/env python3
"""All fuzz targets for a given time, side by side, and a table of what they found: `make fuzz`.

Inputs come from atheris where it is installed, which follows the coverage and keeps what it learnt in `out/fuzz`; else
from hypothesis, as in the tests. `--target NAME` runs one, `--target NAME FILE...` a target with what was found.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import subprocess
import sys
import time
import traceback
import zlib
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(Path(__file__).parents[1]))  # tests/, as pytest has it
OUT = ROOT / "out" / "fuzz"
EDITS = "random-edits"
"""A target of its own: what is remembered while somebody edits, against a fresh analysis."""
_SLACK = 60.0
"""Seconds after its time within which a target has to have ended."""


class Record:
    """What one target did so far. It is written down again and again: the process may be ended from outside."""

    def __init__(self, name: str, by: str, seconds: float) -> None:
        self.folder = OUT / name
        self.folder.mkdir(parents=True, exist_ok=True)
        self._told: dict[str, Any] = {"by": by, "executions": 0, "slowest": 0.0, "found": {}}
        self._began = self._written = time.monotonic()
        self.deadline = self._began + seconds

    def run(self, action: Callable[[], None], data: bytes) -> None:
        """Run a target once and keep what it finds, the same only once."""
        began = time.process_time()
        try:
            action()
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            self.found(error, data)
        self._told["executions"] += 1
        self._told["slowest"] = max(self._told["slowest"], time.process_time() - began)
        if time.monotonic() - self._written > 1:
            self.write()

    def add(self, executions: int) -> None:
        """Count what was run without `run`."""
        self._told["executions"] += executions

    def found(self, error: BaseException, data: bytes) -> None:
        """Keep the input and the traceback under a name made of where it was raised."""
        frames = traceback.extract_tb(error.__traceback__)
        ours = [f for f in frames if "preflight_" in f.filename or "fuzz_" in f.filename][-3:] or frames[-1:]
        key = repr((type(error).__name__, [(f.filename, f.name, f.lineno) for f in ours]))
        name = f"found-{zlib.crc32(key.encode()):08x}"
        if name not in self._told["found"]:
            self._told["found"][name] = f"{type(error).__name__}: {error}"[:300]
            (self.folder / name).write_bytes(data)
            (self.folder / f"{name}.txt").write_text("".join(traceback.format_exception(error)), errors="replace")
            self.write()

    def write(self) -> None:
        self._written = time.monotonic()
        self._told["seconds"] = self._written - self._began
        part = self.folder / "result.part"
        part.write_text(json.dumps(self._told))
        part.replace(self.folder / "result.json")


def guided(name: str, seconds: float) -> None:
    """By atheris. Does not return: neither does libFuzzer."""
    import atheris

    with atheris.instrument_imports(include=["preflight_analysis"]):
        from fuzzing import targets
    target = next(each for each in targets.TARGETS if each.name == name)
    record = Record(name, "atheris", seconds)
    corpus, words = record.folder / "corpus", record.folder / "words"
    corpus.mkdir(exist_ok=True)
    for seed in target.seeds():
        (corpus / f"seed-{zlib.crc32(seed):08x}").write_bytes(seed)
    words.write_text("".join('"%s"\n' % "".join(f"\\x{b:02x}" for b in word.encode()) for word in target.words))

    def one(data: bytes) -> None:
        record.run(lambda: targets.bounded(target.run, data), data)
        if time.monotonic() > record.deadline:
            record.write()
            os._exit(0)

    dictionary = [f"-dict={words}"] if target.words else []
    options = [f"-max_len={targets.seeds.LONGEST}", "-rss_limit_mb=4096", "-timeout=120", "-verbosity=0"]
    atheris.Setup([sys.argv[0], *options, *dictionary, f"-artifact_prefix={record.folder}/", str(corpus)], one)
    atheris.Fuzz()


def drawn(name: str, seconds: float) -> None:
    """By hypothesis."""
    from fuzzing import targets
    from hypothesis import HealthCheck, Phase, given, settings

    target = next(each for each in targets.TARGETS if each.name == name)
    record = Record(name, "hypothesis", seconds)
    for seed in target.seeds():
        record.run(lambda seed=seed: targets.bounded(target.run, seed), seed)  # type: ignore[misc]

    @settings(max_examples=40, database=None, deadline=None, phases=[Phase.generate], suppress_health_check=HealthCheck)
    @given(targets.inputs(target))
    def some(data: bytes) -> None:
        record.run(lambda: targets.bounded(target.run, data), data)

    while time.monotonic() < record.deadline:
        some()
    record.write()


def edited(seconds: float) -> None:
    """The random edits."""
    from preflight_analysis.environment.packages import find_packages

    from tools import random_edits

    corpus = ROOT.parent / "shared" / "corpus" / "ros1" / "src"
    folder = corpus if corpus.is_dir() else ROOT / "fixtures" / "ros1"
    packages = find_packages([str(folder)]).packages
    record = Record(EDITS, "edits", seconds)
    seed = time.time_ns() % 1_000_000
    while time.monotonic() < record.deadline:
        seed += 1
        try:
            record.add(random_edits.run(folder, packages, seed, 200, record.deadline))
        except random_edits.Broken as broken:
            record.found(broken, str(broken).encode())
        record.write()


def names() -> list[str]:
    """All targets."""
    from fuzzing import targets

    return [*(target.name for target in targets.TARGETS), EDITS]


def read_result(name: str) -> dict[str, Any]:
    """What a target told last."""
    try:
        told: dict[str, Any] = json.loads((OUT / name / "result.json").read_text())
    except (OSError, ValueError):
        told = {"by": "", "executions": 0, "slowest": 0.0, "seconds": 0.0, "found": {}}
    return told


def run_target(name: str, seconds: float) -> dict[str, Any]:
    """Run a target in a process of its own; what it tells, or how it broke."""
    folder = OUT / name
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "result.json").unlink(missing_ok=True)
    with (folder / "log").open("w") as log:
        command = [sys.executable, __file__, "--target", name, "--seconds", str(seconds)]
        process = subprocess.Popen(command, stdout=log, stderr=log, stdin=subprocess.DEVNULL, cwd=ROOT)
        try:
            code: int | str = process.wait(seconds + _SLACK)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            code = "it did not end"
    told = read_result(name)
    if code != 0:
        told["found"]["log"] = f"the process ended with {code}"
    return told


def main() -> int:
    """Run all targets, or one."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=600.0, help="for all targets together (default: %(default)g)")
    parser.add_argument("--target", help="this one alone")
    parser.add_argument("--only", nargs="*", help="of all targets only these")
    parser.add_argument("files", nargs="*", type=Path, help="inputs for the target instead of made-up ones")
    options = parser.parse_args()
    if options.files:
        from fuzzing import targets

        target = next(each for each in targets.TARGETS if each.name == options.target)
        for path in options.files:
            targets.bounded(target.run, path.read_bytes())
        return 0
    if options.target == EDITS:
        edited(options.seconds)
        return 0
    if options.target:
        unguided = options.target == "lsp-messages" or importlib.util.find_spec("atheris") is None
        (drawn if unguided else guided)(options.target, options.seconds)
        return 0
    chosen = [name for name in names() if options.only is None or name in options.only]
    workers = min(len(chosen), len(os.sched_getaffinity(0)))
    each = options.seconds * workers / len(chosen)
    print(f"{len(chosen)} targets, {each:.0f} s each, {workers} at once", flush=True)
    print(f"{'target':16}{'inputs by':>12}{'executions':>12}{'seconds':>9}{'slowest':>9}  found", flush=True)
    found = 0
    with ThreadPoolExecutor(workers) as pool:
        for name, told in zip(chosen, pool.map(lambda name: run_target(name, each), chosen), strict=True):
            numbers = f"{told['by']:>12}{told['executions']:>12}{told['seconds']:>9.0f}{told['slowest']:>8.1f}s"
            print(f"{name:16}{numbers}  {len(told['found']) or 'nothing'}", flush=True)
            for file, what in told["found"].items():
                print(f"    out/fuzz/{name}/{file}: {' '.join(what.split())[:160]}", flush=True)
            found += len(told["found"])
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
