"""PRM015: nodes on simulated time without a clock, or beside nodes that are not (ROS 2)."""

from collections.abc import Iterator, Sequence

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.ros2.bridges import is_bridge
from preflight_analysis.evaluation.ros2.spawners import SPAWN, is_spawner
from preflight_analysis.evaluation.tree import LaunchNode, Param, Use
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.arguments import gives
from preflight_analysis.model.clock import has_clock, publishes_clock, stopped_clock
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import CLOCK_AND_TIME, PARAMETERS
from preflight_analysis.rules.rule import Rule

_SHOWN = 3
_APART = "'use_sim_time' is true for {node}, which has {variable} {other}; '/clock' is published with {one}"
_DIFFER = "'use_sim_time' is not true for {node}{others}, but for {count} of this launch; their times differ"
_STOPPED = "'use_sim_time' is true for {node}{others}, but {lacking}; time does not advance"
_MOST_STEPS = 10
_TIMELESS = ("static_transform_publisher",)
"""What it sends holds at any time."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None:
        return
    nodes = [node for node in graph.tree.nodes if node.kind not in ("process", "simulated")]
    on = [(node, param) for node in nodes if (param := _sim_time(node)) is not None and param.value is True]
    if not on:
        return
    is_running, stopped = has_clock(graph), stopped_clock(context)
    if stopped is not None:
        yield rule.claim(
            say(_STOPPED, node=on[0][0].name, others=_and_others(on), lacking=stopped.lacking),
            stopped.at.location,
            subject=Subject("topic", "/clock"),
            kind="absent",
            related=(
                *(
                    (Related("Gazebo starts here", stopped.simulator.location),)
                    if stopped.at is not stopped.simulator
                    else ()
                ),
                Related(f"true for {on[0][0].name}", on[0][1].place),
                *include_chain(stopped.at.origin),
            ),
        )
    elif not is_running:
        node, param = on[0]
        given = _given(context, param.place)
        related = include_chain(node.origin)
        if given != param.place:
            related = (Related(f"set for {node.name} here", param.place), *related)
        yield rule.claim(
            "'use_sim_time' is true, but '/clock' has no publisher in this launch; time does not advance without a "
            "simulator or `ros2 bag play --clock`",
            given,
            subject=Subject("topic", "/clock"),
            kind="absent",
            doubts=doubts(OUTSIDE=True),
            related=related,
        )
    clock = graph.topics.get("/clock")
    published = clock.providers if clock is not None else ()
    for node, param in on if published else ():
        difference = graph.domains.apart(published[0].node, node)
        if difference is not None and not graph.providers_for(node, "topics", "/clock"):
            yield rule.claim(
                say(
                    _APART,
                    node=node.name,
                    variable=difference.variable,
                    other=difference.other,
                    one=difference.one,
                ),
                node.location,
                subject=Subject("topic", "/clock"),
                kind="unreachable",
                doubts=doubts(OUTSIDE=True),
                related=(Related(f"true for {node.name}", param.place), *include_chain(node.origin)),
            )
            break
    simulated = {id(node) for node, _ in on}
    off = [
        node for node in nodes if id(node) not in simulated and _has_times(node) and not publishes_clock(graph, node)
    ]
    if is_running and off and len(off) <= len(on):
        others = "".join(f", {node.name}" for node in off[1:_SHOWN]) + (" and others" if len(off) > _SHOWN else "")
        yield rule.claim(
            say(_DIFFER, node=off[0].name, others=others, count=_counted(len(on))),
            off[0].location,
            subject=Subject("parameter", "use_sim_time"),
            doubts=doubts(ASSUMED=True),
            related=(Related(f"true for {on[0][0].name}", on[0][1].place), *include_chain(off[0].origin)),
        )


def _and_others(on: Sequence[tuple[LaunchNode, Param]]) -> str:
    return f" and {len(on) - 1} more" if len(on) > 1 else ""


def _given(context: Context, place: Location) -> Location:
    """Where the value is written of the parameter whose name is at a place: from one argument to the next, back to a
    default or to what an include passes."""
    for _ in range(_MOST_STEPS):
        use = next((use for use in context.tree.uses if _gives(context, use, place)), None)
        if use is None or use.origin[-1] == place:
            break
        place = use.origin[-1]
    return place


def _gives(context: Context, use: Use, place: Location) -> bool:
    """Whether a use of an argument is the true value at the place, or of the name that is there."""
    return use.value is not None and use.value.lower() == "true" and gives(context, use, place)


def _sim_time(node: LaunchNode) -> Param | None:
    return next((param for param in node.params if param.name == "use_sim_time"), None)


def _has_times(node: LaunchNode) -> bool:
    """Whether it matters which clock the node is on, as far as is known: a container does nothing by itself, and what
    is unknown of a node may be its parameters."""
    if node.unknowns or node.kind == "container":
        return False
    # What puts a robot or a controller in its place ends then, and a bridge passes on the times of others.
    helps = is_spawner(node) or is_bridge(node) or (node.package, node.executable) in SPAWN
    return not helps and node.executable not in _TIMELESS


def _counted(number: int) -> str:
    return "1 node" if number == 1 else f"{number} nodes"


RULE = Rule(
    id="PRM015",
    name="simulated-time",
    effect="misbehaves",
    kind="conflict",
    sometimes=(Reason.OUTSIDE, Reason.ASSUMED),
    what="Checks for `use_sim_time` set to true in a launch where no node publishes `/clock`, or which starts Gazebo "
    "without the plugin or the bridge for it. If a node publishes `/clock`, it checks for nodes without `use_sim_time` "
    "among a majority with it, and for nodes with it in another domain.",
    why="Timers of a node on simulated time wait for the first message on `/clock`. Transforms and messages of "
    "nodes on different clocks look too old or too new to each other.",
    example='<set_parameter name="use_sim_time" value="true"/>',
    instead='<set_parameter name="use_sim_time" value="$(var simulation)"/>',
    references=(
        CLOCK_AND_TIME,
        PARAMETERS,
    ),
    settings=("external",),
    generations=(2,),
    check=_check,
    needs_graph=True,
    every_root=True,
)
