"""Real nodes: what tracing finds of them beside what a real ROS master shows when the same launch really runs.

  python tests/tools/real_nodes.py [LAUNCH ...]     print the rows of these launch files (all: without arguments)
  python tests/tools/real_nodes.py --write          run all and write docs/real_nodes.md

The launch files are those of `fixtures/ros1/real_nodes/launch` (Debian's nodes) and of
`fixtures/ros1/cpp_tutorials/launch` (ours, which are compiled first). What is not installed is named, and launch files
that need it are not run: then the command fails.
"""

from __future__ import annotations

import argparse
import functools
import json
import os
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

sys.path.insert(0, str(Path(__file__).parents[1]))  # tests/, as pytest has it

from preflight_analysis.evaluation import names
from support.cpp_tutorials import SOURCE, compiled
from support.roslaunch_harness import launched
from support.tracing_harness import ROS1_FIXTURES

ROS2 = "## rclcpp\n"
"""Where the part of the page begins that this does not write."""
PAGE = Path(__file__).parents[2] / "docs" / "real_nodes.md"
FOLDER = ROS1_FIXTURES / "real_nodes"
LAUNCHES = {path.stem: path for path in sorted((FOLDER / "launch").glob("*.launch"))}
TUTORIALS = sorted(path.stem for path in (SOURCE / "launch").glob("*.launch"))
_SIDES = ("publishers", "subscribers", "services")


@dataclass(frozen=True)
class Row:
    """A node, or a nodelet manager with its nodelets: how many of its topics and services are found."""

    launch: str
    nodes: str
    executables: str
    topics: tuple[int, int]
    services: tuple[int, int]
    on_demand: int
    """Ends that are made once somebody subscribes, and that the real master did not show as nobody did."""
    outcome: str
    differences: tuple[str, ...]

    @property
    def complete(self) -> bool:
        """Whether the trace and the master are of the same opinion."""
        return not self.differences

    def markdown(self) -> str:
        """The row of the table."""
        found = "; ".join(self.differences) or ("equal" if not self.on_demand else f"equal, {self.on_demand} on demand")
        return (
            f"| {self.launch} | {self.executables} | {self.topics[0]}/{self.topics[1]} "
            f"| {self.services[0]}/{self.services[1]} | {self.outcome} | {found} |"
        )


EndpointRef = tuple[str, str, str | None]
"""Side, name, type."""


def traced(launch_file: Path, folder: Path, packages: Path) -> dict[str, Any]:
    """`ros-preflight graph` of the launch file, with an empty cache."""
    done = subprocess.run(
        [str(Path(sys.executable).parent / "ros-preflight"), "graph", str(launch_file), "--format", "json",
         "--package-path", f"{packages}:/usr/share"],
        env={"PATH": "/usr/bin:/bin", "HOME": str(folder), "XDG_CACHE_HOME": str(folder / "cache")},
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )  # fmt: skip
    if done.returncode == 2:
        raise SystemExit(f"{launch_file}: {done.stderr}")
    answer: dict[str, Any] = json.loads(done.stdout)
    return answer


def rows(launch_file: Path, folder: Path, packages: Path = ROS1_FIXTURES, display: str = "") -> list[Row]:
    """Run a launch file both ways and compare, a row for each node."""
    graph = traced(launch_file, folder, packages)
    real = launched(launch_file, folder, packages, display)
    started = {node["name"]: node for node in real["nodes"]}
    types = _types(graph)
    found = []
    for group in _groups(real["nodes"]):
        nodes = [node for node in graph["nodes"] if node["name"] in group]
        shown = [real["shown"].get(name, {}) for name in group]
        theirs = {(side, name, kind) for sides in shown for side in _SIDES for name, kind in sides.get(side, ())}
        # A master has one type for each topic, which any of its ends may have told.
        masters = {name: kind for side, name, kind in theirs if side != "services" and types[name] & {kind, "*"}}
        ours: dict[EndpointRef, bool] = {}
        for node in nodes:
            for side in _SIDES:
                for end in node[side]:
                    kind = None if end["type"] == "*" else end["type"]
                    ours[side, end["name"], masters.get(end["name"], kind)] = bool(end.get("on_demand"))
        late = {end for end, on_demand in ours.items() if on_demand and end not in theirs}
        absent = [name for name in group if name in real["absent"]]
        outcomes = {_outcome(node) for node in nodes}
        if absent == group and all(node["outcome"] in ("crashed", "exited") for node in nodes):
            # Nothing is left of it to compare.
            ours, absent, outcomes = {}, [], {f"{outcome}, as it really does" for outcome in outcomes}
        found.append(
            Row(
                launch_file.stem,
                ", ".join(group),
                " + ".join(_label(started[name]) for name in group),
                _counted(set(ours) - late, theirs, _SIDES[:2]),
                _counted(set(ours) - late, theirs, _SIDES[2:]),
                len(late),
                ", ".join(sorted(outcomes)),
                tuple(f"{name} did not really run" for name in absent)
                + tuple(_said("not found", end) for end in sorted(theirs - set(ours), key=str))
                + tuple(_said("not real", end) for end in sorted(set(ours) - theirs - late, key=str)),
            )
        )
    return found


