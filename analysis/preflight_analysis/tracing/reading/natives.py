"""Functions of Python that code which is read may call, with a bound of what each does before it does it.

Python does none of these of its own accord here: iterators are gone through by the interpreter, which counts; formats
are taken apart; what is compared, hashed or written out as a text is measured first. What is not named in
`values.METHODS` or here is not called.
"""

from __future__ import annotations

import itertools
import math
import operator
import re
import string
import types
from collections.abc import Callable
from typing import Any

from preflight_analysis.tracing.agents.anything import Anything, marked, readable
from preflight_analysis.tracing.agents.fake_launch import rewritten
from preflight_analysis.tracing.reading.values import (
    MAX_DIGITS,
    MAX_ITEMS,
    MAX_SEARCH,
    MAX_TEXT,
    Function,
    NotRead,
    Wrapped,
    check_keys,
    check_operation,
    is_program_class,
    is_unknown_object,
    whole,
)

MAX_WIDTH = 10_000
_CODECS = frozenset(("utf-8", "utf8", "utf_8", "ascii", "latin-1", "latin1", "iso-8859-1"))
_CODED = _CODECS | {"replace", "ignore", "strict"}
_WIDE = re.compile(r"\d{5,}")
_FILLED = frozenset(("center", "ljust", "rjust", "zfill"))
_CHEAP = frozenset(
    (
        *("append", "get", "keys", "values", "items", "pop", "popitem", "popleft", "insert", "appendleft", "clear"),
        *("copy", "extend", "setdefault", "update", "read", "readlines", "readline"),
    )
)
"""Methods that look at no more than at the collection itself and the keys that they are given."""


_HASHING = frozenset(
    (
        *("set", "frozenset", "dict", "_dict", "OrderedDict", "defaultdict", "Counter", "fromkeys", "update", "union"),
        *("intersection", "difference", "symmetric_difference", "difference_update", "intersection_update"),
        *("symmetric_difference_update", "issubset", "issuperset", "isdisjoint"),
    )
)


