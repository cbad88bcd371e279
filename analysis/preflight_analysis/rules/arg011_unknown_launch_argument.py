"""ARG011: the launch is given an argument that nothing asks for."""

from collections.abc import Iterator

from preflight_analysis.evaluation.problems import UnknownLaunchArgument
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import problems_of
from preflight_analysis.rules.further_reading import LAUNCH_SUBSTITUTIONS, ROSLAUNCH_ARG
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, UnknownLaunchArgument):
        name = problem.kind.name
        near = nearest(name, problem.kind.declared)
        yield problem_claim(
            rule,
            problem,
            f"unknown argument '{name}': no file of this launch declares it{did_you_mean(near)}",
            subject=Subject("argument", name),
            kind="near" if near else "absent",
            candidates=(near,),
        )


RULE = Rule(
    id="ARG011",
    name="unknown-launch-argument",
    effect="no-effect",
    kind="near",
    what="Checks for `name:=value` on the command line, or an argument of a root in `.ros-preflight.yaml`, that no "
    "file of the launch declares or uses.",
    why="`roslaunch` and `ros2 launch` report nothing, and the intended argument keeps its default.",
    example='<!-- roslaunch robot.launch cammera:=false -->\n<arg name="camera" default="true"/>',
    instead='<!-- roslaunch robot.launch camera:=false -->\n<arg name="camera" default="true"/>',
    references=(
        ROSLAUNCH_ARG,
        LAUNCH_SUBSTITUTIONS,
    ),
    settings=("roots",),
    check=_check,
    problems=(UnknownLaunchArgument,),
)
