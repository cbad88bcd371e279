"""PKG011: what a package installs where ROS 2 does not look for it, or cannot run it."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.environment.build import Build, Installed
from preflight_analysis.environment.installed_paths import cmake_build, python_build
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.launch.recognize import LAUNCH_SUFFIXES
from preflight_analysis.rules.further_reading import FILE_SYSTEM, PYTHON_PACKAGES
from preflight_analysis.rules.packages import check_packages, line_of, said_at
from preflight_analysis.rules.rule import Rule

if TYPE_CHECKING:
    from preflight_analysis.environment.setup_py import Called

_OF_ROS2_LAUNCH = (*LAUNCH_SUFFIXES, ".launch.py", "_launch.py", ".launch.xml", ".launch.yaml")
_MANIFEST = "package.xml"
_SETTINGS = "setup.cfg"
_SCRIPTS = (".py", ".sh", ".bash", "")
_MAIN = "__main__"
_CLIENT = "rclpy"


def of_package(rule: Rule, disk: Disk, environment: Environment, package: Package) -> Iterator[Finding]:
    """What of a package goes elsewhere."""
    if package.build_type == "ament_python":
        build = python_build(disk, package)
        document = disk.text(build.file) if build.file is not None else None
        if build.called is not None and isinstance(document, Document):
            yield from _scripts_of_python(rule, disk, package, build.called, document)
            yield from _files_of_python(rule, package, build.called, document)
    elif package.build_type == "ament_cmake":
        made = cmake_build(disk, package)
        yield from _of_cmake(rule, disk, package, made)


def _scripts_of_python(
    rule: Rule, disk: Disk, package: Package, called: Called, document: Document
) -> Iterator[Finding]:
    if not called.entries or not called.all_known:
        return
    wanted = f"lib/{package.name}"
    where = called.scripts_to.get("install")
    settings = disk.text(os.path.join(package.share, _SETTINGS))
    if where is None:
        why = f"{_SETTINGS} has no `install_scripts`" if isinstance(settings, Document) else f"{_SETTINGS} is missing"
        yield rule.claim(
            f"executables of '{package.name}' are installed in bin, not in {wanted}: {why}; `ros2 run` and launch "
            "files do not find them",
            line_of(document, called.entries[0][1]),
            subject=Subject("executable", package.name),
            kind="unreachable",
            # Who sources the workspace has bin on the PATH: tools that are no nodes may be meant for it.
            doubts=doubts(INTENDED=_CLIENT not in package.dependencies),
        )
        return
    for command, folder in called.scripts_to.items():
        if folder == wanted or not folder.startswith("lib/"):
            continue
        in_settings = isinstance(settings, Document) and folder in settings.text
        lines = settings.text.splitlines() if in_settings and isinstance(settings, Document) else []
        of_command = (i for i, text in enumerate(lines) if folder in text and _is_of(lines, i, command))
        number = next(of_command, called.line)
        place = line_of(settings if in_settings and isinstance(settings, Document) else document, number, folder)
        when = "" if command == "install" else " with `colcon build --symlink-install`"
        yield rule.claim(
            f"executables of '{package.name}' are installed in {folder}, not in {wanted}{when}; `ros2 run` and launch "
            "files do not find them",
            place,
            subject=Subject("executable", package.name),
            kind="unreachable",
            effect="stops-node" if command == "install" else "misbehaves",
        )


def _is_of(lines: list[str], index: int, command: str) -> bool:
    """Whether a line of setup.cfg is in the section of a command."""
    return next((text.strip() == f"[{command}]" for text in reversed(lines[:index]) if text.startswith("[")), False)


def _files_of_python(rule: Rule, package: Package, called: Called, document: Document) -> Iterator[Finding]:
    share, said = f"share/{package.name}", set[str]()
    found = {each.source for each in called.copied if f"{each.destination}/".startswith(f"{share}/")}
    for each in called.copied:
        if each.source in found:
            continue  # it is where it belongs, and elsewhere as well
        folders = each.destination.split("/")
        is_below = f"{each.destination}/".startswith((f"{share}/", "share/ament_index/")) or folders == ["share"]
        is_launch = each.source.endswith(_OF_ROS2_LAUNCH) and folders[0] not in ("lib", "..")
        if each.destination in said or is_below or not (is_launch or each.source == _MANIFEST):
            continue
        if os.path.isabs(each.destination):
            continue
        said.add(each.destination)
        yield rule.claim(
            f"{each.source} is installed in {each.destination}, not below {share}, where ROS 2 looks for it",
            line_of(document, each.line),
            subject=Subject("file", each.source),
            kind="unreachable",
        )
    if called.name is not None and _plain(called.name) != _plain(package.name):
        yield rule.claim(
            f"setup.py calls the package '{called.name}', {_MANIFEST} calls it '{package.name}'",
            line_of(document, called.line),
            subject=Subject("package", called.name),
            kind="conflict",
            effect="note",
        )


def _plain(name: str) -> str:
    return name.lower().replace("-", "_").replace(".", "_")


def _of_cmake(rule: Rule, disk: Disk, package: Package, build: Build) -> Iterator[Finding]:
    wanted, said = f"lib/{package.name}", set[str]()
    run = {item.name for item in build.installed if item.runs and _folder(item, package).startswith(wanted)}
    for item in build.installed:
        folder, where = _folder(item, package), item.said
        if where is None or not where.sure or item.runs or not (folder == wanted or folder.startswith(f"{wanted}/")):
            continue
        for path in _scripts_in(disk, item.source, package):
            name = os.path.basename(path)
            if name in run or path in said:
                continue
            said.add(path)
            below = os.path.relpath(path, package.share)
            place = said_at(disk, where, os.path.relpath(item.source, package.share)) or said_at(disk, where)
            if place is not None:
                yield rule.claim(
                    f"script '{below}' is installed without the permission to be executed: `ros2 run` and launch files "
                    f"do not find '{name}'; use install(PROGRAMS ...)",
                    place,
                    subject=Subject("executable", name),
                    kind="invalid",
                    # A link to a file that may be executed stays one.
                    doubts=doubts(UNSEEN=disk.is_program(path)),
                )
    for target in build.installed_targets:
        made = build.targets.get(target.name)
        others = [each for each in build.installed_targets if each.name == target.name]
        is_elsewhere = target.destination.startswith("lib/") and target.destination.split("/")[1] != package.name
        if made is None or made.kind != "executable" or not is_elsewhere or len(others) > 1 or not target.said.sure:
            continue
        place = said_at(disk, target.said, target.name)
        if place is not None:
            yield rule.claim(
                f"executable '{made.output}' is installed in {target.destination}, not in {wanted}; `ros2 run` and "
                "launch files do not find it",
                place,
                subject=Subject("executable", made.output),
                kind="unreachable",
            )


def _folder(item: Installed, package: Package) -> str:
    return os.path.normpath(item.destination.replace("${PROJECT_NAME}", package.name)).lstrip("/")


def _scripts_in(disk: Disk, path: str, package: Package) -> Iterator[str]:
    """The scripts that are meant to be started: what a program imports has no first line that names an interpreter, or
    no launch file of the package names it."""
    names = disk.names(path) if disk.is_folder(path) else ()
    for each in [os.path.join(path, name) for name in sorted(names)] or [path]:
        text = disk.content(each) if os.path.splitext(each)[1] in _SCRIPTS and disk.is_file(each) else None
        if text is None or not text.startswith("#!") or (each.endswith(".py") and _MAIN not in text):
            continue
        if not _is_imported(disk, each) or _is_launched(disk, package, os.path.basename(each)):
            yield each


def _is_imported(disk: Disk, path: str) -> bool:
    """Whether a script beside it imports it."""
    folder, name = os.path.split(path)
    imports = re.compile(rf"^[ \t]*(?:from|import)[ \t]+\.?{re.escape(name.removesuffix('.py'))}\b", re.MULTILINE)
    beside = (os.path.join(folder, other) for other in disk.names(folder) if other.endswith(".py") and other != name)
    return path.endswith(".py") and any(imports.search(disk.content(other) or "") for other in beside)


def _is_launched(disk: Disk, package: Package, name: str) -> bool:
    files = (file for file in files_in(disk, package.share, deep=True) if file.endswith(_OF_ROS2_LAUNCH))
    return any(name in (disk.content(file) or "") for file in files)


RULE = Rule(
    id="PKG011",
    name="installed-elsewhere",
    effect="stops-node",
    kind="unreachable",
    sometimes=(Reason.INTENDED, Reason.UNSEEN),
    what="Checks for executables that are not installed in `lib/<package>`, for scripts that are installed there "
    "without the permission to be executed, and for launch files that go elsewhere than below `share/<package>`.",
    why="`ros2 run` and `ros2 launch` look for executables in `lib/<package>` alone, and for launch files in "
    "`share/<package>`. The build says nothing.",
    example="# setup.cfg of package robot\n[install]\ninstall_scripts=$base/lib/arm",
    instead="# setup.cfg of package robot\n[install]\ninstall_scripts=$base/lib/robot",
    references=(FILE_SYSTEM, PYTHON_PACKAGES),
    generations=(2,),
    check=check_packages(of_package),
    of_package=of_package,
)
