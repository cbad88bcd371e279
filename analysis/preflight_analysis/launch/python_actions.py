"""What a run of a Python launch file tells of it, or what is read from its text, to actions with their places.

The form of the records is that of `tracing/agents/fake_launch/serialize.py`. They come from the file's own process:
whatever has not the form is left out.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from preflight_analysis.documents.span import Span
from preflight_analysis.launch import python_api
from preflight_analysis.launch.model import Action, ActionAttribute, Literal, Substitution, Typed, Value
from preflight_analysis.launch.python_source import PythonSource, walk

MAX_DEPTH = 120
OF_CODE = ("python", "own", "unknown", "branch")
"""Commands of substitutions that stand for what only code gives."""


def actions_of(records: object, source: PythonSource, around: Span) -> tuple[Action, ...]:
    """The actions of records. `around` is the place of those that were made elsewhere."""
    return _Reader(source).actions(records, around, None, 0)


class _Parent(NamedTuple):
    """The call in whose arguments an action without a call of its own stands, and in which part of them, if that is
    known: of several dictionaries in a list, each has its own keys."""

    call: ast.Call
    kind: str
    part: ast.expr | None = None


class _Reader:
    def __init__(self, source: PythonSource) -> None:
        self._source = source
        self._keys: dict[int, dict[str, tuple[ast.expr, ast.expr | None]]] = {}
        """What `_pairs` says of an argument, by the keys: looked through once, for all its children."""
        self._wholes: dict[tuple[int, str], ast.expr | None] = {}
        """The argument of a call that children of a kind stand in."""

    def actions(self, records: object, around: Span, parent: _Parent | None, depth: int) -> tuple[Action, ...]:
        if not isinstance(records, list) or not records or depth > MAX_DEPTH:
            return ()
        found = [record for record in records if _is_action(record)]
        parts = self._parameter_parts(found, parent)
        return tuple(self._action(r, around, parts.get(id(r), parent), depth) for r in found)

    def _parameter_parts(self, records: list[dict[str, Any]], parent: _Parent | None) -> dict[int, _Parent]:
        """Which item of `parameters=[...]` each dictionary or file is, where the list is written out: `part` says it of
        some of them, otherwise all are there in order."""
        parameters = [record for record in records if python_api.CHILDREN.get(record["k"]) == "parameters"]
        if parent is None or parent.part is not None or not parameters:
            return {}
        given = _keywords(parent.call).get("parameters")
        if given is None:
            return {}
        items = self._source.resolved(given)
        if not isinstance(items, (ast.List, ast.Tuple)):
            return {}
        given_numbers = (each.get("part") for each in parameters)
        numbers = [n for n in given_numbers if isinstance(n, int) and 0 <= n < len(items.elts)]
        if len(numbers) != len(parameters):
            numbers = list(range(len(items.elts)))
        if len(numbers) != len(parameters):
            return {}
        return {
            id(record): _Parent(parent.call, parent.kind, items.elts[number])
            for record, number in zip(parameters, numbers, strict=True)
        }

    def _action(self, record: dict[str, Any], around: Span, parent: _Parent | None, depth: int) -> Action:
        kind, source = record["k"], self._source
        line, column = _place(record.get("p"))
        call = source.call(line, column, str(record.get("n"))) if line else None
        if call is not None:
            kind_span, span = source.name_span(call), source.span(call)
            head = kind_span
        elif line:
            kind_span = head = span = source.line_span(line)
        else:
            kind_span = head = span = around
        pair = self._pair_written(record) if call is None and not line else None
        if pair is None and call is None and parent is not None:
            pair = self._pair(kind, record, parent)
        if pair is not None and not line:
            kind_span = head = span = source.span(pair[0])
        made_by = python_api.made_by(kind)
        given = _arguments(call, made_by) if call is not None else {}
        attributes = []
        for name, value in _items(record.get("a")):
            node = given.get(python_api.parameter_of(made_by, name)) if call is not None else None
            if pair is not None:
                node = pair[1] if name in ("value", "to") and pair[1] is not None else pair[0]
            attributes.append(self._attribute(name, value, node, kind_span, call))
        if isinstance(record.get("error"), str):
            attributes.append(self._text("error", record["error"], kind_span))
        number = record.get("i")
        if kind == "opaque" and isinstance(number, int):
            attributes.append(self._text("id", str(number), kind_span))
            attributes.append(self._text("class", str(record.get("n")), kind_span))
        inside = _Parent(call, kind) if call is not None else parent
        children = self.actions(record.get("c"), kind_span, inside, depth + 1)
        return Action(kind, kind_span, tuple(attributes), children, (), _literal("", kind_span), head, span)

    def _text(self, name: str, text: str, span: Span) -> ActionAttribute:
        return ActionAttribute(name, span, _literal(text, span), span)

    def _attribute(
        self, name: str, value: object, node: ast.expr | None, around: Span, call: ast.Call | None
    ) -> ActionAttribute:
        span = self._source.span(node) if node is not None else around
        name_span = span if node is not None else around
        for keyword in call.keywords if call is not None else ():
            if keyword.value is node:
                name_span = self._source.keyword_span(keyword)
        made = self._value(value, span)
        if name in ("if", "unless"):
            made = made._replace(span=span)  # the class says what is asked
        return ActionAttribute(name, name_span, made, Span(name_span.start, max(span.end, name_span.end)))

    def _value(self, value: object, span: Span) -> Value:
        if isinstance(value, dict) and "v" in value:
            plain, span = value["v"], self._written(value, span)
            text = plain if isinstance(plain, str) else str(plain).lower() if isinstance(plain, bool) else str(plain)
            return Value(text, span, (Literal(text, span),), typed=Typed(plain))
        parts = tuple(self._parts(value, span, 0))
        if len(parts) == 1:
            span = parts[0].span  # that of what gives it, wherever that is written
        if any(isinstance(part, Substitution) for part in parts):
            return Value("".join(part.text for part in parts), span, parts)
        return _literal("".join(part.text for part in parts), span)

    def _parts(self, value: object, span: Span, depth: int) -> Iterator[Literal | Substitution]:
        for piece in value if isinstance(value, list) and depth < MAX_DEPTH else ():
            if isinstance(piece, str):
                yield Literal(piece, span)
            elif isinstance(piece, dict) and isinstance(piece.get("x"), str):
                yield Literal(piece["x"], self._written(piece, span))
            elif isinstance(piece, dict) and isinstance(piece.get("s"), str) and isinstance(piece.get("w"), list):
                yield self._substitution(piece, span, depth)

    def _substitution(self, piece: dict[str, Any], around: Span, depth: int) -> Substitution:
        line, column = _place(piece.get("p"))
        call = self._source.call(line, column, str(piece.get("n"))) if line else None
        span = self._source.span(call) if call is not None else around
        command = piece["s"]
        inside = span
        if call is not None and span is not around and call.args and not call.keywords and len(call.args) == 1:
            inside = self._source.span(call.args[0])
        spans = [inside] * len(piece["w"])
        if call is not None and span is not around and len(call.args) + len(call.keywords) == len(spans):
            spans = [self._source.span(each) for each in (*call.args, *(k.value for k in call.keywords))]
        words = tuple(tuple(self._parts(word, at, depth + 1)) for word, at in zip(piece["w"], spans, strict=True))
        arguments = " ".join("".join(part.text for part in word) for word in words)
        shown = _shown(piece, arguments) if command in OF_CODE else f"{command} {arguments}" if words else command
        text = f"$({shown})"
        return Substitution(command, span, arguments, inside, text, span, words)

    def _written(self, value: dict[str, Any], around: Span) -> Span:
        """Where a text is written, if that is known."""
        node = self._source.expression(value.get("p"))
        return around if node is None else self._source.span(node)

    def _pair_written(self, record: dict[str, Any]) -> tuple[ast.expr, ast.expr | None] | None:
        """The name of a part of an action where its place is known, and its value as far as that is."""
        given = record.get("a")
        attributes = given if isinstance(given, dict) else {}
        node = self._expression(_key(record))
        value = self._source.value_beside(node) if node is not None else None
        value = value or self._expression(attributes.get("to")) or self._expression(attributes.get("value"))
        return (node, value) if node is not None else None

    def _expression(self, value: object) -> ast.expr | None:
        """Where the text is made that is all of a value."""
        piece = value[0] if isinstance(value, list) and _is_written(value) else value
        return self._source.expression(piece.get("p")) if isinstance(piece, dict) else None

    def _pair(self, kind: str, record: dict[str, Any], parent: _Parent) -> tuple[ast.expr, ast.expr | None] | None:
        """Of a child that is no object: its key and its value in the parent's argument, or that argument alone."""
        whole = parent.part or self._whole(kind, parent)
        if whole is None:
            return None
        key = _plain(_key(record))
        if id(whole) not in self._keys:
            known: dict[str, tuple[ast.expr, ast.expr | None]] = {}
            self._keys[id(whole)] = known
            for first, second in self._pairs(whole):
                if isinstance(first, ast.Constant) and isinstance(first.value, str):
                    known.setdefault(first.value, (first, second))
        return self._keys[id(whole)].get(key or "") or (whole, None)

    def _whole(self, kind: str, parent: _Parent) -> ast.expr | None:
        key = id(parent.call), kind
        if key not in self._wholes:
            keywords = _keywords(parent.call)
            made_by = python_api.made_by(parent.kind)
            names = (python_api.CHILDREN.get(kind, kind), python_api.parameter_of(made_by, kind))
            self._wholes[key] = next((keywords[name] for name in names if name in keywords), None)
        return self._wholes[key]

    def _pairs(self, node: ast.expr) -> Iterator[tuple[ast.expr, ast.expr | None]]:
        """Keys with values in what a call is given: of maps and of pairs; texts by themselves."""
        nodes = [self._source.resolved(node)]
        if isinstance(nodes[0], ast.Call) and isinstance(nodes[0].func, ast.Attribute):
            nodes.append(self._source.resolved(nodes[0].func.value))
        if isinstance(nodes[0], (ast.List, ast.Tuple)):
            nodes += [self._source.resolved(each) for each in nodes[0].elts if isinstance(each, ast.Name)]
        within = [found for each in nodes for found in walk(each)]
        for found in within:
            if isinstance(found, ast.Dict):
                for key, value in zip(found.keys, found.values, strict=True):
                    if key is not None:
                        yield key, value
            elif isinstance(found, ast.Tuple) and len(found.elts) == 2:
                yield found.elts[0], found.elts[1]
        for found in within:
            if isinstance(found, ast.Constant):
                yield found, None


