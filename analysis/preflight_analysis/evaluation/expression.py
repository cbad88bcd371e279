"""The allow-listed evaluator of `$(eval ...)`: Python's arithmetic, comparisons, strings and a few functions.

roslaunch gives `eval` the `math` module, its own functions and, without meaning to, all that Python has
(http://wiki.ros.org/roslaunch/XML#substitution_args). The same names are known here, but the expression is walked
and computed by us: no attribute that is not listed, no comprehension over anything unbounded, nothing that could run
code. What lies outside raises `NotAllowedError`; what roslaunch itself would reject raises `EvaluationError`. launch's
PythonExpression has other names, and the rest is the same.
"""

from __future__ import annotations

import ast
import builtins
import math
import operator
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

MAX_SIZE = 1_000_000
"""Longest text or list and, in bits, the largest number that an expression may make."""

_BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.Pow: operator.pow,
    ast.BitAnd: operator.and_,
    ast.BitOr: operator.or_,
    ast.BitXor: operator.xor,
    ast.LShift: operator.lshift,
    ast.RShift: operator.rshift,
}
_UNARY: dict[type[ast.unaryop], Callable[[Any], Any]] = {
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
    ast.Not: operator.not_,
    ast.Invert: operator.invert,
}
_COMPARE: dict[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Is: operator.is_,
    ast.IsNot: operator.is_not,
    ast.In: lambda a, b: a in b,
    ast.NotIn: lambda a, b: a not in b,
}
_MATH = {name: value for name, value in vars(math).items() if not name.startswith("_")}
_CONSTANTS = {"true": True, "false": False, "True": True, "False": False}
_METHODS = frozenset(
    {
        "capitalize",
        "center",
        "count",
        "endswith",
        "find",
        "format",
        "get",
        "index",
        "isalnum",
        "isalpha",
        "isdigit",
        "islower",
        "isupper",
    }
    | {"join", "keys", "lower", "lstrip", "partition", "replace", "rfind", "rpartition", "rsplit", "rstrip", "split"}
    | {"ljust", "rjust", "splitlines", "startswith", "strip", "swapcase", "title", "upper", "values", "zfill"}
)


def _round(number: Any, digits: Any = None) -> Any:
    if isinstance(digits, int) and abs(digits) > 1000:
        raise NotAllowedError("that is too much to round")
    return round(number, digits)


def _prod(values: Any, *rest: Any) -> Any:
    raise NotAllowedError("products are not evaluated")


_MATH["prod"] = _prod
_SCALAR = (abs, bin, bool, chr, float, hex, int, len, oct, ord, repr, _round, str)
"""Functions that make one small value of one: what `map` and `filter` may be given."""
_GROWING = (math.factorial, math.comb, math.perm)
_DEEP_FORMAT = re.compile(r"\{[^{}:!]*[.\[]|\{[^{}]*\{|:[^{}]*\d{4}")
_WIDE_FORMAT = re.compile(r"%[^a-zA-Z%]*(?:\*|\d{4})")


class _Items:
    """What `map`, `zip` and their like give: to be gone through, with no text of its own."""

    def __init__(self, items: Iterable[Any]) -> None:
        self.items = list(items)

    def __iter__(self) -> Iterator[Any]:
        return iter(self.items)


def _map(function: Any, *values: Any) -> _Items:
    if function not in _SCALAR:
        raise NotAllowedError("map is not evaluated with this function")
    return _Items(map(function, *values))


def _filter(function: Any, values: Any) -> _Items:
    if function is not None and function not in _SCALAR:
        raise NotAllowedError("filter is not evaluated with this function")
    return _Items(filter(function, values))


def _range(*bounds: Any) -> range:
    found = range(*bounds)
    if not -MAX_SIZE <= (found.stop - found.start) // found.step <= MAX_SIZE:
        raise NotAllowedError("the range is too long")
    return found


def _sum(values: Any, start: Any = 0) -> Any:
    items = list(values)
    if not all(isinstance(item, (int, float)) for item in (*items, start)):
        raise NotAllowedError("only numbers are added up")
    return sum(items, start)


def _format(value: Any, spec: Any = "") -> str:
    if re.search(r"\d{4}", str(spec)):
        raise NotAllowedError("the text would be too long")
    return format(value, spec)


_BUILTINS: dict[str, Any] = {
    **{
        function.__name__.lstrip("_"): function
        for function in (*_SCALAR, all, any, dict, divmod, list, max, min, tuple)
    },
    "enumerate": lambda values, start=0: _Items(enumerate(values, start)),
    "filter": _filter,
    "format": _format,
    "map": _map,
    "range": _range,
    "reversed": lambda values: _Items(reversed(values)),
    "sorted": sorted,
    "sum": _sum,
    "zip": lambda *values: _Items(zip(*values)),  # noqa: B905 - as in the expression
}
"""Python's own functions: roslaunch means to shut them out, and does not."""


