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
from collections.abc import Iterator

from preflight_analysis.documents.reading import Text, read_text
from preflight_analysis.environment.build import Build, Made
from preflight_analysis.environment.installed_paths import cmake_build, python_build
from preflight_analysis.environment.model import Environment, Executable, Package
from preflight_analysis.environment.packages import crawl
from preflight_analysis.environment.walk import walk

_COMPONENTS = os.path.join("share", "ament_index", "resource_index", "rclcpp_components")
_RUNNABLE = stat.S_IRUSR | stat.S_IXUSR


class ExecutableIndex:
    """Finds executables of one environment and remembers what it found; a new one sees what changed."""

    def __init__(self, environment: Environment) -> None:
        self._environment = environment
        self._found: dict[tuple[str, str], Executable] = {}
        self._files: dict[str, dict[str, list[str]]] = {}
        self._sources: dict[str, dict[str, str]] = {}
        self._targets: dict[str, frozenset[str]] = {}
        self._names: dict[str, tuple[str, ...]] = {}
        self._builds: dict[str, Build] = {}
        self._components: dict[str, tuple[str, ...]] = {}

    def find(self, package: str, name: str) -> Executable:
        """What a node of this `pkg` and `type` runs.

        `name` is the plain name of a file: as for roslaunch, nothing is found for one with a slash in it.
        """
        found = self._found.get((package, name))
        if found is None:
            found = self._found[package, name] = self._find(package, name)
        return found

    def _find(self, package: str, name: str) -> Executable:
        found = self._environment.packages.get(package)
        if found is None:
            return Executable(None)
        if self._is_ament(found):
            return self._find_ament(found, name)
        runnable: list[str] = []
        others: list[str] = []
        for folder in self._folders(package, found.share):
            for path in self._walked(folder).get(name, ()):
                mode = _mode(path)
                if mode is not None:
                    (runnable if mode & _RUNNABLE == _RUNNABLE else others).append(path)
        candidates = tuple(dict.fromkeys(runnable))
        return Executable(candidates[0] if candidates else None, candidates, found.share, tuple(dict.fromkeys(others)))

    def _is_ament(self, package: Package) -> bool:
        """Whether `launch_ros` looks for its executables. One that both generations build (`cmake`) is that of the
        environment."""
        return package.is_ament or (package.build_type == "cmake" and self._environment.ros.ament)

    def _find_ament(self, package: Package, name: str) -> Executable:
        """`lib/<package>` of the prefixes, as `launch_ros` looks for it, and what the package in the source will put
        there: the source of a Python package first, since that is what is edited."""
        entry = python_build(package).scripts.get(name)
        installed = [
            path
            for prefix in self._environment.ament_prefixes
            if _is_runnable(path := os.path.join(prefix, "lib", package.name, name))
        ]
        if entry is not None and entry.file is not None:
            entry_point = f"{entry.module}:{entry.function}"
            return Executable(entry.file, (entry.file, *installed), package.share, entry_point=entry_point)
        program = self._build(package.name).programs.get(name)
        source = [program.path] if program is not None and os.path.isfile(program.path) else []
        candidates = (*installed, *source)
        return Executable(candidates[0] if candidates else None, candidates, package.share)

    def is_build_target(self, package: str, name: str) -> bool:
        """Whether a `CMakeLists.txt` of the package names the executable: it is there once the workspace is built.

        Where the file is not understood a word of it is taken for its word; `${PROJECT_NAME}` is the package.
        """
        found = self._environment.packages.get(package)
        if found is None:
            return False
        if self.made_of(package, name) is not None:
            return True
        if package not in self._targets:
            words: set[str] = set()
            for path in self._walked(found.share).get("CMakeLists.txt", ()):
                text = read_text(path)
                if isinstance(text, Text):
                    plain = re.sub(r"#.*", "", text.text.replace("${PROJECT_NAME}", package))
                    words.update(re.findall(r"[^\s()\"]+", plain))
            self._targets[package] = frozenset(words)
        return name in self._targets[package]

    def made_of(self, package: str, name: str) -> Made | None:
        """The file in the source of the package that the executable is made of, once it is built or installed."""
        return self._build(package).made_of(name)

    def _build(self, package: str) -> Build:
        if package not in self._builds:
            found = self._environment.packages.get(package)
            self._builds[package] = cmake_build(found) if found is not None else Build()
        return self._builds[package]

    def names(self, package: str) -> tuple[str, ...]:
        """All that a node of this package could name as its type, what is not built yet as well, sorted.

        Empty for an unknown package.
        """
        found = self._environment.packages.get(package)
        if found is None:
            return ()
        if package not in self._names:
            build = self._build(package)
            of_ros2 = self._is_ament(found)
            names = set(python_build(found).scripts) if of_ros2 else set()
            for prefix in self._environment.ament_prefixes if of_ros2 else ():
                names |= set(_listed(os.path.join(prefix, "lib", package)))
            names |= {target.output for target in build.targets.values() if target.kind == "executable"}
            names |= set(build.programs)
            for folder in self._folders(package, found.share) if not of_ros2 else ():
                for name, paths in self._walked(folder).items():
                    if name not in names and any(_is_runnable(path) for path in paths):
                        names.add(name)
            self._names[package] = tuple(sorted(names))
        return self._names[package]

    def components(self, package: str) -> tuple[str, ...]:
        """The classes of the package that a container can load, as the prefixes list them and as its `CMakeLists.txt`
        registers them, sorted; empty where nothing of that is known."""
        if package not in self._components:
            found = set(self._build(package).components)
            for prefix in self._environment.ament_prefixes:
                listed = read_text(os.path.join(prefix, _COMPONENTS, package))
                if isinstance(listed, Text):
                    found |= {line.partition(";")[0].strip() for line in listed.text.splitlines()}
            self._components[package] = tuple(sorted(found - {""}))
        return self._components[package]

    def _folders(self, package: str, share: str) -> Iterator[str]:
        spaces = (*self._environment.devel_spaces, *self._environment.system_prefixes)
        for space in spaces:
            found = [f for f in self._in_space(space, package) if os.path.exists(f)]
            if found:
                yield from found
                break
        yield share

    def _in_space(self, space: str, package: str) -> Iterator[str]:
        yield from (os.path.join(space, kind, package) for kind in ("lib", "libexec", "share"))
        if space not in self._sources:
            sources: dict[str, str] = {}
            for folder in source_spaces(space):
                for package_there in crawl(folder, metapackages=True):
                    sources.setdefault(package_there.name, package_there.share)
            self._sources[space] = sources
        if package in self._sources[space]:
            yield self._sources[space][package]

    def _walked(self, folder: str) -> dict[str, list[str]]:
        if folder not in self._files:
            by_name: dict[str, list[str]] = {}
            for place, _, files in walk(folder):
                for name in files:
                    by_name.setdefault(name, []).append(os.path.join(place, name))
            self._files[folder] = by_name
        return self._files[folder]


def source_spaces(space: str) -> list[str]:
    """The source folders that a devel space was made from, as its `.catkin` file lists them."""
    try:
        with open(os.path.join(space, ".catkin"), encoding="utf-8", errors="surrogateescape") as marker:
            listed = marker.read(65536)
    except OSError:
        return []
    by_place = {
        os.path.realpath(folder): folder for folder in reversed(listed.split(";")) if folder and "\0" not in folder
    }
    return list(reversed(by_place.values()))


def _listed(folder: str) -> list[str]:
    try:
        return [name for name in os.listdir(folder) if _is_runnable(os.path.join(folder, name))]
    except OSError:
        return []


def _mode(path: str) -> int | None:
    """The mode of a regular file, None for what is none (a dangling link, a socket)."""
    try:
        mode = os.stat(path).st_mode
    except OSError:
        return None
    return mode if stat.S_ISREG(mode) else None


def _is_runnable(path: str) -> bool:
    mode = _mode(path)
    return mode is not None and mode & _RUNNABLE == _RUNNABLE
