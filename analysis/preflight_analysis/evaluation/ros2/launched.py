"""A process that launches another file: `ros2 launch PACKAGE FILE` or `ros2 launch PATH`.

What it launches is not followed. The file is looked for as ros2launch does (`ros2launch.api`): by its name anywhere in
the share folder of the package.
"""

from __future__ import annotations

import os
from collections.abc import Sequence

from preflight_analysis.documents.span import Location, Origin, Span
from preflight_analysis.environment.installed_paths import installed_elsewhere
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.evaluation.problems import LaunchedFileNotFound, PackageNotFound
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.tree import Use
from preflight_analysis.launch.model import Action, Value

_VERB = ("ros2", "launch")


def check_launched(performer: Performer, action: Action, words: Sequence[str]) -> None:
    """Note a package or a file that the process would not find, and where the file is that it would."""
    state = performer.state
    if len(words) == 1 and " " in words[0]:
        words = words[0].split()  # a line for a shell
    if tuple(words[:2]) != _VERB:
        return
    # Flags may stand between; of those before the file none takes a value.
    names = [word for word in words[2:] if not word.startswith("-") and ":=" not in word]
    if not names or "" in names or "$(" in names[0]:
        return
    if os.path.isabs(names[0]):
        path, name = names[0], names[0]
    elif len(names) > 1 and os.sep not in names[0]:
        package = state.environment.packages.get(names[0])
        if package is None:
            state.problem(PackageNotFound(names[0]), _origin(performer, action, names[0]), fatal=False)
            return
        name = names[1]
        found = _in_share(performer, package.name, name)
        folder = os.path.join(package.share, "launch")
        path = found or os.path.join(folder if state.files.is_folder(folder) else package.share, name)
    else:
        return
    origin = _origin(performer, action, name)
    if state.files.is_file(path):
        state.uses.append(Use("file", origin[-1], name, path, Location.of_file(path)))
    else:
        state.problem(LaunchedFileNotFound(path, "does not exist"), origin, fatal=False)


def _in_share(performer: Performer, package: str, name: str) -> str | None:
    state = performer.state
    owner = state.environment.packages[package]
    candidates = (
        *files_in(state.files, owner.share, deep=True),
        *(path for _, path in installed_elsewhere(state.files, owner)),
    )
    return next((path for path in candidates if os.path.basename(path) == name), None)


def _origin(performer: Performer, action: Action, word: str) -> Origin:
    """Where the word is written: alone in Python, within the command line in XML and YAML."""
    place = performer.place
    for child in action.children:
        value = child.value("value") if child.kind == "argument" else None
        if value is not None and word in value.text.split():
            return place.origin(_within(value, word))
    line = action.value("cmd")
    return place.origin(_within(line, word) if line is not None else action.kind_span)


def _within(value: Value, word: str) -> Span:
    start = value.span.start + value.text.find(word)
    exact = value.is_literal and value.span.end - value.span.start == len(value.text)
    return Span(start, start + len(word)) if exact else value.span
