"""LCH017: a node on a machine that is not declared."""

from preflight_analysis.rules.problems import check_names
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="LCH017",
    name="machine-undefined",
    severity="error",
    what="Reports a `machine` attribute that names no `<machine>` declared before, and names the nearest one.",
    why="`roslaunch` stops and starts nothing.",
    example='<machine name="base" address="10.0.0.2"/>\n<node pkg="p" type="t" name="n" machine="bse"/>',
    instead='<machine name="base" address="10.0.0.2"/>\n<node pkg="p" type="t" name="n" machine="base"/>',
    check=check_names(lambda problem: f"machine '{problem.data['name']}' is not declared", "name", "declared"),
    problems=("machine-undefined",),
)
