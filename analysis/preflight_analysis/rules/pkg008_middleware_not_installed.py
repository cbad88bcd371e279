"""PKG008: a middleware that is not there (ROS 2)."""

from collections.abc import Iterator

from preflight_analysis.environment import middleware
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.installed import has_ros, lack_of_package, near_package
from preflight_analysis.model.nearest import did_you_mean
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import MIDDLEWARE
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if not has_ros(context) and context.environment.ros2_python is None:
        return  # of a machine without ROS 2 more is missing
    of_user = context.environment.variables.get(middleware.VARIABLE)
    using: dict[str, list[LaunchNode]] = {}
    for node in context.tree.nodes:
        name = dict(node.env).get(middleware.VARIABLE, of_user)
        if name and node.package and node.kind != "composable":
            using.setdefault(name, []).append(node)
    for name, nodes in using.items():
        if middleware.is_there(context.environment, name, context.disk.is_file):
            continue
        near = near_package(context, name)
        setter = "your environment" if name == of_user else "the launch"
        others = f" and {len(nodes) - 1} more" if len(nodes) > 1 else ""
        text = "middleware '{name}' is not installed; {setter} sets it for {node}{others}{near}"
        yield rule.claim(
            say(text, name=name, setter=setter, node=nodes[0].name, others=others, near=did_you_mean(near)),
            nodes[0].location,
            subject=Subject("package", name),
            kind="absent" if near is None else "near",
            candidates=(near,),
            related=include_chain(nodes[0].origin),
            lack=lack_of_package(context, name) if near is None else None,
        )


RULE = Rule(
    id="PKG008",
    name="middleware-not-installed",
    effect="stops-node",
    kind="absent",
    sometimes=(Reason.NOT_HERE,),
    what="Checks for a middleware in `RMW_IMPLEMENTATION` that is not installed, once in a launch. The environment or "
    "a `<set_env>` sets the variable. Nodes are then run with the default middleware.",
    why="Each node exits at once with `Expected RMW implementation identifier of 'rmw_cyclonedds_cpp' but instead "
    "found 'rmw_fastrtps_cpp'`.",
    example='<set_env name="RMW_IMPLEMENTATION" value="rmw_cyclonedd_cpp"/>',
    instead='<set_env name="RMW_IMPLEMENTATION" value="rmw_cyclonedds_cpp"/>',
    references=(MIDDLEWARE,),
    generations=(2,),
    check=_check,
)
