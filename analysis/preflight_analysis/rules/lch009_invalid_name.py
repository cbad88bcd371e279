"""LCH009: a name that ROS does not allow."""

from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="LCH009",
    name="invalid-name",
    severity="error",
    what="Reports the name of a node, argument, remap or parameter that ROS does not allow.",
    why="`roslaunch` stops. Names start with a letter (or `/`, `~` where a graph resource is meant) and go on with "
    "letters, digits, `_` and `/`; a node's name has no `/` at all, its namespace is given with `ns`.",
    example='<node pkg="camera" type="driver" name="front/camera"/>',
    instead='<node pkg="camera" type="driver" name="camera" ns="front"/>',
    check=check_problems(
        lambda problem: f"{problem.data['what']} name '{problem.data['name']}' is not allowed: {problem.data['reason']}"
    ),
    problems=("invalid-name",),
)
