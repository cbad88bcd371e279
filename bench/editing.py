"""How soon the findings follow a keystroke: from the change notification to the published static diagnostics.

  python bench/editing.py [-n ROUNDS | --quick]

Through the real server process, over its standard input and output. Each round inserts or removes one line break near
the start of the file, so that everything below it moves; then a letter of a topic's name, in a launch where most topics
have one end only and each is compared with the others of its type, and one that is in the name of each. Of ROS 2 it is
a launch of as many nodes in 60 included files, in XML and in YAML; then one file of 300 lines, in XML and in Python,
which is read and not run, and of which a letter in the name of a node changes. The baselines are measured in the same
rounds: a request that the server answers without looking at anything, and the time that `xml.dom.minidom` (PyYAML for
YAML, `ast` for Python) takes to parse the same text. The figures are the median and the 95th percentile in
milliseconds, and the medians' ratio to each baseline.
It fails where a letter of a topic's name takes more than `RENAMED_OVER_MOVED` times as long as lines that move, in the
same file.
"""

from __future__ import annotations

import ast
import shutil
import statistics
import tempfile
import time
import xml.dom.minidom
from collections.abc import Callable
from functools import partial
from itertools import islice, permutations
from pathlib import Path
from string import ascii_letters

import yaml
from client import Client
from options import Options

DEMO = Path(__file__).parent.parent / "fixtures" / "ros1" / "demo"
NODES = 500
INCLUDES = 60
RENAMED_OVER_MOVED = 2.0
"""Both over the time of minidom. It was 2.9 while the name of each topic was compared with all others, and is 1.4."""
ROS2_NODES = {
    ".launch.xml": """  <node pkg="fleet" exec="talker" name="talker_{n}" namespace="robot_{g}">
    <param name="rate" value="$(var rate)"/>
    <remap from="chatter" to="/robot_{g}/words"/>
  </node>
""",
    ".launch.yaml": """  - node:
      pkg: fleet
      exec: talker
      name: talker_{n}
      namespace: robot_{g}
      param:
        - {{name: rate, value: $(var rate)}}
      remap:
        - {{from: chatter, to: /robot_{g}/words}}
""",
}
ROS2_INCLUDES = {
    ".launch.xml": """  <include file="$(dirname)/part_{i}.launch.xml">
    <arg name="rate" value="$(var rate)"/>
  </include>
""",
    ".launch.yaml": """  - include:
      file: $(dirname)/part_{i}.launch.yaml
      arg:
        - {{name: rate, value: $(var rate)}}
""",
}
ROS2_FILES = {
    ".launch.xml": '<launch>\n\n  <arg name="rate" default="5"/>\n{body}</launch>\n',
    ".launch.yaml": "launch:\n\n  - arg: {{name: rate, default: '5'}}\n{body}",
}
ROS2_ONE_FILE = {
    ".launch.xml": (
        '<launch>\n\n  <arg name="rate" default="5"/>\n{body}</launch>\n',
        """  <node pkg="fleet" exec="talker" name="talker_{n}" namespace="robot_{g}">
    <param name="rate" value="$(var rate)"/>
    <param name="frame" value="base_{n}"/>
    <remap from="chatter" to="/robot_{g}/words"/>
    <remap from="scan" to="/robot_{g}/scan"/>

  </node>
""",
        42,
    ),
    ".launch.py": (
        """from launch import LaunchDescription

from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    rate = LaunchConfiguration("rate")
    return LaunchDescription([
        DeclareLaunchArgument("rate", default_value="5"),
{body}    ])
""",
        """        Node(
            package="fleet",
            executable="talker",
            name="talker_{n}",
            namespace="robot_{g}",
            parameters=[{{"rate": rate, "frame": "base_{n}"}}],
            remappings=[("chatter", "/robot_{g}/words"), ("scan", "/robot_{g}/scan")]),
""",
        41,
    ),
}
"""The same nodes in 300 lines: the file, a node, and how many."""
ROS2_PACKAGE = """<package format="3"><name>fleet</name><version>0.1.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license>
<export><build_type>ament_python</build_type></export></package>
"""


