"""The calls in a Python launch file, with their places: what a run made is shown where it is written.

The text may be half typed: where it does not parse, the calls in it that are whole are read one by one.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cached_property, lru_cache

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.change import Change
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import ByteOffsets, LineIndex, Span
from preflight_analysis.incremental.derived import derived

MAX_CHARACTERS = 500_000
"""Of a text that is read as Python."""
_NAME_AND_BRACKET = re.compile(r"[\w.]+(\s*\()?")
_NAME = re.compile(r"\b[A-Za-z_]")
_QUOTES = re.compile(r"[A-Za-z]{0,2}(\"\"\"|'''|\"|')")
_MAX_CALLS = 5_000
_MAX_PARSED = 5_000_000
"""Characters of all calls together that are tried to be read one by one: they may stand in each other."""
_MAX_HEADS = 20
_TOKEN = re.compile(
    r"""(?P<string>(?:[rRbBuUfF]{1,2})?(?:\"\"\"(?:[^\\]|\\.)*?\"\"\"|'''(?:[^\\]|\\.)*?'''|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'))"""
    r"""|(?P<comment>\#[^\n]*)|(?P<open>[(\[{])|(?P<close>[)\]}])|(?P<comma>,)""",
    re.DOTALL,
)


@dataclass(frozen=True, slots=True)
class _Mistake:
    """Why a text is no Python. Not the exception: a remembered one holds the frames of all who called then."""

    message: str
    line: int | None = None
    column: int | None = None
    """From 1 on; None where it is the whole text."""


class _Program:
    """What there is to read of a text, whoever asks."""

    def __init__(self, module: ast.Module | None, pieces: tuple[ast.AST, ...]) -> None:
        self.module, self.pieces = module, pieces
        self.spans: dict[int, Span] = {}
        """Where nodes stand that were asked for, by `id`."""

    @cached_property
    def nodes(self) -> tuple[ast.AST, ...]:
        """All that is in the pieces."""
        return tuple(node for piece in self.pieces for node in walk(piece))

    @cached_property
    def calls(self) -> dict[int, list[ast.Call]]:
        """By their lines."""
        found: dict[int, list[ast.Call]] = {}
        for node in self.nodes:
            if isinstance(node, ast.Call):
                found.setdefault(node.lineno, []).append(node)
        return found

    @cached_property
    def expressions(self) -> dict[tuple[int, ...], ast.expr]:
        """By lines and columns of begin and end; of several the innermost one."""
        return {
            (node.lineno, node.col_offset, node.end_lineno or 0, node.end_col_offset or 0): node
            for node in self.nodes
            if isinstance(node, ast.expr)
        }

    @cached_property
    def pairs(self) -> dict[int, ast.expr]:
        """Values of dictionaries, by the `id` of their keys."""
        found = ((key, value) for node in self.nodes if isinstance(node, ast.Dict) for key, value in _items(node))
        return {id(key): value for key, value in found}

    @cached_property
    def assigned(self) -> dict[str, ast.expr]:
        """What names stand for that are assigned in one place only."""
        found: dict[str, list[ast.expr]] = {}
        for node in self.nodes:
            if isinstance(node, ast.Assign) and len(node.targets) == 1 and isinstance(node.targets[0], ast.Name):
                found.setdefault(node.targets[0].id, []).append(node.value)
            elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.value is not None:
                found.setdefault(node.target.id, []).append(node.value)
            elif isinstance(node, (ast.AugAssign, ast.For)) and isinstance(node.target, ast.Name):
                found.setdefault(node.target.id, []).extend([ast.Constant(None)] * 2)
        return {name: values[0] for name, values in found.items() if len(values) == 1}

    @cached_property
    def sure(self) -> frozenset[int]:
        """By `id`: what is evaluated whatever happens, as it stands in `generate_launch_description`, or in a function
        that is called there or given to an `OpaqueFunction`, and not below `if` and the like."""
        found: set[int] = set()
        body = self.module.body if self.module is not None else []
        functions = {each.name: each for each in body if isinstance(each, ast.FunctionDef)}
        called = ["generate_launch_description"]
        while called:
            function = functions.pop(called.pop(), None)
            for node in _in_any_case(function.body) if function is not None else ():
                found.add(id(node))
                if isinstance(node, ast.Call):
                    called += [last_name(node.func)] if isinstance(node.func, ast.Name) else []
                    called += [last_name(k.value) for k in node.keywords if k.arg == "function"]
        return frozenset(found)

    @cached_property
    def imported(self) -> dict[str, str]:
        """What names stand for that an import binds, and nothing else in the file does: `Node` for
        `launch_ros.actions.Node`, `launch` for itself."""
        bound: dict[str, list[str | None]] = {}
        for node in self.nodes if self.module is not None else ():
            if isinstance(node, ast.ImportFrom):
                for alias in node.names:
                    full = f"{node.module}.{alias.name}" if node.module and not node.level else None
                    bound.setdefault(alias.asname or alias.name, []).append(full)
            elif isinstance(node, ast.Import):
                for alias in node.names:
                    top = alias.name.partition(".")[0]
                    bound.setdefault(alias.asname or top, []).append(alias.name if alias.asname else top)
            elif isinstance(node, ast.Name) and isinstance(node.ctx, (ast.Store, ast.Del)):
                bound.setdefault(node.id, []).append(None)
            elif isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
                bound.setdefault(node.name, []).append(None)
            elif isinstance(node, ast.arg):
                bound.setdefault(node.arg, []).append(None)
        return {name: full[0] for name, full in bound.items() if len(set(full)) == 1 and full[0] is not None}


@lru_cache(maxsize=8)
def _parsed(text: str) -> _Program | _Mistake:
    """The syntax tree, or why there is none. One text is asked for several times, and the trees are not changed."""
    if len(text) > MAX_CHARACTERS:
        return _Mistake(f"files of more than {MAX_CHARACTERS:,} characters are not read as Python")
    try:
        module = ast.parse(text)
        return _Program(module, (module,))
    except SyntaxError as error:
        return _Mistake(error.msg or "invalid syntax", error.lineno or 1, error.offset or 1)
    except (ValueError, RecursionError, MemoryError) as error:
        return _Mistake(str(error) or type(error).__name__)


def module_of(text: str) -> ast.Module | None:
    """The syntax tree of a text that parses."""
    parsed = _parsed(text)
    return parsed.module if isinstance(parsed, _Program) else None


class PythonSource:
    """A text as Python, as far as it is. `problem` is why it does not parse, with its place. Where `since` is what was
    edited in it since, places are those in the text as it is now."""

    def __init__(self, text: str, lines: LineIndex, since: Change | None = None) -> None:
        self.text, self.lines = text, lines
        self._since = since
        self._bytes = ByteOffsets(text)
        self.problem: tuple[str, Span] | None = None
        self.module: ast.Module | None = None
        self._parsed = parsed = _parsed(text)
        if isinstance(parsed, _Program):
            self.module = parsed.module
        else:
            start = 0
            if parsed.line is not None and parsed.column is not None:
                start = lines.line_start(max(parsed.line - 1, 0)) + max(parsed.column - 1, 0)
            self.problem = (parsed.message, Span(min(start, len(text)), min(start + 1, len(text))))

    @cached_property
    def _program(self) -> _Program:
        return self._parsed if isinstance(self._parsed, _Program) else _Program(None, self.pieces)

    @property
    def nodes(self) -> tuple[ast.AST, ...]:
        """All that is in the pieces."""
        return self._program.nodes

    @property
    def assigned(self) -> dict[str, ast.expr]:
        """What names stand for that are assigned in one place only."""
        return self._program.assigned

    @property
    def sure(self) -> frozenset[int]:
        """By `id`: what is evaluated whatever happens (`_Program.sure`)."""
        return self._program.sure

    @property
    def imported(self) -> dict[str, str]:
        """What names stand for that an import binds, and nothing else in the file does."""
        return self._program.imported

    @cached_property
    def pieces(self) -> tuple[ast.AST, ...]:
        """What there is to read: the module, or calls by themselves."""
        if self.module is not None:
            return (self.module,)
        return tuple(self._single_calls())

    def _single_calls(self) -> Iterator[ast.AST]:
        if len(self.text) > MAX_CHARACTERS:
            return
        known = brackets(self.text)
        behind = count = parsed = 0
        for found in _NAME_AND_BRACKET.finditer(self.text):
            name = _NAME.search(self.text, found.start(), found.end()) if found[1] is not None else None
            if name is None:
                continue
            start = name.start()
            end, commas = known.get(found.end() - 1, (None, ()))
            if start < behind:
                continue
            if count > _MAX_CALLS or parsed > _MAX_PARSED:
                return
            count += 1
            parsed += (end or start) - start + sum(comma - start for comma in commas[-_MAX_HEADS:])
            node = _expression(self.text[start : end + 1]) if end is not None else None
            if node is not None and end is not None:
                behind = end
            else:
                # Half typed: what it was given before that.
                for comma in reversed(commas[-_MAX_HEADS:]):
                    node = _expression(self.text[start:comma] + ")")
                    if node is not None:
                        behind = comma
                        break
            if node is not None:
                self._move(node, start)
                yield node

    def _move(self, node: ast.AST, offset: int) -> None:
        """To its place in the text."""
        line, column = self.lines.position(offset)
        width = self._bytes.bytes_before(offset) - self._bytes.bytes_before(offset - column)
        for each in ast.walk(node):
            if isinstance(each, (ast.expr, ast.keyword)):
                if each.lineno == 1:
                    each.col_offset += width
                if each.end_lineno == 1 and each.end_col_offset is not None:
                    each.end_col_offset += width
                each.lineno += line
                each.end_lineno = (each.end_lineno or 1) + line

    def resolved(self, node: ast.expr) -> ast.expr:
        """What a name stands for; anything else is itself."""
        for _ in range(10):
            known = self.assigned.get(node.id) if isinstance(node, ast.Name) else None
            if known is None:
                break
            node = known
        return node

    def full_name(self, node: ast.expr) -> str | None:
        """`launch_ros.actions.Node` of what an import binds; None of anything else."""
        if isinstance(node, ast.Attribute):
            holder = self.full_name(node.value)
            return f"{holder}.{node.attr}" if holder is not None else None
        return self.imported.get(node.id) if isinstance(node, ast.Name) else None

    def call(self, line: int, column: int, name: str) -> ast.Call | None:
        """The call of a class at a place (column in bytes, -1 if it is not known)."""
        at = [c for c in self._program.calls.get(line, ()) if column in (-1, c.col_offset)]
        return next(
            (c for c in at if last_name(c.func) == name), at[0] if len(at) == 1 or (at and column >= 0) else None
        )

    def expression(self, place: object) -> ast.expr | None:
        """The expression from one line and column to another."""
        if isinstance(place, list) and len(place) == 4 and all(isinstance(each, int) for each in place):
            return self._program.expressions.get(tuple(place))
        return None

    def value_beside(self, key: ast.expr) -> ast.expr | None:
        """The value in a dictionary whose key that is."""
        return self._program.pairs.get(id(key))

    def span(self, node: ast.expr | ast.keyword) -> Span:
        """Where a node stands; of a text what is between its quotes."""
        return self._now(self._span(node))

    def whole_span(self, node: ast.expr) -> Span:
        """Where a node stands, with its quotes."""
        return self._now(self._whole_span(node))

    def _now(self, span: Span) -> Span:
        return self._since.moved(span) if self._since is not None else span

    def _whole_span(self, node: ast.expr | ast.keyword) -> Span:
        start = self._offset(node.lineno, node.col_offset)
        return Span(start, self._offset(node.end_lineno or node.lineno, node.end_col_offset or node.col_offset))

    def _span(self, node: ast.expr | ast.keyword) -> Span:
        spans = self._program.spans
        found = spans.get(id(node))
        if found is None:
            found = spans[id(node)] = self._span_within(node)
        return found

    def _span_within(self, node: ast.expr | ast.keyword) -> Span:
        start, end = (whole := self._whole_span(node)).start, whole.end
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node.lineno == node.end_lineno:
            written = self.text[start:end]
            quoted = _QUOTES.match(written)
            if quoted and len(written) >= quoted.end() + len(quoted[1]):
                return Span(start + quoted.end(), end - len(quoted[1]))
        return whole

    def name_span(self, call: ast.Call) -> Span:
        """The name of what is called."""
        whole = self._span(call.func)
        name = last_name(call.func)
        return self._now(Span(max(whole.start, whole.end - len(name)), whole.end))

    def keyword_span(self, keyword: ast.keyword) -> Span:
        """The name of a keyword."""
        start = self._offset(keyword.lineno, keyword.col_offset)
        return self._now(Span(start, start + len(keyword.arg or "")))

    def line_span(self, line: int) -> Span:
        """A line without the blanks around its text; lines are counted from 1."""
        whole = self.lines.line_span(line - 1)
        text = self.text[whole.start : whole.end]
        return self._now(Span(whole.start + len(text) - len(text.lstrip()), whole.start + len(text.rstrip())))

    def _offset(self, line: int, column: int) -> int:
        start, end = self.lines.line_start(line - 1), self.lines.line_start(line)
        if self._bytes.same:
            return min(start + column, end)
        return min(self._bytes.offset(self._bytes.bytes_before(start) + column), end)


def _items(node: ast.Dict) -> Iterator[tuple[ast.expr, ast.expr]]:
    return ((key, value) for key, value in zip(node.keys, node.values, strict=True) if key is not None)


def walk(node: ast.AST) -> list[ast.AST]:
    """As `ast.walk`, sooner, and without what says how a name is used."""
    found = [node]
    for each in found:
        found += _within(each)
    return found


def _within(node: ast.AST) -> list[ast.AST]:
    found: list[ast.AST] = []
    for name, value in vars(node).items():
        if isinstance(value, list):
            found += [item for item in value if isinstance(item, ast.AST)]
        elif isinstance(value, ast.AST) and name != "ctx":
            found.append(value)
    return found


def _in_any_case(body: list[ast.stmt]) -> Iterator[ast.AST]:
    """The nodes that are evaluated whenever the body of a function is."""
    for statement in body:
        if isinstance(statement, (ast.Expr, ast.Assign, ast.AnnAssign, ast.AugAssign, ast.Return)):
            yield from _evaluated(statement)
        elif any(isinstance(node, (ast.Return, ast.Raise)) for node in ast.walk(statement)):
            return  # what follows is another branch


def _evaluated(node: ast.AST) -> Iterator[ast.AST]:
    """The nodes of a statement or expression that are evaluated with it, once."""
    waiting = [node]
    while waiting:
        each = waiting.pop()
        yield each
        if isinstance(each, ast.BoolOp):
            waiting.append(each.values[0])
        elif isinstance(each, ast.IfExp):
            waiting.append(each.test)
        elif not isinstance(each, (ast.Lambda, ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)):
            waiting += _within(each)


def last_name(node: ast.expr) -> str:
    """`Node` of `launch_ros.actions.Node`."""
    return node.attr if isinstance(node, ast.Attribute) else node.id if isinstance(node, ast.Name) else ""


def open_brackets(text: str) -> str:
    """The brackets that are open at the end of a text, the outermost first."""
    opened: list[str] = []
    for token in _TOKEN.finditer(text):
        if token["open"]:
            opened.append(token["open"])
        elif token["close"] and opened:
            opened.pop()
    return "".join(opened)


def _expression(text: str) -> ast.expr | None:
    try:
        return ast.parse(text, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def brackets(text: str) -> dict[int, tuple[int | None, list[int]]]:
    """Each opening bracket with the one that closes it, if any, and the commas right inside."""
    found: dict[int, tuple[int | None, list[int]]] = {}
    opened: list[int] = []
    for token in _TOKEN.finditer(text):
        if token["open"]:
            opened.append(token.start())
            found[token.start()] = (None, [])
        elif token["close"] and opened:
            start = opened.pop()
            found[start] = (token.start(), found[start][1])
        elif token["comma"] and opened:
            found[opened[-1]][1].append(token.start())
    return found


def is_quoted(text: str, offset: int) -> bool:
    """Whether a place is in a string, one whose end is missing too, or in a comment."""
    end = 0
    for token in _TOKEN.finditer(text):
        if token.start() >= offset:
            break
        end = token.end()
        if token["string"] and offset < end:
            return True
        if token["comment"] and offset <= end:
            return True
    return re.search(r"[\"']", text[max(end, text.rfind("\n", 0, offset) + 1) : offset]) is not None


@derived
def python_source(document: Document) -> PythonSource:
    """A document as Python, once for all who ask."""
    return PythonSource(document.text, document.lines)
