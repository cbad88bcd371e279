"""Calls of launch in a Python launch file that is being typed: their signature, and the keywords that they take.

The text need not be whole: what counts is the bracket that is open at the cursor, and what stands in it.
"""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterator
from typing import NamedTuple

from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.ros2.actions.registry import entities
from preflight_analysis.launch import python_api
from preflight_analysis.launch.python_api import Call, parameters
from preflight_analysis.launch.python_source import MAX_CHARACTERS, brackets, is_quoted
from preflight_analysis.launch.substitutions_ros2 import SUBSTITUTIONS_ROS2
from preflight_analysis.queries.completion_items import Completion, Item
from preflight_analysis.queries.signature_items import Parameter, Signature

_LONGEST_NAME = 200
_IMPORTS = re.compile(r"^[ \t]*(?:from[ \t]+([\w.]+)[ \t]+)?import[ \t]+(\([^)]{0,2000}\)|[^\n#(]*)", re.MULTILINE)
_NAME_BEFORE = re.compile(r"([A-Za-z_][\w.]*)\s*\Z")
_NAME = re.compile(r"[A-Za-z_]\w*")
_WORD_BEFORE = re.compile(r"[A-Za-z_]\w*\Z|\Z")
_KEYWORD = re.compile(r"(?:\s|#[^\n]*\n)*([A-Za-z_]\w*)\s*=(?!=)")
_EQUALS = re.compile(r"\s*=(?!=)")
_BEGINS = re.compile(r"(?:\s|#[^\n]*\n)*([A-Za-z_]\w*)?\Z")


class _CallAt(NamedTuple):
    """A call around the cursor. `pieces` are its arguments as far as they are written."""

    call: Call
    pieces: tuple[Span, ...]
    inner: bool
    """Whether the cursor is in brackets of an argument."""


def signature_of_call(text: str, offset: int) -> Signature | None:
    """The signature of the innermost call of launch around a cursor."""
    found = _call_at(text, offset)
    if found is None:
        return None
    takes = parameters(found.call) or ()
    label, shown, star = f"{found.call.short_name}(", list[Parameter](), False
    for each in takes:
        label += ", " if shown else ""
        if not each.positional and not star:
            label, star = f"{label}*, ", True
        start = len(label)
        label += each.name if each.default is None else f"{each.name}={each.default}"
        shown.append(Parameter(each.name, _of_parameter(found.call, each.name), start, len(label)))
    at = next((n for n, piece in enumerate(found.pieces) if piece.start <= offset <= piece.end), 0)
    written = _KEYWORD.match(text, found.pieces[at].start, found.pieces[at].end)
    name = written[1] if written else takes[at].name if at < len(takes) and takes[at].positional else None
    active = next((n for n, each in enumerate(takes) if each.name == name), None)
    return Signature(f"{label})", _of_call(found.call), tuple(shown), active)


def complete_keywords(text: str, offset: int) -> Completion | None:
    """The keywords that may be written at a cursor, those first that have to be; None where there are none."""
    found = _call_at(text, offset)
    if found is None or found.inner:
        return None
    at = next((piece for piece in found.pieces if piece.start <= offset <= piece.end), None)
    if at is None or not _BEGINS.match(text, at.start, offset):
        return None
    before = _WORD_BEFORE.search(text, at.start, offset)
    start = before.start() if before else offset
    word = _NAME.match(text, start)
    span = Span(start, max(offset, word.end() if word else start))
    is_named = _EQUALS.match(text, span.end) is not None
    others = (piece for piece in found.pieces if piece is not at)
    given = {named[1] for piece in others if (named := _KEYWORD.match(text, piece.start, piece.end))}
    return Completion(span, tuple(_keywords(found.call, given, "" if is_named else "=")))


def _keywords(call: Call, given: set[str], behind: str) -> Iterator[Item]:
    takes = [each for each in parameters(call) or () if each.name not in given]
    for each in sorted(takes, key=lambda each: each.default is not None):
        detail = "required" if each.default is None else f"= {each.default}"
        yield Item("attribute", each.name, each.name + behind, _of_parameter(call, each.name), detail)


def _call_at(text: str, offset: int) -> _CallAt | None:
    known = brackets(text) if len(text) <= MAX_CHARACTERS else {}
    around = [start for start, (end, _) in known.items() if start < offset and (end is None or end >= offset)]
    names = ((each, _name_before(text, each)) for each in reversed(around) if text[each] == "(")
    start, name = next(((each, name) for each, name in names if name), (0, ""))
    call = _called(text, name) if name else None
    if call is None or not parameters(call):
        return None
    end, commas = known[start]
    ends = (*commas, end if end is not None else max(offset, start, *commas))
    pieces = tuple(Span(before + 1, behind) for before, behind in zip((start, *commas), ends, strict=True))
    return _CallAt(call, pieces, start != around[-1] or is_quoted(text, offset))


def _name_before(text: str, bracket: int) -> str:
    """The name of what is called; "" where a bracket but holds something together."""
    found = _NAME_BEFORE.search(text, max(0, bracket - _LONGEST_NAME), bracket)
    return found[1] if found is not None and not keyword.iskeyword(found[1]) else ""


def _called(text: str, name: str) -> Call | None:
    """What a name stands for by the imports of a text, or by itself where none binds it."""
    first, dot, rest = name.partition(".")
    full = _imported(text).get(first)
    if full is not None:
        return python_api.call_named(full + dot + rest)
    return python_api.call_named(name) if dot else python_api.BY_SHORT_NAME.get(name)


def _imported(text: str) -> dict[str, str]:
    """What names stand for that imports bind."""
    found: dict[str, str] = {}
    for module, names in _IMPORTS.findall(text):
        for each in re.sub(r"#.*|[()]", "", names).split(","):
            name, _, other = (word.strip() for word in each.partition(" as "))
            if module:
                found[other or name] = f"{module}.{name}"
            else:
                found[other or name.partition(".")[0]] = name if other else name.partition(".")[0]
    return found


def _of_call(call: Call) -> str:
    tag = entities()[call.kind].tag if call.kind in entities() else None
    doc = call.doc or (tag.doc if tag is not None else SUBSTITUTIONS_ROS2[call.kind][1])
    return f"{doc} Of {call.since.capitalize()} or newer." if call.since else doc


def _of_parameter(call: Call, name: str) -> str:
    """One sentence: that of the class itself, of the attribute of the other formats, or of all such parameters."""
    tag = entities()[call.kind].tag if call.kind in entities() else None
    attributes = tag.attributes.values() if tag is not None else ()
    of_tag = next((each.doc for each in attributes if python_api.parameter_of(call, each.name) == name), "")
    return python_api.own_doc(call, name) or of_tag or python_api.PARAMETERS[name]
