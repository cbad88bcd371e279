"""PKG004: a package that a launch file needs and the package.xml above it does not name."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from itertools import chain, islice

from preflight_analysis.catalogue.released import distributions_with, system_keys
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.edits.xml import XmlWriter
from preflight_analysis.environment.installed_paths import cmake_build, package_around
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.environment.packages import MANIFEST
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Alike, Finding, Fix
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.derived import derived
from preflight_analysis.incremental.query import query
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.model.context import Context
from preflight_analysis.model.named_in_sources import included_folders, packages_of_fields
from preflight_analysis.model.names_of_launch_files import packages_of_launch_file
from preflight_analysis.model.problems import fix
from preflight_analysis.model.python_imports import imported_tops
from preflight_analysis.rules.further_reading import MANIFEST_2, MANIFEST_3, ROSDEP
from preflight_analysis.rules.packages import check_packages, line_of, said_at
from preflight_analysis.rules.rule import Rule

_TEST_FOLDERS = ("test", "tests")
_NOT_NODES = frozenset((*_TEST_FOLDERS, "launch", "build", "install", "log", "doc", "docs", "examples"))
_MOST_FILES = 500
_BUILT = ("ament_cmake", "ament_python", "catkin")
_BUILD_TOOLS = ("ament_cmake", "rosidl_default_generators", "catkin")
_OF_FORMAT_1 = {"exec_depend": "run_depend", "depend": "build_depend"}
_OF_CPP = (".cpp", ".cc", ".cxx", ".h", ".hpp", ".hh", ".hxx")
_OF_INTERFACES = (".msg", ".srv", ".action")
_OF_CLIENTS = (
    "action_msgs",
    "builtin_interfaces",
    "rcl",
    "rcl_interfaces",
    "rcpputils",
    "rcutils",
    "rmw",
    "rosgraph_msgs",
)
_BRINGS: Mapping[str, Collection[str]] = {
    "ament_cmake": ("ament_cmake_core", "ament_cmake_python", "ament_cmake_test"),
    "ament_cmake_auto": ("ament_cmake",),
    "rclcpp": _OF_CLIENTS,
    "rclpy": (*_OF_CLIENTS, "ament_index_python", "lifecycle_msgs"),
    "tf2_ros": ("tf2", "tf2_msgs", "geometry_msgs", "message_filters"),
}
"""What comes with packages that nearly all others name, by their own manifests (Humble to Jazzy)."""
_OTHER_HEADERS = frozenset(("ros", "moveit"))
"""Packages without headers, whose name is a folder of those of others: roscpp and moveit_core."""
_Need = tuple[str, Location, str, bool]
"""A package, where it is needed, the tag that names it in a manifest, and whether CMake stops without it."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from _of_launch_files(rule, context)
    yield from check_packages(of_package)(rule, context)


def of_package(rule: Rule, disk: Disk, environment: Environment, package: Package) -> Iterator[Finding]:
    """The packages that the build files, sources and modules of a package need and its manifest does not name, each
    once, the gravest first."""
    if package.build_type not in _BUILT or package.conditional:
        return
    said = {package.name, *package.dependencies}
    manifest = disk.text(package.manifest)
    for name, place, tag, is_required in chain(
        _found_by_cmake(disk, package),
        _imported(disk, package),
        _included(disk, package),
        _in_definitions(disk, package),
    ):
        own = name in environment.packages
        if name in said or not (own or _is_released(name, package.generation)):
            continue
        said.add(name)
        before = _built_before(disk.db, environment, package) if own and is_required else frozenset()
        is_late = (
            is_required and own and name not in before and not environment.is_installed(environment.packages[name])
        )
        by_another = any(name in _BRINGS.get(other, ()) for other in package.dependencies)
        is_brought = not is_late and (by_another or name in _brought(disk.db, environment))
        fixes = _fixes(manifest, package, name, place.file, tag)
        yield _claim(rule, package, name, place, fixes, is_brought=is_brought, is_late=is_late)


