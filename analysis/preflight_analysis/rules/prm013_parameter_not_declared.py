"""PRM013: a parameter that its node does not declare (ROS 2)."""

import re
from collections.abc import Collection, Iterable, Iterator

from preflight_analysis.documents.span import Location
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.evaluation.ros2.spawners import MANAGER
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Alike, Finding, Fix
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, is_slip, nearest, without_numbers
from preflight_analysis.model.param_matching import reports_params
from preflight_analysis.model.parameters import OF_ALL_NODES
from preflight_analysis.model.params_in_sources import may_be_made
from preflight_analysis.model.places import related_node
from preflight_analysis.model.problems import include_chain, replacement
from preflight_analysis.model.sections import is_for_all, section_at
from preflight_analysis.rules.further_reading import PARAMETERS, PARAMETERS_DESIGN
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.interface import Interface, ParamUse

_PREFIXES = ("qos_overrides.",)
_CLOCK = "use_sim_time"
_OF_TRANSPORT = re.compile(
    r"\.(?:(?:en|dis)able_pub_plugins|(?:compressed|compressedDepth|theora|zstd|ffmpeg|draco|zlib|cloudini)\.\w+)\Z"
)
"""What image_transport and point_cloud_transport declare for each topic that they publish."""
_SAID = "parameter '{name}' is not declared by {node}; its value is ignored{near}"
_MANY = "parameters are not declared by {node}; their values are ignored"
_NO_CLOCK = "parameter '{name}' of {node} has no effect; did you mean '{near}'?"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None:
        return
    nodes = [(n, _declared(n, i), i) for n, i in zip(graph.tree.nodes, graph.interfaces, strict=True) if n.params]
    own = context.environment.own_packages
    takers: dict[Location | None, set[int]] = {}
    for node, declared, _ in nodes:
        for param in node.params:
            if declared is None or _is_controller(node) or param.name in declared:
                takers.setdefault(param.name_location, set()).add(id(node))
    for node, declared, interface in nodes:
        for param in node.params:
            if is_slip(param.name, _CLOCK) and param.name != _CLOCK and param.name not in (declared or ()):
                yield _clock(rule, context, node, param)
        if declared is None:
            continue
        given = {(param.name, param.place.file) for param in node.params}
        for param in node.params:
            if param.name in declared or param.name in OF_ALL_NODES or param.name.startswith(_PREFIXES):
                continue
            if is_slip(param.name, _CLOCK):
                continue
            if param.name_location is not None and takers.get(param.name_location, set()) - {id(node)}:
                continue  # what is written once for several nodes, one of which wants it
            if _OF_TRANSPORT.search(param.name):
                continue
            package = context.environment.packages.get(node.package)
            if package in own and may_be_made(context.disk.db, package.share, param.name):
                continue
            numbered = without_numbers(param.name)
            if not interface.tells_all("parameters") and numbered in set(map(without_numbers, declared)):
                continue  # one of a row, `odom1` beside `odom0`, of which the node may take as many as it is given
            near = _near(param.name, [name for name in declared if (name, param.place.file) not in given])
            if near is None and _is_controller(node):
                continue  # a library's base declares all that is set; names may be made of those of joints
            if near is None and interface.source == "trace" and interface.outcome.status in ("crashed", "timed-out"):
                continue  # it may have come to it later
            in_full = interface.tells_all("parameters")
            use = declared.get(near) if near is not None else None
            shared = near is None and (
                _is_for_all(context, node, param)
                or _is_other_choice(param.name, declared)
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


def _is_controller(node: LaunchNode) -> bool:
    """Whether a controller manager makes it, of ros2_control."""
    return node.within is not None and (node.package, node.executable) == MANAGER


def _of_node(node: LaunchNode, uses: Iterable[ParamUse]) -> Iterator[ParamUse]:
    """Without what the library's base of a controller does to all parameters."""
    return (use for use in uses if not (use.name == "/" and use.evidence.of_catalogue and _is_controller(node)))


def _declared(node: LaunchNode, interface: Interface) -> dict[str, ParamUse] | None:
    """The parameters that the node declares, None where it takes any or nothing of it is known."""
    uses = interface.params
    if (not uses and not reports_params(interface)) or any(use.access == "list" for use in _of_node(node, uses)):
        return None
    if interface.source == "none":
        return None
    return {use.name.removeprefix("~"): use for use in uses}


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


def _near(name: str, others: Collection[str]) -> str | None:
    """The parameter that was probably meant; what all of a section share says nothing."""
    near = nearest(name, others)
    if near is None:
        return None
    (above, _, leaf), (other_above, _, other) = name.rpartition("."), near.rpartition(".")
    return near if above != other_above or nearest(leaf, (other,)) is not None else None


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
    sometimes=(Reason.SHARED, Reason.PARTLY_READ, Reason.NOT_ANALYSED, Reason.FROM_SOURCE, Reason.LATER),
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
