"""The gate: an edit is offered only if the texts that it leaves are read by the parsers of their formats.

A file that was well-formed stays so; one that was not gets no further mistake. What does not pass is a bug of whoever
made the edit: it is logged, and raises where `RAISES` is set, as the tests do.
"""

from __future__ import annotations

import ast
import logging
import os
import re
from collections.abc import Callable, Iterable, Iterator
from configparser import ConfigParser
from configparser import Error as ConfigParserError
from functools import lru_cache

import yaml

from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.span import LineIndex
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.documents.yaml import parse_yaml, span_of
from preflight_analysis.edits.edit import Edit, applied, by_file
from preflight_analysis.environment.build import SETTINGS
from preflight_analysis.environment.cmake_syntax import unbalanced
from preflight_analysis.launch.python_source import PythonSource

RAISES = "ROS_PREFLIGHT_RAISE_REFUSED_EDITS"
"""The variable under which a refused edit raises."""
_YAML_SUFFIXES = (".yaml", ".yml", ".rviz")
_CMAKE = re.compile(r"(?:.*/)?CMakeLists\.txt\Z|.*\.cmake\Z")
_MARKUP = re.compile("\ufeff?\\s*<")
_log = logging.getLogger(__name__)

TextOf = Callable[[str], str | None]
"""The text of a file by its path; None where it is not known."""


class EditRefusedError(Exception):
    """An edit that would leave a file that is not well-formed."""


def passes(title: str, edits: Iterable[Edit], text_of: TextOf) -> bool:
    """Whether an edit may be offered. One that may not is logged under its `title`."""
    why = refusal(edits, text_of)
    if why is None:
        return True
    message = f"not offered: {title}: {why}"
    if os.environ.get(RAISES):
        raise EditRefusedError(message)
    _log.error("%s", message)
    return False


def refusal(edits: Iterable[Edit], text_of: TextOf) -> str | None:
    """Why the edits are not to be offered; None where nothing is against them."""
    for file, each in by_file(edits).items():
        before = text_of(file)
        if before is None:
            return f"the text of {file} is not known"
        try:
            after = applied(before, each)
        except ValueError:
            return f"its edits of {file} overlap"
        known, found = mistakes(file, before), mistakes(file, after)
        if known is None or found is None:
            return f"there is no parser for {file}"
        if len(found) > len(known) or (found and _first(found) < _moved(_first(known), each)):
            return f"it leaves {file} with: {found[0][1]}"
    return None


Mistake = tuple[int, str]
"""Offset and message."""


def mistakes(path: str, text: str) -> tuple[Mistake, ...] | None:
    """What the parser of the file's format has against a text, in order. None where no parser knows the format."""
    return _mistakes(_format(path, text), text)


def _format(path: str, text: str) -> str | None:
    if is_python(path, text):
        return "python"
    if path.endswith(_YAML_SUFFIXES):
        return "yaml"
    if _CMAKE.match(path):
        return "cmake"
    if os.path.basename(path) == SETTINGS:
        return "ini"
    # Launch files, manifests, robot descriptions and worlds have many suffixes; all of them are XML.
    return "xml" if _MARKUP.match(text) else "yaml" if path.endswith(".launch") else None


@lru_cache(maxsize=64)
def _mistakes(format_: str | None, text: str) -> tuple[Mistake, ...] | None:
    match format_:
        case "python":
            return _of_python(text)
        case "yaml":
            return _of_yaml(text)
        case "cmake":
            at = unbalanced(text)
            return ((at, "a bracket or a quote that is not closed"),) if at is not None else ()
        case "ini":
            return _of_ini(text)
        case "xml":
            return tuple((problem.span.start, problem.message) for problem in parse_xml("", text).problems)
    return None


def _of_python(text: str) -> tuple[Mistake, ...]:
    source = PythonSource(text, LineIndex(text))
    if source.problem is not None or source.module is None:
        message, span = source.problem or ("no program", None)
        return ((span.start if span is not None else 0, message),)
    calls = (node for node in source.nodes if isinstance(node, ast.Call))
    # What the compiler refuses and the parser takes.
    return tuple(sorted(each for call in calls for each in _given_twice(source, call)))


def _given_twice(source: PythonSource, call: ast.Call) -> Iterator[Mistake]:
    names: set[str] = set()
    for keyword in call.keywords:
        if keyword.arg in names:
            yield source.keyword_span(keyword).start, f"keyword argument '{keyword.arg}' is there twice"
        names.update((keyword.arg,) if keyword.arg is not None else ())


def _of_ini(text: str) -> tuple[Mistake, ...]:
    try:
        ConfigParser(interpolation=None).read_string(text)
    except ConfigParserError as error:
        line = getattr(error, "lineno", None) or 1
        return ((LineIndex(text).line_start(line - 1), error.message),)
    return ()


def _of_yaml(text: str) -> tuple[Mistake, ...]:
    parsed = parse_yaml("", text)
    found = [(problem.span.start, problem.message) for problem in parsed.document.problems]
    waiting = [parsed.node] if parsed.node is not None else []
    seen: set[int] = set()
    while waiting:
        node = waiting.pop()
        if id(node) in seen or not isinstance(node, yaml.CollectionNode):
            continue
        seen.add(id(node))
        keys: set[str] = set()
        for each in node.value:
            waiting += each if isinstance(each, tuple) else (each,)
            key = each[0] if isinstance(each, tuple) else None
            if isinstance(key, yaml.ScalarNode):
                if key.value in keys:
                    found.append((span_of(key).start, f"key '{key.value}' is there twice"))
                keys.add(key.value)
    return tuple(sorted(found))


def _first(found: tuple[Mistake, ...]) -> int:
    return found[0][0]


def _moved(offset: int, edits: Iterable[Edit]) -> int:
    """Where the first mistake of a text is after edits of it; where one of them replaces it, where that begins."""
    by = 0
    for edit in edits:
        start, end = edit.location.span
        if start > offset:
            break
        if end > offset:
            return start + by
        by += len(edit.text) - (end - start)
    return offset + by
