"""How long the command of a parameter takes, against the same command alone. Prints medians and ratios of one run.

  python bench/commands.py [-n ROUNDS | --quick]

Bare: the command as roslaunch runs it. Cold: `CommandRunner.run` without a cache, in the sandbox. Cached:
`CommandRunner.lookup` in a process that has just looked it up, with all files that it read compared. The kinds take
turns in each round.
"""

from __future__ import annotations

import shlex
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from options import Options
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.commands import CommandCache, CommandRunner

sys.path.append(str(Path(__file__).parent.parent / "tests"))
from support.xacro_package import create_robot


def timed(rounds: int) -> None:
    print(f"{'median of ' + str(rounds):<30}{'bare':>9}{'cold':>9}{'cached':>9}{'cold/bare':>11}{'cached/bare':>13}")
    with tempfile.TemporaryDirectory() as folder:
        workspace = str(Path(folder, "workspace"))
        create_robot(Path(workspace))
        variables = {"PATH": "/usr/bin:/bin", "ROS_PACKAGE_PATH": workspace}
        environment = detect_environment(None, variables, [workspace])
        cold = CommandRunner(environment, workspace, None)
        cached = CommandRunner(environment, workspace, CommandCache(Path(folder, "cache")))
        cancel = threading.Event()
        arm = f"{workspace}/arm/urdf/arm.xacro"
        for title, line in (("xacro", f"{workspace}/xacro/xacro {arm} side:=left"), ("cat", f"cat {arm}")):
            expected = cached.run(line, cancel)
            if expected.status != "done":
                raise SystemExit(f"{line}: {expected}")
            samples: dict[str, list[float]] = {"bare": [], "cold": [], "cached": []}
            for _ in range(rounds):
                began = time.perf_counter()
                subprocess.run(shlex.split(line), env=variables, cwd=workspace, stdout=subprocess.PIPE, check=True)
                samples["bare"].append(time.perf_counter() - began)
                for kind, result in (("cold", cold.run), ("cached", lambda line, _: cached.lookup(line))):
                    began = time.perf_counter()
                    if result(line, cancel) != expected:
                        raise SystemExit(f"{line}: not the same {kind}")
                    samples[kind].append(time.perf_counter() - began)
            b, c, w = (statistics.median(samples[kind]) for kind in ("bare", "cold", "cached"))
            print(f"{title:<30}{b:>8.3f}s{c:>8.3f}s{w:>8.4f}s{c / b:>11.2f}{w / b:>13.4f}")


def main() -> None:
    timed(Options(__doc__, n=10, quick=1).read().n)


if __name__ == "__main__":
    main()
