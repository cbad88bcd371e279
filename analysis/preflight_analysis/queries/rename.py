"""Renaming arguments and nodes, over all files, or the reason why not."""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterator
from dataclasses import dataclass

from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation import names
from preflight_analysis.findings.finding import Edit
from preflight_analysis.launch.model import NODE_KINDS, Action
from preflight_analysis.launch.read import PYTHON_SUFFIX
from preflight_analysis.launch.references import NOT_ARGUMENTS
from preflight_analysis.queries import shared_arguments
from preflight_analysis.queries.node_names import mentions_of, remap_ends, tags_of
from preflight_analysis.queries.scene import Scene
from preflight_analysis.queries.subject import Subject, subject_at

_ARGUMENT = re.compile(r"[A-Za-z]\w*\Z", re.ASCII)
_WHAT = {
    "file": "a launch file",
    "package": "a package",
    "executable": "an executable",
    "component": "a component, whose name its source has too",
    "param": "a parameter, whose name the node's source has too",
    "topic": "a topic, whose name the nodes' sources have too",
    "env": "an environment variable",
    "machine": "a machine",
}


class RenameRefusedError(Exception):
    """Why it cannot be renamed, in words for the user."""


@dataclass(frozen=True, slots=True)
class Renamed:
    """What would be renamed: the name as it is, and its place at the cursor."""

    name: str
    span: Span


def prepare(scene: Scene, offset: int) -> Renamed | None:
    """What a rename at `offset` would change; None where there is no name. Raises `RenameRefusedError`."""
    subject = subject_at(scene, offset)
    if subject is None:
        return None
    if subject.kind == "arg":
        (name,) = subject.names
        _argument_places(scene, subject, name)
        return Renamed(name, subject.span)
    if subject.kind == "node":
        name = scene.text(scene.location(scene.path, subject.span))
        _node_places(scene, subject, name)
        return Renamed(name, subject.span)
    raise RenameRefusedError(f"This is {_WHAT[subject.kind]}: only arguments and nodes can be renamed here")


def rename(scene: Scene, offset: int, new: str) -> tuple[Edit, ...]:
    """The edits that give what is at `offset` the name `new`, of any number of files. Raises `RenameRefusedError`."""
    found = prepare(scene, offset)
    subject = subject_at(scene, offset)
    if found is None or subject is None:
        raise RenameRefusedError("There is nothing to rename here")
    if new == found.name:
        return ()
    if subject.kind == "arg":
        places = _argument_places(scene, subject, found.name)
        _check_argument(scene, subject, found.name, new)
    else:
        places = _node_places(scene, subject, found.name)
        _check_node(scene, subject, new)
    for place in places:
        if scene.text(place) != found.name or not _is_text(scene, place):
            where = _shown(scene, place)
            raise RenameRefusedError(f"'{found.name}' cannot be replaced at {where}: the text there is not as expected")
    return tuple(Edit(place, new) for place in sorted(places, key=lambda place: (place.file, place.span)))


def _is_text(scene: Scene, place: Location) -> bool:
    """Whether it is what a name of ROS's stands for there, and not in Python a variable of that name."""
    document = scene.document(place.file) if place.file.endswith(PYTHON_SUFFIX) else None
    return document is None or document.text[place.span.start - 1 : place.span.start] in ("'", '"', "/")


def _argument_places(scene: Scene, subject: Subject, name: str) -> frozenset[Location]:
    if not name.strip():
        raise RenameRefusedError("The argument has no name yet")
    if "$" in name or not subject.files:
        reason = "a substitution is part of its name" if "$" in name else "the included file is not known"
        raise RenameRefusedError(f"The argument '{name}' cannot be renamed: {reason}")
    index = scene.current
    files = shared_arguments.sharing(index, subject.files, name, by_tag=True)
    for path in files:
        if path not in index.files:
            raise RenameRefusedError(f"The argument '{name}' cannot be renamed: {scene.shown(path)} cannot be read")
    for root in index.entries:
        if root.path in files and any(given == name for given, _ in root.args):
            shown = scene.shown(root.path)
            raise RenameRefusedError(
                f"The argument '{name}' cannot be renamed: the project's settings give it to {shown}"
            )
    return frozenset(
        (
            *shared_arguments.declared_at(scene, files, name),
            *shared_arguments.used_at(scene, files, name),
            *shared_arguments.given_at(scene, files, name),
        )
    )


