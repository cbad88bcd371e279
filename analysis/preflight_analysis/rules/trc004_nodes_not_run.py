"""TRC004: nodes were not run, and why."""

from collections.abc import Iterator

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.rules.further_reading import ANNOTATIONS, RUNS, SECURITY
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.interface import Interface


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    count = len(context.tree.nodes)
    if context.why_not_run is not None:
        if count:
            nodes = f"{count} nodes are" if count > 1 else "1 node is"
            said = say("{nodes} not run: {quoted}", nodes=nodes, quoted=context.why_not_run)
            yield rule.claim(said, _root_location(context), subject=Subject("node"))
        return
    if context.graph is None:
        return
    skipped = filter(None, context.each_row(_skipped, (context.tree.nodes, context.graph.processes)))
    there = context.grouped(_where_and_why, rule.id, skipped)
    yield from context.each(_finding, there.values(), rule)


@dataclass(frozen=True, slots=True)
class _Skipped:
    node: LaunchNode
    reason: str


def _skipped(node: LaunchNode, interface: Interface) -> _Skipped | None:
    # That there is nothing to run is a finding about the package or executable.
    if interface.outcome.status != "not-run" or interface.declared or node.resolved.path is None:
        return None
    return _Skipped(node, interface.outcome.reason or "unknown reason")


def _where_and_why(skipped: _Skipped) -> tuple[str, str]:
    return skipped.node.location.file, skipped.reason


def _finding(there: tuple[_Skipped, ...], rule: Rule) -> Finding:
    node, *others = (each.node for each in there)
    more = "".join(f", {each.name}" for each in others)
    said = say("not run: {node}{more}; {quoted}", node=node.name, more=more, quoted=there[0].reason)
    return rule.claim(said, node.location, subject=Subject("node", node.name))


def _root_location(context: Context) -> Location:
    launch_file = context.launch_files.get(context.root)
    if launch_file is not None and launch_file.root is not None:
        return context.location(context.root, launch_file.root.head_span)
    return Location.of_file(context.root)


RULE = Rule(
    id="TRC004",
    name="nodes-not-run",
    effect="note",
    kind="invalid",
    what="Checks for nodes that were not run, and gives the reason: the workspace is not trusted, no sandbox works "
    "on this machine, or a value is unresolved.",
    why="Their topics, services and parameters come from annotations or settings. Without those they come from a "
    "run of the same executable with other settings, or from its source. Findings about connections are missing or "
    "less certain.",
    example="ros-preflight: 2 nodes are not run: the workspace is not trusted",
    instead="Trust the workspace in the editor, install `bubblewrap`, or annotate the nodes.",
    references=(
        RUNS,
        SECURITY,
        ANNOTATIONS,
    ),
    settings=("nodes",),
    generations=(1,),
    check=_check,
)
