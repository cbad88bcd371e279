"""TRC005: what else was noticed when a node was run."""

from collections.abc import Iterator
from itertools import compress

from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.further_reading import RUNS, SECURITY
from preflight_analysis.rules.installed import lack_of_module
from preflight_analysis.rules.problems import include_chain
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.tracing.interface import Interface

_WHAT = {"module": "module", "package": "package", "build": "the built package"}


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if context.graph is None:
        return
    processes = context.graph.processes
    noted = context.kept.each(_is_noted, processes)
    for node, interface in compress(zip(context.tree.nodes, processes, strict=True), noted):
        for note in interface.notes:
            yield rule.finding(f"{node.name}: {note}", node.location, related=include_chain(node.origin))
        for lack in dict.fromkeys(filter(None, (lack_of_module(context, each) for each in interface.stand_ins))):
            message = (
                f"{node.name} needs {_WHAT[lack.kind]} '{lack.name}', which is not installed; a stand-in replaces it"
            )
            yield rule.finding(message, node.location, related=include_chain(node.origin), lack=lack)


def _is_noted(interface: Interface) -> bool:
    return bool(interface.notes or interface.stand_ins)


RULE = Rule(
    id="TRC005",
    name="run-notes",
    severity="info",
    what="Checks for events in the run of a node in the sandbox: a refused write, no exit on request, too much "
    "output, a mock reply, or a name that is random in each run. An import that is missing on this machine, and "
    "replaced by a stand-in, is a hint.",
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
