"""PRM013: a parameter that its node does not declare (ROS 2)."""

from collections.abc import Collection, Iterator

from preflight_analysis.documents.span import Location
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Alike, Finding, Fix
from preflight_analysis.model.context import Context
from preflight_analysis.model.declared_params import declared_params, is_controller, undeclared
from preflight_analysis.model.nearest import did_you_mean, is_slip
from preflight_analysis.model.places import related_node
from preflight_analysis.model.problems import include_chain, replacement
from preflight_analysis.model.sections import is_for_all, section_at
from preflight_analysis.rules.further_reading import PARAMETERS, PARAMETERS_DESIGN
from preflight_analysis.rules.rule import Rule

_CLOCK = "use_sim_time"
_SAID = "parameter '{name}' is not declared by {node}; its value is ignored{near}"
_MANY = "parameters are not declared by {node}; their values are ignored"
_NO_CLOCK = "parameter '{name}' of {node} has no effect; did you mean '{near}'?"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None:
        return
    nodes = [(n, declared_params(n, i), i) for n, i in zip(graph.tree.nodes, graph.interfaces, strict=True) if n.params]
    takers: dict[Location | None, set[int]] = {}
    for node, declared, _ in nodes:
        for param in node.params:
            if declared is None or is_controller(node) or param.name in declared:
                takers.setdefault(param.name_location, set()).add(id(node))
    for node, declared, interface in nodes:
        for param in node.params:
            if is_slip(param.name, _CLOCK) and param.name != _CLOCK and param.name not in (declared or ()):
                yield _clock(rule, context, node, param)
        for param in node.params if declared is not None else ():
            if declared is None or is_slip(param.name, _CLOCK):
                continue
            if param.name_location is not None and takers.get(param.name_location, set()) - {id(node)}:
                continue  # what is written once for several nodes, one of which wants it
            found = undeclared(context, node, interface, declared, param.name, param.place.file)
            if found is None:
                continue
            near, in_full = found.meant, declared.closed
            use = declared.names.get(near) if near is not None else None
            shared = near is None and (
                _is_for_all(context, node, param)
                or _is_other_choice(param.name, declared.names)
                or _is_handed_over(context, param)
            )
            yield rule.claim(
                say(_SAID, name=param.name, node=node.name, near=did_you_mean(near)),
                param.place,
                subject=Subject("parameter", param.name),
                kind="absent" if near is None else "near",
                doubts=doubts(
                    SHARED=shared,
                    PARTLY_READ=near is None and not in_full,
                    NOT_ANALYSED=node.name if not in_full and (use is None or use.evidence.inferred) else "",
                    FROM_SOURCE=(in_full or use is not None) and interface.source == "source",
                    LATER=node.name if interface.source == "trace" else "",
                ),
                candidates=(near,),
                related=(related_node(node), *include_chain(node.origin)),
                fixes=_rename(context, param, near) if near is not None else (),
                alike=Alike(say(_MANY, node=node.name), param.name) if near is None else None,
            )


def _clock(rule: Rule, context: Context, node: LaunchNode, param: Param) -> Finding:
    """A slip of the one parameter that each node has, be the node known or not."""
    return rule.claim(
        say(_NO_CLOCK, name=param.name, node=node.name, near=_CLOCK),
        param.place,
        subject=Subject("parameter", param.name),
        kind="near",
        doubts=doubts(FROM_SOURCE=True),
        candidates=(_CLOCK,),
        related=include_chain(node.origin),
        fixes=_rename(context, param, _CLOCK),
    )


def _is_for_all(context: Context, node: LaunchNode, param: Param) -> bool:
    """Whether it is written for whoever wants it: in a section for any node, of a file that is not the node's own."""
    place = param.name_location
    section = section_at(context, place) if place is not None else None
    if place is None or section is None or not is_for_all(section.section):
        return False
    owner = package_around(context.environment, place.file)
    return owner is None or owner.name != node.package


def _is_handed_over(context: Context, param: Param) -> bool:
    """Whether a Python launch file does not have the name itself: it hands over what it has read, of which a node may
    want a part."""
    leaf = param.name.rpartition(".")[2]
    return param.place.file.endswith(".py") and leaf not in context.text(param.place)


def _is_other_choice(name: str, declared: Collection[str]) -> bool:
    """Whether the node declares the same of another group (`devices.left.port` beside `devices.right.port`): another
    parameter chooses which group counts."""
    parts = name.split(".")
    alike = (other for other in (each.split(".") for each in declared) if len(other) == len(parts))
    return any(
        parts[-1] == other[-1] and sum(one != another for one, another in zip(parts, other, strict=True)) == 1
        for other in alike
    )


def _rename(context: Context, param: Param, name: str) -> tuple[Fix, ...]:
    """A fix where the name is written in one piece; of `a.b` in a file only the last key stands at the place."""
    location = param.name_location
    written = context.text(location) if location is not None else ""
    prefix = param.name.removesuffix(written)
    if location is None or not written or not param.name.endswith(written) or not name.startswith(prefix):
        return ()
    new = name[len(prefix) :]
    return replacement(context, location, new, f"Rename '{written}' to '{new}'")


RULE = Rule(
    id="PRM013",
    name="parameter-not-declared",
    effect="no-effect",
    kind="near",
    sometimes=(
        Reason.SHARED,
        Reason.PARTLY_READ,
        Reason.NOT_ANALYSED,
        Reason.FROM_SOURCE,
        Reason.LATER,
        Reason.NOT_GIVEN,
    ),
    of_param=True,
    what="Checks for a parameter, in the launch file or a parameter file, that its node does not declare. A value that "
    "several nodes share is not reported if one of them declares it.",
    why="The client libraries ignore the value without an error, and the node uses its default.",
    example='<!-- the node declares max_pressure -->\n<node pkg="pump" exec="pump" name="pump">\n'
    '  <param name="max_presure" value="4.5"/>\n</node>',
    instead='<param name="max_pressure" value="4.5"/>',
    references=(
        PARAMETERS,
        PARAMETERS_DESIGN,
    ),
    settings=("nodes",),
    generations=(2,),
    check=_check,
    needs_graph=True,
    in_branches=True,
    every_root=True,
)
