"""LCH022: something refers by name to a node whose name is made up anew with each launch."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from preflight_analysis.documents.span import Location, Origin
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.finding import Confidence, Finding, Fix, Related
from preflight_analysis.launch.model import Value
from preflight_analysis.rules.places import attribute_location
from preflight_analysis.rules.problems import include_chain, rename
from preflight_analysis.rules.rule import Context, Rule

_ANON = re.compile(r"\$\(anon\s+([^()\s]+)\s*\)")
_GRAPH_NAME = re.compile(r"(?<![\w/$(:.])/[A-Za-z][\w/]*")


@dataclass(frozen=True, slots=True)
class _Reference:
    """A full name that the launch file writes, with the place and what it is."""

    name: str
    written: str
    what: str
    origin: Origin
    confidence: Confidence = "likely"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    anonymous = {name: node for node in context.tree.nodes if (name := _plain_name(node)) is not None}
    if not anonymous:
        return
    # Nearly no text has one of the names in it, and looking is quick.
    leaves = tuple({f"{name.rpartition('/')[2]}/" for name in anonymous})
    real = _with_namespaces(node.name for node in context.tree.nodes)
    seen: set[Location] = set()
    for reference in _references(context, leaves):
        node = _named(reference.name, anonymous, real)
        if node is None or reference.origin[-1] in seen:
            continue
        seen.add(reference.origin[-1])
        plain = _plain_name(node) or ""
        yield rule.finding(
            f"{reference.what} '{reference.written}' means nothing: node '{plain}' gets a name of its own at every "
            f"launch, since it is called $(anon ...)",
            reference.origin[-1],
            confidence=reference.confidence,
            related=(
                Related("the name is made here", attribute_location(context, node, "name")),
                *include_chain(reference.origin),
            ),
            fixes=_fixes(context, node, reference, plain),
        )


def _plain_name(node: LaunchNode) -> str | None:
    """The node's full name as it would be without the suffix; None if it is not anonymous."""
    value = node.action.value("name")
    if value is None or value.problem is not None or "$(anon" not in value.text:
        return None
    written = _ANON.sub(r"\1", value.text)
    if "$(" in written or not names.is_legal(written):
        return None
    return names.canonicalize(names.parent(node.name) + written)


def _with_namespaces(full_names: Iterable[str]) -> set[str]:
    """The names and all namespaces in them."""
    return {"/".join(p[:end]) for name in full_names for p in (name.split("/"),) for end in range(2, len(p) + 1)}


def _named(name: str, anonymous: dict[str, LaunchNode], real: set[str]) -> LaunchNode | None:
    """The anonymous node that the name, or a namespace in it, is; None if a node has that name
    or lives in that namespace."""
    parts = name.split("/")
    for end in range(len(parts) - 1, 1, -1):
        prefix = "/".join(parts[:end])
        if prefix in real:
            return None
        if prefix in anonymous:
            return anonymous[prefix]
    return None


def _references(context: Context, leaves: tuple[str, ...]) -> Iterator[_Reference]:
    """What in the launch names something below one of `leaves`."""
    hit = re.compile("|".join(map(re.escape, leaves))).search
    for node in context.tree.nodes:
        for remap in node.remaps:
            for side, place in ((remap.source, remap.source_location), (remap.target, remap.target_location)):
                if hit(side):
                    origin = (*remap.origin[:-1], place)
                    yield _Reference(names.resolve(side, node.name), side, "the name", origin)
        if node.args and hit(node.args):
            origin = (*node.origin[:-1], attribute_location(context, node, "args"))
            for found in _GRAPH_NAME.finditer(node.args):
                yield _Reference(found[0], found[0], "in the arguments,", origin, "possible")
    for param in context.tree.params.values():
        if param.owner is None and hit(param.name):
            place = param.name_location or param.origin[-1]
            yield _Reference(param.name, param.name, "parameter", (*param.origin[:-1], place))
        value = param.value
        if isinstance(value, str) and value.startswith("/") and hit(value) and names.is_legal(value):
            yield _Reference(value, value, "the name", param.origin, "possible")


def _fixes(context: Context, node: LaunchNode, reference: _Reference, plain: str) -> tuple[Fix, ...]:
    """The name written as the node has it, in the node's own file, where $(anon) gives the same name again."""
    value: Value | None = node.action.value("name")
    if value is None or reference.origin[-1].file != node.location.file:
        return ()
    return rename(context, reference.origin[-1], names.canonicalize(plain).rpartition("/")[2], value.text)


RULE = Rule(
    id="LCH022",
    name="anonymous-name-referred-to",
    severity="warning",
    what="Reports a remap, parameter or argument that names something of a node, by the name that stands in the "
    "`$(anon name)` of the node.",
    why="`$(anon talker)` is not `talker`: it gets the host's name, the process and a random number attached, so that "
    "nothing that names `/talker` ever means this node.",
    example='<node pkg="chat" type="talker" name="$(anon talker)"/>\n<param name="/talker/rate" value="10"/>',
    instead='<param name="/$(anon talker)/rate" value="10"/>\n<node pkg="chat" type="talker" name="$(anon talker)"/>',
    generations=(1,),
    check=_check,
)
