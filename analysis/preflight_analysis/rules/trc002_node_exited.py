"""TRC002: a node ended without error before it reached its event loop."""

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import RUNS
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if context.graph is None:
        return
    for node, interface in zip(context.tree.nodes, context.graph.processes, strict=True):
        outcome = interface.outcome
        if outcome.status == "exited" and outcome.exit_code in (None, 0):
            because = f": {outcome.reason}" if outcome.reason else ""
            yield rule.claim(
                say("{node} exits before its event loop, without an error{quoted}", node=node.name, quoted=because),
                node.location,
                subject=Subject("node", node.name),
                doubts=doubts(SANDBOX=node.name if outcome.answers else ""),
                related=include_chain(node.origin),
            )


RULE = Rule(
    id="TRC002",
    name="node-exited",
    effect="note",
    kind="invalid",
    always=(Reason.UNSEEN,),
    sometimes=(Reason.SANDBOX,),
    what="Checks for a node that exits with code 0 before its event loop.",
    why="Some nodes do their work and exit. If the node should keep running, it lacks its loop or has given up. "
    "What it does later is unknown.",
    example="def main():\n    rospy.init_node('listener')\n    rospy.Subscriber('chatter', String, callback)",
    instead="def main():\n    rospy.init_node('listener')\n    rospy.Subscriber('chatter', String, callback)\n"
    "    rospy.spin()",
    references=(RUNS,),
    settings=("nodes",),
    check=_check,
    needs_graph=True,
)
