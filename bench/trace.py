"""How long a trace takes, against the bare node's own time to its event loop. Prints medians and ratios of one run.

  python bench/trace.py [-n ROUNDS | --quick]

Bare: the node under a real rosmaster, from exec until the master has the last topic that it registers before it spins.
Cold: `Tracer.trace` without a cache. Warm: `Tracer.lookup` of a cached trace. The kinds take turns in each round, so
that a busy moment of the machine meets them all.
"""

from __future__ import annotations

import os
import statistics
import tempfile
import threading
import time
from pathlib import Path

from bare_node import PYTHON, bare, rosmaster
from options import Options
from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.trace import Tracer

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


def main() -> None:
    timed(Options(__doc__, n=10, quick=1).read().n)


if __name__ == "__main__":
    main()
