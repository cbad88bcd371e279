"""What the catalogue says of nodes beside what a run of the installed ones shows: `make catalogue-truth`.

  python tests/tools/catalogue_truth.py [--write] [LAUNCH ...]

Runs the nodes of the launch files (all of `fixtures/ros1/real_nodes/launch` without any) in the sandbox, and compares
those that come to their event loop with the catalogue's word for them, which knows neither their arguments nor
their parameters. `--write` writes docs/catalogue.md. Only what is installed is compared; the page says what was.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from preflight_analysis.catalogue import launches as launch_files
from preflight_analysis.catalogue.packages import INTERFACES, interfaces_of
from preflight_analysis.evaluation import names
from preflight_analysis.nodl.catalogued import Catalogued, catalogued

ROOT = Path(__file__).parents[2]
LAUNCHES = sorted((ROOT / "fixtures" / "ros1" / "real_nodes" / "launch").glob("*.launch"))
PAGE = ROOT / "docs" / "catalogue.md"
_OF_ALL = frozenset({"/rosout", "/clock"})


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
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [str(Path(sys.executable).parent / "ros-preflight"), "trace", str(launch), "--format", "json"],
            env={**os.environ, "XDG_CACHE_HOME": folder},
            capture_output=True,
            check=False,
        )
    for node in json.loads(done.stdout)["nodes"] if done.stdout else ():
        package, name = node["package"], node["executable"]
        said = catalogued(package, "executables", name, "noetic")
        if node["interface_source"] == "trace" and node["outcome"]["status"] == "spinning" and said is not None:
            yield _row(f"{package}/{name}", node, said)


def _row(name: str, node: dict[str, Any], said: Catalogued) -> Row:
    # Programs in C++ tell names that are resolved already.
    def full(each: str) -> str:
        return names.resolve(each, node["name"])

    seen = {(e["role"], full(e["name"]), e["type"]) for e in node["endpoints"] if not e["builtin"]}
    known = {(e.role, full(e.name), e.type) for e in said.endpoints}
    read = {full(use["name"]) for use in node["params"] if not use["builtin"]}
    of_own = {end for end in seen if end[1] not in _OF_ALL}
    return Row(name, Share.of(of_own, known), Share.of(read, {full(use.name) for use in said.params}))


def page(found: Iterable[Row]) -> str:
    """The page of the documentation."""
    found = sorted(set(found), key=lambda row: row.node)
    lines = [
        "<!-- Written by `make catalogue-truth`. Do not edit. -->",
        "# The catalogue",
        "What common packages do is known where they are not installed: read from their source by this project's own",
        "analysis, at the commit that each file names, with no argument and no parameter set.",
        "",
        "| distribution | packages | executables | components | nodelets | launch files |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    for folder in sorted(INTERFACES.iterdir()):
        of = [interfaces_of(path.stem, folder.name) for path in sorted(folder.glob("*.json"))]
        counts = (sum(len(each.get(kind, ())) for each in of) for kind in ("executables", "components", "nodelets"))
        files = sum(1 for _ in (launch_files.LAUNCHES / folder.name).rglob("*.json"))
        lines.append(f"| {folder.name} | {len(of)} | {' | '.join(map(str, counts))} | {files} |")
    ends, params = _share(row.ends for row in found), _share(row.params for row in found)
    lines += [
        "",
        "## Measured",
        "Debian's nodes of ROS 1 that were installed where this was written, run in the sandbox, beside the word of",
        f"the catalogue. Of {len(found)} nodes the catalogue knows {ends} of the topics, services and actions that",
        f"they were seen to make, by kind, name and type, and {params} of the parameters that they read. What only the",
        "run has depends on the arguments and parameters of its launch file, as all topics of a relay do.",
        "",
        "| node | ends: both | run only | catalogue only | parameters: both | run only | catalogue only |",
        "| --- | --- | --- | --- | --- | --- | --- |",
        *(f"| {row.node} | {row.ends} | {row.params} |" for row in found),
    ]
    return "\n".join(lines) + "\n"


def _share(shares: Iterable[Share]) -> str:
    shares = list(shares)
    both, all_ = sum(each.both for each in shares), sum(each.both + each.run for each in shares)
    return f"{both} of {all_}" + (f" ({100 * both // all_} %)" if all_ else "")


def main() -> None:
    """Print the page, or write it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("launches", nargs="*", type=Path)
    options = parser.parse_args()
    text = page([row for launch in options.launches or LAUNCHES for row in rows(launch)])
    if options.write:
        PAGE.write_text(text)
    else:
        print(text)


if __name__ == "__main__":
    main()
