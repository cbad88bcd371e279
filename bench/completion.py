"""How soon proposals follow a keystroke: `textDocument/completion` for `pkg="` in a workspace of 200 packages.

  python bench/completion.py [-n ROUNDS | --quick]

Through the real server process, over its standard input and output: once while nothing else happens, and once right
after an edit, when the analysis of the new text has only begun. The baseline, measured in the same rounds, is a request
that the server answers without looking at anything. The figures are the median and the 95th percentile in milliseconds,
and the medians' ratio to the baseline.
"""

from __future__ import annotations

import statistics
import tempfile
import time
from pathlib import Path
from typing import Any

from client import Client
from editing import large
from options import Options

PACKAGES = 200
BEGUN = '  <node pkg="'


def workspace(folder: Path) -> Path:
    """The packages, each with one executable; returns the folder of the first."""
    for number in range(PACKAGES):
        package = folder / "src" / f"package_{number}"
        (package / "scripts").mkdir(parents=True)
        (package / "package.xml").write_text(f'<package format="2"><name>package_{number}</name></package>')
        script = package / "scripts" / "talker.py"
        script.touch()
        script.chmod(0o755)
    return folder / "src" / "package_0"


def measure(name: str, nodes: int, rounds: int) -> None:
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder, "home")
        home.mkdir()
        path = workspace(Path(folder, "workspace")) / "typed.launch"
        text = large(nodes).replace("preflight_demo", "package_0").replace("</launch>", f"{BEGUN}\n</launch>")
        path.write_text(text)
        client = Client(Path(folder, "workspace"), home, trusted=False)
        uri = path.as_uri()
        item = {"uri": uri, "languageId": "roslaunch", "version": 1, "text": text}
        client.notify("textDocument/didOpen", {"textDocument": item})
        line, column = text.count("\n") - 2, len(BEGUN)
        start, end = {"line": line, "character": column}, {"line": line, "character": column + 1}

        def completion(where: dict[str, int]) -> None:
            found: Any = client.request("textDocument/completion", {"textDocument": {"uri": uri}, "position": where})
            assert len(found["items"]) >= PACKAGES, found

        completion(start)
        alone, typed, trips = [], [], []
        for version in range(2, 2 * rounds + 2, 2):
            edits: list[dict[str, Any]] = [
                {"range": {"start": start, "end": start}, "text": "p"},
                {"range": {"start": start, "end": end}, "text": ""},
            ]
            for number, edit in enumerate(edits):
                document = {"uri": uri, "version": version + number}
                began = time.perf_counter()
                client.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [edit]})
                completion(start)
                typed.append(time.perf_counter() - began)
                client.request("textDocument/hover", {"textDocument": {"uri": uri}, "position": start})  # analysed
            began = time.perf_counter()
            client.request("textDocument/documentSymbol", {"textDocument": {"uri": "file:///not/open"}})
            trips.append(time.perf_counter() - began)
            began = time.perf_counter()
            completion(start)
            alone.append(time.perf_counter() - began)
        client.close()
    trip = statistics.median(trips)
    for what, times in (("at rest", alone), ("after a keystroke", typed)):
        median, p95 = statistics.median(times), statistics.quantiles(times, n=20)[-1]
        print(f"{f'{name}, {what}':<36} {1000 * median:8.1f} {1000 * p95:8.1f} {1000 * trip:8.1f} {median / trip:8.1f}")


def main() -> None:
    args = Options(__doc__, n=40, quick=2).read()
    print(f"{'ms':<36} {'median':>8} {'p95':>8} {'request':>8} {'/request':>8}")
    for nodes in (20, 60 if args.quick else 500):
        measure(f"{nodes} nodes", nodes, args.n)


if __name__ == "__main__":
    main()
