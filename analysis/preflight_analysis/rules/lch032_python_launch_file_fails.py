"""LCH032: a Python launch file raises an exception."""

import os
import re
from collections.abc import Iterator

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.secrets import within
from preflight_analysis.documents.span import Location
from preflight_analysis.edits.edit import Edit
from preflight_analysis.edits.python import PythonWriter
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.loaded_modules import is_loaded_module
from preflight_analysis.evaluation.problems import PythonException, PythonImportFailed
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix, Related
from preflight_analysis.findings.lack import Lack
from preflight_analysis.model.asked_variables import lack_of_asked
from preflight_analysis.model.context import Context
from preflight_analysis.model.distributions import BEFORE_GALACTIC, otherwise_in
from preflight_analysis.model.elsewhere import (
    absent_top,
    absent_top_said,
    asks_for_unbuilt_package,
    names_folder_of_build,
)
from preflight_analysis.model.files import is_below_own_home, meant_file, nearest_file
from preflight_analysis.model.installed import has_ros, lack_of_file, lack_of_made, lack_of_module, may_be_made
from preflight_analysis.model.nearest import did_you_mean
from preflight_analysis.model.problems import fix, problems_of, shown
from preflight_analysis.model.python_imports import absent_module, slip_of
from preflight_analysis.model.python_keywords import UnknownKeyword, unknown_keywords
from preflight_analysis.model.said import missing_file, missing_name, words_of
from preflight_analysis.model.undefined_names import undefined_names
from preflight_analysis.rules.further_reading import FORMATS, SECURITY
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule

