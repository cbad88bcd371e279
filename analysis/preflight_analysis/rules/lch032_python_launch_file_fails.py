"""LCH032: a Python launch file raises an exception."""

from collections.abc import Iterator

from preflight_analysis.findings.finding import Confidence, Finding, Related, Severity
from preflight_analysis.rules.problems import include_chain, problems_of
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(rule, context):
        severity: Severity | None = None
        confidence: Confidence = "certain"
        related: tuple[Related, ...] = ()
        if problem.kind == "python-import":
            # Which modules there are is a matter of the environment, which may be another one when it is launched.
            severity, confidence = "warning", "likely"
            message = f"the launch file cannot be run here: {problem.data['message']}"
        else:
            error, said = problem.data["error"], problem.data["message"]
            message = f"{error}: {said}" if error else f"the launch file cannot be run: {said}"
            frames = [place for place in reversed(problem.data["frames"]) if place != problem.location]
            related = tuple(Related("in the traceback", place) for place in frames)
        yield rule.finding(
            message,
            problem.location,
            severity=severity,
            confidence=confidence,
            related=(*related, *include_chain(problem.origin)),
            stops_launch=problem.fatal,
        )


RULE = Rule(
    id="LCH032",
    name="python-launch-file-fails",
    severity="error",
    what="Reports the line of a Python launch file (ROS 2) that raises an exception: while it is loaded, in "
    "`generate_launch_description`, in an `OpaqueFunction`, or by an action that is given what it does not take. Such "
    "files are run in the sandbox, if the workspace is trusted, and nothing of what they describe is started.",
    why="`ros2 launch` stops there. What earlier actions started may be running by then.",
    example='Node(package="camera", node_executable="driver")',
    instead='Node(package="camera", executable="driver")',
    check=_check,
    problems=("python-exception", "python-import"),
)
