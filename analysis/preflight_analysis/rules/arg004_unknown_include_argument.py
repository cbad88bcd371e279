"""ARG004: an include passes an argument that the file does not declare."""

from collections import Counter
from collections.abc import Iterator

from preflight_analysis.evaluation.problems import UnknownIncludeArgument
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.arguments import declarations, remove_at
from preflight_analysis.model.catalogued import by_catalogue, doubts_of_file
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import problems_of, rename, shown
from preflight_analysis.rules.further_reading import LARGE_PROJECTS, ROSLAUNCH_ARG, ROSLAUNCH_INCLUDE
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    problems = [*problems_of(context, UnknownIncludeArgument)]
    unknown_of = Counter((problem.origin[:-1], problem.kind.file) for problem in problems)
    for problem in problems:
        name, file = problem.kind.name, shown(problem.kind.file, context)
        if name != name.strip() and not problem.fatal:
            continue  # LCH009 names the blanks
        near = nearest(name, problem.kind.declared)
        fixes = rename(context, problem.location, name, near) if near else ()
        if near is None or not _is_needed(context, problem.kind.file, near):
            fixes = (*fixes, *remove_at(context, problem.location, f"Do not pass argument '{name}'"))
        message = f"argument '{name}' is not declared by '{file}'"
        if not problem.fatal:
            message = f"argument '{name}' has no effect: neither '{file}' nor its includes use it"
        message += did_you_mean(near) + by_catalogue(context, problem.kind.file)
        by_file = doubts_of_file(context, problem.kind.file)
        # Nobody makes several slips in one include: it is written for another version of the package.
        other = bool(by_file) and (near is None or unknown_of[problem.origin[:-1], problem.kind.file] > 1)
        yield problem_claim(
            rule,
            problem,
            message,
            subject=Subject("argument", name),
            kind="near" if near else "absent",
            effect="stops-launch" if problem.fatal else "no-effect",
            doubts=(*by_file, *doubts(OTHER_VERSION=other)),
            candidates=(near,),
            fixes=fixes,
        )


def _is_needed(context: Context, file: str, name: str) -> bool:
    """Whether a file declares the argument without a value: without it, the launch would stop."""
    launch_file = context.launch_files.get(file)
    tags = declarations(launch_file).get(name, ()) if launch_file is not None else ()
    return any(tag.value("default") is None and tag.value("value") is None for tag in tags)


RULE = Rule(
    id="ARG004",
    name="unknown-include-argument",
    effect="stops-launch",
    kind="near",
    sometimes=("no-effect", Reason.OTHER_DISTRIBUTION),
    what="Checks for an `<arg>` in an `<include>` that the included file does not declare. In ROS 2 there is no "
    "finding if an include that is not taken may use the argument.",
    why="`roslaunch` stops with `unused args`. `ros2 launch` reports nothing, and the included file uses its default.",
    example='<include file="camera.launch">\n  <arg name="frame" value="front"/>\n</include>',
    instead='<include file="camera.launch">\n  <arg name="frame_id" value="front"/>\n</include>',
    references=(
        ROSLAUNCH_INCLUDE,
        ROSLAUNCH_ARG,
        LARGE_PROJECTS,
    ),
    check=_check,
    problems=(UnknownIncludeArgument,),
    in_branches=True,
)
