"""URD006: a mesh of the robot whose file does not exist."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import NamedTuple

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.git_ignored import is_ignored
from preflight_analysis.environment.installed_paths import located, package_around
from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.model.context import Context
from preflight_analysis.model.descriptions import LOOSE, below_package, doubts_of, model_folders, named_file
from preflight_analysis.model.files import address, meant_file, nearest_file, package_folder
from preflight_analysis.model.installed import lack_of_made, near_package
from preflight_analysis.model.nearest import did_you_mean
from preflight_analysis.model.problems import rename, rename_in, shown
from preflight_analysis.model.robots import robots_in_part, written
from preflight_analysis.robot.xacro import Written, XacroFile, xacro_file
from preflight_analysis.rules.further_reading import URDF_LINK
from preflight_analysis.rules.rule import Rule

_PACKAGE = "package://"
_FILE = "file://"
_MODEL = "model://"


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


def _of_description(rule: Rule, disk: Disk, environment: Environment, path: str) -> Iterator[Finding]:
    """What a file names for itself, as far as it is a file of the workspace whatever is computed."""
    file = xacro_file(disk.db, path)
    reported = set[str]()
    for each in file.files if file is not None and not file.document.problems else ():
        found = _missing_of(disk, environment, file, each) if file is not None else None
        if file is None or found is None or found.message in reported:
            continue
        reported.add(found.message)
        yield rule.claim(
            found.message,
            file.document.location(each.span),
            subject=found.about,
            kind="absent" if found.meant is None else "near",
            doubts=(*LOOSE, *doubts_of(each.around, other=False), *doubts(MADE_ELSEWHERE=found.is_ignored)),
            candidates=(found.meant,),
            fixes=rename_in(file.document, each.span, found.old, found.new) if found.new else (),
        )


def _missing_of(disk: Disk, environment: Environment, file: XacroFile, each: Written) -> _Missing | None:
    if each.text.startswith(_MODEL):
        return _missing_model(disk, environment, file.document.path, each.text.removeprefix(_MODEL))
    if not each.text.removeprefix(_FILE).startswith((_PACKAGE, "/", "$(find")):
        return None  # Gazebo looks for any other in its folders of resources
    path = named_file(disk.db, environment, file, each).missing
    package = package_around(environment, path) if path is not None else None
    if path is None or package is None or environment.is_installed(package):
        return None
    return _not_there(disk, environment, "mesh" if each.tag != "texture" else "texture", path)


def _missing_model(disk: Disk, environment: Environment, path: str, name: str) -> _Missing | None:
    """Of a file of a model, which Gazebo looks for in all folders of models: in the workspace there is such a model
    without the file, or the model that names it has it itself."""
    model, _, below = name.partition("/")
    if not below or "$" in name:
        return None
    of_name = model_folders(disk.db, environment).get(model, ())
    package = environment.packages.get(model)
    of_name = (*of_name, *((package.share,) if package is not None else ()))
    if any(disk.exists(os.path.join(folder, below)) for folder in of_name):
        return None
    if len(of_name) == 1:
        return _not_there(disk, environment, "file of a model", os.path.join(of_name[0], below))
    own = os.path.dirname(path)
    if of_name or not disk.exists(os.path.join(own, below)):
        return None
    meant = os.path.basename(own)
    message = f"model '{model}' does not exist in the workspace; did you mean '{meant}', which has '{below}'?"
    return _Missing(message, Subject("file", name), meant, model, meant)


def _not_there(disk: Disk, environment: Environment, what: str, path: str) -> _Missing:
    message, about = f"{what} '{below_package(environment, path)}' does not exist", Subject("file", path)
    if is_ignored(disk, path):
        return _Missing(f"{message}; git ignores it, so each machine may create it", about, is_ignored=True)
    near = nearest_file(disk, path, environment)
    if near is None:
        folder = os.path.dirname(path)
        if not disk.exists(located(disk, environment, folder)):
            message = f"folder '{below_package(environment, folder)}' of a {what} does not exist"
            return _Missing(message, Subject("file", folder))
        return _Missing(message, about)
    same_folder = os.path.dirname(near) == os.path.dirname(path)
    old, new = (os.path.basename(path), os.path.basename(near)) if same_folder else ("", "")
    return _Missing(f"{message}{did_you_mean(below_package(environment, near))}", about, near, old, new)


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
    sometimes=(Reason.MADE_ELSEWHERE, Reason.NOT_HERE, Reason.NOT_GIVEN),
    what="Checks for a mesh of the robot description whose file does not exist: `package://`, or `file://` below a "
    "package. Packages that are not installed here are not checked. The files of descriptions and worlds in the "
    "workspace are checked each for itself, with the files of models (`model://`).",
    why="RViz and the simulator show the robot without the part, and a missing collision mesh makes planners ignore "
    "it.",
    example='<mesh filename="package://arm_description/meshes/elbow.stl"/>  <!-- the file is elbow.STL -->',
    instead='<mesh filename="package://arm_description/meshes/elbow.STL"/>',
    references=(URDF_LINK,),
    check=_check,
    of_description=_of_description,
    in_branches=True,
)
