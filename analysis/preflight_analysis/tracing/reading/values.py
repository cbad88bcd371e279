"""What the code of a launch file may do with values of Python: which attributes it gets, how large they become.

Whatever is not named here is not done: it raises `NotRead`, or the value is one that only a run knows.
"""

from __future__ import annotations

import collections
import functools
import itertools
import re
import types
from pathlib import PurePosixPath
from typing import Any

from preflight_analysis.tracing.agents import anything
from preflight_analysis.tracing.agents.anything import AnyBase, AnyModule, Anything

MAX_TEXT = 1_000_000
MAX_ITEMS = 50_000
MAX_BITS = 4_000
MAX_NUMBER = 100_000
MAX_WORK = 20_000_000
"""Steps of a regular expression, as an estimate."""
AGENTS = anything.__name__.rpartition(".")[0]
FAKES = f"{AGENTS}.fake_launch"
FILES = f"{__name__.rpartition('.')[0]}.files"


class NotRead(BaseException):
    """The reading of a launch file ends: more than anyone writes, or what only a run can do."""


class Raised(BaseException):
    """An exception of the program's."""

    def __init__(self, error: BaseException, frames: list[list[Any]] | None = None) -> None:
        super().__init__(error)
        self.error, self.frames = error, frames or []


class Function:
    """A function of the program's. Whoever calls it calls the interpreter."""

    def __init__(self, call: Any, name: str, qualified: str, doc: str | None = None) -> None:
        self.call, self.__name__, self.__qualname__, self.__doc__ = call, name, qualified, doc
        self.__module__ = "python_launch_file"

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """What it gives, or raises, as Python does."""
        try:
            return self.call(args, kwargs)
        except Raised as raised:
            if not isinstance(raised.error, Exception):
                raise  # such as SystemExit: nobody between the two handles it
            vars(raised.error)["preflight_frames"] = raised.frames
            raise raised.error from None

    def __get__(self, thing: Any, kind: Any = None) -> Any:
        return self if thing is None else types.MethodType(self, thing)

    def __repr__(self) -> str:
        return f"<function {self.__qualname__}>"


Function.__name__ = Function.__qualname__ = "function"
Function.__module__ = "builtins"


class Module:
    """A module as the program sees it."""

    def __init__(self, name: str, contents: dict[str, Any], file: str | None = None) -> None:
        self.name, self.contents, self.file = name, contents, file

    def __repr__(self) -> str:
        return f"<module '{self.name}'>"


Module.__name__ = Module.__qualname__ = "module"
Module.__module__ = "builtins"


SAFE_TYPES: frozenset[type] = frozenset(
    (
        *(str, bytes, int, float, bool, complex, list, tuple, dict, set, frozenset, range, slice, type(None)),
        *(collections.OrderedDict, collections.defaultdict, collections.Counter, collections.deque),
        *(type({}.keys()), type({}.values()), type({}.items()), re.Match, property, staticmethod, classmethod),
        *(map, filter, zip, enumerate, reversed, type(iter([])), type(iter(())), functools.partial, super),
        *(itertools.chain, itertools.product, itertools.islice, itertools.zip_longest, type(Ellipsis)),
        *(anything.UnknownText, type(iter({})), type(iter("")), type(iter(range(0)))),
    )
)
_UNSAFE = frozenset(("maketrans", "mro", "with_traceback", "add_note"))
_PUBLIC_OF_OBJECT = frozenset(("__name__", "__doc__", "__qualname__", "__class__", "__init__", "__module__"))
_FIELD = re.compile(r"\{([^{}:!]*)")
_LARGE = re.compile(r"\d{4,}")
_NESTED = re.compile(r"\{[^{}]*\{")
_STARRED = re.compile(r"%[^a-zA-Z%]*\*")


def is_unknown_object(value: Any) -> bool:
    """Whether it stands for whatever is not known."""
    return isinstance(value, (Anything, AnyBase, AnyModule))


