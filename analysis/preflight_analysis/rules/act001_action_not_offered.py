"""ACT001: a node is a client of an action that nobody offers."""

from collections.abc import Iterator

from preflight_analysis.findings.claim import say
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.graph.actions import moves_actions
from preflight_analysis.model.channels import not_all_known
from preflight_analysis.model.context import Context
from preflight_analysis.model.dangling import dangling_consumers
from preflight_analysis.model.moveit import known_to_moveit, unserved
from preflight_analysis.model.near_miss import OF_NEAR_MISSES, NearMiss, doubts_of, not_analysed
from preflight_analysis.model.near_miss_search import near_misses
from preflight_analysis.model.places import Verbs, subject_of
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
    # MVT001 reports them, by more than the name; others have a controller that the launch loads.
    wrong = [each.known for each in unserved(context)]
    served = [each for each in known_to_moveit(context) if each.loaded is not None]
    of_moveit = {(id(each.node), each.action) for each in (*wrong, *served)}
    pairs, unknown, lacks = near_misses(context, "actions"), not_analysed(graph), not_all_known(graph)
    near = [each for each in pairs if (id(each.consumer.node), each.consumer.name) not in of_moveit]
    for pair in near:
        client, server = pair.consumer, pair.provider
        nodes = {"node": client.node.name, "other": server.node.name}
        said = say(_NEAR, name=client.name, near=server.name, **nodes, why=pair.why, aside=unknown)
        why = doubts_of(pair, lacks, graph.likely_complete)
        yield near_miss_finding(rule, pair, said, subject_of(client), _VERBS, _fixes(context, pair), why)
    explained = {id(pair.consumer) for pair in near}
    for connection in dangling_consumers(context, "actions"):
        if (id(connection.node), connection.name) in of_moveit:
            continue
        if id(connection) not in explained and not graph.blind:
            said = say(_LONE, name=with_type(connection), node=connection.node.name, aside=unknown)
            yield lone_finding(rule, connection, said, lacks=lacks)


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
