"""What a package builds and installs, as its `CMakeLists.txt` says. CMake itself is not run.

All branches of a condition count, but for those of other platforms; a loop over known items is gone through, macros and
functions of the file are followed. A variable that nothing sets is empty, as in CMake, so is one whose value only CMake
would know.
"""

from __future__ import annotations

import contextlib
import fnmatch
import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

from preflight_analysis.environment.walk import walk

LISTS = "CMakeLists.txt"
_MAX_COMMANDS = 20_000
_MAX_DEPTH = 20
_MAX_TEXT = 100_000
_MAX_FILES = 2_000
_SOURCES = (".cpp", ".cc", ".cxx", ".c++", ".C", ".c", ".cu")
_TOKEN = re.compile(
    r"""\#\[(?P<mark>=*)\[.*?\](?P=mark)\]      # bracket comment
      | \#[^\n]*
      | \[(?P<equals>=*)\[(?P<bracket>.*?)\](?P=equals)\]
      | "(?P<quoted>(?:[^"\\]|\\.)*)"
      | (?P<paren>[()])
      | (?P<word>(?:[^\s()#"\\]|\\.)+)
    """,
    re.DOTALL | re.VERBOSE,
)
_VARIABLE = re.compile(r"\$\{([^${}]*)\}")
_ENDS = {"foreach": "endforeach", "macro": "endmacro", "function": "endfunction", "if": "endif"}
_BRANCHES = ("else", "elseif")
_PLATFORM = {"UNIX": True} | dict.fromkeys(("WIN32", "APPLE", "MSVC", "ANDROID", "CYGWIN", "MINGW"), False)
"""Conditions whose value is known: what robots run on is Linux."""
_INSTALLS_NOTHING = re.compile(
    r"(?:ament|catkin|check|cmake|cuda|find|get|gtest|include|link|pkg|pluginlib|pybind11|python|qt[456]?"
    r"|rclcpp|roslaunch|roslint|rosidl|set|target|test|try|xacro)_\w+"
    r"|add_(?:compile|custom|definitions|dependencies|executable|library|link|subdirectory|test)\w*"
    r"|generate_(?:export_header|parameter_library|parameter_module)"
    r"|(?:autoware|nav2)_package|aux_source_directory|block|break|configure_file|continue|define_property|enable_\w+"
    r"|endblock|endwhile|execute_process|export|file|include|install|list|mark_as_advanced|math|message|option|package"
    r"|project|return|separate_arguments|set|string|source_group|unset|while"
)
"""Commands that are known to install no launch or parameter file, or are followed."""
_FOLDERS = {
    "CMAKE_INSTALL_PREFIX": "",
    "CMAKE_INSTALL_BINDIR": "bin",
    "CMAKE_INSTALL_DATADIR": "share",
    "CMAKE_INSTALL_DATAROOTDIR": "share",
    "CMAKE_INSTALL_INCLUDEDIR": "include",
    "CMAKE_INSTALL_LIBDIR": "lib",
}
"""Variables that CMake sets, as they are in a ROS workspace; GNUInstallDirs' among them."""
_LINK_WORDS = frozenset("PUBLIC PRIVATE INTERFACE LINK_PUBLIC LINK_PRIVATE debug optimized general".split())  # noqa: SIM905
_NO_SOURCES = frozenset(
    "WIN32 MACOSX_BUNDLE EXCLUDE_FROM_ALL STATIC SHARED MODULE OBJECT PUBLIC PRIVATE INTERFACE".split()  # noqa: SIM905
)
_PLACES = frozenset("TYPE DESTINATION PERMISSIONS CONFIGURATIONS COMPONENT OPTIONAL RENAME EXCLUDE_FROM_ALL".split())  # noqa: SIM905

Read = Callable[[str], "str | None"]
"""The text of a file, None if there is none that can be read."""


