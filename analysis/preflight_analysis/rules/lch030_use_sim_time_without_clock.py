"""LCH030: the launch runs on simulated time, and nobody tells the time."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.clock import has_clock
from preflight_analysis.model.context import Context
from preflight_analysis.model.entry import Kind
from preflight_analysis.model.name_index import in_workspace
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import CLOCK
from preflight_analysis.rules.rule import Rule

_SIMULATORS = ("gazebo_ros", "gzserver", "stage_ros", "stageros", "morse", "webots_ros")
_SIMULATOR_FAMILIES = ("vrep_", "carla_")
_NAMED: tuple[Kind, ...] = ("package", "program")
_FLAG = "--clock"
"""Of `rosbag play`."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    param = context.tree.params.get("/use_sim_time")
    if graph is None or param is None or not graph.likely_complete or not graph.tree.nodes:
        return
    if param.value is not True and param.value != 1:
        return
    if has_clock(graph):
        return
    # Beside it another launch of the project runs the simulator, or plays a recording.
    beside = _tells_time(context)
    yield rule.claim(
        "'/use_sim_time' is true, but '/clock' has no publisher in this launch; time does not advance without a "
        "simulator or `rosbag play --clock`",
        param.place,
        subject=Subject("topic", "/clock"),
        doubts=doubts(OUTSIDE=beside, NOT_ANALYSED=not graph.complete),
        related=include_chain(param.origin),
    )


def _tells_time(context: Context) -> bool:
    """Whether a launch file of the workspace names a simulator, or plays a recording with its time."""
    named = (each.text for kind in _NAMED for each in in_workspace(context, kind))
    return any(name in _SIMULATORS or name.startswith(_SIMULATOR_FAMILIES) for name in named) or any(
        each.text == _FLAG for each in in_workspace(context, "flag")
    )


RULE = Rule(
    id="LCH030",
    name="use-sim-time-without-clock",
    effect="misbehaves",
    kind="absent",
    always=(Reason.UNSEEN,),
    sometimes=(Reason.OUTSIDE, Reason.NOT_ANALYSED),
    what="Checks for `/use_sim_time` set to true in a launch where all nodes are known and none publishes `/clock`. "
    "Simulators, `rosbag play --clock` and `/clock` among `external.topics` count as publishers.",
    why="Timers, rates and timeouts wait for the first message on `/clock`. The nodes start and do nothing, without "
    "an error.",
    example='<param name="/use_sim_time" value="true"/>\n<node pkg="amcl" type="amcl" name="amcl"/>',
    instead='<arg name="simulated" default="false"/>\n<param name="/use_sim_time" value="$(arg simulated)"/>\n'
    '<node pkg="amcl" type="amcl" name="amcl"/>',
    references=(CLOCK,),
    settings=("external",),
    generations=(1,),
    check=_check,
    needs_graph=True,
    every_root=True,
)
