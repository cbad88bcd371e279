"""What the catalogue says of nodes beside what runs of them show: `make catalogue-truth`.

  python tests/tools/catalogue_truth.py [--sources FOLDER] [--write] [LAUNCH ...]

Runs the nodes of the launch files (all of `fixtures/ros1/real_nodes/launch` without any) in the sandbox, as far as
they are installed, and with `--sources`, the folder that `make catalogue` has, the nodes in Python of ROS 2 from their
source with the rclpy of PyPI. Those that come to their event loop are compared with what is said of them where their
packages are not installed: the catalogue's word, with the arguments and parameters of their launch file in ROS 1 and
without any in ROS 2. `--write` writes docs/catalogue.md.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1]))  # tests/, as pytest has it

from preflight_analysis.catalogue import launches as launch_files
from preflight_analysis.catalogue.packages import INTERFACES, interfaces_of
from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.executables import ExecutableIndex
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation import names
from preflight_analysis.interfaces.catalogued import Catalogued, catalogued
from preflight_analysis.tracing.interface import NOT_RUN, Interface
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.trace import Tracer
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.ros2_harness import ros2_prefix

from tools.catalogue.interfaces import lay_out

ROOT = Path(__file__).parents[2]
LAUNCHES = sorted((ROOT / "fixtures" / "ros1" / "real_nodes" / "launch").glob("*.launch"))
PAGE = ROOT / "docs" / "catalogue.md"
_OF_ALL = frozenset({"/rosout", "/clock"})
_ROS2 = "jazzy"
_NODE = "/node"
_KINDS = ("executables", "components", "nodelets", "controllers", "plugins")


Ends = set[tuple[str, str, str | None]]
"""Role, name and type of each."""


@dataclass(frozen=True, slots=True)
class Share:
    """How many both know, only the run, and only the catalogue."""

    both: int
    run: int
    catalogue: int

    @classmethod
    def of(cls, run: set[Any], said: set[Any]) -> Share:
        """Of two sets."""
        return cls(len(run & said), len(run - said), len(said - run))

    def __str__(self) -> str:
        """For a cell of the table."""
        return f"{self.both} | {self.run} | {self.catalogue}"


@dataclass(frozen=True, slots=True)
class Row:
    """A node."""

    node: str
    ends: Share
    params: Share


def rows(launch: Path) -> Iterable[Row]:
    """The nodes of a launch file that ran and that the catalogue knows."""
    said_of = _without_ros(launch)
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [str(Path(sys.executable).parent / "ros-preflight"), "trace", str(launch), "--format", "json"],
            env={**os.environ, "XDG_CACHE_HOME": folder},
            capture_output=True,
            check=False,
        )
    for node in json.loads(done.stdout)["nodes"] if done.stdout else ():
        package, name, said = node["package"], node["executable"], said_of.get(node["name"])
        if node["interface_source"] == "trace" and node["outcome"]["status"] == "spinning" and said is not None:
            ends = {(e["role"], e["name"], e["type"]) for e in node["endpoints"] if not e["builtin"]}
            params = {use["name"] for use in node["params"] if not use["builtin"]}
            yield _row(f"{package}/{name}", node["name"], ends, params, said)


def _without_ros(launch: Path) -> Mapping[str, Interface]:
    """What is said of the nodes of a launch file that the catalogue knows, by their names, where no ROS is."""
    environment = detect_environment(None, {"ROS_DISTRO": "noetic"}, root="/nowhere")
    workspace = Workspace(environment, Sources())
    analysis = workspace.static(str(launch))
    graph = workspace.with_interfaces(analysis, [NOT_RUN] * len(analysis.tree.nodes), None).graph
    pairs = zip(graph.tree.nodes, graph.interfaces, strict=True) if graph is not None else ()
    return {node.name: interface for node, interface in pairs if interface.source == "catalogue"}


def _row(name: str, node: str, ends: Ends, params: set[str], said: Catalogued | Interface) -> Row:
    # Programs in C++ tell names that are resolved already.
    def full(each: str) -> str:
        return names.resolve(each, node)

    seen = {(role, full(end), _type(type_)) for role, end, type_ in ends if full(end) not in _OF_ALL}
    known = {(e.role, full(e.name), _type(e.type)) for e in said.endpoints if not e.builtin}
    uses = {full(use.name) for use in said.params if not use.builtin}
    return Row(name, Share.of(seen, known), Share.of(set(map(full, params)), uses))


def _type(type_: str | None) -> str | None:
    """A type; None where it is whatever the other end has."""
    return None if type_ == "*" else type_


def rclpy_rows(sources: Path) -> Iterator[Row]:
    """The nodes in Python of the catalogue's packages of ROS 2 that ran with the rclpy of PyPI."""
    prefix = ros2_prefix(f"{_ROS2}-messages")
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
        lay_out(sources, _ROS2, Path(folder))
        variables = {"PATH": f"{prefix / 'bin'}:/usr/bin:/bin", "HOME": folder, "ROS_DISTRO": _ROS2}
        environment = detect_environment(folder, variables)
        requests = list(_python_nodes(environment))
        tracer = Tracer(environment, None)
        runs = pool.map(lambda request: tracer.trace(request[2], threading.Event()), requests)
        for (package, name, _), ran in zip(requests, runs, strict=True):
            said = catalogued(package, "executables", name, _ROS2)
            if ran.outcome.status == "spinning" and "rclpy" not in ran.stand_ins and said is not None:
                ends: Ends = {(e.role, e.name, e.type) for e in ran.endpoints if not e.builtin}
                params = {use.name for use in ran.params if not use.builtin}
                # What is private is told below the name that the program gives its node.
                yield _row(f"{package}/{name}", ran.own_name("/") or _NODE, ends, params, said)


