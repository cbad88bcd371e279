"""What stands above the `<launch>` tag: who includes the file, how many nodes there are, and in whose context."""

from __future__ import annotations

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.launch.read import LAUNCH_FUNCTION
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


def lenses(context: QueryContext) -> Lenses | None:
    """What to show; None in a file without a `<launch>` tag."""
    launch_file = context.launch_file(context.path)
    if launch_file is None or launch_file.root is None:
        return None
    analysis = context.analyses[0]
    places = dict.fromkeys(inclusion.place for inclusion in context.current.includers(context.path))
    nodes = analysis.tree.nodes
    own = sum(any(step.file == context.path for step in node.origin) for node in nodes)
    head = launch_file.root.head_span
    if launch_file.partial and (found := LAUNCH_FUNCTION.search(launch_file.document.text)) is not None:
        head = Span(*found.span(1))
    return Lenses(head, tuple(places), own, len(nodes), analysis.launch)
