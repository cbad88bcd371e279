"""What includes come to, by which an edit evaluates the edited file again and what it changed of others.

What an included file adds to a launch depends on what is passed to it (namespace, remaps, environment, and of the
arguments those that it asks for), on the files read below it, and on nothing else, but for a few tags
(`State.depends_on_outside`); such includes are not remembered. Places in the files above are part of the result too,
the include chain in each origin; they are the same where only text above the tag has changed.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import replace
from typing import NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import LineIndex, Location, Origin
from preflight_analysis.evaluation.collector import Collected
from preflight_analysis.evaluation.files import Files
from preflight_analysis.evaluation.ros1.scope import Scope
from preflight_analysis.evaluation.ros1.scope_arguments import Arguments
from preflight_analysis.evaluation.tree import (
    Param,
    Remap,
)
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.launch.check_language import check_language
from preflight_analysis.launch.problems import LanguageProblem


@dataclass(frozen=True, slots=True, eq=False)
class Record:
    """What an include, or the tag of a node, adds. `declared` has the `<arg>` tags of the included file."""

    collected: Collected
    node_names: Mapping[str, Location | None]
    params: Mapping[str, Param]
    clear_params: tuple[str, ...]
    declared: Mapping[str, Location]
    default_machine: str | None

    def taking_over(self, before: Record) -> Record:
        """The same with what is equal of what it was before: much of it for other arguments."""
        known, params = before.params, self.params
        if params.keys() == known.keys():
            params = {name: known[name] if known[name] == each else each for name, each in params.items()}
        return replace(self, collected=self.collected.taking_over(before.collected), params=params)


class Passed(NamedTuple):
    """All that the evaluation of an included file depends on beside its `Surroundings` and the arguments that it asks
    for."""

    file: str
    ns: str
    depth: int
    pass_all_args: bool
    default_machine: str | None
    chain: Origin
    env: tuple[tuple[str, str], ...]
    remaps: tuple[Remap, ...]

    def scope(self, lines: LineIndex, arguments: Arguments) -> Scope:
        """The scope in which the file is evaluated; `lines` are its own."""
        outside = Scope(self.file, lines, self.chain, self.ns, own_remaps=list(self.remaps))
        return Scope(
            self.file,
            lines,
            self.chain,
            self.ns,
            outside,
            env=list(self.env),
            arguments=arguments,
            pass_all_args=self.pass_all_args,
            depth=self.depth,
        )


def passed_to(inside: Scope, default_machine: str | None) -> Passed | None:
    """What is passed to the file of this scope; None where the file shares something with its includer: private
    parameters, as long as there are any."""
    if inside.private_params:
        return None
    return Passed(
        inside.file,
        inside.ns,
        inside.depth,
        inside.pass_all_args,
        default_machine,
        inside.chain,
        tuple(inside.env),
        tuple(inside.remaps()),
    )


def tags_key_of(scope: Scope, default_machine: str | None) -> Hashable | None:
    """All of a scope that the tags of nodes in it depend on, but for arguments; as for `passed_to`."""
    passed = passed_to(scope, default_machine)
    return None if passed is None else (passed, tuple(scope.anonymous.items()))


@query
def language_problems(db: Database, files: Files, path: str) -> tuple[LanguageProblem, ...]:
    """As `check_language` of a launch file of ROS 1; nothing where there is none."""
    found = files.launch_file(path, 1)
    return () if isinstance(found, Unreadable) else tuple(check_language(found))
