"""PKG007: a package.xml names a package that there is nowhere."""

from collections.abc import Iterator

from preflight_analysis.catalogue.released import DISTRIBUTIONS, distributions_with, system_keys
from preflight_analysis.catalogue.renamed import in_generation
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document, Text
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.edits.xml import XmlWriter
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.packages import MANIFEST
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.model.installed import is_of_family_in, near_package_in
from preflight_analysis.model.nearest import did_you_mean, folded, is_slip_of_words, nearest, squeezed
from preflight_analysis.model.problems import all_of, fix
from preflight_analysis.rules.further_reading import MANIFEST_2, MANIFEST_3, ROSDEP
from preflight_analysis.rules.packages import check_packages
from preflight_analysis.rules.rule import Rule


def of_package(rule: Rule, disk: Disk, environment: Environment, package: Package) -> Iterator[Finding]:
    """The names in the manifest of a package that are slips, or of the other generation of ROS."""
    manifest = disk.text(package.manifest)
    if not isinstance(manifest, Document) or not package.manifest.endswith(f"/{MANIFEST}"):
        return
    generation = 2 if package.is_ament or (package.build_type == "cmake" and environment.ros.ament) else 1
    for spans, name in _unknown(manifest, environment):
        near = near_package_in(disk.db, environment, generation, name)
        if (
            near is None
            and (key := _near_key(disk.db, name)) is not None
            and not is_of_family_in(disk.db, environment, generation, name, key)
        ):
            near = key
        if near is None:
            continue  # a private package, as most that nobody has released
        writer = XmlWriter(manifest)
        edits = [writer.replace(span, near) for span in spans]
        yield rule.claim(
            f"unknown package '{name}': not in the workspace nor any distribution{did_you_mean(near)}",
            manifest.location(spans[0]),
            subject=Subject("package", name),
            candidates=(near,),
            fixes=fix(f"Replace '{name}' with '{near}'", all_of(*edits), preferred=True),
        )
    # It is built for both generations where the build type depends on that.
    if package.build_type in _BUILT and not package.conditional:
        yield from _of_other_generation(rule, environment, package, manifest)


def _of_other_generation(
    rule: Rule, environment: Environment, package: Package, manifest: Document
) -> Iterator[Finding]:
    said = set[str]()
    for name, span, conditional in _dependencies(manifest):
        other = in_generation(name, package.generation)
        known = name in environment.packages or distributions_with(name, package.generation)
        if other is None or known or conditional or name in said:
            continue
        said.add(name)
        yield rule.claim(
            f"'{name}' is a package of ROS {3 - package.generation}, and {package.build_type} builds '{package.name}' "
            f"for ROS {package.generation}; use '{other}'",
            manifest.location(span),
            subject=Subject("package", name),
            kind="conflict",
            candidates=(other,),
        )


def _unknown(manifest: Document, environment: Environment) -> tuple[tuple[tuple[Span, ...], str], ...]:
    """The names, each with its places, that neither ROS nor rosdep knows."""
    unknown: dict[str, list[Span]] = {}
    for name, span, _ in _dependencies(manifest):
        # rosdep has forgotten Python 2; manifests for both still name it.
        key = f"python3-{name[7:]}" if name.startswith("python-") else name
        known = name in environment.packages or not system_keys().isdisjoint((name, key))
        if not known and not any(distributions_with(name, generation) for generation in DISTRIBUTIONS):
            unknown.setdefault(name, []).append(span)
    return tuple((tuple(spans), name) for name, spans in unknown.items())


def _dependencies(manifest: Document) -> Iterator[tuple[str, Span, bool]]:
    """The names, their places, and whether they count under a condition."""
    root = parse_xml(manifest.path, manifest.text, lines=manifest.lines).root
    for element in root.elements if root is not None else ():
        for child in element.children if element.tag.endswith("depend") else ():
            if isinstance(child, Text) and (name := child.content.text.strip()):
                start = child.content.text.index(name)
                yield name, child.content.slice_span(start, start + len(name)), element.get("condition") is not None


@query
def _near_key(db: Database, name: str) -> str | None:
    """The package of the operating system of whose name this is a slip."""
    near = nearest(name, system_keys()) if name not in system_keys() else None
    if near is None or len(name) < _LONG or not is_slip_of_words(name, near):
        return None
    # One word is no slip of two (`param_io`, `paramiko`).
    same_words = len(folded(name).split("_")) == len(folded(near).split("_"))
    return near if same_words or squeezed(name) == squeezed(near) else None


_BUILT = ("ament_cmake", "ament_python", "catkin")
_LONG = 8
"""Letters: of thousands of names one is always near a short one."""


RULE = Rule(
    id="PKG007",
    name="dependency-not-found",
    effect="misbehaves",
    kind="near",
    always=(Reason.UNSEEN,),
    what="Checks for a dependency in a `package.xml` that is a typo. The name is not in the workspace, not installed, "
    "not released for any distribution of ROS and not known to rosdep. Also checks for packages of ROS 1 (`roscpp`, "
    "`tf`) in a `package.xml` that ament builds, and for those of ROS 2 in one that catkin builds.",
    why="`rosdep install` stops at it, and the intended package is not installed on the robot.",
    example="<exec_depend>robot_state_publiser</exec_depend>",
    instead="<exec_depend>robot_state_publisher</exec_depend>",
    references=(
        MANIFEST_2,
        MANIFEST_3,
        ROSDEP,
    ),
    check=check_packages(of_package),
    of_package=of_package,
)
