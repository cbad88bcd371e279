"""How long the catalogue takes to be read: the names of all released packages, and the largest file of each other kind.

  python bench/catalogue.py [-n ROUNDS | --quick]

Processor time in milliseconds with nothing remembered, beside that of `json.loads` of the same text: medians.
"""

from __future__ import annotations

import json
import statistics
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from options import Options
from preflight_analysis.catalogue import launches, packages, released
from preflight_analysis.documents.reading import Text
from preflight_analysis.launch.catalogued import read_catalogued
from results import record


def milliseconds(work: Callable[[], object], rounds: int) -> float:
    took = []
    for _ in range(rounds):
        began = time.process_time()
        work()
        took.append(time.process_time() - began)
    return 1000 * statistics.median(took)


def read_names() -> None:
    released._letters.cache_clear()
    released._names.cache_clear()
    released.distributions_with("rviz", 1)


def timed(rounds: int, quick: bool) -> None:
    interfaces, launch_file = (
        max(folder.rglob("*.json"), key=lambda path: path.stat().st_size)
        for folder in (packages.INTERFACES, launches.LAUNCHES)
    )

    def read_interfaces() -> None:
        packages.interfaces_of.cache_clear()
        packages.interfaces_of(interfaces.stem, interfaces.parent.name)

    def read_launch_file() -> None:
        read_catalogued(Text.of(str(launch_file), launch_file.read_text()))

    kinds: dict[str, tuple[Callable[[], None], Path | None]] = {
        "names of packages": (read_names, None),
        "interfaces of a package": (read_interfaces, interfaces),
        "a launch file": (read_launch_file, launch_file),
    }
    print(f"{'median of ' + str(rounds):<26}{'ms':>8}{'json.loads':>12}")
    worst = 0.0
    for name, (read, path) in kinds.items():
        took = milliseconds(read, rounds)
        worst = max(worst, took)
        bare = f"{milliseconds(partial(json.loads, path.read_text()), rounds):>12.2f}" if path else ""
        print(f"{name:<26}{took:>8.2f}{bare}")
    record(quick, catalogue_worst_ms=worst)


def main() -> None:
    options = Options(__doc__, n=15, quick=1).read()
    timed(options.n, options.quick)


if __name__ == "__main__":
    main()