_RAISE = re.compile(r"\s*raise\b")
_OF_MACHINE = re.compile(
    r"""['"](?:/(?:\.dockerenv|dev|etc|proc|run|sys)\b|git\b)|\bos\.environ\b|\bgetenv\(|\bwhich\(|\bplatform\.|\bgethostname\("""
)
_ARGV = re.compile(r"\bsys\.argv\b")
_BEFORE = 4
"""Lines before a `raise` that say what it is raised for."""
_OF_TEXTS = ("AttributeError", "IndexError", "TypeError", "ValueError")
"""What is raised where a text does not have what was looked for in it."""
_RELEASES = "Humble, Jazzy, Kilted or Rolling"
_OLD_KEYWORDS = frozenset(("node_executable", "node_name", "node_namespace", "node_plugin"))
"""Of nodes and components, deprecated in Foxy."""
_ARGUMENTS = ("() missing", "() got an unexpected keyword argument", "() got multiple values for")
_LAUNCH = frozenset((
    "launch", "launch_ros", "launch_xml", "launch_yaml", "launch_testing", "launch_testing_ros",
    "launch_testing_ament_cmake",
))  # fmt: skip
"""The modules of which all names are known."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    wrong_calls = {
        path: unknown_keywords(launch_file)
        for path, launch_file in context.launch_files.items()
        if launch_file.is_python and launch_file.partial
    }
    for path, wrong_keywords in wrong_calls.items():
        yield from (_keyword(rule, context, path, each) for each in wrong_keywords)
    for problem in problems_of(context, PythonException, PythonImportFailed):
        why: tuple[Doubt, ...] = ()
        lack: Lack | None = None
        related: tuple[Related, ...] = ()
        meant: tuple[str, str] | None = None
        match problem.kind:
            case PythonImportFailed() as failed:
                # Which modules there are is a matter of the environment, which may be another one when it is launched.
                there = has_ros(context)
                wrong = _wrong_import(context, failed, problem.location.file)
                about = Subject("module", failed.module)
                if wrong is not None:
                    message, why = wrong
                else:
                    lack = _lack(context, failed)
                    why = doubts(UNSEEN=there, PARTLY_READ=not there)
                    message = _import(context, failed, problem.location.file, has_ros=there)
            case PythonException("InvalidPythonLaunchFileError") if is_loaded_module(
                context.disk, problem.location.file
            ):
                continue
            case PythonException("TypeError", said) if any(each in said for each in _ARGUMENTS) and any(
                each.call.start <= problem.location.span.start < each.call.end
                or problem.location.span.contains(each.call.start)
                for each in wrong_calls.get(problem.location.file, ())
            ):
                continue  # said of the keyword itself
            case PythonException(error, said, frames, absent):
                message = ": ".join(filter(None, (error, said))) if error else f"launch file cannot be run: {said}"
                near, missing = _near_file(context, error, said), _missing_file(error, said)
                about = Subject("file", missing or absent or "")
                meant = _meant_name(context, problem.location) if error == "NameError" else None
                top = absent_top(context.disk, missing) if missing is not None else None
                message += meant_file(context, missing, near) if missing is not None else ""
                if meant is not None:
                    about, message = Subject("name", meant[0]), f"{message}{did_you_mean(meant[1])}"
                elif near is not None:
                    if top is None and missing is not None:
                        why = doubts(ON_ROBOT=is_below_own_home(context, missing, problem.location.file))
                elif missing is not None:
                    lack = lack_of_made(context, missing) or lack_of_file(context, missing)
                    top = top if lack is None else None
                else:
                    top = absent_top_said(context.disk, f"{error}: {said}")
                if top is not None:
                    why, message = doubts(ON_ROBOT=top), f"{message}; this machine has no '{top}'"
                elif near is not None or missing is not None:
                    pass
                elif absent and not _is_of_workspace(context, absent):
                    why, message = doubts(ON_ROBOT=absent), f"{message}; this machine has no '{absent}'"
                elif absent and (lack := lack_of_made(context, absent)) is not None:
                    pass
                elif absent and _is_of_build(context, absent, problem.location.file):
                    why = doubts(MADE_ELSEWHERE=True)
                    message += f"; the build of the package may create '{shown(absent, context)}'"
                elif error == "SystemExit":
                    why, message = doubts(INTENDED=True), _ends_itself(context, frames, said)
                elif "NoneType" in said and (lack := lack_of_asked(context, problem.location.file)) is not None:
                    message += f"; environment variable '{lack.name}' is not set"
                elif (name := _empty_argument(context, frames, said)) is not None:
                    why, message = doubts(NOT_SET=f"argument '{name}'"), f"{message}; argument '{name}' is empty"
                elif _refuses_the_machine(context, frames):
                    why = doubts(ON_ROBOT=True)
                    message += "; the file asks for the machine that it runs on"
                elif _takes_installed_path_apart(context, error, frames):
                    why = doubts(PARTLY_READ=True)
                    message += "; the file takes the path of an installed package apart, and the workspace is not built"
                places = (place for place in reversed(frames) if place != problem.location)
                related = tuple(Related("in the traceback", place) for place in places)
        said_by_python = say("{quoted}", quoted=message)
        yield problem_claim(
            rule,
            problem,
            said_by_python,
            subject=about,
            kind="near" if meant is not None else None,
            effect=rule.effect,
            doubts=why,
            candidates=meant[1:2] if meant is not None else (),
            related=related,
            fixes=_renamed(context, problem.location, meant) if meant is not None else (),
            lack=lack,
        )


def _meant_name(context: Context, place: Location) -> tuple[str, str] | None:
    """A name that nothing defines, where it is raised for, and the one that was probably meant."""
    launch_file = context.launch_files.get(place.file)
    names = undefined_names(launch_file.document) if launch_file is not None else ()
    written = context.text(place)
    return next(((name, near) for name, near, _, _ in names if name == written and near is not None), None)


def _renamed(context: Context, place: Location, meant: tuple[str, str]) -> tuple[Fix, ...]:
    writer, (name, near) = context.writer(place.file), meant
    edits = writer.rename_names(name, near) if isinstance(writer, PythonWriter) else ()
    return fix(f"Replace '{name}' with '{near}'", edits, preferred=True)


def _keyword(rule: Rule, context: Context, path: str, wrong: UnknownKeyword) -> Finding:
    place = context.location(path, wrong.span)
    writer = context.writer(path)
    edits: tuple[Edit, ...] = ()
    if wrong.near is not None and isinstance(writer, PythonWriter):
        edits = writer.rename_keyword(wrong.span, wrong.near)
    fixes = fix(f"Replace '{wrong.name}' with '{wrong.near}'", edits, preferred=True)
    message = f"{wrong.made}() got an unexpected keyword argument '{wrong.name}'{did_you_mean(wrong.near)}"
    return rule.claim(
        message,
        place,
        subject=Subject("keyword", wrong.name),
        kind="invalid" if wrong.near is None else "near",
        doubts=otherwise_in(context.environment, BEFORE_GALACTIC) if wrong.name in _OLD_KEYWORDS else (),
        candidates=(wrong.near,),
        fixes=fixes,
        stops_launch=True,
    )


def _ends_itself(context: Context, frames: tuple[Location, ...], said: str) -> str:
    """What a program says that ends itself, as it does where it needs what nobody gave it."""
    document = context.disk.text(frames[-1].file) if frames else None
    reads = isinstance(document, Document) and _ARGV.search(document.text) is not None
    message = "the launch file calls exit()" + (f": {said}" if said not in ("", "None", "0") else "")
    return message + ("; it reads arguments from sys.argv, and none are given" if reads else "")


def _is_of_workspace(context: Context, path: str) -> bool:
    """Whether a path is that of something which a package or the workspace has, and not the machine or the robot."""
    folders = context.environment.workspace_folders
    return any(within(path, folder) for folder in folders) or package_around(context.environment, path) is not None


def _is_of_build(context: Context, path: str, file: str) -> bool:
    """Whether the build may install what a launch file looked for, elsewhere than in its own folder."""
    return os.path.dirname(path) != os.path.dirname(file) and may_be_made(context, path)


def _empty_argument(context: Context, frames: tuple[Location, ...], said: str) -> str | None:
    """The argument that has to be given: it is empty, and the program itself raises and names it."""
    document = context.disk.text(frames[-1].file) if frames else None
    if not isinstance(document, Document) or _RAISE.match(document.text, frames[-1].span.start) is None:
        return None
    words = words_of(said)
    return next((name for name, arg in context.tree.args.items() if arg.value == "" and name in words), None)


def _refuses_the_machine(context: Context, frames: tuple[Location, ...]) -> bool:
    """Whether the program itself raises where it has asked for the machine right before: a container, a device, a
    variable, a program."""
    document = context.disk.text(frames[-1].file) if frames else None
    if not isinstance(document, Document) or _RAISE.match(document.text, frames[-1].span.start) is None:
        return False
    lines = document.text[: frames[-1].span.start].splitlines()
    return any(_OF_MACHINE.search(line) for line in lines[-_BEFORE:])


def _takes_installed_path_apart(context: Context, error: str | None, frames: tuple[Location, ...]) -> bool:
    """Whether a program fails at a text where it has looked right before for the folder of a build (`/install/`) in the
    path of a package, which lies elsewhere as long as the workspace is not built."""
    document = context.disk.text(frames[-1].file) if frames and error in _OF_TEXTS else None
    if not isinstance(document, Document) or not asks_for_unbuilt_package(context, frames[-1].file):
        return False
    lines = document.text[: frames[-1].span.end].splitlines()
    return any(names_folder_of_build(line) for line in lines[-_BEFORE:])


def _near_file(context: Context, error: str, said: str) -> str | None:
    """The file that was meant by one that is not there."""
    path = _missing_file(error, said)
    return nearest_file(context.disk, path, context.environment) if path is not None else None


def _missing_file(error: str, said: str) -> str | None:
    path = missing_file(said) if error == "FileNotFoundError" else None
    return path if path is not None and os.path.isabs(path) else None


def _lack(context: Context, failed: PythonImportFailed) -> Lack | None:
    """What is not there to be imported; None for a name that a module does not have, and for those of launch itself."""
    if failed.module.partition(".")[0] in _LAUNCH or not failed.message.startswith("No module named"):
        return None
    return lack_of_module(context, failed.module)


def _wrong_import(context: Context, failed: PythonImportFailed, file: str) -> tuple[str, tuple[Doubt, ...]] | None:
    """What is said of an import that no machine can do; None of one that a machine may."""
    name = missing_name(failed.message)
    if name is not None and name.module.partition(".")[0] in _LAUNCH:
        top = name.module.partition(".")[0]
        instead = f"it is in '{failed.instead}'" if failed.instead else f"no {top} of {_RELEASES} has it"
        return f"cannot import name '{name.name}' from '{name.module}'; {instead}", ()
    if name is None and not failed.message.startswith("No module named"):
        return None
    absent = absent_module(context, file, f"{name.module}:{name.name}" if name is not None else failed.module)
    if absent is not None:
        return f"module '{absent[0]}' does not exist{did_you_mean(absent[1])}", ()
    near = slip_of(context, file, failed.module) if name is None else None
    if near is None:
        return None
    return f"module '{failed.module}' is not known{did_you_mean(near)}", doubts(UNSEEN=True)


def _import(context: Context, failed: PythonImportFailed, file: str, *, has_ros: bool) -> str:
    """What is missing, what that means for the rest of the file, and what to do about it."""
    said = failed.message
    module = failed.module.partition(".")[0]
    message = f"{said}; the launch file is read statically, results may be incomplete"
    if failed.stood_in_for:
        message = f"{said}; values that depend on module '{failed.module}' are unresolved"
    if not said.startswith("No module named"):
        return message
    if module in context.environment.packages:
        return f"{message}; package '{module}' of the workspace is not built"
    if not has_ros:
        return f"{message}; ROS is not installed here"
    owner = package_around(context.environment, file)
    names = {module, f"python3-{module}", f"python3-{module.replace('_', '-')}"}
    if owner is None or names.isdisjoint(owner.dependencies):
        return f"{message}; install its package and add it to package.xml"
    return f"{message}; install it with `rosdep install --from-paths src --ignore-src`"


RULE = Rule(
    id="LCH032",
    name="python-launch-file-fails",
    effect="stops-launch",
    kind="invalid",
    sometimes=(
        Reason.NOT_HERE,
        Reason.ON_ROBOT,
        Reason.MADE_ELSEWHERE,
        Reason.NOT_SET,
        Reason.PARTLY_READ,
        Reason.INTENDED,
        Reason.UNSEEN,
        Reason.MEANT_FOR_OTHER,
    ),
    what="Checks for the line of a Python launch file that raises an exception, in `generate_launch_description`, an "
    "`OpaqueFunction`, or an action. Such files run in the sandbox if the workspace is trusted.",
    why="`ros2 launch` stops at this line. Earlier actions may be running already.",
    example='Node(package="camera", node_executable="driver")',
    instead='Node(package="camera", executable="driver")',
    generations=(2,),
    references=(
        FORMATS,
        SECURITY,
    ),
    check=_check,
    problems=(
        PythonException,
        PythonImportFailed,
    ),
)
