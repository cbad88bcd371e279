"""Renaming arguments, nodes, parameters and topics, over all files, or the reason why not."""

from __future__ import annotations

import builtins
import keyword
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import partial

from preflight_analysis.catalogue.launches import catalogued_file
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.edits.gate import passes
from preflight_analysis.edits.python import PythonWriter
from preflight_analysis.edits.writer import writer_of
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.generation import ros
from preflight_analysis.launch.model import NODE_KINDS, Action, Substitution, Value
from preflight_analysis.launch.references import NAMES, NOT_ARGUMENTS, first_word
from preflight_analysis.queries.node_names import mentions_of, remap_names, tags_of
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.queries.rename_edit import RenameEdit
from preflight_analysis.queries.rename_edit import RenameRefusedError as RenameRefusedError  # noqa: PLC0414 - what a rename raises
from preflight_analysis.queries.rename_names import parameter_edits, parameter_rename, shown, topic_edits
from preflight_analysis.queries.shared_arguments import (
    SharedArgument,
    declared_at,
    given_at,
    shared_argument,
    used_at,
)
from preflight_analysis.queries.symbol_at import NamedSymbol, symbol_at
from preflight_analysis.workspace.index import Inclusion

_ARGUMENT = re.compile(r"[A-Za-z]\w*\Z", re.ASCII)
_WHAT = {
    "file": "a launch file",
    "package": "a package",
    "executable": "an executable",
    "component": "a component; its name is also in its source",
    "env": "an environment variable",
    "machine": "a machine",
}


@dataclass(frozen=True, slots=True)
class Renamed:
    """What would be renamed: the name as it is, and its place at the cursor."""

    name: str
    span: Span


def prepare(context: QueryContext, offset: int) -> Renamed | None:
    """What a rename at `offset` would change; None where there is no name. Raises `RenameRefusedError`."""
    found = _plan(context, offset)
    return found[0] if found is not None else None


def rename(context: QueryContext, offset: int, new: str) -> tuple[RenameEdit, ...]:
    """The edits that give what is at `offset` the name `new`, of any number of files. Raises `RenameRefusedError`."""
    found = _plan(context, offset)
    if found is None:
        raise RenameRefusedError("There is nothing to rename here")
    renamed, edits_to = found
    if new == renamed.name:
        return ()
    edits = {edit.location: edit for edit in edits_to(new)}
    for place in edits:
        if catalogued_file(place.file) is not None or not _is_text(context, place):
            raise RenameRefusedError(f"The name at {shown(context, place)} cannot be changed")
    written = [_written(context, edits[place]) for place in sorted(edits, key=lambda place: (place.file, place.span))]

    def text_of(path: str) -> str | None:
        document = context.document(path)
        return document.text if document is not None else None

    if not passes(f"rename '{renamed.name}' to '{new}'", written, text_of):
        raise RenameRefusedError(f"'{new}' cannot be written everywhere that '{renamed.name}' is")
    return tuple(written)


def _written(context: QueryContext, edit: RenameEdit) -> RenameEdit:
    """The edit as the format of its file has it."""
    document = context.document(edit.location.file)
    writer, span = writer_of(document) if document is not None else None, edit.location.span
    if isinstance(writer, PythonWriter):
        edits = writer.replace(span, edit.text, everywhere=True)
    else:
        edits = writer.replace(span, edit.text) if writer is not None else ()
    if len(edits) != 1:
        raise RenameRefusedError(f"The name at {shown(context, edit.location)} cannot be changed")
    return replace(edit, location=edits[0].location, text=edits[0].text)


def _plan(context: QueryContext, offset: int) -> tuple[Renamed, Callable[[str], Iterable[RenameEdit]]] | None:
    """What is renamed, and the edits to a new name."""
    symbol = symbol_at(context, offset)
    if symbol is None:
        return None
    at = context.location(context.path, symbol.span)
    match symbol.kind:
        case "arg":
            shared = _shared_argument(context, symbol, *symbol.names)
            return Renamed(shared.name, symbol.span), partial(_argument_edits, context, shared)
        case "node":
            node = _NodeRename(context, symbol, context.text(at))
            return Renamed(node.name, symbol.span), partial(_node_edits, context, node)
        case "param":
            found = parameter_rename(context, symbol)
            return Renamed(found.leaf, found.span), partial(parameter_edits, context, found)
        case "topic":
            topic_edits(context, symbol, None)
            return Renamed(context.text(at), symbol.span), partial(topic_edits, context, symbol)
        case kind:
            raise RenameRefusedError(
                f"This is {_WHAT[kind]}: only arguments, nodes, parameters and topics can be renamed here"
            )


