"""One finding for what is said of several nodes at one place: the nodes of a file that is included for each robot, the
nodes that get one parameter file."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace

from preflight_analysis.findings.finding import Finding, Related

_NODE = re.compile(r"(?:(?<![\w'\"./~$-])/[A-Za-z_]\w*(?:/\w+)*(?![\w/.':-])|\A/[A-Za-z_]\w*(?:/\w+)*(?=: ))")
"""A node as messages name it: a full name without quotes. A colon is behind what another program names, as in
`cat: /data/front: Permission denied`; a message of ours begins with a node that has one."""


def node_named(message: str) -> str | None:
    """The node that a message speaks of first."""
    found = _NODE.search(message)
    return found[0] if found else None


def regardless_of_node(message: str) -> str:
    """The message without what differs from one instance of a node to another: its name and its namespace."""
    node = node_named(message)
    if node is None:
        return message
    space = node[: node.rfind("/") + 1]
    plain = message.replace(node, "\0")
    return plain.replace(space, "\1") if len(space) > 1 else plain


def with_others(finding: Finding, others: Iterable[str]) -> Finding:
    """The finding with the number of the `others` of which the same is said: `/robot1/base and 1 more`. Those are
    messages; one that says something else is left alone."""
    node, same = node_named(finding.message), regardless_of_node(finding.message)
    more = {node_named(message) for message in others if regardless_of_node(message) == same} - {node}
    if node is None or not more:
        return finding

    def told(message: str) -> str:
        return _NODE.sub(lambda found: f"{found[0]} and {len(more)} more", message, count=1)

    alike = finding.alike
    alike = replace(alike, what=told(alike.what)) if alike is not None else None
    return replace(finding, message=told(finding.message), alike=alike)


def together(findings: Iterable[Finding]) -> list[Finding]:
    """What one rule says of one place in one context: what it says of several nodes, once, with their ends."""
    alike: dict[tuple[str, str], list[Finding]] = {}
    for finding in findings:
        alike.setdefault((finding.severity, regardless_of_node(finding.message)), []).append(finding)
    return [_one(*found) if len(found) > 1 else found[0] for found in alike.values()]


def _one(first: Finding, *others: Finding) -> Finding:
    found = with_others(first, [other.message for other in others])
    also = tuple(Related(f"also: {other.message}", other.location) for other in others[:5])
    ends = dict.fromkeys(end for each in (first, *others) for end in each.endpoints)
    return replace(found, related=(*first.related, *also), endpoints=tuple(ends))