def is_program_class(kind: Any) -> bool:
    """Whether it is a class that the program makes."""
    return isinstance(kind, type) and "preflight_interpreted" in vars(kind)


def is_fake(kind: type) -> bool:
    """Whether it is one of the classes that take the place of those of launch."""
    return kind.__module__.startswith(FAKES)


def may_have(thing: Any, name: str) -> bool:
    """Whether the program gets an attribute of something."""
    kind = type(thing)
    if name.startswith("preflight") or name in _UNSAFE:
        return False
    if isinstance(thing, type):
        if is_program_class(thing) or thing in (object,):
            return not _is_special(name) or name in _PUBLIC_OF_OBJECT or _is_in_program(thing, name)
        return not name.startswith("_") or name in ("__name__", "__init__", "__qualname__")
    if is_program_class(kind):
        return not _is_special(name) or name in ("__class__", "__dict__") or _is_in_program(kind, name)
    if isinstance(thing, (Function, types.MethodType, types.FunctionType)):
        return name in ("__name__", "__qualname__", "__doc__")
    if name.startswith("_"):
        return name == "__class__"
    return (
        kind in SAFE_TYPES
        or is_fake(kind)
        or kind.__module__ == FILES
        or isinstance(thing, (BaseException, PurePosixPath))
    )


def _is_special(name: str) -> bool:
    return name.startswith("__")


def _is_in_program(kind: type, name: str) -> bool:
    return any(name in vars(each) for each in kind.__mro__ if is_program_class(each))


def check_size(value: Any) -> Any:
    """The value; raises `NotRead` where it is larger than anyone writes."""
    if isinstance(value, (str, bytes)):
        if len(value) > MAX_TEXT:
            raise NotRead("a text is too long")
    elif isinstance(value, (list, tuple, dict, set, frozenset)) and len(value) > MAX_ITEMS:
        raise NotRead("a collection is too large")
    elif isinstance(value, int) and value.bit_length() > MAX_BITS:
        raise NotRead("a number is too large")
    return value


def check_whole(*values: Any) -> None:
    """Raise `NotRead` where what is within values, each time that it is there, is more than anyone writes, or is
    within itself."""
    left = MAX_ITEMS
    depth = 0
    level = list(values)
    while level:
        depth += 1
        left -= len(level)
        if left < 0 or depth > 60:
            raise NotRead("a value is too large")
        below: list[Any] = []
        for each in level:
            if isinstance(each, dict):
                below += each.keys()
                below += each.values()
            elif isinstance(each, (list, tuple, set, frozenset, collections.deque)):
                below += each
            elif isinstance(each, str):
                left -= len(each) // 1000
        level = below


