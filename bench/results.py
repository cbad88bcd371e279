"""What the benchmarks found, for programs: `bench/out/latest.json`, one number a key.

`make bench` begins with an empty one; each benchmark adds its keys, so that those of a part are there if only a part is
run. `--quick` writes nothing: its figures say nothing. The keys with what they are measured in are in `KEYS`.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

LATEST = Path(__file__).parent / "out" / "latest.json"
KEYS: Mapping[str, str] = {
    "edit_p50_ms": "from an edit to its findings, 1,000 launch files, tree of 500 nodes: the median",
    "edit_p95_ms": "the same, the 95th percentile",
    "roslaunch_over_edit_ratio": "`roslaunch --nodes` of the same tree, over that median",
    "hover_worst_ms_while_indexing": "the slowest hover while 1,000 launch files are indexed",
    "index_1000_files_s": "from `initialized` to the end of that index, with nothing kept from before",
    "version_s": "processor time of `ros-preflight --version`",
    "check_of_demo_s": "... of a check of the demo whose nodes were run before",
    "catalogue_worst_ms": "processor time to read the largest part of the catalogue that is read at once",
    "first_answer_s": "from `initialized` to the first hover, in a tree of 500 nodes",
    "index_1000_files_again_s": "the index of a second start, when nothing has changed",
    "python_index_300_files_s": "the index of 300 Python launch files, read and not run, with nothing kept from before",
    "python_index_runs_over_reading_ratio": "the same index where each of them is run first, over that",
    "rss_mb_idle": "resident memory of the server that has been initialised",
    "rss_mb_indexed": "... that has indexed 1,000 launch files",
    "rss_mb_after_10000_edits": "... after 10,000 edits in them",
    "growth_exponent_nodes": "x, where an edit of one node takes n^x in a tree of n = 50 to 5,000 nodes, by the server",
    "growth_exponent_nodes_in_process": "... without the server",
    "growth_exponent_nodes_one_file": "... by the server, where all nodes are in one file",
    "growth_exponent_nodes_one_file_in_process": "... without the server",
}


def record(quick: bool, **figures: float) -> None:
    """Add figures, each one of `KEYS`, to those of the benchmarks before; nothing for a quick run."""
    if unknown := figures.keys() - KEYS:
        raise ValueError(f"not described: {', '.join(sorted(unknown))}")
    if quick:
        return
    known = json.loads(LATEST.read_text()) if LATEST.exists() else {}
    known.update({name: round(value, 3) for name, value in figures.items()})
    LATEST.parent.mkdir(exist_ok=True)
    LATEST.write_text(json.dumps(known, indent=2, sort_keys=True) + "\n")
