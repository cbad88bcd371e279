"""PRM008: the command of a parameter has no success."""

import os
import re
import shlex
from collections.abc import Iterator

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.quoted import Program, Quoted
from preflight_analysis.documents.span import Location, Origin
from preflight_analysis.environment.git_ignored import is_ignored
from preflight_analysis.evaluation.problems import CommandFailed, CommandMissing, MalformedCommand, Problem
from preflight_analysis.findings.claim import Subject, as_text, say
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.lack import Lack
from preflight_analysis.launch.problems import ProblemKind
from preflight_analysis.model.context import Context
from preflight_analysis.model.files import in_namesake
from preflight_analysis.model.installed import (
    lack_of_build,
    lack_of_file,
    lack_of_made,
    lack_of_program,
    lack_of_variable,
    lack_said,
)
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import include_chain, problems_of, quoted, rename, shown
from preflight_analysis.model.said import missing_file, words_of
from preflight_analysis.rules.further_reading import ROSLAUNCH_PARAM, SECURITY, XACRO
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule

_STDERR_LINES = 3
_TRACEBACK = "Traceback (most recent call last):"
_NO_INPUT = "xacro: error: expected exactly one input file"
_NONE = re.compile(r"(?<![A-Za-z])None(?![A-Za-z])")
_READS = ("getenv", "environ.get")


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, CommandFailed, CommandMissing, MalformedCommand):
        match problem.kind:
            case CommandMissing(line):
                yield _missing(rule, context, line, problem.origin, stops=problem.fatal)
            case MalformedCommand(message):
                text = say("malformed command: {quoted}", quoted=message)
                yield problem_claim(rule, problem, text, subject=Subject("command"))
            case CommandFailed() as failed:
                yield _failed(rule, context, problem, failed)
    # A program that is named with its folder is looked for without running anything.
    for command in context.tree.commands:
        if command.launch_file:
            continue
        if command.result is None or command.result.status == "not-run":
            program = next(iter(shlex.split(command.line)), "")
            if os.path.isabs(program) and not context.disk.is_program(program):
                yield _missing(rule, context, command.line, command.origin, stops=False)


def _failed(rule: Rule, context: Context, problem: Problem[ProblemKind], failed: CommandFailed) -> Finding:
    lack = lack_said(context, reversed(failed.stderr))
    text, about = say("the command failed: {quoted}", quoted=_said(failed)), Subject("command")
    against: tuple[Doubt, ...] = ()
    missing = (path for path in map(missing_file, failed.stderr) if path is not None and os.path.isabs(path))
    if lack is None and (path := next(missing, None)) is not None:
        lack = _variable_in(context, path, problem.origin)
        if lack is not None:
            about = Subject("variable", lack.name)
            text = as_text(
                f"the command failed: environment variable '{lack.name}' is not set, and names a file that it reads"
            )
        lack = lack or lack_of_made(context, path) or lack_of_file(context, path)
        if lack is None and is_ignored(context.disk, path):
            against = doubts(MADE_ELSEWHERE=True)
            text = text.followed_by("; git ignores the file, so each machine may create it")
    elif lack is None and any(_is_beside(context, problem.origin, line) for line in failed.stderr):
        against = doubts(WHERE_STARTED=True)
        text = text.followed_by("; the path depends on the folder where the launch is started")
    elif any(_NO_INPUT in line for line in failed.stderr):
        # An argument whose default is empty is how Python launch files say that it has to be given.
        empty = [name for name, arg in context.tree.args.items() if not arg.value]
        against = doubts(NOT_SET=f"argument {quoted(empty)}" if empty else "")
        text = text.followed_by("; set argument {empty}", empty=quoted(empty)) if empty else text
    return problem_claim(rule, problem, text, subject=about, doubts=against, lack=lack)


def _is_beside(context: Context, origin: Origin, said: str) -> bool:
    """Whether what a command did not find has no folder, and is in that of the launch file: it is found by those who
    start the launch there."""
    name = missing_file(said)
    name = name if name is not None and not os.path.isabs(name) else None
    folders = {os.path.dirname(place.file) for place in origin}
    beside = (context.disk.text(os.path.join(folder, name)) for folder in folders) if name is not None else ()
    return any(isinstance(each, Document) for each in beside)


def _variable_in(context: Context, path: str, origin: Origin) -> Lack | None:
    """The variable that is not set, and that a launch file in Python made a path of all the same: `None.urdf`."""
    if _NONE.search(path) is None:
        return None
    files = dict.fromkeys(place.file for place in reversed(origin))
    programs = (Program(file, context.documents[file].text) for file in files if file in context.documents)
    names = (each.text for program in programs for each in program.quoted if _reads_variable(program, each))
    unset = next((name for name in names if name not in context.environment.variables), None)
    return lack_of_variable(context, unset) if unset is not None else None


