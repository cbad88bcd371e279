"""What a package builds and installs, as its build files say."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import field
from typing import Literal

from preflight_analysis.dataclass import dataclass

LISTS = "CMakeLists.txt"
"""The name of a build file of CMake."""
SETUP, SETTINGS = "setup.py", "setup.cfg"
BUILD_FILES = (LISTS, SETUP, SETTINGS)
"""The files of a package that say how it is built and installed."""
MADE = "<build>"
"""The folder, below that of the source, that stands for where CMake makes files."""


@dataclass(frozen=True, slots=True)
class Said:
    """Where a build file says something: the command at an offset."""

    file: str
    at: int
    sure: bool
    """Whether it is said under no condition."""


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
    said: Said | None = None


@dataclass(frozen=True, slots=True)
class Installed:
    """A file or folder that is installed, and the folder below the prefix in which it then is."""

    source: str
    destination: str
    name: str
    """What it is called there; "" where only what is in the folder is installed."""
    said: Said | None = None
    optional: bool = False
    """Whether it need not be there."""
    runs: bool = False
    """Whether it may be executed once it is installed."""
    is_folder: bool = False


@dataclass(frozen=True, slots=True)
class InstalledTarget:
    """A target that is installed, and the folder below the prefix in which programs then are."""

    name: str
    destination: str
    said: Said


@dataclass(frozen=True, slots=True)
class Required:
    """A package without which CMake stops."""

    name: str
    said: Said


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
    components_said: Mapping[str, Said] = field(default_factory=dict)
    """Where each class is registered."""
    installed_targets: tuple[InstalledTarget, ...] = ()
    targets_said: Mapping[str, Said] = field(default_factory=dict)
    """Where each executable is made, without those of tests."""
    parameter_libraries: Mapping[str, str] = field(default_factory=dict)
    """The YAML file of each library of generate_parameter_library, by the name that its header has."""
    component_programs: Mapping[str, str] = field(default_factory=dict)
    """The class of the one component that an executable is made to run, by the name of the executable."""
    plugin_files: tuple[str, ...] = ()
    """The descriptions of plugins that it exports, as ROS 2 has them; those of ROS 1 stand in the manifest."""
    include_folders: tuple[str, ...] = ()
    """Where the headers of its targets lie."""
    python_packages: Mapping[str, str] = field(default_factory=dict)
    """The folder of each Python package that it installs, by the name that it is imported by."""
    required: tuple[Required, ...] = ()
    """What `find_package` needs, the components of catkin too."""
    all_named: bool = True
    """Whether the name of each executable is known."""
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
            for link in (each.rpartition("::")[2] for each in current.links):  # an alias has the package before it
                if link in self.targets and link not in seen:
                    seen.add(link)
                    pending.append(self.targets[link])
        return tuple(found)


def _stem(path: str) -> str:
    return os.path.splitext(os.path.basename(path))[0].lower()
