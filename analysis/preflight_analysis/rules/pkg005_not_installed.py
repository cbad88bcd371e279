"""PKG005: a file of the source that the package does not install."""

import os
import re
from collections.abc import Iterator
from itertools import islice

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.edits import cmake
from preflight_analysis.edits.python import PythonWriter
from preflight_analysis.environment.installed_paths import cmake_build, installed_at, package_around
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.evaluation.tree import LaunchNode, Param, Use
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.launch.model import action_at
from preflight_analysis.launch.recognize import LAUNCH_SUFFIXES
from preflight_analysis.model.context import Context
from preflight_analysis.model.installation import (
    Installation,
    installation,
    installation_in,
    is_by_share,
    named_installation,
)
from preflight_analysis.model.places import argument_location
from preflight_analysis.model.problems import fix
from preflight_analysis.rules.further_reading import FILE_SYSTEM, LARGE_PROJECTS
from preflight_analysis.rules.packages import check_packages
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.request import split_args

_LAUNCH = "launch"
_DESCRIPTIONS = (".urdf", ".xacro", ".srdf", ".sdf", ".world")
_REFERENCE = re.compile(r"(?:package://|\$\(find )\s*([\w-]+)\)?/([^\s\"'<>)]+)")
"""How descriptions of robots name a file of a package."""
_SCRIPT = ".py"
_MOST_FILES = 200
_LONGEST = 1_000_000
_LONGEST_PATH = 4096
_NOT_OURS = frozenset(("test", "tests", "build", "install", "log"))


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if context.tree.ros.ament:
        yield from _of_launch(rule, context)
        yield from check_packages(of_package)(rule, context)
    else:
        yield from _of_catkin(rule, context)


def of_package(rule: Rule, disk: Disk, environment: Environment, package: Package) -> Iterator[Finding]:
    """What the robot descriptions of a package name and no package installs, once for each folder."""
    if not package.is_ament:
        return
    said = set[str]()
    paths = (path for path in files_in(disk, package.share, deep=True) if path.endswith(_DESCRIPTIONS))
    for file in islice(paths, _MOST_FILES):
        document = disk.text(file)
        if not isinstance(document, Document) or len(document.text) > _LONGEST:
            continue
        if not _NOT_OURS.isdisjoint(os.path.relpath(file, package.share).split(os.sep)[:-1]):
            continue
        for found in _REFERENCE.finditer(document.text):
            owner = environment.packages.get(found[1])
            if owner is None or not owner.is_ament or environment.is_installed(owner):
                continue
            path = _known_part(os.path.join(owner.share, found[2]))
            folder = path if disk.is_folder(path) else os.path.dirname(path)
            if folder in said or not folder.startswith(owner.share + os.sep):
                continue
            # Of a folder whose file is not known none may be installed.
            paths_there = files_in(disk, path, deep=True) if folder == path else (path,)
            lost = [installation_in(disk, environment, each) for each in paths_there]
            if not lost or (first := lost[0]) is None:
                continue
            said.add(folder)
            if all(each is not None and each.problem for each in lost):
                place = document.location(Span(found.start(), found.end()))
                about = Subject("file", folder)
                yield rule.claim(first.problem, place, subject=about, fixes=_fixes(disk, first))


def _known_part(path: str) -> str:
    """A path, or the folder before the first part of it that xacro computes."""
    return os.path.normpath(path if "$" not in path else os.path.dirname(path[: path.index("$")] + "_"))


def _of_catkin(rule: Rule, context: Context) -> Iterator[Finding]:
    """What a launch of ROS 1 uses of packages that install other files of the kind: it is found in the devel space, and
    missing where the package is installed. Once for each folder, and for each script."""
    environment, said = context.environment, set[str]()
    uses = [*filter(None, context.each(_use_of_package, context.tree.uses, environment))]
    scripts = [*filter(None, context.each(_script_of_package, context.tree.nodes, environment))]
    packages = {id(package): package for _, package, _ in (*uses, *scripts)}
    some = {key for key, package in packages.items() if _installs_some(context, package)}
    for use, package, path in uses if some else ():
        document, folder = context.documents.get(use.location.file), os.path.dirname(path)
        if id(package) not in some or document is None or folder in said:
            continue
        written = document.text[slice(*use.location.span)]
        if f"$(find {package.name})" not in written or installed_at(context.disk, package, path):
            continue
        said.add(folder)
        about = Subject("file", path)
        yield rule.claim(_not_in(package, "file", path, "files"), use.location, subject=about, effect="note")
    for node, package, path in scripts if some else ():
        if id(package) not in some or path in said:
            continue
        programs = {program.path for program in cmake_build(context.disk, package).programs.values()}
        if programs and path not in programs and path.startswith(package.share + os.sep):
            said.add(path)
            about = Subject("executable", node.executable)
            yield rule.claim(_not_in(package, "script", path, "scripts"), node.location, subject=about, effect="note")


def _use_of_package(use: Use, environment: Environment) -> tuple[Use, Package, str] | None:
    """With the package that the file is in, and its path."""
    path = os.path.normpath(use.name) if _of_file(use) is not None else ""
    package = package_around(environment, path)
    return (use, package, path) if package is not None else None


def _script_of_package(node: LaunchNode, environment: Environment) -> tuple[LaunchNode, Package, str] | None:
    """Likewise."""
    path = node.resolved.path or ""
    package = package_around(environment, path) if path.endswith(_SCRIPT) else None
    return (node, package, path) if package is not None else None


