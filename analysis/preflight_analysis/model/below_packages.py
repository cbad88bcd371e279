"""What a launch file asks for below a package that is not there, and who has just that."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping

from preflight_analysis.documents.document import SpannedText
from preflight_analysis.documents.span import Span
from preflight_analysis.environment.model import Package
from preflight_analysis.evaluation.reading import launch_file_of
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.launch.model import LaunchFile, Literal, Substitution, Value
from preflight_analysis.launch.python_tree import PythonTree
from preflight_analysis.launch.recognize import launch_format_on_disk
from preflight_analysis.launch.references import first_word
from preflight_analysis.launch.substitutions_ros2 import parse_value_ros2
from preflight_analysis.model.context import Context
from preflight_analysis.model.name_index import named_in

_FIND = ("find", "find-pkg-share")
_ARGUMENT = ("arg", "var")
_WRITTEN = re.compile(r"[\w.+/-]*")


def has_what_is_asked_of(context: Context, file: str, name: str) -> tuple[Package, str] | None:
    """The one package of the workspace in which all paths and programs are that `file` asks for of package `name`, and
    the first of those paths; None where there is no such package, or no path that is written out."""
    values = {arg.name: arg.value for arg in context.tree.args.values()} if file == context.tree.file else {}
    paths = sorted(set(asked_below(context.disk.db, file, name, values)))
    # A launch file that hands over to another one mostly has its name.
    paths = [path for path in paths if os.path.basename(path) != os.path.basename(file)]
    if not paths:
        return None
    programs = _started_of(context, file, name)
    having = [
        package
        for package in context.environment.own_packages
        if all(_has(context, package, path, name) for path in paths)
        and all(_has_program(context, package.name, program) for program in programs)
    ]
    return (having[0], paths[0]) if len(having) == 1 else None


def _has(context: Context, package: Package, path: str, name: str) -> bool:
    """Whether a path is there in a package, other than a launch file that hands over to that of package `name`."""
    full = os.path.join(package.share, path)
    hands_over = path in asked_below(context.disk.db, full, name, {})
    return context.disk.exists(full) and not hands_over


def lacks_what_is_asked_of(context: Context, file: str, name: str, other: Package) -> bool:
    """Whether `file` starts a program of package `name` that another package does not have, or asks for paths that are
    written out, of which the other has none."""
    paths = set(asked_below(context.disk.db, file, name, {}))
    if paths and not any(context.disk.exists(os.path.join(other.share, path)) for path in paths):
        return True
    return not all(_has_program(context, other.name, program) for program in _started_of(context, file, name))


def _started_of(context: Context, file: str, name: str) -> set[str]:
    """The programs of the package that tags start, but for those that are not written out."""
    programs = named_in(context.disk.db, file, "program")
    return {each.text for each in programs if each.of == name and "$" not in each.text}


def _has_program(context: Context, package: str, program: str) -> bool:
    executables = context.executables
    return executables.is_build_target(package, program) or program in executables.names(package)


def asked_below(db: Database, file: str, name: str, values: Mapping[str, str | None]) -> Iterator[str]:
    """The paths of two parts or more that a launch file asks for below the share folder of a package, with arguments
    that have one of `values`."""
    for value in _values_in(db, file):
        for at, part in enumerate(value.parts):
            if isinstance(part, Substitution) and part.command in _FIND and first_word(part)[0] == name:
                path = _path_of(value.parts[at + 1 :], values)
                if "/" in path:
                    yield path


def _path_of(parts: tuple[Literal | Substitution, ...], values: Mapping[str, str | None]) -> str:
    """What stands behind the share folder, up to the folder of what is not known."""
    path = ""
    for part in parts:
        is_argument = isinstance(part, Substitution) and part.command in _ARGUMENT
        known = part.text if isinstance(part, Literal) else values.get(first_word(part)[0]) if is_argument else ""
        if not known:
            path = path.rpartition("/")[0]
            break
        written = _WRITTEN.match(known)
        path += written[0] if written is not None else ""
        if written is not None and written.end() < len(known):
            break
    return path.strip("/") if path.startswith("/") else ""


@query
def _values_in(db: Database, file: str) -> tuple[Value, ...]:
    """What a launch file says with substitutions."""
    launch_file = launch_file_of(db, file, None) if launch_format_on_disk(db, file) is not None else None
    if not isinstance(launch_file, LaunchFile):
        return ()
    if launch_file.is_python:
        texts = PythonTree(launch_file.document.text).launch_texts()
        return tuple(parse_value_ros2(SpannedText(text, Span(0, len(text)))) for text in texts if "$(" in text)
    actions = launch_file.root.walk() if launch_file.root is not None else ()
    return tuple(each.value for action in actions for each in action.attributes if "$(" in each.value.text)
