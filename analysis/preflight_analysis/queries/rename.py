"""Renaming arguments, nodes, parameters and topics, over all files, or the reason why not."""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterator

from preflight_analysis.catalogue.launches import catalogued_file
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation import names
from preflight_analysis.findings.finding import Edit
from preflight_analysis.launch.model import NODE_KINDS, Action
from preflight_analysis.launch.references import NOT_ARGUMENTS
from preflight_analysis.queries import shared_arguments
from preflight_analysis.queries.node_names import mentions_of, remap_names, tags_of
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.queries.rename_names import parameter_edits, parameter_rename, shown, topic_edits
from preflight_analysis.queries.rename_refused import RenameRefusedError as RenameRefusedError  # noqa: PLC0414 - what a rename raises
from preflight_analysis.queries.symbol_at import NamedSymbol, symbol_at

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
    symbol = symbol_at(context, offset)
    if symbol is None:
        return None
    if symbol.kind == "arg":
        (name,) = symbol.names
        _argument_places(context, symbol, name)
        return Renamed(name, symbol.span)
    if symbol.kind == "node":
        name = context.text(context.location(context.path, symbol.span))
        _node_places(context, symbol, name)
        return Renamed(name, symbol.span)
    if symbol.kind == "param":
        found = parameter_rename(context, symbol)
        return Renamed(found.leaf, found.span)
    if symbol.kind == "topic":
        topic_edits(context, symbol, None)
        return Renamed(context.text(context.location(context.path, symbol.span)), symbol.span)
    raise RenameRefusedError(
        f"This is {_WHAT[symbol.kind]}: only arguments, nodes, parameters and topics can be renamed here"
    )


def rename(context: QueryContext, offset: int, new: str) -> tuple[Edit, ...]:
    """The edits that give what is at `offset` the name `new`, of any number of files. Raises `RenameRefusedError`."""
    found = prepare(context, offset)
    symbol = symbol_at(context, offset)
    if found is None or symbol is None:
        raise RenameRefusedError("There is nothing to rename here")
    if new == found.name:
        return ()
    if symbol.kind == "topic":
        return _checked(context, topic_edits(context, symbol, new))
    if symbol.kind == "param":
        return _checked(context, parameter_edits(context, parameter_rename(context, symbol), new))
    if symbol.kind == "arg":
        places = _argument_places(context, symbol, found.name)
        _check_argument(context, symbol, found.name, new)
    else:
        places = _node_places(context, symbol, found.name)
        _check_node(context, symbol, new)
    for place in places:
        if context.text(place) != found.name or not _is_text(context, place):
            where = shown(context, place)
            raise RenameRefusedError(f"'{found.name}' cannot be replaced at {where}: the text there is not as expected")
    return tuple(Edit(place, new) for place in sorted(places, key=lambda place: (place.file, place.span)))


def _checked(context: QueryContext, edits: tuple[Edit, ...]) -> tuple[Edit, ...]:
    """The edits in order, none of them in what is not the user's or of a variable."""
    for edit in edits:
        if catalogued_file(edit.location.file) is not None or not _is_text(context, edit.location):
            raise RenameRefusedError(f"The name at {shown(context, edit.location)} cannot be changed")
    return tuple(sorted(edits, key=lambda edit: (edit.location.file, edit.location.span)))


def _is_text(context: QueryContext, place: Location) -> bool:
    """Whether it is what a name of ROS's stands for there, and not in Python a variable of that name."""
    document = context.document(place.file)
    if document is None or not is_python(place.file, document.text):
        return True
    return document.text[place.span.start - 1 : place.span.start] in ("'", '"', "/")


def _argument_places(context: QueryContext, symbol: NamedSymbol, name: str) -> frozenset[Location]:
    if not name.strip():
        raise RenameRefusedError("The argument has no name yet")
    if "$" in name or not symbol.files:
        reason = "a substitution is part of its name" if "$" in name else "the include is unresolved"
        raise RenameRefusedError(f"The argument '{name}' cannot be renamed: {reason}")
    index = context.current
    files = shared_arguments.sharing(index, symbol.files, name, by_tag=True)
    for path in files:
        if path not in index.files:
            raise RenameRefusedError(f"The argument '{name}' cannot be renamed: {context.shown(path)} cannot be read")
    for root in index.entries:
        if root.path in files and any(given == name for given, _ in root.args):
            shown = context.shown(root.path)
            raise RenameRefusedError(
                f"The argument '{name}' cannot be renamed: the project's settings give it to {shown}"
            )
    return frozenset(
        (
            *shared_arguments.declared_at(context, files, name),
            *shared_arguments.used_at(context, files, name),
            *shared_arguments.given_at(context, files, name),
        )
    )


