"""What a package builds and installs, as its `CMakeLists.txt` says. CMake itself is not run.

All branches of a condition count, but for those of other platforms; a loop over known items is gone through, macros and
functions of the file are followed. A variable that nothing sets is empty, as in CMake, so is one whose value only CMake
would know.
"""

from __future__ import annotations

import contextlib
import itertools
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import field, replace
from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.build import (
    LISTS,
    MADE,
    Build,
    Installed,
    InstalledTarget,
    Program,
    Required,
    Said,
    Target,
)
from preflight_analysis.environment.cmake_strings import items_of, texts_made
from preflight_analysis.environment.cmake_syntax import MAX_DEPTH, Command, Word, commands
from preflight_analysis.environment.cmake_values import (
    SOURCES,
    expanded,
    globbed,
    is_only_known_to_cmake,
    joined,
    known_condition,
    parsed_arguments,
    source_files,
    words_of,
)
from preflight_analysis.environment.walk import walk
from preflight_analysis.generation import ros

_MAX_COMMANDS = 20_000
_MAX_FOLDERS = 500
_MAX_PROGRAMS = 1_000
"""Of one folder, and of how many folders, programs are looked for in what is installed."""
_BRANCHES = ("else", "elseif")
_INSTALLS_NOTHING = re.compile(
    r"(?:ament|catkin|check|cmake|cs|cuda|find|get|gtest|include|link|pkg|pluginlib|pybind11|python|qt[456]?"
    r"|rclcpp|roslaunch|roslint|rosidl|set|target|test|try|xacro)_\w+"
    r"|add_(?:compile|custom|definitions|dependencies|executable|library|link|subdirectory|test)\w*"
    r"|generate_(?:export_header|parameter_library|parameter_module)"
    r"|(?:autoware|nav2)_package|aux_source_directory|block|break|configure_file|continue|define_property|enable_\w+"
    r"|endblock|endwhile|execute_process|export|file|include|install|list|mark_as_advanced|math|message|option|package"
    r"|project|return|separate_arguments|set|string|source_group|unset|while"
)
"""Commands that are known to install no launch or parameter file, or are followed."""
_WRAPPER = re.compile(r"\A(?:ament_auto|cs|cuda|qt5|rosbuild)_")
"""Before commands that do what the one without it does, and more; `cs` is catkin_simple's."""
_FOLDERS = {
    "CMAKE_INSTALL_PREFIX": "",
    "CMAKE_INSTALL_BINDIR": "bin",
    "CMAKE_INSTALL_DATADIR": "share",
    "CMAKE_INSTALL_DATAROOTDIR": "share",
    "CMAKE_INSTALL_INCLUDEDIR": "include",
    "CMAKE_INSTALL_LIBDIR": "lib",
}
"""Variables that CMake sets, as they are in a ROS workspace; GNUInstallDirs' among them."""
_CATKIN_FOLDERS = {
    "BIN": "lib/{}",
    "ETC": "etc/{}",
    "INCLUDE": "include/{}",
    "LIB": "lib",
    "PYTHON": "lib/python3/dist-packages/{}",
    "SHARE": "share/{}",
}
"""By the middle of `CATKIN_PACKAGE_..._DESTINATION`, which catkin sets (`catkin_destinations`)."""
_AT_BUILD = re.compile(r"\A\$<BUILD_INTERFACE:([^<>]*)>\Z")
"""A folder that only counts where the package is built, not where it is installed."""
_LINK_WORDS = frozenset("PUBLIC PRIVATE INTERFACE LINK_PUBLIC LINK_PRIVATE debug optimized general".split())  # noqa: SIM905
_MAY_EXECUTE = frozenset(("OWNER_EXECUTE", "GROUP_EXECUTE", "WORLD_EXECUTE"))
_RUNS = _MAY_EXECUTE | {"USE_SOURCE_PERMISSIONS", "FILE_PERMISSIONS", "PERMISSIONS"}
_SCRIPTS = (".py", ".sh", ".bash")
_KINDS = frozenset(re.findall(r"\w+", "ARCHIVE BUNDLE EXPORT FRAMEWORK INCLUDES LIBRARY OBJECTS PUBLIC_HEADER RUNTIME"))
"""Of what `install(TARGETS)` installs."""
_PLACES = frozenset(
    re.findall(
        r"\w+",
        "TYPE DESTINATION PERMISSIONS CONFIGURATIONS COMPONENT OPTIONAL RENAME EXCLUDE_FROM_ALL USE_SOURCE_PERMISSIONS "
        "FILE_PERMISSIONS DIRECTORY_PERMISSIONS MESSAGE_NEVER FILES_MATCHING PATTERN REGEX",
    )
)


