"""ARG008: an argument that its file declares and does not use."""

import os
import re
import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import SpannedText
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation.problems import ArgumentNeeded, UndeclaredArgument
from preflight_analysis.evaluation.tree import Include
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix, Related
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.configurations import IMPLICIT
from preflight_analysis.launch.model import Action, LaunchFile, Value, action_at
from preflight_analysis.launch.references import arg_references
from preflight_analysis.launch.substitutions import parse_value
from preflight_analysis.model.arguments import declarations, pass_on
from preflight_analysis.model.context import Context
from preflight_analysis.model.name_index import in_package
from preflight_analysis.model.nearest import nearest
from preflight_analysis.model.problems import all_of, fix, problems_of, shown
from preflight_analysis.rules.further_reading import LARGE_PROJECTS, ROSLAUNCH_ARG
from preflight_analysis.rules.rule import Rule

_VARIABLE = re.compile(r"\$\(\s*var\s+['\"]?([^\s()$'\"]+)")
_ANY = re.compile(r"\$\(\s*var\s+['\"]?\$\(")
"""Where the name of an argument is itself computed."""
_ANY_IN_PYTHON = re.compile(r"IncludeLaunchDescription|launch_configurations|LaunchConfiguration\(\s*[^'\"\s]")
_IMPORT = re.compile(r"^[ \t]*(?:from|import)[ \t]+(\w*)", re.MULTILINE)
_WITHOUT_NAMES = sys.stdlib_module_names | {
    "launch", "launch_ros", "launch_xml", "launch_yaml", "ament_index_python", "lifecycle_msgs", "nav2_common",
    "xacro", "yaml",
}  # fmt: skip
"""Modules that take arguments by no name of their own."""
_LEFT_OUT = re.compile(r"<!(?:--.*?-->|\[CDATA\[.*?\]\]>)", re.DOTALL)
_FALSE = ("false", "0", "")
_FIXED = ("find", "find-pkg-share", "dirname", "path-join")
"""Substitutions that give the same in every launch."""


@dataclass(frozen=True, slots=True)
class _Arguments:
    """What a file does with arguments, conditions or not. `substituted` are files that it loads with subst_value."""

    used: frozenset[str]
    passes_all: bool
    substituted: tuple[Value, ...]


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if context.tree.ros.shared_configurations:
        yield from _check_ros2(rule, context)
        yield from _passed_in_vain_ros2(rule, context)
        return
    for launch_file, unused, substituted in filter(None, context.each(_unused, context.launch_files.values())):
        path, declared = launch_file.path, declarations(launch_file)
        in_texts = _used_in_texts(context, path, substituted)
        if in_texts is None:
            continue
        for name in sorted(unused - in_texts):
            tags = declared[name]
            value = tags[0].value("name")
            location = context.location(path, value.span if value is not None else tags[0].head_span)
            givers = [include for include in _includers(context).get(path, ()) if name in include.args]
            # An include that passes it would break without the declaration: it is part of what the files agreed on.
            if not any(tag.value("value") is not None for tag in tags):
                for include in {include.origin[-1]: include for include in givers}.values():
                    yield from _given_in_vain(rule, context, include, name, location)
            if givers:
                continue
            files = _passed_around(context, path)[name]
            if files and not any(tag.value("value") is not None for tag in tags):
                yield rule.claim(
                    f"argument '{name}' is never used in this file, but {_who_passes(files)}",
                    location,
                    subject=Subject("argument", name),
                    effect="no-effect",
                    doubts=doubts(INTENDED=_is_left_out(context, path, name)),
                )
                continue
            remove = _removal(context, path, name, tags)
            below = _declared_below(context, path, name)
            if below is None:
                message = f"unused argument '{name}': no tag of this file uses it"
                yield rule.claim(message, location, subject=Subject("argument", name), fixes=remove)
            else:
                included, its_declaration = below
                # A value that no includer may give is for what this file does, whatever is called like it below.
                own = any(tag.value("value") is not None for tag in tags)
                passed = () if own else pass_on(context, included.origin[-1], name)
                yield rule.claim(
                    f"argument '{name}' has no effect: the include does not pass it to "
                    f"'{shown(str(included.path), context)}', which declares it too",
                    location,
                    subject=Subject("argument", name),
                    effect="no-effect",
                    related=(
                        Related("included here", included.file_location),
                        Related("declared here", its_declaration),
                    ),
                    fixes=(*passed, *remove),
                )