def _types(graph: dict[str, Any]) -> dict[str, set[str | None]]:
    """What a master could say of each topic: a type that one end knows, nothing where none does, and anything (`*`)
    where a publisher passes on whatever it gets."""
    types: dict[str, set[str | None]] = defaultdict(set)
    for node in graph["nodes"]:
        for side in _SIDES[:2]:
            for end in node[side]:
                any_type = "*" if side == "publishers" else None
                types[end["name"]].add(any_type if end["type"] == "*" else end["type"])
    return types


def _groups(nodes: list[dict[str, Any]]) -> Iterator[list[str]]:
    """The names of nodes, those of nodelets with their manager: for the master, what they make is the manager's."""
    manager = {}
    for node in nodes:
        if node["package"] == "nodelet" and node["args"][:1] == ["load"]:
            manager[node["name"]] = names.resolve(node["args"][2], node["name"], {})
    for node in nodes:
        if node["name"] not in manager:
            yield [node["name"], *(name for name, of in manager.items() if of == node["name"])]


def _label(node: dict[str, Any]) -> str:
    base = f"{node['package']}/{os.path.basename(node['executable'])}"
    if base == "nodelet/nodelet":
        return " ".join(("nodelet", *node["args"][:2]))
    return f"{base} {node['args'][0]}" if node["package"] == "rostopic" else base


def _outcome(node: dict[str, Any]) -> str:
    source = node["interface_source"]
    # What waited is completed by similar runs, its own among them.
    return str(node["outcome"]) if source in ("trace", "similar") else f"{node['outcome']}, known from {source}"


def _counted(ours: set[EndpointRef], theirs: set[EndpointRef], sides: tuple[str, ...]) -> tuple[int, int]:
    real = {end for end in theirs if end[0] in sides and not _common(end)}
    return len(real & ours), len(real)


def _common(end: EndpointRef) -> bool:
    """Whether every node has it; it is compared, but not counted."""
    side, name, _ = end
    return (side == "publishers" and name == "/rosout") or (
        side == "services" and name.rpartition("/")[2] in ("get_loggers", "set_logger_level")
    )


def _said(what: str, end: EndpointRef) -> str:
    side, name, kind = end
    return f"{what}: {side.removesuffix('s')} `{name}` ({kind})"


@contextmanager
def x_server() -> Iterator[str]:
    """An X server of our own without a screen; its DISPLAY, "" where there is none."""
    read, write = os.pipe()
    try:
        server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-nolisten", "tcp", "-noreset", "-screen", "0", "640x480x24"],
            pass_fds=[write],
            stderr=subprocess.DEVNULL,
        )
    except FileNotFoundError:
        yield ""
        return
    finally:
        os.close(write)
    try:
        with os.fdopen(read) as told:
            yield f":{told.readline().strip()}"
    finally:
        server.terminate()
        server.wait()


def missing(launch_file: Path) -> list[str]:
    """The executables of a launch file that are not installed here."""
    wanted = {(node.get("pkg", ""), node.get("type", "")) for node in ElementTree.parse(launch_file).iter("node")} - {
        ("cpp_tutorials", source.stem) for source in (SOURCE / "src").glob("*.cpp")
    }
    return sorted(f"{package}/{name}" for package, name in wanted if f"{package}/{name}" not in installed())


@functools.cache
def installed() -> frozenset[str]:
    """The executables of the ROS packages that are installed, as PACKAGE/EXECUTABLE."""
    found = set()
    for package in Path("/usr/share").glob("*/package.xml"):
        name = package.parent.name
        for folder in (package.parent, Path("/usr/lib", name), Path("/usr/libexec", name)):
            programs = (path for path in folder.rglob("*") if path.is_file() and os.access(path, os.X_OK))
            found.update(f"{name}/{path.name}" for path in programs if ".so" not in path.name)
    return frozenset(found)


def left_out() -> dict[str, str]:
    """The executables that are in no launch file, and why."""
    lines = (FOLDER / "left_out.txt").read_text().splitlines()
    return dict(line.split(": ", 1) for line in lines if not line.startswith("#"))


def forgotten() -> list[str]:
    """Installed executables of which neither a row nor a reason is to be had."""
    started = {
        f"{node.get('pkg')}/{node.get('type')}"
        for file in LAUNCHES.values()
        for node in ElementTree.parse(file).iter("node")
    }
    return sorted(installed() - started - set(left_out()))


