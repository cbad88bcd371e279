"""PKG006: a component that its package does not register (ROS 2)."""

from collections.abc import Iterator, Sequence

from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.nearest import did_you_mean, nearest_class
from preflight_analysis.rules.places import attribute_location
from preflight_analysis.rules.problems import include_chain, rename
from preflight_analysis.rules.rule import Context, Rule

_MOST = 3
"""Names in a message."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    executables = context.executables
    for node in context.tree.nodes:
        if node.kind != "composable" or not node.plugin or node.unknowns:
            continue
        registered = executables.components(node.package)
        # A word of the build files that is not understood as a registration may well be one.
        if not registered or node.plugin in registered or executables.is_build_target(node.package, node.plugin):
            continue
        near = nearest_class(node.plugin, registered)
        location = attribute_location(context, node, "plugin")
        yield rule.finding(
            f"package '{node.package}' registers no component '{node.plugin}'"
            f"{did_you_mean(near) if near else '; it registers ' + _named(registered)}",
            location,
            severity=None if near else "warning",
            confidence="likely",
            related=include_chain(node.origin),
            fixes=rename(context, location, node.plugin, near) if near else (),
        )


def _named(registered: Sequence[str]) -> str:
    shown = [f"'{each}'" for each in sorted(registered)[:_MOST]]
    more = len(registered) - len(shown)
    return " and ".join(filter(None, (", ".join(shown), f"{more} more" if more else "")))


RULE = Rule(
    id="PKG006",
    name="component-not-registered",
    severity="error",
    what="Reports the plugin of a `<composable_node>` that is not among those that its package registers, and names "
    "the nearest of these: those that the prefix of an installed package lists, or that the `CMakeLists.txt` of one in "
    "the workspace names in `rclcpp_components_register_node(s)`. Packages of which no component is known are left "
    "alone (ROS 2).",
    why="The container says `Failed to find class with the requested plugin name` and goes on without it.",
    example='<composable_node pkg="vision" plugin="Detector" name="detector"/>\n'
    '<!-- rclcpp_components_register_nodes(detector "vision::Detector") -->',
    instead='<composable_node pkg="vision" plugin="vision::Detector" name="detector"/>',
    generations=(2,),
    check=_check,
    in_branches=True,
)
