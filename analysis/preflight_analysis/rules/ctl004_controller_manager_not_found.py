"""CTL004: a spawner asks a controller manager that the launch has under another name.

https://control.ros.org/jazzy/doc/ros2_control/controller_manager/doc/userdoc.html#helper-scripts
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.evaluation.ros2.spawners import asked_of, is_spawner
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.controllers import managers_of
from preflight_analysis.rules.further_reading import CONTROLLER_MANAGER
from preflight_analysis.rules.places import attribute_location
from preflight_analysis.rules.problems import include_chain, quoted
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    tree = context.tree
    spawners = [node for node in tree.nodes if is_spawner(node)]
    managers = managers_of(tree) if spawners else ()
    # What is not known, or a program that has a manager in it, may be the one that is meant.
    if not managers or not tree.complete:
        return
    there = {*managers, *(node.name for node in tree.nodes_and_simulated)}
    for node in spawners:
        asked = asked_of(node)
        if asked is None or asked.manager in there:
            continue
        yield rule.finding(
            f"controller manager '{asked.manager}' is not in this launch: {node.name} waits for it; the launch has "
            f"{quoted(sorted(set(managers)))}",
            attribute_location(context, node, "args"),
            confidence="likely",
            related=include_chain(node.origin),
        )


RULE = Rule(
    id="CTL004",
    name="controller-manager-not-found",
    severity="warning",
    what="Checks for a spawner that asks for a controller manager which the launch does not start, while the launch "
    "starts another one, for example in a namespace. There is no finding if not all of the launch is known.",
    why="The spawner waits for the services of that manager until its timeout. No controller is loaded.",
    example='<node pkg="controller_manager" exec="ros2_control_node" name="controller_manager" namespace="robot"/>\n'
    '<node pkg="controller_manager" exec="spawner" args="base -c /controller_manager"/>',
    instead='<node pkg="controller_manager" exec="ros2_control_node" name="controller_manager" namespace="robot"/>\n'
    '<node pkg="controller_manager" exec="spawner" args="base -c /robot/controller_manager"/>',
    references=(CONTROLLER_MANAGER,),
    generations=(2,),
    check=_check,
    every_root=True,
)
