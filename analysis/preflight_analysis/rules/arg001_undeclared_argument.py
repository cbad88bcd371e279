"""ARG001: $(arg) of an argument that is not declared."""

from preflight_analysis.rules.problems import check_names
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="ARG001",
    name="undeclared-argument",
    severity="error",
    what="Reports `$(arg name)` where the file has not declared that argument before, and names the nearest one that "
    "it has declared.",
    why="`roslaunch` stops. An argument is known only in the file that declares it, from its `<arg>` on; files that "
    "are included get it only if it is passed.",
    example='<arg name="camera" default="front"/>\n<node pkg="p" type="t" name="$(arg camra)"/>',
    instead='<arg name="camera" default="front"/>\n<node pkg="p" type="t" name="$(arg camera)"/>',
    check=check_names(lambda problem: f"argument '{problem.data['name']}' is not declared", "name", "declared"),
    problems=("arg-undeclared",),
)