def _python_nodes(environment: Environment) -> Iterator[tuple[str, str, TraceRequest]]:
    index = ExecutableIndex(environment, Disk())
    for package in sorted(environment.packages):
        for name in interfaces_of(package, _ROS2).get("executables", ()):
            found = index.find(package, name)
            if found.path is not None and (found.entry_point or found.path.endswith(".py")):
                entry = found.entry_point
                yield (
                    package,
                    name,
                    TraceRequest(_NODE, package, found.path, generation=2, entry_point=entry, named=False),
                )


def page(found: Iterable[Row], of_ros2: Iterable[Row]) -> str:
    """The page of the documentation."""
    lines = [
        "<!-- Written by `make catalogue-truth`. Do not edit. -->",
        "# The catalogue",
        "What common packages do is known where they are not installed: read from their source by this project's own",
        "analysis, at the commit that each file names, with no argument and no parameter set.",
        "",
        f"| distribution | packages | {' | '.join(_KINDS)} | launch files |",
        f"| --- | --- |{' --- |' * len(_KINDS)} --- |",
    ]
    for folder in sorted(INTERFACES.iterdir()):
        of = [interfaces_of(path.stem, folder.name) for path in sorted(folder.glob("*.json"))]
        counts = (sum(len(each.get(kind, ())) for each in of) for kind in _KINDS)
        files = sum(1 for _ in (launch_files.LAUNCHES / folder.name).rglob("*.json"))
        lines.append(f"| {folder.name} | {len(of)} | {' | '.join(map(str, counts))} | {files} |")
    ros1, ros2 = _measured(found), _measured(of_ros2)
    lines += [
        "",
        "## Measured",
        "Debian's nodes of ROS 1 that were installed where this was written, run in the sandbox, beside the word of",
        "the catalogue.",
        ros1.summary,
        "What the arguments and parameters of the launch file name is counted, too, as all topics of a relay.",
        "",
        *ros1.table,
        "",
        "The nodes in Python of ROS 2, run from their unchanged source, without arguments and parameters, with the",
        "rclpy of PyPI's wheels, none of which has nodes. Those count that came to their event loop with that rclpy; a",
        "few of them import modules that were stood in for.",
        ros2.summary,
        "",
        *ros2.table,
    ]
    return "\n".join(lines) + "\n"


@dataclass(frozen=True, slots=True)
class _Measured:
    summary: str
    table: tuple[str, ...]


def _measured(found: Iterable[Row]) -> _Measured:
    rows = sorted(set(found), key=lambda row: row.node)
    ends, params = _share(row.ends for row in rows), _share(row.params for row in rows)
    return _Measured(
        f"Of {len(rows)} nodes the catalogue knows {ends} of the topics, services and actions that they were seen to\n"
        f"make, by kind, name and type, and {params} of the parameters that they read.",
        (
            "| node | ends: both | run only | catalogue only | parameters: both | run only | catalogue only |",
            "| --- | --- | --- | --- | --- | --- | --- |",
            *(f"| {row.node} | {row.ends} | {row.params} |" for row in rows),
        ),
    )


def _share(shares: Iterable[Share]) -> str:
    shares = list(shares)
    both, all_ = sum(each.both for each in shares), sum(each.both + each.run for each in shares)
    return f"{both} of {all_}" + (f" ({100 * both // all_} %)" if all_ else "")


def main() -> None:
    """Print the page, or write it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sources", type=Path)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("launches", nargs="*", type=Path)
    options = parser.parse_args()
    of_ros2 = list(rclpy_rows(options.sources)) if options.sources is not None else []
    text = page([row for launch in options.launches or LAUNCHES for row in rows(launch)], of_ros2)
    if options.write:
        PAGE.write_text(text)
    else:
        print(text)


if __name__ == "__main__":
    main()
