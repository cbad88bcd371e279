"""How much processor time the command takes from its start to its end, beside that of Python alone. Prints medians.

  python bench/start.py [-n ROUNDS | --quick]

`check` is that of the demo, whose nodes were run before: nothing is run, and what is left is mostly imports. The kinds
take turns in each round. Time by the clock would be that of whatever else the machine does.
"""

from __future__ import annotations

import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from options import Options
from results import record

DEMO = Path(__file__).parent.parent / "fixtures/ros1/demo"


def seconds(command: list[str], variables: dict[str, str], folder: str) -> float:
    """Processor time of one process, started in a folder, and of what it starts."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(
        command, cwd=folder, env=variables, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def timed(rounds: int, quick: bool) -> None:
    kinds = {
        "python": [sys.executable, "-c", "pass"],
        "--version": [sys.executable, "-m", "preflight_server", "--version"],
        "check of the demo": [sys.executable, "-m", "preflight_server", "check", "demo/launch/talker_listener.launch"],
    }
    with tempfile.TemporaryDirectory() as cache, tempfile.TemporaryDirectory() as folder:
        # A copy: around the original packages are looked for in all that the tests of the editors have installed.
        shutil.copytree(DEMO, Path(folder, "demo"))
        variables = {**os.environ, "ROS_PREFLIGHT_CACHE_DIR": cache}
        variables.pop("PYTHONDONTWRITEBYTECODE", None)
        seconds(kinds["check of the demo"], variables, folder)  # runs the nodes, and has Python compile our modules
        samples = {name: list[float]() for name in kinds}
        for _ in range(rounds):
            for name, command in kinds.items():
                samples[name].append(seconds(command, variables, folder))
    median = {name: statistics.median(found) for name, found in samples.items()}
    print(f"{'median of ' + str(rounds):<24}{'seconds':>9}{'least':>9}{'to python':>11}")
    for name, found in median.items():
        print(f"{name:<24}{found:>9.3f}{min(samples[name]):>9.3f}{found / median['python']:>11.1f}")
    record(quick, version_s=median["--version"], check_of_demo_s=median["check of the demo"])


def main() -> None:
    options = Options(__doc__, n=15, quick=1).read()
    timed(options.n, options.quick)


if __name__ == "__main__":
    main()
