"""Two snapshots to what came, went or changed.

An end that one side lacks counts only if that side would have it: a node that was not run, or of which only the source
was read, is no witness that it does not make something. Such nodes are named in `not_compared`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.snapshot.files import node_json
from preflight_analysis.snapshot.model import GROUPS, EndpointSnapshot, NodeSnapshot, Snapshot

Kind = Literal["added", "removed", "changed"]
CHANNELS = (
    ("topic", "publisher", "subscriber"),
    ("service", "service", "client"),
    ("action", "action_server", "action_client"),
)


@dataclass(frozen=True, slots=True)
class Change:
    """One thing that is not the same on both sides. `what` is `node`, the role of an end, `parameter`, `read`,
    `remap`, `env`, `error`, `unknown`, or `fact`: something of how the node is started. `name` is None for the node
    itself."""

    kind: Kind
    what: str
    node: str | None
    name: str | None
    before: Any = None
    after: Any = None


@dataclass(frozen=True, slots=True, order=True)
class Link:
    """A connection of two nodes that came or went. `provider` is the publisher or server."""

    what: str
    name: str
    provider: str
    consumer: str
    kind: Kind


@dataclass(frozen=True, slots=True)
class Difference:
    """All of it; `changes` by node and in the order of a snapshot's file."""

    before: Snapshot
    after: Snapshot
    changes: tuple[Change, ...]
    links: tuple[Link, ...]
    not_compared: Mapping[str, str]
    """Nodes whose ends could not be compared to their end, and why."""

    @property
    def same(self) -> bool:
        """Whether nothing came, went or changed."""
        return not self.changes and not self.links


_Endpoints = dict[str, Mapping[str, EndpointSnapshot]]


def difference(before: Snapshot, after: Snapshot) -> Difference:
    """What came, went or changed from one snapshot to the other."""
    changes: list[Change] = []
    changes += _of_names("error", None, dict.fromkeys(before.errors), dict.fromkeys(after.errors))
    changes += _of_names("unknown", None, dict.fromkeys(before.unknown), dict.fromkeys(after.unknown))
    changes += _of_names("parameter", None, before.parameters, after.parameters)
    links: dict[Kind, dict[str, _Endpoints]] = {"removed": {}, "added": {}}
    not_compared: dict[str, str] = {}
    for name in sorted({*before.nodes, *after.nodes}):
        old, new = before.nodes.get(name), after.nodes.get(name)
        if old is None or new is None:
            there = old or new
            assert there is not None
            kind: Kind = "removed" if new is None else "added"
            shown = node_json(there)
            changes.append(Change(kind, "node", name, None, *((shown, None) if new is None else (None, shown))))
            links[kind][name] = dict(there.endpoints)
            continue
        changes += _of_node(name, old, new)
        reason = _why_not(old, new)
        if reason is not None:
            not_compared[name] = reason
        links["removed"][name], links["added"][name] = _believed(old, new)
    gone, come = (_links(links[kind]) for kind in ("removed", "added"))
    found = [Link(*link, "removed") for link in gone - come] + [Link(*link, "added") for link in come - gone]
    return Difference(before, after, tuple(changes), tuple(sorted(found)), not_compared)


def _of_node(name: str, old: NodeSnapshot, new: NodeSnapshot) -> Iterator[Change]:
    yield from _of_names("fact", name, old.facts, new.facts)
    if "not-run" not in (old.outcome, new.outcome) and old.outcome != new.outcome:
        yield Change("changed", "fact", name, "outcome", old.outcome, new.outcome)
    was, becomes = _believed(old, new)
    for role in GROUPS.values():
        befores, afters = was.get(role, {}), becomes.get(role, {})
        for of in sorted({*befores, *afters}):
            before, after = befores.get(of), afters.get(of)
            if before is None or after is None:
                kind: Kind = "removed" if after is None else "added"
                yield Change(kind, role, name, of, _endpoint_json(before), _endpoint_json(after))
            elif differ := _differs(before, after, old.interface == new.interface):
                yield Change("changed", role, name, of, *differ)
    yield from _of_names("parameter", name, old.parameters, new.parameters)
    yield from _of_names("read", name, *_believed_reads(old, new))
    yield from _of_names("remap", name, old.remaps, new.remaps)
    yield from _of_names("env", name, old.env, new.env)


