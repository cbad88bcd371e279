"""PKG006: a component that its package does not register (ROS 2)."""

from collections.abc import Iterator, Sequence

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest_class
from preflight_analysis.model.places import attribute_location
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.rules.catalogued import slips
from preflight_analysis.rules.further_reading import COMPOSITION
from preflight_analysis.rules.rule import Rule

_MOST = 3
"""Names in a message."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    executables = context.executables
    for node in context.tree.nodes:
        if node.kind != "composable" or not node.plugin or node.unknowns:
            continue
        if node.package not in context.environment.packages:
            yield from slips(rule, context, node, "components", "plugin")
            continue
        registered = executables.components(node.package)
        # A word of the build files that is not understood as a registration may well be one.
        if not registered or node.plugin in registered or executables.is_build_target(node.package, node.plugin):
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
    "in `CMakeLists.txt`. A package without known components is not checked.",
    why="The container logs `Failed to find class with the requested plugin name` and continues without the component.",
    example='<composable_node pkg="vision" plugin="Detector" name="detector"/>\n'
    '<!-- rclcpp_components_register_nodes(detector "vision::Detector") -->',
    instead='<composable_node pkg="vision" plugin="vision::Detector" name="detector"/>',
    references=(COMPOSITION,),
    generations=(2,),
    check=_check,
    in_branches=True,
)
