"""What one launch file mentions, by its syntax alone: small enough to be kept for every file of a workspace."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import field
from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.tags import scopes_of, tags_of
from preflight_analysis.generation import Generation, ros
from preflight_analysis.launch.model import Action, ActionAttribute, LaunchFile, Substitution, Value
from preflight_analysis.launch.references import COMPONENT, NAMES, Named, arg_references, first_word
from preflight_analysis.launch.schema import Kind as ValueKind
from preflight_analysis.launch.schema import Tag
from preflight_analysis.launch.substitutions_ros2 import nested
from preflight_analysis.workspace.observations import Observation

Kind = Literal[
    "arg-declaration",
    "arg-use",
    "arg-passed",
    "package",
    "executable",
    "component",
    "include",
    "node",
    "param",
    "remap-from",
    "remap-to",
    "env",
    "machine",
]
"""`package`: in `pkg=` or `$(find)`; `executable`: `pkg/type` or, in ROS 2, `pkg/exec`;
`component`: `pkg/plugin`; `include`: the text of `file=`, unresolved; `node`,
`param` and remaps: the name as written; `env`: in `$(env)`, `$(optenv)` or an `<env>` tag; `machine`: declared or
used."""

_OF_VALUE: Mapping[ValueKind, Kind] = {
    "package": "package",
    "executable": "executable",
    "component": "component",
    "node": "node",
    "launch-file": "include",
    "parameter": "param",
    "remap-from": "remap-from",
    "remap-to": "remap-to",
    "variable": "env",
    "machine": "machine",
}
_OF_SUBSTITUTION: Mapping[Named | None, Kind] = {"package": "package", "variable": "env"}


@dataclass(frozen=True, slots=True)
class Mention:
    """A name at a place. `action` is the start tag that it stands in: for `arg-passed` that of the include."""

    kind: Kind
    name: str
    span: Span
    action: Span


@dataclass(frozen=True, slots=True)
class ArgDeclaration:
    """An `<arg>` tag of the file, under whatever condition. `default`, `value` and `choices` as written."""

    name: str
    default: str | None
    value: str | None
    doc: str | None
    span: Span
    choices: tuple[str, ...] = ()

    @property
    def required(self) -> bool:
        """Whether it has to be given."""
        return self.default is None and self.value is None


@dataclass(frozen=True, slots=True)
class FileFacts:
    """What the index keeps of a launch file. `version` names the text that it was read from."""

    path: str
    version: str
    args: tuple[ArgDeclaration, ...]
    mentions: tuple[Mention, ...]
    has_nodes: bool
    passing_all: frozenset[Span] = frozenset()
    """The start tags of the includes that pass all arguments on, or that may: the attribute has a substitution."""
    observations: tuple[Observation, ...] = field(default=(), compare=False, repr=False)
    """What it was made from."""

    def named(self, kind: Kind, name: str) -> Iterator[Mention]:
        """The mentions of a name."""
        return (m for m in self.mentions if m.kind == kind and m.name == name)


def facts_of(launch_file: LaunchFile) -> FileFacts:
    """The facts of a file, whether well-formed or not."""
    root, named = launch_file.root, launch_file.named
    tags, scopes = tags_of(launch_file.generation), scopes_of(launch_file.generation)
    mentions = tuple(_mentions(root, None, tags, substitutions=named is None)) if root is not None else ()
    mentions += tuple(m for part in named or () for m in _of_substitution(part, Span(0, 0)))
    args = tuple(declaration(action) for action in _declarations(root, scopes)) if root is not None else ()
    has_nodes = any(m.kind == "executable" for m in mentions)
    passing_all = frozenset(_passing_all(root, ros(launch_file.generation))) if root is not None else frozenset[Span]()
    return FileFacts(launch_file.path, launch_file.document.version, args, mentions, has_nodes, passing_all)


def _passing_all(root: Action, generation: Generation) -> Iterator[Span]:
    for action in root.walk():
        # What is set around an include is set in the file too.
        if generation.shared_configurations and action.kind == "include":
            yield action.head_span
        value = action.value("pass_all_args") if action.kind == "include" else None
        if value is not None and may_be_true(value):
            yield action.head_span


def may_be_true(value: Value) -> bool:
    """Whether a flag is set, or could be: it has a substitution."""
    return not value.is_literal or value.text.strip().lower() in ("true", "1")


def _declarations(action: Action, scopes: frozenset[str]) -> Iterator[Action]:
    for child in action.children:
        if child.kind == "arg" and child.attribute("name") is not None:
            yield child
        elif child.kind in scopes:
            yield from _declarations(child, scopes)


def declaration(action: Action) -> ArgDeclaration:
    """What an `<arg>` tag that has a name declares."""
    texts = {a.name: a.value.text for a in action.attributes}
    span = next(a.value.span for a in action.attributes if a.name == "name")
    doc = texts.get("doc") or texts.get("description")
    choices = tuple(v.text for child in action.children if child.kind == "choice" and (v := child.value("value")))
    return ArgDeclaration(texts["name"], texts.get("default"), texts.get("value"), doc, span, choices)


def _of_substitution(part: Substitution, action: Span) -> Iterator[Mention]:
    named = NAMES.get(part.command)
    kind: Kind | None = "arg-use" if named == "argument" else _OF_SUBSTITUTION.get(named)
    if part.command == COMPONENT:
        kind = "component"
    if kind is not None:
        yield Mention(kind, *first_word(part), action)


def _mentions(
    action: Action, parent: Action | None, tags: Mapping[str, Tag], *, substitutions: bool
) -> Iterator[Mention]:
    for attribute in action.attributes:
        yield from _of_attribute(action, attribute, parent, tags)
        if not substitutions:
            continue
        if attribute.value.problem is None and "$" in attribute.value.text:
            for name, span in arg_references(attribute.value):
                yield Mention("arg-use", name, span, action.head_span)
            for part in nested(attribute.value.parts):
                kind = _OF_SUBSTITUTION.get(NAMES.get(part.command))
                if kind is not None:
                    yield Mention(kind, *first_word(part), action.head_span)
    if "$" in action.body.text:
        for name, span in arg_references(action.body):
            yield Mention("arg-use", name, span, action.head_span)
    for child in action.children:
        yield from _mentions(child, action, tags, substitutions=substitutions)


def _of_attribute(
    action: Action, attribute: ActionAttribute, parent: Action | None, tags: Mapping[str, Tag]
) -> Iterator[Mention]:
    tag = tags.get(action.kind)
    known = tag.attributes.get(attribute.name) if tag is not None else None
    if known is None or action.kind == "rosparam":  # whose `param` is what several parameters have in common
        return
    name, span = attribute.value.text, attribute.value.span
    if known.kind == "argument":
        passed = parent is not None and parent.kind == "include"
        where = parent.head_span if passed and parent is not None else action.head_span
        yield Mention("arg-passed" if passed else "arg-declaration", name, span, where)
    elif (kind := _OF_VALUE.get(known.kind)) is not None:
        if kind in ("executable", "component"):
            package = action.value("pkg")
            name = f"{package.text if package else ''}/{name}"
        yield Mention(kind, name, span, action.head_span)
