"""The arguments that a launch file declares, and the edits that declare and pass them."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping

from preflight_analysis.documents.span import Location, Origin
from preflight_analysis.edits.writer import writer_of
from preflight_analysis.evaluation.tree import Use
from preflight_analysis.findings.finding import Fix
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Action, LaunchFile, action_at
from preflight_analysis.model.context import Context
from preflight_analysis.model.name_index import in_workspace
from preflight_analysis.model.problems import fix, rename

_FAR = 40
"""Characters between the name of a parameter and its value."""
_ENDS = frozenset(",<>{}")


@derived
def declarations(launch_file: LaunchFile) -> Mapping[str, tuple[Action, ...]]:
    """The `<arg>` tags of each name, those in groups too; tags in includes pass arguments and declare none."""
    found: dict[str, list[Action]] = {}
    for action in _declarations(launch_file.root) if launch_file.root is not None else ():
        name = action.value("name")
        if name is not None and name.is_literal and name.text:
            found.setdefault(name.text, []).append(action)
    return {name: tuple(actions) for name, actions in found.items()}


def _declarations(action: Action) -> Iterator[Action]:
    for child in action.children:
        if child.kind == "arg":
            yield child
        elif child.kind == "group":
            yield from _declarations(child)


def passes_all(context: Context, includes: Origin) -> bool:
    """Whether what is given on the command line reaches the file that these includes lead to: in ROS 1 each has to have
    `pass_all_args`."""
    found = (_include_at(context, place) for place in includes)
    flags = (action.value("pass_all_args") if action is not None else None for action in found)
    return not context.tree.ros.shared_configurations and all(
        flag is not None and flag.text.strip().lower() in ("true", "1") for flag in flags
    )


def _include_at(context: Context, place: Location) -> Action | None:
    launch_file = context.launch_files.get(place.file)
    action = action_at(launch_file, place.span.start + 1) if launch_file is not None else None
    return action if action is not None and action.kind.lower() == "include" else None


def remove_at(context: Context, location: Location, title: str) -> tuple[Fix, ...]:
    """A fix that removes the action at `location`."""
    launch_file = context.launch_files.get(location.file)
    action = action_at(launch_file, location.span.start) if launch_file is not None else None
    if launch_file is None or action is None:
        return ()
    return fix(title, writer_of(launch_file.document).remove(action))


def declare(context: Context, origin: Origin, name: str) -> tuple[Fix, ...]:
    """A fix that declares an argument at the beginning of the launch file at the end of `origin`. None where an include
    leads there that does not pass it: it would have to. Nor in ROS 2 where any launch file of the workspace includes
    it: there the argument may be known from a scope around the include."""
    launch_file = context.launch_files.get(origin[-1].file)
    if launch_file is None or launch_file.root is None or (len(origin) > 1 and not _is_given(context, origin, name)):
        return ()
    if context.tree.ros.shared_configurations and _is_included(context, launch_file.path):
        return ()
    edits = writer_of(launch_file.document).declare_argument(launch_file.root, name)
    return fix(f"Declare argument '{name}'", edits)


def _is_included(context: Context, path: str) -> bool:
    name = os.path.basename(path)
    return any(each.text == name for each in in_workspace(context, "file"))


def _is_given(context: Context, origin: Origin, name: str) -> bool:
    """Whether the file that the includes of `origin` lead to is given an argument."""
    include = _include_at(context, origin[-2])
    given = (child.value("name") for child in include.children if child.kind == "arg") if include is not None else ()
    return passes_all(context, origin[:-1]) or any(value is not None and value.text == name for value in given)


def rename_passed(context: Context, include: Location, old: str, new: str) -> tuple[Fix, ...]:
    """A fix that passes an argument of the include at `include` under another name."""
    action = _include_at(context, include)
    names = (child.value("name") for child in action.children if child.kind == "arg") if action is not None else ()
    place = next((value.span for value in names if value is not None and value.text == old), None)
    return rename(context, context.location(include.file, place), old, new) if place is not None else ()


def pass_on(context: Context, include: Location, name: str) -> tuple[Fix, ...]:
    """A fix that passes the includer's own argument of that name in the include at `include`, if it has one."""
    launch_file, action = context.launch_files.get(include.file), _include_at(context, include)
    if launch_file is None or action is None:
        return ()
    if name not in declarations(launch_file):
        return ()  # its value is for the user to know
    command = "var" if context.tree.ros.shared_configurations else "arg"
    edits = writer_of(launch_file.document).pass_argument(action, name, f"$({command} {name})")
    return fix(f"Pass argument '{name}' on", edits, preferred=True)


def empty_arguments(context: Context, place: Location) -> list[str]:
    """The arguments that are empty and that the value at a place is made of: their users give them."""
    written = context.text(place)
    empty = (name for name, arg in context.tree.args.items() if arg.value == "")
    return [name for name in empty if re.search(rf"\$\((?:arg|var) {re.escape(name)}[ )]", written)]


def gives(context: Context, use: Use, place: Location) -> bool:
    """Whether a use of an argument is the value of the parameter whose name is at the place."""
    if use.kind != "arg" or not use.origin or use.location.file != place.file or use.value is None:
        return False
    near = place.span.start <= use.location.span.start < place.span.end + _FAR
    if not near or (document := context.documents.get(place.file)) is None:
        return False
    # Behind a comma or the end of a tag is something else.
    return not _ENDS.intersection(document.text[place.span.end : use.location.span.start])
