"""LCH025: a condition that is never true, and tests that compare what cannot be equal."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from typing import Any

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.edits.writer import writer_of
from preflight_analysis.evaluation import expression, values
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding, Fix, Related
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Action, ActionAttribute, LaunchFile, Value
from preflight_analysis.launch.substitutions import is_eval
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import fix
from preflight_analysis.model.syntax import CONDITIONS, has_condition
from preflight_analysis.rules.further_reading import ANONYMOUS_NAMES, ROSLAUNCH_ARG
from preflight_analysis.rules.rule import Rule


@dataclass(frozen=True, slots=True)
class _Fixed:
    """An argument that its file fixes with `value=`: nobody can set it."""

    value: object
    location: Location


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for launch_file in context.launch_files.values():
        yield from _findings(launch_file)


@derived
def _findings(launch_file: LaunchFile) -> tuple[Finding, ...]:
    if launch_file.root is None:
        return ()
    conditions = launch_file.root.gather(_conditions)
    fixed = _fixed_args(launch_file) if conditions else {}
    found: list[Finding] = []
    for action, attribute in conditions:
        if any(action.attribute(name) is None for name in CONDITIONS):  # both together stop the launch: LCH007
            found.extend(_constant(RULE, launch_file, fixed, action, attribute))
        found.extend(_unequal(RULE, launch_file, attribute.value))
    return tuple(found)


def _conditions(action: Action) -> list[tuple[Action, ActionAttribute]]:
    return [(action, attribute) for name in CONDITIONS if (attribute := action.attribute(name)) is not None]


def _constant(
    rule: Rule, launch_file: LaunchFile, fixed: Mapping[str, _Fixed], action: Action, attribute: ActionAttribute
) -> Iterator[Finding]:
    used: list[str] = []
    value = attribute.value
    try:
        result = values.to_bool(_text(value, fixed, used))
    except (_VariesError, values.BadValueError):
        return
    if result == (attribute.name == "if"):
        return
    because = f", because argument '{used[0]}' is '{fixed[used[0]].value}'" if used else ""
    yield rule.claim(
        f"<{action.kind}> is never evaluated: '{attribute.name}' is always {str(result).lower()}{because}",
        launch_file.document.location(value.span),
        subject=Subject("condition", used[0] if used else ""),
        effect="style",
        related=(Related(f"'{name}' is fixed here", fixed[name].location) for name in used),
    )


class _VariesError(ValueError):
    """The value is not the same in each launch, or it is not known here."""


def _text(value: Value, fixed: Mapping[str, _Fixed], used: list[str]) -> str:
    """What the value comes to in every launch; `used` gets the fixed arguments in it. Raises `_VariesError`."""
    if value.problem is not None:
        raise _VariesError
    if value.is_literal:
        return value.text

    def known(name: str) -> Any:
        if name not in fixed:
            raise _VariesError
        used.append(name)
        return fixed[name].value

    if is_eval(value.text):
        functions = {"arg": lambda name: values.convert(known(name), "auto")}
        functions |= dict.fromkeys(("env", "optenv", "find", "anon", "dirname"), _varies)
        inner = value.text[len("$(eval ") : -1]
        try:
            return str(expression.evaluate(inner, lambda name: values.convert(known(name), "auto"), functions))
        except (expression.EvaluationError, expression.NotAllowedError) as error:
            raise _VariesError from error
    text = value.text
    for part in value.substitutions:
        if part.command != "arg":
            raise _VariesError
        text = text.replace(part.text, known(part.arguments))
    return text


def _varies(*_: object) -> object:
    raise _VariesError


def _fixed_args(launch_file: LaunchFile) -> dict[str, _Fixed]:
    """Arguments declared once in the file, with a literal value and no condition."""
    found: dict[str, _Fixed] = {}
    several: set[str] = set()
    if (root := launch_file.root) is None:
        return found
    outermost = {id(child) for child in root.children}
    for tag in root.gather(_declared_in):
        name, value = tag.value("name"), tag.value("value")
        literal = value is not None and value.is_literal and tag.value("default") is None
        if name is None:
            continue
        if name.text in found or not literal or has_condition(tag) or id(tag) not in outermost:
            several.add(name.text)
        elif value is not None:
            found[name.text] = _Fixed(value.text, launch_file.document.location(tag.head_span))
    return {name: fixed for name, fixed in found.items() if name not in several}


def _declared_in(action: Action) -> tuple[Action, ...]:
    return () if action.kind == "include" else tuple(child for child in action.children if child.kind == "arg")


def _unequal(rule: Rule, launch_file: LaunchFile, value: Value) -> Iterator[Finding]:
    """Comparisons of an argument with a text that it never is, since `$(eval)` turns the argument into a number or
    a truth value first."""
    if not is_eval(value.text):
        return
    source = value.text[len("$(eval ") : -1].strip()
    try:
        tree = ast.parse(source, mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return
    for node in ast.walk(tree):
        if not (isinstance(node, ast.Compare) and len(node.ops) == 1 and isinstance(node.ops[0], (ast.Eq, ast.NotEq))):
            continue
        left, right = node.left, node.comparators[0]
        name = _argument(left) or _argument(right)
        constant = right if _argument(left) else left
        if name is None or not isinstance(constant, ast.Constant) or not isinstance(constant.value, str):
            continue
        converted = values.convert(constant.value, "auto")
        if isinstance(converted, str):
            continue
        outcome = "always" if isinstance(node.ops[0], ast.NotEq) else "never"
        kind = "a boolean" if isinstance(converted, bool) else "a number"
        written = ast.get_source_segment(source, constant) or ""
        plain = str(converted).lower() if isinstance(converted, bool) else str(converted)
        yield rule.claim(
            f"'{ast.get_source_segment(source, node)}' is {outcome} true: $(eval) converts argument '{name}' to {kind} "
            f"before the comparison; compare with {plain}",
            launch_file.document.location(value.span),
            subject=Subject("condition", name),
            fixes=_compare_with(launch_file, value, written, plain),
        )


def _argument(node: ast.expr) -> str | None:
    """The argument that `arg('name')` or a bare name stands for."""
    if isinstance(node, ast.Name):
        return None if node.id in expression.NAMES else node.id
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "arg" and len(node.args) == 1:
        argument = node.args[0]
        return argument.value if isinstance(argument, ast.Constant) and isinstance(argument.value, str) else None
    return None


def _compare_with(launch_file: LaunchFile, value: Value, written: str, plain: str) -> tuple[Fix, ...]:
    text = launch_file.document.text[value.span.start : value.span.end]
    if not written or text.count(written) != 1:
        return ()
    start = value.span.start + text.index(written)
    edits = writer_of(launch_file.document).replace(Span(start, start + len(written)), plain)
    return fix(f"Compare with {plain}", edits, preferred=True)


RULE = Rule(
    id="LCH025",
    name="condition-never-true",
    effect="misbehaves",
    kind="unreachable",
    sometimes=("style",),
    what="Checks for a comparison in the `$(eval ...)` of a condition that has the same result for all arguments. It "
    "also checks for other tags that are never evaluated.",
    why="`$(eval)` converts the text `true` of an argument to `True`, and `1` to a number, before the comparison. "
    "The value never equals the text `'true'`, and the tag is never evaluated.",
    example="<group if=\"$(eval arg('simulation') == 'true')\">\n</group>",
    instead='<group if="$(arg simulation)">\n</group>',
    references=(
        ROSLAUNCH_ARG,
        ANONYMOUS_NAMES,
    ),
    generations=(1,),
    check=_check,
)
