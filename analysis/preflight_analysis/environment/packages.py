"""Packages as rospkg finds them, for `$(find)`, and as catkin does, for the source folders of a devel space."""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace

from lxml import etree

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.reading import Unreadable, read_text
from preflight_analysis.environment.model import Package
from preflight_analysis.environment.walk import walk

MANIFEST = "package.xml"
LEGACY_MANIFEST = "manifest.xml"
IGNORED_BY_ALL = "CATKIN_IGNORE"
"""The one marker that rospkg knows. colcon's extension for ROS knows it too."""
IGNORED_BY_COLCON = frozenset({"AMENT_IGNORE", "COLCON_IGNORE"})
"""Those that colcon and catkin's own tools know besides: nothing below is built, and rospkg finds it all the same."""
_MADE_BY_COLCON = frozenset({"build", "install", "log"})
OF_ROS1 = (None, "catkin")
"""The build types of packages for ROS 1; one with `cmake` is for both."""
_BLANKS = " \n\r\t"
_OF_VERSION = re.compile(r"""\$ROS_VERSION\s*([!=]=)\s*["']?([12])["']?""")
_FLAT = "/usr/share/"
"""Debian's rospkg and catkin look no deeper than the folders right below this one."""


@dataclass(frozen=True, slots=True)
class FoundPackages:
    """What a package path leads to: for each name the first package, the others of that name, and bad manifests."""

    packages: dict[str, Package]
    shadowed: dict[str, tuple[Package, ...]]
    problems: tuple[str, ...]

    def built_for(self, generation: int) -> FoundPackages:
        """They as they are built for a generation of ROS."""
        return replace(
            self,
            packages={name: package.built_for(generation) for name, package in self.packages.items()},
            shadowed={
                name: tuple(each.built_for(generation) for each in others) for name, others in self.shadowed.items()
            },
        )


def find_packages(package_path: Iterable[str], skip: Collection[str] = ()) -> FoundPackages:
    """Crawl the folders of a package path, in its order: the first package of a name wins, as for rospkg.

    `skip` names folders that are not entered where they stand right below a folder of the path. A metapackage is
    none for rospkg: `$(find)` does not know it.
    """
    packages: dict[str, Package] = {}
    shadowed: dict[str, list[Package]] = {}
    places: set[str] = set()
    problems: list[str] = []
    for folder in package_path:
        for package in crawl(folder, skip, problems):
            place = os.path.realpath(package.share)
            if place in places:
                continue
            places.add(place)
            if packages.setdefault(package.name, package) is not package:
                shadowed.setdefault(package.name, []).append(package)
    return FoundPackages(
        packages, {name: tuple(others) for name, others in shadowed.items()}, tuple(dict.fromkeys(problems))
    )


def crawl(
    top: str, skip: Collection[str] = (), problems: list[str] | None = None, metapackages: bool = False
) -> Iterator[Package]:
    """The packages below one folder in the order of the walk; what is wrong with their manifests goes to `problems`.

    What colcon ignores are packages of ROS 1 only, and with `metapackages`, as catkin's own tools crawl, none at all.
    """
    problems = [] if problems is None else problems
    for folder, folders, files, ignored in walk_unignored(top, skip):
        if ignored and metapackages:
            folders.clear()
        elif MANIFEST in files:
            folders.clear()
            package = _read_manifest(folder, os.path.join(folder, MANIFEST), metapackages, problems)
            if package is not None and not (ignored and package.build_type not in OF_ROS1):
                yield package
        elif LEGACY_MANIFEST in files:
            folders.clear()
            yield _read_legacy_manifest(folder, os.path.join(folder, LEGACY_MANIFEST))
        elif "rospack_nosubdirs" in files or folder.startswith(_FLAT):
            folders.clear()


def package_of(path: str) -> Package | None:
    """The package whose folder a file is in, also one that all tools ignore."""
    folder = os.path.dirname(path)
    while folder != os.path.dirname(folder):
        manifest = os.path.join(folder, MANIFEST)
        if os.path.isfile(manifest):
            return _read_manifest(folder, manifest, metapackages=False, problems=[])
        folder = os.path.dirname(folder)
    return None


def walk_unignored(top: str, skip: Collection[str] = ()) -> Iterator[tuple[str, list[str], list[str], bool]]:
    """As `walk`, without what all tools ignore and what colcon has made; last is whether colcon ignores the folder."""
    marked: tuple[str, ...] = ()
    for folder, folders, files in walk(top, skip):
        by_colcon = not IGNORED_BY_COLCON.isdisjoint(files)
        if IGNORED_BY_ALL in files or (by_colcon and os.path.basename(folder) in _MADE_BY_COLCON):
            folders.clear()
            continue
        if by_colcon:
            marked += (os.path.join(folder, ""),)
        yield folder, folders, files, bool(marked) and os.path.join(folder, "").startswith(marked)


def _read_manifest(folder: str, path: str, metapackages: bool, problems: list[str]) -> Package | None:
    root = _parse(path, problems)
    if root is None:
        return None
    name = (root.findtext("name") or "").strip(_BLANKS)
    if not name:
        problems.append(f"{path} names no package: roslaunch finds no package at all until it does.")
        return None
    if not metapackages and root.find("./export/metapackage") is not None:
        return None
    dependencies = {
        (element.text or "").strip(_BLANKS)
        for element in root
        if isinstance(element.tag, str) and (element.tag == "depend" or element.tag.endswith("_depend"))
    }
    build_type = _build_type(root, dependencies)
    return Package(name, folder, path, frozenset(dependencies - {""}), build_type, tuple(_conditional(root)))


def _conditional(root: etree._Element) -> Iterator[tuple[int, str]]:
    """The build types that count for one generation alone (REP 149)."""
    for element in root.iterfind("./export/build_type"):
        found = _OF_VERSION.fullmatch(element.get("condition", "").strip(_BLANKS))
        if found is not None and (said := (element.text or "").strip(_BLANKS)):
            generation = int(found[2])
            yield generation if found[1] == "==" else 3 - generation, said


def _build_type(root: etree._Element, dependencies: Collection[str]) -> str | None:
    """REP 149: `<build_type>` in the exports; before there was one, the build tool that it depends on."""
    said = (root.findtext("./export/build_type") or "").strip(_BLANKS)
    if said:
        return said
    return next((tool for tool in ("catkin", "ament_cmake", "ament_python") if tool in dependencies), None)


def _read_legacy_manifest(folder: str, path: str) -> Package:
    """The package is named by its folder, whatever the manifest holds."""
    root = _parse(path, [])
    depends = () if root is None else root.findall("depend")
    dependencies = frozenset(str(element.get("package")) for element in depends if element.get("package"))
    return Package(os.path.basename(folder), folder, path, dependencies)


def _parse(path: str, problems: list[str]) -> etree._Element | None:
    text = read_text(path)
    if isinstance(text, Unreadable):
        problems.append(f"{path} {text.reason}: its package is not known.")
        return None
    parser = etree.XMLParser(
        encoding="utf-8",
        recover=True,
        resolve_entities=False,
        no_network=True,
        load_dtd=False,
        remove_comments=True,
        remove_pis=True,
    )
    try:
        root = etree.fromstring(text.text.encode("utf-8", "surrogatepass"), parser)
    except etree.XMLSyntaxError:
        root = None
    errors = [e for e in parser.error_log if e.level >= etree.ErrorLevels.ERROR]
    if errors or root is None:
        where = f" (line {errors[0].line}: {errors[0].message.rstrip('.')})" if errors else ""
        problems.append(f"{path} is not well-formed XML{where}: roslaunch finds no package at all until it is.")
    return root
