"""Goes through the code of a launch file, over Python's own values. It executes nothing: each statement and expression
that it knows is done here, functions and classes of the program are values of ours, and of Python it gets what
`values.py` names.

What only a run knows is a stand-in (`agents/anything.py`), as what nobody knows is in a run: texts made of it are
marked, and where the program asks whether it holds, that is noted.
"""

from __future__ import annotations

import ast
import builtins
import operator
import time
import types
from collections.abc import Callable, Iterator
from pathlib import PosixPath, PurePosixPath
from typing import Any, NamedTuple, Protocol

from preflight_analysis.incremental.database import Cancelled
from preflight_analysis.tracing.agents.anything import Anything, UnknownText, is_unknown, marked
from preflight_analysis.tracing.agents.fake_launch import rewritten
from preflight_analysis.tracing.reading.natives import Natives, check_search
from preflight_analysis.tracing.reading.scopes import Scope, names_of
from preflight_analysis.tracing.reading.values import (
    MAX_TEXT,
    METHODS,
    Function,
    Module,
    NotRead,
    Raised,
    Wrapped,
    check_key,
    check_keys,
    check_operation,
    check_size,
    is_fake,
    is_program_class,
    is_unknown_object,
    may_have,
    whole,
)

MAX_STEPS = 200_000
MAX_SECONDS = 1.0
"""Of the processor, after the first half second: how busy the machine is changes nothing."""
_UNMEASURED = 0.5
MAX_WRITTEN = 10_000
"""Characters of a text of which is known where it is written."""
MAX_CALLS = 40
"""Of functions of the program, one in the other."""
_CHECK = 500
_BREAK, _CONTINUE = object(), object()
_OPERATORS: dict[str, Callable[[Any, Any], Any]] = {
    **{"Add": operator.add, "Sub": operator.sub, "Mult": operator.mul, "Div": operator.truediv},
    **{"FloorDiv": operator.floordiv, "Mod": operator.mod, "Pow": operator.pow, "BitOr": operator.or_},
    **{"BitAnd": operator.and_, "BitXor": operator.xor, "LShift": operator.lshift, "RShift": operator.rshift},
}
_IN_PLACE: dict[str, Callable[[Any, Any], Any]] = {
    **{"Add": operator.iadd, "Sub": operator.isub, "Mult": operator.imul, "BitOr": operator.ior},
    **{"BitAnd": operator.iand},
}
_COMPARISONS: dict[str, Callable[[Any, Any], Any]] = {
    **{"Eq": operator.eq, "NotEq": operator.ne, "Lt": operator.lt, "LtE": operator.le, "Gt": operator.gt},
    **{"GtE": operator.ge, "Is": operator.is_, "IsNot": operator.is_not},
}
_UNARY: dict[str, Callable[[Any], Any]] = {"USub": operator.neg, "UAdd": operator.pos, "Invert": operator.invert}
_SPECIAL = frozenset(
    (
        *("__init__", "__str__", "__repr__", "__eq__", "__ne__", "__call__", "__getitem__", "__setitem__", "__len__"),
        *("__contains__", "__iter__", "__enter__", "__exit__", "__add__", "__radd__", "__lt__", "__le__", "__gt__"),
        *("__ge__", "__post_init__", "__doc__", "__annotations__", "__bool__", "__truediv__", "__module__"),
        *("__qualname__", "__slots__", "__fspath__", "__getattr__", "__next__", "__or__", "__hash__"),
    )
)
_KEPT = (list, tuple, set, frozenset, dict)
_MAKING = (ast.JoinedStr, ast.BinOp, ast.Call)
"""Expressions that make texts."""


class Return:
    """A function ends with a value."""

    def __init__(self, value: Any) -> None:
        self.value = value


class Frame:
    """Code that is being gone through: of which file, and where in it."""

    __slots__ = ("file", "first", "generated", "name", "node", "owner", "tries")

    def __init__(self, file: str, name: str, node: Any) -> None:
        self.file, self.name, self.node = file, name, node
        self.tries: list[ast.Try] = []
        self.owner: Any = None
        self.first: Any = None
        self.generated: list[Any] | None = None


class Around(Protocol):
    """What the program has around it."""

    def module(self, name: str, frame: Frame, level: int) -> Any:
        """An imported module; raises `Raised` where there is none."""

    def builtin(self, name: str) -> Any:
        """A built-in function; raises KeyError."""

    def unknown(self, name: str, reason: str) -> Any:
        """A stand-in for what only a run knows, which is noted."""

    def instead(self, function: Any) -> Any:
        """What is called in the place of a function of Python or of the fakes; None where it is that itself, raises
        `NotRead` where it may not be called."""

    def member(self, module: Module, name: str) -> Any:
        """What a module has that is not in its contents; raises `Raised`."""


