"""The result of a tool: the verb's JSON document, no longer than a caller can take, and a short text."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from itertools import islice
from typing import Any

from preflight_analysis.findings.failure import Failure
from preflight_analysis.findings.printable import printable

Document = Mapping[str, Any]
MOST_BYTES = 200_000
"""Of a document as JSON."""
_LINES = 20
_MOST_TEXT = 4000


def bounded(document: Document, limit: int) -> dict[str, Any]:
    """The document with at most `limit` items in each of its lists and tables, fewer where it would be longer than
    `MOST_BYTES`. `cut` then has the whole lengths by the name of the list."""
    while True:
        found = _cut(document, limit)
        if len(json.dumps(found)) <= MOST_BYTES or limit == 0:
            return found
        limit //= 2


def _cut(document: Document, limit: int) -> dict[str, Any]:
    kept: dict[str, Any] = {}
    cut: dict[str, int] = {}
    for key, value in document.items():
        long = isinstance(value, (list, dict)) and len(value) > limit
        if long:
            cut[key] = len(value)
            value = value[:limit] if isinstance(value, list) else dict(islice(value.items(), limit))  # noqa: PLW2901
        kept[key] = value
    return {**kept, "cut": cut} if cut else kept


def summary(verb: str, document: Document) -> str:
    """A few lines for a reader: what was found, with places."""
    lines = [*islice(_SUMMARIES[verb](document), _LINES + 1)]
    if len(lines) > _LINES:
        lines[_LINES] = "..."
    if cut := document.get("cut"):
        lines.append("The result is cut: " + ", ".join(f"{count} {key}" for key, count in cut.items()) + " in all.")
    return printable("\n".join(lines), lines=True)[:_MOST_TEXT]


def _check(document: Document) -> Iterator[str]:
    counts = Counter(finding["severity"] for finding in document["findings"])
    total = ", ".join(f"{count} {severity}" for severity, count in counts.items()) or "no findings"
    yield f"{total}; {document['files']} launch files, {document['nodes']} nodes"
    for failure in document["failures"]:
        yield Failure(failure["rule"], failure["file"], failure["error"]).message(failure["file"])
    yield from map(_finding, document["findings"])


def _finding(finding: Document) -> str:
    at = finding["range"]["start"]
    place = f"{finding['file']}:{at['line']}:{at['column']}"
    return f"{place}: {finding['severity']} {finding['rule']}: {finding['message']}"


def _tree(document: Document) -> Iterator[str]:
    yield f"{len(document['nodes'])} nodes, {len(document['includes'])} includes"
    for error in document["errors"]:
        yield f"{_place(error)}: {error['rule']}: {error['message']}"
    for node in document["nodes"]:
        yield f"{node['name'] or '(unnamed)'} {node['package']}/{node['executable']} [{_place(node['origin'][-1])}]"


def _graph(document: Document) -> Iterator[str]:
    yield f"{len(document['nodes'])} nodes, {len(document['topics'])} topics, {len(document['services'])} services"
    for name, topic in document["topics"].items():
        if not topic.get("builtin"):
            ends = " -> ".join(", ".join(topic[side]) or "none" for side in ("publishers", "subscribers"))
            yield f"{name} {' '.join(topic['types'])}: {ends}"


def _why(document: Document) -> Iterator[str]:
    if "start" in document:
        start = document["start"]
        yield f"{start['node']} is {'started' if start['started'] else 'not started'}"
        yield from map(_link, start["links"])
    for chain in document.get("chains", ()):
        so_far = "no broken link" if chain["channel"] else "no topic, service or action is known that they share"
        state = {True: "connected", False: "not connected", None: f"{so_far}, some links are unknown"}
        over = f" over {chain['channel']}" if chain["channel"] else ""
        yield f"{chain['provider']} -> {chain['consumer']}{over}: {state[chain['connected']]}"
        yield from map(_link, chain["links"])


def _link(link: Document) -> str:
    return f"  {link['state']}: {link['text']}" + (f" [{_place(link)}]" if "file" in link else "")


def _where(document: Document) -> Iterator[str]:
    for parameter in document["parameters"]:
        of = f" of {parameter['node']}" if parameter["node"] else ""
        yield f"parameter '{parameter['name']}'{of}"
        for setting in parameter["settings"]:
            state = "applies" if setting["applies"] else "overridden"
            yield f"  {state}: {json.dumps(setting['value'])} [{_place(setting)}]"
        for unknown in parameter["unknown"]:
            yield f"  unknown: {unknown['what']} ({unknown['reason']}) [{_place(unknown)}]"
        declared = parameter["declared"]
        if declared is not None and "default" in declared:
            yield f"  default: {json.dumps(declared['default'])}"


def _frames(document: Document) -> Iterator[str]:
    missing = [use for use in document["uses"] if use["looked_up"] and not use["published"]]
    yield f"{len(document['frames'])} frames, {len(missing)} uses of frames that no known node publishes"
    for use in missing:
        yield f"  {use['frame']}: {use['node']}, {use['what']} [{_place(use)}]"
    for frame in document["frames"]:
        parents = ", ".join(edge["parent"] for edge in frame["parents"]) or "no parent"
        yield f"  {frame['frame']}: {parents}"


def _explain(document: Document) -> Iterator[str]:
    yield from map(_finding, document["findings"])
    for rule in document["rules"]:
        yield f"{rule['id']} {rule['name']}: {rule['what']}"
        yield str(rule["why"])


def _diff(document: Document) -> Iterator[str]:
    yield "no difference" if document["same"] else f"{len(document['changes'])} changes"
    for change in document["changes"]:
        node = f"{change['node']}: " if change["node"] else ""
        values = " -> ".join(json.dumps(change[side]) for side in ("before", "after") if change[side] is not None)
        yield f"  {node}{change['kind']} {change['what']} {change['name'] or ''} {values}".rstrip()
    for left_out in document["not_compared"]:
        yield f"  {left_out['node']} is not compared: {left_out['reason']}"


def _place(where: Document) -> str:
    return f"{where['file']}:{where['line']}:{where['column']}"


_SUMMARIES: Mapping[str, Callable[[Document], Iterator[str]]] = {
    "check": _check,
    "tree": _tree,
    "graph": _graph,
    "why": _why,
    "where": _where,
    "frames": _frames,
    "explain": _explain,
    "diff": _diff,
}