def read_build(folder: str, package: str, disk: Disk, generation: int | None = None) -> Build:
    """What the `CMakeLists.txt` of the package in `folder` says, where it is built for the ROS of `generation`. Nothing
    raises; what is not understood is left out."""
    lists = _Lists(folder, disk, generation)
    complete = False
    with contextlib.suppress(_TooLargeError):
        is_catkin = generation is not None and not ros(generation).ament
        names = _CATKIN_FOLDERS if is_catkin else {}
        of_catkin = {f"CATKIN_PACKAGE_{name}_DESTINATION": below.format(package) for name, below in names.items()}
        complete = lists.folder(folder, {**_FOLDERS, **of_catkin, "PROJECT_NAME": package}, 0)
    return replace(lists.build(), complete=complete and lists.complete)


def _is_empty(words: Sequence[Word], variables: Mapping[str, str]) -> bool:
    return any(not expanded(word.text, variables) for word in words)


class _TooLargeError(Exception):
    """More than is looked at."""


@dataclass(slots=True)
class _Making:
    """A target as far as it is known."""

    name: str
    kind: Literal["executable", "library"]
    sources: list[str]
    links: list[str] = field(default_factory=list)
    output: str | None = None


class _Lists:
    def __init__(self, top: str, disk: Disk, generation: int | None) -> None:
        self._top = top
        self._disk = disk
        self._generation = generation
        self._targets: dict[str, _Making] = {}
        self._programs: dict[str, Program] = {}
        self._installed: list[Installed] = []
        self._components: dict[str, str] = {}
        self._components_said: dict[str, Said] = {}
        self._installed_targets: list[InstalledTarget] = []
        self._targets_said: dict[str, Said] = {}
        self._said = Said("", 0, True)
        self._file = ""
        self._calls = 0
        self._conditions = 0
        """How many macros and conditions are around what is read."""
        self._component_programs: dict[str, str] = {}
        self._parameter_libraries: dict[str, str] = {}
        self._plugin_files: dict[str, None] = {}
        self._include_folders: dict[str, None] = {}
        self._python_packages: dict[str, str] = {}
        self._required: list[Required] = []
        self._macros: dict[str, Command] = {}
        self._left = _MAX_COMMANDS
        self.complete = True
        """Whether nothing was met that may install more than is known."""
        self.all_named = True

    def build(self) -> Build:
        return Build(
            {
                t.name: Target(t.name, t.kind, t.output or t.name, tuple(dict.fromkeys(t.sources)), tuple(t.links))
                for t in self._targets.values()
            },
            self._programs,
            tuple(self._installed),
            self._components,
            self._components_said,
            tuple(self._installed_targets),
            self._targets_said,
            self._parameter_libraries,
            self._component_programs,
            tuple(self._plugin_files),
            tuple(self._include_folders),
            self._python_packages,
            tuple(self._required),
            all_named=self.all_named,
        )

    def folder(self, folder: str, variables: Mapping[str, str], depth: int) -> bool:
        """Whether there is something to read in the folder."""
        text = self._disk.content(os.path.join(folder, LISTS)) if depth < MAX_DEPTH else None
        if text is None:
            return False
        here = {"CMAKE_CURRENT_SOURCE_DIR": folder, "CMAKE_CURRENT_LIST_DIR": folder}
        above = {"CMAKE_SOURCE_DIR": self._top, "PROJECT_SOURCE_DIR": self._top, **variables}
        made = os.path.join(self._top, MADE)
        here["CMAKE_CURRENT_BINARY_DIR"] = os.path.normpath(os.path.join(made, os.path.relpath(folder, self._top)))
        above |= {"CMAKE_BINARY_DIR": made, "PROJECT_BINARY_DIR": made}
        before, self._file = self._file, os.path.join(folder, LISTS)
        self._block(commands(text), {**above, **here}, depth + 1)
        self._file = before
        return True

    def _block(self, block: Sequence[Command], variables: dict[str, str], depth: int) -> None:
        for command in block:
            self._left -= 1
            if self._left < 0:
                raise _TooLargeError
            if not self._calls:
                self._said = Said(self._file, command.at, not self._conditions)
            if command.name == "foreach":
                self._foreach(command, variables, depth)
            elif command.name == "if":
                self._if(command, variables, depth)
            elif command.name in ("macro", "function"):
                if command.words:
                    self._macros[expanded(command.words[0].text, variables).lower()] = command
            else:
                if _WRAPPER.sub("", command.name) == "add_executable" and _is_empty(command.words[:1], variables):
                    self.all_named = False
                    continue
                if command.name == "install" and any(map(is_only_known_to_cmake(variables), command.words)):
                    self.complete = False
                    self._said = replace(self._said, sure=False)
                words = words_of(command.words, variables)
                if command.name == "install":  # the kind may stand before each of the files
                    words = [word for at, word in enumerate(words) if at == 0 or word != words[0]]
                self._command(command.name, words, variables, depth)

    def _if(self, command: Command, variables: dict[str, str], depth: int) -> None:
        """All branches, unless a condition says that it is for another platform."""
        condition, branch = command.words, []
        for each in (*command.inner, None):
            if each is not None and each.name not in _BRANCHES:
                branch.append(each)
                continue
            known = known_condition(condition, self._generation)
            if known is not False:
                self._conditions += known is None
                self._block(branch, variables, depth + 1)
                self._conditions -= known is None
            if known or each is None:
                break
            condition, branch = each.words if each.name == "elseif" else (), []

    def _foreach(self, command: Command, variables: dict[str, str], depth: int) -> None:
        words = words_of(command.words, variables)
        if not words or depth >= MAX_DEPTH:
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
        match _WRAPPER.sub("", name), words:
            case "project", [project, *_]:
                variables["PROJECT_NAME"] = project
                variables["PROJECT_SOURCE_DIR"] = variables[f"{project}_SOURCE_DIR"] = folder
                if folder == self._top:
                    variables["CMAKE_PROJECT_NAME"] = project
            case "cmake_parse_arguments", [prefix, options, ones, many, *given]:
                variables.update(parsed_arguments(prefix, options, ones, many, given))
            case "set", [variable, *values]:
                if "CACHE" in values:
                    values = values[: values.index("CACHE")]
                    if variable in variables:
                        return
                variables[variable] = joined(v for v in values if v != "PARENT_SCOPE")
            case "list", ["APPEND" | "PREPEND", variable, *values]:
                variables[variable] = joined([variables.get(variable, ""), *values])
            case "list", ["GET", variable, *rest] if rest:
                variables.update(items_of(rest, variables.get(variable, "")))
            case (("string" | "get_filename_component"), _):
                variables.update(texts_made(name, words) or {})
            case "file", ["GLOB" | "GLOB_RECURSE" as how, variable, *patterns]:
                variables[variable] = joined(globbed(self._disk, patterns, folder, how == "GLOB_RECURSE"))
            case "find_package", ["catkin", *rest] if "COMPONENTS" in rest:
                components = rest[rest.index("COMPONENTS") + 1 :]
                self._required += [Required(each, self._said) for each in components if each != "REQUIRED"]
            case "find_package", [needed, *rest] if "REQUIRED" in rest:
                self._required.append(Required(needed, self._said))
            case "catkin_simple", _:
                self._headers(["include"], folder)
            case "install_scripts", files:  # of catkin_simple
                self._install(files, folder, relayed=False)
            case "aux_source_directory", [where, variable, *_]:
                patterns = [os.path.join(where, f"*{ending}") for ending in SOURCES]
                found = globbed(self._disk, patterns, folder, False)
                variables[variable] = joined([variables.get(variable, ""), *found])
            case (("catkin_add_gtest" | "catkin_add_gmock" | "catkin_add_executable_with_gtest"), [target, *rest]):
                self._target(target, "executable", rest, folder)
            case (("add_rostest_gtest" | "add_rostest_gmock"), [target, _, *rest]):
                self._target(target, "executable", rest, folder)
            case ("add_executable" | "add_library") as kind, [target, *rest]:
                self._target(target, "executable" if kind == "add_executable" else "library", rest, folder)
                if name == "add_executable" and "IMPORTED" not in rest and "ALIAS" not in rest:
                    self._targets_said.setdefault(target, self._said)
            case "google_binary", [target, *rest]:  # cartographer's, which links the library of the project
                self._target(target, "executable", rest, folder)
                self._targets[target].links.append(variables.get("PROJECT_NAME", ""))
            case "target_sources", [target, *rest] if target in self._targets:
                self._targets[target].sources += source_files(self._disk, rest, folder)
            case ("include_directories", paths) | ("target_include_directories", [_, *paths]):
                self._headers(paths, folder)
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
                self._programs_of(rest, folder, f"lib/{variables['PROJECT_NAME']}")
                if not _MAY_EXECUTE.isdisjoint(rest):
                    self._made_executable(rest, folder)
            case "install", ["TARGETS", *rest]:
                self._install_targets(rest)
            case "install", ["EXPORT", *_]:
                pass
            case "package", [*_] if "INSTALL_TO_SHARE" in words:  # ament_auto_package
                folders = words[words.index("INSTALL_TO_SHARE") + 1 :]
                self._data([*folders, "DESTINATION", "share/${PROJECT_NAME}"], folder, whole=True)
            case "rclcpp_components_register_node", [target, *rest] if "PLUGIN" in rest[:-1]:
                self._component(target, rest)
            case "rclcpp_components_register_nodes", [target, *plugins]:
                if "RESOURCE_INDEX" in plugins[:-1]:
                    at = plugins.index("RESOURCE_INDEX")
                    plugins = [*plugins[:at], *plugins[at + 2 :]]
                self._components.update(dict.fromkeys(plugins, target))
                self._components_said.update(dict.fromkeys(plugins, self._said))
            case "pluginlib_export_plugin_description_file", [_, file, *_]:
                self._plugin_files[os.path.normpath(os.path.join(folder, file))] = None
            case "ament_python_install_package", [package, *rest]:
                below = rest[rest.index("PACKAGE_DIR") + 1] if "PACKAGE_DIR" in rest[:-1] else package
                self._python_packages[package] = os.path.normpath(os.path.join(folder, below))
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
        text = self._disk.content(path) if path.startswith(self._top + os.sep) and depth < MAX_DEPTH else None
        if text is None:
            self.complete = False
            return
        before = variables["CMAKE_CURRENT_LIST_DIR"], self._file
        variables["CMAKE_CURRENT_LIST_DIR"], self._file = os.path.dirname(path), path
        self._block(commands(text), variables, depth + 1)
        variables["CMAKE_CURRENT_LIST_DIR"], self._file = before

    def _called(self, macro: Command, words: list[str], variables: dict[str, str], depth: int) -> None:
        if depth >= MAX_DEPTH:
            return
        names = [word.text for word in macro.words[1:]]
        given = dict(zip(names, [*words, *[""] * len(names)], strict=False))
        given |= {"ARGN": joined(words[len(names) :]), "ARGV": joined(words)}
        given |= {f"ARGV{index}": word for index, word in enumerate(words)}
        scope = {**variables, **given}
        self._calls += 1
        self._block(macro.inner, scope, depth + 1)
        self._calls -= 1
        if macro.name == "macro":
            variables.update({name: value for name, value in scope.items() if name not in given})

    def _target(self, name: str, kind: Literal["executable", "library"], rest: Sequence[str], folder: str) -> None:
        if not name or any(word in ("ALIAS", "IMPORTED") for word in rest[:2]):
            return
        made = self._targets.setdefault(name, _Making(name, kind, []))
        if "DIRECTORY" in rest:  # of ament_auto_add_library and ament_auto_add_executable: all that is in the folders
            at = rest.index("DIRECTORY")
            patterns = [os.path.join(each, f"*{ending}") for each in rest[at + 1 :] for ending in SOURCES]
            made.sources += globbed(self._disk, patterns, folder, False)
            rest = rest[:at]
        made.sources += source_files(self._disk, rest, folder)

    def _headers(self, words: Sequence[str], folder: str) -> None:
        """The folders that are named of the package itself; what else is named is not below it."""
        for word in words:
            path = os.path.normpath(os.path.join(folder, _AT_BUILD.sub(r"\1", word)))
            if path.startswith(self._top + os.sep) and self._disk.is_folder(path):
                self._include_folders[path] = None

    def _outputs(self, targets: Sequence[str], output: str) -> None:
        for name in targets:
            if name in self._targets and output:
                self._targets[name].output = output

    def _component(self, target: str, words: Sequence[str]) -> None:
        """A component that has an executable of its own as well."""
        plugin = words[words.index("PLUGIN") + 1]
        self._components[plugin] = target
        self._components_said[plugin] = self._said
        if "EXECUTABLE" in words[:-1] and target in self._targets:
            name = words[words.index("EXECUTABLE") + 1]
            self._component_programs[name] = plugin
            self._targets.setdefault(name, _Making(name, "executable", list(self._targets[target].sources), [target]))

    def _install_targets(self, words: Sequence[str]) -> None:
        """Programs are what is RUNTIME; a destination without a kind is that of all kinds."""
        end = next((index for index, word in enumerate(words) if word in _PLACES or word in _KINDS), len(words))
        rest = list(words[end:])
        of_runtime = rest[rest.index("RUNTIME") :] if "RUNTIME" in rest else []
        of_all = list(itertools.takewhile(lambda word: word not in _KINDS, rest))
        given = (each[each.index("DESTINATION") + 1] for each in (of_runtime, of_all) if "DESTINATION" in each[:-1])
        where = next(given, "bin")
        where = os.path.normpath(where).lstrip("/")
        self._installed_targets += [InstalledTarget(name, where, self._said) for name in words[:end]]

    def _data(self, words: Sequence[str], folder: str, *, whole: bool, runs: bool = False) -> None:
        destination = words[words.index("DESTINATION") + 1]
        end = next((index for index, word in enumerate(words) if word in _PLACES), len(words))
        renamed = words[words.index("RENAME") + 1] if "RENAME" in words[:-1] else None
        for word in words[:end]:
            path = os.path.normpath(os.path.join(folder, word))
            # A folder with a slash at its end stands for what is in it.
            name = "" if whole and word.endswith("/") else renamed or os.path.basename(path)
            optional, may_run = "OPTIONAL" in words, runs or not _RUNS.isdisjoint(words)
            self._installed.append(Installed(path, destination, name, self._said, optional, may_run, whole))

    def _programs_of(self, words: Sequence[str], folder: str, where: str) -> None:
        """The programs among the files, or below the folders, that are installed at `where` or below: `ros2 run` looks
        at any depth. They keep their permissions at least where links are installed."""
        destination = os.path.normpath(words[words.index("DESTINATION") + 1])
        if destination != where and not destination.startswith(where + os.sep):
            return
        for word in itertools.takewhile(lambda word: word not in _PLACES, words):
            path = os.path.normpath(os.path.join(folder, word))
            below = walk(path) if f"{path}/".startswith(f"{self._top}/") else ()
            for place, _, names in itertools.islice(below, _MAX_FOLDERS):
                self._disk.names(place)  # it is made again as something in it comes or goes
                self._add_programs(os.path.join(place, name) for name in names[:_MAX_PROGRAMS])
            self._add_programs((path,))

    def _made_executable(self, words: Sequence[str], folder: str) -> None:
        """The scripts among the files, or below the folders, that get the permission to be executed where they are
        installed."""
        for word in itertools.takewhile(lambda word: word not in _PLACES, words):
            path = os.path.normpath(os.path.join(folder, word))
            inside = f"{path}/".startswith(f"{self._top}/")
            patterns = [os.path.join(path, f"*{ending}") for ending in _SCRIPTS] if inside else ()
            below = globbed(self._disk, patterns, folder, deep=True) if self._disk.is_folder(path) else [path]
            for file in below[:_MAX_PROGRAMS]:
                if file.endswith(_SCRIPTS):
                    self._programs.setdefault(os.path.basename(file), Program(file, False))

    def _add_programs(self, paths: Iterable[str]) -> None:
        for path in filter(self._disk.is_program, paths):
            self._programs.setdefault(os.path.basename(path), Program(path, False))

    def _install(self, words: Sequence[str], folder: str, relayed: bool) -> None:
        end = next((index for index, word in enumerate(words) if word in _PLACES), len(words))
        files, rest = words[:end], list(words[end:])
        renamed = rest[rest.index("RENAME") + 1] if "RENAME" in rest[:-1] else None
        if "DESTINATION" in rest[:-1]:  # launch files that are programs are installed like others
            self._data(words, folder, whole=False, runs=True)
        for file in files:
            path = os.path.normpath(os.path.join(folder, file))
            self._programs.setdefault(renamed or os.path.basename(path), Program(path, relayed, self._said))
