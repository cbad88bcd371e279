"""How long the evaluation of a Python launch file takes, against bare `python` that imports it and calls it.

  python bench/launch_files.py [-n ROUNDS | --quick] [--package-path FOLDERS] [FOLDER | FILE]...

Bare: an interpreter that runs the file and calls `generate_launch_description()`, with our fake of launch, as
there need not be another one. Evaluated: its run in the sandbox without a cache, and the evaluation before and after.
Settled: with all that it includes and with its opaque functions. Files that raise are left out. Prints the median,
the 95th percentile and the worst of the ratios. The files run outside of the sandbox too: name only such as you trust.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from options import Options
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing import backend
from preflight_analysis.tracing.commands import CommandRunner
from preflight_analysis.workspace.commands import CommandResults, run_commands
from preflight_analysis.workspace.resolve_commands import Resolving, resolve_commands
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

ROOT = Path(__file__).parent.parent
BARE = """
import runpy, sys
sys.path[0] = sys.argv[1]
from agents.fake_launch.base import RECORDER
from agents.fake_launch.modules import install
install()
RECORDER.file, RECORDER.packages = sys.argv[2], dict(word.split('=', 1) for word in sys.argv[3:])
runpy.run_path(sys.argv[2])['generate_launch_description']()
"""


@dataclass(frozen=True)
class Sample:
    """Seconds."""

    file: Path
    bare: float
    evaluated: float
    resolved: float


def timed(file: Path, environment: Environment, rounds: int) -> Sample | None:
    """The medians for one file; None if it raises."""
    python = environment.ros2_python or environment.python or sys.executable
    packages = [f"{name}={package.share}" for name, package in environment.packages.items()]
    fake_launch = str(Path(backend.__file__).parent)
    bare = [python, "-c", BARE, fake_launch, str(file), *packages]
    samples: dict[str, list[float]] = {"bare": [], "evaluated": [], "resolved": []}
    for _ in range(rounds):
        began = time.perf_counter()
        with tempfile.TemporaryDirectory() as folder:
            given = {**os.environ, "TMPDIR": folder}
            if subprocess.run(bare, env=given, cwd=folder, capture_output=True, check=False).returncode != 0:
                return None
        samples["bare"].append(time.perf_counter() - began)
        runner = CommandRunner(environment, "/", None)
        results = CommandResults(lambda: None)
        workspace = Workspace(environment, Sources(), "/", results)
        began = time.perf_counter()
        asked = [command.line for command in workspace.static(str(file)).tree.commands if command.launch_file]
        results.update(run_commands(runner, asked[:1], threading.Event()))
        if not workspace.static(str(file)).tree.nodes and not asked:
            return None
        samples["evaluated"].append(time.perf_counter() - began)
        resolve_commands(workspace, str(file), {}, Resolving(results, runner, only_launch_files=True))
        samples["resolved"].append(time.perf_counter() - began)
    return Sample(file, *(statistics.median(samples[kind]) for kind in ("bare", "evaluated", "resolved")))


def found(paths: list[Path]) -> Iterator[Path]:
    """The Python launch files."""
    for path in paths:
        files = sorted(path.rglob("*launch.py")) if path.is_dir() else [path]
        for file in files:
            if "generate_launch_description" in file.read_text(errors="replace"):
                yield file.resolve()


def main() -> None:
    options = Options(__doc__, n=3, quick=1)
    options.add_argument("--package-path", default=str(ROOT / "fixtures" / "ros2"))
    options.add_argument("paths", nargs="*", type=Path, default=[ROOT / "fixtures" / "ros2"])
    args = options.read()
    variables = {"PATH": "/usr/bin:/bin", "ROS_DISTRO": "jazzy", "ROS_VERSION": "2", "LANG": "C.UTF-8"}
    environment = detect_environment(None, variables, args.package_path.split(os.pathsep))
    files = list(found(args.paths))
    samples = [sample for file in files if (sample := timed(file, environment, args.n)) is not None]
    print(f"{len(samples)} of {len(files)} Python launch files, bare median {_median(samples, 'bare'):.3f} s")
    for kind in ("evaluated", "resolved"):
        ratios = sorted((getattr(each, kind) / each.bare, each) for each in samples if each.bare)
        worst = ratios[-1]
        high = ratios[min(len(ratios) - 1, int(len(ratios) * 0.95))][0]
        median = statistics.median(ratio for ratio, _ in ratios)
        print(f"{kind + '/bare':<16} median {median:.2f}  p95 {high:.2f}  worst {worst[0]:.2f} {worst[1].file}")


def _median(samples: list[Sample], kind: str) -> float:
    return statistics.median(getattr(each, kind) for each in samples)


if __name__ == "__main__":
    main()