def _check_argument(scene: Scene, subject: Subject, name: str, new: str) -> None:
    if not _ARGUMENT.match(new):
        raise RenameRefusedError(f"'{new}' is no name for an argument: a letter, then letters, digits and underscores")
    if new in NOT_ARGUMENTS or keyword.iskeyword(new):
        raise RenameRefusedError(f"'{new}' is no name for an argument: it means something else in $(eval ...)")
    index = scene.current
    files = shared_arguments.sharing(index, subject.files, name, by_tag=True)
    taken = (*shared_arguments.declared_at(scene, files, new), *shared_arguments.used_at(scene, files, new))
    same_tag = {tag for place in shared_arguments.given_at(scene, files, name) for tag in _tags(scene, place, name)}
    given = (p for p in shared_arguments.given_at(scene, files, new) if same_tag.intersection(_tags(scene, p, new)))
    for place in (*taken, *given):
        raise RenameRefusedError(f"There is an argument '{new}' already, at {_shown(scene, place)}")


def _tags(scene: Scene, place: Location, name: str) -> Iterator[Location]:
    facts = scene.facts(place.file)
    for mention in facts.named("arg-passed", name) if facts else ():
        if mention.span == place.span:
            yield scene.location(place.file, mention.action)


def _node_places(scene: Scene, subject: Subject, name: str) -> frozenset[Location]:
    if "$" in name:
        raise RenameRefusedError(f"The node '{name}' cannot be renamed: a substitution is part of its name")
    if not name.strip():
        raise RenameRefusedError("The node has no name yet")
    trees = scene.all_trees
    own = tuple(_tags_named(scene, subject))
    runs = [c for tree in scene.trees for c in tree.commands if c.launch_file and scene.path.endswith(PYTHON_SUFFIX)]
    if any(run.result is None or run.result.status != "done" for run in runs):
        raise RenameRefusedError("Where a Python launch file names its nodes is not known as long as it is not run")
    if not own:
        raise RenameRefusedError("This is the name of a test, not that of its node")
    places = {place for place in tags_of(scene, own) if scene.text(place) == name}
    wanted = frozenset(node.name for tree in trees for node in tree.nodes if node.location in own)
    for tree in trees:
        for node in tree.nodes:
            if node.name in wanted and node.location not in own:
                where = _shown(scene, node.location)
                raise RenameRefusedError(
                    f"The tag at {where} makes a node '{node.name}' too: which one is meant is not sure"
                )
            for full in wanted:
                if node.name != full and _is_below(node.name, full):
                    raise RenameRefusedError(f"'{full}' is also the namespace of '{node.name}': rename it by hand")
    mixed: dict[Location, set[Span | None]] = {}
    for mention in mentions_of(scene, trees, wanted):
        mixed.setdefault(mention.value, set()).add(mention.span)
    for tree in trees:
        for value, full in remap_ends(tree):
            if value in mixed and not any(_is_below(full, node) for node in wanted):
                mixed[value].add(None)  # for another node that the remap reaches it means something else
    for value, spans in mixed.items():
        span = spans.pop()
        if span is None or spans:
            where = _shown(scene, value)
            raise RenameRefusedError(
                f"The node's name is part of what is set at {where}, but not written there: rename it by hand"
            )
        places.add(scene.location(value.file, span))
    return frozenset(places)


def _is_below(full: str, node: str) -> bool:
    return full == node or full.startswith(f"{node}/")


def _tags_named(scene: Scene, subject: Subject) -> Iterator[Location]:
    """The tag at the cursor, and those of its alternatives: of that name in the same place, under another condition."""
    launch_file = scene.launch_file(scene.path)
    if launch_file is None or launch_file.root is None:
        return
    evaluated = {node.location for tree in scene.trees for node in tree.nodes}
    for parent in launch_file.root.walk():
        nodes = [child for child in parent.children if child.kind in NODE_KINDS]
        own = next((child for child in nodes if _names(child, subject.span)), None)
        if own is None:
            continue
        for child in nodes:
            place = scene.location(scene.path, child.head_span)
            same = (_text(child, "name"), _text(child, "ns")) == (_text(own, "name"), _text(own, "ns"))
            if child is own or (same and place not in evaluated):
                yield place


def _names(action: Action, span: Span) -> bool:
    value = action.value("name") or action.value("test-name")
    return value is not None and value.span == span


def _text(action: Action, attribute: str) -> str | None:
    value = action.value(attribute)
    return value.text if value else None


def _check_node(scene: Scene, subject: Subject, new: str) -> None:
    if not new or not names.is_legal(new) or "/" in new or "~" in new:
        raise RenameRefusedError(f"'{new}' is no name for a node: a letter, then letters, digits and underscores")
    wanted = {names.parent(full) + new for full in subject.names}
    for tree in scene.all_trees:
        for node in tree.nodes:
            if node.name in wanted:
                raise RenameRefusedError(f"There is a node '{node.name}' already, at {_shown(scene, node.location)}")


def _shown(scene: Scene, place: Location) -> str:
    document = scene.document(place.file)
    line = document.lines.position(place.span.start)[0] + 1 if document else 1
    return f"{scene.shown(place.file)}:{line}"
