"""What the `CMakeLists.txt` of a package refers to and does not have: sources, interface files, targets, packages, and
the packages that define its commands.

Only what is sure is said: what a variable, a condition, a loop, another file or an unknown command may change is left
out. CMake reads a file from top to bottom, and so does this.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import takewhile
from typing import Literal, NamedTuple

from preflight_analysis.catalogue.released import distributions_with
from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.build import LISTS
from preflight_analysis.environment.cmake_syntax import Command, Word, commands
from preflight_analysis.environment.cmake_values import known_condition
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.slips import edits

Kind = Literal[
    "source", "interface", "unlisted", "target", "late", "generated", "itself", "package", "command", "setup", "module"
]


class Broken(NamedTuple):
    """Something that is referred to and not there. `at` is the offset of its name, `by` what refers to it, `others`
    what of the kind there is."""

    kind: Kind
    name: str
    at: int
    by: str
    others: tuple[str, ...] = ()


_VARIABLE = re.compile(r"\$\{(\w+)\}")
_UNRESOLVED = re.compile(r"[$<>*?@]")
_MAKES_TARGET = re.compile(
    r"(?:cuda_|cs_|ament_auto_|rosbuild_)?add_(?:executable|library)|add_custom_target|pybind11_add_module"
    r"|(?:ament_|catkin_)add_\w*g(?:test|mock)\w*|add_rostest_g(?:test|mock)|rosidl_generate_interfaces"
    r"|generate_parameter_(?:library|module)|rclcpp_components_register_node"
)
_WITH_SOURCES = re.compile(r"(?:cuda_|cs_|ament_auto_)?add_(?:executable|library)")
_USES_TARGET = re.compile(
    r"target_(?:link_libraries|include_directories|compile_(?:definitions|features|options)|sources|link_options)"
    r"|ament_target_dependencies|rosidl_target_interfaces|add_dependencies|rclcpp_components_register_nodes?"
)
_NO_TARGETS = re.compile(
    r"ament_(?:auto_package|auto_find_\w+|export_\w+|index_\w+|python_install_\w+|lint_\w+|cppcheck|cpplint"
    r"|environment_hooks|get_\w+|register_\w+|add_\w*test|flake8|xmllint|pep257|copyright|uncrustify|clang_\w+)"
    r"|[a-z0-9]+_package|add_(?:launch_test|rostest|ros_test)|catkin_add_nosetests|catch_discover_tests"
    r"|rosidl_get_\w+|pluginlib_export_\w+|catkin_(?:python_setup|install_python|destinations)"
    r"|(?:cmake_minimum_required|cmake_policy|project|set|unset|list|string|math|file|message|option|find_\w+|if|else"
    r"|elseif|foreach|while|endwhile|function|macro|return|install|include_directories|link_directories|link_libraries"
    r"|add_(?:definitions|compile_\w+|link_options|test|custom_command)|enable_\w+|get_\w+|set_\w+|configure_file"
    r"|execute_process|export|mark_as_advanced|separate_arguments|source_group|aux_source_directory|pkg_\w+"
    r"|check_\w+|roslaunch_\w+|add_(?:message|service|action)_files|generate_messages"
    r"|generate_dynamic_reconfigure_options|class_loader_\w+|qt[56]_wrap_\w+|include)"
)
"""Commands that make no target of a name that stands elsewhere in the file."""
_MAKES_MORE = {"generate_messages": "{}_gen", "generate_dynamic_reconfigure_options": "{}_gencfg"}
"""Commands that make targets of names that begin so, of the package's name; for those of `rosidl_generate_interfaces`
see `_made`."""
_MODULES = re.compile(r"CTest|GNUInstallDirs|CMake\w+|Check\w+|GenerateExportHeader|ExternalProject|Find\w+")
"""Of CMake itself, which make no targets by themselves."""
_SOURCE = re.compile(r"\.(?:c|cc|cpp|cxx|c\+\+|C|cu|h|hh|hpp|hxx)\Z")
_INTERFACE = re.compile(r"\.(?:msg|srv|action|idl)\Z")
_LISTS_OF_CATKIN = {"add_message_files": "msg", "add_service_files": "srv", "add_action_files": "action"}
_PACKAGE = re.compile(r"[a-z]\w*")
_LONG = 5
"""Letters of a name that is near another one not by chance."""
_KEYWORD = re.compile(r"[A-Z][A-Z_]+\Z")
_SYSTEM = re.compile(r"[A-Z]\w*|yaml-cpp")
"""Packages that are not ROS's, and find none of ROS."""
_BRINGS = {
    name: tuple(brought.split())
    for name, brought in {
        "ament_cmake": "",
        "ament_cmake_python": "",
        "cv_bridge": "sensor_msgs OpenCV",
        "geometry_msgs": "std_msgs",
        "image_transport": "message_filters pluginlib rclcpp rclcpp_components rclcpp_lifecycle sensor_msgs",
        "message_filters": "rclcpp rclcpp_lifecycle std_msgs",
        "nav_msgs": "geometry_msgs std_msgs",
        "pluginlib": "class_loader",
        "class_loader": "",
        "rclcpp": "",
        "rclcpp_action": "rclcpp",
        "rclcpp_components": "class_loader rclcpp",
        "rclcpp_lifecycle": "rclcpp",
        "rclpy": "",
        "rosidl_default_generators": "",
        "sensor_msgs": "geometry_msgs std_msgs",
        "std_msgs": "",
        "std_srvs": "",
        "tf2": "geometry_msgs",
        "tf2_geometry_msgs": "geometry_msgs tf2 tf2_ros",
        "tf2_msgs": "geometry_msgs",
        "tf2_ros": "geometry_msgs message_filters rclcpp rclcpp_action rclcpp_components tf2 tf2_msgs",
        "trajectory_msgs": "geometry_msgs std_msgs",
        "visualization_msgs": "geometry_msgs sensor_msgs std_msgs",
    }.items()
}
"""Packages of ROS 2 of which it is known what `find_package` of each finds besides, in any distribution."""
_BELOW = re.compile(
    r"ament_\w+|libstatistics_collector|rcl\w*|rcpputils|rcutils|rmw\w*|rosidl_\w+|tracetools|\w+_vendor|console_bridge"
    r"|(?:action|builtin|composition|lifecycle|rosgraph|service|statistics|type_description|unique_identifier)"
    r"_(?:msgs|interfaces)"
)
"""Packages that those may find besides."""
_AMENT, _AUTO = "ament_cmake", "ament_cmake_auto"
_DEFINED_BY = (
    (re.compile(r"ament_(?:package|target_dependencies|export_\w+|python_install_package)"), _AMENT, frozenset[str]()),
    (re.compile(r"ament_auto_\w+"), _AUTO, _BRINGS.keys()),
    (re.compile(r"rosidl_generate_interfaces"), "rosidl_default_generators", frozenset[str]()),
    (re.compile(r"catkin_(?:package|python_setup|install_python)"), "catkin", frozenset[str]()),
)
"""Commands, the package that defines them, and those besides `ament_cmake` that are known not to find it. Messages, and
rclcpp, do find what defines `rosidl_generate_interfaces`."""


