"""Why a launch starts a node, or does not."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from itertools import islice

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation.inversion import Assignment, arguments_and_variables, assignments
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, NotTaken
from preflight_analysis.queries.enclosing import conditions_of
from preflight_analysis.queries.why import Link, NoSuchNodeError, first_broken, node_named
from preflight_analysis.workspace.workspace import Analysis

MAX_EVALUATIONS = 24
"""Of one launch, with other arguments."""
_EACH = 3
"""Of these, how many for one tag."""
Evaluate = Callable[[Assignment], LaunchTree]
"""The launch with these arguments."""


@dataclass(frozen=True, slots=True)
class Start:
    """Whether a node is started. `links` say why, the first broken one why not; `wanted` are the arguments that start
    it, beyond those that are given."""

    node: str
    links: tuple[Link, ...]
    wanted: Mapping[str, str]

    @property
    def broken(self) -> Link | None:
        """The first link that breaks."""
        return first_broken(self.links)

    @property
    def verdict(self) -> str:
        """Whether it is started, in a line."""
        return f"{self.node} is {'not started' if self.broken else 'started'}"


def why_started(analysis: Analysis, name: str, evaluate: Evaluate) -> Start:
    """What starts the node, or which condition leaves it out. Raises `NoSuchNodeError` where no arguments that the
    conditions ask for start a node of that name."""
    nodes = analysis.graph.tree.nodes if analysis.graph is not None else analysis.tree.nodes
    try:
        node = node_named(nodes, name)
    except NoSuchNodeError as error:
        found = next(_left_out(analysis, name, evaluate), None)
        if found is None:
            raise error from None
        node, left_out, wanted = found
        return Start(node.name, (_condition(left_out, wanted),), wanted)
    return Start(node.name, (*_started(analysis, node), *_problems(analysis, node)), {})


def _left_out(
    analysis: Analysis, name: str, evaluate: Evaluate
) -> Iterator[tuple[LaunchNode, NotTaken, Mapping[str, str]]]:
    given = dict(analysis.args)
    tried = 0
    for left_out in analysis.tree.not_taken:
        for wanted in islice(assignments(analysis.tree, analysis.launch_files, left_out, given), _EACH):
            if tried >= MAX_EVALUATIONS:
                return
            if any(arguments_and_variables(wanted)[1]):
                continue  # variables of the environment are not the launch file's to give
            tried += 1
            try:
                node = node_named(evaluate(wanted).nodes, name)
            except NoSuchNodeError:
                continue
            yield node, left_out, {key: text for key, text in wanted.items() if given.get(key) != text}
            break


def _condition(left_out: NotTaken, wanted: Mapping[str, str]) -> Link:
    written = " ".join(left_out.written.text.split())
    value = "not known" if left_out.value is None else f"'{left_out.value}'"
    arguments = " ".join(f"{name}:={text}" for name, text in wanted.items())
    text = f'not started: {left_out.condition}="{written}" is {value}; it is started with {arguments}'
    return Link("condition", "broken", text, left_out.place)


def _started(analysis: Analysis, node: LaunchNode) -> Iterator[Link]:
    for step in node.origin[:-1]:
        yield Link("include", "ok", "includes the file below", step)
    for condition in conditions_of(analysis.context, node):
        yield Link("condition", "ok", f"under the condition {condition.text}", condition.place)
    when = " after a timer or an event" if node.deferred else ""
    within = f" within {node.within}" if node.within is not None else ""
    yield Link("started", "ok", f"{node.name} is started here{within}{when}", node.location)


def _problems(analysis: Analysis, node: LaunchNode) -> Iterator[Link]:
    """The findings at its tag that are errors."""
    place = node.location
    span = node.action.span
    for finding in analysis.offered:
        inside = finding.location.file == place.file and span.start <= finding.location.span.start < span.end
        if inside and finding.severity == "error":
            yield Link("finding", "broken", f"{finding.rule}: {finding.message}", finding.location, finding.fixes)
