"""ARG011: the launch is given an argument that nothing asks for."""

from collections.abc import Iterator

from preflight_analysis.evaluation.problems import UnknownLaunchArgument
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.nearest import did_you_mean, nearest
from preflight_analysis.rules.problems import problem_finding, problems_of
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, UnknownLaunchArgument):
        name = problem.kind.name
        near = nearest(name, problem.kind.declared)
        yield problem_finding(
            rule, problem, f"the launch is given '{name}', and nothing in it declares that argument{did_you_mean(near)}"
        )


RULE = Rule(
    id="ARG011",
    name="unknown-launch-argument",
    severity="warning",
    what="Reports a `name:=value` of the command line, or an argument of a root in `.ros-preflight.yaml`, that no file "
    "of the launch declares or uses, and names the nearest one that is.",
    why="`roslaunch` and `ros2 launch` take it without a word, and the argument that was meant has its default.",
    example='<!-- roslaunch robot.launch cammera:=false -->\n<arg name="camera" default="true"/>',
    instead='<!-- roslaunch robot.launch camera:=false -->\n<arg name="camera" default="true"/>',
    check=_check,
    problems=(UnknownLaunchArgument,),
)