NAMES: Mapping[str, bool] = {name: callable(value) for name, value in {**_CONSTANTS, **_BUILTINS, **_MATH}.items()}
"""What is known in every expression, beside the functions of roslaunch and the arguments, and whether it is called."""


class EvaluationError(ValueError):
    """The expression fails, in roslaunch as well."""


class NotAllowedError(ValueError):
    """Outside of what is evaluated here; roslaunch may well accept it."""


def evaluate(expression: str, names: Callable[[str], Any], functions: Mapping[str, Callable[..., Any]]) -> Any:
    """The value of a `$(eval)` expression.

    `functions` are roslaunch's own (`arg`, `find`, `env`, ...), `names` gives the value of a launch argument and raises
    `KeyError` for one that does not exist.
    """
    if "__" in expression:
        raise EvaluationError("double underscores are not allowed in $(eval)")
    return _evaluated(expression, _Walker(names, {**_MATH, **functions}, _CONSTANTS))


def evaluate_ros2(expression: str, *, module: bool = True) -> Any:
    """The value of launch's PythonExpression with the module `math`, whose names count with and without it in front;
    not `module`: without it alone, as before Iron."""

    def no_names(name: str) -> Any:
        if name in vars(math):
            raise NotAllowedError(f"'{name}' is not evaluated")
        raise KeyError(name)

    return _evaluated(expression, _Walker(no_names, _MATH, {}, frozenset({"math"} if module else ())))