@dataclass(frozen=True, slots=True)
class Target:
    """An executable or a library. `output` is the name of its file, of a library without `lib` and ending."""

    name: str
    kind: Literal["executable", "library"]
    output: str
    sources: tuple[str, ...]
    links: tuple[str, ...] = ()
    """What it is linked with: names of targets of the package and others."""


@dataclass(frozen=True, slots=True)
class Program:
    """A script that is installed. `relayed`: a build makes it known already, by a file in the devel space."""

    path: str
    relayed: bool


@dataclass(frozen=True, slots=True)
class Installed:
    """A file or folder that is installed, and the folder below the prefix in which it then is."""

    source: str
    destination: str
    name: str
    """What it is called there; "" where only what is in the folder is installed."""


@dataclass(frozen=True, slots=True)
class Made:
    """Where an executable comes from: the file in the source, and whether `catkin_make` makes it known already or
    only `install` does."""

    source: str
    by_build: bool


@dataclass(frozen=True, slots=True)
class Build:
    """What one package builds and installs."""

    targets: Mapping[str, Target] = field(default_factory=dict)
    programs: Mapping[str, Program] = field(default_factory=dict)
    """Scripts by the name they get."""
    installed: tuple[Installed, ...] = ()
    """Files and folders other than programs and targets."""
    components: Mapping[str, str] = field(default_factory=dict)
    """Library by the class of each rclcpp component that it registers."""
    parameter_libraries: Mapping[str, str] = field(default_factory=dict)
    """The YAML file of each library of generate_parameter_library, by the name that its header has."""
    component_programs: Mapping[str, str] = field(default_factory=dict)
    """The class of the one component that an executable is made to run, by the name of the executable."""
    complete: bool = False
    """Whether all that it installs is known: no command that is not known here may install more."""

    def executable(self, name: str) -> Target | None:
        """The target whose file has this name."""
        return next((t for t in self.targets.values() if t.kind == "executable" and t.output == name), None)

    def made_of(self, name: str) -> Made | None:
        """What the executable of this name is made of."""
        target = self.executable(name)
        if target is not None:
            likely = sorted(target.sources, key=lambda path: _stem(path) not in (name.lower(), "main"))
            return Made(likely[0], True) if likely else None
        program = self.programs.get(name)
        return Made(program.path, program.relayed) if program is not None else None

    def library(self, name: str) -> Target | None:
        """The library whose file is `lib<name>.so` (the `lib` may stand in `name`)."""
        stem = name.removesuffix(".so")
        for output in (stem, stem.removeprefix("lib")):
            for target in self.targets.values():
                if target.kind == "library" and target.output == output:
                    return target
        return None

    def sources(self, target: Target) -> tuple[str, ...]:
        """The sources of a target and of the libraries of the package that it is linked with, its own first."""
        found: dict[str, None] = {}
        pending, seen = [target], {target.name}
        while pending:
            current = pending.pop(0)
            found.update(dict.fromkeys(current.sources))
            for link in current.links:
                if link in self.targets and link not in seen:
                    seen.add(link)
                    pending.append(self.targets[link])
        return tuple(found)


def read_build(folder: str, package: str, read: Read) -> Build:
    """What the `CMakeLists.txt` of the package in `folder` says. Nothing raises; what is not understood is left out."""
    lists = _Lists(folder, read)
    complete = False
    with contextlib.suppress(_TooLargeError):
        complete = lists.folder(folder, {**_FOLDERS, "PROJECT_NAME": package}, 0)
    return replace(lists.build(), complete=complete and lists.complete)


class _TooLargeError(Exception):
    """More than is looked at."""


@dataclass(frozen=True, slots=True)
class _Word:
    text: str
    quoted: bool = False


@dataclass(frozen=True, slots=True)
class _Command:
    name: str
    words: tuple[_Word, ...]
    inner: tuple[_Command, ...] = ()
    """What stands between an `if`, `foreach`, `macro` or `function` and its end."""


def _commands(text: str) -> tuple[_Command, ...]:
    flat = iter(list(_flat(text)))
    return _nested(flat, None, 0)


