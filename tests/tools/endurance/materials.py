"""Workspaces of real packages: samples of the corpora, or of the fixtures where there are no corpora."""

from __future__ import annotations

import random
import re
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[3]
FORMATS = ("ros1", "xml", "yaml", "python")
"""ROS 1, and the three of ROS 2."""
MAX_BYTES = 30_000
"""Of a file: many edits in small files find more than few in large ones."""
MAX_FILES = 60
"""Of a package."""
_KEPT = frozenset({".launch", ".test", ".machine", ".xml", ".yaml", ".yml", ".py", ".xacro", ".urdf", ".srdf"})
_LAUNCH_XML = re.compile(r"<launch(?=[\s/>])")
_PACKAGES = re.compile(r"(?:find|find-pkg-share|FindPackageShare\(|package_share_directory\()[\s'\"]*([\w-]+)")


@dataclass(frozen=True)
class Package:
    """A real one: its folder, the small files below it, and its launch files by format."""

    name: str
    folder: Path
    files: tuple[Path, ...]
    launch_files: Mapping[str, tuple[Path, ...]]
    names: frozenset[str]
    """Of the packages that its launch files find."""


@dataclass(frozen=True)
class Sample:
    """A workspace that was copied: its folder, and its files by format; `parameters` are other YAML files."""

    folder: Path
    launch_files: Mapping[str, tuple[Path, ...]]
    parameters: tuple[Path, ...]


def packages_of(sources: Sequence[Path]) -> list[Package]:
    """The packages with launch files below some folders, in an order that is the same everywhere."""
    found = []
    for source in sources:
        for manifest in sorted(source.rglob("package.xml")):
            if package := _package(manifest.parent):
                found.append(package)
    return found


def _package(folder: Path) -> Package | None:
    files = []
    for path in sorted(folder.rglob("*")):
        inner = any((parent / "package.xml").exists() for parent in path.parents if folder in parent.parents)
        if path.suffix in _KEPT and path.is_file() and not inner and path.stat().st_size <= MAX_BYTES:
            files.append(path)
        if len(files) == MAX_FILES:
            break
    launch_files: dict[str, list[Path]] = {}
    names: set[str] = set()
    for path in files:
        text = path.read_bytes().decode(errors="replace")
        if form := _format(path, text):
            launch_files.setdefault(form, []).append(path)
            names.update(_PACKAGES.findall(text))
    if not launch_files:
        return None
    return Package(folder.name, folder, tuple(files), {f: tuple(p) for f, p in launch_files.items()}, frozenset(names))


def _format(path: Path, text: str) -> str | None:
    if path.suffix == ".py":
        return "python" if "generate_launch_description" in text else None
    if path.suffix in (".yaml", ".yml"):
        return "yaml" if text.startswith("launch:") or "\nlaunch:" in text else None
    if not _LAUNCH_XML.search(text):
        return None
    of_ros2 = re.search(r"\$\(var |\bexec=|find-pkg-share", text) or path.name.endswith("launch.xml")
    return "xml" if of_ros2 else "ros1"


def sample(packages: Sequence[Package], folder: Path, chance: random.Random, forms: Sequence[str], most: int) -> Sample:
    """Copy at most so many packages with files of these formats into `folder/src`, and what their launch files find."""
    by_name = {package.name: package for package in packages}
    chosen: dict[str, Package] = {}
    for form in forms:
        having = [package for package in packages if form in package.launch_files]
        if not having:
            continue
        first = chance.choice(having)
        todo = [first.name]
        while todo and len(chosen) < most:
            package = by_name[todo.pop(0)]
            if package.name not in chosen:
                chosen[package.name] = package
                todo += sorted(name for name in package.names if name in by_name)
        chosen[first.name] = first
    launch_files: dict[str, list[Path]] = {form: [] for form in forms}
    parameters = []
    for package in chosen.values():
        target = folder / "src" / package.name
        for path in (package.folder / "package.xml", *package.files):
            copy = target / path.relative_to(package.folder)
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, copy)
            form = next((form for form, paths in package.launch_files.items() if path in paths), None)
            if form in launch_files:
                launch_files[form].append(copy)
            elif path.suffix == ".yaml":
                parameters.append(copy)
    return Sample(folder, {form: tuple(paths) for form, paths in launch_files.items()}, tuple(parameters))


def variables(folder: Path, generation: int, home: Path) -> dict[str, str]:
    """The environment of a workspace of that generation of ROS."""
    found = {"PATH": "/usr/bin:/bin", "HOME": str(home), "LANG": "C.UTF-8"}
    if generation == 1:
        return {**found, "ROS_VERSION": "1", "ROS_DISTRO": "noetic", "ROS_PACKAGE_PATH": str(folder / "src")}
    return {**found, "ROS_VERSION": "2", "ROS_DISTRO": "jazzy"}


def sources(given: Sequence[Path]) -> tuple[list[Path], str]:
    """The folders to take packages from, and what they are: what was named, else the corpora and the fixtures."""
    if given:
        return list(given), ", ".join(map(str, given))
    shared = REPOSITORY.parent / "shared" / "corpus"
    corpora = [shared / "ros1/src", shared / "ros2/src", REPOSITORY / "out/ros2-python/src"]
    found = [folder for folder in corpora if folder.is_dir()]
    fixtures = [REPOSITORY / "fixtures" / each for each in ("ros1", "ros2/chapter")]
    return [*found, *fixtures], "corpora and fixtures" if found else "fixtures"