def _evaluated(expression: str, walker: _Walker) -> Any:
    try:
        tree = ast.parse(expression.strip(), mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise EvaluationError(f"not an expression: {getattr(error, 'msg', None) or error}") from error
    try:
        result = walker.visit(tree.body)
        _check_weight(result)
        if isinstance(result, (_Items, type)) or callable(result):
            raise NotAllowedError("the result is no value")
        return result
    except (EvaluationError, NotAllowedError):
        raise
    except RecursionError as error:
        raise NotAllowedError("nested too deeply") from error
    except (ArithmeticError, LookupError, TypeError, ValueError, AttributeError) as error:
        raise EvaluationError(str(error)) from error


def evaluate_arithmetic(expression: str) -> Any:
    """Numbers, operators and `math`'s names only: the angles of parameter files."""

    def no_names(name: str) -> Any:
        raise KeyError(name)

    try:
        return evaluate(expression, no_names, {})
    except NotAllowedError as error:
        raise EvaluationError(str(error)) from error


class _Walker:
    def __init__(
        self,
        names: Callable[[str], Any],
        functions: Mapping[str, Any],
        constants: Mapping[str, Any],
        modules: frozenset[str] = frozenset(),
    ) -> None:
        self._names = names
        self._functions = functions
        self._constants = constants
        self._modules = modules
        """Names that stand for `math`."""

    def visit(self, node: ast.expr) -> Any:
        method = getattr(self, "_" + type(node).__name__.lower(), None)
        if method is None:
            raise NotAllowedError(f"{type(node).__name__} is not evaluated")
        return method(node)

    def _constant(self, node: ast.Constant) -> Any:
        return node.value

    def _name(self, node: ast.Name) -> Any:
        # roslaunch looks at its own functions first, then at the arguments, then at Python's functions.
        if node.id in self._constants:
            return self._constants[node.id]
        if node.id in self._modules:
            raise NotAllowedError("a module is no value")
        if node.id in self._functions:
            return self._functions[node.id]
        try:
            return self._names(node.id)
        except KeyError:
            if node.id in _BUILTINS:
                return _BUILTINS[node.id]
            if hasattr(builtins, node.id):
                raise NotAllowedError(f"'{node.id}' is not evaluated") from None
            raise EvaluationError(f"name '{node.id}' is not defined") from None

    def _is_module(self, node: ast.expr) -> bool:
        return isinstance(node, ast.Name) and node.id in self._modules

    def _attribute(self, node: ast.Attribute) -> Any:
        if self._is_module(node.value):
            if node.attr in _MATH:
                return _MATH[node.attr]
            if hasattr(math, node.attr):
                raise NotAllowedError("attributes are not evaluated")
            raise EvaluationError(f"module 'math' has no attribute {node.attr!r}")
        value = self.visit(node.value)
        if not hasattr(value, node.attr):
            raise EvaluationError(f"{type(value).__name__!r} has no attribute {node.attr!r}")
        raise NotAllowedError("attributes are not evaluated")

    def _binop(self, node: ast.BinOp) -> Any:
        left, right = self.visit(node.left), self.visit(node.right)
        _check_size(node.op, left, right)
        return _BINARY[type(node.op)](left, right) if type(node.op) in _BINARY else self._refuse(node.op)

    def _unaryop(self, node: ast.UnaryOp) -> Any:
        return _UNARY[type(node.op)](self.visit(node.operand))

    def _boolop(self, node: ast.BoolOp) -> Any:
        value: Any = None
        for item in node.values:
            value = self.visit(item)
            if bool(value) == isinstance(node.op, ast.Or):
                break
        return value

    def _compare(self, node: ast.Compare) -> Any:
        left = self.visit(node.left)
        for op, item in zip(node.ops, node.comparators, strict=True):
            right = self.visit(item)
            result = _COMPARE[type(op)](left, right)
            if not result:
                return result
            left = right
        return result

    def _ifexp(self, node: ast.IfExp) -> Any:
        return self.visit(node.body if self.visit(node.test) else node.orelse)

    def _list(self, node: ast.List) -> Any:
        return [self.visit(item) for item in node.elts]

    def _tuple(self, node: ast.Tuple) -> Any:
        return tuple(self.visit(item) for item in node.elts)

    def _dict(self, node: ast.Dict) -> Any:
        if any(key is None for key in node.keys):
            raise NotAllowedError("** in a dictionary is not evaluated")
        return {self.visit(k): self.visit(v) for k, v in zip(node.keys, node.values, strict=True) if k is not None}

    def _subscript(self, node: ast.Subscript) -> Any:
        return self.visit(node.value)[self.visit(node.slice)]

    def _slice(self, node: ast.Slice) -> Any:
        return slice(*(self.visit(part) if part is not None else None for part in (node.lower, node.upper, node.step)))

    def _call(self, node: ast.Call) -> Any:
        if node.keywords or any(isinstance(a, ast.Starred) for a in node.args):
            raise NotAllowedError("keyword and starred arguments are not evaluated")
        arguments = [self.visit(a) for a in node.args]
        if isinstance(node.func, ast.Attribute) and not self._is_module(node.func.value):
            return self._method(self.visit(node.func.value), node.func.attr, arguments)
        if not isinstance(node.func, (ast.Name, ast.Attribute)):
            raise NotAllowedError("only functions with a name are called")
        function = self.visit(node.func)
        if function in _GROWING and any(a > 1000 for a in arguments):
            raise NotAllowedError("the number is too large")
        if not callable(function):
            raise EvaluationError(f"'{ast.unparse(node.func)}' is not a function")
        for argument in arguments:
            _check_weight(argument)
        return function(*arguments)

    def _method(self, value: Any, name: str, arguments: list[Any]) -> Any:
        if not hasattr(value, name):
            raise EvaluationError(f"{type(value).__name__!r} object has no attribute {name!r}")
        if not isinstance(value, (str, list, tuple, dict)) or name not in _METHODS:
            raise NotAllowedError(f"the method '{name}' is not evaluated")
        for argument in (value, *arguments):
            _check_weight(argument)
        if name == "join" and len(value) * sum(1 for _ in arguments[0]) > MAX_SIZE:
            raise NotAllowedError("the text would be too long")
        if name in ("center", "ljust", "rjust", "zfill") and arguments[0] > MAX_SIZE:
            raise NotAllowedError("the text would be too long")
        if name == "format" and isinstance(value, str) and _DEEP_FORMAT.search(value):
            raise NotAllowedError("attributes, items and wide fields are not formatted")
        if name == "replace" and len(value) * max(1, len(str(arguments[-1]))) > MAX_SIZE:
            raise NotAllowedError("the text would be too long")
        return getattr(value, name)(*arguments)

    @staticmethod
    def _refuse(op: ast.operator) -> Any:
        raise NotAllowedError(f"{type(op).__name__} is not evaluated")


def _check_weight(value: Any, times: int = 1) -> None:
    """Refuse lists of lists of long texts: they take no memory until a function makes text or further lists of them,
    or compares them."""
    left, waiting = MAX_SIZE // times, [value]
    while waiting:
        item = waiting.pop()
        left -= len(item) if isinstance(item, (str, bytes)) else 1
        if isinstance(item, dict):
            waiting += item.keys()
            waiting += item.values()
        elif isinstance(item, (list, tuple)):
            waiting += item
        elif isinstance(item, _Items):
            waiting += item.items
        if left < 0 or len(waiting) > MAX_SIZE:
            raise NotAllowedError("the value would be too large")


def _check_size(op: ast.operator, left: Any, right: Any) -> None:
    """Refuse what would take the memory: `'a' * 10**9`, `9**9**9`, `1 << 10**9`, `'%9999999999d' % 1`."""
    if isinstance(op, ast.Mult):
        for text, count in ((left, right), (right, left)):
            if isinstance(text, (str, bytes, list, tuple)) and isinstance(count, int) and count > 0:
                _check_weight(text, count)
    if isinstance(left, int) and isinstance(right, int):
        bits = left.bit_length() * right if isinstance(op, ast.Pow) else right if isinstance(op, ast.LShift) else 0
        if bits > MAX_SIZE:
            raise NotAllowedError("the number would be too large")
    if isinstance(op, ast.Mod) and isinstance(left, str) and _WIDE_FORMAT.search(left):
        raise NotAllowedError("the text would be too long")
    if isinstance(op, ast.Mod) and isinstance(left, str):
        _check_weight(right)
    if isinstance(op, ast.Mod) and isinstance(left, bytes):
        raise NotAllowedError("bytes are not formatted")
