"""One finding for what is said of several nodes at one place: the nodes of a file that is included for each robot, the
nodes that get one parameter file."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from preflight_analysis.findings.clipping import clipped
from preflight_analysis.findings.finding import Finding, Related


def with_others(finding: Finding, others: Iterable[Finding]) -> Finding:
    """The finding with the number of the `others` that say the same of another node: `/robot1/base and 1 more`."""
    node, same = finding.text.node, finding.text.regardless_of_node()
    more = {other.text.node for other in others if other.text.regardless_of_node() == same} - {node}
    if not node or not more:
        return finding
    alike = finding.alike
    if alike is not None and alike.what.node == node:
        alike = replace(alike, what=alike.what.with_more(len(more)))
    text = finding.text.with_more(len(more))
    return replace(finding, text=text, message=clipped(str(text)), alike=alike)


def together(findings: Iterable[Finding]) -> list[Finding]:
    """What one rule says of one place in one context: what it says of several nodes, once, with their ends."""
    alike: dict[object, list[Finding]] = {}
    for finding in findings:
        alike.setdefault((finding.severity, finding.text.regardless_of_node()), []).append(finding)
    return [_one(*found) if len(found) > 1 else found[0] for found in alike.values()]


def _one(first: Finding, *others: Finding) -> Finding:
    found = with_others(first, others)
    also = tuple(Related(f"also: {other.message}", other.location) for other in others[:5])
    ends = dict.fromkeys(end for each in (first, *others) for end in each.endpoints)
    return replace(found, related=(*found.related, *also), endpoints=tuple(ends))
