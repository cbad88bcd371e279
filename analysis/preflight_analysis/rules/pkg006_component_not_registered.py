"""PKG006: a component that its package does not register (ROS 2)."""

import os
import re
from collections.abc import Iterator, Sequence

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.installed_paths import cmake_build
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest_class
from preflight_analysis.model.places import attribute_location
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.rules.catalogued import slips
from preflight_analysis.rules.further_reading import COMPOSITION
from preflight_analysis.rules.packages import check_packages, said_at
from preflight_analysis.rules.rule import Rule

_MOST = 3
"""Names in a message."""
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
_REGISTERED = re.compile(r"\bRCLCPP_COMPONENTS_REGISTER_NODE\s*\(\s*([\w:]+)\s*\)")
_HEADERS = (".hpp", ".h", ".hh", ".hxx", ".ipp", ".inc")
_OTHERWISE = re.compile(
    r"\b(?:CLASS_LOADER_REGISTER_CLASS\w*|PLUGINLIB_EXPORT_CLASS|RCLCPP_COMPONENTS_REGISTER_NODE\s*\([^)]*##)"
)
"""How a source registers classes in another way."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from check_packages(of_package)(rule, context)
    executables = context.executables
    for node in context.tree.nodes:
        if node.kind != "composable" or not node.plugin or node.unknowns:
            continue
        if node.package not in context.environment.packages:
            yield from slips(rule, context, node, "components", "plugin")
            continue
        registered = executables.components(node.package)
        # A word of the build files that is not understood as a registration may well be one.
        if not registered or node.plugin in registered or executables.is_in_build_file(node.package, node.plugin):
            continue
        near = nearest_class(node.plugin, registered)
        location = attribute_location(context, node, "plugin")
        yield rule.claim(
            f"component '{node.plugin}' is not registered by package '{node.package}'"
            f"{did_you_mean(near) if near else '; it registers ' + _named(registered)}",
            location,
            subject=Subject("component", node.plugin),
            kind="near" if near else "absent",
            doubts=doubts(FROM_SOURCE=bool(near), UNSEEN=not near),
            candidates=(near,),
            related=include_chain(node.origin),
            fixes=rename(context, location, node.plugin, near) if near else (),
        )


def of_package(rule: Rule, disk: Disk, environment: Environment, package: Package) -> Iterator[Finding]:
    """The classes that `CMakeLists.txt` lists and whose sources do not register them."""
    build = cmake_build(disk, package)
    for plugin, library in build.components.items():
        target, said = build.targets.get(library), build.components_said.get(plugin)
        sources = build.sources(target) if target is not None else ()
        headers = (path for path in files_in(disk, package.share, deep=True) if path.endswith(_HEADERS))
        texts = [disk.content(path) or "" for path in (*sources, *headers)] if sources else []
        if said is None or not all(texts[: len(sources)]) or any(_OTHERWISE.search(text) for text in texts):
            continue
        registered = {name.removeprefix("::") for text in texts for name in _REGISTERED.findall(_COMMENT.sub("", text))}
        name = plugin.removeprefix("::")
        if not sources or name in registered or any(name.endswith(f"::{each}") for each in registered):
            continue
        if not registered and not any(re.search(rf"\b{re.escape(name.rpartition('::')[2])}\b", text) for text in texts):
            continue  # another file makes the class
        near = nearest_class(name, registered)
        place = said_at(disk, said, plugin)
        if place is not None:
            where = os.path.relpath(sources[0], package.share)
            yield rule.claim(
                f"no RCLCPP_COMPONENTS_REGISTER_NODE({plugin}) in the sources of '{library}' ({where}): no container "
                f"can load it{did_you_mean(near)}",
                place,
                subject=Subject("component", plugin),
                kind="near" if near else "absent",
                doubts=doubts(FROM_SOURCE=True),
                candidates=(near,),
            )


def _named(registered: Sequence[str]) -> str:
    shown = [f"'{each}'" for each in sorted(registered)[:_MOST]]
    more = len(registered) - len(shown)
    return " and ".join(filter(None, (", ".join(shown), f"{more} more" if more else "")))


RULE = Rule(
    id="PKG006",
    name="component-not-registered",
    effect="stops-node",
    kind="near",
    sometimes=(Reason.FROM_SOURCE, Reason.UNSEEN, Reason.OTHER_DISTRIBUTION),
    what="Checks for the plugin of a `<composable_node>` that its package does not register: in the resource index, or "
    "in `CMakeLists.txt`. A package without known components is not checked. Also checks that the sources of what "
    "`CMakeLists.txt` registers have `RCLCPP_COMPONENTS_REGISTER_NODE`.",
    why="The container logs `Failed to find class with the requested plugin name` and continues without the component.",
    example='<composable_node pkg="vision" plugin="Detector" name="detector"/>\n'
    '<!-- rclcpp_components_register_nodes(detector "vision::Detector") -->',
    instead='<composable_node pkg="vision" plugin="vision::Detector" name="detector"/>',
    references=(COMPOSITION,),
    generations=(2,),
    check=_check,
    of_package=of_package,
    in_branches=True,
)
