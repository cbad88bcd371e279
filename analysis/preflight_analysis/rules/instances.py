"""One finding for what is said of several nodes at one place: the nodes of a file that is included for each robot, the
nodes that get one parameter file."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace

from preflight_analysis.findings.finding import Finding, Related

_NODE = re.compile(r"(?:(?<![\w'\"./~$-])/[A-Za-z_]\w*(?:/\w+)*(?![\w/.':-])|\A/[A-Za-z_]\w*(?:/\w+)*(?=: ))")
"""A node as messages of rules that do not say which it is name it: a full name without quotes. A colon is behind what
another program names, as in `cat: /data/front: Permission denied`; a message of ours begins with a node that has one.
"""


def node_of(finding: Finding) -> str | None:
    """The node that a finding is about: which its rule says, or the first that its own words name."""
    if finding.node:
        return finding.node
    found = _NODE.search(finding.message[: finding.quoted_from])
    return found[0] if found else None


def regardless_of_node(finding: Finding) -> str:
    """The message without what differs from one instance of a node to another: its name and its namespace."""
    node, message = node_of(finding), finding.message
    if node is None:
        return message
    space = node[: node.rfind("/") + 1]
    plain = message.replace(node, "\0")
    return plain.replace(space, "\1") if len(space) > 1 else plain


def with_others(finding: Finding, others: Iterable[Finding]) -> Finding:
    """The finding with the number of the `others` that say the same of another node: `/robot1/base and 1 more`. What
    another program says is left as it is."""
    node, same = node_of(finding), regardless_of_node(finding)
    more = {node_of(other) for other in others if regardless_of_node(other) == same} - {node}
    if node is None or not more:
        return finding
    name, told = re.compile(rf"(?<![\w'\"./~$-]){re.escape(node)}(?![\w/.'-])"), f"{node} and {len(more)} more"
    own = finding.message[: finding.quoted_from]
    quoted = finding.message[len(own) :]
    own = name.sub(lambda _: told, own, count=1)
    alike = finding.alike
    alike = replace(alike, what=name.sub(lambda _: told, alike.what, count=1)) if alike is not None else None
    at = len(own) if finding.quoted_from is not None else None
    return replace(finding, message=own + quoted, quoted_from=at, alike=alike)


def together(findings: Iterable[Finding]) -> list[Finding]:
    """What one rule says of one place in one context: what it says of several nodes, once, with their ends."""
    alike: dict[tuple[str, str], list[Finding]] = {}
    for finding in findings:
        alike.setdefault((finding.severity, regardless_of_node(finding)), []).append(finding)
    return [_one(*found) if len(found) > 1 else found[0] for found in alike.values()]


def _one(first: Finding, *others: Finding) -> Finding:
    found = with_others(first, others)
    also = tuple(Related(f"also: {other.message}", other.location) for other in others[:5])
    ends = dict.fromkeys(end for each in (first, *others) for end in each.endpoints)
    return replace(found, related=(*first.related, *also), endpoints=tuple(ends))
