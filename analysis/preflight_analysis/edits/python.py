"""The writer of Python: launch files and setup.py, by their syntax tree, with the layout kept."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import NamedTuple

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.edits import layout
from preflight_analysis.edits.edit import Edit
from preflight_analysis.edits.hash_comments import HashComments
from preflight_analysis.edits.python_uses import PythonUses
from preflight_analysis.launch.model import Action, ActionAttribute
from preflight_analysis.launch.python_api import NODES
from preflight_analysis.launch.python_source import PythonSource, last_name

_ACTIONS, _SUBSTITUTIONS = "launch.actions", "launch.substitutions"
_STRING = re.compile(r"([rRuU]?)(\"\"\"|'''|\"|')")
_COMMA = re.compile(r"(?:\s|#[^\n]*\n)*,")
_BLANKS = re.compile(r"[ \t]*(?:#[^\n]*)?(?:\r?\n[ \t]*)?")
_IMPORTED_FROM = ("launch", "launch_ros")


class _Literal(NamedTuple):
    """A text that is written as one string. `span` is what is between its quotes."""

    node: ast.Constant
    span: Span
    quote: str
    raw: bool


class PythonWriter(HashComments):
    """Edits of one file. An edit that cannot be made is no edit: the tuple is empty."""

    def __init__(self, document: Document) -> None:
        super().__init__(document)
        self._text = document.text
        self._source = PythonSource(document.text, document.lines)

    def declare_argument(self, root: Action, name: str) -> tuple[Edit, ...]:
        """Declare an argument without a default before all else in the LaunchDescription."""
        descriptions = [call for call in self._calls() if last_name(call.func) == "LaunchDescription"]
        if len(descriptions) != 1 or any(keyword.arg is None for keyword in descriptions[0].keywords):
            return ()
        (description,) = descriptions
        made, imports = self._imported(_ACTIONS, "DeclareLaunchArgument")
        call = f"{made}({self._quoted(name)})"
        given = [*description.args, *(k.value for k in description.keywords if k.arg == "initial_entities")]
        if not given:
            edits = self._first_added(description, call)
        else:
            entities = self._source.resolved(given[0])
            edits = self._put_first(entities, call) if isinstance(entities, (ast.List, ast.Tuple)) else ()
        return (*imports, *edits) if edits else ()

    def pass_argument(self, include: Action, name: str, reference: str) -> tuple[Edit, ...]:
        """Pass the includer's own argument of that name on."""
        call = self._call(include)
        if call is None:
            return ()
        made, imports = self._imported(_SUBSTITUTIONS, "LaunchConfiguration")
        key, value = self._quoted(name), f"{made}({self._quoted(name)})"
        given = next((k.value for k in call.keywords if k.arg == "launch_arguments"), None)
        if given is None:
            edits = self._keyword_added(call, f"launch_arguments={{{key}: {value}}}.items()")
        else:
            pairs = self._source.resolved(given)
            if _is_items(pairs):
                pairs = self._source.resolved(pairs.func.value)  # type: ignore[attr-defined]
            if isinstance(pairs, ast.Dict):
                edits = self._put_last(pairs, pairs.values, f"{key}: {value}")
            elif isinstance(pairs, ast.List):
                edits = self._put_last(pairs, pairs.elts, f"({key}, {value})")
            else:
                edits = ()
        return (*imports, *edits) if edits else ()

    def add_remap(self, node: Action, source: str, target: str) -> tuple[Edit, ...]:
        """Remap a name of a node."""
        call = self._call(node)
        if call is None or last_name(call.func) not in NODES:
            return ()
        pair = f"({self._quoted(source)}, {self._quoted(target)})"
        given = next((k.value for k in call.keywords if k.arg == "remappings"), None)
        if given is None:
            return self._keyword_added(call, f"remappings=[{pair}]")
        pairs = self._source.resolved(given)
        return self._put_last(pairs, pairs.elts, pair) if isinstance(pairs, ast.List) else ()

    def remove(self, action: Action) -> tuple[Edit, ...]:
        """Remove an action from where it is listed or added, or a pair that an include or a node is given."""
        call = self._call(action)
        if call is not None:
            return self._without(call)
        literal = self._literal_at(action.kind_span)
        whole = literal is not None and literal.span == action.kind_span
        return self._without_pair(literal.node) if literal is not None and whole else ()

    def set_attribute(self, action: Action, name: str, value: str) -> tuple[Edit, ...]:
        """What an attribute is called in Python, and how it is written, is not known here."""
        return ()

    def remove_attribute(self, attribute: ActionAttribute) -> tuple[Edit, ...]:
        """Remove a keyword."""
        for call in self._calls():
            for keyword in call.keywords:
                if self._source.keyword_span(keyword) == attribute.name_span:
                    return self._keyword_removed(call, keyword)
        return ()

    def rename_element(self, action: Action, name: str) -> tuple[Edit, ...]:
        """Classes are no tags."""
        return ()

    def replace(self, span: Span, new: str, *, everywhere: bool = False) -> tuple[Edit, ...]:
        """Write `new` in the place of a part of a text that is written as one string, with its quotes. `everywhere`:
        also where the text goes to several things, for which it may be right or not."""
        literal = self._literal_at(span)
        if literal is None:
            return self._in_comment(span, new)
        if not (everywhere or self._uses.is_for_one(literal.node)):
            return ()
        if "\\" in self._text[literal.span.start : literal.span.end]:
            return ()
        written = new.replace("\\", "\\\\").replace(literal.quote, "\\" + literal.quote)
        if not new.isprintable() or (literal.raw and written != new):
            return ()
        return (Edit(self._document.location(span), written),)

    def literals_of(self, span: Span, text: str) -> tuple[Span, ...]:
        """Where a text is written that the expression at `span` is made of: in it, or in what its names stand for that
        are assigned once."""
        nodes: dict[int, ast.AST] = {}
        for node in self._nodes:
            if isinstance(node, ast.expr) and span in (self._source.span(node), self._source.whole_span(node)):
                waiting: list[ast.AST] = [node]
                while waiting:
                    each = waiting.pop()
                    if isinstance(each, ast.Name):
                        each = self._source.resolved(each)
                    if id(each) not in nodes:
                        nodes[id(each)] = each
                        waiting += ast.iter_child_nodes(each)
        texts = (
            each for on_line in self._texts.values() for each in on_line if each.value == text and id(each) in nodes
        )
        return tuple(each.span for each in filter(None, map(self._literal, texts)))

    def set_parameter(self, name: Span, old: object, new: object) -> tuple[Edit, ...]:
        """Give the parameter whose name is at a span another value, if the one that it has is written beside it."""
        literal = self._literal_at(name)
        holder = self._parents.get(id(literal.node)) if literal is not None else None
        if literal is None or literal.span != name or not isinstance(holder, ast.Dict) or isinstance(new, str):
            return ()
        value = next(
            (value for key, value in zip(holder.keys, holder.values, strict=True) if key is literal.node), None
        )
        if value is None or _plain(value) != old or type(_plain(value)) is not type(old):
            return ()
        return (Edit(self._document.location(self._source.whole_span(value)), repr(new)),)

    def rename_names(self, name: str, new: str) -> tuple[Edit, ...]:
        """Write another name in the place of one that nothing defines, wherever it is used."""
        nodes = [node for node in self._nodes if isinstance(node, ast.Name) and node.id == name]
        if not new.isidentifier() or not all(isinstance(node.ctx, ast.Load) for node in nodes):
            return ()
        return tuple(Edit(self._document.location(self._source.whole_span(node)), new) for node in nodes)

    def rename_keyword(self, span: Span, new: str) -> tuple[Edit, ...]:
        """Give the keyword of a call whose name is at `span` another name."""
        keywords = (node for node in self._nodes if isinstance(node, ast.keyword) and node.arg is not None)
        if not new.isidentifier() or all(self._source.keyword_span(each) != span for each in keywords):
            return ()
        return (Edit(self._document.location(span), new),)

    def write_expression(self, span: Span, substitutions: Sequence[str], code: str) -> tuple[Edit, ...]:
        """Write an expression in the place of what is at `span`, in which `{0}`, `{1}`, ... are these classes of
        `launch.substitutions` as the file calls them, or will."""
        found = [self._imported(_SUBSTITUTIONS, name) for name in substitutions]
        imports = (edit for _, edits in found for edit in edits)
        return (*imports, Edit(self._document.location(span), code.format(*(called for called, _ in found))))

    def insert_comma(self, offset: int) -> tuple[Edit, ...]:
        """Write a comma between two strings."""
        return (layout.insertion(self._document, offset, ","),)

    def add_data_files(self, folder: str, file: str) -> tuple[Edit, ...]:
        """One more entry of `data_files` in a setup.py, behind the last one."""
        for call in self._calls():
            for keyword in call.keywords:
                if keyword.arg == "data_files" and isinstance(keyword.value, ast.List) and keyword.value.elts:
                    entry = f"({self._quoted(folder)}, [{self._quoted(file)}])"
                    return self._put_last(keyword.value, keyword.value.elts, entry)
        return ()

    # What is inserted

    def _put_first(self, among: ast.List | ast.Tuple, item: str) -> tuple[Edit, ...]:
        """One more item before all others."""
        whole = self._source.whole_span(among)
        if not among.elts:
            at = whole.start + 1
            return (layout.insertion(self._document, at, item),) if isinstance(among, ast.List) else ()
        at = self._source.whole_span(among.elts[0]).start
        if self._text[whole.start] not in "[(" or "(" in self._text[whole.start + 1 : at]:
            return ()  # a tuple without brackets, or a first item in brackets of its own
        blanks = layout.blanks_before(self._document, at)
        between = f",{layout.newline(self._text)}{blanks}" if blanks is not None else ", "
        return (layout.insertion(self._document, at, item + between),)

    def _put_last(self, among: ast.expr, items: Sequence[ast.expr], item: str) -> tuple[Edit, ...]:
        """One more item behind all others, between brackets."""
        whole = self._source.whole_span(among)
        if not items:
            return (layout.insertion(self._document, whole.start + 1, item),)
        return self._behind(self._source.whole_span(items[-1]).end, whole.end - 1, items[-1], item)

    def _behind(self, end: int, close: int, last: ast.expr | ast.keyword, item: str) -> tuple[Edit, ...]:
        """What comes behind the last of what is between brackets. `close` is where the bracket is."""
        comma = _COMMA.match(self._text, end, close)
        if comma is None and self._text[end:close].strip(" \t\r\n") and not _only_comments(self._text[end:close]):
            return ()  # brackets of its own
        first = self._source.whole_span(last).start if isinstance(last, ast.expr) else self._start_of(last)
        blanks = layout.blanks_before(self._document, first)
        at = comma.end() if comma is not None else end
        between = f"{layout.newline(self._text)}{blanks}" if blanks is not None else " "
        before = "" if comma is not None else ","
        after = "," if comma is not None and blanks is not None else ""
        return (layout.insertion(self._document, at, f"{before}{between}{item}{after}"),)

    def _keyword_added(self, call: ast.Call, written: str) -> tuple[Edit, ...]:
        """One more keyword of a call."""
        given: list[ast.expr | ast.keyword] = sorted(
            [*call.args, *call.keywords], key=lambda each: (each.lineno, each.col_offset)
        )
        close = self._source.whole_span(call).end - 1
        if not given:
            return (layout.insertion(self._document, close, written),)
        last = given[-1]
        end = self._source.whole_span(last.value if isinstance(last, ast.keyword) else last).end
        return self._behind(end, close, last, written)

    def _first_added(self, description: ast.Call, call: str) -> tuple[Edit, ...]:
        """`ld.add_action(...)` right behind `ld = LaunchDescription()`."""
        for node in self._nodes:
            if isinstance(node, ast.Assign) and node.value is description and isinstance(node.targets[0], ast.Name):
                line, _ = self._document.lines.position(self._source.whole_span(description).end)
                at = self._document.lines.line_span(line).end
                indent, end = layout.indent_of(self._document, at - 1), layout.newline(self._text)
                if self._text[at - 1 : at] != "\n":
                    return ()
                return (layout.insertion(self._document, at, f"{indent}{node.targets[0].id}.add_action({call}){end}"),)
        return ()

    def _imported(self, module: str, name: str) -> tuple[str, tuple[Edit, ...]]:
        """How a class of a module is called in the file, and what imports it where nothing does."""
        body = self._source.module.body if self._source.module is not None else []
        imports = [node for node in body if isinstance(node, ast.ImportFrom) and not node.level]
        for node in imports:
            known = next((a for a in node.names if node.module == module and a.name == name), None)
            if known is not None:
                return known.asname or name, ()
        for plain in body:
            for alias in plain.names if isinstance(plain, ast.Import) else ():
                if alias.name in ("launch", module) and (alias.asname is None or alias.name == module):
                    return f"{alias.asname or module}.{name}", ()
        return name, self._import_added(imports, module, name)

    def _import_added(self, imports: Sequence[ast.ImportFrom], module: str, name: str) -> tuple[Edit, ...]:
        same = next((node for node in imports if node.module == module and node.names[0].name != "*"), None)
        if same is not None:
            # In the order of the names, where they have one.
            after = next((alias for alias in same.names if alias.name > name), None)
            if after is not None:
                return (layout.insertion(self._document, self._start_of(after), f"{name}, "),)
            last = same.names[-1]
            end = self._offset(last.end_lineno or last.lineno, last.end_col_offset or 0)
            return (layout.insertion(self._document, end, f", {name}"),)
        others = [node for node in imports if (node.module or "").split(".")[0] in _IMPORTED_FROM]
        before = [node for node in others if (node.module or "") < module]
        body = self._source.module.body if self._source.module is not None else []
        line = f"from {module} import {name}{layout.newline(self._text)}"
        if before:
            number = before[-1].end_lineno or before[-1].lineno
        elif others:
            number = others[0].lineno - 1
        else:
            known = [node for node in body if isinstance(node, (ast.Import, ast.ImportFrom))]
            if not known:
                return (layout.insertion(self._document, self._start_of(body[0]), line),) if body else ()
            number = known[-1].end_lineno or known[-1].lineno
        return (layout.insertion(self._document, self._document.lines.line_start(number), line),)

    # What is removed

    def _without(self, call: ast.Call) -> tuple[Edit, ...]:
        """Without an action: its item of a list, its statement, and those of the name that stands for it."""
        parent = self._parents.get(id(call))
        if isinstance(parent, (ast.List, ast.Tuple)):
            return self._item_removed(parent, parent.elts, call)
        statement = self._parents.get(id(parent)) if isinstance(parent, ast.Call) else None
        added = isinstance(parent, ast.Call) and last_name(parent.func) == "add_action" and parent.args == [call]
        if added and isinstance(statement, ast.Expr):
            return self._statement_removed(statement)
        if not isinstance(parent, ast.Assign) or len(parent.targets) != 1:
            return ()
        (target,) = parent.targets
        if not isinstance(target, ast.Name) or self._source.assigned.get(target.id) is not call:
            return ()
        edits = [*self._statement_removed(parent)]
        for node in self._nodes:
            if isinstance(node, ast.Name) and node.id == target.id and node is not target:
                edit = self._use_removed(node)
                if not edit or not edits:
                    return ()
                edits += edit
        return tuple(edits)

    def _use_removed(self, name: ast.Name) -> tuple[Edit, ...]:
        parent = self._parents.get(id(name))
        if isinstance(parent, (ast.List, ast.Tuple)):
            return self._item_removed(parent, parent.elts, name)
        statement = self._parents.get(id(parent)) if isinstance(parent, ast.Call) else None
        if isinstance(parent, ast.Call) and last_name(parent.func) == "add_action" and parent.args == [name]:
            return self._statement_removed(statement) if isinstance(statement, ast.Expr) else ()
        return ()

    def _statement_removed(self, statement: ast.stmt) -> tuple[Edit, ...]:
        parent = self._parents.get(id(statement))
        body = getattr(parent, "body", ())
        if len(body) < 2 or statement not in body:
            return ()
        start = self._offset(statement.lineno, statement.col_offset)
        end = self._offset(statement.end_lineno or statement.lineno, statement.end_col_offset or 0)
        if layout.blanks_before(self._document, start) is None or not layout.ends_line(self._text, end):
            return ()
        return (layout.removal(self._document, Span(start, end)),)

    def _without_pair(self, key: ast.Constant) -> tuple[Edit, ...]:
        """Without a pair, and without what it is all of."""
        parent = self._parents.get(id(key))
        holder: ast.expr
        if isinstance(parent, ast.Dict) and key in parent.keys:
            holder, items = parent, list(zip(parent.keys, parent.values, strict=True))
            if len(items) > 1:
                at = next(number for number, (first, _) in enumerate(items) if first is key)
                spans = [self._of_pair(first, second) for first, second in items]
                return self._taken_out(spans, at, self._source.whole_span(parent).end - 1)
        elif isinstance(parent, ast.Tuple) and isinstance(
            above := self._parents.get(id(parent)), (ast.List, ast.Tuple)
        ):
            holder = above
            if len(above.elts) > 1:
                return self._item_removed(above, above.elts, parent)
        else:
            return ()
        around = self._parents.get(id(holder))
        if isinstance(around, ast.Attribute) and isinstance(call := self._parents.get(id(around)), ast.Call):
            holder, around = call, self._parents.get(id(call))
        if isinstance(around, ast.keyword):
            owner = self._parents.get(id(around))
            return self._keyword_removed(owner, around) if isinstance(owner, ast.Call) else ()
        return ()

    def _of_pair(self, key: ast.expr | None, value: ast.expr) -> Span:
        end = self._source.whole_span(value)
        start = self._source.whole_span(key).start if key is not None else self._text.rfind("**", 0, end.start)
        return Span(start, end.end)

    def _item_removed(self, among: ast.List | ast.Tuple, items: Sequence[ast.expr], item: ast.expr) -> tuple[Edit, ...]:
        if isinstance(among, ast.Tuple) and len(items) <= 2:
            return ()  # a pair, or what would be no tuple
        spans = [self._source.whole_span(each) for each in items]
        at = next(number for number, each in enumerate(items) if each is item)
        return self._taken_out(spans, at, self._source.whole_span(among).end - 1)

    def _keyword_removed(self, call: ast.Call, keyword: ast.keyword) -> tuple[Edit, ...]:
        spans = sorted(
            [
                *(self._source.whole_span(each) for each in call.args),
                *(Span(self._start_of(each), self._source.whole_span(each.value).end) for each in call.keywords),
            ]
        )
        at = next(number for number, span in enumerate(spans) if span.start == self._start_of(keyword))
        return self._taken_out(spans, at, self._source.whole_span(call).end - 1)

    def _taken_out(self, spans: Sequence[Span], at: int, close: int) -> tuple[Edit, ...]:
        """Without one of what stands between brackets, its comma, and its line where that is left without anything."""
        start, end = spans[at]
        comma = _COMMA.match(self._text, end, spans[at + 1].start if at + 1 < len(spans) else close)
        if comma is not None and comma.end() <= (spans[at + 1].start if at + 1 < len(spans) else close):
            whole = Span(start, comma.end())
            edit = layout.removal(self._document, whole)
            if edit.location.span != whole:
                return (edit,)
            if at + 1 < len(spans):
                return (Edit(self._document.location(Span(start, spans[at + 1].start)), ""),)
            if not at:
                return (edit,)
            return (Edit(self._document.location(Span(spans[at - 1].end, end)), ""),)
        if self._text[end : spans[at + 1].start if at + 1 < len(spans) else close].strip():
            return ()  # brackets of its own, or a comment in the way
        if at:
            return (Edit(self._document.location(Span(spans[at - 1].end, end)), ""),)
        return (layout.removal(self._document, Span(start, end)),)

    # What there is

    def _call(self, action: Action) -> ast.Call | None:
        """The call that an action is made by."""
        return next((call for call in self._calls() if self._source.name_span(call) == action.kind_span), None)

    def _calls(self) -> Iterator[ast.Call]:
        return (node for node in self._nodes if isinstance(node, ast.Call))

    @property
    def _nodes(self) -> tuple[ast.AST, ...]:
        return self._source.nodes if self._source.module is not None else ()

    @cached_property
    def _parents(self) -> dict[int, ast.AST]:
        return {id(child): node for node in self._nodes for child in ast.iter_child_nodes(node)}

    @cached_property
    def _uses(self) -> PythonUses:
        return PythonUses(self._nodes, self._parents)

    def _literal_at(self, span: Span) -> _Literal | None:
        """The text that has all of a span."""
        line, _ = self._document.lines.position(span.start)
        found = filter(None, map(self._literal, self._texts.get(line + 1, ())))
        return next((each for each in found if _covers(each.span, span)), None)

    @cached_property
    def _texts(self) -> dict[int, list[ast.Constant]]:
        """The texts on each line, counted from 1, but for parts of texts with values in them."""
        parts = {id(part) for node in self._nodes if isinstance(node, ast.JoinedStr) for part in node.values}
        found: dict[int, list[ast.Constant]] = {}
        for node in self._nodes:
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in parts:
                found.setdefault(node.lineno, []).append(node)
        return found

    def _literal(self, node: ast.Constant) -> _Literal | None:
        """A text that is written as one string on one line."""
        if node.lineno != node.end_lineno:
            return None
        whole = self._source.whole_span(node)
        written = self._text[whole.start : whole.end]
        begun = _STRING.match(written)
        if begun is None or not written.endswith(begun[2]) or len(written) < begun.end() + len(begun[2]):
            return None
        span = Span(whole.start + begun.end(), whole.end - len(begun[2]))
        # Several strings side by side are one text, too.
        if re.search(rf"(?<!\\){begun[2][0]}", self._text[span.start : span.end]) is not None:
            return None
        return _Literal(node, span, begun[2][0], "r" in begun[1].lower())

    def _start_of(self, node: ast.keyword | ast.alias | ast.stmt) -> int:
        return self._offset(node.lineno, node.col_offset)

    def _offset(self, line: int, column: int) -> int:
        """`column` is in bytes."""
        start, end = self._document.lines.line_span(line - 1)
        return start + len(self._text[start:end].encode()[:column].decode(errors="replace"))

    def _quoted(self, text: str) -> str:
        """A text in the quotes that the file prefers."""
        return repr(text) if self._text.count("'") >= self._text.count('"') else _in_double_quotes(text)


def _plain(node: ast.expr) -> object:
    """The value of a literal; None of what is none."""
    try:
        found: object = ast.literal_eval(node)
    except (ValueError, TypeError, SyntaxError, MemoryError, RecursionError):
        return None
    return found


def _in_double_quotes(text: str) -> str:
    written = repr(text)
    return f'"{written[1:-1]}"' if written[0] == "'" and '"' not in written else written


def _is_items(node: ast.expr) -> bool:
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "items"


def _only_comments(text: str) -> bool:
    return all(not line.strip() or line.lstrip().startswith("#") for line in text.splitlines())


def _covers(whole: Span, part: Span) -> bool:
    return whole.start <= part.start and part.end <= whole.end
