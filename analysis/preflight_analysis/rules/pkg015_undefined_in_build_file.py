"""PKG015: `CMakeLists.txt` refers to a source, target or package that it does not have."""

from __future__ import annotations

import os
from collections.abc import Iterator

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.environment.build import LISTS
from preflight_analysis.environment.cmake_references import Broken, Kind, broken_references
from preflight_analysis.environment.cmake_syntax import may_make_files, word_end
from preflight_analysis.environment.git_ignored import is_ignored
from preflight_analysis.environment.git_submodules import left_submodule
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.rules.further_reading import CMAKE_TARGETS, PYTHON_PACKAGES
from preflight_analysis.rules.packages import check_packages
from preflight_analysis.rules.rule import Rule

_STOPS = "CMake stops, and the package does not build"
_TEXTS: dict[Kind, str] = {
    "source": "source file '{name}' of target '{by}' does not exist: " + _STOPS,
    "interface": "interface file '{name}' does not exist: {by}() fails, and the package does not build",
    "unlisted": "interface file '{name}'{more} is not listed in {by}(): no code is generated",
    "target": "target '{name}' of {by}() is not defined: " + _STOPS,
    "late": "target '{name}' is defined after {by}() uses it: " + _STOPS,
    "generated": "target '{name}' of {by}() is not defined without generate_messages(): " + _STOPS,
    "itself": "find_package() requires '{name}', the package itself, which is not built yet: " + _STOPS,
    "package": "package '{name}' of {by}() has no find_package(): " + _STOPS,
    "command": "{by}() is an unknown command without find_package({name}): " + _STOPS,
    "module": "{by}() needs a folder '{name}', which does not exist: " + _STOPS,
    "setup": "{by}() needs a '{name}', which does not exist: " + _STOPS,
}
_OF_FILES = ("source", "interface")
_OF_NAMES = ("target", "package")


def of_package(rule: Rule, disk: Disk, environment: Environment, package: Package) -> Iterator[Finding]:
    """What the build file of a package refers to in vain."""
    path = os.path.join(package.share, LISTS)
    document = disk.text(path) if package.build_type in ("ament_cmake", "catkin") else None
    if not isinstance(document, Document):
        return
    for each in broken_references(disk, environment, package):
        file = os.path.normpath(os.path.join(package.share, each.name)) if each.kind in _OF_FILES else None
        if file is not None and left_submodule(disk, file) is not None:
            continue
        ignored = file is not None and is_ignored(disk, file)
        near = None if ignored else _near(disk, each, file)
        end = each.at + len(each.name)
        written = document.text[each.at : end] == each.name
        more = f" (and {len(each.others)} more)" if each.kind == "unlisted" and each.others else ""
        yield rule.claim(
            _TEXTS[each.kind].format(name=each.name, by=each.by, more=more) + did_you_mean(near),
            document.location(Span(each.at, end) if written else Span(each.at, word_end(document.text, each.at))),
            subject=Subject("file" if file is not None else "name", file or each.name),
            effect="note" if each.kind == "unlisted" else None,
            kind="absent" if near is None else "near",
            doubts=doubts(MADE_ELSEWHERE=ignored, MADE_BY_BUILD=file is not None and may_make_files(document.text)),
            candidates=(near,),
        )


def _near(disk: Disk, each: Broken, file: str | None) -> str | None:
    if file is None:
        return nearest(each.name, each.others) if each.kind in _OF_NAMES else None
    name = nearest(os.path.basename(file), disk.names(os.path.dirname(file)))
    return os.path.join(os.path.dirname(each.name), name) if name is not None else None


RULE = Rule(
    id="PKG015",
    name="undefined-in-build-file",
    effect="stops-node",
    kind="absent",
    sometimes=("note", Reason.MADE_ELSEWHERE, Reason.MADE_BY_BUILD),
    what="Checks `CMakeLists.txt` for what it names and does not have: a source or interface file that does not exist, "
    "a target that no command before defines, a package or command without its `find_package()`, the package itself in "
    "`find_package()`, `catkin_python_setup()` without `setup.py`. Also for interface files that are not listed. What "
    "depends on conditions, unknown variables or other CMake files is left out.",
    why="CMake stops, so none of the nodes and launch files of the package is found. No code is generated for an "
    "interface file that is not listed.",
    example="add_executable(driver src/driver.cpp)\ninstall(TARGETS drivers DESTINATION lib/${PROJECT_NAME})",
    instead="add_executable(driver src/driver.cpp)\ninstall(TARGETS driver DESTINATION lib/${PROJECT_NAME})",
    references=(CMAKE_TARGETS, PYTHON_PACKAGES),
    check=check_packages(of_package),
    of_package=of_package,
)
