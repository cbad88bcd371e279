"""The project settings file, `.ros-preflight.yaml` at the workspace root.

roots:                          # what is launched, beside the files that nothing includes
  - launch/robot.launch         # relative to this file
  - file: launch/robot.launch   # the same with arguments, for as many profiles as there are
    args: {sim: true}
external:                       # what something that no launch file starts offers or uses
  topics: [/joy, /teleop/*]     # full names; * stands for anything, slashes among it
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass

import yaml

from preflight_analysis.documents.reading import Text, read_text
from preflight_analysis.environment.detect import SETTINGS_FILE
from preflight_analysis.workspace.index import Root


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


def read_project_settings(folder: str) -> ProjectSettings:
    """The settings of a workspace; empty where there is no settings file."""
    path = os.path.join(folder, SETTINGS_FILE)
    found = read_text(path)
    if not isinstance(found, Text):
        unreadable = SettingsProblem(f"the file {found.reason}", 1)
        return ProjectSettings(path, (), () if found.kind == "missing" else (unreadable,))
    try:
        document = yaml.compose(found.text, Loader=yaml.SafeLoader)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        reason = getattr(error, "problem", None) or "it is no YAML"
        return ProjectSettings(path, (), (SettingsProblem(str(reason), mark.line + 1 if mark else 1),))
    problems: list[SettingsProblem] = []
    roots: list[Root] = []
    external: list[str] = []
    for key, value in _entries(document, problems, "the settings"):
        if key.value == "external":
            external += _external(value, problems)
        elif key.value != "roots":
            problems.append(_problem(key, f"'{key.value}' is no setting; there are: roots, external"))
        elif not isinstance(value, yaml.SequenceNode):
            problems.append(_problem(value, "roots is a list of launch files"))
        else:
            roots += (root for entry in value.value if (root := _root(entry, folder, problems)) is not None)
    return ProjectSettings(path, tuple(dict.fromkeys(roots)), tuple(problems), tuple(external))


def _external(node: yaml.Node, problems: list[SettingsProblem]) -> Iterator[str]:
    for key, value in _entries(node, problems, "external"):
        if key.value != "topics":
            problems.append(_problem(key, f"'{key.value}' does not belong into external; it has topics"))
        elif not isinstance(value, yaml.SequenceNode):
            problems.append(_problem(value, "topics is a list of names"))
        else:
            for item in value.value:
                if isinstance(item, yaml.ScalarNode) and item.value:
                    yield "/" + item.value.lstrip("/")
                else:
                    problems.append(_problem(item, "a topic is a name or a pattern"))


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
                    problems.append(_problem(text, f"the value of '{name.value}' is a text, as on a command line"))
        else:
            problems.append(_problem(key, f"'{key.value}' does not belong into a root; it has file and args"))
    if file is None:
        problems.append(_problem(node, "a root is a path, or has one as 'file'"))
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
                problems.append(_problem(key, "a name is expected here"))
    elif node is not None:
        problems.append(_problem(node, f"{what}: names with values are expected here"))


def _problem(node: yaml.Node, message: str) -> SettingsProblem:
    return SettingsProblem(message, node.start_mark.line + 1)