def large(nodes: int) -> str:
    """A launch file of that many nodes, each with a parameter and a remap."""
    node = (
        '  <node pkg="preflight_demo" type="talker.py" name="talker_{n}" ns="robot_{g}">\n'
        '    <param name="rate" value="$(arg rate)"/>\n'
        '    <remap from="chatter" to="/robot_{g}/words"/>\n'
        "  </node>\n"
    )
    body = "".join(node.format(n=n, g=n % 10) for n in range(nodes))
    return f'<launch>\n  <arg name="rate" default="5"/>\n{body}</launch>\n'


def dangling(nodes: int) -> str:
    """A launch file of that many nodes, annotated: half of them publish what nobody wants, the others want what nobody
    publishes, all of one type."""
    node = (
        '  <node pkg="preflight_demo" type="talker.py" name="node_{name}">\n'
        '    <topics><topic name="chatter" type="sensor_msgs/Image" class="{side}"/></topics>\n'
        '    <remap from="chatter" to="/{name}"/>\n'
        "  </node>\n"
    )
    words = ("front", "rear", "left", "right", "camera", "depth", "raw", "points", "scan", "map", "goal", "arm")
    names = islice(("_".join(chosen) for chosen in permutations(words, 3)), nodes)
    body = "".join(node.format(name=name, side=("pub", "sub")[n % 2]) for n, name in enumerate(names))
    return f"<launch>\n\n{body}</launch>\n"


def of_one_robot(text: str) -> str:
    """The same with the name of the robot in each topic, which is an argument in the second line."""
    named = text.replace('to="/', 'to="/$(arg robot)/')
    return named.replace("\n\n", '\n  <arg name="robot" default="a"/>\n', 1)


def fleet(workspace: Path, suffix: str, count: int) -> Path:
    """A launch of ROS 2 with that many nodes, in 60 files that it includes and in itself."""
    folder = workspace / "fleet" / "launch"
    folder.mkdir(parents=True, exist_ok=True)
    (folder.parent / "package.xml").write_text(ROS2_PACKAGE)
    share = count // (INCLUDES + 1)

    def nodes(first: int, end: int) -> str:
        return "".join(ROS2_NODES[suffix].format(n=n, g=n % 10) for n in range(first, end))

    for i in range(INCLUDES):
        body = nodes(i * share, (i + 1) * share)
        (folder / f"part_{i}{suffix}").write_text(ROS2_FILES[suffix].format(body=body))
    includes = "".join(ROS2_INCLUDES[suffix].format(i=i) for i in range(INCLUDES))
    root = folder / f"fleet{suffix}"
    root.write_text(ROS2_FILES[suffix].format(body=includes + nodes(INCLUDES * share, count)))
    return root


def one_file(workspace: Path, suffix: str) -> Path:
    """A launch of ROS 2 of 300 lines."""
    whole, node, count = ROS2_ONE_FILE[suffix]
    folder = workspace / "fleet" / "launch"
    folder.mkdir(parents=True, exist_ok=True)
    (folder.parent / "package.xml").write_text(ROS2_PACKAGE)
    path = folder / f"one{suffix}"
    path.write_text(whole.format(body="".join(node.format(n=n, g=n % 10) for n in range(count))))
    return path


def line_break(version: int) -> dict[str, object]:
    """Inserted in even versions, removed in odd ones."""
    start = {"line": 1, "character": 0}
    end = start if version % 2 == 0 else {"line": 2, "character": 0}
    return {"range": {"start": start, "end": end}, "text": "\n" if version % 2 == 0 else ""}


def first_name(version: int) -> dict[str, object]:
    """The first letter of the first topic of `dangling` becomes another one, and none that it was lately."""
    start, end = {"line": 4, "character": 31}, {"line": 4, "character": 32}
    return {"range": {"start": start, "end": end}, "text": ascii_letters[version % len(ascii_letters)]}


def first_robot(version: int) -> dict[str, object]:
    """The name of the robot of `of_one_robot` becomes another one."""
    start, end = {"line": 1, "character": 29}, {"line": 1, "character": 30}
    return {"range": {"start": start, "end": end}, "text": ascii_letters[version % len(ascii_letters)]}


def a_name(path: Path, version: int) -> dict[str, object]:
    """A letter in the name of the first node of `one_file` becomes another one, and none that it was lately."""
    lines = path.read_text().splitlines()
    line = next(n for n, text in enumerate(lines) if "talker_0" in text)
    column = lines[line].index("talker_0")
    start, end = {"line": line, "character": column}, {"line": line, "character": column + 1}
    return {"range": {"start": start, "end": end}, "text": ascii_letters[version % len(ascii_letters)]}


