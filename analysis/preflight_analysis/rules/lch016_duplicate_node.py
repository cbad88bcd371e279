"""LCH016: two nodes of one name."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.problems import DuplicateNode
from preflight_analysis.evaluation.ros2.spawners import is_spawner
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix, Related
from preflight_analysis.model.catalogued import doubts_of_file
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import include_chain, problems_of, rename, shortened
from preflight_analysis.model.python_branches import made_twice
from preflight_analysis.model.python_description import always_twice
from preflight_analysis.rules.further_reading import LAUNCH_DESIGN, NAMES, NODES
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    taken = {node.name for node in context.tree.nodes}
    for problem in problems_of(context, DuplicateNode):
        name, first = problem.kind.name, problem.kind.first
        if first is None:
            message = f"duplicate node name '{name}': roslaunch's own node has this name"
            yield problem_claim(rule, problem, message, subject=Subject("node", name))
            continue
        location = problem.location
        twice = first.file == location.file and first.span.start <= location.span.start < first.span.end
        how = ": this file is included twice; give each include its own namespace" if twice else ""
        yield problem_claim(
            rule,
            problem,
            f"duplicate node name '{name}'{how}",
            subject=Subject("node", name),
            effect="stops-launch" if problem.fatal else "misbehaves",
            doubts=() if problem.fatal else doubts_of_file(context, first.file),
            related=(Related("the first node", first),),
            fixes=() if twice else _fixes(context, name, location, taken),
        )
    yield from _unrun(rule, context, taken)
    yield from _of_own_names(rule, context)
    yield from _in_branches(rule, context)


def _unrun(rule: Rule, context: Context, taken: set[str]) -> Iterator[Finding]:
    """Nodes that a Python launch file starts whatever happens, where it was not run."""
    not_run = [path for path, each in context.launch_files.items() if each.is_python and each.partial]
    made = {node.location: node for node in context.tree.nodes} if not_run else {}
    for path in not_run:
        for twice in always_twice(context.launch_files[path]):
            first, second = (made.get(context.location(path, span)) for span in (twice.first, twice.second))
            if first is None or second is None:
                continue
            places = [
                context.location(path, node.tag.span_of("name") or node.action.kind_span) for node in (first, second)
            ]
            yield rule.claim(
                f"duplicate node name '{second.name}'",
                places[1],
                subject=Subject("node", second.name),
                effect="misbehaves",
                related=(Related("the first node", places[0]), *include_chain(second.origin)),
                fixes=_fixes(context, second.name, places[1], taken),
            )


def _of_own_names(rule: Rule, context: Context) -> Iterator[Finding]:
    """Nodes of ROS 2 whose own code gives them the name that another one has."""
    nodes = context.graph.tree.nodes if context.graph is not None else ()
    if not any(node.name_from_code for node in nodes):
        return
    first: dict[str, LaunchNode] = {}
    for node in sorted(nodes, key=lambda node: node.name_from_code):
        if not (node.named or node.name_from_code) or node.unknowns:
            continue
        other = first.setdefault(node.name, node)
        if node.within is not None and node.within == other.within and node is not other:
            continue  # two processes of one name, of which each makes them all
        simulated = next((each for each in (node, other) if each.kind == "simulated"), None)
        if simulated is not None and other is not node:
            started = other if simulated is node else node
            yield rule.claim(
                f"duplicate node name '{node.name}': the simulator creates it for the robot, and this launch starts it",
                context.location(started.location.file, started.action.kind_span),
                subject=Subject("node", node.name),
                effect="misbehaves",
                doubts=doubts(LIBRARY=True),
                related=(Related("the robot is spawned here", simulated.location), *include_chain(started.origin)),
            )
        elif node.name_from_code and other is not node:
            yield rule.claim(
                f"duplicate node name '{node.name}': {_why(node)}",
                context.location(node.location.file, node.action.kind_span),
                subject=Subject("node", node.name),
                effect="misbehaves",
                doubts=doubts(
                    ASSUMED=node.name_inferred,
                    NOT_ANALYSED=other.name if other.name_inferred else "",
                    # A spawner ends when the controller is there.
                    INTENDED=is_spawner(node) or is_spawner(other),
                    FROM_SOURCE=True,
                ),
                related=(Related("the first node", other.location), *include_chain(node.origin)),
            )


def _in_branches(rule: Rule, context: Context) -> Iterator[Finding]:
    """Nodes of Python launch files that have one name in a branch which this launch need not take."""
    said = {problem.location for problem in problems_of(context, DuplicateNode)}
    for path, launch_file in context.launch_files.items():
        for twice in made_twice(launch_file) if launch_file.is_python else ():
            first, second = context.location(path, twice.first), context.location(path, twice.second)
            if said.isdisjoint((first, second)):
                yield rule.claim(
                    f"duplicate node name if `{shortened(twice.test)}`",
                    second,
                    subject=Subject("node"),
                    effect="misbehaves",
                    doubts=doubts(OTHER_ARGUMENTS=True),
                    related=(Related("the other node", first),),
                )


def _why(node: LaunchNode) -> str:
    if node.within is not None:
        return f"the process of {node.within} creates it"
    return "it comes from the node's code, because the tag has no 'name'"


def _fixes(context: Context, full: str, location: Location, taken: set[str]) -> tuple[Fix, ...]:
    """The name with a number that makes it the only one."""
    namespace, leaf = names.parent(full), names.leaf(full)
    number = 2
    while f"{namespace}{leaf}_{number}" in taken:
        number += 1
    taken.add(f"{namespace}{leaf}_{number}")
    return rename(context, location, leaf, f"{leaf}_{number}")


RULE = Rule(
    id="LCH016",
    name="duplicate-node",
    effect="stops-launch",
    kind="duplicate",
    sometimes=(
        "misbehaves",
        Reason.OTHER_DISTRIBUTION,
        Reason.LIBRARY,
        Reason.ASSUMED,
        Reason.NOT_ANALYSED,
        Reason.INTENDED,
        Reason.FROM_SOURCE,
    ),
    what="Checks for a second node with the same full name, in this file or an included file. In a Python launch "
    "file it also checks nodes that are made in one branch of an `if`.",
    why="`roslaunch` stops, because names are unique in the graph: a second node shuts the first one down. `ros2 "
    "launch` only warns. Both nodes run, and a request to one of them by its name may reach the other. `ros2 "
    "launch` does not notice duplicate names of nodes without a `name`.",
    example='<node pkg="laser" type="driver" name="laser"/>\n<node pkg="laser" type="driver" name="laser"/>',
    instead='<node pkg="laser" type="driver" name="laser_front"/>\n<node pkg="laser" type="driver" name="laser_rear"/>',
    references=(
        NODES,
        NAMES,
        LAUNCH_DESIGN,
    ),
    check=_check,
    problems=(DuplicateNode,),
)
