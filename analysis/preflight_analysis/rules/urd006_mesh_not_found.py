"""URD006: a mesh of the robot whose file does not exist."""

from __future__ import annotations

import os
from collections.abc import Iterator

from preflight_analysis.environment.git_ignored import is_ignored
from preflight_analysis.environment.installed_paths import located
from preflight_analysis.findings.finding import Finding, Fix, Severity
from preflight_analysis.rules.files import nearest_file
from preflight_analysis.rules.further_reading import URDF_LINK
from preflight_analysis.rules.installed import lack_of_made, near_package
from preflight_analysis.rules.problems import rename, shown
from preflight_analysis.rules.robots import robots_in_part, written
from preflight_analysis.rules.rule import Context, Rule

_PACKAGE = "package://"
_FILE = "file://"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for robot in robots_in_part(context):
        said = set[str]()  # a folder that is missing is of many meshes
        for mesh in robot.description.meshes:
            found = _missing(context, mesh)
            if found is None or found[0] in said:
                continue
            said.add(found[0])
            message, old, near, severity = found
            place, related = written(context, robot, "mesh", "filename", mesh)
            path = mesh.removeprefix(_FILE)
            lack = lack_of_made(context, path) if mesh.startswith(_FILE) else None
            fixes: tuple[Fix, ...] = rename(context, place, old, near) if near else ()
            yield rule.finding(message, place, severity=severity, related=related, fixes=fixes, lack=lack)


def _missing(context: Context, mesh: str) -> tuple[str, str, str, Severity | None] | None:
    """What is wrong with the name of a mesh, what in it to replace by what, and another severity than the usual one.
    None for a file that is there, and for one of a package or folder that this machine does not have."""
    packages = context.environment.packages
    if mesh.startswith(_PACKAGE):
        name, slash, below = mesh.removeprefix(_PACKAGE).partition("/")
        if not slash:
            return None
        package = packages.get(name)
        if package is None:
            near = near_package(context, name)
            if near is None:
                return None
            return f"package '{name}' of a mesh does not exist; did you mean '{near}'?", name, near, None
        path = os.path.join(package.share, below.lstrip("/"))
    else:
        path = mesh.removeprefix(_FILE) if mesh.startswith(_FILE) else ""
        if not any(path.startswith(f"{package.share.rstrip('/')}/") for package in packages.values()):
            return None
    if context.disk.exists(located(context.disk, context.environment, path)):
        return None
    message = f"mesh '{shown(path, context)}' does not exist"
    if is_ignored(context.disk, path):
        return f"{message}; git ignores it, so each machine may create it", "", "", "info"
    near_path = nearest_file(context.disk, path, context.environment)
    if near_path is None:
        folder = os.path.dirname(path)
        if not context.disk.exists(located(context.disk, context.environment, folder)):
            message = f"folder '{shown(folder, context)}' of a mesh does not exist"
        return message, "", "", None
    same_folder = os.path.dirname(near_path) == os.path.dirname(path)
    old, new = (os.path.basename(path), os.path.basename(near_path)) if same_folder else ("", "")
    return f"{message}; did you mean '{shown(near_path, context)}'?", old, new, None


RULE = Rule(
    id="URD006",
    name="mesh-not-found",
    severity="warning",
    what="Checks for a mesh of the robot description whose file does not exist: `package://` of a package of the "
    "workspace or an installed one, `file://` below such a package. A package that is not installed here is not "
    "reported. A file that git ignores is information.",
    why="RViz and the simulator show the robot without the part, and a missing collision mesh makes planners ignore "
    "it.",
    example='<mesh filename="package://arm_description/meshes/elbow.stl"/>  <!-- the file is elbow.STL -->',
    instead='<mesh filename="package://arm_description/meshes/elbow.STL"/>',
    references=(URDF_LINK,),
    check=_check,
    in_branches=True,
)