def _flat(text: str) -> Iterator[_Command]:
    name: str | None = None
    words: list[_Word] = []
    depth = 0
    for token in _TOKEN.finditer(text):
        paren, word = token["paren"], token["word"]
        if paren == "(":
            depth += 1
        elif paren == ")":
            depth = max(depth - 1, 0)
            if not depth and name is not None:
                yield _Command(name, tuple(words))
                name, words = None, []
        elif word is not None and not depth:
            name, words = word.lower(), []
        elif word is not None:
            words.append(_Word(word))
        elif token["quoted"] is not None:
            words.append(_Word(re.sub(r"\\(.)", r"\1", token["quoted"]), True))
        elif token["bracket"] is not None:
            words.append(_Word(token["bracket"], True))


def _nested(flat: Iterator[_Command], end: str | None, depth: int) -> tuple[_Command, ...]:
    found: list[_Command] = []
    for command in flat:
        if command.name == end:
            break
        if command.name in _ENDS and depth < _MAX_DEPTH:
            inner = _nested(flat, _ENDS[command.name], depth + 1)
            found.append(_Command(command.name, command.words, inner))
        else:
            found.append(command)
    return tuple(found)


@dataclass(slots=True)
class _Making:
    """A target as far as it is known."""

    name: str
    kind: Literal["executable", "library"]
    sources: list[str]
    links: list[str] = field(default_factory=list)
    output: str | None = None


