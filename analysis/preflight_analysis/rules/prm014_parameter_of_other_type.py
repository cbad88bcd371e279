"""PRM014: a parameter of another type than its node declares (ROS 2)."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from preflight_analysis.evaluation.ros2.rcl_yaml import as_passed, plain_scalar
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.claim import Text, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.model.context import Context
from preflight_analysis.model.distributions import BEFORE_GALACTIC, otherwise_in
from preflight_analysis.model.files import is_template
from preflight_analysis.model.parameters import OF_ALL_NODES
from preflight_analysis.model.problems import fix, shortened
from preflight_analysis.rules.further_reading import PARAMETERS, PARAMETERS_DESIGN
from preflight_analysis.rules.refusals import OF_REFUSALS, refusal
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.interface import Interface, ParamUse

_TYPES = {bool: "bool", int: "integer", float: "double", str: "string"}
_NAMES = {
    "bool": "a bool",
    "integer": "an integer",
    "double": "a double",
    "string": "a string",
    "byte array": "bytes (which an empty list means)",
}
_START = "type mismatch of parameter '{name}': "
_OTHER_TYPE = _START + "got {given}, {node} declares {wanted}; the node exits (InvalidParameterTypeException){hint}"
_EMPTY = _START + "an empty list has no type, {node} declares {wanted}; rclpy ignores the value, rclcpp exits"
_UNQUOTED = (
    _START + "launch passes {value} without quotes, and rcl reads {given}; {node} declares {wanted}, the node exits "
    "(InvalidParameterTypeException); set it in a parameter file, in quotes"
)
_REFUSED = "parameter '{name}' is refused, and {node} exits: {quoted}"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    reported: set[tuple[object, ...]] = set()
    for node, interface in zip(graph.tree.nodes, graph.interfaces, strict=True) if graph is not None else ():
        if not node.params:
            continue
        uses = {u.name.removeprefix("~"): u for u in interface.params if u.access == "get"}
        known = {**OF_ALL_NODES, **uses} if node.kind != "process" else uses
        declared = {name: use for name, use in known.items() if not use.dynamic}
        for param in node.params:
            use = declared.get(param.name)
            wanted = _declared_type(use, interface) if use is not None else None
            if use is None or wanted is None or _is_as_declared(param, use, wanted):
                continue
            place, files = param.place, {s.path for s in node.param_sources}
            passed = param.value if place.file in files or node.container else as_passed(param.value)
            message = _wrong(param, passed, wanted, node)
            if message is None and use.refused is not None:
                message = say(_REFUSED, name=param.name, node=node.name, quoted=use.refused)
            if message is None or (place, wanted) in reported:
                continue  # what is written once for several nodes is wrong for each
            reported.add((place, wanted))
            # A program writes the value into the file before it is used.
            template = doubts(NOT_SET=f"the value of '{param.name}'" if is_template(str(param.value)) else "")
            fixes = _fixes(context, param, passed, wanted, in_file=place.file in files)
            # Before, the node logged it and went on: its clock takes it, after it is declared without a type.
            clock = otherwise_in(context.environment, BEFORE_GALACTIC) if param.name == "use_sim_time" else ()
            yield replace(refusal(rule, node, param, use, message, (*template, *clock)), fixes=fixes)


def _is_as_declared(param: Param, use: ParamUse, wanted: str) -> bool:
    """Most are as they should be, and only texts change on their way."""
    return use.refused is None and wanted != "string" and _TYPES.get(type(param.value)) == wanted


def _declared_type(use: ParamUse, interface: Interface) -> str | None:
    """The type that the node gives the parameter; what an annotation says of a default is a text, whatever it means."""
    if use.type is not None or not use.has_default:
        return use.type
    return None if interface.declared and isinstance(use.default, str) else _type(use.default)


def _wrong(param: Param, passed: Any, wanted: str, node: LaunchNode) -> Text | None:
    """What is wrong with the value that arrives at the node; None if it fits, or if nobody can tell."""
    if isinstance(passed, (list, tuple)) and not passed:
        # An empty list is what the node has anyway.
        return None if wanted == "byte array" else say(_EMPTY, name=param.name, node=node.name, wanted=_named(wanted))
    given = _type(passed)
    if given is None or given == wanted:
        return None
    kinds = {"given": _named(given), "wanted": _named(wanted)}
    if _type(param.value) == wanted:
        return say(_UNQUOTED, name=param.name, node=node.name, value=_shown(param.value), **kinds)
    return say(_OTHER_TYPE, name=param.name, node=node.name, **kinds, hint=_hint(passed, given, wanted))


def _hint(passed: Any, given: str, wanted: str) -> str:
    match given, wanted:
        case "integer", "double":
            return f"; write {passed}.0"
        case "integer array", "double array":
            return f"; write [{', '.join(f'{each}.0' for each in passed)}]"
        case (("integer" | "double" | "bool"), "string"):
            return "; in a parameter file, write it in quotes"
        case "string", ("integer" | "double" | "bool"):
            return "; write it without quotes" if _type(plain_scalar(str(passed))) == wanted else ""
    if given == wanted.removesuffix(" array"):
        return f"; write [{passed}]" if given != "string" else ""
    return ""


def _fixes(context: Context, param: Param, passed: Any, wanted: str, *, in_file: bool) -> tuple[Fix, ...]:
    """The value as the message has it, where it is written as such."""
    writer, given = context.writer(param.place.file), _type(passed)
    new: object = None
    match given, wanted:
        case "integer", "double":
            new = float(passed)
        case "integer array", "double array":
            new = [float(each) for each in passed]
        case (("integer" | "double" | "bool"), "string"):
            new = str(passed) if in_file else None
        case "string", ("integer" | "double" | "bool"):
            plain = plain_scalar(str(passed))
            new = plain if _type(plain) == wanted else None
        case _ if given is not None and given != "string" and given == wanted.removesuffix(" array"):
            new = [passed]
    if writer is None or new is None or _type(param.value) == wanted:
        return ()
    title = f"Write '{param.name.rpartition('.')[2]}' as {_named(wanted)}"
    return fix(title, writer.set_parameter(param.place.span, param.value, new), preferred=True)


def _type(value: Any) -> str | None:
    """The type of a parameter's value; None for what says none."""
    if isinstance(value, (list, tuple)):
        kinds = {type(each) for each in value}
        kind = _TYPES.get(kinds.pop()) if len(kinds) == 1 else None
        return f"{kind} array" if kind else None
    return _TYPES.get(type(value))


def _named(type_: str) -> str:
    return _NAMES.get(type_) or f"a list of {type_.removesuffix(' array')}s"


def _shown(value: Any) -> str:
    return repr(shortened(str(value)))


RULE = Rule(
    id="PRM014",
    name="parameter-of-other-type",
    effect="stops-node",
    kind="conflict",
    sometimes=(*OF_REFUSALS, Reason.NOT_SET, Reason.MEANT_FOR_OTHER, Reason.NOT_GIVEN),
    of_param=True,
    what="Checks for a parameter whose type differs from the type that its node declares. An integer is not a "
    "double, and an empty list has no type. A text of the launch file may arrive with another type.",
    why="rclcpp and rclpy raise InvalidParameterTypeException in `declare_parameter`, and most nodes exit.",
    example='<!-- declare_parameter("rate", 10.0) -->\n<param name="rate" value="5"/>',
    instead='<param name="rate" value="5.0"/>',
    references=(
        PARAMETERS,
        PARAMETERS_DESIGN,
    ),
    settings=("nodes",),
    generations=(2,),
    check=_check,
    needs_graph=True,
)