def _as_written(context: QueryContext, name: str, edits: Iterable[RenameEdit]) -> Iterator[RenameEdit]:
    """The edits, each of a place where the name stands as it is."""
    for edit in edits:
        if context.text(edit.location) != name or not _is_text(context, edit.location):
            where = shown(context, edit.location)
            raise RenameRefusedError(f"'{name}' cannot be replaced at {where}: the text there is not as expected")
        yield edit


def _node_edits(context: QueryContext, node: _NodeRename, new: str) -> Iterator[RenameEdit]:
    node.check(new)
    yield from _as_written(context, node.name, node.edits(new))


def _is_text(context: QueryContext, place: Location) -> bool:
    """Whether it is what a name of ROS's stands for there, and not in Python a variable of that name."""
    document = context.document(place.file)
    if document is None or not is_python(place.file, document.text):
        return True
    return document.text[place.span.start - 1 : place.span.start] in ("'", '"', "/")


def _shared_argument(context: QueryContext, symbol: NamedSymbol, name: str) -> SharedArgument:
    """The argument at the cursor, where it can be renamed. Raises `RenameRefusedError`."""
    if not name.strip():
        raise RenameRefusedError("The argument has no name yet")
    if "$" in name or not symbol.files:
        reason = "a substitution is part of its name" if "$" in name else "the include is unresolved"
        raise RenameRefusedError(f"The argument '{name}' cannot be renamed: {reason}")
    index = context.current
    shared = shared_argument(context, symbol.files, name, by_tag=True)
    for path in shared.files:
        if path not in index.files:
            raise RenameRefusedError(f"The argument '{name}' cannot be renamed: {context.shown(path)} cannot be read")
        for inclusion in index.includers(path):
            if name in inclusion.args and shared.hands_on(inclusion) and _is_unscoped(context, inclusion.includer):
                where = shown(context, inclusion.tag)
                raise RenameRefusedError(f"'{name}' is passed to {context.shown(path)} by a name made up at {where}")
    if hasattr(builtins, name) and not any(
        (*declared_at(context, shared.files, name), *given_at(context, shared.files, name))
    ):
        raise RenameRefusedError(f"'{name}' is a function of Python here, not an argument")
    for root in index.entries:
        if root.path in shared.files and any(given == name for given, _ in root.args):
            raise RenameRefusedError(
                f"The argument '{name}' cannot be renamed: the project's settings give it to {context.shown(root.path)}"
            )
    return shared


def _is_unscoped(context: QueryContext, path: str) -> bool:
    """Whether what an include sets in a file stays set after it."""
    launch_file = context.launch_file(path)
    return launch_file is not None and ros(launch_file.generation).shared_configurations


def _argument_edits(context: QueryContext, shared: SharedArgument, new: str) -> Iterator[RenameEdit]:
    _check_argument(context, shared, new)
    yield from _as_written(context, shared.name, _places_of_argument(context, shared, new))


def _places_of_argument(context: QueryContext, shared: SharedArgument, new: str) -> Iterator[RenameEdit]:
    for path in shared.files:
        label = f"Argument '{shared.name}' of {context.shown(path)}"
        other = shared.shared_with.get(path)
        reason = f"Shared with {context.shown(other)}: no include between them passes it by name" if other else ""
        own = (*declared_at(context, (path,), shared.name), *used_at(context, (path,), shared.name, shared.trees))
        yield from (RenameEdit(place, new, label, reason, bool(other)) for place in own)
        for place in given_at(context, (path,), shared.name):
            yield RenameEdit(place, new, f"'{shared.name}' as passed to {context.shown(path)}", reason)


def _check_argument(context: QueryContext, shared: SharedArgument, new: str) -> None:
    if not _ARGUMENT.match(new):
        raise RenameRefusedError(
            f"'{new}' is not a valid argument name: use a letter, then letters, digits and underscores"
        )
    if new in NOT_ARGUMENTS or keyword.iskeyword(new):
        raise RenameRefusedError(f"'{new}' is not a valid argument name: it has another meaning in $(eval ...)")
    name, files = shared.name, shared.files
    taken = (*declared_at(context, files, new), *used_at(context, files, new, shared.trees))
    same_tag = {tag for place in given_at(context, files, name) for tag in _tags(context, place, name)}
    given = (p for p in given_at(context, files, new) if same_tag.intersection(_tags(context, p, new)))
    for place in (*taken, *given):
        raise RenameRefusedError(f"Duplicate argument '{new}', declared at {shown(context, place)}")
    mixed = tuple(_mixed_with(context, shared, new))
    for place in (*declared_at(context, mixed, new), *used_at(context, mixed, new, shared.trees)):
        raise RenameRefusedError(f"'{new}' is already an argument of the same launch, at {shown(context, place)}")


