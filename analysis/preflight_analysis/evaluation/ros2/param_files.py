"""Parameter files of ROS 2: which nodes each section is for, and what it sets.

https://design.ros2.org/articles/160_ros_command_line_arguments.html#multiple-parameter-assignments: the keys down to
`ros__parameters` are the full name of a node, with `*` for one part of it and `**` for any number of them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import Any, NamedTuple

import yaml

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.exact import exact
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, YamlDocument, constructed, parse_yaml, span_of
from preflight_analysis.evaluation.ros2 import rcl_yaml
from preflight_analysis.incremental.derived import derived
from preflight_analysis.slips import edits

MARK = "ros__parameters"
EVERY = "/**"
"""The key of what is for every node."""
_TABS_AT_END = re.compile(r"(?<=\S)[ \t]*\t[ \t]*(?=#|$)", re.MULTILINE)
"""Before a comment, or the end of a line that has something."""
_MAY_BE_ALIAS = re.compile(r"(?:^|[\s\[{,:-])\*[\w.-]+\s*(?:$|[\]},#:])", re.MULTILINE)
_SHORT_MARK = re.compile(r"ros_+param(?:eter)?s?")
_SLIP = 2
"""Letters by which a key may differ from the mark."""
_NEXT_DOCUMENT = re.compile(r"^---(?=[ \t]*(?:#|$))", re.MULTILINE)
_MAX_DEPTH = 40
_MAX_KEYS = 50_000
"""Of one file; aliases of aliases would otherwise make any number of them."""
_MAX_WILDCARDS = 3
"""In one key. What has more fits nothing: going through all ways to fit it would take for ever."""


@exact("value", "by_launch")
class FileParam(NamedTuple):
    """One parameter of a section, its name as the node declares it (`a.b`). `value` is what rcl makes of it,
    `by_launch` what PyYAML does, by which launch reads the file for a composable node."""

    name: str
    value: Any
    by_launch: Any
    name_span: Span
    value_span: Span


@dataclass(frozen=True, slots=True)
class Section:
    """The parameters for the nodes that `pattern` (`/robot/camera`, `/**`, `/*/camera`) fits. `spans` are its keys, and
    `key` is what they come to as written: to rcl `robot/camera` is another one than `/robot/camera`."""

    pattern: str
    spans: tuple[Span, ...]
    params: tuple[FileParam, ...]
    key: str = ""

    def fits(self, node: str) -> bool:
        """Whether the node of this full name gets them."""
        if "*" not in self.pattern:
            return self.pattern == node
        return _compiled(self.pattern).fullmatch(node) is not None

    def reaches(self, node: str, *, composable: bool) -> bool:
        """Likewise, but launch_ros reads the file of a composable node itself, and knows no wildcard but `/**`."""
        return self.pattern in (EVERY, node) if composable else self.fits(node)

    @property
    def exact(self) -> bool:
        """Whether it names one node."""
        return "*" not in self.pattern


@dataclass(frozen=True)
class ParamFile:
    """What a parameter file says. `problem` is why it is no YAML for rcl, with its place, `problem_of_launch` why it is
    none for launch, which reads the files of components and those with substitutions; `unmarked` are keys that lead to
    values without `ros__parameters` above them, which nobody reads; `refused` is YAML for which rcl refuses the file:
    what it is, and where. `flat` are the parameters of a file without any `ros__parameters`, which `launch_ros` gives
    to a component as they stand."""

    sections: tuple[Section, ...]
    problem: tuple[str, Span] | None = None
    unmarked: tuple[tuple[str, Span], ...] = ()
    refused: tuple[tuple[str, Span], ...] = ()
    flat: tuple[FileParam, ...] = ()
    misspelt: bool = False
    """Whether a key is a slip of `ros__parameters`."""
    problem_of_launch: tuple[str, Span] | None = None

    @property
    def repeated(self) -> Iterator[tuple[FileParam, FileParam]]:
        """The parameters that stand in a section twice, each with the one that rcl takes in its place, the later
        (`rcl_yaml_param_parser`, `add_val_to_...`)."""
        for section in self.sections:
            last: dict[str, FileParam] = {}
            for param in section.params:
                if (before := last.get(param.name)) is not None:
                    yield before, param
                last[param.name] = param

    def reaching(self, node: str, *, composable: bool = False) -> list[Section]:
        """The sections that reach the node of this full name, in order. A file may be shared by hundreds of nodes with
        a section for each: names are looked up, only wildcards are tried."""
        wild = (at for at in self._wildcards if self.sections[at].reaches(node, composable=composable))
        return [self.sections[at] for at in sorted((*self._by_name.get(node, ()), *wild))]

    @cached_property
    def _by_name(self) -> Mapping[str, list[int]]:
        found: dict[str, list[int]] = {}
        for at, section in enumerate(self.sections):
            if section.exact:
                found.setdefault(section.pattern, []).append(at)
        return found

    @cached_property
    def _wildcards(self) -> list[int]:
        return [at for at, section in enumerate(self.sections) if not section.exact]


def may_be_mark(key: str) -> bool:
    """Whether a key is a slip of `ros__parameters`."""
    return key != MARK and (edits(key, MARK, _SLIP) <= _SLIP or _SHORT_MARK.fullmatch(key) is not None)


def read_param_file(document: Document) -> ParamFile:
    """The sections of a parameter file in the order in which they are written."""
    return _of_document(document)


@derived
def _of_document(document: Document) -> ParamFile:
    return _read(document.text)


@lru_cache(maxsize=64)
def read_made_param_file(text: str) -> ParamFile:
    """As `read_param_file`, of a text that stands in no file: one whose substitutions were made, or that a run of a
    launch file wrote."""
    return _read(text)


def _read(text: str) -> ParamFile:
    parsed = by_launch = parse_yaml("", text)
    if by_launch.document.problems:
        # libyaml, by which rcl reads the file, takes a tab there for a blank (`yaml_parser_scan_to_next_token`). rcl
        # goes on with the next document (`parse_file_events`).
        by_rcl = parse_yaml("", _TABS_AT_END.sub(_blanks, _NEXT_DOCUMENT.sub("#--", text)))
        parsed = by_launch if by_rcl.document.problems else by_rcl
    problem = _first_problem(parsed)
    reader = _Reader()
    if isinstance(parsed.node, yaml.MappingNode):
        reader.nodes(parsed.node, (), (), 0)
    reader.refused += _aliases(text) if reader.sections and problem is None else ()
    flat = _Reader().params(parsed.node) if not reader.sections and isinstance(parsed.node, yaml.MappingNode) else ()
    return ParamFile(
        tuple(reader.sections),
        problem,
        tuple(reader.unmarked),
        tuple(reader.refused),
        tuple(flat),
        reader.misspelt,
        _first_problem(by_launch),
    )


def _aliases(text: str) -> Iterator[tuple[str, Span]]:
    """The first alias: libyaml tells rcl of it, which supports none (`parse_file_events`)."""
    if _MAY_BE_ALIAS.search(text) is None:
        return
    for event in yaml.parse(text, Loader=yaml.SafeLoader):
        if isinstance(event, yaml.AliasEvent) and event.start_mark is not None and event.end_mark is not None:
            yield f"an alias ('*{event.anchor}')", Span(event.start_mark.index, event.end_mark.index)
            return


def _emptied(params: yaml.MappingNode) -> Iterator[tuple[str, Span]]:
    """Empty groups with more behind them: where one ends, rcl takes that for the end of all parameters."""
    for key, value in params.value[:-1]:
        if isinstance(value, yaml.MappingNode) and not value.value and isinstance(key, yaml.ScalarNode):
            yield f"an empty group of parameters before others: '{key.value}'", span_of(key)


def _first_problem(parsed: YamlDocument) -> tuple[str, Span] | None:
    return next(((each.message, each.span) for each in parsed.document.problems), None)


def _blanks(found: re.Match[str]) -> str:
    return " " * len(found[0])


class _Reader:
    def __init__(self) -> None:
        self.sections: list[Section] = []
        self.unmarked: list[tuple[str, Span]] = []
        self.refused: list[tuple[str, Span]] = []
        self.misspelt = False
        self._keys = 0

    def nodes(self, node: yaml.MappingNode, keys: tuple[str, ...], spans: tuple[Span, ...], depth: int) -> None:
        """The levels above `ros__parameters`."""
        for key, value in node.value:
            if not isinstance(key, yaml.ScalarNode) or self._is_enough(depth):
                continue
            name, span = str(key.value), span_of(key)
            if name == MARK:
                if isinstance(value, yaml.ScalarNode):
                    self.refused.append((f"'{MARK}' without parameters below it", span))
                elif isinstance(value, yaml.MappingNode):
                    params = tuple(self._params(value, "", depth))
                    self.refused += _emptied(value)
                    if any("//" in f"{key}/{below}" for key, below in pairwise(keys)):
                        self.refused.append(("a node's name with two slashes: '" + "/".join(keys) + "'", spans[0]))
                    self.sections.append(Section(_pattern(keys), spans or (span,), params, _key(keys)))
            elif isinstance(value, yaml.MappingNode):
                self.misspelt = self.misspelt or may_be_mark(name)
                self.nodes(value, (*keys, name), (*spans, span), depth + 1)
            else:
                self.unmarked.append((name, span))

    def _is_enough(self, depth: int) -> bool:
        self._keys += 1
        return depth > _MAX_DEPTH or self._keys > _MAX_KEYS

    def params(self, node: yaml.MappingNode) -> Iterator[FileParam]:
        """All that stands below `node`."""
        return self._params(node, "", 0)

    def _params(self, node: yaml.MappingNode, prefix: str, depth: int) -> Iterator[FileParam]:
        for key, value in node.value:
            if not isinstance(key, yaml.ScalarNode) or self._is_enough(depth):
                continue
            name = f"{prefix}{key.value}"
            if isinstance(value, yaml.MappingNode):
                yield from self._params(value, name + ".", depth + 1)
            else:
                refused = rcl_yaml.refused(value)
                if refused is not None:
                    self.refused.append((f"{refused}: '{name}'", span_of(value)))
                yield FileParam(name, rcl_yaml.value(value), plain(value), span_of(key), span_of(value))


def plain(node: yaml.Node) -> Any:
    """The value of a node as plain data, by the rules of YAML 1.1. A parameter's list has no lists or dictionaries in
    it; what a file has there all the same is None."""
    if isinstance(node, yaml.SequenceNode):
        return [plain(each) if isinstance(each, yaml.ScalarNode) else None for each in node.value]
    try:
        return constructed(node)
    except CONSTRUCTION_ERRORS:
        return str(getattr(node, "value", ""))


def _key(keys: tuple[str, ...]) -> str:
    """The key that rcl makes of these, one level after the other."""
    return "/".join(keys).replace("//", "/")


def _pattern(keys: tuple[str, ...]) -> str:
    """The full name that the keys make: each may have slashes of its own."""
    parts = [part for key in keys for part in key.split("/") if part]
    return "/" + "/".join(parts)


@lru_cache(maxsize=4096)
def _compiled(pattern: str) -> re.Pattern[str]:
    if pattern.count("*") > 2 * _MAX_WILDCARDS:
        return re.compile(r"(?!)")
    parts = []
    for part in pattern.split("/")[1:]:
        parts.append(r"(?:/[^/]+)*" if part == "**" else "/" + re.escape(part).replace(r"\*", "[^/]*"))
    return re.compile("".join(parts) or "/")
