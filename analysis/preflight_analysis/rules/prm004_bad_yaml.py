"""PRM004: parameters that are not valid YAML."""

from preflight_analysis.evaluation.problems import BadYaml
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="PRM004",
    name="bad-yaml",
    severity="error",
    what="Reports parameters, in a `<rosparam>` or in the file that it loads, that are not valid YAML or not of the "
    "shape that is needed.",
    why="`roslaunch` stops and starts nothing.",
    example="<rosparam>\nrate: 10\n\tframe: map\n</rosparam>",
    instead="<rosparam>\nrate: 10\nframe: map\n</rosparam>",
    check=check_problems(lambda bad: f"not valid as parameters: {bad.message}", BadYaml),
    problems=(BadYaml,),
    in_branches=True,
)