class Interpreter:
    """One reading."""

    def __init__(self, around: Around, file: str, written: dict[int, tuple[Any, list[int]]]) -> None:
        self.around, self.file = around, file
        self.written = written
        """Texts by `id`, with the places in `file` of the expressions that make them."""
        self._literals: dict[ast.Constant, str] = {}
        self.frames: list[Frame] = []
        self.natives = Natives(self)
        self._names: dict[Any, Any] = {}
        self._steps = 0
        self._began = time.monotonic()
        self._ends: float | None = None
        self._expressions: dict[type, Callable[[Any, Scope], Any]] = {
            getattr(ast, name[6:]): getattr(self, name) for name in dir(self) if name.startswith("_expr_")
        }
        self._statements: dict[type, Callable[[Any, Scope], Any]] = {
            getattr(ast, name[6:]): getattr(self, name) for name in dir(self) if name.startswith("_stmt_")
        }

    # Frames

    def run_module(self, tree: ast.Module, file: str, contents: dict[str, Any]) -> None:
        """Go through the code of a file; what it defines is in `contents` then."""
        frame = Frame(file, "<module>", tree)
        self._enter(frame)
        try:
            self.block(tree.body, Scope(contents, None, contents, None))
        except Raised as raised:
            self._note_frame(raised, frame)
            raise
        finally:
            self.frames.pop()

    def expression(self, node: ast.expr, values: dict[str, Any]) -> Any:
        """The value of an expression by itself."""
        frame = Frame("<expression>", "<expression>", node)
        self._enter(frame)
        try:
            return self.evaluate(node, Scope(values, None, values, None))
        finally:
            self.frames.pop()

    def _enter(self, frame: Frame) -> None:
        if len(self.frames) >= MAX_CALLS:
            raise NotRead("calls are too deep")
        self.frames.append(frame)

    def _note_frame(self, raised: Raised, frame: Frame) -> None:
        raised.frames.insert(0, [frame.file, getattr(frame.node, "lineno", 0), frame.name])

    @property
    def frame(self) -> Frame:
        """The code that is gone through now."""
        return self.frames[-1]

    def place_in(self, file: str) -> list[int] | None:
        """Line and column of what a file does now."""
        for frame in reversed(self.frames):
            if frame.file == file:
                return [getattr(frame.node, "lineno", 0), getattr(frame.node, "col_offset", -1)]
        return None

    @property
    def steps(self) -> int:
        """How much was done."""
        return self._steps

    @property
    def asks(self) -> str:
        """Where it asks for something now: the places of all calls that lead there."""
        places = ((getattr(frame.node, "lineno", 0), getattr(frame.node, "col_offset", -1)) for frame in self.frames)
        return "/".join(f"{line}:{column}" for line, column in places)

    def is_provided_for(self, errors: Any, catches: Callable[[Any, Any], bool], ends: Callable[[Any], bool]) -> bool:
        """Whether the code that is gone through now stands in a `try` that handles one of the errors."""
        return any(
            catches(handler.type, errors) and not ends(handler)
            for each in self.frame.tries
            for handler in each.handlers
        )

    def step(self, count: int = 1) -> None:
        """Some more was done."""
        before = self._steps
        self._steps += count
        if before // _CHECK != self._steps // _CHECK and (self._steps > MAX_STEPS or self._is_late()):
            raise NotRead("it takes too long")

    def _is_late(self) -> bool:
        if time.monotonic() - self._began < _UNMEASURED:
            return False  # asking for the time of the processor takes its time
        now = time.thread_time()
        if self._ends is None:
            self._ends = now + MAX_SECONDS
        return now > self._ends

    def made(self, value: Any) -> Any:
        """A value that was made; all of them together are bounded."""
        check_size(value)
        if isinstance(value, int) and value.bit_length() > 60:
            self.step(50)  # a few have one hash
        elif isinstance(value, (str, bytes)):
            if len(value) > 1000:
                self.step(len(value) // 64)
        elif isinstance(value, (list, tuple, dict, set, frozenset)) and len(value) > 100:
            self.step(len(value) // 4)
        return value

    # Statements

    def block(self, body: list[ast.stmt], scope: Scope) -> Any:
        """The statements of a block; what ended it early."""
        for statement in body:
            self.step()
            self.frame.node = statement
            does = self._statements.get(type(statement))
            if does is None:
                raise NotRead(f"{type(statement).__name__} is not read")
            ended = does(statement, scope)
            if ended is not None:
                return ended
        return None

    def _stmt_Expr(self, node: ast.Expr, scope: Scope) -> None:
        self.evaluate(node.value, scope)

    def _stmt_Pass(self, node: ast.Pass, scope: Scope) -> None:
        pass

    def _stmt_Break(self, node: ast.Break, scope: Scope) -> Any:
        return _BREAK

    def _stmt_Continue(self, node: ast.Continue, scope: Scope) -> Any:
        return _CONTINUE

    def _stmt_Return(self, node: ast.Return, scope: Scope) -> Any:
        return Return(None if node.value is None else self.evaluate(node.value, scope))

    def _stmt_Global(self, node: ast.Global, scope: Scope) -> None:
        pass

    _stmt_Nonlocal = _stmt_Global

    def _stmt_Assign(self, node: ast.Assign, scope: Scope) -> None:
        value = self.evaluate(node.value, scope)
        count = rewritten._count(node.targets[0]) if len(node.targets) == 1 else 0
        if count and not isinstance(node.value, (ast.Tuple, ast.List)):
            value = rewritten._parts(value, count)
        for target in node.targets:
            self._assign(target, value, scope)

    def _stmt_AnnAssign(self, node: ast.AnnAssign, scope: Scope) -> None:
        if scope.is_class and isinstance(node.target, ast.Name):
            written = ast.unparse(node.annotation)
            scope.values.setdefault("__annotations__", {})[node.target.id] = written
        if node.value is not None:
            self._assign(node.target, self.evaluate(node.value, scope), scope)

    def _stmt_AugAssign(self, node: ast.AugAssign, scope: Scope) -> None:
        if isinstance(node.target, ast.Name):
            before = self._name(node.target.id, scope)
            self._assign(node.target, self._augmented(node, before, scope), scope)
        elif isinstance(node.target, ast.Attribute):
            thing = self.evaluate(node.target.value, scope)
            name = self._mangled(node.target.attr, scope)
            after = self._augmented(node, self.attribute(thing, name), scope)
            self.set_attribute(thing, name, after)
        elif isinstance(node.target, ast.Subscript):
            thing, key = self.evaluate(node.target.value, scope), self.evaluate(node.target.slice, scope)
            after = self._augmented(node, self._native(lambda: rewritten._of(thing)[key]), scope)
            self._set_item(thing, key, after)

    def _augmented(self, node: ast.AugAssign, before: Any, scope: Scope) -> Any:
        value = self.evaluate(node.value, scope)
        self.frame.node = node
        name = type(node.op).__name__
        return self.operated(name, before, value, _IN_PLACE.get(name))

    def operated(self, name: str, left: Any, right: Any, function: Any = None) -> Any:
        """What an operator gives."""
        if name == "Add" and function is not None and isinstance(left, list) and not isinstance(right, (list, tuple)):
            right = right if is_unknown_object(right) else self.natives.each(right)
        check_operation(name, left, right)
        if name == "Mod" and isinstance(left, (str, bytes)):
            return self.shown(self.made(marked(self._native(self.natives.percent, left, right))))
        function = function or _OPERATORS.get(name)
        if function is None:
            raise NotRead("an operator")
        return self.made(marked(self._native(function, left, right)))

    def _stmt_Delete(self, node: ast.Delete, scope: Scope) -> None:
        for target in node.targets:
            if isinstance(target, ast.Name):
                scope.remove(target.id)
            elif isinstance(target, ast.Subscript):
                thing, key = self.evaluate(target.value, scope), self.evaluate(target.slice, scope)
                self._native(operator.delitem, thing, key)
            else:
                raise NotRead("del of an attribute")

    def _stmt_If(self, node: ast.If, scope: Scope) -> Any:
        return self.block(node.body if self.truth(node.test, scope) else node.orelse, scope)

    def _stmt_While(self, node: ast.While, scope: Scope) -> Any:
        while self.truth(node.test, scope):
            self.step()
            ended = self.block(node.body, scope)
            if ended is _BREAK:
                return None
            if isinstance(ended, Return):
                return ended
        return self.block(node.orelse, scope)

    def _stmt_For(self, node: ast.For, scope: Scope) -> Any:
        count = rewritten._count(node.target)
        values = self.evaluate(node.iter, scope)
        self.frame.node = node.iter
        for value in self.each(values):
            self._assign(node.target, rewritten._parts(value, count) if count else value, scope)
            ended = self.block(node.body, scope)
            if ended is _BREAK:
                return None
            if isinstance(ended, Return):
                return ended
        return self.block(node.orelse, scope)

    def each(self, values: Any) -> Iterator[Any]:
        """What a loop goes through."""
        if isinstance(values, (set, frozenset)):
            values = self.in_order(values)
        found = self._native(iter, values)
        while True:
            self.step()
            try:
                value = self._native(next, found)
            except Raised as raised:
                if isinstance(raised.error, StopIteration):
                    return
                raise
            yield value

    def in_order(self, values: Any) -> Any:
        """The items of a set; a run has those with texts in an order of its own."""
        if len(values) > 1 and any(not isinstance(each, (int, float, type(None))) for each in values):
            self.around.unknown("a set", "the order of its items is another one in each launch")
        return list(values)

    def _stmt_Try(self, node: ast.Try, scope: Scope) -> Any:
        frame = self.frame
        depth = len(self.frames)
        frame.tries.append(node)
        raised: Raised | None = None
        ended: Any = None
        try:
            ended = self.block(node.body, scope)
        except Raised as caught:
            raised = caught
        finally:
            frame.tries.pop()
        if raised is not None:
            del self.frames[depth:]
            ended = self._handled(node, raised, scope)
        elif ended is None and node.orelse:
            try:
                ended = self.block(node.orelse, scope)
            except Raised:
                self._finally(node, scope)
                raise
        finally_ended = self.block(node.finalbody, scope) if node.finalbody else None
        return finally_ended or ended

    def _handled(self, node: ast.Try, raised: Raised, scope: Scope) -> Any:
        error = raised.error
        for handler in node.handlers:
            kind = self.evaluate(handler.type, scope) if handler.type is not None else BaseException
            if not _matches(error, kind):
                continue
            if handler.name is not None:
                scope.set(handler.name, error)
            before, scope.handled = scope.handled, raised
            try:
                return self.block(handler.body, scope)
            except Raised:
                self._finally(node, scope)
                raise
            finally:
                scope.handled = before
        self._finally(node, scope)
        raise raised

    def _finally(self, node: ast.Try, scope: Scope) -> None:
        if node.finalbody:
            self.block(node.finalbody, scope)

    def _stmt_Raise(self, node: ast.Raise, scope: Scope) -> None:
        if node.exc is None:
            if scope.handled is None:
                raise NotRead("raise without an exception")
            raise scope.handled
        error = self.evaluate(node.exc, scope)
        if isinstance(error, type) and issubclass(error, BaseException):
            error = self._native(error)
        self.frame.node = node
        if not isinstance(error, BaseException):
            raise NotRead("raise of what is no exception")
        raise Raised(error)

    def _stmt_Assert(self, node: ast.Assert, scope: Scope) -> None:
        if not self.truth(node.test, scope):
            message = (self.evaluate(node.msg, scope),) if node.msg is not None else ()
            raise Raised(AssertionError(*message))

    def _stmt_With(self, node: ast.With, scope: Scope) -> Any:
        return self._with(node, 0, scope)

    def _with(self, node: ast.With, index: int, scope: Scope) -> Any:
        if index == len(node.items):
            return self.block(node.body, scope)
        item = node.items[index]
        manager = self.evaluate(item.context_expr, scope)
        enter, leave = (getattr(type(manager), name, None) for name in ("__enter__", "__exit__"))
        if enter is None or leave is None or not self.is_ours(manager):
            raise NotRead("with of something unknown")
        value = self._native(enter, manager)
        if item.optional_vars is not None:
            self._assign(item.optional_vars, value, scope)
        try:
            ended = self._with(node, index + 1, scope)
        except Raised as raised:
            if self._native(leave, manager, type(raised.error), raised.error, None):
                return None
            raise
        self._native(leave, manager, None, None, None)
        return ended

    def is_ours(self, thing: Any) -> bool:
        """Whether its special methods are the program's or ours."""
        kind = type(thing)
        return is_program_class(kind) or kind.__module__.startswith("preflight_analysis.")

    def _stmt_Import(self, node: ast.Import, scope: Scope) -> None:
        for alias in node.names:
            module = self.around.module(alias.name, self.frame, 0)
            if alias.asname is None:
                scope.set(alias.name.partition(".")[0], self.around.module(alias.name.partition(".")[0], self.frame, 0))
            else:
                scope.set(alias.asname, module)

    def _stmt_ImportFrom(self, node: ast.ImportFrom, scope: Scope) -> None:
        if node.module == "__future__":
            return
        module = self.around.module(node.module or "", self.frame, node.level)
        for alias in node.names:
            if alias.name != "*":
                scope.set(alias.asname or alias.name, self._imported(module, alias.name))
            elif isinstance(module, Module):
                listed = module.contents.get("__all__")
                for name in list(module.contents) if listed is None else list(listed):
                    if listed is not None or not name.startswith("_"):
                        scope.set(name, self._imported(module, name))
            else:
                raise NotRead("import * of a module that is not read")

    def _imported(self, module: Any, name: str) -> Any:
        if not isinstance(module, Module):
            return self.attribute(module, name)
        if name in module.contents:
            return self.given(module.contents[name])
        try:
            return self.given(self.around.member(module, name))
        except Raised as raised:
            if not isinstance(raised.error, AttributeError):
                raise
        where = module.file or "unknown location"
        message = f"cannot import name '{name}' from '{module.name}' ({where})"
        raise Raised(ImportError(message, name=module.name, path=module.file))

    def _stmt_FunctionDef(self, node: ast.FunctionDef, scope: Scope) -> None:
        function: Any = self._function(node, node.name, node.body, scope)
        scope.set(node.name, self._decorated(node, function, scope))

    def _stmt_AsyncFunctionDef(self, node: ast.AsyncFunctionDef, scope: Scope) -> None:
        scope.set(node.name, self.around.unknown(node.name, "coroutines are not read"))

    def _decorated(self, node: Any, thing: Any, scope: Scope) -> Any:
        for each in reversed(node.decorator_list):
            decorator = self.evaluate(each, scope)
            thing = thing if is_unknown_object(decorator) else self.call(decorator, (thing,), {})
        return thing

    def _stmt_ClassDef(self, node: ast.ClassDef, scope: Scope) -> None:
        bases = [self.evaluate(each, scope) for each in node.bases]
        if node.keywords:
            bases += [self.evaluate(each.value, scope) for each in node.keywords if each.arg != "metaclass"]
            if any(each.arg != "metaclass" or ast.unparse(each.value) not in _ABSTRACT for each in node.keywords):
                scope.set(node.name, self.around.unknown(node.name, "classes with a metaclass are not read"))
                return
        values: dict[str, Any] = {"__module__": "python_launch_file", "__qualname__": scope.qualified(node.name)}
        inner = Scope(values, scope, scope.globals, None, of="class", name=values["__qualname__"])
        self.block(node.body, inner)
        own = {self._mangled(name, inner): value for name, value in values.items()}
        scope.set(node.name, self._decorated(node, self._class(node.name, tuple(bases), own), scope))

    def _class(self, name: str, bases: tuple[Any, ...], values: dict[str, Any]) -> Any:
        for each in bases:
            is_known = isinstance(each, type) and (is_program_class(each) or is_fake(each) or each in _BASES)
            if not is_known and not isinstance(each, Anything):
                return self.around.unknown(name, "a class that is made from one of Python is not read")
        odd = [n for n in values if n.startswith("__") and n.endswith("__") and n not in _SPECIAL]
        if odd:
            return self.around.unknown(name, f"a class with {odd[0]} is not read")
        if values["__module__"] != "python_launch_file" or "preflight_interpreted" in values:
            raise NotRead("a class of another module")
        values["preflight_interpreted"] = True
        kind = self._native(types.new_class, name, bases, {}, lambda body: body.update(values))
        for each in values.values():
            function = getattr(each, "__func__", each)
            function = function.fget if isinstance(function, property) else function
            code = getattr(getattr(function, "call", None), "__self__", None)
            if isinstance(code, _Code):
                code.owner = kind
        return kind

    def _stmt_Match(self, node: Any, scope: Scope) -> Any:
        subject = self.evaluate(node.subject, scope)
        for case in node.cases:
            if self._fits(case.pattern, node.subject, subject, scope) and (
                case.guard is None or self.truth(case.guard, scope)
            ):
                return self.block(case.body, scope)
        return None

    def _fits(self, pattern: Any, asked: ast.expr, subject: Any, scope: Scope) -> bool:
        if isinstance(pattern, ast.MatchValue):
            self.frame.node = ast.copy_location(ast.Compare(asked, [ast.Eq()], [pattern.value]), pattern)
            return self.holds(self._native(operator.eq, marked(subject), self.evaluate(pattern.value, scope)))
        if isinstance(pattern, ast.MatchSingleton):
            return subject is pattern.value
        if isinstance(pattern, ast.MatchOr):
            return any(self._fits(each, asked, subject, scope) for each in pattern.patterns)
        if isinstance(pattern, ast.MatchAs):
            if pattern.pattern is not None and not self._fits(pattern.pattern, asked, subject, scope):
                return False
            if pattern.name is not None:
                scope.set(pattern.name, subject)
            return True
        raise NotRead("a pattern")

    # Targets

    def _assign(self, target: ast.expr, value: Any, scope: Scope) -> None:
        if isinstance(target, ast.Name):
            scope.set(target.id, value)
        elif isinstance(target, (ast.Tuple, ast.List)):
            self._unpack(target.elts, value, scope)
        elif isinstance(target, ast.Attribute):
            self.set_attribute(self.evaluate(target.value, scope), self._mangled(target.attr, scope), value)
        elif isinstance(target, ast.Subscript):
            self._set_item(self.evaluate(target.value, scope), self.evaluate(target.slice, scope), value)
        else:
            raise NotRead("a target")

    def _unpack(self, targets: list[ast.expr], value: Any, scope: Scope) -> None:
        if is_unknown_object(value):
            for each in targets:
                self._assign(each.value if isinstance(each, ast.Starred) else each, value[0], scope)
            return
        values = list(self.each(value))
        starred = next((i for i, each in enumerate(targets) if isinstance(each, ast.Starred)), None)
        if starred is not None:
            if len(values) < len(targets) - 1:
                message = f"not enough values to unpack (expected at least {len(targets) - 1}, got {len(values)})"
                raise Raised(ValueError(message))
            behind = len(targets) - starred - 1
            middle = values[starred : len(values) - behind]
            values = [*values[:starred], middle, *values[len(values) - behind :]]
        elif len(values) > len(targets):
            raise Raised(ValueError(f"too many values to unpack (expected {len(targets)})"))
        elif len(values) < len(targets):
            raise Raised(ValueError(f"not enough values to unpack (expected {len(targets)}, got {len(values)})"))
        for each, part in zip(targets, values, strict=True):
            self._assign(each.value if isinstance(each, ast.Starred) else each, part, scope)

    def _set_item(self, thing: Any, key: Any, value: Any) -> None:
        if not (isinstance(thing, (list, dict)) or is_unknown_object(thing) or self.is_ours(thing)):
            if isinstance(thing, (str, tuple, int, type(None))):
                self._native(operator.setitem, thing, key, value)
            raise NotRead("an item is set")
        check_size(thing)
        check_key(key)
        if isinstance(key, slice) and isinstance(thing, list):
            value = self.natives.each(value)
        self._native(operator.setitem, thing, key, value)

    def set_attribute(self, thing: Any, name: str, value: Any) -> None:
        """What `thing.name = value` does."""
        if is_unknown_object(thing) and not is_program_class(type(thing)):
            return
        is_known = is_program_class(type(thing)) or is_program_class(thing)
        if isinstance(thing, Function) and not name.startswith("__"):
            thing.members[name] = value
        elif isinstance(thing, Module) and thing.file is not None:
            thing.contents[name] = value
        elif is_known and not name.startswith(("__", "preflight")):
            self._native(setattr, thing, name, value)
        else:
            raise NotRead("an attribute is set")

    # Expressions

    def evaluate(self, node: Any, scope: Scope) -> Any:
        """The value of an expression."""
        self.step()
        does = self._expressions.get(type(node))
        if does is None:
            raise NotRead(f"{type(node).__name__} is not read")
        value = does(node, scope)
        return self._written(value, node) if type(value) is str and type(node) in _MAKING else value

    def _written(self, text: str, node: Any) -> str:
        """A text that an expression makes, as one that is known to be written there: what is made of one thing in two
        places is one object otherwise. Of what is written elsewhere that is known already."""
        if id(text) in self.written or self.frame.file != self.file or not 1 < len(text) <= MAX_WRITTEN:
            return text
        made = text[:1] + text[1:]
        self.written[id(made)] = made, [node.lineno, node.col_offset, node.end_lineno, node.end_col_offset]
        return made

    def truth(self, node: ast.expr, scope: Scope) -> bool:
        """Whether an expression holds."""
        value = self.evaluate(node, scope)
        self.frame.node = node
        return self.holds(value)

    def holds(self, value: Any) -> bool:
        """Whether a value counts as true."""
        if type(value) is str:
            value = marked(value)
        if isinstance(value, (bool, str, int, float, type(None), *_KEPT)) or self.is_ours(value):
            return bool(self._native(bool, value))
        return bool(self._native(bool, value)) if not isinstance(value, Module) else True

    def _expr_Constant(self, node: ast.Constant, scope: Scope) -> Any:
        if type(node.value) is not str:
            return node.value
        found = self._literals.get(node)
        if found is None:
            found = self._literals[node] = self._written("".join((node.value[:1], node.value[1:])), node)
        return found

    def _expr_Name(self, node: ast.Name, scope: Scope) -> Any:
        try:
            return self._name(node.id, scope)
        except Raised:
            self.frame.node = node
            raise

    def _name(self, name: str, scope: Scope) -> Any:
        try:
            return scope.get(name)
        except NameError as error:
            raise Raised(error) from None
        except KeyError:
            pass
        try:
            return self.around.builtin(name)
        except KeyError:
            raise Raised(NameError(f"name '{name}' is not defined", name=name)) from None

    def _expr_NamedExpr(self, node: ast.NamedExpr, scope: Scope) -> Any:
        value = self.evaluate(node.value, scope)
        scope.function().set(node.target.id, value)
        return value

    def _expr_Tuple(self, node: ast.Tuple, scope: Scope) -> Any:
        return tuple(self._items(node.elts, scope))

    def _expr_List(self, node: ast.List, scope: Scope) -> Any:
        return self._items(node.elts, scope)

    def _expr_Set(self, node: ast.Set, scope: Scope) -> Any:
        items = self._items(node.elts, scope)
        whole(items)
        check_keys(items)
        return self._native(set, items)

    def _items(self, nodes: list[ast.expr], scope: Scope) -> list[Any]:
        found: list[Any] = []
        for each in nodes:
            if isinstance(each, ast.Starred):
                found += self.each(self.evaluate(each.value, scope))
                check_size(found)
            else:
                found.append(self.evaluate(each, scope))
        return found

    def _expr_Dict(self, node: ast.Dict, scope: Scope) -> Any:
        found: dict[Any, Any] = {}
        for key, value in zip(node.keys, node.values, strict=True):
            if key is None:
                given = self.evaluate(value, scope)
                if is_unknown_object(given):
                    found[str(given)] = given[str(given)]
                else:
                    self._native(found.update, given)
                    self.made(found)
            else:
                name = self.evaluate(key, scope)
                check_key(name)
                self._native(operator.setitem, found, name, self.evaluate(value, scope))
        return check_size(found)

    def _expr_JoinedStr(self, node: ast.JoinedStr, scope: Scope) -> Any:
        pieces, size = [], 0
        for each in node.values:
            pieces.append(str(self._piece(each, scope)))
            size += len(pieces[-1])
            if size > MAX_TEXT:
                raise NotRead("a text is too long")
        return self.made(marked("".join(pieces)))

    def _piece(self, node: Any, scope: Scope) -> Any:
        if isinstance(node, ast.Constant):
            return node.value
        value = self._native(rewritten._formatted, self.evaluate(node.value, scope))
        spec = "" if node.format_spec is None else str(self.evaluate(node.format_spec, scope))
        self._check_shown(value)
        if node.conversion != -1:
            self.step(whole(value) // 20)
            value = self._native({"r": repr, "a": ascii, "s": str}[chr(node.conversion)], value)
        return self.shown(self._native(self.natives.formatted, value, spec))

    def shown(self, text: Any) -> Any:
        """A text that was made of a value; one with the address of an object is another one in each launch."""
        if isinstance(text, str) and str.__contains__(text, " at 0x"):
            return str(self.around.unknown("the address of an object", "it is another one in each launch"))
        return text

    def _check_shown(self, value: Any) -> None:
        """A text of something that Python makes has an address in it, or the like."""
        if isinstance(value, (set, frozenset)):
            self.in_order(value)

    def _expr_IfExp(self, node: ast.IfExp, scope: Scope) -> Any:
        return self.evaluate(node.body if self.truth(node.test, scope) else node.orelse, scope)

    def _expr_BoolOp(self, node: ast.BoolOp, scope: Scope) -> Any:
        is_or = isinstance(node.op, ast.Or)
        value: Any = None
        for each in node.values:
            value = marked(self.evaluate(each, scope))
            if each is not node.values[-1]:
                self.frame.node = each
                if self.holds(value) == is_or:
                    return value
        return value

    def _expr_UnaryOp(self, node: ast.UnaryOp, scope: Scope) -> Any:
        if isinstance(node.op, ast.Not):
            return not self.truth(node.operand, scope)
        value = self.evaluate(node.operand, scope)
        return self._native(_UNARY[type(node.op).__name__], value)

    def _expr_BinOp(self, node: ast.BinOp, scope: Scope) -> Any:
        left, right = self.evaluate(node.left, scope), self.evaluate(node.right, scope)
        self.frame.node = node
        return self.operated(type(node.op).__name__, left, right)

    def _expr_Compare(self, node: ast.Compare, scope: Scope) -> Any:
        left = self.evaluate(node.left, scope)
        result: Any = True
        for kind, each in zip(node.ops, node.comparators, strict=True):
            right = self.evaluate(each, scope)
            self.frame.node = node
            result = self.compared(type(kind).__name__, left, right)
            if len(node.ops) > 1 and not self.holds(result):
                return result
            left = right
        return result

    def compared(self, name: str, left: Any, right: Any) -> Any:
        """What a comparison gives."""
        if name not in ("Is", "IsNot"):
            left, right = marked(left), marked(right)
        if not (isinstance(left, (str, int, type(None))) and isinstance(right, (str, int, type(None)))):
            self.step(whole(left, right) // 20)
        if name in ("In", "NotIn"):
            if isinstance(right, (str, bytes)):
                check_search(right, left)
            found = self._native(lambda: left in rewritten._in(right))
            return found if name == "In" else not found
        return self._native(_COMPARISONS[name], left, right)

    def _expr_Attribute(self, node: ast.Attribute, scope: Scope) -> Any:
        thing = self.evaluate(node.value, scope)
        self.frame.node = node
        return self.given(self.attribute(thing, self._mangled(node.attr, scope)))

    @staticmethod
    def _mangled(name: str, scope: Scope | None) -> str:
        """The name of an attribute as a class has it that calls it `__name`."""
        if not name.startswith("__") or name.endswith("__"):
            return name
        while scope is not None and not scope.is_class:
            scope = scope.outer
        return name if scope is None else f"_{scope.name.rpartition('.')[2].lstrip('_')}{name}"

    def given(self, found: Any) -> Any:
        """What the program gets of Python or of launch: functions as those that the interpreter calls."""
        is_method = isinstance(found, types.MethodType) and isinstance(found.__func__, Function)
        return self.wrapped(found) if isinstance(found, _OF_PYTHON) and not is_method else found

    def wrapped(self, function: Any) -> Function:
        """A function that Python may call: it is called by the interpreter, which looks at what it is given."""
        name = getattr(function, "__name__", "")
        return Wrapped(lambda args, kwargs: self.call(function, args, kwargs), name, name)

    def attribute(self, thing: Any, name: str) -> Any:
        """What `thing.name` is."""
        if isinstance(thing, Module):
            if name in thing.contents:
                return thing.contents[name]
            return self.around.member(thing, name)
        if is_unknown_object(thing) and not is_program_class(type(thing)):
            if name.startswith("__"):
                return self.around.unknown(name, "it is of what is not known")
            return self._native(getattr, thing, name)
        if isinstance(thing, Function) and name in thing.members:
            return thing.members[name]
        if isinstance(thing, super):
            if name.startswith("_") and name != "__init__" and not self._in_program(thing, name):
                raise NotRead(f"super().{name}")
            return self._native(getattr, thing, name)
        if not may_have(thing, name):
            return self._not_had(thing, name)
        if isinstance(thing, UnknownText):
            return Wrapped(lambda args, kwargs: self.natives.of_unknown(thing, name, args, kwargs), name, name)
        found = self._native(getattr, thing, name)
        if isinstance(thing, type) and isinstance(found, _OF_TYPES):
            return self._of_type(thing, name)
        return found

    def _not_had(self, thing: Any, name: str) -> Any:
        kind = type(thing)
        if isinstance(thing, PurePosixPath) and not name.startswith("_"):
            if hasattr(PosixPath, name):
                return self.around.unknown(f"Path.{name}", "what is done with files is known only when it is launched")
            raise Raised(AttributeError(f"'PosixPath' object has no attribute '{name}'", name=name))
        if (kind in METHODS or thing is None) and not name.startswith("_"):
            if hasattr(kind, name) or kind is UnknownText:
                return self.around.unknown(f"{kind.__name__}.{name}", "it is known only when it is launched")
            raise Raised(AttributeError(f"'{kind.__name__}' object has no attribute '{name}'", name=name))
        if name.startswith(("_", "preflight")):
            raise NotRead(f"the attribute {name} of {kind.__name__}")
        return self.around.unknown(f"{kind.__name__}.{name}", "it is known only when it is launched")

    def _in_program(self, thing: Any, name: str) -> bool:
        found = getattr(thing, name, None)
        return isinstance(getattr(found, "__func__", None), Function)

    def _of_type(self, kind: Any, name: str) -> Any:
        """`str.lower` as a function."""
        if name == "fromkeys":
            return kind.fromkeys

        def called(args: Any, kwargs: Any) -> Any:
            if not args or not isinstance(args[0], kind):
                raise NotRead(f"{kind.__name__}.{name}")
            return self.call(self.attribute(args[0], name), args[1:], kwargs)

        return Wrapped(called, name, name)

    def _expr_Subscript(self, node: ast.Subscript, scope: Scope) -> Any:
        thing, key = self.evaluate(node.value, scope), self.evaluate(node.slice, scope)
        self.frame.node = node
        return self.item(thing, key)

    def item(self, thing: Any, key: Any) -> Any:
        """What `thing[key]` is."""
        if isinstance(thing, Module):
            raise NotRead("an item of a module")
        if isinstance(thing, type) and not is_program_class(thing):
            return self._native(operator.getitem, thing, key) if _is_plain_type(key) else thing
        if type(thing).__module__ == "typing":
            return self._native(operator.getitem, thing, key) if _is_plain_type(key) else thing
        check_key(key)
        return marked(self._native(lambda: rewritten._of(thing)[key]))

    def _expr_Slice(self, node: ast.Slice, scope: Scope) -> Any:
        bounds = (None if each is None else self.evaluate(each, scope) for each in (node.lower, node.upper, node.step))
        return slice(*bounds)

    def _expr_Starred(self, node: ast.Starred, scope: Scope) -> Any:
        raise NotRead("a starred expression")

    def _expr_Lambda(self, node: ast.Lambda, scope: Scope) -> Any:
        body = ast.Return(node.body)
        ast.copy_location(body, node.body)
        return self._function(node, "<lambda>", [body], scope)

    def _expr_ListComp(self, node: ast.ListComp, scope: Scope) -> Any:
        return self._comprehended(node.generators, lambda inner: self.evaluate(node.elt, inner), scope)

    def _expr_SetComp(self, node: ast.SetComp, scope: Scope) -> Any:
        items = self._expr_ListComp(node, scope)  # type: ignore[arg-type]
        whole(items)
        check_keys(items)
        return self._native(set, items)

    def _expr_GeneratorExp(self, node: ast.GeneratorExp, scope: Scope) -> Any:
        return iter(self._expr_ListComp(node, scope))  # type: ignore[arg-type]

    def _expr_DictComp(self, node: ast.DictComp, scope: Scope) -> Any:
        def pair(inner: Scope) -> Any:
            key = self.evaluate(node.key, inner)
            check_key(key)
            return key, self.evaluate(node.value, inner)

        pairs = self._comprehended(node.generators, pair, scope)
        check_keys([key for key, _ in pairs])
        return self._native(dict, pairs)

    def _comprehended(self, generators: Any, element: Callable[[Scope], Any], scope: Scope) -> list[Any]:
        found: list[Any] = []
        inner = Scope({}, scope, scope.globals, None, of="comprehension")

        def rounds(index: int) -> None:
            if index == len(generators):
                found.append(element(inner))
                check_size(found)
                return
            generator = generators[index]
            count = rewritten._count(generator.target)
            values = self.evaluate(generator.iter, inner if index else scope)
            self.frame.node = generator.iter
            for value in self.each(values):
                self._assign(generator.target, rewritten._parts(value, count) if count else value, inner)
                if all(self.truth(each, inner) for each in generator.ifs):
                    rounds(index + 1)

        rounds(0)
        return found

    def _expr_Yield(self, node: ast.Yield, scope: Scope) -> Any:
        value = None if node.value is None else self.evaluate(node.value, scope)
        generated = self.frame.generated
        if generated is None:
            raise NotRead("yield")
        generated.append(value)
        check_size(generated)
        return None

    def _expr_YieldFrom(self, node: ast.YieldFrom, scope: Scope) -> Any:
        generated = self.frame.generated
        if generated is None:
            raise NotRead("yield")
        generated += self.each(self.evaluate(node.value, scope))
        return None

    # Calls

    def _expr_Call(self, node: ast.Call, scope: Scope) -> Any:
        of: Any = None
        if isinstance(node.func, ast.Attribute):
            of = self.evaluate(node.func.value, scope)
            if type(of) is str:
                of = marked(of)
            function = self._method(of, self._mangled(node.func.attr, scope))
        else:
            function = self.evaluate(node.func, scope)
        args = tuple(self._items(node.args, scope)) if node.args else ()
        kwargs: dict[str, Any] = {}
        starred = any(isinstance(each, ast.Starred) for each in node.args)
        for each in node.keywords:
            value = self.evaluate(each.value, scope)
            if each.arg is not None:
                kwargs[each.arg] = value
            elif is_unknown_object(value):
                kwargs[str(value)] = value
                starred = True
            else:
                given = self._native(dict, value)
                double = next((name for name in given if name in kwargs), None)
                if double is not None or not all(isinstance(name, str) for name in given):
                    raise NotRead("an argument is given twice")
                kwargs.update(given)
        if isinstance(node.func, ast.Name) and function is super:
            args = args or (self.frame.owner, self.frame.first)
        if isinstance(node.func, ast.Attribute):
            args, kwargs = self._texts_of(node.func.attr, args, kwargs)
        self.frame.node = node
        if starred and any(map(is_unknown_object, (*args, *kwargs.values()))):
            args, kwargs = self._filled(function, args, kwargs)
        return marked(self.call(function, args, kwargs))

    def _filled(self, function: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Any:
        """The arguments of a call that is given some which nobody knows: what it lacks nobody knows either."""
        names = [name for name in kwargs if is_unknown(name)]
        unknown = [kwargs[name] for name in names] or [each for each in args if isinstance(each, Anything)]
        if not unknown or function is dict:
            return args, kwargs
        if isinstance(function, (Function, types.MethodType)):
            return args, {**kwargs, str(unknown[0]): unknown[0]}
        given = {name: value for name, value in kwargs.items() if name not in names}
        return args, {**rewritten._lacking(function, args, given, unknown[0]), **given}

    def _method(self, of: Any, name: str) -> Any:
        if name == "get" and type(of) is dict:
            return rewritten._Of(of).get
        return self.attribute(of, name)

    def _texts_of(self, name: str, args: Any, kwargs: Any) -> Any:
        if name in rewritten._OF_TEXTS:
            self.step(whole(*args, *kwargs.values()) // 20)
            change = rewritten._formatted if name == "format" else rewritten._as_text
            args = tuple(map(change, args))
            if name == "format":
                kwargs = {key: change(value) for key, value in kwargs.items()}
        return args, kwargs

    def checked(self, function: Any) -> Any:
        """What is called in the place of a function; raises `NotRead` where it may not be called."""
        if isinstance(function, Function) or is_unknown_object(function):
            return function
        if isinstance(function, types.MethodType) and isinstance(function.__func__, Function):
            return function
        if is_program_class(function):
            return function
        return self.around.instead(function)

    def call(self, function: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Any:
        """What a function gives, or raises."""
        self.step()
        if isinstance(function, types.MethodType) and isinstance(function.__func__, Function):
            args, function = (function.__self__, *args), function.__func__
        if isinstance(function, Function):
            is_program = isinstance(getattr(function.call, "__self__", None), _Code)
            return function.call(args, kwargs) if is_program else self._native(function.call, args, kwargs)
        if isinstance(function, Anything) and len(args) == 1 and isinstance(args[0], (Function, type)) and not kwargs:
            return args[0]
        if isinstance(function, staticmethod):
            return self.call(function.__func__, args, kwargs)
        name, of = getattr(function, "__name__", ""), getattr(function, "__self__", None)
        instead = self.natives.instead.get(function) if isinstance(function, _HASHED) else None
        instead = instead or (self.natives.method(of, name) if isinstance(function, types.BuiltinMethodType) else None)
        if instead is None:
            instead = self.checked(function)
            if not isinstance(instead, type) or instead in _TYPES:
                instead = rewritten._called(instead)
            args = tuple(map(self.natives.callable, args)) if name in _CALLING else args
            kwargs = (
                {key: self.natives.callable(value) for key, value in kwargs.items()} if name in _CALLING else kwargs
            )
            if name not in _LOOKING:
                self.natives.check(function, args, kwargs)
        for each in args:
            if isinstance(each, (set, frozenset)) and name not in _UNORDERED:
                self.in_order(each)
        made = self.made(self._native(instead, *args, **kwargs))
        is_shown = isinstance(made, str) and (not isinstance(of, str) or name in ("format", "format_map"))
        return self.shown(made) if is_shown else made

    def _native(self, function: Any, /, *args: Any, **kwargs: Any) -> Any:
        """What Python gives; what it raises is the program's."""
        try:
            return function(*args, **kwargs)
        except (RecursionError, MemoryError):
            raise NotRead("it is too deep") from None
        except Cancelled:
            raise
        except Exception as error:
            frames = vars(error).pop("preflight_frames", None) if hasattr(error, "__dict__") else None
            raise Raised(error, frames) from None

    def names_of(self, node: Any) -> Any:
        """Those of a function; it may be defined several times."""
        found = self._names.get(node)
        if found is None:
            found = self._names[node] = names_of(node)
        return found

    def _function(self, node: Any, name: str, body: list[ast.stmt], scope: Scope) -> Function:
        arguments = node.args
        defaults = _Defaults(
            [self.evaluate(each, scope) for each in arguments.defaults],
            [None if each is None else (self.evaluate(each, scope),) for each in arguments.kw_defaults],
        )
        code = _Code(self, node, name, body, scope, defaults)
        doc = ast.get_docstring(node) if isinstance(node, ast.FunctionDef) else None
        return Function(code.call, name, code.qualified, doc)


class _Defaults(NamedTuple):
    """Those of the last arguments that have places, and of those that have names alone: None where there is none."""

    by_place: list[Any]
    by_name: list[tuple[Any] | None]


class _Code:
    """A function of the program."""

    def __init__(
        self,
        interpreter: Interpreter,
        node: Any,
        name: str,
        body: list[ast.stmt],
        scope: Scope,
        defaults: _Defaults,
    ) -> None:
        self.interpreter, self.node, self.name, self.body = interpreter, node, name, body
        self.scope, self.defaults = scope, defaults
        self.file = interpreter.frame.file
        self.qualified = scope.qualified(name)
        self.owner: Any = None
        self.names = interpreter.names_of(node)

    def call(self, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Any:
        """What it gives for some arguments."""
        interpreter = self.interpreter
        values = self._bound(args, kwargs)
        scope = Scope(
            values, self.scope, self.scope.globals, self.names, of="function", name=f"{self.qualified}.<locals>"
        )
        frame = Frame(self.file, self.name, self.node)
        frame.owner, frame.first = self.owner, args[0] if args else None
        frame.generated = [] if self.names.is_generator else None
        interpreter._enter(frame)
        try:
            ended = interpreter.block(self.body, scope)
        except Raised as raised:
            interpreter._note_frame(raised, frame)
            raise
        finally:
            while interpreter.frames.pop() is not frame:
                pass
        if frame.generated is not None:
            return iter(frame.generated)
        return ended.value if isinstance(ended, Return) else None

    def _bound(self, args: tuple[Any, ...], kwargs: dict[str, Any]) -> dict[str, Any]:
        given = self.node.args
        by_place = [each.arg for each in (*given.posonlyargs, *given.args)]
        values: dict[str, Any] = dict(zip(by_place, args, strict=False))
        if len(args) > len(by_place) and given.vararg is None:
            raise Raised(TypeError(self._too_many(by_place, len(args))))
        if given.vararg is not None:
            values[given.vararg.arg] = args[len(by_place) :]
        names = {*by_place, *(each.arg for each in given.kwonlyargs)} - {each.arg for each in given.posonlyargs}
        more: dict[str, Any] = {}
        for name, value in kwargs.items():
            if name not in names:
                if given.kwarg is None:
                    if is_unknown(name):
                        continue
                    message = f"{self.qualified}() got an unexpected keyword argument '{name}'"
                    raise Raised(TypeError(message))
                more[name] = value
            elif name in values:
                raise Raised(TypeError(f"{self.qualified}() got multiple values for argument '{name}'"))
            else:
                values[name] = value
        if given.kwarg is not None:
            values[given.kwarg.arg] = more
        for name, value in zip(reversed(by_place), reversed(self.defaults.by_place), strict=False):
            values.setdefault(name, value)
        for each, default in zip(given.kwonlyargs, self.defaults.by_name, strict=True):
            if default is not None:
                values.setdefault(each.arg, default[0])
        self._check(by_place, [each.arg for each in given.kwonlyargs], values, kwargs)
        return values

    def _check(self, by_place: list[str], kwonly: list[str], values: dict[str, Any], kwargs: dict[str, Any]) -> None:
        for names, kind in ((by_place, "positional"), (kwonly, "keyword-only")):
            lacking = [name for name in names if name not in values]
            if not lacking:
                continue
            unknown = next((value for name, value in kwargs.items() if is_unknown(name)), None)
            if unknown is not None:
                values.update({name: unknown[name] for name in lacking})
                continue
            shown = [f"'{name}'" for name in lacking]
            listed = shown[0] if len(shown) == 1 else f"{', '.join(shown[:-1])}{',' * (len(shown) > 2)} and {shown[-1]}"
            several = "s" if len(shown) > 1 else ""
            message = f"{self.qualified}() missing {len(shown)} required {kind} argument{several}: {listed}"
            raise Raised(TypeError(message))

    def _too_many(self, by_place: list[str], count: int) -> str:
        with_default = len(self.defaults.by_place)
        least = len(by_place) - with_default
        takes = f"from {least} to {len(by_place)}" if with_default else str(len(by_place))
        several = "" if not with_default and len(by_place) == 1 else "s"
        were = "was" if count == 1 else "were"
        return f"{self.qualified}() takes {takes} positional argument{several} but {count} {were} given"


def _is_plain_type(key: Any) -> bool:
    """Whether it is a type, or several, that Python may keep in another one: not one that has some within itself."""
    if isinstance(key, tuple):
        return len(key) < 10 and all(map(_is_plain_type, key))
    return key is None or key is Any or (type(key) is type and not is_program_class(key))


def _matches(error: BaseException, kind: Any) -> bool:
    """Whether a handler takes an exception."""
    if isinstance(kind, tuple):
        return any(_matches(error, each) for each in kind)
    return isinstance(kind, type) and isinstance(error, kind)


_OF_PYTHON = (
    *(types.BuiltinMethodType, types.MethodType, types.FunctionType, types.MethodWrapperType),
    *(types.MethodDescriptorType, types.ClassMethodDescriptorType, types.WrapperDescriptorType),
)
_HASHED = (type, types.BuiltinFunctionType)
_CALLING = frozenset(("sorted", "min", "max", "sort", "defaultdict"))
"""What calls a function that it is given."""
_LOOKING = frozenset(("isinstance", "_isinstance", "callable", "issubclass", "len", "iter", "next", "type", "_type"))
"""What does not look into what it is given."""
_OF_TYPES = (types.MethodDescriptorType, types.ClassMethodDescriptorType, types.BuiltinMethodType)
_ABSTRACT = ("ABCMeta", "abc.ABCMeta")
_TYPES = (int, float, dict, type, str, bool)
_UNORDERED = frozenset(
    (
        *("sorted", "len", "set", "frozenset", "any", "all", "min", "max", "sum", "isinstance", "_isinstance", "bool"),
        *("issubset", "issuperset", "union", "intersection", "difference", "update", "add", "isdisjoint", "_bool"),
        *("symmetric_difference", "called", "append"),
    )
)
_BASES: tuple[Any, ...] = (
    object,
    *(v for v in vars(builtins).values() if isinstance(v, type) and issubclass(v, Exception)),
)
