"""The files that `pkg` and `type` of a node lead to, as `roslib.packages.find_node` finds them for roslaunch.

First the devel and install spaces and the system's prefix, of which only the first one counts that has anything of
the package: `lib/<pkg>`, `libexec/<pkg>`, `share/<pkg>`, and the source folder where the space was made from one.
Then the folder that `$(find)` gives. All of them are walked down to the last subfolder, and the first file of the
name that its owner may read and execute is run.
"""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Iterator, Mapping, Sequence

from preflight_analysis.documents.disk import Disk, mode_of, names_in
from preflight_analysis.environment.build import Build, Made
from preflight_analysis.environment.installed_paths import cmake_build, python_build
from preflight_analysis.environment.model import Environment, Executable, Package
from preflight_analysis.environment.packages import crawl
from preflight_analysis.environment.walk import walk
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query

_COMPONENTS = os.path.join("share", "ament_index", "resource_index", "rclcpp_components")
_RUNNABLE = stat.S_IRUSR | stat.S_IXUSR
_MAX_MARKER = 65536
_EXECUTABLE = re.compile(r"add_executable\s*\(\s*\"?([^\s()\"]+)", re.IGNORECASE)


class ExecutableIndex:
    """Finds executables of one environment on a disk."""

    def __init__(self, environment: Environment, disk: Disk | None = None) -> None:
        self._environment = environment
        self._db = (disk or Disk()).db

    def find(self, package: str, name: str) -> Executable:
        """What a node of this `pkg` and `type` runs.

        `name` is the plain name of a file: as for roslaunch, nothing is found for one with a slash in it.
        """
        return _find(self._db, self._environment, package, name)

    def is_build_target(self, package: str, name: str) -> bool:
        """Whether a `CMakeLists.txt` of the package names the executable: it is there once the workspace is built.

        Where the files are not understood a word of them is taken for its word; `${PROJECT_NAME}` is the package. A
        library is no executable.
        """
        if package not in self._environment.packages:
            return False
        build = _build(self._db, self._environment, package)
        if build.made_of(name) is not None:
            return True
        if build.complete and build.library(name) is not None:
            return False
        words = _words_of_lists(self._db, self._environment, package)
        if build.complete and build.all_named:  # a file that none adds may make it all the same
            return f"add_executable({name}" in words
        return name in words

    def is_in_build_file(self, package: str, name: str) -> bool:
        """Whether a `CMakeLists.txt` of the package has the name of a file or class among its words: its build may make
        it."""
        if package not in self._environment.packages:
            return False
        return name in _words_of_lists(self._db, self._environment, package)

    def is_library_target(self, package: str, name: str) -> bool:
        """Whether a `CMakeLists.txt` of the package names the library (`vision` for `libvision.so`), likewise."""
        if package not in self._environment.packages:
            return False
        built = _build(self._db, self._environment, package).library(name) is not None
        return built or name in _words_of_lists(self._db, self._environment, package)

    def made_of(self, package: str, name: str) -> Made | None:
        """The file in the source of the package that the executable is made of, once it is built or installed."""
        return _build(self._db, self._environment, package).made_of(name)

    def names(self, package: str) -> tuple[str, ...]:
        """All that a node of this package could name as its type, what is not built yet as well, sorted.

        Empty for an unknown package.
        """
        return _names(self._db, self._environment, package)

    def names_are_all(self, package: str) -> bool:
        """Whether `names` are all: a `setup.py` or `CMakeLists.txt` may compute them in ways that are not followed."""
        found = self._environment.packages.get(package)
        if found is None or not found.is_ament:
            return True
        named = _build(self._db, self._environment, package).all_named
        return named and python_build(Disk(self._db), found).all_programs

    def components(self, package: str) -> tuple[str, ...]:
        """The classes of the package that a container can load, as the prefixes list them and as its `CMakeLists.txt`
        registers them, sorted; empty where nothing of that is known."""
        return _components(self._db, self._environment, package)

    def component(self, package: str, plugin: str) -> Executable:
        """The library that a container loads for the class of a package: of the first prefix that lists the package's
        components, as `ament_index_cpp` looks for it."""
        return _component(self._db, self._environment, package, plugin)


@query
def _find(db: Database, environment: Environment, package: str, name: str) -> Executable:
    found = environment.packages.get(package)
    if found is None:
        return Executable(None)
    if _is_ament(environment, found):
        return _find_ament(Disk(db), environment, found, name)
    runnable: list[str] = []
    others: list[str] = []
    for folder in _folders(db, environment, package, found.share):
        for path in _walked(db, folder).get(name, ()):
            mode = mode_of(db, path)
            if mode is not None and stat.S_ISREG(mode):
                (runnable if mode & _RUNNABLE == _RUNNABLE else others).append(path)
    candidates = tuple(dict.fromkeys(runnable))
    return Executable(candidates[0] if candidates else None, candidates, found.share, tuple(dict.fromkeys(others)))


def _is_ament(environment: Environment, package: Package) -> bool:
    """Whether `launch_ros` looks for its executables. One that both generations build (`cmake`) is that of the
    environment."""
    return package.is_ament or (package.build_type == "cmake" and environment.ros.ament)