class _Lists:
    def __init__(self, top: str, read: Read) -> None:
        self._top = top
        self._read = read
        self._targets: dict[str, _Making] = {}
        self._programs: dict[str, Program] = {}
        self._installed: list[Installed] = []
        self._components: dict[str, str] = {}
        self._component_programs: dict[str, str] = {}
        self._parameter_libraries: dict[str, str] = {}
        self._macros: dict[str, _Command] = {}
        self._left = _MAX_COMMANDS
        self.complete = True
        """Whether nothing was met that may install more than is known."""

    def build(self) -> Build:
        return Build(
            {
                t.name: Target(t.name, t.kind, t.output or t.name, tuple(dict.fromkeys(t.sources)), tuple(t.links))
                for t in self._targets.values()
            },
            self._programs,
            tuple(self._installed),
            self._components,
            self._parameter_libraries,
            self._component_programs,
        )

    def folder(self, folder: str, variables: Mapping[str, str], depth: int) -> bool:
        """Whether there is something to read in the folder."""
        text = self._read(os.path.join(folder, LISTS)) if depth < _MAX_DEPTH else None
        if text is None:
            return False
        here = {"CMAKE_CURRENT_SOURCE_DIR": folder, "CMAKE_CURRENT_LIST_DIR": folder}
        above = {"CMAKE_SOURCE_DIR": self._top, "PROJECT_SOURCE_DIR": self._top, **variables}
        self._block(_commands(text), {**above, **here}, depth + 1)
        return True

    def _block(self, commands: Sequence[_Command], variables: dict[str, str], depth: int) -> None:
        for command in commands:
            self._left -= 1
            if self._left < 0:
                raise _TooLargeError
            if command.name == "foreach":
                self._foreach(command, variables, depth)
            elif command.name == "if":
                self._if(command, variables, depth)
            elif command.name in ("macro", "function"):
                if command.words:
                    self._macros[_expanded(command.words[0].text, variables).lower()] = command
            else:
                if command.name == "install" and any(map(_is_only_known_to_cmake(variables), command.words)):
                    self.complete = False
                self._command(command.name, _words(command.words, variables), variables, depth)

    def _if(self, command: _Command, variables: dict[str, str], depth: int) -> None:
        """All branches, unless a condition says that it is for another platform."""
        condition, branch = command.words, []
        for each in (*command.inner, None):
            if each is not None and each.name not in _BRANCHES:
                branch.append(each)
                continue
            known = _known(condition)
            if known is not False:
                self._block(branch, variables, depth + 1)
            if known or each is None:
                break
            condition, branch = each.words if each.name == "elseif" else (), []

    def _foreach(self, command: _Command, variables: dict[str, str], depth: int) -> None:
        words = _words(command.words, variables)
        if not words or depth >= _MAX_DEPTH:
            return
        name, items = words[0], words[1:]
        if "RANGE" in items[:1]:
            return
        if items[:2] == ["IN", "LISTS"]:
            items = [item for word in items[2:] for item in variables.get(word, word).split(";")]
        elif items[:2] == ["IN", "ITEMS"]:
            items = items[2:]
        for item in items:
            variables[name] = item
            self._block(command.inner, variables, depth + 1)
        variables.pop(name, None)

    def _command(self, name: str, words: list[str], variables: dict[str, str], depth: int) -> None:
        folder = variables["CMAKE_CURRENT_SOURCE_DIR"]
        if name in self._macros:
            self._called(self._macros[name], words, variables, depth)
            return
        match (
            name.removeprefix("ament_auto_").removeprefix("cuda_").removeprefix("rosbuild_").removeprefix("qt5_"),
            words,
        ):
            case "project", [project, *_]:
                variables["PROJECT_NAME"] = project
                variables["PROJECT_SOURCE_DIR"] = variables[f"{project}_SOURCE_DIR"] = folder
                if folder == self._top:
                    variables["CMAKE_PROJECT_NAME"] = project
            case "cmake_parse_arguments", [prefix, options, ones, many, *given]:
                variables.update(_parsed(prefix, options, ones, many, given))
            case "set", [variable, *values]:
                if "CACHE" in values:
                    values = values[: values.index("CACHE")]
                    if variable in variables:
                        return
                variables[variable] = _joined(v for v in values if v != "PARENT_SCOPE")
            case "list", ["APPEND" | "PREPEND", variable, *values]:
                variables[variable] = _joined([variables.get(variable, ""), *values])
            case "file", ["GLOB" | "GLOB_RECURSE" as how, variable, *patterns]:
                variables[variable] = _joined(_globbed(patterns, folder, how == "GLOB_RECURSE"))
            case "aux_source_directory", [where, variable, *_]:
                patterns = [os.path.join(where, f"*{ending}") for ending in _SOURCES]
                found = _globbed(patterns, folder, False)
                variables[variable] = _joined([variables.get(variable, ""), *found])
            case ("add_executable" | "add_library") as kind, [target, *rest]:
                self._target(target, "executable" if kind == "add_executable" else "library", rest, folder)
            case "target_sources", [target, *rest] if target in self._targets:
                self._targets[target].sources += _files(rest, folder)
            case "target_link_libraries", [target, *rest] if target in self._targets:
                self._targets[target].links += [word for word in rest if word not in _LINK_WORDS]
            case "set_target_properties", [*targets, "OUTPUT_NAME", output] if "PROPERTIES" in targets:
                self._outputs(targets[: targets.index("PROPERTIES")], output)
            case "set_target_properties", _ if "PROPERTIES" in words and "OUTPUT_NAME" in words[:-1]:
                self._outputs(words[: words.index("PROPERTIES")], words[words.index("OUTPUT_NAME") + 1])
            case "set_property", ["TARGET", *rest] if "OUTPUT_NAME" in rest[:-1] and "PROPERTY" in rest:
                self._outputs(rest[: rest.index("PROPERTY")], rest[rest.index("OUTPUT_NAME") + 1])
            case (("install" | "catkin_install_python"), ["PROGRAMS", *rest]):
                self._install(rest, folder, relayed=name == "catkin_install_python")
            case "install", [("DIRECTORY" | "FILES") as kind, *rest] if "DESTINATION" in rest[:-1]:
                self._data(rest, folder, whole=kind == "DIRECTORY")
            case "install", ["TARGETS" | "EXPORT", *_]:
                pass
            case "package", [*_] if "INSTALL_TO_SHARE" in words:  # ament_auto_package
                folders = words[words.index("INSTALL_TO_SHARE") + 1 :]
                self._data([*folders, "DESTINATION", "share/${PROJECT_NAME}"], folder, whole=True)
            case "rclcpp_components_register_node", [target, *rest] if "PLUGIN" in rest[:-1]:
                self._component(target, rest)
            case "rclcpp_components_register_nodes", [target, *plugins]:
                self._components.update(dict.fromkeys(plugins, target))
            case "generate_parameter_library", [library, file, *_]:
                self._parameter_libraries[library] = os.path.normpath(os.path.join(folder, file))
            case "add_subdirectory", [below, *_]:
                self.folder(os.path.normpath(os.path.join(folder, below)), variables, depth)
            case "include", [file, *_] if file.endswith(".cmake"):
                self._include(os.path.normpath(os.path.join(folder, file)), variables, depth)
            case _:
                if name == "install" or not _INSTALLS_NOTHING.fullmatch(name):
                    self.complete = False

    def _include(self, path: str, variables: dict[str, str], depth: int) -> None:
        text = self._read(path) if path.startswith(self._top + os.sep) and depth < _MAX_DEPTH else None
        if text is None:
            self.complete = False
            return
        before = variables["CMAKE_CURRENT_LIST_DIR"]
        variables["CMAKE_CURRENT_LIST_DIR"] = os.path.dirname(path)
        self._block(_commands(text), variables, depth + 1)
        variables["CMAKE_CURRENT_LIST_DIR"] = before

    def _called(self, macro: _Command, words: list[str], variables: dict[str, str], depth: int) -> None:
        if depth >= _MAX_DEPTH:
            return
        names = [word.text for word in macro.words[1:]]
        given = dict(zip(names, [*words, *[""] * len(names)], strict=False))
        given |= {"ARGN": _joined(words[len(names) :]), "ARGV": _joined(words)}
        given |= {f"ARGV{index}": word for index, word in enumerate(words)}
        scope = {**variables, **given}
        self._block(macro.inner, scope, depth + 1)
        if macro.name == "macro":
            variables.update({name: value for name, value in scope.items() if name not in given})

    def _target(self, name: str, kind: Literal["executable", "library"], rest: Sequence[str], folder: str) -> None:
        if not name or any(word in ("ALIAS", "IMPORTED") for word in rest[:2]):
            return
        made = self._targets.setdefault(name, _Making(name, kind, []))
        if "DIRECTORY" in rest:  # of ament_auto_add_library and ament_auto_add_executable: all that is in the folders
            at = rest.index("DIRECTORY")
            patterns = [os.path.join(each, f"*{ending}") for each in rest[at + 1 :] for ending in _SOURCES]
            made.sources += _globbed(patterns, folder, False)
            rest = rest[:at]
        made.sources += _files(rest, folder)

    def _outputs(self, targets: Sequence[str], output: str) -> None:
        for name in targets:
            if name in self._targets and output:
                self._targets[name].output = output

    def _component(self, target: str, words: Sequence[str]) -> None:
        """A component that has an executable of its own as well."""
        plugin = words[words.index("PLUGIN") + 1]
        self._components[plugin] = target
        if "EXECUTABLE" in words[:-1] and target in self._targets:
            name = words[words.index("EXECUTABLE") + 1]
            self._component_programs[name] = plugin
            self._targets.setdefault(name, _Making(name, "executable", list(self._targets[target].sources), [target]))

    def _data(self, words: Sequence[str], folder: str, *, whole: bool) -> None:
        destination = words[words.index("DESTINATION") + 1]
        end = next((index for index, word in enumerate(words) if word in _PLACES), len(words))
        renamed = words[words.index("RENAME") + 1] if "RENAME" in words[:-1] else None
        for word in words[:end]:
            path = os.path.normpath(os.path.join(folder, word))
            # A folder with a slash at its end stands for what is in it.
            name = "" if whole and word.endswith("/") else renamed or os.path.basename(path)
            self._installed.append(Installed(path, destination, name))

    def _install(self, words: Sequence[str], folder: str, relayed: bool) -> None:
        end = next((index for index, word in enumerate(words) if word in _PLACES), len(words))
        files, rest = words[:end], list(words[end:])
        renamed = rest[rest.index("RENAME") + 1] if "RENAME" in rest[:-1] else None
        if "DESTINATION" in rest[:-1]:  # launch files that are programs are installed like others
            self._data(words, folder, whole=False)
        for file in files:
            path = os.path.normpath(os.path.join(folder, file))
            self._programs.setdefault(renamed or os.path.basename(path), Program(path, relayed))


