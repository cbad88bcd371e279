"""LCH027: what its authors, roslaunch or a newer distribution of ROS have given up."""

import os
import re
from collections.abc import Iterator

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span
from preflight_analysis.edits.writer import writer_of
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Action, LaunchFile, Value
from preflight_analysis.model.context import Context
from preflight_analysis.model.distributions import BEFORE_MELODIC, BEFORE_NOETIC, otherwise_in
from preflight_analysis.model.installed import has_ros
from preflight_analysis.model.places import attribute_location
from preflight_analysis.model.problems import all_of, fix, include_chain, rename, replacement, shown
from preflight_analysis.model.retired import RETIRED_IN, Retired, retired, retired_program
from preflight_analysis.rules.further_reading import ROSLAUNCH, XACRO
from preflight_analysis.rules.rule import Rule

_PERIOD = re.compile(r"\s+[\d.]+\s*\Z")
_IN_ORDER = re.compile(r"\s--inorder\b")
_PROGRAM = re.compile(r"(?:\$\(find\s+(\w+)\)/|\brosrun\s+(\w+)\s+)([\w.]+)(?![\w./])")
"""One of a package, in a command."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from _includes(rule, context)
    yield from _nodes(rule, context)
    yield from _commands(rule, context)
    yield from _joint_state_publishers(rule, context)
    for path, launch_file in context.launch_files.items():
        document = launch_file.document
        old = _old_language(launch_file)
        for tag in old.masters:
            fixes = fix("Remove <master>", writer_of(document).remove(tag), preferred=True)
            message = "<master> is removed since ROS Fuerte; roslaunch ignores it"
            place = context.location(path, tag.head_span)
            yield rule.claim(message, place, subject=Subject("element"), effect="note", fixes=fixes)
        if context.environment.distro not in BEFORE_MELODIC:
            for span in old.in_order:
                place = context.location(path, span)
                message = "'--inorder' has no effect: xacro processes in order since ROS Melodic"
                fixes = replacement(context, place, "", "Remove --inorder")
                why = otherwise_in(context.environment, BEFORE_MELODIC)
                yield rule.claim(message, place, subject=Subject("command", "--inorder"), doubts=why, fixes=fixes)


def _includes(rule: Rule, context: Context) -> Iterator[Finding]:
    for include in context.tree.includes:
        included = context.launch_files.get(include.path or "")
        root = included.root if included is not None else None
        deprecated = root.value("deprecated") if root is not None else None
        if included is not None and deprecated is not None and deprecated.text:
            message = f"'{shown(included.path, context)}' is deprecated: {deprecated.text}"
            place = (*include.origin[:-1], include.file_location)
            yield rule.claim(
                message,
                include.file_location,
                subject=Subject("file", included.path),
                effect="misbehaves",
                related=include_chain(place),
            )


def _nodes(rule: Rule, context: Context) -> Iterator[Finding]:
    for node in filter(None, context.each(_of_retired_package, context.tree.nodes)):
        for each in retired(context, node):
            attribute = "type" if each.executable is not None else "pkg"
            yield rule.claim(
                each.message,
                attribute_location(context, node, attribute),
                subject=Subject("executable", f"{each.package}/{each.executable or ''}"),
                kind="absent" if each.removed else None,
                effect="stops-node" if each.removed else None,
                doubts=(
                    *doubts(UNSEEN=each.removed and not has_ros(context)),
                    *otherwise_in(context.environment, each.still_in),
                ),
                related=include_chain(node.origin),
                fixes=_fixes(context, each, node),
            )


def _commands(rule: Rule, context: Context) -> Iterator[Finding]:
    for path, launch_file in context.launch_files.items():
        text = launch_file.document.text
        for command in _old_language(launch_file).commands:
            found = _PROGRAM.search(text, *command.span)
            package = (found[1] or found[2]) if found is not None else ""
            # What of a package that is here does not exist is PRM008's.
            if found is None or package in context.environment.packages:
                continue
            place = context.location(path, Span(*found.span(3)))
            for each in retired_program(context, package, found[3], is_there=False):
                yield rule.claim(
                    each.message,
                    place,
                    subject=Subject("command", f"{package}/{found[3]}"),
                    kind="absent" if each.removed else None,
                    effect="stops-launch" if each.removed else None,
                    doubts=(
                        *doubts(UNSEEN=each.removed and not has_ros(context)),
                        *otherwise_in(context.environment, each.still_in),
                    ),
                    fixes=rename(context, place, found[3], each.instead_executable) if each.instead_executable else (),
                )


def _of_retired_package(node: LaunchNode) -> LaunchNode | None:
    return node if node.package in RETIRED_IN else None


def _fixes(context: Context, each: Retired, node: LaunchNode) -> tuple[Fix, ...]:
    if each.instead_executable:
        return rename(context, attribute_location(context, node, "type"), node.executable, each.instead_executable)
    if each.instead_package:
        return rename(context, attribute_location(context, node, "pkg"), node.package, each.instead_package)
    document, writer = context.documents.get(node.location.file), context.writer(node.location.file)
    if each.package != "tf" or document is None or writer is None:
        return ()
    package, args = attribute_location(context, node, "pkg"), attribute_location(context, node, "args")
    # x y z and yaw pitch roll or a quaternion, two frames, the period.
    period = _PERIOD.search(document.text, args.span.start, args.span.end)
    if period is None or len(node.args.split()) not in (9, 10) or context.text(package) != "tf":
        return ()
    shorter = writer.replace(Span(period.start(), args.span.end), "")
    return fix("Use static_transform_publisher of tf2_ros", all_of(writer.replace(package.span, "tf2_ros"), shorter))


def _joint_state_publishers(rule: Rule, context: Context) -> Iterator[Finding]:
    """Its parameter `use_gui`: https://github.com/ros/joint_state_publisher/pull/34."""
    if context.environment.distro in BEFORE_NOETIC:
        return
    for node in filter(None, context.each(_as_joint_state_publisher, context.tree.nodes)):
        for name in (f"{node.name}/use_gui", os.path.join(node.namespace, "use_gui")):
            param = context.tree.params.get(name)
            if param is None:
                continue
            yield rule.claim(
                "parameter 'use_gui' of joint_state_publisher is removed since ROS Noetic; for the window run "
                "joint_state_publisher_gui of the package of that name",
                param.place,
                subject=Subject("parameter", param.name),
                effect="no-effect" if param.value is True else None,
                doubts=otherwise_in(context.environment, BEFORE_NOETIC),
                related=include_chain(param.origin),
            )


