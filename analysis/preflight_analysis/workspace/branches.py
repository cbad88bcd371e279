"""What conditions leave out of a launch is looked at, too.

Each tag that is left out is taken once: the launch is evaluated again with the arguments that its condition asks for
(`evaluation/inversion.py`), with all that they imply, and what the rules say then and did not say before is said with
these arguments. All combinations are not tried. A tag whose condition cannot be read backwards is evaluated as if it
were taken, and what is found in it is less sure.
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import field, replace
from functools import cached_property
from itertools import chain

from preflight_analysis.catalogue.launches import catalogued_file
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.conditions import VARIABLE, named_arguments
from preflight_analysis.evaluation.inversion import Assignment, assignments
from preflight_analysis.evaluation.ros2.python_branches import BRANCH
from preflight_analysis.evaluation.tree import LaunchTree, NotTaken
from preflight_analysis.findings.doubt import Doubt, Reason
from preflight_analysis.findings.failure import Failure
from preflight_analysis.findings.finding import Finding, under
from preflight_analysis.findings.policy import doubted
from preflight_analysis.incremental.derived import derived
from preflight_analysis.incremental.query import Input
from preflight_analysis.launch.model import Action, LaunchFile
from preflight_analysis.model.syntax import CONDITIONS
from preflight_analysis.workspace.index import Root

MAX_WHAT_IFS = 24
"""Further evaluations of one launch."""
_MAX_ASSUMED = 3
_ASSUMED = Doubt(Reason.OTHER_ARGUMENTS)
"""Of these, how often the tags are taken that stand in tags which no arguments take."""
_TRUTH = {"true": True, "1": True, "false": False, "0": False}
_Key = tuple[tuple[str, str], ...]
_OF_ARGUMENTS = ("ARG001", "ARG002", "ARG004", "ARG006", "ARG007")
"""Rules that ask whether arguments are there, and not what they are."""
_OF_TWO = "ARG005"
"""A rule that speaks of two tags, which mostly exclude each other: what is assumed is taken beside all the others."""
_OF_VARIANTS = "PRM019"
"""Where it is unsure, an argument names the file that it compares with: one that a condition asks for together with its
own."""
_OF_VALUES = "ARG009"
"""A rule that speaks of a value: Python may have made it of the same as a condition that names no argument."""
_ARGUMENT = re.compile(r"\$\((?:arg|var|eval)\b")
_ONE_ARGUMENT = re.compile(r"\s*\$\((?:arg|var)\s[^()]*\)\s*")
_GRAVE = ("error", "warning")
_LONGEST = 60
"""Characters of a condition in a message."""


@dataclass(frozen=True, slots=True, eq=False)
class WhatIf:
    """A launch with other arguments: `found` is what the rules that speak of branches say, without what is missing on
    this machine."""

    tree: LaunchTree
    documents: Mapping[str, Document]
    launch_files: Mapping[str, LaunchFile]
    found: tuple[Finding, ...]


@dataclass(frozen=True, slots=True)
class Branches:
    """What is found in the tags and files that a launch leaves out, each finding with the text that it is about.
    `documents` are those of the files that it speaks of, `untried` is the number of tags that were not looked into, as
    there are so many. `asked` are the runs of Python launch files that it takes, made or not. `failures` are the rules
    that raised meanwhile."""

    findings: tuple[tuple[Finding, str], ...] = ()
    documents: Mapping[str, Document] = field(default_factory=dict, compare=False, repr=False)
    untried: int = 0
    asked: tuple[str, ...] = field(default=(), compare=False, repr=False)
    failures: tuple[Failure, ...] = ()

    def with_others(self, found: Iterable[Finding], disk: Disk) -> Branches:
        """With findings of other files that the launch leaves out."""
        documents = dict(self.documents)
        more: list[tuple[Finding, str]] = []
        for finding in found:
            document = disk.text(finding.location.file)
            if isinstance(document, Document):
                documents.setdefault(finding.location.file, document)
                more.append((finding, document.text[slice(*finding.location.span)]))
        return replace(self, findings=(*self.findings, *more), documents=documents)


def _none_yet(workspace: Hashable, root: Root) -> Branches:
    return Branches()


BRANCHES = Input(_none_yet, durable=False)
"""What was found last in the tags that a root leaves out."""
Ask = Callable[[Assignment, frozenset[Location]], WhatIf]
"""Evaluates the launch with these arguments, and with the tags at these places taken whatever their conditions say."""
AskParams = Callable[[Assignment, frozenset[Location]], Iterable[Finding]]
"""What rules say of the parameters of that launch, by what is known of its nodes without a run."""


def branches_of(
    tree: LaunchTree, launch_files: Mapping[str, LaunchFile], args: Assignment, ask: Ask, ask_params: AskParams
) -> Branches:
    """What is found where a launch is evaluated with other arguments than `args`, with which `tree` is made."""
    return _Search(tree, launch_files, args, ask, ask_params).branches()


class _Search:
    def __init__(
        self,
        tree: LaunchTree,
        launch_files: Mapping[str, LaunchFile],
        args: Assignment,
        ask: Ask,
        ask_params: AskParams,
    ) -> None:
        self._tree, self._given, self._ask, self._ask_params = tree, args, ask, ask_params
        self._launch_files = dict(launch_files)
        self._what_ifs: dict[_Key, WhatIf] = {}
        self._evaluations = 0
        self._findings: dict[tuple[str, Location], tuple[Finding, str]] = {}
        self._documents: dict[str, Document] = {}
        self._untried: set[Location] = set()
        self._asked: dict[str, None] = {}

    def branches(self) -> Branches:
        """All that is found."""
        self._choose()
        for key, left_out in self._by_arguments().items():
            for together in _compatible(left_out):
                self._assume(dict(key), together)
        return Branches(tuple(self._findings.values()), self._documents, len(self._untried), tuple(self._asked))

    def _choose(self) -> None:
        """Give each choice of an argument that has choices and no value: without one nothing is known of what depends
        on it."""
        for name, choices in _choices(self._launch_files.get(self._tree.file)):
            declared = self._tree.args.get(name)
            for choice in choices if declared is not None and declared.value is None else ():
                wanted = {**self._given, name: choice}
                what_if = self._with(wanted)
                if what_if is not None:
                    self._note(what_if.found, _shown(wanted, self._given), what_if.documents)

    def _by_arguments(self) -> dict[_Key, list[NotTaken]]:
        """Look at each branch that arguments take. Gives the others, by the arguments that lead there."""
        queue = deque((self._given, self._tree, left_out) for left_out in _open(self._tree))
        seen: set[Location] = set()
        refused: dict[_Key, list[NotTaken]] = {}
        while queue:
            args, within, left_out = queue.popleft()
            tag = left_out.origin[-1]
            if tag in seen or self._is_taken_somewhere(left_out):
                continue
            seen.add(tag)
            for wanted in assignments(within, self._launch_files, left_out, args):
                what_if = self._with(wanted)
                if what_if is None:
                    self._untried.add(tag)
                    break
                if takes(what_if.tree, left_out):
                    found = (
                        each
                        for each in (*what_if.found, *self._of_params(what_if.tree, wanted, frozenset()))
                        if not _is_given(each, what_if.documents)
                    )
                    others = {name for name, text in wanted.items() if self._given.get(name) != text}
                    found = (_unsure_of_others(each, left_out, others, what_if) for each in found)
                    self._note(found, _shown(wanted, self._given), what_if.documents)
                    queue.extend((wanted, what_if.tree, each) for each in _open(what_if.tree))
                    break
            else:
                refused.setdefault(_key(args), []).append(left_out)
        return refused

    def _is_taken_somewhere(self, left_out: NotTaken) -> bool:
        trees = (self._tree, *(what_if.tree for what_if in self._what_ifs.values()))
        return any(takes(tree, left_out) for tree in trees)

    def _with(self, args: Assignment) -> WhatIf | None:
        """The launch with these arguments; None where there were too many others before."""
        key = _key(args)
        found = self._what_ifs.get(key)
        if found is None and self._has_room():
            found = self._what_ifs[key] = self._evaluated(args, frozenset())
            self._launch_files = {**found.launch_files, **self._launch_files}
        return found

    def _evaluated(self, args: Assignment, assumed: frozenset[Location]) -> WhatIf:
        """The launch with these arguments and tags; what it asks to be run is noted."""
        found = self._ask(args, assumed)
        self._asked.update((each.line, None) for each in found.tree.commands if each.launch_file)
        return found

    def _of_params(self, tree: LaunchTree, args: Assignment, assumed: frozenset[Location]) -> Iterator[Finding]:
        """What is grave of parameters that the launch itself does not set: whoever else reads one of these may be left
        out, too, and of those that it sets more is known by runs."""
        if _places_of_params(tree) <= self._places:
            return
        for found in self._ask_params(args, assumed):
            if found.severity in _GRAVE and found.location not in self._places:
                yield found

    @cached_property
    def _places(self) -> frozenset[Location]:
        return _places_of_params(self._tree)

    def _has_room(self) -> bool:
        self._evaluations += 1
        return self._evaluations <= MAX_WHAT_IFS

    def _assume(self, args: Assignment, left_out: Iterable[NotTaken]) -> None:
        """Evaluate tags as if they were taken, then those that are left out in them."""
        todo = {each.origin[-1]: each for each in left_out}
        taken: dict[Location, NotTaken] = {}
        for _ in range(_MAX_ASSUMED):
            todo = {tag: each for tag, each in todo.items() if tag not in taken}
            if not todo:
                return
            if not self._has_room():
                self._untried |= todo.keys()
                return
            taken |= todo
            what_if = self._evaluated(args, frozenset(taken))
            all_found = (*what_if.found, *self._of_params(what_if.tree, args, frozenset(taken)))
            for each in todo.values():
                found = (found for found in all_found if _stands_in(found, each))
                unsure = (
                    doubted(found, _ASSUMED)
                    for found in found
                    if found.rule != _OF_TWO and not _depends(found, each, what_if.documents)
                )
                self._note(unsure, _in_words(each), what_if.documents)
            inside = (
                each for each in _open(what_if.tree) if any(_holds(outer, each.origin) for outer in todo.values())
            )
            todo, *others = ({each.origin[-1]: each for each in group} for group in _compatible(inside, taken.values()))
            self._untried.update(*others)

    def _note(self, found: Iterable[Finding], condition: str, documents: Mapping[str, Document]) -> None:
        for finding in found:
            key = (finding.rule, finding.location)
            if key not in self._findings:
                if finding.rule == _OF_VARIANTS and Doubt(Reason.DEPENDS) in finding.doubts:
                    finding = doubted(finding, _ASSUMED)  # noqa: PLW2901
                self._findings[key] = under(finding, condition), _text(finding, documents)
                places = (finding.location, *(related.location for related in finding.related))
                self._documents |= {each.file: documents[each.file] for each in places if each.file in documents}


def _places_of_params(tree: LaunchTree) -> frozenset[Location]:
    """Where the parameters of a launch and of its nodes are set."""
    of_nodes = chain.from_iterable(node.params for node in tree.nodes)
    return frozenset(param.place for param in chain(tree.all_params, of_nodes))


def _compatible(left_out: Iterable[NotTaken], taken: Iterable[NotTaken] = ()) -> tuple[list[NotTaken], list[NotTaken]]:
    """The tags in two groups in which no two have opposite conditions: those that can be taken together with what is
    `taken`, and those whose opposite is or comes before them."""
    first: list[NotTaken] = []
    opposite: list[NotTaken] = []
    conditions = {_outcome(each) for each in taken}
    for each in left_out:
        written, wanted = _outcome(each)
        conditions.add((written, wanted))
        (opposite if (written, not wanted) in conditions else first).append(each)
    return first, opposite


def _outcome(left_out: NotTaken) -> tuple[str, bool]:
    return left_out.written.text.strip(), left_out.condition == "if"


def takes(tree: LaunchTree, left_out: NotTaken) -> bool:
    """Whether a launch takes a tag that another one leaves out."""
    return (left_out.place, left_out.written.text, left_out.condition == "if") in _outcomes(tree)


@derived
def _outcomes(tree: LaunchTree) -> frozenset[tuple[Location, str, bool]]:
    """The values of the launch that are true or false, by place and text."""
    values = (use for use in tree.uses if use.kind == "value" and use.value is not None)
    return frozenset(
        (use.location, use.name, truth)
        for use in values
        if (truth := _TRUTH.get((use.value or "").strip().lower())) is not None
    )


def _open(tree: LaunchTree) -> Iterator[NotTaken]:
    """What is left out by more than a plain word, which is how tags are commented out, in files that can be mended."""
    return (
        each for each in tree.not_taken if not each.written.is_literal and catalogued_file(each.origin[-1].file) is None
    )


def _choices(root: LaunchFile | None) -> Iterator[tuple[str, tuple[str, ...]]]:
    """The arguments that a file declares with choices, and these."""
    for action in root.root.walk() if root is not None and root.root is not None else ():
        name = action.value("name") if action.kind == "arg" else None
        given = (child.value("value") for child in action.children if child.kind == "choice")
        choices = tuple(value.text for value in given if value is not None)
        if name is not None and choices:
            yield name.text, choices


def _key(args: Assignment) -> _Key:
    return tuple(sorted(args.items()))


def _shown(args: Assignment, given: Assignment) -> str:
    return " ".join(
        f"{name.removeprefix(VARIABLE)}={text}" if name.startswith(VARIABLE) else f"{name}:={text}"
        for name, text in _key(args)
        if given.get(name) != text
    )


def _in_words(left_out: NotTaken) -> str:
    written = left_out.shown
    shown = written if len(written) <= _LONGEST else f"{written[: _LONGEST - 3]}..."
    return f"{shown} is {'true' if left_out.condition == 'if' else 'false'}"


def _unsure_of_others(finding: Finding, left_out: NotTaken, changed: AbstractSet[str], what_if: WhatIf) -> Finding:
    """It as information where a value that is made of arguments stands outside of the tag that was left out,
    below a condition of another argument than those that were changed: who changes these may change that one with them,
    as a robot of another version has no such bus."""
    if not _depends_beside(finding, left_out, what_if.documents):
        return finding
    chain = (related.location for related in finding.related if related.role == "included")
    for place in (finding.location, *chain):
        launch_file = what_if.launch_files.get(place.file)
        for action in _around(launch_file.root if launch_file is not None else None, place):
            conditions = (value for kind in CONDITIONS if (value := action.value(kind)) is not None)
            if any((named := named_arguments(value)) and changed.isdisjoint(named) for value in conditions):
                return doubted(finding, Doubt(Reason.PARTLY_READ))
    return finding


def _depends_beside(finding: Finding, left_out: NotTaken, documents: Mapping[str, Document]) -> bool:
    """Whether it is of a value that is made of arguments, outside of the tag that was left out."""
    if finding.rule in _OF_ARGUMENTS or _stands_in(finding, left_out):
        return False
    return _ARGUMENT.search(_text(finding, documents)) is not None


def _around(action: Action | None, place: Location) -> Iterator[Action]:
    """The tags that a place is in, from the outside."""
    while action is not None:
        yield action
        inside = (child for child in action.children if child.span.start <= place.span.start < child.span.end)
        action = next(inside, None)


def _is_given(finding: Finding, documents: Mapping[str, Document]) -> bool:
    """Whether it is about the value of an argument as it is: one that is not given where nobody asks for it."""
    return finding.rule not in _OF_ARGUMENTS and _ONE_ARGUMENT.fullmatch(_text(finding, documents)) is not None


def _depends(finding: Finding, left_out: NotTaken, documents: Mapping[str, Document]) -> bool:
    """Whether it depends on arguments: where a tag is not taken they may be others than where it is. What is said of
    the arguments themselves does not."""
    if finding.rule in _OF_ARGUMENTS:
        return False
    file = left_out.origin[-1].file
    document = documents.get(file)
    in_python = is_python(file, document.text if document is not None else "")
    if finding.rule == _OF_VALUES and in_python and not named_arguments(left_out.written):
        return True
    if finding.location.file == file and not in_python:
        return _ARGUMENT.search(_text(finding, documents)) is not None
    actions = tuple(left_out.action.walk())
    if left_out.action.kind == BRANCH:
        # What stands beside it in the branch has nothing to do with it.
        at = finding.location.span.start
        actions = tuple(each for each in actions if each.span.start <= at < each.span.end) or actions
    return any(
        named_arguments(attribute.value)
        for action in actions
        for attribute in action.attributes
        if attribute.value != left_out.written
    )


def _text(finding: Finding, documents: Mapping[str, Document]) -> str:
    document = documents.get(finding.location.file)
    return document.text[slice(*finding.location.span)] if document is not None else ""


def _stands_in(finding: Finding, left_out: NotTaken) -> bool:
    """Whether a finding is of a tag, or of what that includes, or may be of code that it runs."""
    if finding.location.file == left_out.origin[-1].file and any(a.kind == "opaque" for a in left_out.action.walk()):
        return True
    chain = (related.location for related in finding.related if related.role == "included")
    return _holds(left_out, (finding.location, *chain))


def _holds(left_out: NotTaken, places: Iterable[Location]) -> bool:
    file = left_out.origin[-1].file
    here = [place.span.start for place in places if place.file == file]
    return any(each.span.start <= at < each.span.end for at in here for each in left_out.action.walk())
