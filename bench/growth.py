"""How the time of an edit that changes one node grows with the number of nodes: as n^x.

  python bench/growth.py [-n ROUNDS | --quick]

Launches of ROS 1 with 50, 500 and 5,000 nodes: in files of ten that one file includes, where a leaf is edited, and all
in one file. Each edit gives a parameter of one node another value, which it never had before. By the real server, from
the keystroke to the published diagnostics, and by the analysis in this process. The exponent x is the slope of a line
through the medians by least squares, both axes logarithmic.
"""

from __future__ import annotations

import gc
import math
import os
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from client import Client
from options import Options
from preflight_analysis.environment.detect import detect
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace as Engine
from results import record

COUNTS, QUICK_COUNTS = (50, 500, 5_000), (10, 20)
IN_A_FILE = 10
VALUE = "value_0"
NODE = """  <node pkg="rosout" type="rosout" name="node_{n}" ns="robot_{g}">
    <param name="mode" value="{value}"/>
    <remap from="in" to="/robot_{g}/words"/>
  </node>
"""
MANIFEST = '<package format="2"><name>growth</name><version>1.0.0</version></package>'


@dataclass(frozen=True)
class Launch:
    """The root, and the file that is edited."""

    root: Path
    edited: Path


def nodes(first: int, end: int) -> str:
    """The first of them has the value that is edited."""
    return "".join(NODE.format(n=n, g=n % 10, value=VALUE if n == first else "fixed") for n in range(first, end))


def in_files(folder: Path, count: int) -> Launch:
    """Files of ten nodes each, and the root that includes them all."""
    includes = ""
    for first in range(0, count, IN_A_FILE):
        name = f"part_{first}.launch"
        (folder / name).write_text(f"<launch>\n{nodes(first, first + IN_A_FILE)}</launch>\n")
        includes += f'  <include file="$(dirname)/{name}"/>\n'
    root = folder / "root.launch"
    root.write_text(f"<launch>\n{includes}</launch>\n")
    return Launch(root, folder / f"part_{count // 2 // IN_A_FILE * IN_A_FILE}.launch")


def in_one(folder: Path, count: int) -> Launch:
    path = folder / "one.launch"
    path.write_text(f"<launch>\n{nodes(0, count)}</launch>\n")
    return Launch(path, path)


def digits(text: str, rounds: int) -> Iterator[tuple[int, str]]:
    """Where the value's digit is, and what it becomes."""
    at = text.index(VALUE) + len(VALUE) - 1
    for number in range(1, rounds + 1):
        yield at, chr(ord("A") + number % 26) if number % 27 else str(number % 10)


def by_server(launch: Launch, rounds: int, home: Path) -> list[float]:
    client = Client(launch.root.parents[1], home, trusted=False)
    for path in dict.fromkeys((launch.root, launch.edited)):
        item = {"uri": path.as_uri(), "languageId": "roslaunch", "version": 0, "text": path.read_text()}
        client.notify("textDocument/didOpen", {"textDocument": item})
    uri = launch.edited.as_uri()
    # What is asked of the root waits until it is analysed; then the edited file is shown in its context.
    place = {"textDocument": {"uri": launch.root.as_uri()}, "position": {"line": 1, "character": 5}}
    client.request("textDocument/hover", place)
    text = launch.edited.read_text()
    samples = []
    for version, (at, char) in enumerate(digits(text, rounds), 1):
        start = {"line": text.count("\n", 0, at), "character": at - text.rfind("\n", 0, at) - 1}
        change = {"range": {"start": start, "end": {**start, "character": start["character"] + 1}}, "text": char}
        began = time.perf_counter()
        document = {"uri": uri, "version": version}
        client.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [change]})
        client.diagnostics(lambda p, version=version: p["uri"] == uri and p.get("version") == version)
        samples.append(time.perf_counter() - began)
    client.close()
    return samples


def in_process(launch: Launch, rounds: int, home: Path) -> list[float]:
    texts = Sources()
    engine = Engine(detect(str(launch.root.parents[1])), texts)
    text = launch.edited.read_text()
    texts.open(str(launch.edited), text)
    _ = engine.static(str(launch.root)).findings
    samples = []
    for at, char in digits(text, rounds):
        began = time.perf_counter()
        texts.open(str(launch.edited), text[:at] + char + text[at + 1 :])
        _ = engine.static(str(launch.root)).findings
        samples.append(time.perf_counter() - began)
    return samples


def exponent(counts: tuple[int, ...], seconds: list[float]) -> float:
    """The slope of the line through the points, both axes logarithmic."""
    return statistics.linear_regression([math.log(n) for n in counts], [math.log(s) for s in seconds]).slope


def main() -> None:
    args = Options(__doc__, n=30, quick=2).read()
    counts = QUICK_COUNTS if args.quick else COUNTS
    gc.set_threshold(10_000, 2, 10_000)  # as the server
    ways: tuple[tuple[str, str, Callable[[Path, int], Launch], Callable[[Launch, int, Path], list[float]]], ...] = (
        ("files of ten nodes, server", "growth_exponent_nodes", in_files, by_server),
        ("files of ten nodes, in process", "growth_exponent_nodes_in_process", in_files, in_process),
        ("one file, server", "growth_exponent_nodes_one_file", in_one, by_server),
        ("one file, in process", "growth_exponent_nodes_one_file_in_process", in_one, in_process),
    )
    print(f"{'medians in ms':<34}" + "".join(f"{f'{n:,} nodes':>14}" for n in counts) + f"{'exponent':>10}")
    for title, key, make, measure in ways:
        medians = []
        for count in counts:
            with tempfile.TemporaryDirectory() as scratch:
                home, package = Path(scratch, "home"), Path(scratch, "growth")
                home.mkdir()
                (package / "launch").mkdir(parents=True)
                (package / "package.xml").write_text(MANIFEST)
                os.environ["ROS_PACKAGE_PATH"] = str(package)
                medians.append(statistics.median(measure(make(package / "launch", count), args.n, home)))
        slope = exponent(counts, medians)
        print(f"{title:<34}" + "".join(f"{1000 * median:>14.1f}" for median in medians) + f"{slope:>10.2f}", flush=True)
        record(args.quick, **{key: slope})


if __name__ == "__main__":
    main()
