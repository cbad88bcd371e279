"""What one launch file mentions, by its syntax alone: small enough to be kept for every file of a workspace."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.tags import scopes_of
from preflight_analysis.generation import Generation, ros
from preflight_analysis.launch.model import Action, LaunchFile, Value
from preflight_analysis.model.entry import REFERRED, Kind, Mention
from preflight_analysis.model.names_of_launch_files import names_of_launch_file
from preflight_analysis.workspace.observations import Observation


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

    @property
    def stands_alone(self) -> bool:
        """Whether it can be launched as it is: each argument that it declares has a value, and it uses no other."""
        arguments = [m.entry for m in self.mentions if m.entry.kind == "argument"]
        declared = {each.text for each in arguments if each.role == "declares"}
        given = {each.name for each in self.args if not each.required}
        used = {each.text for each in arguments if each.role == "uses"}
        return declared.issuperset(used) and given.issuperset(each.name for each in self.args)

    def named(self, kind: Kind, name: str, role: str = "") -> Iterator[Mention]:
        """The mentions of a name."""
        return (m for m in self.mentions if m.entry[:3] == (kind, name, role))


def facts_of(launch_file: LaunchFile) -> FileFacts:
    """The facts of a file, whether well-formed or not."""
    root, scopes = launch_file.root, scopes_of(launch_file.generation)
    mentions = tuple(each for each in names_of_launch_file(launch_file) if each.entry.kind in REFERRED)
    args = tuple(declaration(action) for action in _declarations(root, scopes)) if root is not None else ()
    has_nodes = any(each.entry.kind == "program" for each in mentions)
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
