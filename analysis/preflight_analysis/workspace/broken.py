"""What syntax errors touch: a node in whose tag one stands is not worth a run, and all others are what they were."""

from __future__ import annotations

from preflight_analysis.documents.span import Location, Origin
from preflight_analysis.launch.model import NODE_KINDS
from preflight_analysis.workspace.workspace import Analysis

_STARTS_NODES = NODE_KINDS | {"include", "executable", "param"}


class Broken:
    """The syntax errors of the files of a launch. `files` are those that have any."""

    def __init__(self, analysis: Analysis) -> None:
        self.files = tuple(path for path, document in analysis.documents.items() if document.problems)
        self._heads: set[Location] = set()
        """The tags that a syntax error stands in."""
        for path in self.files:
            launch_file = analysis.launch_files.get(path)
            spans = [problem.span for problem in analysis.documents[path].problems]
            for action in launch_file.root.walk() if launch_file is not None and launch_file.root is not None else ():
                within = (span.start <= action.span.end and action.span.start <= span.end for span in spans)
                if action.kind in _STARTS_NODES and any(within):
                    self._heads.add(analysis.documents[path].location(action.head_span))

    def touches(self, origin: Origin) -> bool:
        """Whether a syntax error stands in one of the tags that lead to a place, or in the place's own."""
        return any(step in self._heads or self._stands_in(step) for step in origin)

    def _stands_in(self, step: Location) -> bool:
        """A command's place is that of its text."""
        return any(
            head.file == step.file and head.span.start <= step.span.start < head.span.end for head in self._heads
        )