def _shown(piece: dict[str, Any], arguments: str) -> str:
    """What is written for people in the place of a value that only code makes: the code, its class, or what is not
    known."""
    if piece["s"] == "python":
        return str(piece.get("t"))
    if piece["s"] == "own":
        return str(piece.get("n"))
    return f"var {arguments}" if piece["s"] == "unknown" and arguments.isidentifier() else arguments


def _arguments(call: ast.Call, made_by: python_api.Call) -> dict[str, ast.expr]:
    given = _keywords(call)
    for name, node in zip(python_api.positional(made_by), call.args, strict=False):
        given.setdefault(name, node)
    return given


def _keywords(call: ast.Call) -> dict[str, ast.expr]:
    return {keyword.arg: keyword.value for keyword in call.keywords if keyword.arg is not None}


def _is_action(record: object) -> bool:
    return isinstance(record, dict) and isinstance(record.get("k"), str)


def _items(attributes: object) -> Iterable[tuple[str, object]]:
    if isinstance(attributes, dict):
        yield from ((name, value) for name, value in attributes.items() if isinstance(name, str))


def _place(place: object) -> tuple[int, int]:
    if isinstance(place, list) and len(place) == 2 and all(isinstance(each, int) for each in place):
        return place[0], place[1]
    return 0, -1


def _key(record: dict[str, Any]) -> object:
    given = record.get("a")
    attributes = given if isinstance(given, dict) else {}
    return attributes.get("name", attributes.get("from", attributes.get("value")))


def _is_written(value: list[Any]) -> bool:
    return len(value) == 1 and isinstance(value[0], dict) and isinstance(value[0].get("x"), str)


def _plain(value: object) -> str | None:
    if isinstance(value, list) and len(value) == 1:
        return value[0]["x"] if _is_written(value) else value[0] if isinstance(value[0], str) else None
    return None


def _literal(text: str, span: Span) -> Value:
    return Value(text, span, (Literal(text, span),))
