"""The files that paths and addresses name, and those that wrong ones were meant to name."""

from __future__ import annotations

import os
import re
from itertools import chain
from pathlib import Path
from typing import NamedTuple

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.span import Location
from preflight_analysis.environment.git_history import formerly
from preflight_analysis.environment.git_ignored import is_ignored
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.evaluation.problems import ParameterFileNotFound, Problem, UnreadablePath
from preflight_analysis.findings.doubt import Doubt, doubts
from preflight_analysis.launch.recognize import LAUNCH_SUFFIXES
from preflight_analysis.model.context import Context
from preflight_analysis.model.elsewhere import (
    absent_folder_of_others,
    absent_top,
    depends_on_build,
    depends_on_working_folder,
)
from preflight_analysis.model.nearest import nearest
from preflight_analysis.model.problems import quoted, shown

_NOT_SET = re.compile(r"(?<![a-z])no(?:t[_ -]?(?:set|specified|given|defined)|_\w*_set)(?![a-z])", re.IGNORECASE)
_TO_DO = re.compile(
    r"\b(?:TODO|FIXME|TBD)\b|\b(?:CHANGE|REPLACE)_?ME\b|(?:\b[A-Z]{2,}\b[ _]?){4,}|\bPATH_TO_|\bpath/to/"
)
"""What people write where somebody else is to write a name: a note, or a sentence in capitals."""

_TEMPLATE = re.compile(r"(?<!\w)(?:__[A-Z][A-Z0-9]*(?:_[A-Z0-9]+)*__|@[A-Z][A-Z0-9_]+@)(?!\w)")
"""What a program puts a value in the place of: `__MAX_SPEED__`, `@MAX_SPEED@`."""

_HOME = re.compile(r"\bHOME\b|\bexpanduser\b|\.home\(\)")
_OPTIONAL = re.compile(r"\$\(optenv (\w+) *\)")
_SUBSTITUTION = re.compile(r"\$\([^()]*\)")
_GAP = re.compile(r"(?:\A()(?=[._-])|([._-])(?=[._-]))")
"""Where the name of a file lacks a part: `_map.yaml`, `map_.yaml`."""


class Address(NamedTuple):
    """What an address (`package://arm/meshes/a.stl`, `file:///a.stl`) names: `package` is the one that it names, "" for
    none, `path` where the file has to be; None where that package is not here."""

    package: str
    path: str | None


def address(environment: Environment, text: str) -> Address | None:
    """That of a text; None where it is none of a file."""
    scheme, sign, rest = text.partition("://")
    if not sign or not rest:
        return None
    if scheme == "file":
        return Address("", rest)
    name, slash, below = rest.partition("/")
    if scheme != "package" or not slash or not below.strip("/"):
        return None
    package = environment.packages.get(name)
    return Address(name, os.path.join(package.share, below.lstrip("/")) if package is not None else None)


def doubts_of_file(
    context: Context, problem: Problem[UnreadablePath], near: str | None
) -> tuple[tuple[Doubt, ...], str]:
    """Those about a file that is not there, and what the message says of them."""
    path, place = problem.kind.path, problem.location
    if says_not_set(path):
        return doubts(NOT_SET=True), "; a part of the path has to be set"
    if near is None and is_ignored(context.disk, path):
        return doubts(MADE_ELSEWHERE=True), "; git ignores it, so each machine may create it"
    if empty := _empty_arguments(context, path, place, near):
        return doubts(NOT_SET=empty), f"; set {empty}"
    if (absent := _absent_top(context, path)) is not None:
        return doubts(ON_ROBOT=absent), f"; this machine has no '{absent}'"
    if is_below_own_home(context, path, place.file):
        return doubts(ON_ROBOT=True), "; it is looked for in the home folder"
    if _is_beside(context, problem.kind, place) or (near is None and depends_on_working_folder(context, place)):
        return doubts(WHERE_STARTED=True), "; the path depends on the folder where the launch is started"
    if depends_on_build(context, path, place.file):
        return doubts(PARTLY_READ=True), "; the path depends on where the package is installed"
    if near is None and (maker := _maker_of(context, path, place)) is not None:
        return doubts(MADE_ELSEWHERE=maker), f"; '{maker}' gets this launch file and may create it"
    return (), ""


