"""URD006: a mesh of the robot whose file does not exist."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import NamedTuple

from preflight_analysis.environment.git_ignored import is_ignored
from preflight_analysis.environment.installed_paths import located
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.model.context import Context
from preflight_analysis.model.files import address, meant_file, nearest_file, package_folder
from preflight_analysis.model.installed import lack_of_made, near_package
from preflight_analysis.model.problems import rename, shown
from preflight_analysis.model.robots import robots_in_part, written
from preflight_analysis.rules.further_reading import URDF_LINK
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for robot in robots_in_part(context):
        said = set[str]()  # a folder that is missing is of many meshes
        for mesh in robot.description.meshes:
            found = _missing(context, mesh)
            if found is None or found.message in said:
                continue
            said.add(found.message)
            place, related = written(context, robot, "mesh", "filename", mesh)
            fixes: tuple[Fix, ...] = rename(context, place, found.old, found.new) if found.new else ()
            yield rule.claim(
                found.message,
                place,
                subject=found.about,
                kind="absent" if found.meant is None else "near",
                doubts=doubts(MADE_ELSEWHERE=found.is_ignored),
                candidates=(found.meant,),
                related=related,
                fixes=fixes,
                lack=lack_of_made(context, found.path) if found.path else None,
            )


class _Missing(NamedTuple):
    """What is wrong with the name of a mesh: the path that is not there, "" where its package is not; what was meant,
    and what in it to replace by what. `is_ignored`: git ignores the file."""

    message: str
    about: Subject
    path: str = ""
    meant: str | None = None
    old: str = ""
    new: str = ""
    is_ignored: bool = False


def _missing(context: Context, mesh: str) -> _Missing | None:
    """None for a file that is there, and for one of a package or folder that this machine does not have."""
    named = address(context.environment, mesh)
    if named is None:
        return None
    path = named.path
    if path is None:
        near = near_package(context, named.package)
        if near is None:
            return None
        message = f"package '{named.package}' of a mesh does not exist; did you mean '{near}'?"
        return _Missing(message, Subject("package", named.package), meant=near, old=named.package, new=near)
    if package_folder(path, context.environment) is None:
        return None
    if context.disk.exists(located(context.disk, context.environment, path)):
        return None
    message, about = f"mesh '{shown(path, context)}' does not exist", Subject("file", path)
    if is_ignored(context.disk, path):
        return _Missing(f"{message}; git ignores it, so each machine may create it", about, path, is_ignored=True)
    near_path = nearest_file(context.disk, path, context.environment)
    if near_path is None:
        folder = os.path.dirname(path)
        if not context.disk.exists(located(context.disk, context.environment, folder)):
            message, about = f"folder '{shown(folder, context)}' of a mesh does not exist", Subject("file", folder)
        return _Missing(f"{message}{meant_file(context, path, None)}", about, path)
    same_folder = os.path.dirname(near_path) == os.path.dirname(path)
    old, new = (os.path.basename(path), os.path.basename(near_path)) if same_folder else ("", "")
    return _Missing(f"{message}{meant_file(context, path, near_path)}", about, path, near_path, old, new)


RULE = Rule(
    id="URD006",
    name="mesh-not-found",
    effect="misbehaves",
    kind="absent",
    sometimes=(Reason.MADE_ELSEWHERE, Reason.NOT_HERE),
    what="Checks for a mesh of the robot description whose file does not exist: `package://`, or `file://` below a "
    "package. Packages that are not installed here are not checked.",
    why="RViz and the simulator show the robot without the part, and a missing collision mesh makes planners ignore "
    "it.",
    example='<mesh filename="package://arm_description/meshes/elbow.stl"/>  <!-- the file is elbow.STL -->',
    instead='<mesh filename="package://arm_description/meshes/elbow.STL"/>',
    references=(URDF_LINK,),
    check=_check,
    in_branches=True,
)
