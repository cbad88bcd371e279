"""ARG001: $(arg) of an argument that is not declared."""

from collections.abc import Iterator

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.problems import Problem, UndeclaredArgument
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.rules.arguments import declarations, declare
from preflight_analysis.rules.nearest import did_you_mean, nearest
from preflight_analysis.rules.parts_of_launches import is_configured_elsewhere, is_part
from preflight_analysis.rules.problems import problem_finding, problems_of, rename
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    part_of_another = context.once(is_part)
    for problem in problems_of(context, UndeclaredArgument):
        name, place = problem.kind.name, problem.location
        message = f"argument '{name}' is not declared"
        launch_file = context.launch_files.get(place.file)
        elsewhere = declarations(launch_file).get(name, ()) if launch_file is not None else ()
        if elsewhere:
            later = elsewhere[0].span.start > place.span.start
            where = "before this place" if later else "here, but in another <group> or under a condition"
            declared = Related("declared here", context.location(place.file, elsewhere[0].head_span))
            yield problem_finding(rule, problem, f"{message} {where}", related=(declared,))
            continue
        near = nearest(name, problem.kind.declared)
        if problem.kind.not_followed is not None:
            yield _unsure(rule, context, problem, near, problem.kind.not_followed)
            continue
        fixes = (*(rename(context, place, name, near) if near else ()), *declare(context, place.file, name))
        if near is None and (part_of_another or is_configured_elsewhere(context, name)):
            message += ": another launch file that includes this one has to set it"
            yield problem_finding(rule, problem, message, severity="info", confidence="possible", fixes=fixes)
            continue
        yield problem_finding(rule, problem, message + did_you_mean(near), fixes=fixes)


def _unsure(
    rule: Rule, context: Context, problem: Problem[UndeclaredArgument], near: str | None, not_followed: Location
) -> Finding:
    """What comes before could not be evaluated, and in ROS 2 it may have set the argument."""
    name = problem.kind.name
    return problem_finding(
        rule,
        problem,
        f"nothing that could be read declares argument '{name}'{did_you_mean(near)}",
        severity="warning" if near else "hint",
        confidence="possible",
        related=(Related("this could not be read, and may set it", not_followed),),
        fixes=rename(context, problem.location, name, near) if near else (),
    )


RULE = Rule(
    id="ARG001",
    name="undeclared-argument",
    severity="error",
    what="Reports `$(arg name)` where the file has not declared that argument before, and names the nearest one that "
    "it has declared. In ROS 2 an included file sets arguments of its includer too: after an include that cannot be "
    "read it is a warning where there is a name that near, and a hint else. It knows those of its includer as well: in "
    "a file that is made to be included it is information.",
    why="`roslaunch` stops. An argument is known only in the file that declares it, from its `<arg>` on; files that "
    "are included get it only if it is passed.",
    example='<arg name="camera" default="front"/>\n<node pkg="p" type="t" name="$(arg camra)"/>',
    instead='<arg name="camera" default="front"/>\n<node pkg="p" type="t" name="$(arg camera)"/>',
    check=_check,
    problems=(UndeclaredArgument,),
    in_branches=True,
)
