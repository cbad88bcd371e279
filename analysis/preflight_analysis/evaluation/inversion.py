"""With which arguments of a launch a condition takes what it leaves out: read from the text of the conditions.

Nothing is sure that is found here: whether a condition comes out as wanted is known once the launch is evaluated with
these arguments. What cannot be read backwards gives nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import islice, product

from preflight_analysis.documents.span import Location, Origin
from preflight_analysis.evaluation.conditions import (
    COMPARISONS,
    MOST,
    REFERENCES,
    VARIABLE,
    Wanted,
    comparisons,
    default_of,
    name_in,
    parsed_expression,
    solved,
)
from preflight_analysis.evaluation.tree import LaunchTree, NotTaken
from preflight_analysis.launch.model import Action, LaunchFile, Literal, Substitution, action_at
from preflight_analysis.launch.substitutions_ros2 import nested

Assignment = Mapping[str, str]
"""Arguments of the root with their values, and variables of the environment, whose names begin with `VARIABLE`."""

_MAX_STEPS = 40
"""From an argument to the one that it is made of."""
_MAX_COMBINATIONS = 64
"""Of what several parts of a condition ask for: most of them contradict each other where there are many."""
_WORDS = {"true": True, "1": True, "false": False, "0": False}


def assignments(
    tree: LaunchTree, launch_files: Mapping[str, LaunchFile], left_out: NotTaken, given: Assignment
) -> list[Assignment]:
    """The arguments that would take a tag, the likeliest first, each with all of those that are `given`, which is what
    `tree` was evaluated with."""
    reader = _Reader(tree, launch_files, left_out.value)
    *chain, tag = left_out.origin
    found = reader.truth(left_out.written.parts, left_out.condition == "if", tag.file, tuple(chain))
    unique: dict[tuple[tuple[str, str], ...], Assignment] = {}
    for each in islice(found, MOST):
        whole = {**given, **each}
        if whole != given:
            unique.setdefault(tuple(sorted(whole.items())), whole)
    return list(unique.values())


def arguments_and_variables(given: Assignment) -> tuple[dict[str, str], dict[str, str]]:
    """What is given to the launch, and what the environment is to have."""
    variables = {name.removeprefix(VARIABLE): text for name, text in given.items() if name.startswith(VARIABLE)}
    return {name: text for name, text in given.items() if not name.startswith(VARIABLE)}, variables


class _Reader:
    def __init__(self, tree: LaunchTree, launch_files: Mapping[str, LaunchFile], value: str | None) -> None:
        self._tree, self._files = tree, launch_files
        # Where values are put into the text of an expression, Python's words are what it knows.
        self._style = value if value is not None or not tree.ros.nested_substitutions else str(False)
        self._steps = 0
        self._compared: dict[str, Mapping[str, list[str]]] = {}
        """By file and name, the texts that its conditions compare arguments with."""

    def truth(
        self, parts: Sequence[Literal | Substitution], wanted: bool, file: str, chain: Origin
    ) -> Iterator[Assignment]:
        """What makes a condition true or false."""
        if len(parts) != 1 or not isinstance(parts[0], Substitution):
            return
        part = parts[0]
        words = part.words
        match part.command:
            case command if command in REFERENCES:
                yield from self._reference(part, "true" if wanted else "false", file, chain)
            case "not" if words:
                yield from self.truth(words[0], not wanted, file, chain)
            case "and" | "all" | "or" | "any":
                each = [partial(self.truth, word, wanted, file, chain) for word in words]
                yield from _all_of(each) if (part.command in ("and", "all")) == wanted else _any_of(each)
            case "equals" | "not-equals" if len(words) == 2:
                yield from self._equal(words, wanted == (part.command == "equals"), file, chain)
            case command if command in COMPARISONS and len(words) == 2:
                variable = part._replace(command="var", words=words[:1])
                yield from self._equal(((variable,), words[1]), wanted == COMPARISONS[command], file, chain)
            case "eval":
                yield from self._expression(part, wanted, file, chain)

    def _equal(
        self, words: Sequence[Sequence[Literal | Substitution]], wanted: bool, file: str, chain: Origin
    ) -> Iterator[Assignment]:
        for one, other in (words, words[::-1]):
            text = "".join(piece.text for piece in other)
            if all(isinstance(piece, Literal) for piece in other) and len(one) == 1:
                name = name_in(one[0])
                for wished in (text,) if wanted else self._others(name, text, file):
                    yield from self._parts(one, wished, file, chain)

    def _others(self, name: str | None, text: str, file: str) -> Iterable[str]:
        """The texts that are another one, as far as they can be told: of true there is one; of a name those that are
        its choices or that the file compares it with."""
        known = _WORDS.get(text.lower())
        if known is not None:
            return ("false" if known else "true",)
        if name is None:
            return ()
        inside = (child for each in self._declared(name, file) for child in each.children if child.kind == "choice")
        choices = [value.text for child in inside if (value := child.value("value")) is not None]
        found = dict.fromkeys((*choices, *self._compared_in(file).get(name, ())))
        return [each for each in found if each not in ("", text)]

    def _compared_in(self, file: str) -> Mapping[str, list[str]]:
        if file not in self._compared:
            launch_file = self._files.get(file)
            root = launch_file.root if launch_file is not None else None
            found = self._compared[file] = dict[str, list[str]]()
            for action in root.walk() if root is not None else ():
                for condition in ("if", "unless"):
                    value = action.value(condition)
                    for part in nested(value.parts) if value is not None else ():
                        for name, text in comparisons(part):
                            found.setdefault(name, []).append(text)
        return self._compared[file]

    # From the value of an argument to the arguments of the root

    def _reference(self, part: Substitution, text: str, file: str, chain: Origin) -> Iterator[Assignment]:
        """What makes the substitution of an argument or of a variable this text."""
        name = name_in(part)
        if name is None:
            return
        if not name.startswith(VARIABLE):
            yield from self._argument(name, text, file, chain)
        elif text:
            yield {name: _in_style(text, default_of(part))}

    def _argument(self, name: str, text: str, file: str, chain: Origin) -> Iterator[Assignment]:
        self._steps += 1
        if self._steps > _MAX_STEPS:
            return
        shared = self._tree.ros.shared_configurations
        include = self._action(chain[-1]) if chain else None
        if include is not None:
            passed = [child for child in include.children if child.kind == "arg" and _named(child) == name]
            values = [value for child in passed if (value := child.value("value") or child.value("default"))]
            for value in values:
                yield from self._parts(value.parts, text, chain[-1].file, chain[:-1])
            if values:
                return
        if chain and (shared or (include is not None and include.attribute("pass_all_args") is not None)):
            yield from self._argument(name, text, chain[-1].file, chain[:-1])
        declared = self._declared(name, file)
        if not chain and (shared or any(each.attribute("value") is None for each in declared)):
            yield from self._of_root(name, text)
        for each in () if shared else declared:
            value = each.value("value") or (each.value("default") if chain else None)
            if value is not None:
                yield from self._parts(value.parts, text, file, chain)

    def _of_root(self, name: str, text: str) -> Iterator[Assignment]:
        arg = self._tree.args.get(name)
        now = (arg.value if arg.value is not None else arg.default) if arg is not None else None
        # What is not empty counts as true in an expression: that says nothing of which text it has to be. And nobody
        # empties an argument to see what its file does without.
        if text and (text not in ("true", "false") or now is None or now.lower() in _WORDS):
            yield {name: _in_style(text, now if now is not None else self._style)}

    def _parts(
        self, parts: Sequence[Literal | Substitution], text: str, file: str, chain: Origin
    ) -> Iterator[Assignment]:
        """What makes a value this text."""
        if len(parts) == 1 and isinstance(part := parts[0], Substitution):
            if part.command in REFERENCES:
                yield from self._reference(part, text, file, chain)
            elif text.lower() in _WORDS:
                yield from self.truth(parts, _WORDS[text.lower()], file, chain)

    def _action(self, tag: Location) -> Action | None:
        launch_file = self._files.get(tag.file)
        if launch_file is None or launch_file.partial:
            return None
        return action_at(launch_file, tag.span.start + 1)

    def _declared(self, name: str, file: str) -> list[Action]:
        launch_file = self._files.get(file)
        if launch_file is None or launch_file.root is None:
            return []
        return [each for each in _of_file(launch_file.root) if each.kind == "arg" and _named(each) == name]

    # Expressions

    def _expression(self, part: Substitution, wanted: bool, file: str, chain: Origin) -> Iterator[Assignment]:
        expression = parsed_expression(part)
        if expression is None:
            return
        node, names = expression
        for conjunction in solved(node, wanted, names):
            yield from _all_of([partial(self._wished, each, file, chain) for each in conjunction])

    def _wished(self, wish: Wanted, file: str, chain: Origin) -> Iterator[Assignment]:
        for text in (wish.text,) if wish.equal else self._others(wish.name, wish.text, file):
            if wish.name.startswith(VARIABLE):
                yield {wish.name: text}
            else:
                yield from self._argument(wish.name, text, file, chain)


def _of_file(action: Action) -> Iterator[Action]:
    """The tags of a file but those in includes, which pass arguments on."""
    for child in action.children:
        yield child
        if child.kind != "include":
            yield from _of_file(child)


def _named(action: Action) -> str | None:
    name = action.value("name")
    return name.text if name is not None else None


_Found = Callable[[], Iterator[Assignment]]


def _any_of(each: Iterable[_Found]) -> Iterator[Assignment]:
    for found in each:
        yield from found()


def _all_of(each: Iterable[_Found]) -> Iterator[Assignment]:
    """Each combination in which no argument has two values. What cannot be read backwards may be right as it is."""
    combinations = product(*(list(islice(found(), MOST)) or [{}] for found in each))
    for combination in islice(combinations, _MAX_COMBINATIONS):
        merged: dict[str, str] = {}
        if all(merged.setdefault(name, text) == text for one in combination for name, text in one.items()):
            yield merged


def _in_style(text: str, now: str | None) -> str:
    """A truth value as the file writes them."""
    value = _WORDS.get(text.lower())
    if value is None or now is None:
        return text
    if now in ("True", "False"):
        return str(value)
    return str(int(value)) if now in ("0", "1") else text