def _installs_some(context: Context, package: Package) -> bool:
    """Whether all that a catkin package installs is known, and something goes to its share folder."""
    if package.build_type != "catkin" or context.environment.is_installed(package):
        return False
    build, share = cmake_build(context.disk, package), f"share/{package.name}"
    return build.complete and any(f"{each.destination}/".startswith(f"{share}/") for each in build.installed)


def _not_in(package: Package, what: str, path: str, others: str) -> str:
    below = os.path.relpath(path, package.share)
    return (
        f"{what} '{below}' is not installed: CMakeLists.txt of '{package.name}' installs other {others}, not this one; "
        "it is found in the devel space only"
    )


def _of_launch(rule: Rule, context: Context) -> Iterator[Finding]:
    named = set[str]()
    for path, location in _opened_by_nodes(context):
        opened = installation(context, path) if path not in named and is_by_share(context, location) else None
        if opened is not None:
            named.add(path)
            if opened.problem:
                fixes = _fixes(context.disk, opened) if not opened.places else ()
                yield rule.claim(opened.problem, location, subject=Subject("file", path), fixes=fixes)
    for use in filter(None, context.each(_of_file, context.tree.uses)):
        found = named_installation(context, use)
        if found is None:
            continue
        path = os.path.normpath(use.name)
        named.add(path)
        if found.problem:
            fixes = _fixes(context.disk, found) if not found.places else ()
            about = Subject("file", path)
            yield rule.claim(found.problem, use.location, subject=about, candidates=found.places[:1], fixes=fixes)
    for path, launch_file in context.launch_files.items():
        found = installation(context, path) if path not in named and launch_file.root is not None else None
        if found is None or launch_file.root is None:
            continue
        if found.below.startswith(_LAUNCH + os.sep) and found.state == "nowhere":
            # A copy that somebody put aside has more behind `.launch`, and build files that name patterns leave it.
            is_copy = ".launch" in os.path.basename(path) and not path.endswith(LAUNCH_SUFFIXES)
            name = found.package.name
            yield rule.claim(
                f"launch file '{found.below}' is not installed by {found.build_file} of '{name}': "
                f"`ros2 launch {name} {os.path.basename(path)}` does not find it",
                context.location(path, launch_file.root.head_span),
                subject=Subject("file", path),
                doubts=doubts(SET_ASIDE=is_copy),
                fixes=_fixes(context.disk, found),
            )


def _opened_by_nodes(context: Context) -> Iterator[tuple[str, Location]]:
    """The files that nodes get as arguments (`rviz2 -d view.rviz`) or as parameters, and where they are given."""
    for node in context.tree.nodes:
        words = split_args(node.args) if "/" in node.args and not node.unknowns else ()
        for word in words:
            path = word.rpartition("=")[2].rpartition(":")[2]
            if path.startswith("/") and context.disk.is_file(path):
                yield os.path.normpath(path), argument_location(context, node, word)
        for param in node.params:
            if isinstance(param.value, str) and param.value.startswith("/") and len(param.value) < _LONGEST_PATH:
                path = os.path.normpath(param.value)
                if context.disk.is_file(path):
                    yield path, _value_of(context, param)


def _value_of(context: Context, param: Param) -> Location:
    launch_file = context.launch_files.get(param.place.file)
    action = action_at(launch_file, param.place.span.start + 1) if launch_file is not None else None
    value = action.value("value") if action is not None else None
    return context.location(param.place.file, value.span) if value is not None else param.place


def _of_file(use: Use) -> Use | None:
    """The use itself, if it names a file that is there."""
    return use if use.kind in ("include", "file") and use.target is not None else None


def _fixes(disk: Disk, lost: Installation) -> tuple[Fix, ...]:
    package, below = lost.package, lost.below
    found = disk.text(os.path.join(package.share, lost.build_file))
    if not isinstance(found, Document):
        return ()
    folder = os.path.dirname(below)
    if lost.build_file == "setup.py":
        edits = PythonWriter(found).add_data_files(f"share/{os.path.join(package.name, folder)}", below)
    else:
        what = f"DIRECTORY {folder}" if folder else f"FILES {below}"
        edits = cmake.install(found, what, "share/${PROJECT_NAME}")
    return fix(f"Install '{below}' in {lost.build_file}", edits, preferred=True)


RULE = Rule(
    id="PKG005",
    name="not-installed",
    effect="misbehaves",
    kind="absent",
    sometimes=("note", Reason.SET_ASIDE),
    what="Checks for a launch file, a parameter file, or a file that a node or a robot description opens, that the "
    "`setup.py` or `CMakeLists.txt` of its package does not install in the share folder. Something refers to it there, "
    "or it is in the folder `launch`. In ROS 1, for what a launch file uses of a package that installs other files.",
    why="`ros2 launch` searches the share folder of the installed package. The file is not there.",
    example='<include file="$(find-pkg-share robot)/launch/base.launch.xml"/>\n'
    "<!-- setup.py: data_files=[('share/robot/config', glob('config/*'))] -->",
    instead="data_files=[('share/robot/config', glob('config/*')), ('share/robot/launch', glob('launch/*'))]",
    references=(
        FILE_SYSTEM,
        LARGE_PROJECTS,
    ),
    check=_check,
    of_package=of_package,
    in_branches=True,
)