def is_below_own_home(context: Context, path: str, file: str) -> bool:
    """Whether a launch file asks for the home folder of whoever starts it, where the path lies: on another machine the
    workspace may be there."""
    home, document = context.environment.variables.get("HOME"), context.documents.get(file)
    below = home is not None and len(home) > 1 and path.startswith(home.rstrip("/") + "/")
    asks = document is not None and _HOME.search(document.text) is not None
    return below and asks and package_folder(path, context.environment) is None


def in_namesake(context: Context, path: str) -> str | None:
    """The folder of another package of the same name, where that has the file: which of them is found depends on the
    package path."""
    share = package_folder(path, context.environment)
    if share is None:
        return None
    below = os.path.relpath(path, share)
    named = (each for each, package in context.environment.packages.items() if package.share == str(share))
    others = chain.from_iterable(context.environment.shadowed.get(each, ()) for each in named)
    return next((each.share for each in others if context.disk.exists(os.path.join(each.share, below))), None)


def _is_beside(context: Context, kind: UnreadablePath, place: Location) -> bool:
    """Whether a parameter file with a relative path is there for those who start the launch in the folder of its launch
    file."""
    workspace = context.environment.workspace
    if workspace is None or not kind.path or not isinstance(kind, ParameterFileNotFound):
        return False
    if package_folder(kind.path, context.environment) is not None:
        return False
    below = os.path.relpath(kind.path, workspace)
    return not below.startswith("..") and context.disk.exists(os.path.join(os.path.dirname(place.file), below))


def _maker_of(context: Context, path: str, place: Location) -> str | None:
    """The program that gets the launch file itself as an argument, where a file is missing whose name begins with that
    of the launch file: it writes the one that the launch file includes another time (`parse:=true`)."""
    folder, name = os.path.split(place.file)
    launch_file = context.launch_files.get(place.file)
    if launch_file is None or launch_file.root is None or os.path.dirname(path) != folder:
        return None
    if not os.path.basename(path).startswith(stem(name)):
        return None
    itself = re.compile(rf"(?<![\w.-]){re.escape(name)}(?![\w.])")
    pending = [launch_file.root]
    while pending:
        action = pending.pop()
        pending += action.children
        args, program = action.value("args"), action.value("type")
        if args is not None and program is not None and itself.search(args.text):
            return program.text
    return None


def _empty_arguments(context: Context, path: str, place: Location, near: str | None) -> str:
    """The arguments, or else the variables without a value, that are empty (`argument 'robot'`), where there is such a
    file with a folder, or a part of its name, more: `config/rover/robot.yaml` for `config/robot.yaml`,
    `maps/hall.yaml` for `maps/.yaml`. Where another file may be meant, `near`, only those that are written at the
    place."""
    empty, written = [name for name, arg in context.tree.args.items() if arg.value == ""], context.text(place)
    if near is not None:
        empty = [name for name in empty if re.search(rf"\$\((?:arg|var) {re.escape(name)}[ )]", written)]
    unset = [name for name in _OPTIONAL.findall(written) if name not in context.environment.variables]
    if not (empty or unset) or package_folder(path, context.environment) is None:
        return ""
    said = f"variable {quoted(unset)}" if unset else f"argument {quoted(empty)}"
    folder, name = os.path.split(os.path.normpath(path))
    gap = _GAP.search(name)
    before, after = (name[: gap.end()], name[gap.end() :]) if gap is not None else ("", "")
    for there in files_in(context.disk, folder, deep=True):
        where, other = os.path.split(there)
        if where != folder and other == name:
            return said
        if gap is not None and len(other) > len(name) and other.startswith(before) and other.endswith(after):
            return said
    return ""


def _absent_top(context: Context, path: str) -> str | None:
    """The top folder of a path that is of no package of this machine, or the folder of a user or a disk, where it has
    none of that name."""
    if package_folder(path, context.environment) is not None:
        return None
    return absent_top(context.disk, path) or absent_folder_of_others(context.disk, path)


def says_not_set(text: str) -> bool:
    """Whether a value is there to be replaced, as `$(optenv ROBOT !!NO_ROBOT_SET!!)` is: by a variable, or by an
    argument whose default it is."""
    return _NOT_SET.search(text) is not None or _TO_DO.search(text) is not None or is_template(text)


def is_template(text: str) -> bool:
    """Whether a text has a mark in it for which a program writes a value."""
    return _TEMPLATE.search(text) is not None


