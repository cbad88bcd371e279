"""TRC005: what else was noticed when a node was run."""

from collections.abc import Iterator
from itertools import compress

from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.installed import lack_of_module
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import RUNS, SECURITY
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.interface import Interface

_NEEDS = "{node} needs {what} '{name}', which is not installed; a stand-in replaces it"
_WHAT = {"module": "module", "package": "package", "build": "the built package"}


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if context.graph is None:
        return
    processes = context.graph.processes
    noted = context.each(_is_noted, processes)
    for node, interface in compress(zip(context.tree.nodes, processes, strict=True), noted):
        for note in interface.notes:
            yield rule.claim(
                say("{node}: {quoted}", node=node.name, quoted=note),
                node.location,
                subject=Subject("node", node.name),
                related=include_chain(node.origin),
            )
        for lack in dict.fromkeys(filter(None, (lack_of_module(context, each) for each in interface.stand_ins))):
            yield rule.claim(
                say(_NEEDS, node=node.name, what=_WHAT[lack.kind], name=lack.name),
                node.location,
                subject=Subject("module", lack.name),
                kind="absent",
                related=include_chain(node.origin),
                lack=lack,
            )


def _is_noted(interface: Interface) -> bool:
    return bool(interface.notes or interface.stand_ins)


RULE = Rule(
    id="TRC005",
    name="run-notes",
    effect="note",
    kind="invalid",
    sometimes=(Reason.NOT_HERE,),
    what="Checks for events in the run of a node in the sandbox, such as a refused write, no exit on request, or a "
    "mock reply. An import that this machine lacks is replaced by a stand-in.",
    why="The sandbox stopped these effects; on the robot they happen. After a refusal or a mock reply the "
    "node may behave differently than on the robot.",
    example="open('/home/me/.calibration', 'w')",
    instead="open(os.path.join(rospkg.get_ros_home(), 'calibration'), 'w')",
    references=(
        RUNS,
        SECURITY,
    ),
    settings=("nodes",),
    check=_check,
    needs_graph=True,
)