class Natives:
    """Those of one reading. `interpreter` calls, goes through iterators, and counts."""

    def __init__(self, interpreter: Any) -> None:
        self._interpreter = interpreter
        self._formatter = _Formatter(interpreter, self)
        self.instead: dict[Any, Callable[..., Any]] = {
            **{map: self._map, filter: self._filter, zip: self._zip, enumerate: self._enumerate, iter: self._iter},
            **{itertools.chain: self._chain, itertools.islice: self._islice, itertools.product: self._product},
            **{itertools.zip_longest: self._zip_longest, range: self._range, slice: self._slice, sum: self._sum},
            **{pow: self._pow, round: self._round, bytes: self._bytes, format: self.formatted, math.prod: self._prod},
            **{kind: _of_program(kind) for kind in (property, staticmethod, classmethod)},
        }

    # What is called

    def callable(self, function: Any) -> Any:
        """A function for Python to call: it is called by the interpreter."""
        if isinstance(function, Function) or not callable(function) or is_unknown_object(function):
            return function
        if is_program_class(function) or is_program_class(type(function)):
            return function
        if isinstance(function, types.MethodType) and isinstance(function.__func__, Function):
            return function
        name = getattr(function, "__name__", "")
        return Wrapped(lambda args, kwargs: self._interpreter.call(function, args, kwargs), name, name)

    def method(self, of: Any, name: str) -> Callable[..., Any] | None:
        """What does what a method of a value does; None where it is that itself."""
        if isinstance(of, (str, bytes)):
            if name == "join":
                return lambda items: self._joined(of, items)
            if name in ("format", "format_map") and isinstance(of, str):
                return self._format_method(of, name)
        return None

    def of_unknown(self, text: Any, name: str, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Any:
        """What a method of a text gives of which some is not known."""
        instead = self.method(text, name)
        if instead is None:
            _check_text(str.__str__(text), name, args, kwargs)
            self._interpreter.step(whole(*args, *kwargs.values()) // 20)
            instead = getattr(text, name)
            if name in rewritten._NUMBERS_OF_TEXT:
                return Anything(f"{readable(text)}.{name}()")
        return self._interpreter.made(instead(*args, **kwargs))

    def check(self, function: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
        """Raise `NotRead` where a call would do too much; counts what it does."""
        of, name = getattr(function, "__self__", None), getattr(function, "__name__", "")
        if isinstance(of, (str, bytes)):
            _check_text(of, name, args, kwargs)
        elif isinstance(of, (list, dict, set)):
            given = sum(len(each) for each in args if isinstance(each, (list, tuple, dict, set, frozenset, range)))
            if len(of) + given + len(kwargs) > MAX_ITEMS:
                raise NotRead("a collection is too large")
        elif _is_number(function) and any(isinstance(each, (str, bytes)) and len(each) > MAX_DIGITS for each in args):
            raise NotRead("a number is too long")
        if name in _HASHING:
            for each in args:
                check_keys(each)
        weight = whole(*args, *kwargs.values())
        if isinstance(of, (list, tuple, dict, set, frozenset)):
            weight += len(of) if name in _CHEAP else whole(of)
        self._interpreter.step(weight // 20)

    # Iterators

    def each(self, values: Any) -> list[Any]:
        """All items."""
        found: list[Any] = []
        for value in self._interpreter.each(values):
            found.append(value)
            if len(found) > MAX_ITEMS:
                raise NotRead("a collection is too large")
        return found

    def _map(self, function: Any, *values: Any) -> Any:
        given = [self.each(each) for each in values]
        return iter([self._interpreter.call(function, args, {}) for args in zip(*given)])  # noqa: B905 - as `map`

    def _filter(self, function: Any, values: Any) -> Any:
        def holds(value: Any) -> Any:
            return value if function is None else self._interpreter.call(function, (value,), {})

        return iter([each for each in self.each(values) if self._interpreter.holds(holds(each))])

    def _zip(self, *values: Any, strict: bool = False) -> Any:
        """One round after the other: several may be the same iterator."""
        if strict:
            raise NotRead("zip() with strict")
        found: list[Any] = []
        iterators = [self._interpreter.each(each) for each in values]
        while iterators:
            made = []
            for each in iterators:
                try:
                    made.append(next(each))
                except StopIteration:
                    return iter(found)
            found.append(tuple(made))
            if len(found) > MAX_ITEMS:
                raise NotRead("a collection is too large")
        return iter(found)

    def _zip_longest(self, *values: Any, fillvalue: Any = None) -> Any:
        return iter(list(itertools.zip_longest(*map(self.each, values), fillvalue=fillvalue)))

    def _enumerate(self, values: Any, start: Any = 0) -> Any:
        return iter(list(enumerate(self.each(values), start)))

    def _iter(self, *args: Any) -> Any:
        if len(args) == 1:
            return iter(args[0])
        function, last = args
        found: list[Any] = []
        while True:
            value = self._interpreter.call(function, (), {})
            if self._interpreter.holds(self._interpreter.compared("Eq", value, last)):
                return iter(found)
            found.append(value)

    def _chain(self, *values: Any) -> Any:
        return iter(self.each(item for each in values for item in self._interpreter.each(each)))

    def _islice(self, values: Any, *bounds: Any) -> Any:
        if any(isinstance(each, int) and each > MAX_ITEMS for each in bounds):
            raise NotRead("a collection is too large")
        return iter(list(itertools.islice(self._interpreter.each(values), *bounds)))

    def _product(self, *values: Any, repeat: Any = 1) -> Any:
        given = [self.each(each) for each in values]
        count = math.prod(max(len(each), 1) for each in given)
        if not isinstance(repeat, int) or not 0 <= repeat <= 10 or (count**repeat) * len(given) > MAX_ITEMS:
            raise NotRead("a collection is too large")
        made = list(itertools.product(*given, repeat=repeat))
        self._interpreter.step(len(made))
        return iter(made)

    @staticmethod
    def _range(*args: Any) -> Any:
        if any(isinstance(each, Anything) for each in args):
            return range(1)
        made = range(*args)
        if abs(made.stop - made.start) // abs(made.step) > MAX_ITEMS or max(abs(made.start), abs(made.stop)) >= 1 << 60:
            raise NotRead("a range is too long")
        return made

    @staticmethod
    def _slice(*args: Any) -> Any:
        if not all(each is None or isinstance(each, (int, Anything)) for each in args):
            raise NotRead("a slice of other things than numbers")
        return slice(*args)

    # Numbers

    def _sum(self, values: Any, start: Any = 0) -> Any:
        return self._folded("Add", operator.add, values, start)

    def _prod(self, *values: Any, start: Any = 1) -> Any:
        if len(values) != 1:
            raise NotRead("a function of math")
        return self._folded("Mult", operator.mul, values[0], start)

    def _folded(self, name: str, function: Any, values: Any, start: Any) -> Any:
        if isinstance(start, (str, bytes)):
            raise TypeError("sum() can't sum strings [use ''.join(seq) instead]")
        for each in self.each(values):
            check_operation(name, start, each)
            start = self._interpreter.made(function(start, each))
        return start

    @staticmethod
    def _pow(base: Any, exponent: Any, modulus: Any = None) -> Any:
        if any(map(is_unknown_object, (base, exponent, modulus))):
            return Anything("pow()")
        check_operation("Pow", base, exponent)
        return pow(base, exponent, modulus)

    @staticmethod
    def _round(number: Any, digits: Any = None) -> Any:
        if is_unknown_object(number) or is_unknown_object(digits):
            return Anything("round()")
        if not isinstance(number, (int, float)) or (isinstance(digits, int) and abs(digits) > 400):
            raise NotRead("round()")
        return round(number, digits)

    @staticmethod
    def _bytes(*args: Any) -> Any:
        if args and isinstance(args[0], str) and args[1:] and str(args[1]).lower() in _CODECS:
            return args[0].encode(args[1])
        if not args or (len(args) == 1 and isinstance(args[0], (bytes, list, tuple))):
            return bytes(*args)
        raise NotRead("bytes()")

    # Texts

    def _joined(self, separator: Any, items: Any) -> Any:
        given = rewritten._as_text(self.each(items) if not isinstance(items, (str, bytes, Anything)) else items)
        if not isinstance(given, (str, bytes)):
            size = sum(len(separator) + len(each) for each in given if isinstance(each, (str, bytes)))
            if size > MAX_TEXT:
                raise NotRead("a text is too long")
        return separator.join(given)

    def _format_method(self, text: str, name: str) -> Callable[..., Any]:
        def called(*args: Any, **kwargs: Any) -> Any:
            if name == "format_map":
                kwargs = args[0] if isinstance(args[0], dict) else self._no_mapping()
                args = ()
            return marked(self._formatter.vformat(str.__str__(text), args, kwargs))

        return called

    @staticmethod
    def _no_mapping() -> Any:
        raise NotRead("format_map() of what is no dictionary")

    def formatted(self, value: Any, spec: Any = "") -> str:
        """`format(value, spec)`."""
        if not isinstance(spec, str) or _WIDE.search(spec):
            raise NotRead("a text is too wide")
        if isinstance(value, type) and spec == "":
            return str(value)
        self._interpreter.step(whole(value) // 20)
        return format(value, spec)

    def percent(self, left: Any, right: Any) -> Any:
        """`left % right`, of a text."""
        shown = left if isinstance(left, str) else left.decode("latin-1")
        count = _conversions(shown)
        given = list(right) if isinstance(right, tuple) else [*right.values()] if isinstance(right, dict) else [right]
        size = len(shown) + count * (MAX_WIDTH // 100 + 10 * sum(map(_length, given)))
        if size > 10 * MAX_TEXT:
            raise NotRead("a text is too long")
        return rewritten._percent(left, right)


class _Formatter(string.Formatter):
    """`str.format`, of which the interpreter gets the attributes."""

    def __init__(self, interpreter: Any, natives: Natives) -> None:
        self._interpreter, self._natives, self._size = interpreter, natives, 0

    def vformat(self, format_string: str, args: Any, kwargs: Any) -> str:
        self._size = 0
        return super().vformat(format_string, args, kwargs)

    def get_value(self, key: Any, args: Any, kwargs: Any) -> Any:
        if isinstance(key, int):
            if key >= len(args):
                raise IndexError(f"Replacement index {key} out of range for positional args tuple")
            return args[key]
        return kwargs[key]

    def get_field(self, field_name: str, args: Any, kwargs: Any) -> Any:
        first, rest = string._string.formatter_field_name_split(field_name)  # type: ignore[attr-defined]
        value = self.get_value(first, args, kwargs)
        for is_attribute, name in rest:
            value = self._interpreter.attribute(value, name) if is_attribute else self._interpreter.item(value, name)
        return value, first

    def format_field(self, value: Any, format_spec: str) -> Any:
        return self._grown(self._natives.formatted(value, format_spec))

    def convert_field(self, value: Any, conversion: Any) -> Any:
        if conversion is not None:
            self._interpreter.step(whole(value) // 20)
        return super().convert_field(value, conversion)

    def _grown(self, text: str) -> str:
        self._size += len(text)
        if self._size > MAX_TEXT:
            raise NotRead("a text is too long")
        return text


def _of_program(kind: Any) -> Callable[..., Any]:
    """`property` and the like, of the program's own functions."""

    def made(*functions: Any, **named: Any) -> Any:
        if named or not all(each is None or isinstance(each, (Function, property)) for each in functions):
            raise NotRead(f"{kind.__name__}()")
        if any(isinstance(each, property) for each in functions) and kind is property:
            raise NotRead("property()")
        return kind(*functions)

    return made


def _length(value: Any) -> int:
    """At most so many characters a text of it has."""
    if isinstance(value, (str, bytes)):
        return len(value)
    if isinstance(value, (int, float, bool, type(None), Anything)):
        return 1_300
    if isinstance(value, (list, tuple, dict, set, frozenset)):
        return whole(value) * 100
    return MAX_TEXT // 100


def _conversions(text: str) -> int:
    """How many conversions a text for `%` has; raises `NotRead` where one is wide."""
    count, at = 0, 0
    while (at := text.find("%", at) + 1) > 0:
        count += 1
        if text[at : at + 1] == "(":
            depth = 0
            while at < len(text):
                depth += (text[at] == "(") - (text[at] == ")")
                at += 1
                if depth == 0:
                    break
        found = _CONVERSION.match(text, at)
        if found is not None:
            if "*" in found[0] or _WIDE.search(found[0]):
                raise NotRead("a text is too wide")
            at = found.end()
        at += 1
    return count


_CONVERSION = re.compile(r"[#0\- +]*(?:\*|\d+)?(?:\.(?:\*|\d*))?[hlL]?")


def _is_number(function: Any) -> bool:
    return function is int or function is float


def check_search(within: Any, *texts: Any) -> None:
    """Raise `NotRead` where a text takes long to look for."""
    for each in texts:
        if isinstance(each, (str, bytes)) and len(each) > 1 and len(each) * len(within) > MAX_SEARCH:
            raise NotRead("a text takes long to look for")


def _check_text(of: Any, name: str, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
    check_search(of, *args, *kwargs.values())
    if name in _FILLED:
        if any(isinstance(each, int) and each > MAX_WIDTH for each in args):
            raise NotRead("a text is too long")
    elif name == "expandtabs":
        tabs = of.count("\t" if isinstance(of, str) else b"\t")
        size = next((each for each in (*args, *kwargs.values()) if isinstance(each, int)), 8)
        if len(of) + tabs * max(size, 0) > MAX_TEXT:
            raise NotRead("a text is too long")
    elif name == "replace" and len(args) >= 2 and all(isinstance(each, (str, bytes)) for each in args[:2]):
        count = of.count(args[0]) if type(args[0]) is type(of) or isinstance(of, str) else len(of) + 1
        if len(of) + count * len(args[1]) > MAX_TEXT:
            raise NotRead("a text is too long")
    elif name in ("encode", "decode") and not {str(each).lower() for each in (*args, *kwargs.values())} <= _CODED:
        raise NotRead(f"{name}() with another coding")


__all__ = ["Natives"]
