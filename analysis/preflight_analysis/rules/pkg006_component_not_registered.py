"""PKG006: a component that its package does not register (ROS 2)."""

import os
from collections.abc import Iterator

from preflight_analysis.environment.shares import cmake_build
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.nearest import did_you_mean, nearest
from preflight_analysis.rules.places import attribute_location
from preflight_analysis.rules.problems import include_chain, rename
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for node in context.tree.nodes:
        if node.kind != "composable" or not node.plugin or node.unknowns:
            continue
        package = context.environment.packages.get(node.package)
        if package is None or not os.path.isfile(os.path.join(package.share, "CMakeLists.txt")):
            continue
        registered = cmake_build(package).components
        if not registered or node.plugin in registered:
            continue
        near = nearest(node.plugin, registered) or nearest(node.plugin, registered, key=_class)
        location = attribute_location(node, "plugin")
        yield rule.finding(
            f"package '{node.package}' registers no component '{node.plugin}'; it registers {len(registered)}"
            f"{did_you_mean(near)}",
            location,
            severity="warning" if near else "info",
            confidence="likely",
            related=include_chain(node.origin),
            fixes=rename(context, location, node.plugin, near) if near else (),
        )


def _class(name: str) -> str:
    return name.rpartition("::")[2]


RULE = Rule(
    id="PKG006",
    name="component-not-registered",
    severity="warning",
    what="Reports the plugin of a `<composable_node>` that is not among those that the `CMakeLists.txt` of its package "
    "registers with `rclcpp_components_register_node`, and names the nearest of these. Packages that are only "
    "installed, or register none there, are left alone (ROS 2).",
    why="The container says `Failed to find class with the requested plugin name` and goes on without it.",
    example='<composable_node pkg="vision" plugin="Detector" name="detector"/>\n'
    '<!-- rclcpp_components_register_nodes(detector "vision::Detector") -->',
    instead='<composable_node pkg="vision" plugin="vision::Detector" name="detector"/>',
    generations=(2,),
    check=_check,
)
