"""A workspace of 1,000 launch files: the time of its index, and how soon findings follow a keystroke in a large tree.

  python bench/index.py [-n ROUNDS | --quick]

The workspace is that of `workspace.py`. Through the real server: the time from `initialized` to the end of the index,
hovers meanwhile, the time from a keystroke to the published diagnostics in several files of the largest tree (500
nodes, 60 includes), and memory, also after 10,000 edits of which one in twenty is waited for. Typed are single
characters in an attribute's value, each taken back again, and lines. In the same run real `roslaunch --nodes` is asked
about the same tree: that is what an edit is compared with. Last, the same edits without a server, split into the steps
of the analysis. Quick: the three robots of that tree alone, and as few keystrokes as there can be.
"""

from __future__ import annotations

import gc
import os
import statistics
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from client import Client
from options import Options
from preflight_analysis.environment.detect import detect
from preflight_analysis.launch import read as read_module
from preflight_analysis.workspace import workspace as workspace_module
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace as Engine
from results import record
from workspace import HEAVY, INCLUDES, NODES, ROBOTS, Workspace, generate

TITLE = "Indexing launch files"
TYPED = ("front_left", "\n" * 3)
"""Within a value, and at the end of its line."""
TARGET_MS, TARGET_RATIO = 50, 50
MANY, AT_ONCE = 10_000, 20


@dataclass(frozen=True)
class Place:
    """Where something is typed: behind the first `before` in a file."""

    title: str
    path: Path
    before: str

    def texts(self, rounds: int, typed: tuple[str, str]) -> Iterator[tuple[str, int, int, str]]:
        """The edits, as start, end and new text, with the text that each leads to; the last leads back."""
        text = self.path.read_text()
        at = text.index(self.before) + len(self.before)
        line = text.index("\n", at) + 1
        for _ in range(rounds):
            for start, word in zip((at, line), typed, strict=True):
                for count, char in enumerate(word, 1):
                    new = text[:start] + word[:count] + text[start:]
                    yield new, start + count - 1, start + count - 1, char
                for count in range(len(word) - 1, -1, -1):
                    yield text[:start] + word[:count] + text[start:], start + count, start + count + 1, ""


def places(made: Workspace) -> list[Place]:
    return [
        Place("root: a node's attribute", made.root, 'type="teleop_monitor.py" name="'),
        Place("root: an argument for a third", made.root, '<arg name="robot" value="'),
        Place("robot.launch, included once", made.middle, '<param name="parts" value="'),
        Place("tracker.launch, a leaf", made.leaf, 'name="frame_id" value="'),
    ]


def shown(title: str, samples: list[float]) -> None:
    p95 = statistics.quantiles(samples, n=20)[-1]
    print(f"  {title:<42}{1000 * statistics.median(samples):8.1f}{1000 * p95:8.1f}{1000 * max(samples):8.1f}")


def position(text: str, offset: int) -> dict[str, int]:
    return {"line": text.count("\n", 0, offset), "character": offset - (text.rfind("\n", 0, offset) + 1)}


def index(client: Client, made: Workspace, files: int) -> tuple[float, float, float]:
    """Cold index, which begins when the open file is analysed, with hovers meanwhile. The client has just said
    `initialized`. Returns the seconds to the first hover, of all of it, and of the slowest hover from then on."""
    began = time.perf_counter()
    text = made.root.read_text()
    at = {"textDocument": {"uri": made.root.as_uri()}, "position": position(text, text.index("$(arg sim)") + 4)}
    hovers = []
    if not client.request("textDocument/hover", at):
        raise SystemExit("a hover was not answered")
    analysed = time.perf_counter() - began
    while TITLE not in client.ended:
        asked = time.perf_counter()
        if not client.request("textDocument/hover", at) or asked - began > 300:
            raise SystemExit("a hover was not answered, or the index has no end")
        hovers.append(time.perf_counter() - asked)
    print(f"first answer, with the first analysis of the largest tree: {analysed:.2f} s")
    print(
        f"its graph, and the cold index of {files:,} launch files: {client.ended[TITLE] - began - analysed:.2f} s more"
    )
    print(f"{'ms':<44}{'median':>8}{'p95':>8}{'max':>8}")
    shown("hover, while the index is built", hovers)
    return analysed, client.ended[TITLE] - began, max(hovers)


def again(made: Workspace, home: Path) -> float:
    """The seconds of the index that a second server makes."""
    client = Client(made.folder, home, trusted=False)
    while TITLE not in client.ended:
        client.receive()
    took = client.ended[TITLE] - client.begun[TITLE]
    client.close()
    print(f"index of a second start: {took:.2f} s")
    return took


def opened(client: Client, path: Path) -> None:
    item = {"uri": path.as_uri(), "languageId": "roslaunch", "version": 0, "text": path.read_text()}
    client.notify("textDocument/didOpen", {"textDocument": item})


def edits(
    client: Client, place: Place, changes: Iterator[tuple[str, int, int, str]], version: Iterator[int]
) -> list[float]:
    uri = place.path.as_uri()
    samples = []
    text = place.path.read_text()
    for new, start, end, typed in changes:
        number = next(version)
        change = {"range": {"start": position(text, start), "end": position(text, end)}, "text": typed}
        began = time.perf_counter()
        document = {"uri": uri, "version": number}
        client.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [change]})
        client.diagnostics(lambda p, number=number: p["uri"] == uri and p.get("version") == number)
        samples.append(time.perf_counter() - began)
        text = new
    return samples


