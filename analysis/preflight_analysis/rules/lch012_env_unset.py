"""LCH012: $(env) of a variable that is not set."""

from preflight_analysis.evaluation.problems import UnsetVariable
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="LCH012",
    name="environment-variable-unset",
    severity="warning",
    what="Reports `$(env NAME)`, and `os.environ['NAME']` in a Python launch file, of a variable that is not set in "
    "the environment in which the analysis looks.",
    why="`roslaunch` stops where the variable is not set. It may be set on the robot, hence a warning.",
    example='<arg name="robot" default="$(env ROBOT)"/>',
    instead='<arg name="robot" default="$(optenv ROBOT turtle)"/>',
    check=check_problems(lambda unset: f"environment variable '{unset.name}' is not set", UnsetVariable),
    problems=(UnsetVariable,),
)
