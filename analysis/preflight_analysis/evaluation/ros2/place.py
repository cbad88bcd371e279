"""Where an action stands: the launch file that is evaluated, and how it was reached."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import field
from typing import Any

from preflight_analysis.catalogue.launches import SUFFIX
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.python_text import PYTHON_SUFFIX, is_python
from preflight_analysis.documents.span import LineIndex, Location, Origin, Span
from preflight_analysis.evaluation.tree import Tag
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.python_source import PythonSource
from preflight_analysis.launch.recognize import is_yaml

_CATALOGUED_PYTHON = PYTHON_SUFFIX + SUFFIX
"""Of what the catalogue has of a program."""
_SAID_ELSEWHERE = re.compile(r"\*[\w-]|!")
"""In YAML: an alias, or a tag, which a directive may define."""


@dataclass(frozen=True, slots=True, eq=False)
class PythonRun:
    """A run of a Python launch file: its text, the variables that differ from those of the launch, and which of its
    functions and substitutions were called, with what was configured then (`evaluation/ros2/python_runs.py`)."""

    file: str
    text: str
    variables: Mapping[str, str]
    calls: tuple[Mapping[str, Any], ...]
    source: PythonSource
    given: Mapping[str, str] = field(default_factory=dict)
    """The variables of the user's environment that the text names: the sandbox hands on no others."""
    packages: Mapping[str, str] = field(default_factory=dict)
    """The folders of packages that are others for the launch than for most."""
    read_partly: bool = False
    """Whether it is a reading that left something to the run: what its code gives is only read then, as the run may
    give other numbers to what it makes."""
    otherwise: tuple[str, ...] = ()
    """Of a reading: the conditions that are answered otherwise than at first, as they are not known."""
    replaced: bool = False
    """Whether the text is another one by now, and this the last run that went well: nothing is asked for it again."""


@dataclass(frozen=True, slots=True)
class Place:
    """The launch file that is evaluated, and the include tags that led to it, outermost first."""

    file: str
    lines: LineIndex
    """Those of the file."""
    chain: Origin
    run: PythonRun | None = None
    """Where the file is a Python program: the run that told its actions."""
    partial: bool = False
    """Whether it is one that was not run: only what is written out is known of it."""

    @property
    def is_python(self) -> bool:
        """Whether its actions were made by a program in Python."""
        return self.file.endswith(_CATALOGUED_PYTHON) or is_python(self.file, self.lines.text)

    def location(self, span: Span) -> Location:
        """A place in the file."""
        return self.lines.location(self.file, span)

    def origin(self, span: Span) -> Origin:
        """The origin of a place in the file."""
        return (*self.chain, self.location(span))

    def tag(self, action: Action) -> Tag:
        """The tag of a node."""
        written = self.written(action)
        source = self.lines.text[slice(*written)] if written is not None else None
        return Tag(action, self.location(action.head_span), source)

    def written(self, action: Action) -> Span | None:
        """The text that says all of an action. None where there is no such text: in Python there are variables, in
        YAML aliases and tags."""
        if self.is_python:
            return None
        if not is_yaml(self.file):
            return action.span
        start = min((action.span.start, *(comment.span.start for comment in action.comments)))
        is_all = _SAID_ELSEWHERE.search(self.lines.text, start, action.span.end) is None
        return Span(start, action.span.end) if is_all else None
