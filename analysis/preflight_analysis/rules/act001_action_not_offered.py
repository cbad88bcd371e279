"""ACT001: a node is a client of an action that nobody offers."""

from collections.abc import Iterator

from preflight_analysis.findings.claim import say
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.graph.actions import moves_actions
from preflight_analysis.model.context import Context
from preflight_analysis.model.near_miss import OF_NEAR_MISSES, NearMiss, doubts_of
from preflight_analysis.model.places import Verbs
from preflight_analysis.model.reach import seen, unmet
from preflight_analysis.rules.further_reading import ACTIONLIB, ACTIONS
from preflight_analysis.rules.near_miss_fixes import fixes_in
from preflight_analysis.rules.rule import Rule
from preflight_analysis.rules.unmatched import lone_finding, near_miss_finding, with_type

_VERBS = Verbs("serves", "is a client of")
_NEAR = "action '{name}' has no server (client: {node}); did you mean '{near}', served by {other} ({why}{aside})?"
_LONE = "action {name} has no server in this launch (client: {node}){aside}"
_OF_GOALS = ("/goal", "/send_goal")
"""How the first part of an action is called, in ROS 1 and 2."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None:
        return
    found, known = unmet(context, "actions"), seen(context, graph)
    for pair in found.near:
        client, server = pair.consumer, pair.provider
        nodes = {"node": client.node.name, "other": server.node.name}
        said = say(_NEAR, name=client.name, near=server.name, **nodes, why=pair.why, aside=known.aside)
        why = doubts_of(pair, known.lacks, known.likely_complete)
        yield near_miss_finding(rule, pair, said, _VERBS, _fixes(context, pair), why)
    for each in found.consumers if not known.blind else ():
        said = say(_LONE, name=with_type(each), node=each.node.name, aside=known.aside)
        yield lone_finding(rule, each, said, lacks=known.lacks)


def _fixes(context: Context, pair: NearMiss) -> tuple[Fix, ...]:
    """None where the parts were remapped one by one, as each of those remaps would have to change, where no remap moves
    an action, nor where like words alone speak for it: another controller moves the robot as well, in another way."""
    if not moves_actions(context.environment.distro) or pair.likeness == "words":
        return ()
    remap = pair.site.remap
    one_by_one = remap is not None and remap.target.endswith(_OF_GOALS) and not pair.site.name.endswith(_OF_GOALS)
    return () if one_by_one else fixes_in(context, pair)


RULE = Rule(
    id="ACT001",
    name="action-not-offered",
    effect="breaks",
    kind="absent",
    always=(Reason.UNSEEN,),
    sometimes=(Reason.OTHER_LAUNCH, *OF_NEAR_MISSES),
    what="Checks for an action client whose action has no server in the launch. A remap of the action's name moves "
    "its parts in ROS 1, and in ROS 2 since Kilted.",
    why="A client that waits for the server waits forever. The goals of a client that does not wait are lost "
    "without an error.",
    example='<!-- the base offers move_base -->\n<remap from="navigate" to="mov_base"/>',
    instead='<remap from="navigate" to="move_base"/>',
    references=(
        ACTIONLIB,
        ACTIONS,
    ),
    settings=("nodes",),
    check=_check,
    needs_graph=True,
    every_root=True,
)
