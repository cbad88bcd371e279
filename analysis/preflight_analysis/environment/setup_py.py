"""What a package of build type `ament_python` installs: its `setup.py`, `setup.cfg` and `pyproject.toml`, read as text.

https://docs.ros.org/en/rolling/How-To-Guides/Developing-a-ROS-2-Package.html#python-packages. Nothing is run: a small
part of Python is computed, what is beyond it makes the answer incomplete.
"""

from __future__ import annotations

import ast
import configparser
import fnmatch
import glob
import importlib
import os
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field
from typing import Any

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.package_files import module_file

_SCRIPTS_TO = {"install": "install_scripts", "develop": "script_dir"}
"""The option of each command of setuptools that says where scripts go."""
_TOML = "tomllib" if sys.version_info >= (3, 11) else "tomli"

_MAX_TEXT = 200_000
_MAX_FILES = 2_000
_MAX_ENTRIES = 20_000
"""Of folders, in which the patterns of one file look for names."""
_MAX_DOTS = 200
"""In a line of TOML."""
_MAX_STEPS = 20_000
"""Expressions that are computed of one file; loops within loops have no end otherwise."""
_MAX_SIZE = 100_000
"""Characters of a text or items of a list that an expression makes."""
_ROS_VERSION = re.compile(r"(?:os\.)?(?:environ\[|environ\.get\(|getenv\()'ROS_VERSION'(?:, [^(]*)?[])]")
"""How Python reads which ROS is built for; this is read of a package that ROS 2 builds."""
_FIELD = re.compile(r"(?:[^{}]|\{\w*\})*")
"""A text to format whose fields have neither a width nor an attribute."""
_BIG_NUMBER = re.compile(r"\d{4}|\*")
"""Of a `%` that would make its text that wide."""


@dataclass(frozen=True, slots=True)
class EntryPoint:
    """`name = module:function`; `file` is the source of the module, None if it is not there, `line` where `setup.py`
    says so (counted from 0)."""

    name: str
    module: str
    function: str
    file: str | None
    line: int = 0


@dataclass(frozen=True, slots=True)
class Copied:
    """A file that `data_files` names, as it is written, the folder below the prefix that it goes to, and where
    `setup.py` says so (counted from 0)."""

    destination: str
    source: str
    line: int


@dataclass(frozen=True, slots=True)
class Called:
    """What `setup()` is given, as far as it is known."""

    line: int
    """Of the call, counted from 0."""
    name: str | None = None
    entries: tuple[tuple[str, int], ...] = ()
    """The texts of `console_scripts`, and the line of each, counted from 0."""
    copied: tuple[Copied, ...] = ()
    modules: frozenset[str] | None = None
    """The packages and top modules that are installed, by their dotted names; None where they are not known."""
    finds: bool = False
    """Whether `find_packages` has looked for them."""
    scripts_to: Mapping[str, str] = field(default_factory=dict)
    """The folder of scripts below the prefix, by the command of setuptools: `install` or `develop`."""
    all_known: bool = True
    """Whether no keyword is given that cannot be read."""


@dataclass(frozen=True, slots=True)
class PythonBuild:
    """`scripts` are the executables that entry points make, by name, `programs` the files of those that are installed
    as they are. `data` maps what is installed below `share/<package>/` (relative paths)
    to the source. `complete`: all of the data files are known, so what is not in `data` is not installed;
    `all_programs`: likewise of `scripts` and `programs`."""

    scripts: Mapping[str, EntryPoint] = field(default_factory=dict)
    programs: Mapping[str, str] = field(default_factory=dict)
    data: Mapping[str, str] = field(default_factory=dict)
    all_programs: bool = True
    complete: bool = False
    file: str | None = None
    """The file that says so, where a fix goes."""
    called: Called | None = None
    """None without a call of `setup()`."""