def _known(condition: Sequence[_Word]) -> bool | None:
    """Whether a condition holds; None where that depends on more than the platform. Without one it is an `else`."""
    words = [word.text for word in condition]
    negated = words[:1] == ["NOT"]
    if not words or len(words) != 1 + negated or words[-1] not in _PLATFORM:
        return None
    return _PLATFORM[words[-1]] is not negated


def _is_only_known_to_cmake(variables: Mapping[str, str]) -> Callable[[_Word], bool]:
    return lambda word: any(name not in variables for name in _VARIABLE.findall(word.text))


def _stem(path: str) -> str:
    return os.path.splitext(os.path.basename(path))[0].lower()


def _words(words: Sequence[_Word], variables: Mapping[str, str]) -> list[str]:
    found: list[str] = []
    for word in words:
        text = _expanded(word.text, variables)
        found += [text] if word.quoted else [part for part in text.split(";") if part]
    return found


def _expanded(text: str, variables: Mapping[str, str]) -> str:
    for _ in range(_MAX_DEPTH):
        if "${" not in text:
            break
        new = _VARIABLE.sub(lambda found: variables.get(found[1], ""), text)
        if new == text:
            break
        text = new[:_MAX_TEXT]
    return text


def _parsed(prefix: str, options: str, ones: str, many: str, given: Sequence[str]) -> dict[str, str]:
    """What `cmake_parse_arguments` sets: each keyword's words, under its name with the prefix."""
    keywords = dict.fromkeys(options.split(";"), 0) | dict.fromkeys(ones.split(";"), 1)
    keywords |= dict.fromkeys(many.split(";"), _MAX_COMMANDS)
    found: dict[str, list[str]] = {word: [] for word in keywords if word}
    current, left = "", 0
    for word in given:
        if word in found:
            current, left = word, keywords[word]
            found[word] = found[word] if left else ["TRUE"]
        elif left:
            found[current].append(word)
            left -= 1
    return {f"{prefix}_{word}": _joined(words) for word, words in found.items()}


