"""Keywords in a Python launch file that the class of `launch` or `launch_ros` does not take: known without a run."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.python_api import call_named, parameters
from preflight_analysis.launch.python_source import PythonSource, python_source
from preflight_analysis.model.nearest import nearest


@dataclass(frozen=True, slots=True)
class UnknownKeyword:
    """A keyword of a call, its place and that of the whole call, and which one was probably meant."""

    made: str
    name: str
    near: str | None
    span: Span
    call: Span


@derived
def unknown_keywords(launch_file: LaunchFile) -> tuple[UnknownKeyword, ...]:
    """The first one of each call that is made in any case, and of which all keywords are written out."""
    source = python_source(launch_file.document)
    return tuple(_unknown(source)) if source.module is not None else ()


def _unknown(source: PythonSource) -> Iterator[UnknownKeyword]:
    for node in source.nodes if source.module is not None else ():
        if not isinstance(node, ast.Call) or id(node) not in source.sure:
            continue
        made = call_named(source.full_name(node.func) or "")
        takes = parameters(made) if made is not None else None
        given = {keyword.arg for keyword in node.keywords}
        if made is None or takes is None or None in given:
            continue
        known = {each.name for each in takes}
        for keyword in node.keywords:
            name = keyword.arg or ""
            if name not in known:
                left = known - given
                near = nearest(name, left) or nearest(name, left, key=lambda each: each.removeprefix("node_"))
                yield UnknownKeyword(made.short_name, name, near, source.keyword_span(keyword), source.whole_span(node))
                break