def _mixed_with(context: QueryContext, shared: SharedArgument, new: str) -> Iterator[str]:
    """The files whose argument `new` would get its value from the renamed one, or give it to that."""
    index = context.current
    other = SharedArgument(context, (), (), new)
    below = (i for path in shared.files for i in index.included_from(path) if other.hands_on(i))
    yield from (path for i in below for path in _mentioning(context, other, i.target, shared))
    seen, left = set[str](), [*shared.files]
    while left:
        path = left.pop()
        for inclusion in index.includers(path):
            above = inclusion.includer
            gives = path in shared.files and shared.gives(inclusion)
            unscoped = _is_unscoped(context, above)
            if not unscoped and (gives or not other.hands_on(inclusion)):
                continue
            same = gives and _gives_itself(context, inclusion, shared.name, new)
            if above not in shared.files and other.is_mentioned(above) and not same:
                yield above
            if above not in seen:
                seen.add(above)
                left.append(above)
                beside = (i for i in index.included_from(above) if unscoped and other.hands_on(i))
                beside = (i for i in beside if i.target not in shared.files and i.target != path)
                yield from (each for i in beside for each in _mentioning(context, other, i.target, shared))


def _mentioning(context: QueryContext, other: SharedArgument, path: str, shared: SharedArgument) -> Iterator[str]:
    """The files that mention an argument, of one and those that it hands everything on to."""
    seen, left = set[str](), [path]
    while left:
        at = left.pop()
        if at not in seen and at not in shared.files:
            seen.add(at)
            if other.is_mentioned(at):
                yield at
            left += (i.target for i in context.current.included_from(at) if other.hands_on(i))


def _gives_itself(context: QueryContext, inclusion: Inclusion, name: str, new: str) -> bool:
    """Whether an include passes, as `name`, no more than its own argument `new`."""
    launch_file = context.launch_file(inclusion.includer)
    for action in launch_file.root.walk() if launch_file is not None and launch_file.root is not None else ():
        if action.kind == "include" and action.head_span == inclusion.tag.span:
            given = [c for c in action.children if c.kind == "arg" and (n := c.value("name")) and n.text == name]
            values = [value for child in given if (value := child.value("value")) is not None]
            return bool(values) and all(_is_argument(value, new) for value in values)
    return False


def _is_argument(value: Value, name: str) -> bool:
    """Whether a value is that of an argument as it is."""
    match value.parts:
        case (Substitution(command=command) as part,) if NAMES.get(command) == "argument":
            return first_word(part)[0] == name
    return False


def _tags(context: QueryContext, place: Location, name: str) -> Iterator[Location]:
    facts = context.facts(place.file)
    for mention in facts.named("argument", name, "passes") if facts else ():
        if mention.span == place.span:
            yield context.location(place.file, mention.action)