def many(client: Client, made: Workspace, count: int, version: Iterator[int]) -> None:
    """So many edits, as fast as they are handled: after each twenty the findings are waited for."""
    while count > 0:
        for place in places(made):
            uri, text = place.path.as_uri(), place.path.read_text()
            for new, start, end, typed in place.texts(1, TYPED):
                number, count = next(version), count - 1
                change = {"range": {"start": position(text, start), "end": position(text, end)}, "text": typed}
                document = {"uri": uri, "version": number}
                client.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [change]})
                text = new
                if count % AT_ONCE == 0:
                    client.diagnostics(lambda p, uri=uri, n=number: p["uri"] == uri and p.get("version") == n)
    at_end = {"textDocument": {"uri": made.root.as_uri()}, "position": {"line": 1, "character": 5}}
    client.request("textDocument/hover", at_end)


def roslaunch(root: Path, rounds: int) -> float:
    """Seconds that the real one takes, the median."""
    samples = []
    for _ in range(rounds):
        began = time.perf_counter()
        answer = subprocess.run(["roslaunch", "--nodes", root], check=True, capture_output=True, text=True)
        samples.append(time.perf_counter() - began)
        if len(answer.stdout.split()) != NODES:
            raise SystemExit(f"roslaunch: {answer.stdout}{answer.stderr}")
    return statistics.median(samples)


class Stopwatch:
    """The time spent in functions of modules, less that in watched ones which they call."""

    def __init__(self) -> None:
        self.spent: dict[str, float] = {}
        self._inner = [0.0]

    def watch(self, title: str, module: Any, name: str) -> None:
        function: Callable[..., Any] = getattr(module, name)

        def watched(*args: Any, **kwargs: Any) -> Any:
            self._inner.append(0.0)
            began = time.perf_counter()
            try:
                return function(*args, **kwargs)
            finally:
                took = time.perf_counter() - began
                self.spent[title] = self.spent.get(title, 0.0) + took - self._inner.pop()
                self._inner[-1] += took

        setattr(module, name, watched)


def library(made: Workspace, typed: tuple[str, str]) -> None:
    """The same edits without a server."""
    watch = Stopwatch()
    watch.watch("parse", read_module, "parse_xml")
    watch.watch("frontend", read_module, "read_ros1")
    watch.watch("evaluate", workspace_module, "evaluate_launch")
    watch.watch("rules", workspace_module, "run_rules")
    gc.set_threshold(10_000, 2, 10_000)  # as the server
    texts = Sources()
    engine = Engine(detect(str(made.folder)), texts)
    _ = engine.static(str(made.root)).findings
    print("without a server, means in ms")
    for place in places(made):
        watch.spent.clear()
        samples = []
        for new, *_ in place.texts(1, typed):
            began = time.perf_counter()
            texts.open(str(place.path), new)
            _ = engine.static(str(made.root)).findings
            samples.append(time.perf_counter() - began)
        watch.spent["other"] = sum(samples) - sum(watch.spent.values())
        steps = ", ".join(f"{step} {1000 * spent / len(samples):.1f}" for step, spent in watch.spent.items())
        print(f"  {place.title:<30}{1000 * statistics.mean(samples):6.1f}: {steps}")
        texts.close(str(place.path))


def main() -> None:
    args = Options(__doc__, n=3, quick=1, help="of 26 edits in each place").read()
    typed = ("f", "\n") if args.quick else TYPED
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder, "home")
        home.mkdir()
        made = generate(Path(folder, "workspace"), HEAVY if args.quick else ROBOTS)
        os.environ["ROS_PACKAGE_PATH"] = str(made.folder / "src")
        client = Client(made.folder, home, trusted=False)
        memory = [client.megabytes()]
        opened(client, made.root)
        first, indexed, hover = index(client, made, sum(1 for _ in made.folder.rglob("*.launch")))
        memory.append(client.megabytes())
        for path in (made.middle, made.leaf):
            opened(client, path)
            client.diagnostics(lambda p, path=path: p["uri"] == path.as_uri())
        version = iter(range(1, 1_000_000))
        samples: list[float] = []
        for place in places(made):
            took = edits(client, place, place.texts(args.n, typed), version)
            shown(place.title, took)
            samples += took
        shown("all edits", samples)
        many(client, made, AT_ONCE if args.quick else MANY - len(samples), version)
        memory.append(client.megabytes())
        client.close()
        indexed_again = again(made, home)
        real = roslaunch(made.root, 1 if args.quick else 5)
        median = statistics.median(samples)
        ratio = real / median
        p95 = 1000 * statistics.quantiles(samples, n=20)[-1]
        print(f"roslaunch --nodes of the same tree ({NODES} nodes, {INCLUDES} includes): {1000 * real:.0f} ms")
        print(f"roslaunch : edit = {ratio:.0f} (target: {TARGET_RATIO}); p95 {p95:.1f} ms (target: {TARGET_MS})")
        print("memory of the server in MB: {:.0f} at first, {:.0f} indexed, {:.0f} after the edits".format(*memory))
        record(
            args.quick,
            edit_p50_ms=1000 * median,
            edit_p95_ms=p95,
            roslaunch_over_edit_ratio=ratio,
            hover_worst_ms_while_indexing=1000 * hover,
            first_answer_s=first,
            index_1000_files_s=indexed,
            index_1000_files_again_s=indexed_again,
            rss_mb_idle=memory[0],
            rss_mb_indexed=memory[1],
            rss_mb_after_10000_edits=memory[2],
        )
        library(made, typed)


if __name__ == "__main__":
    main()
