"""How long the nodes of a launch take, all of them, and the same again after a restart, when they are in the cache.

  python bench/fleet.py [-n NODES | --quick]

Half of the nodes are rospy's and half roscpp's, each an executable of its own, in a workspace that is made for the
occasion; and as many nodes of two executables, in namespaces of their own. The baseline of the same run is the sum of
what the nodes take bare, one after the other. By the command line: `ros-preflight trace`. By the server: from the
opening of the file to the findings that need all nodes. Two nodes are run at a time.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from bare_node import bare, rosmaster
from client import Client
from options import Options

ROSOUT = Path("/usr/lib/rosout/rosout")
TALKER = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import String

rospy.init_node("talker")
rospy.Publisher("words{0}", String, queue_size=1)
rospy.spin()
"""


def create_workspace(workspace: Path, count: int) -> tuple[Path, Path]:
    """A package with that many executables, a launch file of all of them, and one of two of them many times."""
    for name in ("launch", "scripts"):
        (workspace / name).mkdir(parents=True)
    workspace.joinpath("package.xml").write_text(
        '<package format="2"><name>fleet</name><version>1.0.0</version><description>d</description>'
        "<maintainer email='a@b.c'>m</maintainer><license>MIT</license><exec_depend>rospy</exec_depend></package>\n"
    )
    for number in range(count // 2):
        script = workspace / f"scripts/talker_{number}.py"
        script.write_text(TALKER.format(number))
        script.chmod(0o755)
        shutil.copy(ROSOUT, workspace / f"scripts/rosout_{number}")
    node = '  <node pkg="fleet" type="{}" name="{}" ns="{}"/>\n'
    # It subscribes to what nobody publishes: that is told as soon as all others are known.
    last = '  <node pkg="topic_tools" type="relay" name="relay" args="words_0 out"/>\n'
    various, alike = "", ""
    for number in range(count // 2):
        various += node.format(f"talker_{number}.py", f"talker_{number}", "/")
        various += node.format(f"rosout_{number}", f"rosout_{number}", "/")
        alike += node.format("talker_0.py", "talker", f"robot_{number}")
        alike += node.format("rosout_0", "rosout", f"robot_{number}")
    paths = (workspace / "launch/various.launch", workspace / "launch/alike.launch")
    for path, nodes in zip(paths, (various, alike), strict=True):
        path.write_text(f"<launch>\n{nodes}{last}</launch>\n")
    return paths


def by_command(path: Path, home: Path) -> float:
    """Seconds that `trace` takes."""
    environment = {**os.environ, "HOME": str(home), "XDG_CACHE_HOME": str(home / ".cache")}
    command = [sys.executable, "-m", "preflight_server.cli.main", "trace", str(path), "--format", "json"]
    began = time.perf_counter()
    done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, text=True, check=True)
    took = time.perf_counter() - began
    missing = done.stdout.count('"status": "not-run"') + done.stdout.count('"status": "crashed"')
    if missing:
        raise SystemExit(f"{missing} of the nodes were not traced")
    return took


def by_server(path: Path, home: Path) -> float:
    """Seconds from the opening of the file to the findings that need all of its nodes."""
    client = Client(path.parents[1], home, trusted=True)
    item = {"uri": path.as_uri(), "languageId": "roslaunch", "version": 1, "text": path.read_text()}
    began = time.perf_counter()
    client.notify("textDocument/didOpen", {"textDocument": item})
    client.diagnostics(lambda p: p["uri"] == path.as_uri() and any(d["code"] == "TOP001" for d in p["diagnostics"]))
    took = time.perf_counter() - began
    client.close()
    return took


def main() -> None:
    count = Options(__doc__, n=40, quick=4, metavar="NODES").read().n
    with tempfile.TemporaryDirectory() as folder:
        various, alike = create_workspace(Path(folder, "workspace"), count)
        # What is compiled on first use is there already.
        fresh = Path(folder, "home")
        fresh.mkdir()
        first = various.with_name("first.launch")
        first.write_text('<launch><node pkg="rosout" type="rosout" name="first"/></launch>')
        by_command(first, fresh)
        with rosmaster(folder) as ros:
            scripts = ((various.parents[1] / "scripts/talker_0.py", "/words0"), (ROSOUT, "/rosout_agg"))
            each = [min(bare(script, topic, ros, number) for number in range(3)) for script, topic in scripts]
        whole = sum(each) * (count // 2)
        print(f"{f'{count} nodes, bare one by one':<34}{whole:>8.2f}s{'/bare':>9}")
        for title, path in (("executables of their own", various), ("of two executables", alike)):
            for asked, by in (("trace", by_command), ("server", by_server)):
                with tempfile.TemporaryDirectory() as home:
                    shutil.copytree(fresh, home, dirs_exist_ok=True)
                    for when in ("cold", "again"):
                        took = by(path, Path(home))
                        print(f"{f'{title}, {asked}, {when}':<34}{took:>8.2f}s{took / whole:>9.3f}", flush=True)


if __name__ == "__main__":
    main()