def _given_in_vain(rule: Rule, context: Context, include: Include, name: str, declared: Location) -> Iterator[Finding]:
    """Where an include passes what its file does not use: whoever wrote that believes that it has an effect."""
    includer = context.launch_files.get(include.origin[-1].file)
    action = action_at(includer, include.origin[-1].span.start + 1) if includer is not None else None
    file = action.value("file") if action is not None else None
    # Of files of which one is chosen, each has to declare what all of them are passed.
    if action is None or file is None or any(part.command not in _FIXED for part in file.substitutions):
        return
    assert includer is not None
    for given in action.children:
        value = given.value("name")
        if given.kind == "arg" and value is not None and value.text == name:
            where = shown(str(include.path), context)
            left_out = _is_left_out(context, declared.file, name)
            in_common = len(_files_given(includer).get(name, ())) > 1
            yield rule.claim(
                f"argument '{name}' has no effect: '{where}' "
                + ("uses it only in a comment" if left_out else "declares it but never uses it"),
                context.location(include.origin[-1].file, value.span),
                subject=Subject("argument", name),
                effect="no-effect",
                doubts=doubts(INTENDED=left_out, SHARED=in_common),
                related=(Related("declared here", declared),),
            )


@derived
def _files_given(launch_file: LaunchFile) -> Mapping[str, set[str]]:
    """The files that the includes of a file pass each argument: where they are several, they may agree on what all of
    them declare."""
    given: dict[str, set[str]] = {}
    for action in launch_file.root.walk() if launch_file.root is not None else ():
        for child in action.children if action.kind == "include" else ():
            name, file = child.value("name"), action.value("file")
            if child.kind == "arg" and name is not None and file is not None:
                given.setdefault(name.text, set()).add(file.text)
    return given


def _passed_around(context: Context, path: str) -> Counter[str]:
    """How many launch files of the package that include the file by its place in a package pass it each argument."""
    passed = in_package(context, "passed").items()
    return Counter({each.text: count for each, count in passed if each.of == os.path.basename(path)})


def _who_passes(files: int) -> str:
    return "1 launch file of the package passes it" if files == 1 else f"{files} launch files of the package pass it"


def _is_left_out(context: Context, path: str, name: str) -> bool:
    """Whether a comment or a section of character data of the file speaks of the argument: whoever wrote that knows
    that it is not used, and keeps it for those who pass it."""
    document = context.documents.get(path)
    word = re.compile(rf"(?<!\w){re.escape(name)}(?!\w)")
    return document is not None and any(word.search(text) for text in _LEFT_OUT.findall(document.text))


def _declared_below(context: Context, path: str, name: str) -> tuple[Include, Location] | None:
    """The include in a file that is not passed an argument which the included file declares and may be given, and
    where it does; nothing if one is passed it, under whatever name of another."""
    for include in _includes(context).get(path, ()):
        if include.path is None or name in include.args:
            continue
        launch_file = context.launch_files.get(include.path)
        for tag in declarations(launch_file).get(name, ()) if launch_file is not None else ():
            value = tag.value("name")
            if value is not None and tag.value("value") is None:
                return include, context.location(include.path, value.span)
    return None


def _unused(launch_file: LaunchFile) -> tuple[LaunchFile, frozenset[str], tuple[Value, ...]] | None:
    """The file, the arguments that it declares and does not use itself, and the files that may use them."""
    # What is malformed may hide the rest of the file.
    if launch_file.document.problems or launch_file.document.entities:
        return None
    arguments = _arguments(launch_file)
    unused = declarations(launch_file).keys() - arguments.used
    return (launch_file, frozenset(unused), arguments.substituted) if unused and not arguments.passes_all else None


@derived
def _includes(context: Context) -> Mapping[str, list[Include]]:
    """The includes in each file."""
    found: dict[str, list[Include]] = {}
    for include in context.tree.includes:
        found.setdefault(include.origin[-1].file, []).append(include)
    return found


@derived
def _includers(context: Context) -> Mapping[str, list[Include]]:
    """The includes of each file."""
    found: dict[str, list[Include]] = {}
    for include in context.tree.includes:
        if include.path is not None:
            found.setdefault(include.path, []).append(include)
    return found


def _check_ros2(rule: Rule, context: Context) -> Iterator[Finding]:
    """In ROS 2 an argument is known in all that is included, and after an include what that has declared: only a
    launch of one file tells."""
    path = context.root
    launch_file = context.launch_files.get(path)
    if launch_file is None or launch_file.document.problems or context.tree.includes:
        return
    if any(problems_of(context, ArgumentNeeded)):
        return  # made to be included by another, which knows the argument too
    python = launch_file.is_python
    if python and (not context.tree.complete or _uses_others(launch_file.document.text)):
        return  # what it was not seen to do may use it, and what helpers of the project do is not in its text
    texts = [document.text for document in context.documents.values()]
    if any((_ANY_IN_PYTHON if python else _ANY).search(text) for text in texts):
        return
    used = IMPLICIT.union(*(_VARIABLE.findall(text) for text in texts))
    for name, tags in declarations(launch_file).items():
        quoted = sum(text.count(f"'{name}'") + text.count(f'"{name}"') for text in texts) if python else 1
        value = tags[0].value("name")
        if name in used or quoted != 1 or value is None or not value.is_literal:
            continue
        yield rule.claim(
            f"unused argument '{name}': nothing in this launch uses it",
            context.location(path, value.span),
            subject=Subject("argument", name),
            fixes=_removal(context, path, name, tags),
        )