def _find_ament(disk: Disk, environment: Environment, package: Package, name: str) -> Executable:
    """`lib/<package>` of the prefixes, as `launch_ros` looks for it, and what the package in the source will put
    there: the source of a Python package first, since that is what is edited."""
    entry = python_build(disk, package).scripts.get(name)
    installed = [
        path
        for prefix in environment.ament_prefixes
        if _is_runnable(disk.db, path := os.path.join(prefix, "lib", package.name, name))
    ]
    if entry is not None and entry.file is not None:
        entry_point = f"{entry.module}:{entry.function}"
        return Executable(entry.file, (entry.file, *installed), package.share, entry_point=entry_point)
    program = cmake_build(disk, package).programs.get(name)
    script = program.path if program is not None else python_build(disk, package).programs.get(name)
    source = [script] if script is not None and disk.is_file(script) else []
    candidates = (*installed, *source)
    return Executable(candidates[0] if candidates else None, candidates, package.share)


def _build(db: Database, environment: Environment, package: str) -> Build:
    found = environment.packages.get(package)
    return cmake_build(Disk(db), found) if found is not None else Build()


@query
def _words_of_lists(db: Database, environment: Environment, package: str) -> frozenset[str]:
    """The words of all the `CMakeLists.txt` of a package; `add_executable(name` is one."""
    words: set[str] = set()
    for path in _walked(db, environment.packages[package].share).get("CMakeLists.txt", ()):
        found = Disk(db).content(path)
        if found is not None:
            plain = re.sub(r"#.*", "", found.replace("${PROJECT_NAME}", package))
            words.update(re.findall(r"[^\s()\"]+", plain))
            words.update(f"add_executable({name}" for name in _EXECUTABLE.findall(plain))
    return frozenset(words)


@query
def _names(db: Database, environment: Environment, package: str) -> tuple[str, ...]:
    found = environment.packages.get(package)
    if found is None:
        return ()
    disk, build = Disk(db), _build(db, environment, package)
    of_ros2 = _is_ament(environment, found)
    python = python_build(disk, found) if of_ros2 else None
    names = {*python.scripts, *python.programs} if python is not None else set()
    for prefix in environment.ament_prefixes if of_ros2 else ():
        folder = os.path.join(prefix, "lib", package)
        names |= {name for name in disk.names(folder) if _is_runnable(db, os.path.join(folder, name))}
    names |= {target.output for target in build.targets.values() if target.kind == "executable"}
    names |= set(build.programs)
    for folder in _folders(db, environment, package, found.share) if not of_ros2 else ():
        for name, paths in _walked(db, folder).items():
            if name not in names and any(_is_runnable(db, path) for path in paths):
                names.add(name)
    return tuple(sorted(names))


@query
def _components(db: Database, environment: Environment, package: str) -> tuple[str, ...]:
    found = set(_build(db, environment, package).components)
    for _, listed in _listed_components(db, environment, package):
        found.update(listed)
    return tuple(sorted(found))


@query
def _component(db: Database, environment: Environment, package: str, plugin: str) -> Executable:
    found = environment.packages.get(package)
    if found is None:
        return Executable(None)
    prefix, listed = next(_listed_components(db, environment, package), ("", {}))
    library = os.path.join(prefix, listed.get(plugin, ""))
    there = plugin in listed and Disk(db).is_file(library)
    return Executable(library if there else None, (library,) if there else (), found.share)


def _listed_components(db: Database, environment: Environment, package: str) -> Iterator[tuple[str, Mapping[str, str]]]:
    """The prefixes that list components of a package, each with the libraries by class."""
    for prefix in environment.ament_prefixes:
        listed = Disk(db).content(os.path.join(prefix, _COMPONENTS, package))
        if listed is not None:
            lines = (line.partition(";") for line in listed.splitlines())
            yield prefix, {cls.strip(): library.strip() for cls, _, library in lines if cls.strip()}


def _folders(db: Database, environment: Environment, package: str, share: str) -> Iterator[str]:
    spaces = (*environment.devel_spaces, *environment.system_prefixes)
    for space in spaces:
        found = [folder for folder in _in_space(db, environment, space, package) if mode_of(db, folder) is not None]
        if found:
            yield from found
            break
    yield share


def _in_space(db: Database, environment: Environment, space: str, package: str) -> Iterator[str]:
    yield from (os.path.join(space, kind, package) for kind in ("lib", "libexec", "share"))
    source = _sources_of_space(db, environment, space).get(package)
    if source is not None:
        yield source


@query
def _sources_of_space(db: Database, environment: Environment, space: str) -> Mapping[str, str]:
    """The folders of the packages that a space was made from, by name: as they are when an environment is detected."""
    sources: dict[str, str] = {}
    for folder in source_spaces(Disk(db), space):
        for package_there in crawl(folder, metapackages=True):
            sources.setdefault(package_there.name, package_there.share)
    return sources


@query
def _walked(db: Database, folder: str) -> Mapping[str, Sequence[str]]:
    """The paths of the files below a folder, by name."""
    by_name: dict[str, list[str]] = {}
    for place, _, files in walk(folder):
        names_in(db, place)  # walked again as something in it comes or goes
        for name in files:
            by_name.setdefault(name, []).append(os.path.join(place, name))
    return by_name


def source_spaces(disk: Disk, space: str) -> list[str]:
    """The source folders that a devel space was made from, as its `.catkin` file lists them."""
    marker = disk.data(os.path.join(space, ".catkin"))
    listed = os.fsdecode(marker[:_MAX_MARKER]) if isinstance(marker, bytes) else ""
    by_place = {
        disk.real_path(folder): folder for folder in reversed(listed.split(";")) if folder and "\0" not in folder
    }
    return list(reversed(by_place.values()))


def _is_runnable(db: Database, path: str) -> bool:
    mode = mode_of(db, path)
    return mode is not None and stat.S_ISREG(mode) and mode & _RUNNABLE == _RUNNABLE
