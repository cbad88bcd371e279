"""LCH004: an element that roslaunch does not know."""

from preflight_analysis.rules.problems import check_names
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="LCH004",
    name="unknown-element",
    severity="warning",
    what="Reports an element that `roslaunch` does not know at that place, and names the nearest one that it knows.",
    why="`roslaunch` prints one line among many others and skips the element with all that is in it: the parameter "
    "is not set, the node is not started.",
    example='<node pkg="camera" type="driver" name="camera">\n  <parm name="rate" value="30"/>\n</node>',
    instead='<node pkg="camera" type="driver" name="camera">\n  <param name="rate" value="30"/>\n</node>',
    check=check_names(
        lambda problem: f"<{problem.data['tag']}> is not known in <{problem.data['parent']}> and is skipped",
        "tag",
        "allowed",
    ),
    problems=("unknown-element",),
)
