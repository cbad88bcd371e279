"""LCH040: a substitution or a condition whose value Python is asked for while the file is read, and the truth of a text
(ROS 2)."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator
from collections.abc import Set as AbstractSet
from typing import NamedTuple

from preflight_analysis.documents.span import Span
from preflight_analysis.edits.python import PythonWriter
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.python_api import CONDITIONS, SUBSTITUTIONS
from preflight_analysis.launch.python_source import PythonSource, python_source
from preflight_analysis.model.arguments import declarations
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import fix, shortened
from preflight_analysis.model.python_names import BoundNames, bound_names
from preflight_analysis.rules.further_reading import FORMATS, LAUNCH_SUBSTITUTIONS
from preflight_analysis.rules.rule import Rule

_BEFORE = ("foxy", "galactic")
"""The distributions whose launch does not have these substitutions yet."""
_CONDITIONS_ON = ("IfCondition", "UnlessCondition")
_WITH_TEST = (ast.If, ast.IfExp, ast.While, ast.Assert)
_TRUTHS = ("true", "false")
_SAME_TEXT = ("casefold", "lower", "strip", "title", "upper")
"""Methods of a text that leave `true` and `false` what they are, but for the case of letters."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for path, launch_file in context.launch_files.items():
        for span, message, instead in _asked(launch_file) if launch_file.is_python else ():
            known = instead is not None and not (instead.classes and context.environment.distro in _BEFORE)
            fixes = _fixes(launch_file, span, instead) if instead is not None and known else ()
            yield rule.claim(message, context.location(path, span), subject=Subject("expression", message), fixes=fixes)


class _Instead(NamedTuple):
    """What launch evaluates in the place of an expression: its code, in which `{0}`, `{1}`, ... are the classes."""

    code: str
    classes: tuple[str, ...]


def _fixes(launch_file: LaunchFile, span: Span, instead: _Instead) -> tuple[Fix, ...]:
    edits = PythonWriter(launch_file.document).write_expression(span, instead.classes, instead.code)
    title = f"Write {instead.classes[0]}(...)" if instead.classes else "Compare with 'true'"
    return fix(title, edits, preferred=True)


@derived
def _asked(launch_file: LaunchFile) -> tuple[tuple[Span, str, _Instead | None], ...]:
    source = python_source(launch_file.document)
    if source.module is None:
        return ()
    found = _Finder(source, bound_names(launch_file.document), _truths(launch_file))
    found.look_at(source.module)
    return tuple(found.found)


def _truths(launch_file: LaunchFile) -> frozenset[str]:
    """The arguments that are `true` or `false`, as their defaults are."""
    return frozenset(
        name
        for name, tags in declarations(launch_file).items()
        if all((default := tag.value("default")) is not None and default.text.lower() in _TRUTHS for tag in tags)
    )