def _is_released(name: str, generation: int) -> bool:
    """Whether it is a package of ROS, and none of the operating system as well, which a manifest may name instead."""
    is_of_system = not system_keys().isdisjoint((name, f"lib{name}-dev"))
    return bool(distributions_with(name, generation)) and not is_of_system


@query
def _built_before(db: Database, environment: Environment, package: Package) -> frozenset[str]:
    """The packages that a build makes first, as the manifests of the workspace say."""
    found, pending = set[str](), list(package.dependencies)
    while pending:
        name = pending.pop()
        if name not in found:
            found.add(name)
            pending += environment.packages[name].dependencies if name in environment.packages else ()
    return frozenset(found)


def _found_by_cmake(disk: Disk, package: Package) -> Iterator[_Need]:
    for required in cmake_build(disk, package).required if package.build_type != "ament_python" else ():
        place = said_at(disk, required.said, required.name) if required.said.sure else None
        if place is not None:
            is_tool = required.name.startswith(_BUILD_TOOLS)
            yield required.name, place, "buildtool_depend" if is_tool else "depend", True


def _imported(disk: Disk, package: Package) -> Iterator[_Need]:
    """What modules import whenever they are loaded. In ROS 1 that need not be a package of that name."""
    for path in _sources(disk, package, (".py",)) if package.is_ament else ():
        document = disk.text(path)
        if path.endswith("launch.py") or path == f"{package.share}/setup.py" or not isinstance(document, Document):
            continue
        for top, number in imported_tops(document):
            yield top, line_of(document, number, top), "exec_depend", False


def _included(disk: Disk, package: Package) -> Iterator[_Need]:
    folders = {folder for path in files_in(disk, package.share, deep=True) for folder in path.split("/")[:-1]}
    for path in _sources(disk, package, _OF_CPP):
        for name, line in included_folders(disk.db, path):
            document = disk.text(path) if name not in folders and name not in _OTHER_HEADERS else None
            if isinstance(document, Document):
                yield name, line_of(document, line, name), "depend", False


def _in_definitions(disk: Disk, package: Package) -> Iterator[_Need]:
    for path in _sources(disk, package, _OF_INTERFACES):
        document = disk.text(path)
        if isinstance(document, Document):
            for name, span in packages_of_fields(document):
                yield name, document.location(span), "depend", False


def _sources(disk: Disk, package: Package, endings: tuple[str, ...]) -> Iterator[str]:
    paths = (path for path in files_in(disk, package.share, deep=True) if path.endswith(endings))
    for path in islice(paths, _MOST_FILES):
        if _NOT_NODES.isdisjoint(os.path.relpath(path, package.share).split(os.sep)[:-1]):
            yield path


def _of_launch_files(rule: Rule, context: Context) -> Iterator[Finding]:
    files = tuple(context.launch_files.values())
    manifests: dict[str, Document | Unreadable] = {}
    for launch_file, found in zip(files, context.each(_missing, files, context.environment), strict=True):
        if found is not None:
            owner, missing = found
            if owner.manifest not in manifests:
                manifests[owner.manifest] = context.disk.text(owner.manifest)
            manifest = manifests[owner.manifest]
            brought = _brought(context.disk.db, context.environment)
            yield from context.one(_findings, launch_file.path, rule, launch_file, brought, owner, missing, manifest)


def _findings(
    rule: Rule,
    launch_file: LaunchFile,
    brought: AbstractSet[str],
    owner: Package,
    missing: tuple[tuple[str, Span], ...],
    manifest: Document | Unreadable,
) -> tuple[Finding, ...]:
    return tuple(
        _claim(
            rule,
            owner,
            name,
            launch_file.document.location(span),
            _fixes(manifest, owner, name, launch_file.path),
            is_brought=name in brought,
        )
        for name, span in missing
    )