def in_named_package(disk: Disk, path: str, environment: Environment) -> tuple[Package, str] | None:
    """The package whose name is that of a folder of `path`, and what follows it, where that exists in the package:
    `/home/me/ws/src/robot/maps/a.yaml` is `maps/a.yaml` of `robot`."""
    parts = path.split("/")
    for at in range(len(parts) - 1, 0, -1):
        package = environment.packages.get(parts[at])
        below = "/".join(parts[at + 1 :])
        if package is not None and below and disk.exists(os.path.join(package.share, below)):
            return package, below
    return None


def nearest_file(disk: Disk, path: str, environment: Environment) -> str | None:
    """The path of an existing file that `path` is probably meant to be, None if nothing is near.

    First the one that git says it was renamed to; then a file of a like name in the same folder, the same name, or one
    like it, elsewhere in the package, and the same place in a package that it names.
    """
    change = formerly(disk, path)
    if change is not None and change.path is not None:
        return change.path
    wanted = Path(path)
    siblings = {entry.name: entry for entry in map(Path, files_in(disk, str(wanted.parent), deep=False))}
    alike = [name for name in siblings if Path(name).suffix == wanted.suffix]
    # A launch file is meant by no name but that of one.
    launches = () if wanted.name.endswith(LAUNCH_SUFFIXES) else LAUNCH_SUFFIXES
    other = (name for name in siblings if stem(name) == wanted.stem and not name.endswith(launches))
    near = nearest(wanted.name, alike, key=stem) or next(other, None)
    if near is not None:
        return str(siblings[near])
    share = package_folder(path, environment)
    if share is None:
        named = in_named_package(disk, path, environment)
        return os.path.join(named[0].share, named[1]) if named is not None else None
    elsewhere: dict[str, list[Path]] = {}
    for entry in map(Path, files_in(disk, str(share), deep=True)):
        if entry.suffix == wanted.suffix:
            elsewhere.setdefault(entry.name, []).append(entry)
    name = wanted.name if wanted.name in elsewhere else nearest(wanted.name, elsewhere, key=stem)
    return _closest(elsewhere[name], wanted.parent) if name is not None else None


def meant_file(context: Context, path: str, near: str | None) -> str:
    """What a message about a file that is not there says of the one that was meant (`nearest_file`), and of what became
    of it."""
    change = formerly(context.disk, path)
    if change is not None and change.path == near:
        return change.told(shown(near, context) if near is not None else None)
    return f"; did you mean '{shown(near, context)}'?" if near is not None else ""


def _closest(files: list[Path], folder: Path) -> str | None:
    """The file whose folders have most names in common with `folder`, None if several have."""
    wanted = set(folder.parts)
    ranked = sorted(files, key=lambda file: len(wanted & set(file.parent.parts)), reverse=True)
    if len(ranked) > 1 and len(wanted & set(ranked[0].parent.parts)) == len(wanted & set(ranked[1].parent.parts)):
        return None
    return str(ranked[0])


def leads_elsewhere(context: Context, location: Location, path: Path) -> bool:
    """Whether there are files that fit a text which came to `path`, with anything in the place of what the text does
    not hold, as another launch may give it: `maps/hall.yaml` for `maps/$(arg map).yaml`."""
    root = package_folder(str(path), context.environment) or path.parent
    written = _SUBSTITUTION.sub("$", context.text(location))
    parts = path.relative_to(root).parts
    held = [re.search(rf"(?<![\w$.-]){re.escape(part)}(?![\w$.-])", written) is not None for part in parts]
    if all(held):
        return False
    *folders, last = (re.escape(part) if there else "[^/]*" for part, there in zip(parts, held, strict=True))
    suffix = "" if held[-1] else re.escape(path.suffix)
    fits = re.compile("/".join((re.escape(str(root)), *folders, f"{last}{suffix}")))
    return any(map(fits.fullmatch, files_in(context.disk, str(root), deep=True)))


def package_folder(path: str, environment: Environment) -> Path | None:
    """The folder of the innermost package around `path`."""
    holders = [p.share for p in environment.packages.values() if path.startswith(p.share.rstrip("/") + "/")]
    return Path(max(holders, key=len)) if holders else None


def stem(name: str) -> str:
    """What can be a slip of the keyboard: an equal extension would make short names look alike."""
    return name.partition(".")[0] or name
