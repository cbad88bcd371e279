"""How long a trace takes, against the bare node's own time to its event loop. Prints medians and ratios of one run.

  python bench/trace.py [-n ROUNDS | --quick]

Bare: the node under a real rosmaster, from exec until the master has the last topic that it registers before it spins.
Cold: `Tracer.trace` without a cache. Warm: `Tracer.lookup` of a cached trace. The kinds take turns in each round, so
that a busy moment of the machine meets them all.

Containers of ROS 2 and their components likewise, cold and as many runs at a time as the command has, against the
container that loads none.
"""

from __future__ import annotations

import os
import shutil
import statistics
import sys
import tempfile
import threading
import time
from pathlib import Path

sys.path.append(str(Path(__file__).parent.parent / "tests"))

from bare_node import PYTHON, bare, rosmaster
from options import Options
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.schedule import most_at_once, trace_all
from preflight_analysis.tracing.trace import Tracer
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.rcl_harness import ContainerHarness, rcl_node

FIXTURES = Path(__file__).parent.parent / "fixtures" / "ros1"
NODES = {
    "demo/talker (Rate loop)": (FIXTURES / "demo/scripts/talker.py", "/chatter"),
    "demo/listener (rospy.spin)": (FIXTURES / "demo/scripts/listener.py", "/chatter"),
    "tutorials/advanced_publish": (FIXTURES / "tutorials/scripts/advanced_publish.py", "~numbers"),
    "rosout (roscpp, ros::spin)": (Path("/usr/lib/rosout/rosout"), "/rosout_agg"),
}


def timed(rounds: int) -> None:
    package_path = (str(FIXTURES),)
    variables = {"PATH": "/usr/bin:/bin", "ROS_PACKAGE_PATH": str(FIXTURES)}
    environment = Environment(
        1, "noetic", variables, package_path, {}, {}, (), ("/usr",), PYTHON, named_folders=package_path
    )
    cancel = threading.Event()
    print(f"{'median of ' + str(rounds):<30}{'bare':>9}{'cold':>9}{'warm':>9}{'cold/bare':>11}{'warm/bare':>11}")
    with tempfile.TemporaryDirectory() as folder, rosmaster(folder) as ros:
        cold_tracer, warm_tracer = Tracer(environment, None), Tracer(environment, TraceCache(Path(folder) / "cache"))
        for title, (script, topic) in NODES.items():
            request = TraceRequest("/node", "bench", os.fspath(script))
            warm_tracer.trace(request, cancel)
            samples: dict[str, list[float]] = {"bare": [], "cold": [], "warm": []}
            for number in range(rounds):
                samples["bare"].append(bare(script, topic, ros, number))
                began = time.perf_counter()
                found = cold_tracer.trace(request, cancel)
                samples["cold"].append(time.perf_counter() - began)
                if found.outcome.status != "spinning":
                    raise SystemExit(f"{script}: {found.outcome}")
                began = time.perf_counter()
                if warm_tracer.lookup(request) is None:
                    raise SystemExit(f"{script}: not in the cache")
                samples["warm"].append(time.perf_counter() - began)
            b, c, w = (statistics.median(samples[kind]) for kind in ("bare", "cold", "warm"))
            print(f"{title:<30}{b:>8.3f}s{c:>8.3f}s{w:>8.4f}s{c / b:>11.2f}{w / b:>11.4f}")


def composed(rounds: int) -> None:
    """Launches of containers and of lifecycle nodes."""

    def container(*names: str) -> str:
        inside = "".join(f"<composable_node pkg='cpkg' plugin='cpkg::{name}' name='{name}'/>" for name in names)
        return f"<node_container pkg='cpkg' exec='node' name='box' namespace=''>{inside}</node_container>"

    plain, managed = [f"Plain{n}" for n in range(10)], [f"Managed{n}" for n in range(11)]
    launches = {
        "a container alone": container(),
        "with ten components": container(*plain),
        "eleven lifecycle nodes": "".join(
            f"<node pkg='cpkg' exec='other' args='managed {name}' name='{name}'/>" for name in managed
        ),
        "composed": container(*managed),
    }
    with tempfile.TemporaryDirectory() as folder:
        harness = ContainerHarness(Path(folder))
        for name in (*plain, *managed):
            harness.component(name, f"pub={name} sub=~/in double=rate@1.5" + (" managed" if name in managed else ""))
        shutil.copy(rcl_node(source="rcl_node.c"), harness.program.with_name("other"))
        environment = detect_environment(folder, harness.variables)
        tracer = Tracer(environment, None)
        samples: dict[str, list[float]] = {title: [] for title in launches}
        for number in range(-1, rounds):  # the first time is for what is compiled once
            for title, inside in launches.items():
                harness.launch_file.write_text(f"<launch>{inside}</launch>")
                workspace = Workspace(environment, Sources())
                requests = [each for each in workspace.requests(workspace.static(str(harness.launch_file))) if each]
                began = time.perf_counter()
                trace_all(tracer, requests, workers=most_at_once(), on_done=is_up, cancel=threading.Event())
                if number >= 0:
                    samples[title].append(time.perf_counter() - began)
    print(f"\n{'median of ' + str(rounds):<30}{'cold':>9}{'cold/alone':>12}")
    alone = statistics.median(samples["a container alone"])
    for title, seconds in samples.items():
        print(f"{title:<30}{statistics.median(seconds):>8.3f}s{statistics.median(seconds) / alone:>12.2f}")


def is_up(_index: int, found: Interface) -> None:
    if found.outcome.status != "spinning":
        raise SystemExit(f"{found.outcome}")


def main() -> None:
    rounds = Options(__doc__, n=10, quick=1).read().n
    timed(rounds)
    composed(rounds)


if __name__ == "__main__":
    main()