def check_call(function: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
    """Raise `NotRead` where what a call would make is too large, or asks for what may not be asked for."""
    of, name = getattr(function, "__self__", None), getattr(function, "__name__", "")
    for each in args:
        if isinstance(each, range) and len(each) > MAX_ITEMS:
            raise NotRead("a range is too long")
        if name in _BY_NUMBER and isinstance(each, int) and abs(each) > _MOST_BY_NUMBER[name]:
            raise NotRead("a number is too large")
    if name == "pow" and len(args) == 2:
        check_operation("Pow", *args)
    elif name == "iter" and len(args) > 1:
        raise NotRead("iter() with a function")
    elif name == "indent" and sum(len(each) for each in args if isinstance(each, str)) > 10_000:
        raise NotRead("a text is too long")
    elif name == "format" and len(args) == 2 and isinstance(args[1], str):
        check_format("{:" + args[1] + "}")
    if isinstance(of, (str, bytes)):
        _check_text_method(of, name, args, kwargs)
    elif isinstance(of, (list, dict, set, collections.deque)):
        given = sum(len(each) for each in args if hasattr(each, "__len__") and not isinstance(each, Anything))
        if len(of) + given > MAX_ITEMS and name not in ("get", "append", "pop", "index"):
            raise NotRead("a collection is too large")


_MOST_BY_NUMBER = {"bytes": MAX_ITEMS, "to_bytes": 1_000, "round": MAX_NUMBER, "pow": MAX_NUMBER}
_BY_NUMBER = frozenset(_MOST_BY_NUMBER)


def bounded(value: Any) -> Any:
    """What Python goes through by itself: the items of an iterator, of which there may be any number."""
    if not hasattr(type(value), "__next__") or isinstance(value, Anything):
        return value
    items = list(itertools.islice(value, MAX_ITEMS + 1))
    check_size(items)
    return iter(items)


def _check_text_method(of: str | bytes, name: str, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
    if name in ("center", "ljust", "rjust", "zfill", "expandtabs"):
        if any(isinstance(each, int) and each > 10_000 for each in args):
            raise NotRead("a text is too long")
    elif name == "translate":
        raise NotRead("translate()")
    elif name == "replace" and len(args) >= 2 and all(isinstance(each, (str, bytes)) for each in args[:2]):
        if len(of) + (of.count(args[0]) if args[0] else len(of) + 1) * len(args[1]) > MAX_TEXT:
            raise NotRead("a text is too long")
    elif name in ("format", "format_map") and isinstance(of, str):
        check_format(of)
        if name == "format_map":
            args = tuple(args[0].values()) if args and isinstance(args[0], dict) else args
        if _NESTED.search(of) and any(isinstance(each, int) and each > 1_000 for each in (*args, *kwargs.values())):
            raise NotRead("a text is too long")
        check_whole(*args, *kwargs.values())
    elif name == "join":
        for each in args:
            items = each if isinstance(each, (list, tuple)) else ()
            if sum(len(of) + len(x) for x in items if isinstance(x, (str, bytes))) > MAX_TEXT:
                raise NotRead("a text is too long")


def check_format(text: str) -> None:
    """Raise `NotRead` where a format asks for what is hidden, or for much."""
    if _LARGE.search(text) and "{" in text and any(_LARGE.search(each) for each in re.findall(r"\{[^{}]*\}?", text)):
        raise NotRead("a text is too long")
    for field in _FIELD.findall(text):
        if "._" in field or ".preflight" in field or ("." in field and not field.replace(".", "").isidentifier()):
            raise NotRead("a format asks for an attribute")


def check_percent(text: Any) -> None:
    """The same for `%`."""
    if isinstance(text, (str, bytes)):
        shown = text if isinstance(text, str) else text.decode(errors="replace")
        if _STARRED.search(shown) or re.search(r"%[^a-zA-Z%]*\d{4,}", shown):
            raise NotRead("a text is too long")


def check_operation(name: str, left: Any, right: Any) -> None:
    """Raise `NotRead` where an operation makes something too large."""
    if name == "Mult":
        for one, other in ((left, right), (right, left)):
            most = MAX_TEXT if isinstance(one, (str, bytes)) else MAX_ITEMS
            is_repeated = isinstance(one, (str, bytes, list, tuple)) and isinstance(other, int)
            if is_repeated and len(one) * max(other, 0) > most:
                raise NotRead("a value is too large")
        if isinstance(left, int) and isinstance(right, int):
            _check_bits(left.bit_length() + right.bit_length())
    elif name == "Add":
        if isinstance(left, (str, bytes, list, tuple)) and isinstance(right, (str, bytes, list, tuple)):
            most = MAX_TEXT if isinstance(left, (str, bytes)) else MAX_ITEMS
            if len(left) + len(right) > most:
                raise NotRead("a value is too large")
    elif name in ("Pow", "LShift") and isinstance(left, int) and isinstance(right, int):
        _check_bits(max(left.bit_length(), 1) * abs(right) if name == "Pow" else left.bit_length() + abs(right))
    elif name == "Mod":
        check_percent(left)
        if isinstance(left, str):
            check_whole(right)


def _check_bits(count: int) -> None:
    if count > MAX_BITS:
        raise NotRead("a number is too large")
