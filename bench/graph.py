"""How soon a graph is seen: its layout, its page, and the first paint of that in a browser.

  python bench/graph.py [-n ROUNDS | --quick]

For a small robot and for 150 nodes with 600 topics. The baseline of the layout, measured in the same rounds, is the
start of a Python process, as the layout runs in one of its own; that of the paint is an empty page. The paint needs
what `tests/editors/install.sh vscode` installs. The figures are medians in milliseconds, and ratios to the baseline.
"""

from __future__ import annotations

import json
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from options import Options  # noqa: E402
from preflight_analysis.view.graph_page import graph_page  # noqa: E402
from preflight_analysis.view.layout import lay_out  # noqa: E402
from support import sample_graphs  # noqa: E402

VIEWS = {"9 nodes, 19 topics": sample_graphs.robot(), "150 nodes, 600 topics": sample_graphs.large(150, 600)}


def milliseconds(work: Callable[[], object]) -> float:
    started = time.perf_counter()
    work()
    return (time.perf_counter() - started) * 1000


def start_python() -> None:
    subprocess.run([sys.executable, "-I", "-c", ""], check=True)


def paint(pages: dict[str, Path], rounds: int) -> dict[str, list[float]]:
    """The first contentful paints of pages, in turn, as the browser itself has them."""
    given = {"pages": {name: str(path) for name, path in pages.items()}, "browser": shutil.which("chromium")}
    script = ROOT / "bench" / "paint.mjs"
    done = subprocess.run(
        ["node", str(script), json.dumps({**given, "rounds": rounds})], capture_output=True, text=True, check=True
    )
    found: dict[str, list[float]] = json.loads(done.stdout)
    return found


def main() -> None:
    rounds = Options(__doc__, n=5, quick=1).read().n
    times: dict[str, list[float]] = {"start of Python": []}
    for _ in range(rounds):
        times["start of Python"].append(milliseconds(start_python))
        for name, view in VIEWS.items():
            times.setdefault(f"layout, {name}", []).append(milliseconds(lambda view=view: lay_out(view)))  # type: ignore[misc]
            times.setdefault(f"page, {name}", []).append(milliseconds(lambda view=view: graph_page(view, None)))  # type: ignore[misc]
    report(times, "start of Python")
    if not (ROOT / "tests/editors/vscode/node_modules/playwright-core").exists():
        print("first paint: not measured, run tests/editors/install.sh vscode")
        return
    with tempfile.TemporaryDirectory() as folder:
        pages = {"empty page": Path(folder, "empty.html")}
        pages["empty page"].write_text("<!doctype html><title>empty</title><p>nothing</p>")
        for i, (name, view) in enumerate(VIEWS.items()):
            pages[f"first paint, {name}"] = Path(folder, f"{i}.html")
            pages[f"first paint, {name}"].write_text(graph_page(view, None), encoding="utf-8")
        report(paint(pages, rounds), "empty page")


def report(times: dict[str, list[float]], baseline: str) -> None:
    base = statistics.median(times[baseline])
    for name, found in times.items():
        median = statistics.median(found)
        print(f"{name:40} {median:8.0f} ms {median / base:7.1f} x")


if __name__ == "__main__":
    main()
