"""PKG014: a variable in `CMakeLists.txt` that nothing sets, where one of a like name is set for nothing."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Iterator

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.environment.build import LISTS
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.rules.further_reading import CMAKE_VARIABLES
from preflight_analysis.rules.packages import check_packages
from preflight_analysis.rules.rule import Rule
from preflight_analysis.slips import edits

_COMMENT = re.compile(r"#[^\n]*")
_USED = re.compile(r"\$\{(\w+)\}")
_SET = re.compile(r"(?i)\b(?:set|file)\s*\(\s*(?:GLOB(?:_RECURSE)?\s+)?(\w+)(?=[\s)])")
_FOUND = re.compile(r"(?i)\b(?:find_package|pkg_\w+)\s*\(\s*(\w+)")
"""Packages, each of which sets variables that begin with its name."""
_OTHERWISE = re.compile(r"(?<![{\w])(\w+)(?![\w}])")


def of_package(rule: Rule, disk: Disk, environment: Environment, package: Package) -> Iterator[Finding]:
    """The variables that are used and nowhere set, with the one that was meant."""
    path = os.path.join(package.share, LISTS)
    document = disk.text(path)
    if not isinstance(document, Document):
        return
    text = _COMMENT.sub(_blanks, document.text)
    bare = Counter(_OTHERWISE.findall(text))
    packages = tuple(f"{name.lower()}_" for name in _FOUND.findall(text))
    used = {found[1]: found for found in _USED.finditer(text)}
    unset = {k: found for k, found in used.items() if k not in bare and not k.lower().startswith(packages)}
    given = {name for name, count in Counter(_SET.findall(text)).items() if unset and count == bare[name]}
    if not given:
        return
    others = (each for each in files_in(disk, package.share, deep=True) if each.endswith((".cmake", LISTS)))
    elsewhere = "\n".join(disk.content(each) or "" for each in others if each != path)
    idle = given.difference(_USED.findall(text), _OTHERWISE.findall(elsewhere), _USED.findall(elsewhere))
    for name, found in unset.items():
        near = nearest(name, idle) if not re.search(rf"\b{name}\b", elsewhere) else None
        if near is not None and edits(name, near, 1) <= 1:
            yield rule.claim(
                f"variable '{name}' is set nowhere and is empty, and '{near}' is used nowhere{did_you_mean(near)}",
                document.location(Span(found.start(1), found.end(1))),
                subject=Subject("name", name),
                kind="near",
                candidates=(near,),
            )


def _blanks(found: re.Match[str]) -> str:
    return " " * len(found[0])


RULE = Rule(
    id="PKG014",
    name="unset-build-variable",
    effect="misbehaves",
    kind="near",
    what="Checks for a variable that `CMakeLists.txt` uses and that no CMake file of the package sets, where it sets "
    "one of a similar name that nothing uses.",
    why="CMake replaces a variable that is not set by nothing and reports no error. The files that it was to list are "
    "not compiled, generated or installed.",
    example="file(GLOB ARM_SRVS srv/*.srv)\nrosidl_generate_interfaces(${PROJECT_NAME} ${AR_SRVS})",
    instead="file(GLOB ARM_SRVS srv/*.srv)\nrosidl_generate_interfaces(${PROJECT_NAME} ${ARM_SRVS})",
    references=(CMAKE_VARIABLES,),
    check=check_packages(of_package),
    of_package=of_package,
)
