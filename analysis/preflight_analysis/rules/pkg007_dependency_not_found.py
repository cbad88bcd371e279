"""PKG007: a package.xml names a package that there is nowhere."""

import os
from collections.abc import Iterator

from preflight_analysis.catalogue.released import DISTRIBUTIONS, distributions_with, system_keys
from preflight_analysis.documents.document import Document, Text
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.packages import MANIFEST
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.model.context import Context
from preflight_analysis.model.installed import is_of_family, near_package
from preflight_analysis.model.nearest import did_you_mean, is_slip_of_words, nearest
from preflight_analysis.model.problems import all_of, fix
from preflight_analysis.rules.further_reading import MANIFEST_2, MANIFEST_3, ROSDEP
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for package in _packages(context):
        manifest = context.documents.get(package.manifest)
        if manifest is None or not package.manifest.endswith(f"/{MANIFEST}"):
            continue
        for spans, name in context.one(_unknown, package.manifest, manifest, context.environment):
            near = near_package(context, name)
            if (
                near is None
                and (key := _near_key(context.disk.db, name)) is not None
                and not is_of_family(context, name, key)
            ):
                near = key
            if near is None:
                continue  # a private package, as most that nobody has released
            writer = context.writer(manifest.path)
            edits = [writer.replace(span, near) for span in spans] if writer is not None else []
            yield rule.claim(
                f"unknown package '{name}': not in the workspace nor any distribution{did_you_mean(near)}",
                manifest.location(spans[0]),
                subject=Subject("package", name),
                candidates=(near,),
                fixes=fix(f"Replace '{name}' with '{near}'", all_of(*edits), preferred=True),
            )


def _packages(context: Context) -> Iterator[Package]:
    """Those of the workspace that the launch files are in."""
    environment = context.environment
    one_of_folder = {os.path.dirname(path): path for path in context.launch_files}
    found = (package_around(environment, path) for path in one_of_folder.values())
    for package in dict.fromkeys(found):
        if package is not None and not context.environment.is_installed(package):
            yield package


def _unknown(manifest: Document, environment: Environment) -> tuple[tuple[tuple[Span, ...], str], ...]:
    """The names, each with its places, that neither ROS nor rosdep knows."""
    unknown: dict[str, list[Span]] = {}
    for name, span in _dependencies(manifest):
        # rosdep has forgotten Python 2; manifests for both still name it.
        key = f"python3-{name[7:]}" if name.startswith("python-") else name
        known = name in environment.packages or not system_keys().isdisjoint((name, key))
        if not known and not any(distributions_with(name, generation) for generation in DISTRIBUTIONS):
            unknown.setdefault(name, []).append(span)
    return tuple((tuple(spans), name) for name, spans in unknown.items())


def _dependencies(manifest: Document) -> Iterator[tuple[str, Span]]:
    root = parse_xml(manifest.path, manifest.text, lines=manifest.lines).root
    for element in root.elements if root is not None else ():
        for child in element.children if element.tag.endswith("depend") else ():
            if isinstance(child, Text) and (name := child.content.text.strip()):
                start = child.content.text.index(name)
                yield name, child.content.slice_span(start, start + len(name))


@query
def _near_key(db: Database, name: str) -> str | None:
    """The package of the operating system of whose name this is a slip."""
    near = nearest(name, system_keys()) if name not in system_keys() else None
    return near if near is not None and len(name) >= _LONG and is_slip_of_words(name, near) else None


_LONG = 8
"""Letters: of thousands of names one is always near a short one."""


RULE = Rule(
    id="PKG007",
    name="dependency-not-found",
    effect="misbehaves",
    kind="near",
    always=(Reason.UNSEEN,),
    what="Checks for a dependency in the `package.xml` of a launch file's package that is a typo. The name is not "
    "in the workspace, not installed, not released for any distribution of ROS and not known to rosdep.",
    why="`rosdep install` stops at it, and the intended package is not installed on the robot.",
    example="<exec_depend>robot_state_publiser</exec_depend>",
    instead="<exec_depend>robot_state_publisher</exec_depend>",
    references=(
        MANIFEST_2,
        MANIFEST_3,
        ROSDEP,
    ),
    check=_check,
)
