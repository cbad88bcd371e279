"""What a run came to, as the page `bench/endurance.md`."""

from __future__ import annotations

import os
import platform
from collections.abc import Sequence

from tools.endurance import materials
from tools.endurance.conditions import Row
from tools.endurance.sitting import Figures

PAGE = materials.REPOSITORY / "bench" / "endurance.md"
WARM = 10_000
"""Edits after which the memory is compared: code is loaded and caches are full by then."""
GROWTH = 1.05
WHOLE = 100_000
"""Edits of a whole run."""
TITLES = {
    "ros1": "XML of ROS 1",
    "xml": "XML of ROS 2",
    "yaml": "YAML of ROS 2",
    "python": "Python of ROS 2",
    "parameters": "parameters (YAML)",
}


def _after(figures: Figures, edits: int) -> float | None:
    """MB after so many edits, None if it were not so many."""
    return next((mb for count, mb in sorted(figures.megabytes.items()) if count >= edits), None)


def grown(figures: Figures) -> str | None:
    """What the server uses more of than it should, after enough edits."""
    warm, last = _after(figures, WARM), figures.megabytes[figures.edits]
    if warm is not None and last > warm * GROWTH:
        return f"{last:.0f} MB after {figures.edits:,} edits, {warm:.0f} MB after {WARM:,}"
    half = len(figures.descriptors) // 2
    for what, counts in (("descriptors", figures.descriptors), ("threads", figures.threads)):
        if half and max(counts[half:]) > max(counts[: half + 1]) + 2:
            return f"more and more {what}: {counts}"
    return None


def text(figures: Figures | None, ran: Figures | None, rows: Sequence[Row], where: str) -> str:
    """The page, in Markdown. `ran` are the figures of edits where launch files were run."""
    lines = ["# Endurance", "`make endurance` writes this page; what it does stands in `tests/tools/endurance`.", ""]
    if figures is not None:
        machine = f"{os.cpu_count()} cores, Python {platform.python_version()}"
        done = [f"{TITLES[form]} {count:,}" for form, count in figures.files.items()]
        lines += [
            f"## {figures.edits:,} edits in one server",
            f"Packages of the {where}; {machine}; {figures.seconds / 60:.0f} minutes.",
            *([] if figures.edits >= WHOLE else [f"This is a short run: the whole one has {WHOLE:,} edits."]),
            "",
            "| what | how much |",
            "| --- | --- |",
            f"| edits, through the protocol | {figures.edits:,} |",
            f"| requests in between, and how many were cancelled | {figures.requests:,}, {figures.cancelled:,} |",
            f"| files that came, went, became folders, links, rings, pipes | {figures.changes_on_disk:,} |",
            f"| files that were edited | {', '.join(done)} |",
            f"| launch files of the two workspaces; how often two more were opened and closed |"
            f" {figures.launch_files:,}; {figures.guests:,} |",
            f"| comparisons with a fresh server, findings of all files equal | {figures.comparisons:,} |",
            f"| answers of both compared, all equal | {figures.questions:,} |",
            "| exceptions, internal errors, message boxes; processes left | 0; 0 |",
            f"| descriptors, threads at the end of the first and of the last workspace | {figures.descriptors[0]},"
            f" {figures.threads[0]}; {figures.descriptors[-1]}, {figures.threads[-1]} |",
            "",
            "| memory of the server, nothing open | MB |",
            "| --- | --- |",
            f"| idle | {figures.idle:.0f} |",
            f"| indexed | {figures.megabytes[0]:.0f} |",
        ]
        for count in (1_000, WARM, 50_000, 100_000):
            if (found := _after(figures, count)) is not None:
                lines.append(f"| after {count:,} edits | {found:.0f} |")
        lines.append("")
    if ran is not None:
        lines += [
            f"Then {ran.edits:,} edits in a server that runs launch files and commands in the sandbox, which it did"
            f" {ran.runs:,} times; {ran.comparisons:,} comparisons: all equal, no process left,"
            f" {ran.descriptors[-1]} descriptors.",
            "",
        ]
    if rows:
        lines += ["## What is not as usual", "| what | what must hold | measured |", "| --- | --- | --- |"]
        lines += [f"| {row.title} | {row.asserted} | {row.failure or row.measured} |" for row in rows]
    return "\n".join(lines).rstrip() + "\n"
