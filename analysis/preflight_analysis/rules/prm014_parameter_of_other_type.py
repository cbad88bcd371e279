"""PRM014: a parameter of another type than its node declares (ROS 2)."""

from collections.abc import Iterator
from typing import Any

from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.rules.parameters import name_place
from preflight_analysis.rules.places import node_location
from preflight_analysis.rules.problems import include_chain
from preflight_analysis.rules.rule import Context, Rule

_NAMES = {bool: "a bool", int: "an integer", float: "a double", str: "a string"}
_LISTS = {bool: "a list of bools", int: "a list of integers", float: "a list of doubles", str: "a list of strings"}


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    for node, interface in zip(graph.tree.nodes, graph.interfaces, strict=True) if graph is not None else ():
        declared = {u.name.removeprefix("~"): u for u in interface.params if u.has_default and u.access == "get"}
        for param in node.params:
            use = declared.get(param.name)
            if use is None:
                continue
            wanted, given = _kind(use.default), _kind(param.value)
            if wanted is None or given is None or wanted == given:
                continue
            hint = ""
            if (given, wanted) == (_NAMES[int], _NAMES[float]):
                hint = f"; write {param.value}.0"
            yield rule.finding(
                f"'{param.name}' is {given}, and {node.name} declares it as {wanted}: the node stops when it "
                f"declares it{hint}",
                name_place(param),
                confidence="likely" if not use.assumed else "possible",
                severity="error" if not use.assumed else "warning",
                related=(
                    Related(f"{node.name} is started here", node_location(node)),
                    *include_chain(node.origin),
                ),
            )


def _kind(value: Any) -> str | None:
    """The type of a parameter's value; None for what says none, an empty list for instance."""
    if isinstance(value, (list, tuple)):
        kinds = {type(each) for each in value}
        return _LISTS.get(kinds.pop()) if len(kinds) == 1 else None
    return _NAMES.get(type(value))


RULE = Rule(
    id="PRM014",
    name="parameter-of-other-type",
    severity="error",
    what="Reports a parameter whose value has another type than the one that the node declares it with (ROS 2). An "
    "integer is no double.",
    why="rclcpp and rclpy raise an exception in `declare_parameter`, and most nodes end by it.",
    example='<!-- declare_parameter("rate", 10.0) -->\n<param name="rate" value="5"/>',
    instead='<param name="rate" value="5.0"/>',
    generations=(2,),
    check=_check,
    needs_graph=True,
)