def broken_references(disk: Disk, environment: Environment, package: Package) -> tuple[Broken, ...]:
    """Those of the build file of a package, in its order. Nothing raises."""
    text = disk.content(os.path.join(package.share, LISTS))
    if text is None:
        return ()
    reader = _Reader(disk, environment, package)
    reader.block(commands(text), sure=True)
    return tuple(sorted(reader.found(), key=lambda each: each.at))


def _before_keyword(words: Sequence[Word]) -> list[Word]:
    return [*takewhile(lambda word: not _KEYWORD.match(word.text), words)]


class _Use(NamedTuple):
    """A target that a command names."""

    name: str
    at: int
    by: str
    before: int
    """How many targets were made before."""


class _Reader:
    """A file that is gone through once. `sure` is what stands under no condition, loop or macro."""

    def __init__(self, disk: Disk, environment: Environment, package: Package) -> None:
        self._disk, self._environment, self._folder = disk, environment, package.share
        self._package, self._generation = package.name, package.generation
        self._values: dict[str, tuple[str, ...]] = dict.fromkeys(
            ("CMAKE_CURRENT_SOURCE_DIR", "CMAKE_CURRENT_LIST_DIR", "PROJECT_SOURCE_DIR"), (self._folder,)
        )
        self._broken: list[Broken] = []
        self._targets: dict[str, int] = {}
        self._prefixes = ["ament_cmake_python_"]
        """Of the names of targets that commands make without naming them."""
        self._uses: list[_Use] = []
        self._packages: set[str] = set()
        self._generated: list[Broken] = []
        """Dependencies on messages of the package itself."""
        self._asked: list[tuple[Word, str]] = []
        self._commands: list[Command] = []
        self._listed: dict[str, tuple[set[str], int, str]] = {}
        """By folder the interface files that are listed, where, and by which command."""
        self._mentioned: set[str] = set()
        """Base names of files that other commands name, which may make them."""
        self._targets_known = self._packages_known = self._commands_known = self._interfaces_known = True
        self._makes_messages = self._returned = False
        self._wants_targets = False
        """Whether a dependency that is no target is an error: CMake's policy CMP0046."""

    def block(self, block: Sequence[Command], *, sure: bool) -> None:
        for command in block:
            sure = sure and not self._returned
            if command.name == "if":
                self._if(command, sure=sure)
            elif command.name in ("foreach", "macro", "function"):
                for word in command.words:
                    self._values.pop(word.text, None)
                if command.name != "foreach":
                    self._targets_known = False
                    self._commands_known = False
                self.block(command.inner, sure=False)
            else:
                self._command(command, sure=sure)

    def _if(self, command: Command, *, sure: bool) -> None:
        condition: Sequence[Word] = command.words
        branch: list[Command] = []
        for each in (*command.inner, None):
            if each is not None and each.name not in ("else", "elseif"):
                branch.append(each)
                continue
            known = known_condition(condition, self._generation)
            if known is not False:
                self.block(branch, sure=sure and known is True)
            if known or each is None:
                break
            condition, branch = each.words if each.name == "elseif" else (), []

    def _words(self, words: Sequence[Word]) -> list[Word]:
        """With what is known of variables; what is not known keeps its `$`."""
        found: list[Word] = []
        for word in words:
            alone = _VARIABLE.fullmatch(word.text)
            if alone is not None and alone[1] in self._values:
                found += [Word(item, word.quoted, word.at) for item in self._values[alone[1]]]
            else:
                text = _VARIABLE.sub(lambda at: ";".join(self._values.get(at[1], (at[0],))), word.text)
                parts = [text] if word.quoted else [part for part in text.split(";") if part]
                found += [Word(part, word.quoted, word.at) for part in parts]
        return found

    def _command(self, command: Command, *, sure: bool) -> None:
        name, words = command.name, self._words(command.words)
        texts = [word.text for word in words]
        if sure:
            self._commands.append(command)
        match name, texts:
            case "project", [project, *_]:
                self._values |= {"PROJECT_NAME": (project,), f"{project}_SOURCE_DIR": (self._folder,)}
            case "set", [variable, *values]:
                given = takewhile(lambda each: each != "CACHE", values)
                self._set(variable, tuple(filter(None, given)), sure=sure)
                if "CACHE" in values or "PARENT_SCOPE" in values:
                    self._values.pop(variable, None)
            case "list", ["APPEND", variable, *values] if variable in self._values:
                self._set(variable, (*self._values[variable], *values), sure=sure)
            case "cmake_minimum_required", ["VERSION", version, *_]:
                self._wants_targets = version[:1].isdigit() and not version.startswith(("2.", "1."))
            case "return", _:
                self._returned = True
            case "find_package", [_, *rest]:
                self._found(words[0], rest, sure=sure)
            case "include", [module, *_]:
                if not _MODULES.fullmatch(module):
                    self._targets_known = self._packages_known = self._commands_known = False
            case (("add_subdirectory" | "subdirs"), _):
                self._targets_known = self._interfaces_known = False
            case _:
                self._other(name, words, sure=sure)

    def _set(self, variable: str, values: tuple[str, ...], *, sure: bool) -> None:
        if sure:
            self._values[variable] = values
        else:
            self._values.pop(variable, None)

    def _found(self, word: Word, rest: Sequence[str], *, sure: bool) -> None:
        if _UNRESOLVED.search(word.text):
            self._packages_known = self._commands_known = False
            return
        parts = [part for part in rest if not _KEYWORD.match(part)] if word.text == "catkin" else []
        if any(_UNRESOLVED.search(part) for part in parts):
            self._packages_known = False
        self._packages |= {word.text, *parts}
        required = "REQUIRED" in rest and not {"PATHS", "HINTS", "MODULE", "CONFIG", "NO_MODULE"} & {*rest}
        if sure and required and word.text == self._package:
            self._broken.append(Broken("itself", word.text, word.at, "find_package"))
        elif sure and "REQUIRED" in rest and self._package in parts:
            self._broken.append(Broken("itself", self._package, word.at, "find_package"))

    def _other(self, name: str, words: list[Word], *, sure: bool) -> None:
        texts = [word.text for word in words]
        if _MAKES_TARGET.fullmatch(name):
            self._made(name, words, sure=sure)
        elif not _NO_TARGETS.fullmatch(name) and not _USES_TARGET.fullmatch(name):
            self._targets_known = False
        if not _WITH_SOURCES.fullmatch(name) and name != "rosidl_generate_interfaces":
            self._mentioned |= {os.path.basename(text) for text in texts}
        if not _MAKES_TARGET.fullmatch(name) and not _USES_TARGET.fullmatch(name):
            for text in texts:
                self._values.pop(text, None)  # it may set it
        if name.startswith("ament_auto_find_"):
            self._packages_known = False
        if name in _MAKES_MORE:
            self._prefixes.append(_MAKES_MORE[name].format(self._package))
            self._makes_messages |= name == "generate_messages"
        if name in _LISTS_OF_CATKIN:
            self._listed_by_catkin(name, words, sure=sure)
        if sure:
            self._used(name, words)

    def _made(self, name: str, words: list[Word], *, sure: bool) -> None:
        if not words or _UNRESOLVED.search(words[0].text):
            self._targets_known = False
            return
        target, rest = words[0], words[1:]
        texts = [word.text for word in rest]
        if name == "rosidl_generate_interfaces":
            self._targets.setdefault(target.text, len(self._targets))
            self._prefixes.append(f"{target.text}__")
            self._interfaces(name, _before_keyword(rest), self._folder, sure=sure)
            return
        if name == "rclcpp_components_register_node":
            made = [texts[at + 1] for at, text in enumerate(texts[:-1]) if text == "EXECUTABLE"]
            self._targets.update((each, len(self._targets)) for each in made if each not in self._targets)
            return
        self._targets.setdefault(target.text, len(self._targets))
        if not sure or not _WITH_SOURCES.fullmatch(name) or {"ALIAS", "IMPORTED"} & {*texts}:
            return
        for word in takewhile(lambda word: word.text != "DIRECTORY", rest):
            path = os.path.normpath(os.path.join(self._folder, word.text))
            is_ours = path.startswith(f"{self._folder}/") and not _UNRESOLVED.search(path)
            if _SOURCE.search(word.text) and is_ours and not self._disk.exists(path):
                self._broken.append(Broken("source", word.text, word.at, target.text))

    def _listed_by_catkin(self, name: str, words: list[Word], *, sure: bool) -> None:
        texts = [word.text for word in words]
        below = _LISTS_OF_CATKIN[name]
        if "DIRECTORY" in texts[:-1]:
            below = texts[texts.index("DIRECTORY") + 1]
        if "FILES" not in texts or {"BASE_DIR", "PACKAGE"} & {*texts}:
            self._interfaces_known = False
            return
        files = _before_keyword(words[texts.index("FILES") + 1 :])
        self._interfaces(name, files, os.path.join(self._folder, below), sure=sure)

    def _interfaces(self, by: str, files: Sequence[Word], folder: str, *, sure: bool) -> None:
        for word in files:
            path = os.path.normpath(os.path.join(folder, word.text))
            if not sure or _UNRESOLVED.search(path) or not _INTERFACE.search(path):
                self._interfaces_known = False
                continue
            listed = self._listed.setdefault(os.path.dirname(path), (set(), word.at, by))
            listed[0].add(os.path.basename(path))
            if not self._disk.exists(path):
                self._broken.append(Broken("interface", os.path.relpath(path, self._folder), word.at, by))

    def _used(self, name: str, words: list[Word]) -> None:
        texts = [word.text for word in words]
        targets: list[Word] = []
        if name == "install" and texts[:1] == ["TARGETS"]:
            targets = _before_keyword(words[1:])
        elif _USES_TARGET.fullmatch(name):
            targets = words[:1]
        self._uses += [_Use(word.text, word.at, name, len(self._targets)) for word in targets]
        generated = f"{self._package}_generate_messages"
        if name == "add_dependencies" and self._wants_targets:
            made = (word for word in words[1:] if word.text in (generated, f"{generated}_cpp", f"{generated}_py"))
            self._generated += [Broken("generated", word.text, word.at, name) for word in made]
        elif name == "rosidl_generate_interfaces" and "DEPENDENCIES" in texts:
            needed = words[texts.index("DEPENDENCIES") + 1 :]
            self._asked += [(word, name) for word in _before_keyword(needed)]
        elif name == "ament_target_dependencies":
            self._asked += [(word, name) for word in words[1:] if not _KEYWORD.match(word.text)]

    def found(self) -> Iterator[Broken]:
        """All that is sure once the file is read."""
        for each in self._broken:
            if each.kind != "source" or os.path.basename(each.name) not in self._mentioned:
                yield each
        if self._targets_known:
            yield from self._of_targets()
            if not self._makes_messages:
                yield from self._generated[:1]
        if self._packages_known:
            yield from self._of_packages()
        if self._commands_known:
            yield from self._of_commands()
        yield from self._of_files()
        if self._interfaces_known:
            yield from self._unlisted()

    def _of_targets(self) -> Iterator[Broken]:
        said = set[str]()
        for use in self._uses:
            made = self._targets.get(use.name)
            is_unsure = (
                not use.name
                or _UNRESOLVED.search(use.name)
                or "::" in use.name
                or use.name.startswith((*self._prefixes,))
            )
            if is_unsure or use.name in said or (made is not None and made < use.before):
                continue
            said.add(use.name)
            yield Broken("target" if made is None else "late", use.name, use.at, use.by, tuple(self._targets))

    def _of_packages(self) -> Iterator[Broken]:
        """A package that no `find_package` finds, by itself or because another one needs it."""
        found, unknown, pending = set[str](), set[str](), [*self._packages]
        while pending:
            name = pending.pop()
            if name in found:
                continue
            found.add(name)
            if name in self._environment.packages:
                pending += self._environment.packages[name].dependencies
            elif name in _BRINGS:
                pending += _BRINGS[name]
            elif not _SYSTEM.fullmatch(name) and not _BELOW.fullmatch(name):
                unknown.add(name)
        said = set[str]()
        for word, by in self._asked:
            name = word.text
            if name in found or name in said or not _PACKAGE.fullmatch(name):
                continue
            said.add(name)
            if self._is_found_by_none(name, unknown):
                yield Broken("package", name, word.at, by, tuple(self._packages))

    def _is_found_by_none(self, name: str, unknown: Iterable[str]) -> bool:
        """Whether none of the packages of which it is not known what they need can need this one: there are none, or it
        is one of the workspace and they are released, or it is nowhere and a slip of one that is found."""
        if name in self._environment.packages or distributions_with(name, 2):
            is_ours = name in self._environment.packages and not distributions_with(name, 2)
            return not _BELOW.fullmatch(name) and all(is_ours and distributions_with(each, 2) for each in unknown)
        return len(name) >= _LONG and any(edits(name, each, 1) <= 1 for each in self._packages)

    def _of_commands(self) -> Iterator[Broken]:
        said = set[str]()
        for command in self._commands:
            for pattern, package, harmless in _DEFINED_BY:
                known = self._packages_known or package == _AUTO
                if package in said or not known or not pattern.fullmatch(command.name):
                    continue
                others = self._packages - harmless
                brings = (
                    r"(?!ament_lint_)\w+" if package == _AMENT else rf"{package}|(?!ament_(?:cmake|lint)_?)[a-z]\w+"
                )
                if any(re.fullmatch(brings, each) for each in others):
                    continue
                said.add(package)
                yield Broken("command", package, command.at, command.name)

    def _of_files(self) -> Iterator[Broken]:
        for command in self._commands:
            if command.name == "catkin_python_setup" and not self._is_there("setup.py"):
                yield Broken("setup", "setup.py", command.at, command.name)
            elif command.name == "ament_python_install_package":
                words = self._words(command.words)
                if len(words) == 1 and _PACKAGE.fullmatch(words[0].text) and not self._is_there(words[0].text):
                    yield Broken("module", words[0].text, words[0].at, command.name)

    def _is_there(self, below: str) -> bool:
        return self._disk.exists(os.path.join(self._folder, below))

    def _unlisted(self) -> Iterator[Broken]:
        for folder, (listed, at, by) in self._listed.items():
            endings = {os.path.splitext(name)[1] for name in listed}
            others = (each for each in self._disk.names(folder) if os.path.splitext(each)[1] in endings)
            names = [os.path.relpath(os.path.join(folder, each), self._folder) for each in others if each not in listed]
            if names:
                yield Broken("unlisted", names[0], at, by, tuple(names[1:]))
