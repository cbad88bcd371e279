"""PRM009: a parameter's value is of another kind than the node's own default."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import replace
from itertools import chain
from typing import Any

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation.tree import LaunchTree, Param
from preflight_analysis.findings.claim import Effect, Subject, say
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.graph.model import ParamRead
from preflight_analysis.incremental.kept import Before
from preflight_analysis.launch.model import action_at
from preflight_analysis.model.context import Context
from preflight_analysis.model.parameters import changed_names
from preflight_analysis.model.places import related_param_read
from preflight_analysis.model.problems import fix, include_chain, shortened
from preflight_analysis.rules.further_reading import PARAMETER_SERVER, ROSLAUNCH_PARAM
from preflight_analysis.rules.rule import Rule

_BOOLEAN_WORDS = frozenset({"true", "false", "yes", "no", "on", "off", "y", "n", "t", "f"})
_OTHER_NUMBER = re.compile(
    r"[-+]?(0[xob][0-9a-f_]+|[0-9][0-9_]*(\.[0-9_]*)?(e[-+]?[0-9]+)?|\.[0-9]+(e[-+]?[0-9]+)?)", re.I
)
_PLAIN = re.compile(r"-?[0-9]+\.[0-9]+")
_SAID = "type mismatch of parameter '{name}': {value} is {kind}, {node} expects {wanted} (default {default}){advice}"
_OTHER_BASES = ("0x", "0o", "0b")


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None:
        return
    reported: set[tuple[str, str]] = set()
    of_nodes = context.each(_with_default, graph.reads_of_nodes)
    refused = context.whole(_refused, "", graph.tree, of_nodes, rule)
    for read, found in chain.from_iterable(refused):
        if (read.name, read.node.name) not in reported:
            reported.add((read.name, read.node.name))
            yield replace(found, fixes=_plain_number(context, graph.tree.params[read.name], read))


@dataclass(frozen=True, slots=True, eq=False)
class _WithDefault:
    """The reads of one node whose defaults tell of what kind the values are."""

    reads: tuple[ParamRead, ...]
    names: AbstractSet[str]


def _with_default(reads: tuple[ParamRead, ...]) -> _WithDefault:
    found = tuple(read for read in reads if read.use.has_default and not read.use.builtin and read.use.access == "get")
    return _WithDefault(found, {read.name for read in found})


_Refused = tuple[tuple[ParamRead, Finding], ...]


def _refused(
    before: Before[list[_Refused]] | None, tree: LaunchTree, of_nodes: tuple[_WithDefault, ...], rule: Rule
) -> list[_Refused]:
    """For each node the reads that get a value of another kind."""
    known: list[_Refused | None] = [None] * len(of_nodes)
    if before is not None and len(before[0][1]) == len(of_nodes):
        (old_tree, old_of_nodes, _), last = before
        names = changed_names(old_tree.all_params, tree.all_params)
        known = [
            found if old is each and names.isdisjoint(each.names) else None
            for found, old, each in zip(last, old_of_nodes, of_nodes, strict=True)
        ]
    params = tree.params
    return [
        found if found is not None else tuple(_refused_of(each.reads, params, rule))
        for found, each in zip(known, of_nodes, strict=True)
    ]


def _refused_of(
    reads: Iterable[ParamRead], params: Mapping[str, Param], rule: Rule
) -> Iterator[tuple[ParamRead, Finding]]:
    for read in reads:
        param = params.get(read.name)
        if param is not None and type(param.value) is not type(read.use.default):
            difference = _difference(param.value, read.use.default)
            if difference is not None:
                yield read, _finding(rule, param, read, difference)


def _plain_number(context: Context, param: Param, read: ParamRead) -> tuple[Fix, ...]:
    """The number that a text means, in the form that roslaunch takes for one: `1000` for `1e3`."""
    written, writer = str(param.value).strip(), context.writer(param.place.file)
    number_expected = isinstance(read.use.default, int | float) and not isinstance(read.use.default, bool)
    if not (number_expected and isinstance(param.value, str) and _OTHER_NUMBER.fullmatch(written)):
        return ()
    file = context.launch_files.get(param.place.file)
    tag = action_at(file, param.place.span.start) if file is not None else None
    try:
        number = float(int(written, 0) if written.lower().lstrip("-+").startswith(_OTHER_BASES) else written)
    except (OverflowError, ValueError):  # an old octal number, or one that is too large
        return ()
    # What has a type keeps it. A number of many digits would have an exponent again.
    if writer is None or (tag is not None and tag.value("type") is not None) or not _PLAIN.fullmatch(repr(number)):
        return ()
    plain = int(number) if number.is_integer() else number
    return fix(f"Write {plain}", writer.set_parameter(param.place.span, param.value, plain), preferred=True)


@dataclass(frozen=True, slots=True)
class _Difference:
    """What a value of another kind does, what speaks against that, and what to add to the message."""

    effect: Effect = "misbehaves"
    doubts: tuple[Doubt, ...] = ()
    advice: str = ""


def _finding(rule: Rule, param: Param, read: ParamRead, difference: _Difference) -> Finding:
    default = {"wanted": _kind(read.use.default), "default": _shown(read.use.default)}
    given = {"value": _shown(param.value), "kind": _kind(param.value)}
    return rule.claim(
        say(_SAID, name=param.name, node=read.node.name, **given, **default, advice=difference.advice),
        param.place,
        subject=Subject("parameter", param.name),
        effect=difference.effect,
        doubts=(*difference.doubts, *doubts(ASSUMED=read.use.evidence.assumed, FROM_SOURCE=read.use.evidence.inferred)),
        related=(related_param_read(read), *include_chain(param.origin)),
    )


def _difference(value: Any, default: Any) -> _Difference | None:
    """What is wrong; None where the value will do or nobody can tell.

    A default is also what a node takes for "not set": `False`, `0`, `""` and `None` say little of the kind.
    """
    match default:
        case bool():
            if isinstance(value, str) and value.strip().lower() in _BOOLEAN_WORDS:
                return _Difference(advice="; any text that is not empty is true")
        case int() | float():
            if isinstance(value, str):
                if not value.strip():
                    unset = doubts(NOT_SET="the argument or variable that the value comes from")
                    return _Difference(doubts=unset, advice="; set the argument or variable that the value comes from")
                if _OTHER_NUMBER.fullmatch(value.strip()):
                    return _Difference(advice="; write it as a plain decimal number")
                return _Difference("misbehaves" if default not in (0, -1) else "style")
            if isinstance(value, list | dict):
                return _Difference()
        case str() if default:
            if isinstance(value, list | dict):
                return _Difference()
        case list() | dict() if not default and isinstance(value, list | dict):
            return _Difference(doubts=doubts(INTENDED=True), advice="; an empty default may stand for either")
        case list():
            if isinstance(value, str) and value.strip().startswith("["):
                advice = '; a <param> is never a list: write <rosparam param="...">[...]</rosparam>'
                return _Difference(advice=advice)
            if isinstance(value, str | int | float | dict):
                return _Difference()
        case dict():
            if isinstance(value, str | int | float | list):
                return _Difference()
    return None


def _kind(value: Any) -> str:
    match value:
        case bool():
            return "a boolean"
        case int() | float():
            return "a number"
        case str():
            return "a text"
        case list():
            return "a list"
    return "a dictionary"


def _shown(value: Any) -> str:
    return shortened(repr(value))


RULE = Rule(
    id="PRM009",
    name="parameter-type",
    effect="misbehaves",
    kind="conflict",
    always=(Reason.LIBRARY,),
    sometimes=("style", Reason.ASSUMED, Reason.FROM_SOURCE, Reason.NOT_SET, Reason.INTENDED),
    what="Checks for a parameter whose value has another kind than the default with which a node reads it. An "
    'integer for a float is valid, and defaults that mean "not set" (`False`, an empty text) are not compared.',
    why="Some nodes crash, some use the default, and some read `off` as true. For `roslaunch` the values `1e3`, "
    "`0x10` and `1_000` are texts.",
    example='<param name="rate" value="1e3"/> <!-- rospy.get_param("~rate", 10) -->',
    instead='<param name="rate" value="1000"/>',
    references=(
        ROSLAUNCH_PARAM,
        PARAMETER_SERVER,
    ),
    generations=(1,),
    check=_check,
    needs_graph=True,
    every_root=True,
)