def page(found: list[Row]) -> str:
    """docs/real_nodes.md."""
    debian = [row for row in found if row.launch in LAUNCHES]
    ours = [row for row in found if row.launch in TUTORIALS]
    executables = {part for row in debian for part in row.executables.split(" + ")}
    reasons = defaultdict(list)
    for name, reason in left_out().items():
        reasons[reason].append(f"`{name}`")
    return _PAGE.format(
        summary=f"{len(debian)} rows of {len(executables)} executables and nodelets; "
        f"{sum(row.complete for row in debian)} rows are complete.",
        debian="\n".join((_HEAD, *(row.markdown() for row in debian))),
        tutorials="\n".join((_HEAD, *(row.markdown() for row in ours))),
        paper="\n".join(
            f"| {row.executables} | {_PAPER[row.executables]} | {row.topics[0]}/{row.topics[1]} "
            f"| {row.services[0]}/{row.services[1]} |"
            for row in debian
            if row.executables in _PAPER
        ),
        left_out="\n".join(f"- {reason}: {', '.join(names)}" for reason, names in sorted(reasons.items())),
    )


_HEAD = """| launch file | node | topics | services | outcome of the trace | compared |
| --- | --- | --- | --- | --- | --- |"""
_PAPER = {"robot_state_publisher/robot_state_publisher": "2/5", "rviz/rviz": "13/13"}
"""Topics found in the paper's Table 3, of the nodes that Debian has."""
_PAGE = """# Real nodes: the trace beside a real master
`make nodes` writes this page. Each launch file is traced with `ros-preflight graph`, and started with the real
roslaunch and rosmaster, which is asked for its state once that no longer changes. Publishers, subscribers and services
have to be equal by name and type. `/rosout` and the two logger services, which every node has, are compared but not
counted: *2/3* means that two of the three topics' ends which the master shows were found by the trace. Nodelets are
counted with their manager, since for a master their topics are the manager's. *On demand* are ends that the node makes
once somebody subscribes to it, or sends it a message; the trace shows them, the master only if somebody did. A
subscription that a node gives up again, after a first message, is *not real* here: the trace keeps it.

## Nodes of Debian's packages
From `fixtures/ros1/real_nodes/launch`; `fixtures/ros1/real_nodes/apt-packages` is what they need. {summary}

{debian}

## Tutorials
From `fixtures/ros1/cpp_tutorials`, after the structure of roscpp_tutorials; those in Python are compared in
`tests/tracing/test_table1.py`.

{tutorials}

## Beside the paper's Table 3
Topics found, in the paper and here. Nodes of that table that Debian does not have (joy) cannot be shown.

| node | paper | here, topics | here, services |
| --- | --- | --- | --- |
{paper}

## What is left out
{left_out}
"""


def _of_ros2(text: str) -> str:
    """What the page says of ROS 2. It was measured with an rclcpp that was built by hand, as no index has one."""
    at = text.find(ROS2)
    return "\n" + text[at:] if at >= 0 else ""


def main() -> int:
    """Run what was asked for and print its table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("launch", nargs="*", help="names of launch files")
    parser.add_argument("--write", action="store_true", help="write docs/real_nodes.md")
    options = parser.parse_args()
    absent = []
    found: list[Row] = []
    print(_HEAD)
    with x_server() as display, tempfile.TemporaryDirectory() as scratch:
        for name in options.launch or [*LAUNCHES, *TUTORIALS]:
            needed = missing(LAUNCHES[name]) if name in LAUNCHES else []
            if needed:
                absent.append(f"{name}: not installed: {', '.join(needed)}")
                continue
            for row in rows_of(name, Path(scratch), display):
                print(row.markdown(), flush=True)
                found.append(row)
    problems = absent + [f"{name}: neither in a launch file nor in left_out.txt" for name in forgotten()]
    print("\n".join(problems), file=sys.stderr)
    print(f"{sum(not row.complete for row in found)} of {len(found)} rows are not complete", file=sys.stderr)
    if options.write and not problems:
        PAGE.write_text(page(found) + _of_ros2(PAGE.read_text()))
    return 1 if problems else 0


def rows_of(name: str, scratch: Path, display: str = "") -> list[Row]:
    """The rows of the launch file of this name. `scratch` is one folder for all: the tutorials are built there."""
    folder = scratch / name
    folder.mkdir()
    if name in LAUNCHES:
        return rows(LAUNCHES[name], folder, display=display)
    if not (scratch / SOURCE.name).is_dir():
        compiled(scratch)
    return rows(scratch / SOURCE.name / "launch" / f"{name}.launch", folder, scratch, display)


if __name__ == "__main__":
    sys.exit(main())
