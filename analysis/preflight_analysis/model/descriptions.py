"""The files of robot descriptions and worlds in the packages of the workspace, each for itself, whatever launches them:
what each may use of what it includes, and of what the files define that include it."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.environment.git_submodules import left_submodule
from preflight_analysis.environment.installed_paths import located, made_by_build, package_around
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.environment.set_aside import is_set_aside
from preflight_analysis.findings.doubt import Doubt, doubts
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.model.context import Context
from preflight_analysis.robot.xacro import COMPUTED, Around, Macro, Part, Written, XacroFile, is_made_of, xacro_file

_SUFFIXES = (".xacro", ".urdf", ".srdf", ".sdf", ".world", ".gazebo")
_NOT_OURS = frozenset({"test", "tests", "build", "install", "log", "template", "templates"})
_PROPERTY = re.compile(r"\$\{ *(\w+) *\}")
_FIND = re.compile(r"\$\(find +([^\s()]+)\)|package://([^/\s]+)")
_COMPUTED = re.compile(rf"{COMPUTED.pattern}|\*|\?|\[[^]]{{0,1000}}\]")
LOOSE = doubts(NOT_GIVEN=True)
"""Of a rule that has something to say of launched descriptions, too: that no launch is known to read the file."""
_MOST = 1000
"""Files of all packages that are looked through, and of one description."""
_PASSING = (".launch", ".xml", ".py", ".sh", ".yaml", ".yml", ".md", ".cpp", ".bash", ".txt", ".rst")
"""What may give xacro an argument on its command line."""


@dataclass(frozen=True, slots=True)
class Named:
    """What the name of a file may lead to: `paths` are there; `whole` if no other file can be meant. `missing` is the
    path that it leads to for certain, where that is not there and nothing is known that makes it."""

    paths: tuple[str, ...] = ()
    whole: bool = False
    missing: str | None = None


@dataclass(frozen=True, slots=True)
class Defined:
    """What files define together. `whole`: all that they include is among them."""

    macros: Mapping[str, tuple[tuple[str, Macro], ...]]
    """With the file of each."""
    properties: frozenset[str]
    arguments: frozenset[str]
    whole: bool
    used: frozenset[str]
    """The properties that are used."""
    of_callers: Mapping[str, frozenset[str]]
    """The parameters of the macros that call a macro, through others too: its body has these names as well
    (`handle_macro_call` of xacro: the scope of a macro is below that of its call)."""

    @classmethod
    def of(cls, files: Iterable[XacroFile], *, whole: bool) -> Defined:
        """That of these files."""
        macros: dict[str, list[tuple[str, Macro]]] = {}
        properties, arguments, used = set[str](), set[str](), set[str]()
        calls = dict[str, set[tuple[str, frozenset[str]]]]()
        for file in files:
            for call in file.calls:
                if call.around.macro:
                    calls.setdefault(call.name, set()).add((call.around.macro, call.around.names))
            for macro in file.macros:
                macros.setdefault(macro.name, []).append((file.document.path, macro))
            properties.update(file.properties)
            for each in file.includes:  # one in the body of a macro has its parameters
                properties |= each.around.names
            arguments |= file.arguments
            used.update(use.name for use in file.uses if use.kind in ("property", "block"))
            whole = whole and not file.open
        found = {name: tuple(each) for name, each in macros.items()}
        of_callers = {name: _of_callers(calls, name) for name in found if name in calls}
        return cls(found, frozenset(properties), frozenset(arguments), whole, frozenset(used), of_callers)


def _of_callers(calls: Mapping[str, set[tuple[str, frozenset[str]]]], name: str) -> frozenset[str]:
    names, seen, waiting = set[str](), {name}, [name]
    while waiting:
        for caller, of_caller in calls.get(waiting.pop(), ()):
            names |= of_caller
            if caller not in seen:
                seen.add(caller)
                waiting.append(caller)
    return frozenset(names)


def packages_around(context: Context) -> tuple[Package, ...]:
    """The packages of the workspace that the files and nodes of a launch are in."""
    environment = context.environment
    around = (package_around(environment, path) for path in (context.root, *context.launch_files))
    named = {node.package for node in context.tree.nodes} & environment.packages.keys()
    found = dict.fromkeys((*filter(None, around), *(environment.packages[name] for name in sorted(named))))
    return tuple(package for package in found if not environment.is_installed(package))


@query
def files_of_package(db: Database, environment: Environment, package: Package) -> tuple[str, ...]:
    """Those of one package of the workspace."""
    disk = Disk(db)
    found = [path for path in files_in(disk, package.share, deep=True) if path.endswith(_SUFFIXES)]
    return tuple(
        path
        for path in sorted(found)[:_MOST]
        if _NOT_OURS.isdisjoint(os.path.relpath(path, package.share).split(os.sep)[:-1])
        and package_around(environment, path) is package
        and not is_set_aside(disk, environment, path)
    )


@query
def _all_files(db: Database, environment: Environment) -> tuple[str, ...]:
    own = (package for package in environment.own_packages if package.is_within(environment.workspace))
    return tuple(path for package in own for path in files_of_package(db, environment, package))[:_MOST]


def named_file(db: Database, environment: Environment, file: XacroFile, written: Written) -> Named:
    """What the name of an include or a mesh leads to."""
    return _named(db, environment, file.document.path, written.text)


@query
def _named(db: Database, environment: Environment, path: str, written: str) -> Named:
    file, disk = xacro_file(db, path), Disk(db)
    constants = file.properties if file is not None else {}
    unknown = False

    def constant(match: re.Match[str]) -> str:
        return constants.get(match[1]) or match[0]

    def share(match: re.Match[str]) -> str:
        nonlocal unknown
        package = environment.packages.get(match[1] or match[2])
        unknown = unknown or package is None
        return package.share if package is not None else ""

    text = _PROPERTY.sub(constant, _PROPERTY.sub(constant, written.strip()))
    text = _FIND.sub(share, text).removeprefix("file://")
    if unknown or "://" in text or not text:
        return Named()
    if _COMPUTED.search(text) is None:
        if "$" in text:
            return Named()
        name = os.path.normpath(os.path.join(os.path.dirname(path), text))
        there = located(disk, environment, name)
        if disk.exists(there):
            return Named((there,), whole=True)
        is_made = made_by_build(disk, environment, name) is not None or disk.exists(f"{name}.in")
        return Named(missing=None if is_made or left_submodule(disk, name) is not None else name)
    pieces = _COMPUTED.split(text)
    anchored = bool(pieces[0])
    if anchored:
        begin = os.path.join(os.path.dirname(path), pieces[0])
        pieces[0] = os.path.normpath(begin) + ("/" if begin.endswith("/") else "")
    pieces = pieces if anchored else ["", *pieces]
    found = tuple(each for each in _all_files(db, environment) if each != path and is_made_of(each, pieces))
    return Named(found, whole=anchored and bool(found))


@query
def included(db: Database, environment: Environment, path: str) -> tuple[tuple[str, ...], bool]:
    """The files that a file includes, or may include, and whether these are all."""
    file = xacro_file(db, path)
    if file is None:
        return (), False
    found, whole = dict[str, None](), True
    for each in file.includes:
        named = named_file(db, environment, file, each)
        found.update(dict.fromkeys(named.paths))
        whole = whole and (named.whole or (each.optional and named.missing is not None))
    return tuple(found), whole


@query
def _includers(db: Database, environment: Environment) -> Mapping[str, tuple[str, ...]]:
    found: dict[str, list[str]] = {}
    for path in _all_files(db, environment):
        for each in included(db, environment, path)[0]:
            found.setdefault(each, []).append(path)
    return {path: tuple(each) for path, each in found.items()}


@query
def tops_of(db: Database, environment: Environment, path: str) -> tuple[str, ...]:
    """The files that include a file, through others too, and that no file includes; itself if there is none."""
    includers, seen, waiting, tops = _includers(db, environment), {path}, [path], list[str]()
    while waiting:
        here = waiting.pop()
        above = includers.get(here, ())
        if not above:
            tops.append(here)
        waiting += (each for each in above if each not in seen)
        seen.update(above)
    return tuple(sorted(tops)) or tuple(sorted(seen))


@query
def _closure(db: Database, environment: Environment, tops: tuple[str, ...]) -> tuple[tuple[str, ...], bool]:
    found, waiting, whole = dict[str, None](), list(tops), True
    while waiting and len(found) < _MOST:
        path = waiting.pop()
        if path in found:
            continue
        found[path] = None
        inner, is_whole = included(db, environment, path)
        whole = whole and is_whole
        waiting += inner
    return tuple(found), whole and not waiting


@query
def defined_for(db: Database, environment: Environment, path: str) -> Defined:
    """What a file may use: what is defined by the files that include it, and by all that these include."""
    files, whole = _closure(db, environment, tops_of(db, environment, path))
    found = [xacro_file(db, each) for each in files]
    return Defined.of(filter(None, found), whole=whole and None not in found)


@query
def parts_for(db: Database, environment: Environment, path: str) -> tuple[tuple[Part, ...], bool]:
    """The links and joints of the robots that a file is of, each as it is written, and whether these are all."""
    files, whole = _closure(db, environment, tops_of(db, environment, path))
    found = [xacro_file(db, each) for each in files]
    return tuple(part for file in found if file is not None for part in file.parts), whole and None not in found


@query
def materials_for(db: Database, environment: Environment, path: str) -> tuple[frozenset[str], bool]:
    """The materials of the robots that a file is of, each as it is written, and whether these are all."""
    files, whole = _closure(db, environment, tops_of(db, environment, path))
    found = [xacro_file(db, each) for each in files]
    known = frozenset[str]().union(*(file.materials for file in found if file is not None))
    return known, whole and None not in found and not any(file is not None and file.open for file in found)


@query
def defined_anywhere(db: Database, environment: Environment) -> Defined:
    """What all files of the workspace define."""
    return Defined.of(filter(None, (xacro_file(db, each) for each in _all_files(db, environment))), whole=False)


def is_passed(db: Database, environment: Environment, name: str) -> bool:
    """Whether a file of the workspace has a name that may be an argument which it gives to xacro."""
    return name in _words(db, environment)


@query
def _words(db: Database, environment: Environment) -> frozenset[str]:
    disk, found = Disk(db), set[str]()
    for package in environment.own_packages:
        for path in files_in(disk, package.share, deep=True):
            text = disk.text(path) if path.endswith(_PASSING) else None
            if isinstance(text, Document):
                found.update(re.findall(r"\w+", text.text))
    return frozenset(found)


@query
def model_folders(db: Database, environment: Environment) -> Mapping[str, tuple[str, ...]]:
    """The folders of Gazebo's models in packages of the workspace, by their names."""
    found: dict[str, list[str]] = {}
    for package in environment.own_packages:
        for path in files_in(Disk(db), package.share, deep=True):
            if os.path.basename(path) == "model.config":
                folder = os.path.dirname(path)
                found.setdefault(os.path.basename(folder), []).append(folder)
    return {name: tuple(each) for name, each in found.items()}


def is_part(db: Database, environment: Environment, path: str) -> bool:
    """Whether a file is made to be included, and nobody of the workspace does so or who does is made for it, too:
    others may define what it asks for."""
    files = (xacro_file(db, each) for each in tops_of(db, environment, path))
    return not any(file is not None and _is_robot(file) for file in files)


def _is_robot(file: XacroFile) -> bool:
    root = file.document.root
    return root is not None and root.get("name") is not None


def may_be_other(db: Database, environment: Environment, path: str, around: Around) -> bool:
    """Whether what is defined for a place in a file may not be all: it is in a macro that others may call."""
    return bool(around.macro) or is_part(db, environment, path)


def doubts_of(around: Around, *, other: bool) -> tuple[Doubt, ...]:
    """Those about something that stands there in a file."""
    return doubts(OTHER_ARGUMENTS=around.conditional and not around.macro, UNSEEN=other)


def below_package(environment: Environment, path: str) -> str:
    """A path as a message shows it: with the folder of its package."""
    package = package_around(environment, path)
    if package is None:
        return path
    return os.path.join(os.path.basename(package.share.rstrip("/")), os.path.relpath(path, package.share))