def measure(
    name: str,
    path: Path,
    text: str,
    home: Path,
    rounds: int,
    *,
    trusted: bool = False,
    edit: Callable[[int], dict[str, object]] = line_break,
) -> float:
    """Print the figures of one case. Returns the last one: the median over the time to parse the text."""
    client = Client(path.parents[1], home, trusted=trusted)
    uri = path.as_uri()
    language = {".yaml": "yaml", ".py": "python"}.get(path.suffix, "roslaunch")
    item = {"uri": uri, "languageId": language, "version": 1, "text": text}
    client.notify("textDocument/didOpen", {"textDocument": item})
    if trusted:  # until the runs are done
        client.diagnostics(lambda p: p["uri"] == uri and any(d["code"] == "TOP001" for d in p["diagnostics"]))
    else:
        client.diagnostics(lambda p: p["uri"] == uri)

    edits, trips, parses = [], [], []
    for version in range(2, rounds + 2):
        change = edit(version)
        began = time.perf_counter()
        document = {"uri": uri, "version": version}
        client.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [change]})
        client.diagnostics(lambda p, version=version: p.get("version") == version)
        edits.append(time.perf_counter() - began)

        began = time.perf_counter()
        client.request("textDocument/documentSymbol", {"textDocument": {"uri": "file:///not/open"}})
        trips.append(time.perf_counter() - began)

        began = time.perf_counter()
        if language == "yaml":
            yaml.safe_load(text)
        elif language == "python":
            ast.parse(text)
        else:
            xml.dom.minidom.parseString(text.encode())
        parses.append(time.perf_counter() - began)
    client.close()

    p95 = statistics.quantiles(edits, n=20)[-1]
    median, trip, parse = (statistics.median(each) for each in (edits, trips, parses))
    print(
        f"{name:<32} {1000 * median:8.1f} {1000 * p95:8.1f} {1000 * trip:8.1f} {1000 * parse:8.1f}"
        f" {median / trip:8.1f} {median / parse:8.2f}"
    )
    return median / parse


def main() -> None:
    args = Options(__doc__, n=60, quick=2).read()
    rounds, nodes = args.n, 70 if args.quick else NODES
    with tempfile.TemporaryDirectory() as folder:
        home, workspace = Path(folder, "home"), Path(folder, "workspace")
        home.mkdir()
        shutil.copytree(DEMO, workspace)
        (demo,) = workspace.rglob("talker_listener.launch")
        print(f"{'ms':<32} {'median':>8} {'p95':>8} {'request':>8} {'minidom':>8} {'/request':>8} {'/minidom':>8}")
        measure("demo, static", demo, demo.read_text(), home, rounds)
        measure("demo, with what its runs told", demo, demo.read_text(), home, rounds, trusted=True)
        measure(f"{nodes} nodes, static", demo.with_name("large.launch"), large(nodes), home, rounds)
        lone = demo.with_name("dangling.launch")
        lone.write_text(dangling(nodes))  # what launch files of the package call topics is compared, too
        moved = measure(f"{nodes} nodes, most dangle: moved", lone, dangling(nodes), home, rounds)
        renamed = measure(f"{nodes} nodes, most dangle: renamed", lone, dangling(nodes), home, rounds, edit=first_name)
        robot = demo.with_name("robot.launch")
        robot.write_text(of_one_robot(dangling(nodes)))
        measure(f"{nodes} nodes, each renamed", robot, robot.read_text(), home, rounds, edit=first_robot)
        for suffix in ROS2_NODES:
            root = fleet(workspace, suffix, nodes)
            measure(f"{nodes} nodes of ROS 2, {suffix}", root, root.read_text(), home, rounds)
        for suffix in ROS2_ONE_FILE:
            root = one_file(workspace, suffix)
            measure(f"300 lines of ROS 2, {suffix}", root, root.read_text(), home, rounds, edit=partial(a_name, root))
    if renamed > RENAMED_OVER_MOVED * moved:
        raise SystemExit(f"a renamed topic takes {renamed / moved:.1f} times as long as moved lines")


if __name__ == "__main__":
    main()
