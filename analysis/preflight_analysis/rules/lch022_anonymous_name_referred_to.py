"""LCH022: something refers by name to a node whose name is made up anew with each launch."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from itertools import chain

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Origin
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix, Related
from preflight_analysis.launch.model import Value
from preflight_analysis.model.context import Context
from preflight_analysis.model.places import attribute_location
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.rules.further_reading import ANONYMOUS_NAMES, NAMES
from preflight_analysis.rules.rule import Rule

_ANON = re.compile(r"\$\(anon\s+([^()\s]+)\s*\)")
_GRAPH_NAME = re.compile(r"(?<![\w/$(:.])/[A-Za-z][\w/]*")


@dataclass(frozen=True, slots=True)
class _Reference:
    """A full name that the launch file writes, with the place and what it is."""

    name: str
    written: str
    what: str
    origin: Origin
    may_be_text: bool = False
    """Whether it need not be a name at all."""
    arguments_of: LaunchNode | None = None
    """The node in whose arguments it is: `origin` ends at that node's tag then, until it is `_placed`."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    nodes = context.tree.nodes
    plain_names = zip(context.each(_plain_name, nodes), nodes, strict=True)
    anonymous = {name: node for name, node in plain_names if name is not None}
    if not anonymous:
        return
    # Nearly no text has one of the names in it, and looking is quick.
    leaves = sorted({f"{name.rpartition('/')[2]}/" for name in anonymous})
    hit = re.compile("|".join(map(re.escape, leaves)))
    real = names.with_namespaces(node.name for node in nodes)
    seen: set[Location] = set()
    references = chain(
        context.each(_references_of_node, nodes, hit),
        context.each(_references_of_param, context.tree.all_params, hit),
    )
    for found in chain.from_iterable(filter(None, references)):
        reference = _placed(context, found)
        node = _named(reference.name, anonymous, real)
        if node is None or reference.origin[-1] in seen:
            continue
        seen.add(reference.origin[-1])
        plain = _plain_name(node) or ""
        yield rule.claim(
            f"{reference.what} '{reference.written}' has no effect: the name of node '{plain}' is $(anon ...), which "
            "differs at every launch",
            reference.origin[-1],
            subject=Subject("node", plain),
            doubts=doubts(DEPENDS=reference.may_be_text),
            related=(
                Related("the anonymous name", attribute_location(context, node, "name")),
                *include_chain(reference.origin),
            ),
            fixes=_fixes(context, node, reference, plain),
        )


def _placed(context: Context, reference: _Reference) -> _Reference:
    if reference.arguments_of is None:
        return reference
    place = attribute_location(context, reference.arguments_of, "args")
    return replace(reference, origin=(*reference.origin[:-1], place), arguments_of=None)


def _plain_name(node: LaunchNode) -> str | None:
    """The node's full name as it would be without the suffix; None if it is not anonymous."""
    value = node.action.value("name")
    if value is None or value.problem is not None or "$(anon" not in value.text:
        return None
    written = _ANON.sub(r"\1", value.text)
    if "$(" in written or not names.is_legal(written):
        return None
    return names.canonicalize(names.parent(node.name) + written)


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


def _references_of_node(node: LaunchNode, hit: re.Pattern[str]) -> tuple[_Reference, ...]:
    """What a node says that names something in which there is a `hit`."""
    found: list[_Reference] = []
    for remap in node.remaps:
        for side, place in ((remap.source, remap.source_location), (remap.target, remap.target_location)):
            if hit.search(side):
                origin = (*remap.origin[:-1], place)
                found.append(_Reference(names.resolve(side, node.name), side, "the name", origin))
    if node.args and hit.search(node.args):
        for name in _GRAPH_NAME.findall(node.args):
            found.append(_Reference(name, name, "in the arguments,", node.origin, may_be_text=True, arguments_of=node))
    return tuple(found)


def _references_of_param(param: Param, hit: re.Pattern[str]) -> tuple[_Reference, ...]:
    """What the name or the value of a parameter refers to, if there is a `hit` in it."""
    found: list[_Reference] = []
    if param.owner is None and hit.search(param.name):
        place = param.place
        found.append(_Reference(param.name, param.name, "parameter", (*param.origin[:-1], place)))
    value = param.value
    if isinstance(value, str) and value.startswith("/") and hit.search(value) and names.is_legal(value):
        found.append(_Reference(value, value, "the name", param.origin, may_be_text=True))
    return tuple(found)


def _fixes(context: Context, node: LaunchNode, reference: _Reference, plain: str) -> tuple[Fix, ...]:
    """The name written as the node has it, in the node's own file, where $(anon) gives the same name again."""
    value: Value | None = node.action.value("name")
    if value is None or reference.origin[-1].file != node.location.file:
        return ()
    return rename(context, reference.origin[-1], names.canonicalize(plain).rpartition("/")[2], value.text)


RULE = Rule(
    id="LCH022",
    name="anonymous-name-referred-to",
    effect="no-effect",
    kind="absent",
    sometimes=(Reason.DEPENDS,),
    what="Checks for a remap, parameter or argument that refers to a node by the name inside its `$(anon name)`.",
    why="`$(anon talker)` is not `talker`. roslaunch appends the host name, the process id and a random number. A "
    "reference to `/talker` never reaches this node.",
    example='<node pkg="chat" type="talker" name="$(anon talker)"/>\n<param name="/talker/rate" value="10"/>',
    instead='<param name="/$(anon talker)/rate" value="10"/>\n<node pkg="chat" type="talker" name="$(anon talker)"/>',
    references=(
        ANONYMOUS_NAMES,
        NAMES,
    ),
    generations=(1,),
    check=_check,
)
