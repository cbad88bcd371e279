"""LCH040: a substitution or a condition whose value Python is asked for while the file is read (ROS 2)."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from preflight_analysis.documents.span import Span
from preflight_analysis.edits.python import PythonWriter
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.python_source import PythonSource, python_source
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import fix, shortened
from preflight_analysis.model.python_names import CONDITIONS, SUBSTITUTIONS, BoundNames, bound_names
from preflight_analysis.rules.further_reading import FORMATS, LAUNCH_SUBSTITUTIONS
from preflight_analysis.rules.rule import Rule

_BEFORE = ("foxy", "galactic")
"""The distributions whose launch does not have these substitutions yet."""
_CONDITIONS_ON = ("IfCondition", "UnlessCondition")
_WITH_TEST = (ast.If, ast.IfExp, ast.While, ast.Assert)


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for path, launch_file in context.launch_files.items():
        for span, message, instead in _asked(launch_file) if launch_file.is_python else ():
            known = context.environment.distro not in _BEFORE
            fixes = _fixes(launch_file, span, instead) if instead is not None and known else ()
            yield rule.claim(message, context.location(path, span), subject=Subject("expression", message), fixes=fixes)


class _Instead(NamedTuple):
    """What launch evaluates in the place of an expression: its code, in which `{0}`, `{1}`, ... are the classes."""

    code: str
    classes: tuple[str, ...]


def _fixes(launch_file: LaunchFile, span: Span, instead: _Instead) -> tuple[Fix, ...]:
    edits = PythonWriter(launch_file.document).write_expression(span, instead.classes, instead.code)
    return fix(f"Write {instead.classes[0]}(...)", edits, preferred=True)


@derived
def _asked(launch_file: LaunchFile) -> tuple[tuple[Span, str, _Instead | None], ...]:
    source = python_source(launch_file.document)
    if source.module is None:
        return ()
    found = _Finder(source, bound_names(launch_file.document))
    found.look_at(source.module)
    return tuple(found.found)


class _Finder(ast.NodeVisitor):
    """Places where Python decides by an object that stands for a value of later."""

    def __init__(self, source: PythonSource, names: BoundNames) -> None:
        self._source = source
        self._names = names
        self.found: list[tuple[Span, str, _Instead | None]] = []
        self._tests = {
            id(node.test) for piece in source.pieces for node in ast.walk(piece) if isinstance(node, _WITH_TEST)
        }
        self._performed = {
            id(node.args[0])
            for piece in source.pieces
            for node in ast.walk(piece)
            if isinstance(node, ast.Call) and node.args and self._names.made_by(node) in _CONDITIONS_ON
        }

    def look_at(self, module: ast.Module) -> None:
        """Visit all nodes, without a recursion: an expression may be as deep as the file is long."""
        waiting: list[ast.AST] = [module]
        while waiting:
            node = waiting.pop()
            self.visit(node)
            if not isinstance(node, ast.JoinedStr):
                waiting.extend(ast.iter_child_nodes(node))

    def generic_visit(self, node: ast.AST) -> None:
        """Children have a turn of their own."""

    def visit_BoolOp(self, node: ast.BoolOp) -> None:
        for at, each in enumerate(node.values[:-1]):
            kind = self._kind(each)
            if kind is not None:
                both = isinstance(node.op, ast.And)
                word, lost, instead = ("and", each, "And") if both else ("or", node.values[at + 1], "Or")
                advice = f"; write {instead}Substitution(...)" if self._kind(node.values[-1]) is not None else ""
                self._say(
                    node,
                    f"Python's '{word}' drops '{self._written(lost)}': {kind} is always true before the launch "
                    f"runs{advice}",
                    self._together(node, f"{instead}Substitution") if advice else None,
                )
                return

    def visit_UnaryOp(self, node: ast.UnaryOp) -> None:
        kind = self._kind(node.operand) if isinstance(node.op, ast.Not) else None
        if kind is not None:
            self._say(
                node,
                f"'not' is always False: {kind} is always true before the launch runs; use UnlessCondition or "
                "NotSubstitution",
                self._performed_as(node, "Not", node.operand),
            )

    def visit_IfExp(self, node: ast.IfExp) -> None:
        self._test(node.test)

    def visit_If(self, node: ast.If) -> None:
        self._test(node.test)

    def visit_Compare(self, node: ast.Compare) -> None:
        if len(node.ops) != 1 or not isinstance(node.ops[0], (ast.Eq, ast.NotEq)):
            return
        for one, other in ((node.left, node.comparators[0]), (node.comparators[0], node.left)):
            kind = self._kind(one)
            if kind is not None and isinstance(other, ast.Constant) and other.value is not None:
                equal = isinstance(node.ops[0], ast.NotEq)
                self._say(
                    node,
                    f"comparison is always {equal}: {kind} has no value before the launch runs; use "
                    "EqualsSubstitution, or perform(context) in an OpaqueFunction",
                    self._performed_as(node, "NotEquals" if equal else "Equals", node.left, node.comparators[0]),
                )

    def visit_JoinedStr(self, node: ast.JoinedStr) -> None:
        # Not at the object: before Python 3.12 nothing in an f-string has its right place.
        self._in_text(node, (each.value for each in node.values if isinstance(each, ast.FormattedValue)))

    def visit_Call(self, node: ast.Call) -> None:
        if isinstance(node.func, ast.Name) and node.func.id == "str" and len(node.args) == 1 and not node.keywords:
            self._in_text(node, node.args)

    def _test(self, node: ast.expr) -> None:
        kind = self._kind(node)
        if kind is not None:
            self._say(node, f"{kind} is always true before the launch runs")

    def _in_text(self, text: ast.expr, values: Iterable[ast.expr]) -> None:
        kind = next(filter(None, map(self._kind, values)), None)
        if kind is not None:
            self._say(
                text,
                f"{kind} has no value before the launch runs: the text contains a Python object; write a list of "
                "texts and substitutions",
            )

    def _kind(self, node: ast.expr) -> str | None:
        made = self._names.made_by(node)
        return f"'{made}'" if made in CONDITIONS or made in SUBSTITUTIONS else None

    def _written(self, node: ast.expr) -> str:
        span = self._source.whole_span(node)
        return shortened(" ".join(self._source.text[span.start : span.end].split()))

    def _together(self, node: ast.BoolOp, name: str) -> _Instead | None:
        """Two substitutions, or conditions, as one. Python itself asks for the value of a test."""
        if id(node) in self._tests or len(node.values) != 2 or not all(map(self._kind, node.values)):
            return None
        made = [self._condition(each) for each in node.values]
        if all(each is None for each in made):
            if any(self._names.made_by(each) in CONDITIONS for each in node.values):
                return None
            return _Instead(f"{{0}}({', '.join(map(self._code, node.values))})", (name,))
        if any(each is None for each in made):
            return None
        classes, parts = [name], list[str]()
        for condition in filter(None, made):
            code = self._code(condition.args[0])
            if self._names.made_by(condition) == "UnlessCondition":
                classes += () if "NotSubstitution" in classes else ("NotSubstitution",)
                code = f"{{1}}({code})"
            parts.append(code)
        positive = next((each for each in filter(None, made) if self._names.made_by(each) == "IfCondition"), None)
        if positive is None:
            return None
        return _Instead(f"{self._code(positive.func)}({{0}}({', '.join(parts)}))", tuple(classes))

    def _condition(self, node: ast.expr) -> ast.Call | None:
        """The call that makes one of the two plain conditions, if it is written here."""
        plain = isinstance(node, ast.Call) and len(node.args) == 1 and not node.keywords
        return node if plain and self._names.made_by(node) in _CONDITIONS_ON else None  # type: ignore[return-value]

    def _performed_as(self, node: ast.expr, name: str, *operands: ast.expr) -> _Instead | None:
        """A substitution where a condition takes the value, which evaluates it."""
        kinds = {self._names.made_by(each) for each in operands}
        if id(node) not in self._performed or kinds & CONDITIONS:
            return None
        return _Instead(f"{{0}}({', '.join(map(self._code, operands))})", (f"{name}Substitution",))

    def _code(self, node: ast.expr) -> str:
        span = self._source.whole_span(node)
        return self._source.text[span.start : span.end].replace("{", "{{").replace("}", "}}")

    def _say(self, node: ast.expr, message: str, instead: _Instead | None = None) -> None:
        self.found.append((self._source.whole_span(node), message, instead))


RULE = Rule(
    id="LCH040",
    name="substitution-as-value",
    effect="misbehaves",
    kind="invalid",
    always=(Reason.FROM_SOURCE,),
    what="Checks for a substitution or condition in a Python launch file whose value Python itself reads, in an "
    "operator, an `if` or a string.",
    why="The value is unresolved while Python reads the file. The object itself is always true, equals no text, and "
    "prints as a Python object. `IfCondition(a) and UnlessCondition(b)` is `UnlessCondition(b)`.",
    example="condition=IfCondition(use_rviz) and UnlessCondition(headless)",
    instead="condition=IfCondition(AndSubstitution(use_rviz, NotSubstitution(headless)))",
    references=(
        LAUNCH_SUBSTITUTIONS,
        FORMATS,
    ),
    generations=(2,),
    check=_check,
    in_branches=True,
)