def _removal(context: Context, path: str, name: str, tags: tuple[Action, ...]) -> tuple[Fix, ...]:
    """A fix that removes all declarations of an argument, if each can be; none where an argument is asked for that is a
    slip of it."""
    writer = context.writer(path)
    asked = [problem.kind.name for problem in problems_of(context, UndeclaredArgument)]
    if writer is None or nearest(name, asked) is not None:
        return ()
    return fix(f"Remove the declaration of '{name}'", all_of(*(writer.remove(tag) for tag in tags)))


def _passed_in_vain_ros2(rule: Rule, context: Context) -> Iterator[Finding]:
    """What is passed to files that include nothing themselves. As an argument is known in all that comes after, no file
    may name it which does not pass it."""
    for path, includers in _includers(context).items():
        launch_file = context.launch_files.get(path)
        if launch_file is None or path in _includes(context):
            continue
        for name, span in _named_once(launch_file):
            givers = {each.origin[-1]: each for each in includers if name in each.args}
            passing = {path, *(place.file for place in givers)}
            others = (document.text for file, document in context.documents.items() if file not in passing)
            if givers and not any(name in other for other in others):
                for include in givers.values():
                    yield from _given_in_vain(rule, context, include, name, context.location(path, span))


@derived
def _named_once(launch_file: LaunchFile) -> tuple[tuple[str, Span], ...]:
    """The arguments that a file declares and names nowhere else, not even in a comment."""
    python, text = launch_file.is_python, launch_file.document.text
    if launch_file.document.problems or (python and _uses_others(text)):
        return ()
    if (_ANY_IN_PYTHON if python else _ANY).search(text):
        return ()
    values = ((name, tags[0].value("name")) for name, tags in declarations(launch_file).items())
    return tuple(
        (name, value.span)
        for name, value in values
        if value is not None and value.is_literal and len(re.findall(rf"(?<!\w){re.escape(name)}(?!\w)", text)) == 1
    )


def _uses_others(text: str) -> bool:
    return not set(_IMPORT.findall(text)) <= _WITHOUT_NAMES


@derived
def _arguments(launch_file: LaunchFile) -> _Arguments:
    root = launch_file.root
    if root is None:
        return _Arguments(frozenset(), False, ())
    return _Arguments(frozenset(root.gather(_used_by)), any(root.gather(_passes_all)), tuple(root.gather(_substituted)))


def _used_by(action: Action) -> set[str]:
    texts = [attribute.value.text for attribute in action.attributes if "$" in attribute.value.text]
    texts += (action.body.text,) if _substitutes(action) else ()
    return {name for text in texts for name in _references(text)}


def _passes_all(action: Action) -> tuple[bool, ...]:
    return (True,) if action.kind == "include" and not _is_false(action.value("pass_all_args")) else ()


def _substituted(action: Action) -> tuple[Value, ...]:
    file = action.value("file")
    return (file,) if file is not None and _substitutes(action) else ()


def _substitutes(action: Action) -> bool:
    return action.kind == "rosparam" and not _is_false(action.value("subst_value"))


def _references(text: str) -> set[str]:
    """The arguments that a text speaks of."""
    return {name for name, _ in arg_references(parse_value(SpannedText(text, Span(0, len(text)))))}


def _used_in_texts(context: Context, path: str, files: Iterable[Value]) -> set[str] | None:
    """The arguments that YAML files loaded with subst_value use; None if one of those files is not known here."""
    wanted = {value.span for value in files}
    if not wanted:
        return set()
    found: dict[object, set[str]] = {}
    for use in context.tree.uses:
        if use.kind == "file" and use.location.file == path and use.location.span in wanted:
            document = context.documents.get(use.name)
            if document is not None:
                found.setdefault(use.location.span, set()).update(_references(document.text))
    return set().union(*found.values()) if found.keys() == wanted else None


def _is_false(value: Value | None) -> bool:
    return value is None or value.text.strip().lower() in _FALSE


RULE = Rule(
    id="ARG008",
    name="argument-never-used",
    effect="style",
    kind="unused",
    sometimes=("no-effect", Reason.INTENDED, Reason.SHARED),
    what="Checks for an `<arg>` that its own file does not use, whatever the conditions, and for an include that "
    "passes such an argument. In ROS 2 included files see the argument: only what no file names is reported.",
    why="The argument has no effect when it is set on the command line. An argument is visible only in the file "
    "that declares it. An included file gets it only if the include passes it.",
    example='<arg name="rate" default="10"/>\n<include file="$(find camera)/launch/camera.launch"/>',
    instead='<arg name="rate" default="10"/>\n<include file="$(find camera)/launch/camera.launch">\n'
    '  <arg name="rate" value="$(arg rate)"/>\n</include>',
    references=(
        ROSLAUNCH_ARG,
        LARGE_PROJECTS,
    ),
    check=_check,
    every_root=True,
)
