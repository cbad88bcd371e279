"""The text of a knowledge file to `Knowledge`. What is wrong in it becomes a `Problem` at its line."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from typing import Any

import yaml

from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, compose_fast, constructed
from preflight_analysis.knowledge.model import (
    ENTRY_KINDS,
    ROLES,
    Entry,
    EntryKind,
    Frames,
    Kind,
    Knowledge,
    Meaning,
    Problem,
)

_OF_ENTRIES = ("parameters", "arguments", "options", "broadcasts", "distributions", "node", "within", "whole")
_OF_MEANINGS = (
    "type", "default", "when", "qos", "append", "remapped", "private", "folder", "names", "formerly",
)  # fmt: skip
_MAX_VALUES = 50_000
"""Of one file; aliases of aliases would otherwise make any number of them."""


@lru_cache(maxsize=256)
def read_knowledge(text: str) -> Knowledge:
    """What a file says; never raises."""
    try:
        return _Reader().file(compose_fast(text))
    except CONSTRUCTION_ERRORS as error:
        mark = getattr(error, "problem_mark", None)
        reason = getattr(error, "problem", None) or "invalid YAML"
        return Knowledge(problems=(Problem(str(reason), mark.line + 1 if mark else 1),))


class _Reader:
    def __init__(self) -> None:
        self.problems: list[Problem] = []
        self._values = 0

    def file(self, node: yaml.Node | None) -> Knowledge:
        package, source = "", {}
        distributions: tuple[str, ...] = ()
        entries: list[Entry] = []
        if node is None:
            self._wrong(None, "empty file: expected package and entries")
        for key, value in self._pairs(node, "a knowledge file"):
            if key.value == "package":
                package = self._text(value, "package")
            elif key.value == "source":
                source = self._plain(value)
                if not isinstance(source, dict):
                    self._wrong(value, "invalid value of 'source': expected names with values")
                    source = {}
            elif key.value == "distributions":
                distributions = self._texts(value, "distributions")
            elif key.value == "entries":
                entries += map(self.entry, self._items(value, "entries"))
            else:
                self._unknown(key, "a knowledge file", ("package", "source", "distributions", "entries"))
        if node is not None and not package:
            self._wrong(node, "key 'package' is missing")
        whole = [_of_distributions(entry, distributions) for entry in entries]
        return Knowledge(package, tuple(whole), distributions, source, tuple(self.problems))

    def entry(self, node: yaml.Node) -> Entry:
        given: dict[str, Any] = {}
        names: dict[EntryKind, tuple[str, ...]] = {}
        for key, value in self._pairs(node, "an entry"):
            if key.value in ENTRY_KINDS:
                names[key.value] = self._texts(value, key.value)
            elif key.value == "parameters":
                given["meanings"] = tuple(self._meanings(value))
            elif key.value == "broadcasts":
                frames = map(self.frames, self._items(value, "broadcasts"))
                given["frames"] = tuple(each for each in frames if each is not None)
            elif key.value == "distributions":
                given["distributions"] = self._texts(value, "distributions")
            elif key.value == "arguments":
                given["arguments"] = self._texts(value, "arguments")
            elif key.value in ("within", "options"):
                given[key.value] = {k.value: self._text(v, k.value) for k, v in self._pairs(value, key.value)}
            elif key.value == "node":
                given["node"] = self._text(value, "node")
            elif key.value == "whole":
                given["whole"] = self._plain(value) is True
            else:
                self._unknown(key, "an entry", (*ENTRY_KINDS, *_OF_ENTRIES))
        if not names:
            self._wrong(node, f"an entry needs one of: {', '.join(ENTRY_KINDS)}")
        return Entry(names, **given)

    def _meanings(self, node: yaml.Node) -> Iterator[Meaning]:
        """Those of each parameter, which may have a list of them."""
        for key, value in self._pairs(node, "parameters"):
            several = self._items(value, key.value) if isinstance(value, yaml.SequenceNode) else [value]
            for each in several:
                meaning = self.meaning(key, each)
                if meaning is not None:
                    yield meaning

    def meaning(self, key: yaml.ScalarNode, node: yaml.Node) -> Meaning | None:
        kind: Kind | None = None
        given: dict[str, Any] = {}
        for name, value in self._pairs(node, f"'{key.value}'"):
            if name.value in ROLES:
                if kind is not None:
                    self._wrong(name, f"'{key.value}' is either '{kind}' or '{name.value}', not both")
                    continue
                kind = name.value
                given["role"] = self._text(value, name.value)
                roles = ROLES[kind]
                if given["role"] not in roles:
                    self._wrong(value, f"invalid value of '{kind}': expected {' or '.join(roles)}")
                    return None
            elif name.value == "type":
                given |= self._type(value)
            elif name.value == "default":
                given["default"] = self._plain(value)
            elif name.value in ("when", "qos"):
                given[name.value] = {k.value: self._plain(v) for k, v in self._pairs(value, name.value)}
            elif name.value in ("append", "folder"):
                given[name.value] = self._text(value, name.value)
            elif name.value == "names":
                given["names"] = self._texts(value, "names")
            elif name.value == "formerly":
                given["formerly"] = {k.value: self._text(v, k.value) for k, v in self._pairs(value, "formerly")}
            elif name.value in ("remapped", "private"):
                given[name.value] = self._plain(value) is True
            else:
                self._unknown(name, f"'{key.value}'", (*ROLES, *_OF_MEANINGS))
        if kind is None and given.keys() == {"default"}:
            kind = "value"
        if kind is None:
            self._wrong(key, f"'{key.value}' needs one of: {', '.join(ROLES)}")
            return None
        return Meaning(key.value, kind, **given)

    def frames(self, node: yaml.Node) -> Frames | None:
        given: dict[str, Any] = {}
        for key, value in self._pairs(node, "a broadcast"):
            if key.value in ("parent", "child"):
                given[key.value] = self._text(value, key.value)
            elif key.value == "static":
                given["static"] = self._plain(value) is True
            elif key.value == "when":
                given["when"] = {k.value: self._plain(v) for k, v in self._pairs(value, "when")}
            else:
                self._unknown(key, "a broadcast", ("parent", "child", "static", "when"))
        if not {"parent", "child"} <= given.keys():
            self._wrong(node, "a broadcast needs parent and child")
            return None
        return Frames(**given)

    def _type(self, node: yaml.Node) -> dict[str, Any]:
        if isinstance(node, yaml.ScalarNode):
            return {"type": self._text(node, "type")}
        by = {}
        for key, value in self._pairs(node, "type"):
            by[key.value] = {k.value.lower(): self._text(v, "type") for k, v in self._pairs(value, key.value)}
        return {"type_by": by}

    def _plain(self, node: yaml.Node) -> Any:
        if isinstance(node, yaml.MappingNode):
            return {key.value: self._plain(value) for key, value in self._pairs(node, "a value")}
        if isinstance(node, yaml.SequenceNode):
            return [self._plain(each) for each in self._items(node, "a value")]
        try:
            return constructed(node)
        except CONSTRUCTION_ERRORS:
            self._wrong(node, f"invalid value '{node.value}'")
            return None

    def _text(self, node: yaml.Node, what: str) -> str:
        if isinstance(node, yaml.ScalarNode):
            return str(node.value)
        self._wrong(node, f"invalid value of '{what}': expected a text")
        return ""

    def _texts(self, node: yaml.Node, what: str) -> tuple[str, ...]:
        return tuple(filter(None, (self._text(each, what) for each in self._items(node, what))))

    def _items(self, node: yaml.Node, what: str) -> list[yaml.Node]:
        if isinstance(node, yaml.SequenceNode):
            self._count(len(node.value))
            return list(node.value)
        self._wrong(node, f"invalid value of '{what}': expected a list")
        return []

    def _pairs(self, node: yaml.Node | None, what: str) -> Iterator[tuple[yaml.ScalarNode, yaml.Node]]:
        if isinstance(node, yaml.MappingNode):
            for key, value in node.value:
                self._count()
                if isinstance(key, yaml.ScalarNode):
                    yield key, value
                else:
                    self._wrong(key, "invalid key: expected a name")
        elif node is not None:
            self._wrong(node, f"invalid value of {what}: expected names with values")

    def _count(self, number: int = 1) -> None:
        self._values += number
        if self._values > _MAX_VALUES:
            raise ValueError("too many values")

    def _unknown(self, key: yaml.ScalarNode, what: str, known: tuple[str, ...]) -> None:
        self._wrong(key, f"unknown key '{key.value}' of {what}; expected one of: {', '.join(known)}")

    def _wrong(self, node: yaml.Node | None, message: str) -> None:
        self.problems.append(Problem(message, node.start_mark.line + 1 if node is not None else 1))


def _of_distributions(entry: Entry, distributions: tuple[str, ...]) -> Entry:
    if entry.distributions or not distributions:
        return entry
    return replace(entry, distributions=distributions)
