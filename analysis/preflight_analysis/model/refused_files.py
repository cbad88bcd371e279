"""Parameter files that rcl refuses as a whole, so that no node that is given one starts (ROS 2)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation.ros2.param_files import MARK, read_param_file
from preflight_analysis.evaluation.tree import LaunchNode, ParamSource
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.sections import given_files

Given = tuple[LaunchNode, ParamSource]
"""A node, and how it gets a file."""


class Refusal(NamedTuple):
    """Something for which rcl refuses a parameter file, and where it stands. `unmarked` is the parameter that is below
    no `ros__parameters`, "" for anything else; `given` are the nodes whose client library reads the file."""

    path: str
    what: str
    place: Location
    unmarked: str
    given: Sequence[Given]

    @property
    def reason(self) -> str:
        """What is so, in words."""
        return f"rcl refuses the whole file: {self.what}"


@derived
def refusals(context: Context) -> tuple[Refusal, ...]:
    """Those of a launch, of what is below no `ros__parameters` the first in each file."""
    return tuple(found for path, given in given_files(context).items() for found in _of_file(context, path, given))


def reads_by_rcl(node: LaunchNode) -> bool:
    """Whether the client library of a node reads its files. Those of a component launch_ros reads itself, and takes the
    sections that there are, or all of it."""
    return node.kind != "composable"


def not_marked(name: str) -> str:
    """What is wrong with a parameter that is below no `ros__parameters`."""
    return f"parameter '{name}' is not below '{MARK}'"


def _of_file(context: Context, path: str, given: Sequence[Given]) -> Iterator[Refusal]:
    document, readers = context.documents.get(path), [each for each in given if reads_by_rcl(each[0])]
    if not readers or not isinstance(document, Document):
        return
    file = read_param_file(document)
    for name, span in file.unmarked[:1]:
        yield Refusal(path, not_marked(name), context.location(path, span), name, readers)
    # Of a file that launch made of it PyYAML wrote the values.
    as_written = [each for each in readers if each[1].made_from is None]
    for what, span in file.refused:
        computed = "$(" in _text(document, span)  # what a substitution comes to may be fine
        refused = {node.name: (node, source) for node, source in as_written if not (computed and source.substituted)}
        if refused:
            yield Refusal(path, what, context.location(path, span), "", [*refused.values()])


def _text(document: Document, span: Span) -> str:
    return document.text[span.start : span.end]