def _of_names(what: str, node: str | None, before: Mapping[str, Any], after: Mapping[str, Any]) -> Iterator[Change]:
    for name in sorted({*before, *after}):
        if name not in after:
            yield Change("removed", what, node, name, before=before[name])
        elif name not in before:
            yield Change("added", what, node, name, after=after[name])
        elif not _equal(before[name], after[name]):
            yield Change("changed", what, node, name, before[name], after[name])


def _equal(before: Any, after: Any) -> bool:
    """ROS tells true from 1 and 1 from 1.0, Python does not."""
    if isinstance(before, Mapping) and isinstance(after, Mapping):
        return before.keys() == after.keys() and all(_equal(before[key], after[key]) for key in before)
    if isinstance(before, list) and isinstance(after, list):
        return len(before) == len(after) and all(map(_equal, before, after))
    return type(before) is type(after) and before == after


def _witness(side: NodeSnapshot, other: NodeSnapshot) -> bool:
    """Whether what the side lacks, and the other has, is not there."""
    alike = (side.interface, side.outcome) == (other.interface, other.outcome)
    return side.known and (side.sure or alike)


def _believed(old: NodeSnapshot, new: NodeSnapshot) -> tuple[_Endpoints, _Endpoints]:
    """The ends of both sides, with what a side that is no witness lacks taken from the other."""
    was, becomes = dict(old.endpoints), dict(new.endpoints)
    for role in GROUPS.values():
        of_old, of_new = old.endpoints.get(role, {}), new.endpoints.get(role, {})
        if not _witness(old, new):
            was[role] = {**of_new, **of_old}
        if not _witness(new, old):
            becomes[role] = {**of_old, **of_new}
    return was, becomes


def _believed_reads(old: NodeSnapshot, new: NodeSnapshot) -> tuple[Mapping[str, Any], Mapping[str, Any]]:
    """Only two runs, or two readings of one kind, are alike in what they tell of a parameter's default."""
    if (old.interface, old.outcome) != (new.interface, new.outcome):
        return {}, {}
    return old.reads, new.reads


def _why_not(old: NodeSnapshot, new: NodeSnapshot) -> str | None:
    for side, other, word in ((new, old, "after"), (old, new, "before")):
        if not side.known:
            if other.known:
                return f"nothing is known of it {word}"
        elif not _witness(side, other):
            return f"it is known by its {side.interface} {word} ({side.outcome}), by its {other.interface} otherwise"
    return None


def _differs(
    before: EndpointSnapshot, after: EndpointSnapshot, alike: bool
) -> tuple[dict[str, Any], dict[str, Any]] | None:
    """What is not the same of an end's type and QoS. What one side does not know is no difference, unless both know by
    the same means."""
    old, new = _endpoint_json(before) or {}, _endpoint_json(after) or {}
    keys = [key for key in {**old, **new} if alike or (old.get(key) is not None and new.get(key) is not None)]
    changed = [key for key in keys if not _equal(old.get(key), new.get(key))]
    if not changed:
        return None
    return {key: old.get(key) for key in changed}, {key: new.get(key) for key in changed}


def _endpoint_json(endpoint: EndpointSnapshot | None) -> dict[str, Any] | None:
    return None if endpoint is None else {"type": endpoint.type, **endpoint.qos}


def _links(nodes: Mapping[str, _Endpoints]) -> set[tuple[str, str, str, str]]:
    found: set[tuple[str, str, str, str]] = set()
    for what, providing, consuming in CHANNELS:
        sides: dict[str, tuple[list[str], list[str]]] = {}
        for node, endpoints in nodes.items():
            for role, side in ((providing, 0), (consuming, 1)):
                for name in endpoints.get(role, ()):
                    sides.setdefault(name, ([], []))[side].append(node)
        found.update(
            (what, name, a, b) for name, (providers, consumers) in sides.items() for a in providers for b in consumers
        )
    return found