def _reads_variable(program: Program, quoted: Quoted) -> bool:
    """Whether it is a variable that is read without a default."""
    return quoted.call.endswith(_READS) and program.text[quoted.end :].lstrip().startswith(")")


def _said(failed: CommandFailed) -> str:
    """What the command or the sandbox says of it."""
    lines = [line.strip() for line in failed.stderr if line.strip()]
    if any(line.startswith(_TRACEBACK) for line in lines):
        reported = lines[-1:]
    else:
        # xacro says what is wrong and where, and may go on with advice.
        told = (n for n, line in enumerate(lines) if "error" in words_of(line.lower()))
        start = next(told, max(0, len(lines) - _STDERR_LINES))
        reported = lines[start : start + _STDERR_LINES]
    return "; ".join([failed.reason, *reported])


def _missing(rule: Rule, context: Context, line: str, origin: Origin, *, stops: bool) -> Finding:
    """The program is not there, or may not be executed."""
    program = shlex.split(line)[0]
    name = os.path.basename(program)
    against: tuple[Doubt, ...] = ()
    near = lack = None
    if "/" not in program:
        lack = lack_of_program(context, program)
        message = f"program '{program}' is not on the PATH of this environment"
        if lack.remedy:
            message += f"; install it: {lack.remedy}"
    elif context.disk.is_file(program):
        message = f"program '{shown(program, context)}' is not executable; run `chmod +x {program}`"
    elif package := _will_build(context, program):
        message = (
            f"program '{shown(program, context)}' is not built yet: CMakeLists.txt of package '{package}' names it"
        )
        against, lack = doubts(MADE_BY_BUILD=True), lack_of_build(context, package)
    else:
        near = _near(context, program)
        noetic = context.environment.distro in (None, "noetic")
        removed = "; xacro.py is removed since ROS Noetic" if name == "xacro.py" and noetic else ""
        message = f"program '{shown(program, context)}' does not exist{removed}{did_you_mean(near)}"
        lack = lack_of_file(context, program) if near is None and not removed else None
        if (other := in_namesake(context, program)) is not None:
            against, message = doubts(UNSEEN=True), f"{message}; another package of that name has it in '{other}'"
    location: Location = origin[-1]
    return rule.claim(
        message,
        location,
        subject=Subject("command", program),
        kind="absent" if near is None else "near",
        doubts=against,
        candidates=(near,),
        related=include_chain(origin),
        fixes=rename(context, location, name, near) if near else (),
        stops_launch=stops,
        lack=lack,
    )


def _will_build(context: Context, program: str) -> str | None:
    """The package whose build makes the program."""
    executables = context.executables
    for package in context.environment.packages.values():
        inside = program.startswith(package.share.rstrip("/") + "/")
        if inside and executables.is_build_target(package.name, os.path.basename(program)):
            return package.name
    return None


def _near(context: Context, program: str) -> str | None:
    """The most similar program of the same folder."""
    folder, name = os.path.split(program)
    folder = os.path.abspath(folder)
    names = [each for each in context.disk.names(folder) if context.disk.is_program(os.path.join(folder, each))]
    return nearest(name, names) or nearest(name, names, key=lambda each: os.path.splitext(each)[0])


RULE = Rule(
    id="PRM008",
    name="command-failed",
    effect="stops-launch",
    kind="invalid",
    sometimes=(
        Reason.NOT_HERE,
        Reason.MADE_BY_BUILD,
        Reason.MADE_ELSEWHERE,
        Reason.NOT_SET,
        Reason.WHERE_STARTED,
        Reason.UNSEEN,
    ),
    what="Checks for a `<param command=...>` whose command fails or whose program does not exist. The command runs "
    "in the sandbox if the workspace is trusted; `ros-preflight check --no-run` finds missing programs only.",
    why="`roslaunch` runs the command before the first node, and starts nothing if it fails.",
    example='<param name="robot_description" command="$(find xacro)/xacro.py $(find arm)/urdf/arm.xacro"/>',
    instead='<param name="robot_description" command="$(find xacro)/xacro $(find arm)/urdf/arm.xacro"/>',
    references=(
        ROSLAUNCH_PARAM,
        XACRO,
        SECURITY,
    ),
    check=_check,
    problems=(
        CommandFailed,
        CommandMissing,
        MalformedCommand,
    ),
)