class _NodeRename:
    """A node with the tags that start it, and the places that name it. `tags` has the section of a parameter file for
    each tag that is there for that alone: a file that several launches use has one name for all their nodes."""

    def __init__(self, context: QueryContext, symbol: NamedSymbol, name: str) -> None:
        self._context, self.name = context, name
        self.tags: dict[Location, Location | None] = dict.fromkeys(_tags_named(context, symbol))
        self.places: dict[Location, str] = {}
        """Where it is named outside of its tags, and the full name that stands for there."""
        self.trees: tuple[LaunchTree, ...] = ()
        self._refuse_unknown()
        while True:
            self.trees = context.trees_around({place.file for place in (*self.tags, *self.places)})
            before = len(self.tags), len(self.places), len(self.trees)
            self.places = self._mentions()
            self._tie()
            reached = context.trees_around({place.file for place in (*self.tags, *self.places)})
            if before == (len(self.tags), len(self.places), len(reached)):
                break

    def _refuse_unknown(self) -> None:
        if "$" in self.name:
            raise RenameRefusedError(f"The node '{self.name}' cannot be renamed: a substitution is part of its name")
        if not self.name.strip():
            raise RenameRefusedError("The node has no name yet")
        launch_file = self._context.launch_file(self._context.path)
        python = launch_file is not None and launch_file.is_python
        runs = [command for tree in self._context.trees for command in tree.commands if command.launch_file and python]
        if any(run.result is None or run.result.status != "done" for run in runs):
            raise RenameRefusedError("The Python launch file was not run: the place of the node's name is unknown")
        if not self.tags:
            raise RenameRefusedError("This is the name of a test, not that of its node")

    def _named(self) -> Iterator[tuple[LaunchTree, frozenset[str]]]:
        """The launches with the full names that it has there. In those that reach the file of the cursor a name of one
        is that of all."""
        names_in = [frozenset(node.name for node in tree.nodes if node.location in self.tags) for tree in self.trees]
        reaching = len(self._context.all_trees)
        common = frozenset[str]().union(*names_in[:reaching])
        for number, (tree, own) in enumerate(zip(self.trees, names_in, strict=True)):
            yield tree, common if number < reaching else own

    def _mentions(self) -> dict[Location, str]:
        found: dict[Location, str] = {}
        for tree, wanted in self._named():
            self._refuse_ambiguous(tree, wanted)
            mixed: dict[Location, set[Span | None]] = {}
            for mention in mentions_of(self._context, (tree,), wanted):
                mixed.setdefault(mention.value, set()).add(mention.span)
                if mention.span is not None:
                    found[self._context.location(mention.value.file, mention.span)] = mention.node
            for value, full in remap_names(tree):
                if value in mixed and not any(_is_below(full, node) for node in wanted):
                    mixed[value].add(None)  # for another node that the remap reaches it means something else
            for value, spans in mixed.items():
                if None in spans or len(spans) > 1:
                    where = shown(self._context, value)
                    raise RenameRefusedError(
                        f"The value at {where} contains the node's name by a substitution: rename it by hand"
                    )
        return found

    def _refuse_ambiguous(self, tree: LaunchTree, wanted: frozenset[str]) -> None:
        for node in tree.nodes:
            if node.name in wanted and node.location not in self.tags:
                where = shown(self._context, node.location)
                raise RenameRefusedError(f"The tag at {where} also starts a node '{node.name}': the name is ambiguous")
            for full in wanted:
                if node.name != full and _is_below(node.name, full):
                    raise RenameRefusedError(f"'{full}' is also the namespace of '{node.name}': rename it by hand")

    def _tie(self) -> None:
        """Add the tags of other nodes that get their parameters by the same name in the same file."""
        for tree in self.trees:
            others = {n.name: n for n in tree.nodes if names.leaf(n.name) == self.name and n.location not in self.tags}
            for mention in mentions_of(self._context, (tree,), frozenset(others)) if others else ():
                place = self._context.location(mention.value.file, mention.span or mention.value.span)
                if place not in self.places:
                    continue
                node, where = others[mention.node], shown(self._context, place)
                written = [self._context.text(at) for at in tags_of(self._context, (node.location,))]
                if place.file in self._context.current.files or written != [self.name]:
                    started = shown(self._context, node.location)
                    raise RenameRefusedError(
                        f"The name at {where} is also that of {node.name}, started at {started}: rename it by hand"
                    )
                self.tags[node.location] = place

    def edits(self, new: str) -> Iterator[RenameEdit]:
        """What gives it another name."""
        for tag, section in self.tags.items():
            reason = f"It reads the same section at {shown(self._context, section)}" if section is not None else ""
            label = f"Node '{self.name}' in {self._context.shown(tag.file)}"
            for place in tags_of(self._context, (tag,)):
                if self._context.text(place) == self.name:
                    yield RenameEdit(place, new, label, reason, section is not None)
        for place, full in self.places.items():
            yield RenameEdit(place, new, f"Name of {full} in {self._context.shown(place.file)}")

    def check(self, new: str) -> None:
        """Raise `RenameRefusedError` where the name is none, or another node has it."""
        if not new or not names.is_legal(new) or "/" in new or "~" in new:
            raise RenameRefusedError(
                f"'{new}' is not a valid node name: use a letter, then letters, digits and underscores"
            )
        for tree, own in self._named():
            wanted = {names.parent(full) + new for full in own}
            for node in tree.nodes:
                if node.name in wanted:
                    where = shown(self._context, node.location)
                    raise RenameRefusedError(f"Duplicate node name '{node.name}', used at {where}")


def _is_below(full: str, node: str) -> bool:
    return full == node or full.startswith(f"{node}/")


def _tags_named(context: QueryContext, symbol: NamedSymbol) -> Iterator[Location]:
    """The tag at the cursor, and those of its alternatives: of that name in the same place, under another condition."""
    launch_file = context.launch_file(context.path)
    if launch_file is None or launch_file.root is None:
        return
    evaluated = {node.location for tree in context.trees for node in tree.nodes}
    for parent in launch_file.root.walk():
        nodes = [child for child in parent.children if child.kind in NODE_KINDS]
        own = next((child for child in nodes if _names(child, symbol.span)), None)
        if own is None:
            continue
        for child in nodes:
            place = context.location(context.path, child.head_span)
            same = (_text(child, "name"), _text(child, "ns")) == (_text(own, "name"), _text(own, "ns"))
            if child is own or (same and place not in evaluated):
                yield place


def _names(action: Action, span: Span) -> bool:
    value = action.value("name") or action.value("test-name")
    return value is not None and value.span == span


def _text(action: Action, attribute: str) -> str | None:
    value = action.value(attribute)
    return value.text if value else None
