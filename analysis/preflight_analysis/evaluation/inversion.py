"""With which arguments of a launch a condition takes what it leaves out: read from the text of the conditions.

Nothing is sure that is found here: whether a condition comes out as wanted is known once the launch is evaluated with
these arguments. What cannot be read backwards gives nothing.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import islice, product
from typing import NamedTuple

from preflight_analysis.documents.span import Location, Origin
from preflight_analysis.evaluation.tree import LaunchTree, NotTaken
from preflight_analysis.launch.model import Action, LaunchFile, Literal, Substitution, Value, action_at
from preflight_analysis.launch.references import NOT_ARGUMENTS, arg_references, first_word
from preflight_analysis.launch.substitutions_ros2 import nested

Assignment = Mapping[str, str]
"""Arguments of the root with their values."""

MOST = 4
"""Assignments that are looked at of one condition: those that it names first are mostly right."""
_MAX_STEPS = 40
"""From an argument to the one that it is made of."""
_MAX_COMBINATIONS = 64
"""Of what several parts of a condition ask for: most of them contradict each other where there are many."""
_LONGEST = 500
"""Characters of an expression that is read: parentheses and words nest, and Python's stack has an end."""
_WORDS = {"true": True, "1": True, "false": False, "0": False}
_SAME_TEXT = frozenset({"lower", "upper", "strip", "casefold"})
"""Methods that a comparison is not about."""
_COMPARISONS = {"config-equals": True, "config-not-equals": False}
"""Conditions of Python launch files on one configuration, with whether it has to be equal."""
_MARK = "argument_{}_of_the_condition"


class _Wanted(NamedTuple):
    """A variable of a condition, with the text that it has to have."""

    name: str
    text: str


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


