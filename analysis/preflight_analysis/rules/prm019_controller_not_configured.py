"""PRM019: a controller that is to be loaded and that its manager has no type of (ROS 2).

https://control.ros.org/jazzy/doc/ros2_control/controller_manager/doc/userdoc.html#helper-scripts
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.evaluation.ros2.param_files import read_param_file
from preflight_analysis.evaluation.ros2.params import of_name
from preflight_analysis.evaluation.ros2.spawners import asked_of, is_spawner
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.rules.further_reading import CONTROLLER_MANAGER
from preflight_analysis.rules.nearest import nearest
from preflight_analysis.rules.problems import include_chain, quoted
from preflight_analysis.rules.rule import Context, Rule

_SHOWN = 3


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    nodes = context.tree.nodes
    asked = {at: each for at, node in enumerate(nodes) if is_spawner(node) and (each := asked_of(node)) and each.plain}
    managers = {name: _manager(context, name) for name in dict.fromkeys(each.manager for each in asked.values())}
    for at, each in asked.items():
        manager = managers[each.manager]
        if manager is None:
            continue
        known = [param.name.removesuffix(".type") for param in manager.params if param.name.endswith(".type")]
        for controller in each.controllers if known else ():
            if controller not in known:
                yield _finding(rule, nodes[at], controller, manager, known)


def _finding(rule: Rule, spawner: LaunchNode, controller: str, manager: LaunchNode, known: list[str]) -> Finding:
    near = nearest(controller, known)
    some = quoted(known[:_SHOWN]) + (", ..." if len(known) > _SHOWN else "")
    files = [source.origin[-1] for source in manager.param_sources if source.path is not None]
    return rule.finding(
        f"{manager.name} has no parameter '{controller}.type': the controller is not loaded; "
        + (f"did you mean '{near}'?" if near is not None else f"it knows {some}"),
        spawner.location,
        confidence="likely",
        related=(
            *(Related(f"{manager.name} gets its parameters here", each) for each in files[:1]),
            *include_chain(spawner.origin),
        ),
    )


def _manager(context: Context, name: str) -> LaunchNode | None:
    """The node that is the manager of this name, or makes it: whatever program has one in it, its own code names it,
    and a parameter file that it gets has something for that name. None where that is not one, or not all known."""
    found = [node for node in context.tree.nodes_and_simulated if node.name == name]
    for node in context.tree.nodes if not found else ():
        if not (node.named or node.name_from_code or is_spawner(node)) and _has_section(context, node, name):
            found.append(of_name(node, name, context.documents, inferred=True))
    return found[0] if len(found) == 1 and not found[0].unknowns else None


def _has_section(context: Context, node: LaunchNode, name: str) -> bool:
    documents = (context.documents.get(each.path) for each in node.param_sources if each.path is not None)
    return any(
        section.exact for each in documents if each is not None for section in read_param_file(each).reaching(name)
    )


RULE = Rule(
    id="PRM019",
    name="controller-not-configured",
    severity="warning",
    what="Checks for a controller in the arguments of the `spawner` of ros2_control without a type in the "
    "parameters of the controller manager. The manager is a node of the launch, or the one that the robot "
    "description starts in Gazebo. There is no finding if the parameters of the manager are not all known, or if "
    "the spawner has its own parameters.",
    why="The manager refuses to load the controller: `The 'type' param was not defined`. The spawner exits and the "
    "controller does not run.",
    example="arguments=['streaming_controller']  # the manager's file has twist_controller",
    instead="arguments=['twist_controller']",
    references=(CONTROLLER_MANAGER,),
    generations=(2,),
    check=_check,
    in_branches=True,
)
