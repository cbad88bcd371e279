"""ARG001: $(arg) of an argument that is not declared."""

import os
import re
from collections.abc import Iterator

from preflight_analysis.documents.span import Location
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.evaluation.problems import Problem, UndeclaredArgument
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.launch.model import Action
from preflight_analysis.model.arguments import declarations, declare, passes_all
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, is_slip, nearest
from preflight_analysis.model.parts_of_launches import is_configured_elsewhere, is_part
from preflight_analysis.model.problems import problems_of, quoted, rename
from preflight_analysis.rules.further_reading import LAUNCH_SUBSTITUTIONS, ROSLAUNCH_ARG
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule

_WORD = re.compile(r"[A-Za-z_]\w*")
_TEXTS = re.compile(r"readme\b|.*\.(?:md|rst|txt|sh)\Z", re.IGNORECASE)


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    part_of_another = is_part(context)
    for problem in problems_of(context, UndeclaredArgument):
        name, place = problem.kind.name, problem.location
        about = Subject("argument", name)
        message = f"argument '{name}' is not declared"
        launch_file = context.launch_files.get(place.file)
        elsewhere = declarations(launch_file).get(name, ()) if launch_file is not None else ()
        asked = passes_all(context, problem.origin[:-1])
        if elsewhere:
            later = elsewhere[0].span.start > place.span.start
            where = "before this line" if later else "in this scope: another <group> or a condition declares it"
            if launch_file is not None and launch_file.is_python:
                where = "here: its DeclareLaunchArgument is not in the LaunchDescription, or comes after this action"
            declared = Related("declared here", context.location(place.file, elsewhere[0].head_span))
            chosen = _choosing(context, elsewhere) if asked and not later else []
            message = f"{message} {where}" + ("; a command-line argument decides" if chosen else "")
            undecided = doubts(NOT_SET=chosen and f"argument {quoted(chosen)}")
            yield problem_claim(
                rule, problem, message, subject=about, kind="unreachable", doubts=undecided, related=(declared,)
            )
            continue
        near = nearest(name, problem.kind.declared)
        if problem.kind.not_followed is not None:
            yield _unsure(rule, context, problem, near, problem.kind.not_followed)
            continue
        fixes = (*(rename(context, place, name, near) if near else ()), *declare(context, problem.origin, name))
        if near is None and (part_of_another or is_configured_elsewhere(context, name)):
            message += "; the including launch file has to set it"
            part = doubts(SET_ASIDE=True)
            yield problem_claim(rule, problem, message, subject=about, kind="absent", doubts=part, fixes=fixes)
            continue
        documented = False
        if asked and not (near is not None and is_slip(name, near)):
            documented = _is_documented(context, place.file, name)
            message += f"; only the command line can set it ({name}:=...)"
        yield problem_claim(
            rule,
            problem,
            message + did_you_mean(near),
            subject=about,
            kind="near" if near else "absent",
            doubts=doubts(INTENDED=documented),
            candidates=(near,),
            fixes=fixes,
        )


def _choosing(context: Context, tags: tuple[Action, ...]) -> list[str]:
    """The arguments by which the command line decides over a condition of one of the declarations, and does not yet."""
    conditions = (value.text for tag in tags for kind in ("if", "unless") if (value := tag.value(kind)) is not None)
    names = {name for condition in conditions for name in _WORD.findall(condition)}
    args = {name: context.tree.args[name] for name in sorted(names & context.tree.args.keys())}
    if any(arg.value_origin is None for arg in args.values()) or all(arg.default is None for arg in args.values()):
        return []
    return [*args]


def _is_documented(context: Context, file: str, name: str) -> bool:
    """Whether the package or the workspace of a launch file says how to give it the argument."""
    package, workspace = package_around(context.environment, file), context.environment.workspace
    folders = (package.share if package is not None else None, workspace, os.path.dirname(file))
    texts = (
        context.disk.content(os.path.join(folder, each))
        for folder in dict.fromkeys(filter(None, folders))
        for each in context.disk.names(folder)
        if _TEXTS.match(each)
    )
    return any(re.search(rf"(?<!\w){re.escape(name)}:=", text) for text in texts if text is not None)


def _unsure(
    rule: Rule, context: Context, problem: Problem[UndeclaredArgument], near: str | None, not_followed: Location
) -> Finding:
    """What comes before could not be evaluated, and in ROS 2 it may have set the argument."""
    name = problem.kind.name
    return problem_claim(
        rule,
        problem,
        f"argument '{name}' is not declared, unless the unresolved include sets it{did_you_mean(near)}",
        subject=Subject("argument", name),
        kind="near" if near else "absent",
        doubts=doubts(UNSEEN=True, NOT_HERE=near is None),
        candidates=(near,),
        related=(Related("unresolved, may set it", not_followed),),
        fixes=rename(context, problem.location, name, near) if near else (),
    )


RULE = Rule(
    id="ARG001",
    name="undeclared-argument",
    effect="stops-launch",
    kind="near",
    sometimes=(Reason.NOT_SET, Reason.INTENDED, Reason.UNSEEN, Reason.NOT_HERE),
    what="Checks for `$(arg name)` where the file has not declared that argument before. In ROS 2 an included file "
    "sets arguments for its includer, and sees those of its includer.",
    why="`roslaunch` stops. An argument is visible only in the file that declares it, after its `<arg>`. An "
    "included file gets it only if the include passes it.",
    example='<arg name="camera" default="front"/>\n<node pkg="p" type="t" name="$(arg camra)"/>',
    instead='<arg name="camera" default="front"/>\n<node pkg="p" type="t" name="$(arg camera)"/>',
    references=(
        ROSLAUNCH_ARG,
        LAUNCH_SUBSTITUTIONS,
    ),
    check=_check,
    problems=(UndeclaredArgument,),
    in_branches=True,
)