def _joined(values: Sequence[str] | Iterator[str]) -> str:
    return ";".join(value for value in values if value)[:_MAX_TEXT]


def _files(words: Sequence[str], folder: str) -> list[str]:
    found: list[str] = []
    for word in words:
        path = os.path.normpath(os.path.join(folder, word))
        if word in _NO_SOURCES or "$<" in word:
            continue
        if word.endswith(_SOURCES):
            found.append(path)
        elif not os.path.splitext(word)[1]:  # CMake tries the endings that it knows
            found += [path + ending for ending in _SOURCES if os.path.isfile(path + ending)][:1]
    return found


def _globbed(patterns: Sequence[str], folder: str, deep: bool) -> list[str]:
    found: list[str] = []
    wanted = [p for p in patterns if p not in ("CONFIGURE_DEPENDS", "FOLLOW_SYMLINKS", "RELATIVE", "LIST_DIRECTORIES")]
    for pattern in wanted:
        top, name = os.path.split(os.path.normpath(os.path.join(folder, pattern)))
        if not name or any(mark in top for mark in "*?["):
            continue
        seen = 0
        for place, folders, files in walk(top):
            found += sorted(os.path.join(place, file) for file in files if fnmatch.fnmatchcase(file, name))
            seen += len(files)
            if not deep or seen > _MAX_FILES:
                folders.clear()
            if seen > _MAX_FILES:
                break
    return found[:_MAX_FILES]