def _check_argument(context: QueryContext, symbol: NamedSymbol, name: str, new: str) -> None:
    if not _ARGUMENT.match(new):
        raise RenameRefusedError(
            f"'{new}' is not a valid argument name: use a letter, then letters, digits and underscores"
        )
    if new in NOT_ARGUMENTS or keyword.iskeyword(new):
        raise RenameRefusedError(f"'{new}' is not a valid argument name: it has another meaning in $(eval ...)")
    index = context.current
    files = shared_arguments.sharing(index, symbol.files, name, by_tag=True)
    taken = (*shared_arguments.declared_at(context, files, new), *shared_arguments.used_at(context, files, new))
    same_tag = {tag for place in shared_arguments.given_at(context, files, name) for tag in _tags(context, place, name)}
    given = (p for p in shared_arguments.given_at(context, files, new) if same_tag.intersection(_tags(context, p, new)))
    for place in (*taken, *given):
        raise RenameRefusedError(f"Duplicate argument '{new}', declared at {shown(context, place)}")


def _tags(context: QueryContext, place: Location, name: str) -> Iterator[Location]:
    facts = context.facts(place.file)
    for mention in facts.named("arg-passed", name) if facts else ():
        if mention.span == place.span:
            yield context.location(place.file, mention.action)


def _node_places(context: QueryContext, symbol: NamedSymbol, name: str) -> frozenset[Location]:
    if "$" in name:
        raise RenameRefusedError(f"The node '{name}' cannot be renamed: a substitution is part of its name")
    if not name.strip():
        raise RenameRefusedError("The node has no name yet")
    trees = context.all_trees
    own = tuple(_tags_named(context, symbol))
    launch_file = context.launch_file(context.path)
    python = launch_file is not None and launch_file.is_python
    runs = [command for tree in context.trees for command in tree.commands if command.launch_file and python]
    if any(run.result is None or run.result.status != "done" for run in runs):
        raise RenameRefusedError("The Python launch file was not run: the place of the node's name is unknown")
    if not own:
        raise RenameRefusedError("This is the name of a test, not that of its node")
    places = {place for place in tags_of(context, own) if context.text(place) == name}
    wanted = frozenset(node.name for tree in trees for node in tree.nodes if node.location in own)
    for tree in trees:
        for node in tree.nodes:
            if node.name in wanted and node.location not in own:
                where = shown(context, node.location)
                raise RenameRefusedError(f"The tag at {where} also starts a node '{node.name}': the name is ambiguous")
            for full in wanted:
                if node.name != full and _is_below(node.name, full):
                    raise RenameRefusedError(f"'{full}' is also the namespace of '{node.name}': rename it by hand")
    mixed: dict[Location, set[Span | None]] = {}
    for mention in mentions_of(context, trees, wanted):
        mixed.setdefault(mention.value, set()).add(mention.span)
    for tree in trees:
        for value, full in remap_names(tree):
            if value in mixed and not any(_is_below(full, node) for node in wanted):
                mixed[value].add(None)  # for another node that the remap reaches it means something else
    for value, spans in mixed.items():
        span = spans.pop()
        if span is None or spans:
            where = shown(context, value)
            raise RenameRefusedError(
                f"The value at {where} contains the node's name by a substitution: rename it by hand"
            )
        places.add(context.location(value.file, span))
    return frozenset(places)


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


def _check_node(context: QueryContext, symbol: NamedSymbol, new: str) -> None:
    if not new or not names.is_legal(new) or "/" in new or "~" in new:
        raise RenameRefusedError(
            f"'{new}' is not a valid node name: use a letter, then letters, digits and underscores"
        )
    wanted = {names.parent(full) + new for full in symbol.names}
    for tree in context.all_trees:
        for node in tree.nodes:
            if node.name in wanted:
                raise RenameRefusedError(f"Duplicate node name '{node.name}', used at {shown(context, node.location)}")
