"""PKG003: several files that a node's type could mean."""

import filecmp
import os
from collections.abc import Iterator

from preflight_analysis.environment.model import Executable
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.places import attribute_location
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import ROSLAUNCH_NODE
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for node in context.tree.nodes:
        if len(node.resolved.candidates) < 2:
            continue
        first, *others = _different(node.resolved)
        if others:
            package = node.resolved.package_path or ""
            rest = ", ".join(f"'{os.path.relpath(path, package)}'" for path in others)
            yield rule.claim(
                f"ambiguous executable '{node.executable}': package '{node.package}' has {len(others) + 1} different "
                f"files; '{os.path.relpath(first, package)}' runs here, another machine may run {rest}",
                attribute_location(context, node, "type"),
                subject=Subject("executable", node.executable),
                related=include_chain(node.origin),
            )


def _different(found: Executable) -> list[str]:
    """What is run, and the other files of the same folder tree that are not the same thing under another path.

    What a devel or install space has was made from the package's source folder: no second executable.
    """
    share = f"{(found.package_path or '').rstrip('/')}/"
    first = found.candidates[0]
    different = [first]
    for path in found.candidates[1:]:
        if path.startswith(share) == first.startswith(share) and not any(_same(path, other) for other in different):
            different.append(path)
    return different


def _same(path: str, other: str) -> bool:
    try:
        return os.path.samefile(path, other) or filecmp.cmp(path, other, shallow=False)
    except OSError:
        return False


RULE = Rule(
    id="PKG003",
    name="executable-ambiguous",
    effect="misbehaves",
    kind="duplicate",
    what="Checks for a node whose package has several executable files of that name with different content. A link, "
    "a copy, and a built file in a devel or install space are not counted.",
    why="`roslaunch` runs the first one that it finds and reports nothing. The order of folders in the file system "
    "decides, so the robot may run another one.",
    example="scripts/talker.py\nscripts/old/talker.py",
    instead="scripts/talker.py\nscripts/old/talker_2019.py",
    references=(ROSLAUNCH_NODE,),
    generations=(1,),
    check=_check,
)