class _Finder(ast.NodeVisitor):
    """Places where Python decides by an object that stands for a value of later, or by whether a text is empty."""

    def __init__(self, source: PythonSource, names: BoundNames, truths: AbstractSet[str]) -> None:
        self._source = source
        self._names = names
        self._truths = truths
        self.found: list[tuple[Span, str, _Instead | None]] = []
        self._tests = {id(node.test) for node in source.nodes if isinstance(node, _WITH_TEST)}
        self._performed = {
            id(node.args[0])
            for node in source.nodes
            if isinstance(node, ast.Call) and node.args and self._names.made_by(node) in _CONDITIONS_ON
        }

    def look_at(self, module: ast.Module) -> None:
        """Visit all nodes, without a recursion: an expression may be as deep as the file is long."""
        waiting: list[ast.AST] = [module]
        while waiting:
            node = waiting.pop()
            if isinstance(node, _LOOKED_AT):
                self.visit(node)
            if not isinstance(node, ast.JoinedStr):
                waiting.extend(ast.iter_child_nodes(node))

    def generic_visit(self, node: ast.AST) -> None:
        """Children have a turn of their own."""

    def visit_BoolOp(self, node: ast.BoolOp) -> None:
        is_test = id(node) in self._tests
        for each in node.values if is_test else node.values[:-1]:
            self._truth(each)
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
        if isinstance(node.op, ast.Not):
            self._truth(node.operand, node)
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
            name = self._performed_text(one)
            if name is not None and isinstance(other, ast.Constant) and isinstance(other.value, bool):
                equal = isinstance(node.ops[0], ast.NotEq)
                message = (
                    f"comparison is always {equal}: the value of argument '{name}' is a text; compare it with 'true'"
                )
                self._say(node, message, self._compared(one, is_true=other.value != equal))
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
        if not (isinstance(node.func, ast.Name) and len(node.args) == 1 and not node.keywords):
            return
        if node.func.id == "str":
            self._in_text(node, node.args)
        elif node.func.id == "bool":
            self._truth(node.args[0], node)

    def visit_While(self, node: ast.While) -> None:
        self._test(node.test)

    def _test(self, node: ast.expr) -> None:
        self._truth(node)
        kind = self._kind(node)
        if kind is not None:
            self._say(node, f"{kind} is always true before the launch runs")

    def _truth(self, node: ast.expr, around: ast.expr | None = None) -> None:
        """What Python takes for the truth of `node`; `around` is its `not` or `bool(...)`."""
        name = self._performed_text(node)
        if name not in self._truths:
            return
        is_not = isinstance(around, ast.UnaryOp)
        message = (
            f"'not' is always False: argument '{name}'" if is_not else f"condition is always true: argument '{name}'"
        )
        self._say(
            around or node,
            f"{message} has the text 'true' or 'false', and no text but the empty one is false; compare it with 'true'",
            self._compared(node, is_true=not is_not),
        )

    def _performed_text(self, node: ast.expr) -> str | None:
        """The launch configuration whose text an expression is."""
        value = self._names.value_of(node)
        while isinstance(value, ast.Call) and isinstance(value.func, ast.Attribute) and value.func.attr in _SAME_TEXT:
            value = self._names.value_of(value.func.value)
        match value:
            case ast.Call(func=ast.Attribute(attr="perform", value=asked)) if self._kind(asked) is not None:
                made = self._names.value_of(asked)
                arguments = made.args if isinstance(made, ast.Call) else []
                is_plain = self._names.made_by(asked) == "LaunchConfiguration" and arguments
                name = arguments[0] if is_plain else None
            case ast.Subscript(value=ast.Attribute(attr="launch_configurations"), slice=name):
                pass
            case ast.Call(
                func=ast.Attribute(attr="get", value=ast.Attribute(attr="launch_configurations")), args=[name, *_]
            ):
                pass
            case _:
                return None
        return name.value if isinstance(name, ast.Constant) and isinstance(name.value, str) else None

    def _compared(self, node: ast.expr, *, is_true: bool) -> _Instead:
        """The text compared with `true`."""
        code = self._code(node)
        lower = "" if code.endswith(".lower()") else ".lower()"
        return _Instead(f"{code}{lower} {'==' if is_true else '!='} 'true'", ())

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


_LOOKED_AT = tuple(getattr(ast, name[6:]) for name in vars(_Finder) if name.startswith("visit_"))


RULE = Rule(
    id="LCH040",
    name="substitution-as-value",
    effect="misbehaves",
    kind="invalid",
    always=(Reason.FROM_SOURCE,),
    what="Checks for a substitution or condition in a Python launch file whose value Python itself reads, in an "
    "operator, an `if` or a string. Checks for `if` and `not` with the text of an argument that is `true` or `false`.",
    why="The value is unresolved while Python reads the file. The object itself is always true, equals no text, and "
    "prints as a Python object. `IfCondition(a) and UnlessCondition(b)` is `UnlessCondition(b)`. The text `false` is "
    "true, too.",
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
