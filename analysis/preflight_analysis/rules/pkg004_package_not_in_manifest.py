"""PKG004: a package that a launch file needs and the package.xml above it does not name."""

import os
from collections.abc import Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from itertools import chain

from preflight_analysis.catalogue.released import distributions_with
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.edits.xml import XmlWriter
from preflight_analysis.environment.installed_paths import package_around
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
from preflight_analysis.model.names_of_launch_files import packages_of_launch_file
from preflight_analysis.model.problems import fix
from preflight_analysis.model.python_imports import imported_tops
from preflight_analysis.rules.further_reading import MANIFEST_2, MANIFEST_3, ROSDEP
from preflight_analysis.rules.packages import check_packages
from preflight_analysis.rules.rule import Rule

_TEST_FOLDERS = ("test", "tests")
_NOT_NODES = frozenset((*_TEST_FOLDERS, "launch", "build", "install", "log", "doc", "docs", "examples"))
_MOST_FILES = 500


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from _of_launch_files(rule, context)
    yield from check_packages(of_package)(rule, context)


def of_package(rule: Rule, disk: Disk, environment: Environment, package: Package) -> Iterator[Finding]:
    """The packages that the Python modules of a package import and its manifest does not name, each once. In ROS 1 what
    a module imports need not be a package of that name."""
    if not package.is_ament:
        return
    said = {package.name, *package.dependencies}
    manifest = disk.text(package.manifest)
    for path in files_in(disk, package.share, deep=True)[:_MOST_FILES]:
        folders = os.path.relpath(path, package.share).split(os.sep)
        if not path.endswith(".py") or path.endswith("launch.py") or folders == ["setup.py"]:
            continue
        document = disk.text(path) if _NOT_NODES.isdisjoint(folders[:-1]) else None
        if not isinstance(document, Document):
            continue
        for top, number in imported_tops(document):
            if top in said or not (top in environment.packages or distributions_with(top, 2)):
                continue
            said.add(top)
            line = document.lines.line_span(number)
            at = document.text.find(top, line.start)
            place = document.location(Span(at, at + len(top)) if at >= 0 else line)
            is_brought = top in _brought(disk.db, environment)
            yield _claim(rule, package, top, place, _fixes(manifest, package, top, path), is_brought=is_brought)


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
    rule: Rule, owner: Package, name: str, place: Location, fixes: Iterable[Fix], *, is_brought: bool
) -> Finding:
    manifest = os.path.basename(owner.manifest)
    many = say("packages are not dependencies in {manifest} of '{owner}'", manifest=manifest, owner=owner.name)
    return rule.claim(
        f"package '{name}' is not a dependency in {manifest} of '{owner.name}'",
        place,
        subject=Subject("package", name),
        doubts=doubts(NO_DIFFERENCE=is_brought),
        fixes=fixes,
        alike=Alike(many, name, owner.manifest),
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


def _fixes(manifest: Document | Unreadable, owner: Package, name: str, file: str) -> tuple[Fix, ...]:
    if not isinstance(manifest, Document) or os.path.basename(owner.manifest) != MANIFEST:
        return ()
    folders = file[len(owner.share) :].split("/")
    root = parse_xml(manifest.path, manifest.text, lines=manifest.lines).root
    given = root.get("format") if root is not None else None
    tag = "exec_depend" if given is not None and given.value.text in ("2", "3") else "run_depend"
    if file.endswith(".test") or any(folder in _TEST_FOLDERS for folder in folders):
        tag = "test_depend"
    edits = XmlWriter(manifest).add_dependency(tag, name)
    return fix(f"Add <{tag}>{name}</{tag}> to package.xml of '{owner.name}'", edits, preferred=True)


RULE = Rule(
    id="PKG004",
    name="package-not-in-manifest",
    effect="note",
    kind="absent",
    sometimes=(Reason.NO_DIFFERENCE,),
    what="Checks for a package that a launch file uses, or in ROS 2 a Python module imports, and that the "
    "`package.xml` of its own package does not name as any kind of dependency. An editor shows each package once in a "
    "launch file, and once for all modules; `check` has one finding for each `package.xml`. It is a hint where the "
    "workspace has the package, or another of its packages names it.",
    why="`rosdep` and binary packages install only declared dependencies. The launch file fails where no other "
    "package needs the missing one. In ROS 1 `roslaunch_add_file_check` reports the same.",
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
