"""LCH005: an attribute that roslaunch does not know."""

from preflight_analysis.rules.problems import check_names
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="LCH005",
    name="unknown-attribute",
    severity="warning",
    what="Reports an attribute that the element does not have, and names the nearest one that it has.",
    why="`roslaunch` mentions it and goes on without it: what the attribute was to do does not happen.",
    example='<node pkg="camera" type="driver" name="camera" respwan="true"/>',
    instead='<node pkg="camera" type="driver" name="camera" respawn="true"/>',
    check=check_names(
        lambda problem: f"<{problem.data['tag']}> has no attribute '{problem.data['name']}'", "name", "allowed"
    ),
    problems=("unknown-attribute",),
)
