"""How soon the findings follow a keystroke: from the change notification to the published static diagnostics.

  python bench/editing.py [-n ROUNDS]

Through the real server process, over its standard input and output. Each round inserts or removes one line break near
the start of the file, so that everything below it moves. The baselines are measured in the same rounds: a request that
the server answers without looking at anything, and the time that `xml.dom.minidom` takes to parse the same text. The
figures are the median and the 95th percentile in milliseconds, and the medians' ratio to each baseline.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
import xml.dom.minidom
from collections.abc import Callable
from pathlib import Path
from typing import Any

DEMO = Path(__file__).parent.parent / "fixtures" / "ros1" / "demo"
NODES = 500


class Client:
    """Just enough of an editor."""

    def __init__(self, folder: Path, home: Path, *, trusted: bool) -> None:
        environment = {**os.environ, "HOME": str(home), "XDG_CACHE_HOME": str(home / ".cache")}
        self._server = subprocess.Popen(
            [sys.executable, "-m", "preflight_server.cli.main", "lsp"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment,
        )
        self._id = 0
        self.request(
            "initialize",
            {
                "processId": os.getpid(),
                "rootUri": folder.as_uri(),
                "capabilities": {},
                "initializationOptions": {"workspaceTrusted": trusted},
            },
        )
        self.notify("initialized", {})

    def notify(self, method: str, params: Any) -> None:
        self._send({"method": method, "params": params})

    def request(self, method: str, params: Any) -> Any:
        self._id += 1
        self._send({"id": self._id, "method": method, "params": params})
        while (message := self.receive()).get("id") != self._id:
            pass
        return message.get("result")

    def diagnostics(self, fits: Callable[[Any], bool]) -> Any:
        """The next published diagnostics that fit."""
        while True:
            message = self.receive()
            if message.get("method") == "textDocument/publishDiagnostics" and fits(message["params"]):
                return message["params"]

    def receive(self) -> Any:
        assert self._server.stdout is not None
        length = 0
        while line := self._server.stdout.readline().strip():
            name, _, value = line.partition(b":")
            if name.lower() == b"content-length":
                length = int(value)
        if not length:
            raise SystemExit("the server ended")
        return json.loads(self._server.stdout.read(length))

    def _send(self, message: dict[str, Any]) -> None:
        assert self._server.stdin is not None
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self._server.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        self._server.stdin.flush()

    def close(self) -> None:
        self.request("shutdown", None)
        self.notify("exit", None)
        self._server.wait(20)


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


def measure(name: str, path: Path, text: str, home: Path, rounds: int, *, trusted: bool = False) -> None:
    client = Client(path.parents[1], home, trusted=trusted)
    uri = path.as_uri()
    item = {"uri": uri, "languageId": "roslaunch", "version": 1, "text": text}
    client.notify("textDocument/didOpen", {"textDocument": item})
    if trusted:  # until the runs are done
        client.diagnostics(lambda p: p["uri"] == uri and any(d["code"] == "TOP001" for d in p["diagnostics"]))
    else:
        client.diagnostics(lambda p: p["uri"] == uri)

    edits, trips, parses = [], [], []
    start = {"line": 1, "character": 0}
    for version in range(2, rounds + 2):
        broken = version % 2 == 0
        end = start if broken else {"line": 2, "character": 0}
        change = {"range": {"start": start, "end": end}, "text": "\n" if broken else ""}
        began = time.perf_counter()
        document = {"uri": uri, "version": version}
        client.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [change]})
        client.diagnostics(lambda p, version=version: p.get("version") == version)
        edits.append(time.perf_counter() - began)

        began = time.perf_counter()
        client.request("textDocument/documentSymbol", {"textDocument": {"uri": "file:///not/open"}})
        trips.append(time.perf_counter() - began)

        began = time.perf_counter()
        xml.dom.minidom.parseString(text.encode())
        parses.append(time.perf_counter() - began)
    client.close()

    p95 = statistics.quantiles(edits, n=20)[-1]
    edit, trip, parse = (statistics.median(each) for each in (edits, trips, parses))
    print(
        f"{name:<32} {1000 * edit:8.1f} {1000 * p95:8.1f} {1000 * trip:8.1f} {1000 * parse:8.1f}"
        f" {edit / trip:8.1f} {edit / parse:8.2f}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-n", type=int, default=60, metavar="ROUNDS")
    rounds = parser.parse_args().n
    with tempfile.TemporaryDirectory() as folder:
        home, workspace = Path(folder, "home"), Path(folder, "workspace")
        home.mkdir()
        shutil.copytree(DEMO, workspace)
        (demo,) = workspace.rglob("talker_listener.launch")
        print(f"{'ms':<32} {'median':>8} {'p95':>8} {'request':>8} {'minidom':>8} {'/request':>8} {'/minidom':>8}")
        measure("demo, static", demo, demo.read_text(), home, rounds)
        measure("demo, with what its runs told", demo, demo.read_text(), home, rounds, trusted=True)
        measure(f"{NODES} nodes, static", demo.with_name("large.launch"), large(NODES), home, rounds)


if __name__ == "__main__":
    main()
