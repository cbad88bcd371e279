"""What includes came to, remembered, so that an edit evaluates the edited file again and what it changed of others.

What an included file adds to a launch depends on what is passed to it (arguments, namespace, remaps, environment), on
the files read below it, and on nothing else, but for a few tags (`State.depends_on_outside`); such includes are not
remembered. Places in the files above are part of the result too, the include chain in each origin; they are the same
where only text above the tag has changed.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass

from preflight_analysis.documents.span import Line, Location
from preflight_analysis.evaluation.problems import Problem
from preflight_analysis.evaluation.ros1.scope import Scope
from preflight_analysis.evaluation.tree import (
    Command,
    Include,
    LaunchNode,
    NotTaken,
    Param,
    Unknown,
    Use,
)
from preflight_analysis.launch.check_language import check_language
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.problems import LanguageProblem, ProblemKind

MAX_RECORDS = 4_000
MAX_SCOPES = 1_000
"""In which nodes are remembered, the latest that were evaluated."""


@dataclass(frozen=True, slots=True)
class Record:
    """What an include adds. `inputs` has the included file and all that it read, `declared` its `<arg>` tags."""

    inputs: Mapping[str, str]
    visited: tuple[str, ...]
    nodes: tuple[LaunchNode, ...]
    node_names: Mapping[str, Location | None]
    params: Mapping[str, Param]
    clear_params: tuple[str, ...]
    includes: tuple[Include, ...]
    commands: tuple[Command, ...]
    uses: tuple[Use, ...]
    problems: tuple[Problem[ProblemKind], ...]
    unknowns: tuple[Unknown, ...]
    not_taken: tuple[NotTaken, ...]
    declared: Mapping[str, Location]
    default_machine: str | None


TagKey = tuple[str, int, tuple[Line, ...]]
"""What a tag says and where: its text, its column, and its lines."""


@dataclass(frozen=True, slots=True)
class TagRecords:
    """What the tags of nodes in one scope added the last time that it was evaluated, and this time."""

    before: Mapping[TagKey, Record]
    now: dict[TagKey, Record]


class Memo:
    """Records by what they depend on. One for each environment and set of executables; used by one thread at a time."""

    def __init__(self) -> None:
        self._records: OrderedDict[Hashable, Record] = OrderedDict()
        self._tags: OrderedDict[Hashable, dict[TagKey, Record]] = OrderedDict()
        self._language: dict[str, tuple[LaunchFile, tuple[LanguageProblem, ...]]] = {}

    def get(self, key: Hashable, is_current: Callable[[Record], bool]) -> Record | None:
        """The record of an include."""
        record = self._records.get(key)
        if record is None or not is_current(record):
            return None
        self._records.move_to_end(key)
        return record

    def put(self, key: Hashable, record: Record) -> None:
        """Remember a record; the one that was longest out of use is forgotten for it."""
        self._records[key] = record
        self._records.move_to_end(key)
        if len(self._records) > MAX_RECORDS:
            self._records.popitem(last=False)

    def tags(self, key: Hashable) -> TagRecords:
        """The records of the nodes in a scope that is evaluated again."""
        records = TagRecords(self._tags.pop(key, {}), {})
        self._tags[key] = records.now
        if len(self._tags) > MAX_SCOPES:
            self._tags.popitem(last=False)
        return records

    def language(self, launch_file: LaunchFile) -> tuple[LanguageProblem, ...]:
        """As `check_language`."""
        known = self._language.get(launch_file.path)
        if known is None or known[0] is not launch_file:
            known = self._language[launch_file.path] = (launch_file, tuple(check_language(launch_file)))
        return known[1]


def tags_key_of(scope: Scope, default_machine: str | None) -> Hashable | None:
    """As `key_of`, for the tags of nodes of this scope."""
    key = key_of(scope, default_machine)
    return None if key is None else (key, tuple(scope.declared.items()), tuple(scope.anonymous.items()))


def key_of(inside: Scope, default_machine: str | None) -> Hashable | None:
    """What the evaluation of the file of this scope depends on; None if it cannot be remembered: private parameters are
    shared with the includer as long as there are any."""
    if inside.private_params:
        return None
    return (
        inside.file,
        inside.ns,
        inside.depth,
        inside.pass_all_args,
        default_machine,
        inside.chain,
        tuple((name, value.text, value.origin) for name, value in inside.args.items()),
        tuple(inside.env),
        tuple(inside.remaps()),
    )