def _claim(
    rule: Rule,
    owner: Package,
    name: str,
    place: Location,
    fixes: Iterable[Fix],
    *,
    is_brought: bool,
    is_late: bool = False,
) -> Finding:
    manifest = os.path.basename(owner.manifest)
    many = say("packages are not dependencies in {manifest} of '{owner}'", manifest=manifest, owner=owner.name)
    late = f": the build may take '{owner.name}' first, and CMake stops" if is_late else ""
    return rule.claim(
        f"package '{name}' is not a dependency in {manifest} of '{owner.name}'{late}",
        place,
        subject=Subject("package", name),
        # catkin takes packages that need nothing of each other by the alphabet: it may well build.
        effect="misbehaves" if is_late and owner.is_ament else None,
        doubts=doubts(NO_DIFFERENCE=is_brought, UNSEEN=is_late),
        fixes=fixes,
        alike=None if is_late else Alike(many, name, owner.manifest),
    )


@query
def _brought(db: Database, environment: Environment) -> frozenset[str]:
    """The packages that are there all the same where a workspace is built and `rosdep install --from-paths src` is run:
    its own, and those that any of them names."""
    own = [package for package in environment.packages.values() if not environment.is_installed(package)]
    return frozenset(chain((each.name for each in own), *(each.dependencies for each in own)))


def _missing(launch_file: LaunchFile, environment: Environment) -> tuple[Package, tuple[tuple[str, Span], ...]] | None:
    """The package of the file, and those that it uses and the package does not name."""
    owner = package_around(environment, launch_file.path)
    # What is installed is not for the user to mend; of ROS 2's installed packages no manifest was read.
    if owner is None or environment.is_installed(owner):
        return None
    missing = tuple(
        (name, span)
        for name, span in _used_packages(launch_file).items()
        # One that is neither here nor released is another rule's: it may well be a wrong name.
        if name not in owner.dependencies
        and name != owner.name
        and (name in environment.packages or distributions_with(name, launch_file.generation))
    )
    return (owner, missing) if missing else None


@derived
def _used_packages(launch_file: LaunchFile) -> Mapping[str, Span]:
    """The packages that the file names, under whatever conditions, each with the first place."""
    first: dict[str, Span] = {}
    for name, span in packages_of_launch_file(launch_file):
        if "$" not in name:
            first.setdefault(name.strip("'\""), span)
    return first


def _fixes(
    manifest: Document | Unreadable, owner: Package, name: str, file: str, tag: str = "exec_depend"
) -> tuple[Fix, ...]:
    if not isinstance(manifest, Document) or os.path.basename(owner.manifest) != MANIFEST:
        return ()
    folders = file[len(owner.share) :].split("/")
    root = parse_xml(manifest.path, manifest.text, lines=manifest.lines).root
    given = root.get("format") if root is not None else None
    if given is None or given.value.text not in ("2", "3"):
        tag = _OF_FORMAT_1.get(tag, tag)
    if file.endswith(".test") or any(folder in _TEST_FOLDERS for folder in folders):
        tag = "test_depend"
    edits = XmlWriter(manifest).add_dependency(tag, name)
    return fix(f"Add <{tag}>{name}</{tag}> to package.xml of '{owner.name}'", edits, preferred=True)


RULE = Rule(
    id="PKG004",
    name="package-not-in-manifest",
    effect="note",
    kind="absent",
    sometimes=(Reason.NO_DIFFERENCE, Reason.UNSEEN),
    what="Checks for a package that a launch file uses, `CMakeLists.txt` requires, C++ sources include, messages have "
    "fields of, or in ROS 2 a Python module imports, and that the `package.xml` of its own package does not name as "
    "any kind of dependency. It is a warning where `find_package` requires a package of the workspace. An editor shows "
    "each package once in a launch file, and once for all other files; `check` has one finding for each `package.xml`. "
    "It is a hint where the workspace has the package, or another of its packages names it.",
    why="`rosdep` and binary packages install only declared dependencies. The launch file fails where no other "
    "package needs the missing one. A workspace is built in the order of its manifests: CMake does not find what is "
    "not built yet. In ROS 1 `roslaunch_add_file_check` reports the same.",
    example='<!-- of a package whose package.xml does not name rviz -->\n<node pkg="rviz" type="rviz" name="rviz"/>',
    instead="<exec_depend>rviz</exec_depend>",
    references=(
        MANIFEST_2,
        MANIFEST_3,
        ROSDEP,
    ),
    check=_check,
    of_package=of_package,
)