def read_python_build(folder: str, package: str, disk: Disk) -> PythonBuild:
    """What is said in the package's folder. Never raises."""
    scripts: dict[str, EntryPoint] = {}
    data: dict[str, str] = {}
    setup = os.path.join(folder, "setup.py")
    text = disk.content(setup)
    found = _Setup(folder, text, disk) if text is not None else None
    complete = found is not None and found.complete
    file = setup if found is not None else None
    programs = list(found.programs) if found is not None else []
    for path, reader in (("setup.cfg", _from_cfg), ("pyproject.toml", _from_toml)):
        content = disk.content(os.path.join(folder, path))
        if content is not None:
            for name, target in reader(content).items():
                scripts[name] = _entry_point(folder, name, target, 0, disk)
    if found is not None:
        for name, (target, line) in found.scripts.items():
            scripts[name] = _entry_point(folder, name, target, line, disk)
        share, lib = f"share/{package}", f"lib/{package}"
        for destination, sources in found.data_files:
            where = os.path.normpath(destination)
            if where == lib or where.startswith(lib + "/"):
                programs += sources
            if where != share and not where.startswith(share + "/"):
                continue
            below = where[len(share) :].lstrip("/")
            for source in sources[:_MAX_FILES]:
                data[os.path.join(below, os.path.basename(source))] = os.path.normpath(os.path.join(folder, source))
    paths = (os.path.normpath(os.path.join(folder, program)) for program in programs[:_MAX_FILES])
    by_name = {os.path.basename(path): path for path in paths if disk.is_file(path)}
    called = found.called(_folders_from_cfg(disk.content(os.path.join(folder, "setup.cfg")))) if found else None
    all_programs = found is None or (found.all_programs and called is not None)
    return PythonBuild(scripts, by_name, data, all_programs, complete and called is not None, file, called)


def _entry_point(folder: str, name: str, target: str, line: int, disk: Disk) -> EntryPoint:
    module, _, function = target.partition(":")
    module, function = module.strip(), function.split("[")[0].strip()
    return EntryPoint(name, module, function, module_file(folder, module, disk), line)


def _from_cfg(text: str) -> dict[str, str]:
    parser = configparser.ConfigParser(interpolation=None, strict=False)
    try:
        parser.read_string(text)
        lines = parser.get("options.entry_points", "console_scripts", fallback="")
    except configparser.Error:
        return {}
    return dict(_scripts(lines.splitlines()))


def _folders_from_cfg(text: str | None) -> dict[str, str] | None:
    """Where scripts go, by command; None where that cannot be read."""
    parser = configparser.ConfigParser(interpolation=None, strict=False)
    try:
        parser.read_string(text or "")
        found: dict[str, str] = {}
        for command, option in _SCRIPTS_TO.items():
            section = (
                {key.replace("-", "_"): value for key, value in parser.items(command)} if command in parser else {}
            )
            if option in section:
                found[command] = _below_prefix(section[option])
    except configparser.Error:
        return None
    return found


def _below_prefix(folder: str) -> str:
    return os.path.normpath(folder.strip().removeprefix("$base").lstrip("/"))


def _from_toml(text: str) -> dict[str, str]:
    # The parser goes through a dotted key from its start for each of its names.
    if len(text) > _MAX_TEXT or any(line.count(".") > _MAX_DOTS for line in text.splitlines()):
        return {}
    try:
        scripts: Any = importlib.import_module(_TOML).loads(text).get("project", {}).get("scripts", {})
    except (ValueError, AttributeError, RecursionError):
        return {}
    if not isinstance(scripts, dict):
        return {}
    return {name: target for name, target in scripts.items() if isinstance(target, str) and ":" in target}


def _scripts(lines: list[str]) -> list[tuple[str, str]]:
    pairs = (line.split("=", 1) for line in lines if "=" in line and ":" in line)
    return [(name.strip(), target.strip()) for name, target in pairs]