def _as_joint_state_publisher(node: LaunchNode) -> LaunchNode | None:
    there = node.package == node.executable == "joint_state_publisher"
    return node if there else None


@dataclass(frozen=True, slots=True)
class _OldLanguage:
    masters: tuple[Action, ...]
    in_order: tuple[Span, ...]
    commands: tuple[Value, ...]


@derived
def _old_language(launch_file: LaunchFile) -> _OldLanguage:
    root, text = launch_file.root, launch_file.document.text
    if root is None:
        return _OldLanguage((), (), ())
    commands = tuple(root.gather(_commands_of))
    options = (_IN_ORDER.search(text, *command.span) for command in commands if "xacro" in command.text)
    return _OldLanguage(
        tuple(root.gather(_masters)), tuple(Span(*found.span()) for found in options if found), commands
    )


def _masters(action: Action) -> tuple[Action, ...]:
    return (action,) if action.kind == "master" else ()


def _commands_of(action: Action) -> tuple[Value, ...]:
    command = action.value("command")
    return (command,) if action.kind != "master" and command is not None else ()


RULE = Rule(
    id="LCH027",
    name="deprecated",
    effect="style",
    kind="invalid",
    sometimes=("stops-launch", "stops-node", "misbehaves", "no-effect", "note", Reason.UNSEEN, Reason.MEANT_FOR_OTHER),
    what="Checks for what is deprecated or removed: files with `<launch deprecated=...>`, `<master>`, and nodes, "
    "programs, parameters and options of older releases of ROS.",
    why="A deprecated part disappears with an upgrade. A removed node does not start.",
    example='<node pkg="robot_state_publisher" type="state_publisher" name="state_publisher"/>',
    instead='<node pkg="robot_state_publisher" type="robot_state_publisher" name="state_publisher"/>',
    references=(
        ROSLAUNCH,
        XACRO,
    ),
    generations=(1,),
    check=_check,
)
