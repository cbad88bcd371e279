"""TRC003: a node did not reach its event loop in time."""

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import RUNS
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if context.graph is None:
        return
    for node, interface in zip(context.tree.nodes, context.graph.processes, strict=True):
        if interface.outcome.status == "timed-out":
            because = f": {interface.outcome.reason}" if interface.outcome.reason else ""
            yield rule.claim(
                say("{node} does not reach its event loop in time{quoted}", node=node.name, quoted=because),
                node.location,
                subject=Subject("node", node.name),
                related=include_chain(node.origin),
            )


RULE = Rule(
    id="TRC003",
    name="node-timed-out",
    effect="note",
    kind="invalid",
    always=(Reason.UNSEEN,),
    what="Checks for a node that is still starting when its time is up.",
    why="Only what it did until then is known: it may have more topics, services and parameters. A node that waits "
    "for another one gets a mock reply: a service, a message, an action server, a transform, a parameter or "
    "simulated time. This node waits for something that no answer in the sandbox satisfies. The finding names it if "
    "the node was seen to request it.",
    example="while not ready():  # for hardware, say\n    time.sleep(1)\npub = rospy.Publisher('state', String)",
    instead="pub = rospy.Publisher('state', String)\nwhile not ready():\n    time.sleep(1)",
    references=(RUNS,),
    settings=("nodes",),
    check=_check,
    needs_graph=True,
)