def _variable(expression: str) -> str | None:
    """`ROS_VERSION`, as the set-up scripts of ROS 2 set it; None for any other expression."""
    return "2" if _ROS_VERSION.fullmatch(expression) else None


class _Unknown(Exception):  # noqa: N818 - what is not computed, not an error
    pass


class _Setup:
    """The call of `setup(...)`, its arguments computed as far as they are simple."""

    def __init__(self, folder: str, text: str, disk: Disk) -> None:
        self._folder = folder
        self._disk = disk
        self._names: dict[str, Any] = {}
        self.scripts: dict[str, tuple[str, int]] = {}
        self.data_files: list[tuple[str, list[str]]] = []
        self.programs: list[str] = []
        self._entries: list[tuple[str, int]] = []
        self._copied: list[Copied] = []
        self._modules: dict[str, list[str] | None] = {}
        self._given: dict[str, Any] = {}
        self._finds = False
        self._line: int | None = None
        self.all_programs = True
        self.complete = True
        self._steps = 0
        self._real = os.path.join(disk.real_path(folder), "")
        self._looked_at = 0
        try:
            tree = ast.parse(text[:_MAX_TEXT])
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            self.complete = False
            return
        for statement in tree.body:
            self._statement(statement)

    def _statement(self, statement: ast.stmt) -> None:
        if isinstance(statement, ast.Assign) and len(statement.targets) == 1:
            target = statement.targets[0]
            if isinstance(target, ast.Name):
                self._assign(target.id, statement.value)
            if isinstance(statement.value, ast.Call):
                self._call(statement.value)
        elif isinstance(statement, ast.AugAssign) and isinstance(statement.target, ast.Name):
            self._augment(statement)
        elif isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Call):
            self._call(statement.value)
        elif isinstance(statement, ast.If):
            self._choice(statement)
        elif isinstance(statement, (ast.For, ast.While, ast.FunctionDef, ast.With, ast.Try)):
            # What a loop adds to the data files is not known; that it adds is.
            self.complete = False
            for inner in ast.walk(statement):
                if isinstance(inner, ast.Call):
                    self._call(inner)

    def _choice(self, statement: ast.If) -> None:
        """The branch that is taken; both where that is not known."""
        try:
            branches = [statement.body if self._value(statement.test) else statement.orelse]
        except (_Unknown, RecursionError):
            branches = [statement.body, statement.orelse]
            self.complete = False
        for branch in branches:
            for inner in branch:
                self._statement(inner)

    def _assign(self, name: str, value: ast.expr) -> None:
        try:
            self._names[name] = self._value(value)
        except (_Unknown, RecursionError):
            self._names.pop(name, None)

    def _augment(self, statement: ast.AugAssign) -> None:
        assert isinstance(statement.target, ast.Name)
        try:
            self._names[statement.target.id] = self._names[statement.target.id] + self._value(statement.value)
        except (_Unknown, KeyError, TypeError, RecursionError):
            self._names.pop(statement.target.id, None)
            self.complete = False

    def _call(self, call: ast.Call) -> None:
        name = call.func.id if isinstance(call.func, ast.Name) else getattr(call.func, "attr", "")
        if name in ("append", "extend") and isinstance(call.func, ast.Attribute):
            self._append(call, name)
        if name != "setup":
            return
        self._line = call.lineno - 1
        for keyword in call.keywords:
            if keyword.arg in ("packages", "py_modules"):
                self._modules[keyword.arg] = self._names_of(keyword.value)
            elif keyword.arg in ("name", "options"):
                self._given[keyword.arg] = self._known(keyword.value)
            elif keyword.arg == "entry_points":
                self._entry_points(keyword.value)
            elif keyword.arg == "scripts":
                self._programs(keyword.value)
            elif keyword.arg == "data_files":
                self._data_files(keyword.value)
            elif keyword.arg is None:
                self.complete = self.all_programs = False

    def called(self, scripts_to: Mapping[str, str] | None) -> Called | None:
        """What `setup()` was called with; `scripts_to` is what `setup.cfg` says."""
        if self._line is None:
            return None
        given, name = self._given.get("options", {}), self._given.get("name")
        known = scripts_to is not None and isinstance(given, dict)
        folders = dict(scripts_to or {})
        for command, option in _SCRIPTS_TO.items() if isinstance(given, dict) else ():
            options = given.get(command)
            if isinstance(options, dict) and isinstance(options.get(option), str):
                folders[command] = _below_prefix(options[option])
        modules = frozenset[str]() if "packages" in self._modules else None
        for names in self._modules.values():
            modules = modules | frozenset(names) if modules is not None and names is not None else None
        return Called(
            self._line,
            name if isinstance(name, str) else None,
            tuple(self._entries),
            tuple(self._copied),
            modules,
            self._finds,
            folders,
            known and self.all_programs,
        )

    def _known(self, node: ast.expr) -> Any:
        try:
            return self._value(node)
        except (_Unknown, RecursionError):
            return None

    def _names_of(self, node: ast.expr) -> list[str] | None:
        value = self._known(node)
        whole = isinstance(value, (list, tuple)) and all(isinstance(each, str) for each in value)
        return list(value) if whole else None

    def _programs(self, node: ast.expr) -> None:
        try:
            value = self._value(node)
        except (_Unknown, RecursionError):
            self.all_programs = False
            return
        self.programs += [path for path in value if isinstance(path, str)] if isinstance(value, (list, tuple)) else []

    def _append(self, call: ast.Call, method: str) -> None:
        target = call.func.value if isinstance(call.func, ast.Attribute) else None
        known = self._names.get(target.id) if isinstance(target, ast.Name) else None
        if isinstance(known, list) and len(call.args) == 1:
            try:
                value = self._value(call.args[0])
                known.extend(value if method == "extend" else [value])
                return
            except (_Unknown, TypeError, RecursionError):
                pass
        self.complete = False

    def _entry_points(self, node: ast.expr) -> None:
        lists: list[ast.expr] = []
        self.all_programs = self.all_programs and isinstance(node, ast.Dict)
        if isinstance(node, ast.Dict):
            for key, value in zip(node.keys, node.values, strict=True):
                if isinstance(key, ast.Constant) and key.value == "console_scripts":
                    lists.append(value)
        for each in lists:
            items = each.elts if isinstance(each, (ast.List, ast.Tuple)) else [each]
            for item in items:
                try:
                    value = self._value(item)
                except (_Unknown, RecursionError):
                    self.all_programs = False
                    continue
                lines = [v for v in value if isinstance(v, str)] if isinstance(value, list) else str(value).splitlines()
                self._entries += [(line, item.lineno - 1) for line in lines if line.strip()]
                for name, target in _scripts(lines):
                    self.scripts[name] = (target, item.lineno - 1)

    def _data_files(self, node: ast.expr) -> None:
        items: list[Any] = []
        try:
            items = list(self._value(node))
        except (_Unknown, TypeError, RecursionError):
            self.complete = False
            for element in getattr(node, "elts", []):
                try:
                    items.append(self._value(element))
                except (_Unknown, RecursionError):
                    continue
        elements = getattr(node, "elts", [])
        lines = (
            [each.lineno - 1 for each in elements] if len(elements) == len(items) else [node.lineno - 1] * len(items)
        )
        for item, line in zip(items, lines, strict=True):
            if isinstance(item, (tuple, list)) and len(item) == 2 and isinstance(item[0], str):
                sources = [s for s in item[1] if isinstance(s, str)] if isinstance(item[1], (list, tuple)) else []
                self.data_files.append((item[0], sources))
                self._copied += [Copied(os.path.normpath(item[0]), source, line) for source in sources[:_MAX_FILES]]
            else:
                self.complete = False

    def _value(self, node: ast.expr) -> Any:
        self._steps += 1
        if self._steps > _MAX_STEPS:
            raise _Unknown
        value = self._computed(node)
        if isinstance(value, (str, list, tuple)) and len(value) > _MAX_SIZE:
            raise _Unknown
        return value

    def _computed(self, node: ast.expr) -> Any:
        match node:
            case ast.Constant(value=value) if isinstance(value, (str, int, float, bool)):
                return value
            case ast.Name(id=name) if name in self._names:
                return self._names[name]
            case ast.Name(id="__name__"):
                return "__main__"
            case ast.Subscript(slice=ast.Constant(value="ROS_VERSION")):
                return _variable(ast.unparse(node))
            case ast.Compare(left=left, ops=[ast.Eq() | ast.NotEq() as operator], comparators=[right]):
                return (self._value(left) == self._value(right)) is isinstance(operator, ast.Eq)
            case ast.Call(func=ast.Attribute(value=ast.Constant(value=str()) | ast.Name() as form, attr="format")):
                return self._formatted(self._value(form), node)
            case ast.JoinedStr(values=parts):
                return "".join(str(self._value(p.value if isinstance(p, ast.FormattedValue) else p)) for p in parts)
            case ast.List(elts=elements):
                return [self._value(element) for element in elements]
            case ast.Dict(keys=keys, values=values):
                if not all(isinstance(key, ast.Constant) for key in keys):
                    raise _Unknown
                return {self._value(k): self._value(v) for k, v in zip(keys, values, strict=True) if k is not None}
            case ast.Tuple(elts=elements):
                return tuple(self._value(element) for element in elements)
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                try:
                    return self._value(left) + self._value(right)
                except TypeError:
                    raise _Unknown from None
            case ast.BinOp(left=left, op=ast.Mod(), right=right):
                try:
                    form = self._value(left)
                    if isinstance(form, str) and _BIG_NUMBER.search(form):
                        raise _Unknown
                    return form % self._value(right)
                except (TypeError, ValueError, ArithmeticError):
                    raise _Unknown from None
            case ast.Call(func=function, args=args):
                return self._called(ast.unparse(function), args, node)
            case ast.ListComp(
                elt=element, generators=[ast.comprehension(target=ast.Name(id=name), iter=items, ifs=[])]
            ):
                return self._comprehension(element, name, items)
        raise _Unknown

    def _comprehension(self, element: ast.expr, name: str, items: ast.expr) -> list[Any]:
        values = self._value(items)
        if not isinstance(values, (list, tuple)) or len(values) > _MAX_FILES:
            raise _Unknown
        before = dict(self._names)
        found = []
        for value in values:
            self._names[name] = value
            found.append(self._value(element))
        self._names = before
        return found

    def _formatted(self, form: Any, call: ast.Call) -> str:
        values = [self._value(arg) for arg in call.args]
        named = {keyword.arg: self._value(keyword.value) for keyword in call.keywords if keyword.arg is not None}
        simple = isinstance(form, str) and _FIELD.fullmatch(form) and len(named) == len(call.keywords)
        try:
            if not simple or len(form) * max(map(len, (*values, *named.values())), default=0) > _MAX_SIZE:
                raise _Unknown
            return str(form.format(*values, **named))
        except (TypeError, ValueError, LookupError):
            raise _Unknown from None

    def _called(self, name: str, args: list[ast.expr], call: ast.Call) -> Any:
        if (variable := _variable(ast.unparse(call))) is not None:
            return variable
        if name.rpartition(".")[2] == "find_packages":
            return self._found_packages(args, call)
        values = [self._value(arg) for arg in args]
        texts = [value for value in values if isinstance(value, str)]
        if name in ("os.path.join", "join", "path.join") and texts and len(texts) == len(values):
            return os.path.join(*texts)
        if name in ("glob", "glob.glob", "iglob", "glob.iglob") and len(texts) == 1:
            recursive = any(k.arg == "recursive" for k in call.keywords)
            return self._glob(texts[0], recursive)
        if name in ("str", "os.path.basename") and len(texts) == 1:
            return texts[0] if name == "str" else os.path.basename(texts[0])
        if name == "int" and texts in (["1"], ["2"]):
            return int(texts[0])
        if name in ("list", "sorted") and len(values) == 1 and isinstance(values[0], (list, tuple)):
            return list(values[0])
        raise _Unknown

    def _found_packages(self, args: list[ast.expr], call: ast.Call) -> list[str]:
        """What setuptools' `find_packages(where, exclude, include)` gives."""
        given = dict(zip(("where", "exclude", "include"), args, strict=False))
        given |= {keyword.arg or "": keyword.value for keyword in call.keywords}
        values = {name: self._value(value) for name, value in given.items()}
        where = values.pop("where", ".")
        if not isinstance(where, str) or not {*values} <= {"exclude", "include"} or ".." in where.split("/"):
            raise _Unknown
        self._finds = True
        include, exclude = values.get("include", ("*",)), values.get("exclude", ())
        for patterns in (include, exclude):
            if not isinstance(patterns, (list, tuple)) or not all(isinstance(each, str) for each in patterns):
                raise _Unknown
        found, pending = list[str](), [(os.path.normpath(os.path.join(self._folder, where)), "")]
        while pending:
            folder, package = pending.pop()
            for name, is_folder in self._listed(folder):
                path, full = os.path.join(folder, name), f"{package}.{name}".lstrip(".")
                if is_folder and "." not in name and self._disk.is_file(os.path.join(path, "__init__.py")):
                    pending.append((path, full))
                    if _matches(full, include) and not _matches(full, exclude):
                        found.append(full)
        return found

    def _glob(self, pattern: str, recursive: bool) -> list[str]:
        if os.path.isabs(pattern) or ".." in pattern.split("/"):
            raise _Unknown
        return sorted(set(self._below("", pattern.split("/"), recursive)))

    def _below(self, folder: str, pattern: list[str], recursive: bool) -> Iterator[str]:
        """What `glob` gives for a pattern in a folder of the package, without going through links out of it."""
        first, *rest = pattern
        here = os.path.join(self._folder, folder)
        if first != "" and not glob.has_magic(first):
            if rest and self._disk.is_folder(os.path.join(here, first)):
                yield from self._below(os.path.join(folder, first), rest, recursive)
            elif not rest and self._disk.exists(os.path.join(here, first)):
                yield os.path.join(folder, first)
            return
        if first == "":  # a slash at the end, or two
            if rest:
                yield from self._below(folder, rest, recursive)
            elif folder and self._disk.is_folder(here):
                yield os.path.join(folder, "")
            return
        any_depth = recursive and first == "**"
        if any_depth:
            yield from self._below(folder, rest, recursive) if rest else ([os.path.join(folder, "")] if folder else [])
        for name, is_folder in self._listed(here):
            if name.startswith(".") and not first.startswith("."):
                continue
            path = os.path.join(folder, name)
            if any_depth:
                if is_folder:
                    yield from self._below(path, pattern, recursive)
                elif not rest:
                    yield path
            elif fnmatch.fnmatchcase(name, first):
                if not rest:
                    yield path
                elif is_folder:
                    yield from self._below(path, rest, recursive)

    def _listed(self, folder: str) -> list[tuple[str, bool]]:
        """The names in a folder of the package, and which are folders; raises `_Unknown` when there are too many."""
        if not os.path.join(self._disk.real_path(folder), "").startswith(self._real):
            return []
        names = self._disk.names(folder)
        self._looked_at += len(names)
        if self._looked_at > _MAX_ENTRIES:
            raise _Unknown
        return [(name, self._disk.is_folder(os.path.join(folder, name))) for name in names]


def _matches(name: str, patterns: Iterable[str]) -> bool:
    return any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)
