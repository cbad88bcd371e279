"""The project settings file, `.ros-preflight.yaml` at the workspace root.

roots:                          # what is launched, beside the files that nothing includes
  - launch/robot.launch         # relative to this file
  - file: launch/robot.launch   # the same with arguments, for as many profiles as there are
    args: {sim: true}
external:                       # what something that no launch file starts offers or uses
  topics: [/joy, /teleop/*]     # full names; * stands for anything, slashes among it
nodes:                          # what nodes do that cannot be run, in the words of the annotations of launch files
  - package: my_drivers         # each node of this executable; or a single one by `name: /full/name`
    executable: lidar
    topics: [{name: scan, type: sensor_msgs/LaserScan, class: pub}]
    params: [{name: ~rate, default: 10}]
knowledge:                      # files that say what parameters of nodes mean: docs/knowledge.md
  - config/knowledge.yaml
distribution: humble            # that the workspace is for
select: [LCH, TOP]              # rules and families that speak; all where this is left out
ignore: [LCH020]                # that do not
severities:                     # of rules: off, on, hint, info, warning or error; `all` are those that are not named
  TOP002: off
paths:                          # the same for files below a folder, or of a pattern; the last that matches counts
  - path: third_party/*
    severities: {all: off}
  - path: old/*
    ignore: [PKG]
profile: strict                 # of the command: default, strict (warnings fail), launch (what stops a launch)
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from typing import Literal

import yaml

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import text_of
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Text, Unreadable, digest, read_text
from preflight_analysis.documents.span import LineIndex, Location, Span
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, compose
from preflight_analysis.environment.detect import SETTINGS_FILE
from preflight_analysis.environment.distribution import known_distributions
from preflight_analysis.findings.severities import CHOICES, Severities, Wanted, chosen
from preflight_analysis.graph.annotations import GROUPS, AnnotationProblem, read_item
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.interfaces.settings import NodeSettings
from preflight_analysis.knowledge.model import Problem as KnowledgeProblem
from preflight_analysis.rules.registry import is_selector
from preflight_analysis.tracing.interface import Endpoint, ParamUse
from preflight_analysis.workspace.index import Root

KEYS = (
    *("roots", "external", "nodes", "knowledge", "distribution"),
    *("select", "ignore", "severities", "paths", "profile"),
)
"""The names on the top level."""
SELECTORS = ("select", "ignore")
"""Lists of rules and families, for all files and by path."""
Profile = Literal["default", "strict", "launch"]
PROFILES: tuple[Profile, ...] = ("default", "strict", "launch")
_DISTRIBUTIONS = (*known_distributions(1), *known_distributions(2))
"""`environment/distribution.py` reads it."""


@dataclass(frozen=True, slots=True)
class SettingsProblem:
    """What is wrong with the settings file, and its line, counted from 1."""

    message: str
    line: int


@dataclass(frozen=True, slots=True)
class ProjectSettings:
    """What the settings file says. What is wrong in it is left out and stands in `problems`."""

    path: str | None = None
    roots: tuple[Root, ...] = ()
    problems: tuple[SettingsProblem, ...] = ()
    external_topics: tuple[str, ...] = ()
    """Patterns of full names."""
    nodes: tuple[NodeSettings, ...] = ()
    knowledge: tuple[tuple[str, int], ...] = ()
    """The paths of files that say what parameters mean, and the lines, counted from 1, that name them."""
    severities: tuple[Severities, ...] = ()
    """The last that speak of a finding count."""
    profile: Profile = "default"
    text: str = ""
    """What the file held."""


def read_project_settings(folder: str) -> ProjectSettings:
    """The settings of a workspace, as its file is on the disk; empty where there is none."""
    path = os.path.join(folder, SETTINGS_FILE)
    return _settings(folder, path, read_text(path))


def settings_of_text(folder: str, text: str) -> ProjectSettings:
    """The settings of a workspace as they would be with this text."""
    path = os.path.join(folder, SETTINGS_FILE)
    return _settings(folder, path, Text.of(path, text))


@query
def project_settings_of(db: Database, folder: str) -> ProjectSettings:
    """The settings of a workspace; empty where there is no settings file."""
    path = os.path.join(folder, SETTINGS_FILE)
    return _settings(folder, path, text_of(db, path))


def _settings(folder: str, path: str, found: Text | Unreadable) -> ProjectSettings:
    if not isinstance(found, Text):
        unreadable = SettingsProblem(f"settings file {found.reason}", 1)
        return ProjectSettings(path, (), () if found.kind == "missing" else (unreadable,))
    try:
        document = compose(found.text)
    except CONSTRUCTION_ERRORS as error:
        mark = getattr(error, "problem_mark", None)
        reason = getattr(error, "problem", None) or "invalid YAML"
        problem = SettingsProblem(str(reason), mark.line + 1 if mark else 1)
        return ProjectSettings(path, (), (problem,), text=found.text)
    problems: list[SettingsProblem] = []
    roots: list[Root] = []
    external: list[str] = []
    nodes: list[NodeSettings] = []
    knowledge: list[tuple[str, int]] = []
    everywhere: list[Severities] = []
    by_path: list[Severities] = []
    selected: dict[str, tuple[str, ...]] = {}
    profile: Profile = "default"
    for key, value in _entries(document, problems, "the settings"):
        if key.value == "nodes" and isinstance(value, yaml.SequenceNode):
            nodes += (node for item in value.value if (node := _node(item, problems)) is not None)
        elif key.value == "nodes":
            problems.append(_problem(value, "invalid value of 'nodes': expected a list"))
        elif key.value == "knowledge" and isinstance(value, yaml.SequenceNode):
            for item in value.value:
                if isinstance(item, yaml.ScalarNode) and item.value:
                    knowledge.append((_path(folder, item), item.start_mark.line + 1))
                else:
                    problems.append(_problem(item, "invalid item of 'knowledge': expected a file"))
        elif key.value == "knowledge":
            problems.append(_problem(value, "invalid value of 'knowledge': expected a list of files"))
        elif key.value == "distribution":
            if value.value not in _DISTRIBUTIONS:
                expected = f"expected one of {', '.join(_DISTRIBUTIONS)}"
                problems.append(_problem(value, f"invalid value of 'distribution': {expected}"))
        elif key.value in SELECTORS:
            selected[key.value] = _selectors(key.value, value, problems)
        elif key.value == "severities":
            everywhere.append(Severities(_severities(value, problems)))
        elif key.value == "profile":
            if isinstance(value, yaml.ScalarNode) and value.value in PROFILES:
                profile = PROFILES[PROFILES.index(value.value)]
            else:
                problems.append(_problem(value, f"invalid value of 'profile': expected one of {', '.join(PROFILES)}"))
        elif key.value == "paths" and isinstance(value, yaml.SequenceNode):
            by_path += (each for item in value.value for each in _of_path(item, folder, problems))
        elif key.value == "paths":
            problems.append(_problem(value, "invalid value of 'paths': expected a list"))
        elif key.value == "external":
            external += _external(value, problems)
        elif key.value != "roots":
            problems.append(_problem(key, f"unknown setting '{key.value}'; expected one of: {', '.join(KEYS)}"))
        elif not isinstance(value, yaml.SequenceNode):
            problems.append(_problem(value, "invalid value of 'roots': expected a list of launch files"))
        else:
            roots += (root for entry in value.value if (root := _root(entry, folder, problems)) is not None)
    return ProjectSettings(
        path,
        tuple(dict.fromkeys(roots)),
        tuple(problems),
        tuple(external),
        tuple(nodes),
        tuple(knowledge),
        (*_chosen(selected), *everywhere, *by_path),
        profile,
        found.text,
    )


def located_problems(settings: ProjectSettings) -> tuple[Document | None, tuple[tuple[str, Location], ...]]:
    """What is wrong with the settings file and where, with the text that the places are in; without the blanks around
    what stands on the line. No text where nothing is wrong."""
    if settings.path is None or not settings.problems:
        return None, ()
    document = document_of(settings.path, settings.text)
    return document, located(document, settings.problems)


def located(
    document: Document, problems: Iterable[SettingsProblem | KnowledgeProblem]
) -> tuple[tuple[str, Location], ...]:
    """What is wrong with a text and where, without the blanks around what stands on the line."""
    text = document.text
    found = []
    for problem in problems:
        start, end = document.lines.line_span(problem.line - 1)
        line = text[start:end]
        start += len(line) - len(line.lstrip())
        found.append((problem.message, document.location(Span(start, max(start, start + len(line.strip()))))))
    return tuple(found)


@lru_cache(maxsize=16)
def document_of(path: str, text: str) -> Document:
    """The document of a settings file. One for one text: what several roots say of a place in it is said of the same
    place."""
    return Document(path, text, digest(text), (), (), LineIndex(text))


def _node(node: yaml.Node, problems: list[SettingsProblem]) -> NodeSettings | None:
    who: dict[str, str] = {}
    found: list[Endpoint | ParamUse] = []
    for key, value in _entries(node, problems, "a node"):
        if key.value in ("package", "executable", "name") and isinstance(value, yaml.ScalarNode):
            who[key.value] = value.value
        elif key.value in GROUPS and isinstance(value, yaml.SequenceNode):
            found += (item for each in value.value if (item := _item(key.value, each, problems)) is not None)
        else:
            allowed = ", ".join(("package", "executable", "name", *GROUPS))
            problems.append(_problem(key, f"unknown key '{key.value}' of a node; expected {allowed}"))
    if "name" not in who and not {"package", "executable"} <= who.keys():
        problems.append(_problem(node, "'package' and 'executable', or 'name', of a node are missing"))
        return None
    return NodeSettings(
        who.get("package"),
        who.get("executable"),
        who.get("name"),
        tuple(item for item in found if isinstance(item, Endpoint)),
        tuple(item for item in found if isinstance(item, ParamUse)),
    )


def _item(group: str, node: yaml.Node, problems: list[SettingsProblem]) -> Endpoint | ParamUse | None:
    at = Span(node.start_mark.line, node.start_mark.line)  # lines stand in for offsets here
    attributes = []
    for key, value in _entries(node, problems, group):
        line = key.start_mark.line
        text = value.value if isinstance(value, yaml.ScalarNode) else ""
        attributes.append((key.value, text, Span(line, line)))
    found: list[AnnotationProblem] = []
    item = read_item(group, at, attributes, found)
    problems += (SettingsProblem(each.message, each.span.start + 1) for each in found)
    return item


def _external(node: yaml.Node, problems: list[SettingsProblem]) -> Iterator[str]:
    for key, value in _entries(node, problems, "external"):
        if key.value != "topics":
            problems.append(_problem(key, f"unknown key '{key.value}' of 'external'; expected topics"))
        elif not isinstance(value, yaml.SequenceNode):
            problems.append(_problem(value, "invalid value of 'topics': expected a list of names"))
        else:
            for item in value.value:
                if isinstance(item, yaml.ScalarNode) and item.value:
                    yield "/" + item.value.lstrip("/")
                else:
                    problems.append(_problem(item, "invalid item of 'topics': expected a name or a pattern"))


def _selectors(name: str, node: yaml.Node, problems: list[SettingsProblem]) -> tuple[str, ...]:
    if not isinstance(node, yaml.SequenceNode):
        problems.append(_problem(node, f"invalid value of '{name}': expected a list of rules and families"))
        return ()
    found = []
    for item in node.value:
        if isinstance(item, yaml.ScalarNode) and is_selector(item.value):
            found.append(item.value)
        else:
            rule = item.value if isinstance(item, yaml.ScalarNode) else ""
            problems.append(_problem(item, f"unknown rule or family '{rule}'"))
    return tuple(found)


def _chosen(selected: Mapping[str, Sequence[str]], pattern: str | None = None) -> Iterator[Severities]:
    rules = chosen(**selected)
    if rules:
        yield Severities(rules, pattern)


def _severities(node: yaml.Node, problems: list[SettingsProblem]) -> dict[str, Wanted]:
    found: dict[str, Wanted] = {}
    for key, value in _entries(node, problems, "severities"):
        wanted = value.value if isinstance(value, yaml.ScalarNode) else ""
        choice = next((each for each in CHOICES if each == wanted), None)
        if not is_selector(key.value):
            problems.append(_problem(key, f"unknown rule or family '{key.value}'"))
        elif choice is None:
            problems.append(_problem(value, f"invalid severity of '{key.value}'; expected one of {', '.join(CHOICES)}"))
        else:
            found[key.value] = choice
    return found


def _of_path(node: yaml.Node, folder: str, problems: list[SettingsProblem]) -> tuple[Severities, ...]:
    pattern: str | None = None
    severities: dict[str, Wanted] = {}
    selected: dict[str, tuple[str, ...]] = {}
    for key, value in _entries(node, problems, "a path"):
        if key.value == "path" and isinstance(value, yaml.ScalarNode):
            pattern = _path(folder, value)
        elif key.value == "severities":
            severities |= _severities(value, problems)
        elif key.value in SELECTORS:
            selected[key.value] = _selectors(key.value, value, problems)
        else:
            expected = f"expected path, severities, {', '.join(SELECTORS)}"
            problems.append(_problem(key, f"unknown key '{key.value}' of 'paths'; {expected}"))
    if pattern is None:
        problems.append(_problem(node, "key 'path' is missing in an item of 'paths'"))
        return ()
    return (*_chosen(selected, pattern), Severities(severities, pattern))


def _root(node: yaml.Node, folder: str, problems: list[SettingsProblem]) -> Root | None:
    if isinstance(node, yaml.ScalarNode):
        return Root(_path(folder, node))
    file: yaml.ScalarNode | None = None
    args: dict[str, str] = {}
    for key, value in _entries(node, problems, "a root"):
        if key.value == "file" and isinstance(value, yaml.ScalarNode):
            file = value
        elif key.value == "args":
            for name, text in _entries(value, problems, "args"):
                if isinstance(text, yaml.ScalarNode):
                    args[name.value] = text.value
                else:
                    problems.append(_problem(text, f"invalid value of argument '{name.value}': expected a text"))
        else:
            problems.append(_problem(key, f"unknown key '{key.value}' of 'roots'; expected file and args"))
    if file is None:
        problems.append(_problem(node, "key 'file' is missing in an item of 'roots'"))
        return None
    return Root.of(_path(folder, file), args)


def _path(folder: str, node: yaml.ScalarNode) -> str:
    return os.path.normpath(os.path.join(folder, os.path.expanduser(node.value)))


def _entries(
    node: yaml.Node | None, problems: list[SettingsProblem], what: str
) -> Iterator[tuple[yaml.ScalarNode, yaml.Node]]:
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            if isinstance(key, yaml.ScalarNode):
                yield key, value
            else:
                problems.append(_problem(key, "invalid key: expected a name"))
    elif node is not None:
        problems.append(_problem(node, f"invalid value of {what}: expected names with values"))


def _problem(node: yaml.Node, message: str) -> SettingsProblem:
    return SettingsProblem(message, node.start_mark.line + 1)
