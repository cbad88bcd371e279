"""What stands above the `<launch>` tag: who includes the file, how many nodes there are, and in whose context. Above a
file that launches hand over it is the last of these alone."""

from __future__ import annotations

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.python_text import LAUNCH_FUNCTION
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation.problems import PythonException, PythonImportFailed
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.queries.handed_over import is_handed_over
from preflight_analysis.queries.param_files import is_param_file
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.workspace.index import Root


@dataclass(frozen=True, slots=True)
class Lenses:
    """Of the launch file whose `<launch>` tag, or function in Python, is `head`. `own` of the `nodes` that the shown
    root starts come from the file and from what it includes."""

    head: Span
    includers: tuple[Location, ...]
    own: int
    nodes: int
    root: Root
    reason: str = ""
    """Why the file itself is not evaluated; empty where it is."""
    is_launched: bool = True
    """Whether it is a launch file."""


def lenses(context: QueryContext) -> Lenses | None:
    """What to show; None in an empty file."""
    analysis = context.analyses[0]
    if is_handed_over(context.analyses, context.path) or is_param_file(analysis, context.path):
        return Lenses(Span(0, 0), (), 0, 0, analysis.launch, is_launched=False)
    launch_file = context.launch_file(context.path)
    if launch_file is None or (launch_file.root is None and not launch_file.document.text.strip()):
        return None
    places = dict.fromkeys(inclusion.place for inclusion in context.current.includers(context.path))
    nodes = analysis.tree.nodes
    own = sum(any(step.file == context.path for step in node.origin) for node in nodes)
    if launch_file.root is None:
        return Lenses(Span(0, 0), tuple(places), own, len(nodes), analysis.launch, "it has no root element 'launch'")
    head = launch_file.root.head_span
    if launch_file.partial and (found := LAUNCH_FUNCTION.search(launch_file.document.text)) is not None:
        head = Span(*found.span(1))
    return Lenses(head, tuple(places), own, len(nodes), analysis.launch, _why_not(context, launch_file))


def _why_not(context: QueryContext, launch_file: LaunchFile) -> str:
    """Why a Python launch file has no run; of other formats nothing has to be run."""
    if not launch_file.is_python:
        return ""
    tree = context.trees[0]
    included = {include.origin for include in tree.includes if include.path == context.path}
    for command in tree.commands:
        if not command.launch_file:
            continue
        is_root = len(command.origin) == 1 and command.location.file == context.path
        if is_root or command.origin in included:
            if command.result is None:
                return "it has not run in the sandbox yet"
            return command.result.reason if command.result.status != "done" else _raised(context)
    return _raised(context)  # it was read


def _raised(context: QueryContext) -> str:
    """The exception that ended the run of the file."""
    for problem in context.trees[0].problems:
        if problem.location.file == context.path:
            if isinstance(problem.kind, PythonException):
                return ": ".join(filter(None, (problem.kind.error, problem.kind.message)))
            if isinstance(problem.kind, PythonImportFailed) and not problem.kind.stood_in_for:
                return f"the module '{problem.kind.module}' cannot be imported"
    return ""
