"""What includes came to, remembered, so that an edit evaluates the edited file again and what it changed of others.

What an included file adds to a launch depends on what is passed to it (arguments, namespace, remaps, environment), on
the files read below it, and on nothing else, but for a few tags (`State.depends_on_outside`); such includes are not
remembered. Places in the files above are part of the result too, the include chain in each origin: where only those
have moved, because text was inserted above the tag, they are replaced.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, replace

from preflight_analysis.documents.span import Location, Origin
from preflight_analysis.evaluation.ros1.scope import Scope
from preflight_analysis.evaluation.tree import (
    Command,
    Include,
    LaunchNode,
    NotTaken,
    Param,
    Problem,
    Remap,
    Unknown,
    Use,
)
from preflight_analysis.launch.check_language import LanguageProblem, check_language
from preflight_analysis.launch.model import LaunchFile

MAX_RECORDS = 4_000


@dataclass(frozen=True, slots=True)
class Record:
    """What an include adds. `chain` and `arg_origins` are the places in files above that its origins lead through;
    `inputs` has the included file and all that it read, `declared` its `<arg>` tags."""

    chain: Origin
    arg_origins: Mapping[str, Origin | None]
    inputs: Mapping[str, str]
    visited: tuple[str, ...]
    nodes: tuple[LaunchNode, ...]
    node_names: Mapping[str, Location | None]
    params: Mapping[str, Param]
    clear_params: tuple[str, ...]
    includes: tuple[Include, ...]
    commands: tuple[Command, ...]
    uses: tuple[Use, ...]
    problems: tuple[Problem, ...]
    unknowns: tuple[Unknown, ...]
    not_taken: tuple[NotTaken, ...]
    declared: Mapping[str, Location]
    default_machine: str | None


class Memo:
    """Records by what they depend on. One for each environment and set of executables; used by one thread at a time."""

    def __init__(self) -> None:
        self._records: OrderedDict[Hashable, Record] = OrderedDict()
        self._language: dict[str, tuple[LaunchFile, tuple[LanguageProblem, ...]]] = {}

    def get(self, key: Hashable, inside: Scope, is_current: Callable[[Record], bool]) -> Record | None:
        """The record of an include in this scope, its origins brought up to date."""
        record = self._records.get(key)
        if record is None or not is_current(record):
            return None
        self._records.move_to_end(key)
        origins = arg_origins(inside)
        if record.chain != inside.chain or record.arg_origins != origins:
            record = self._records[key] = _moved(record, inside.chain, origins)
        return record

    def put(self, key: Hashable, record: Record) -> None:
        """Remember a record; the one that was longest out of use is forgotten for it."""
        self._records[key] = record
        self._records.move_to_end(key)
        if len(self._records) > MAX_RECORDS:
            self._records.popitem(last=False)

    def language(self, launch_file: LaunchFile) -> tuple[LanguageProblem, ...]:
        """As `check_language`."""
        known = self._language.get(launch_file.path)
        if known is None or known[0] is not launch_file:
            known = self._language[launch_file.path] = (launch_file, tuple(check_language(launch_file)))
        return known[1]


def key_of(inside: Scope, default_machine: str | None) -> Hashable | None:
    """What the evaluation of the file of this scope depends on, places in files above left out; None if it cannot be
    remembered: private parameters are shared with the includer as long as there are any."""
    if inside.private_params:
        return None
    return (
        inside.file,
        inside.ns,
        inside.depth,
        inside.pass_all_args,
        default_machine,
        tuple(location.file for location in inside.chain),
        tuple((name, value.text) for name, value in inside.args.items()),
        tuple(inside.env),
        tuple(inside.remaps()),
    )


def arg_origins(inside: Scope) -> dict[str, Origin | None]:
    """Where each argument was given."""
    return {name: value.origin for name, value in inside.args.items()}


def _moved(record: Record, chain: Origin, origins: Mapping[str, Origin | None]) -> Record:
    """The record with the places in the files above as they are now."""
    length, old_chain = len(record.chain), record.chain
    given = {old: new for name, old in record.arg_origins.items() if old and (new := origins.get(name))}
    places = {old[-1]: new[-1] for old, new in given.items()}

    def move(origin: Origin) -> Origin:
        if origin[:length] == old_chain:
            return chain + origin[length:]
        return given.get(origin, origin)

    def param(old: Param) -> Param:
        overrides = tuple(map(param, old.overrides)) if old.overrides else ()
        return Param(old.name, old.value, move(old.origin), old.owner, old.name_location, overrides)

    def remap(old: Remap) -> Remap:
        return old._replace(origin=move(old.origin), replaces=tuple(map(remap, old.replaces)))

    def use(old: Use) -> Use:
        if not old.origin and old.target not in places:
            return old
        target = places.get(old.target, old.target) if old.target is not None else None
        return Use(old.kind, old.location, old.name, old.value, target, move(old.origin))

    return replace(
        record,
        chain=chain,
        arg_origins=origins,
        nodes=tuple(n._replace(origin=move(n.origin), remaps=tuple(map(remap, n.remaps))) for n in record.nodes),
        params={name: param(old) for name, old in record.params.items()},
        includes=tuple(replace(i, origin=move(i.origin)) for i in record.includes),
        commands=tuple(replace(c, origin=move(c.origin)) for c in record.commands),
        uses=tuple(map(use, record.uses)),
        problems=tuple(replace(p, origin=move(p.origin)) for p in record.problems),
        not_taken=tuple(n._replace(origin=move(n.origin)) for n in record.not_taken),
    )
