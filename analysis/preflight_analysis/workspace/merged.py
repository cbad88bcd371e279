"""What is shown of each file where several launches reach it: for server and command line."""

from __future__ import annotations

import functools
from collections.abc import Collection, Iterable, Mapping

from preflight_analysis.findings.contexts import RootFindings, by_file, roots
from preflight_analysis.findings.finding import Finding
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.rules.registry import all_rules
from preflight_analysis.workspace.index import Root

CRASH = "TRC001"
"""The rule that reports nodes that crashed."""


def counting(files: Mapping[Root, Iterable[str]], asked: Collection[Root]) -> frozenset[Root]:
    """The roots whose findings are shown: those that no other one includes, and those that were asked for. `files` has
    what each of them is made of."""
    reached: dict[str, list[str]] = {}
    for root, of_root in files.items():
        reached.setdefault(root.path, []).extend(of_root)
    tops = frozenset(roots(reached))
    return frozenset(root for root in files if root.path in tops or root in asked)


def merged(reports: Iterable[RootFindings], kept: Kept | None = None) -> dict[str, tuple[Finding, ...]]:
    """The findings of each file, once; what nodes do together only where it holds in each launch of the file."""
    return by_file(reports, _every_root(), kept)


@functools.cache
def _every_root() -> frozenset[str]:
    return frozenset(rule.id for rule in all_rules() if rule.every_root)