class _Reader:
    def __init__(self, tree: LaunchTree, launch_files: Mapping[str, LaunchFile], value: str | None) -> None:
        self._tree, self._files = tree, launch_files
        # Where values are put into the text of an expression, Python's words are what it knows.
        self._style = value if value is not None or not tree.ros.nested_substitutions else str(False)
        self._steps = 0

    def truth(
        self, parts: Sequence[Literal | Substitution], wanted: bool, file: str, chain: Origin
    ) -> Iterator[Assignment]:
        """What makes a condition true or false."""
        if len(parts) != 1 or not isinstance(parts[0], Substitution):
            return
        part = parts[0]
        words = part.words
        match part.command:
            case "arg" | "var":
                yield from self._argument(first_word(part)[0], "true" if wanted else "false", file, chain)
            case "not" if words:
                yield from self.truth(words[0], not wanted, file, chain)
            case "and" | "all" | "or" | "any":
                each = [partial(self.truth, word, wanted, file, chain) for word in words]
                yield from _all_of(each) if (part.command in ("and", "all")) == wanted else _any_of(each)
            case "equals" | "not-equals" if len(words) == 2:
                yield from self._equal(words, wanted == (part.command == "equals"), file, chain)
            case command if command in _COMPARISONS and len(words) == 2:
                variable = part._replace(command="var", words=words[:1])
                yield from self._equal(((variable,), words[1]), wanted == _COMPARISONS[command], file, chain)
            case "eval":
                yield from self._expression(part, wanted, file, chain)

    def _equal(
        self, words: Sequence[Sequence[Literal | Substitution]], wanted: bool, file: str, chain: Origin
    ) -> Iterator[Assignment]:
        for one, other in (words, words[::-1]):
            text = "".join(piece.text for piece in other)
            if all(isinstance(piece, Literal) for piece in other) and len(one) == 1:
                for wished in (text,) if wanted else _others(text):
                    yield from self._parts(one, wished, file, chain)

    # From the value of an argument to the arguments of the root

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
            if part.command in ("arg", "var"):
                yield from self._argument(first_word(part)[0], text, file, chain)
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
        text, names = _with_marks(part)
        if text is None or len(text) > _LONGEST:
            return
        try:
            node = ast.parse(text.strip(), mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            return
        for conjunction in _solved(node, wanted, names):
            each = [partial(self._argument, name, text, file, chain) for name, text in conjunction]
            yield from _all_of(each)


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


def _others(text: str) -> tuple[str, ...]:
    """The texts that are another one, as far as they can be told: of true there is one, of a name there are many."""
    known = _WORDS.get(text.lower())
    return () if known is None else ("false" if known else "true",)


def _in_style(text: str, now: str | None) -> str:
    """A truth value as the file writes them."""
    value = _WORDS.get(text.lower())
    if value is None or now is None:
        return text
    if now in ("True", "False"):
        return str(value)
    return str(int(value)) if now in ("0", "1") else text


def _with_marks(part: Substitution) -> tuple[str | None, dict[str, str] | None]:
    """An expression with a mark for each argument, and the names that the marks stand for; in ROS 1, where arguments
    are known by their names, no marks. None for what has other values in it."""
    if not part.words:
        return part.text[len("$(eval ") : -1], None
    text, names = "", dict[str, str]()
    for piece in part.words[0]:
        if isinstance(piece, Literal):
            text += piece.text
        elif piece.command == "var" and len(piece.words) == 1:
            mark = _MARK.format(len(names))
            names[mark] = first_word(piece)[0]
            text += mark
        else:
            return None, None
    return text, names


def _solved(node: ast.expr, wanted: bool, names: Mapping[str, str] | None) -> Iterator[tuple[_Wanted, ...]]:
    """What variables have to be, all of a tuple together, for an expression to be true or false."""
    match node:
        case ast.UnaryOp(op=ast.Not(), operand=inner):
            yield from _solved(inner, not wanted, names)
        case ast.BoolOp(op=op, values=values):
            if isinstance(op, ast.And) == wanted:
                for several in product(*(list(islice(_solved(v, wanted, names), MOST)) or [()] for v in values)):
                    yield tuple(each for one in several for each in one)
            else:
                for value in values:
                    yield from _solved(value, wanted, names)
        case ast.Compare(left=left, ops=[ast.Eq() | ast.NotEq() as op], comparators=[right]):
            equal = wanted == isinstance(op, ast.Eq)
            for one, other in ((left, right), (right, left)):
                name, text = _variable(one, names), _constant(other, names)
                if name is not None and text is not None:
                    yield from ((_Wanted(name, each),) for each in ((text,) if equal else _others(text)))
        case ast.Compare(
            left=left, ops=[ast.In() | ast.NotIn() as op], comparators=[ast.List() | ast.Tuple() as items]
        ):
            name = _variable(left, names)
            if name is not None and wanted == isinstance(op, ast.In):
                texts = (_constant(each, names) for each in items.elts)
                yield from ((_Wanted(name, text),) for text in texts if text is not None)
        case _:
            if (name := _variable(node, names)) is not None:
                yield (_Wanted(name, "true" if wanted else "false"),)


def _variable(node: ast.expr, names: Mapping[str, str] | None) -> str | None:
    match node:
        case ast.Call(func=ast.Attribute(value=inner, attr=method), args=[]) if method in _SAME_TEXT:
            return _variable(inner, names)
        case ast.Call(func=ast.Name(id="str" | "bool"), args=[inner]):
            return _variable(inner, names)
        case ast.Call(func=ast.Name(id="arg"), args=[ast.Constant(value=str(name))]) if names is None:
            return name
        case ast.Name(id=name):
            return names.get(name) if names is not None else name if name not in NOT_ARGUMENTS else None
        case ast.Constant(value=str(text)) if names is not None:
            return names.get(text)
    return None


def _constant(node: ast.expr, names: Mapping[str, str] | None) -> str | None:
    match node:
        case ast.Constant(value=str(text)):
            return None if names is not None and any(mark in text for mark in names) else text
        case ast.Constant(value=bool(value)):
            return str(value).lower()
        case ast.Constant(value=int(number) | float(number)):
            return str(number)
        case ast.Name(id="true" | "false" as word):
            return word
    return None


def named_arguments(value: Value) -> frozenset[str]:
    """The arguments that a value names."""
    compared = (part for part in nested(value.parts) if part.command in _COMPARISONS)
    return frozenset((*(first_word(part)[0] for part in compared), *(name for name, _ in arg_references(value))))
