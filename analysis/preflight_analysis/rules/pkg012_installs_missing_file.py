"""PKG012: a build file installs what is not there."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from typing import NamedTuple

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location
from preflight_analysis.environment.build import LISTS, MADE
from preflight_analysis.environment.cmake_syntax import may_make_files
from preflight_analysis.environment.git_ignored import is_ignored
from preflight_analysis.environment.git_submodules import left_submodule
from preflight_analysis.environment.installed_paths import cmake_build, python_build
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.rules.further_reading import FILE_SYSTEM, PYTHON_PACKAGES
from preflight_analysis.rules.packages import check_packages, line_of, said_at
from preflight_analysis.rules.rule import Rule

_AT_ONCE = "catkin_install_python"
"""What of catkin looks for the files when it configures."""
_UNRESOLVED = re.compile(r"[$<>*?]")


def of_package(rule: Rule, disk: Disk, environment: Environment, package: Package) -> Iterator[Finding]:
    """What a package installs that is not there."""
    said = set[str]()
    for missing in _installed(disk, package):
        path, written, place = missing.path, missing.written, missing.place
        if path in said or _UNRESOLVED.search(path) or not path.startswith(f"{package.share}{os.sep}"):
            continue
        said.add(path)
        below = os.path.relpath(path, package.share)
        build_file = "setup.py" if package.build_type == "ament_python" else LISTS
        if disk.is_folder(path):
            message = f"{build_file} installs '{written}', which is a folder: data_files takes files only"
            yield rule.claim(message, place, subject=Subject("file", path), kind="invalid")
            continue
        if left_submodule(disk, path) is not None:
            continue
        ignored = is_ignored(disk, path, as_folder=missing.is_folder)
        near = None if ignored else nearest(os.path.basename(path), disk.names(os.path.dirname(path)))
        if near is None and not ignored and os.path.dirname(below) == "resource":
            near = next((each for each in disk.names(os.path.dirname(path)) if not each.startswith(".")), None)
        meant = os.path.join(os.path.dirname(below), near) if near is not None else None
        fails = "the package does not build" if missing.at_once else "`catkin_make install` fails"
        yield rule.claim(
            f"{build_file} installs '{written}', which does not exist: {fails}{did_you_mean(meant)}",
            place,
            subject=Subject("file", path),
            effect=None if missing.at_once else "misbehaves",
            kind="absent" if meant is None else "near",
            doubts=doubts(MADE_ELSEWHERE=ignored, MADE_BY_BUILD=missing.made),
            candidates=(meant,),
        )


class _Missing(NamedTuple):
    """A file or folder that cannot be installed as it is: how it is written, and where. `made`: the build may make it;
    `at_once`: the build fails already, not the installation alone, which ROS 1 seldom needs."""

    path: str
    written: str
    place: Location
    made: bool
    at_once: bool
    is_folder: bool = False


def _installed(disk: Disk, package: Package) -> Iterator[_Missing]:
    if package.build_type == "ament_python":
        build = python_build(disk, package)
        document = disk.text(build.file) if build.file is not None else None
        for each in build.called.copied if build.called is not None and isinstance(document, Document) else ():
            path = os.path.normpath(os.path.join(package.share, each.source))
            if not disk.is_file(path) and isinstance(document, Document):
                yield _Missing(path, each.source, line_of(document, each.line), made=False, at_once=True)
    elif package.build_type in ("ament_cmake", "catkin"):
        for item in cmake_build(disk, package).installed:
            said = item.said
            if said is None or not said.sure or item.optional or disk.exists(item.source) or f"/{MADE}" in item.source:
                continue
            written = os.path.relpath(item.source, os.path.dirname(said.file))
            place = said_at(disk, said, written)
            if place is not None:
                text = disk.content(said.file) or ""
                at_once = package.is_ament or text[said.at :].lower().startswith(_AT_ONCE)
                yield _Missing(item.source, written, place, may_make_files(text), at_once, item.is_folder)


RULE = Rule(
    id="PKG012",
    name="installs-missing-file",
    effect="stops-node",
    kind="absent",
    sometimes=("misbehaves", Reason.MADE_ELSEWHERE, Reason.MADE_BY_BUILD),
    what="Checks for a file or folder that `setup.py` or `CMakeLists.txt` installs and that does not exist. The marker "
    "`resource/<package>` is one of them.",
    why="The build of the package fails, so none of its nodes and launch files is found. With catkin `install(...)` "
    "fails only when the package is installed. Git does not keep empty folders, so one that is empty here is missing "
    "in every clone.",
    example="install(DIRECTORY lanch DESTINATION share/${PROJECT_NAME})",
    instead="install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})",
    references=(PYTHON_PACKAGES, FILE_SYSTEM),
    check=check_packages(of_package),
    of_package=of_package,
)
