"""What the code of a launch file may do with values of Python: which attributes it gets, how large they become.

Whatever is not named here is not done: it raises `NotRead`, or the value is one that only a run knows.
"""

from __future__ import annotations

import collections
import re
import types
from pathlib import PurePosixPath
from typing import Any

from preflight_analysis.tracing.agents import anything
from preflight_analysis.tracing.agents.anything import AnyBase, AnyModule, Anything
from preflight_analysis.tracing.agents.fake_launch.base import TextSubstitution

MAX_TEXT = 1_000_000
MAX_ITEMS = 50_000
MAX_BITS = 4_000
MAX_DIGITS = 5_000
MAX_DEPTH = 60
MAX_KEYS = 2_000
"""Of other kinds than texts, that are made at once."""
MAX_SEARCH = 20_000_000
"""Characters of a text, times those that are looked for in it."""
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
        self.members: dict[str, Any] = {}
        """What the program says that it has."""

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """What it gives; raises what the program does."""
        try:
            return self.call(args, kwargs)
        except Raised as raised:
            if not isinstance(raised.error, Exception):
                raise  # nothing of Python's may take `sys.exit()` for its own
            # Between the two there may be code that handles it.
            vars(raised.error)["preflight_frames"] = raised.frames
            raise raised.error from None

    def __get__(self, thing: Any, kind: Any = None) -> Any:
        return self if thing is None else types.MethodType(self, thing)

    def __repr__(self) -> str:
        return f"<function {self.__qualname__}>"


class Wrapped(Function):
    """One of Python or of launch, as the program has it."""

    def __get__(self, thing: Any, kind: Any = None) -> Any:
        return self


for _kind in (Function, Wrapped):
    _kind.__name__ = _kind.__qualname__ = "function"
    _kind.__module__ = "builtins"


class Module:
    """A module as the program sees it."""

    def __init__(self, name: str, contents: dict[str, Any], file: str | None = None) -> None:
        self.name, self.contents, self.file = name, contents, file

    def __repr__(self) -> str:
        return f"<module '{self.name}'>"


Module.__name__ = Module.__qualname__ = "module"
Module.__module__ = "builtins"


def _names(*texts: str) -> frozenset[str]:
    return frozenset(name for text in texts for name in text.split())


_OF_BYTES = (
    "center count decode endswith expandtabs find index isalnum isalpha isdigit islower isspace istitle isupper join"
    " ljust lower lstrip partition replace rfind rindex rjust rpartition rsplit rstrip split splitlines startswith"
    " strip swapcase title upper zfill removeprefix removesuffix"
)
_OF_MAPS = "clear copy get items keys pop popitem setdefault update fromkeys"
_OF_SETS = (
    "copy difference intersection isdisjoint issubset issuperset symmetric_difference union add clear discard pop"
    " remove update difference_update intersection_update symmetric_difference_update"
)
_OF_LISTS = "append clear copy count extend index insert pop remove reverse sort"
METHODS: dict[type, frozenset[str]] = {
    str: _names(_OF_BYTES, "capitalize casefold encode format format_map isascii isdecimal isidentifier isnumeric")
    | _names("isprintable") - _names("decode"),
    bytes: _names(_OF_BYTES),
    **{list: _names(_OF_LISTS), tuple: _names("count index"), range: _names("count index start stop step")},
    **{dict: _names(_OF_MAPS), collections.OrderedDict: _names(_OF_MAPS, "move_to_end")},
    **{collections.defaultdict: _names(_OF_MAPS, "default_factory"), set: _names(_OF_SETS)},
    collections.Counter: _names(_OF_MAPS, "most_common"),
    collections.deque: _names(_OF_LISTS, "appendleft extendleft popleft rotate"),
    frozenset: _names(_OF_SETS),
    **dict.fromkeys((int, bool), _names("bit_length real imag numerator denominator")),
    float: _names("is_integer real imag hex"),
    re.Match: _names("group groups groupdict start end span string pos endpos lastgroup lastindex"),
    property: _names("setter getter deleter"),
    slice: _names("start stop step"),
    anything.UnknownText: frozenset(),
}
"""What the program may have of values of Python."""
METHODS[anything.UnknownText] = METHODS[str]
_ITERATED = frozenset(
    (
        *(type(iter([])), type(iter(())), type(iter({})), type(iter("")), type(iter(range(0))), type(iter(set()))),
        *(type(reversed([])), type(reversed({})), type({}.keys()), type({}.values()), type({}.items())),
        *(type(iter({}.values())), type(iter({}.items())), type(reversed(range(0)))),
    )
)
SAFE_TYPES: frozenset[type] = frozenset((*METHODS, *_ITERATED, type(None), type(Ellipsis), complex, super, object))
_OF_PATHS = _names(
    "parts drive root anchor parents parent name suffix suffixes stem as_posix joinpath relative_to is_relative_to",
    "with_name with_stem with_suffix is_absolute",
    "exists is_file is_dir read_text open resolve absolute expanduser glob rglob iterdir cwd home",
)
"""Of `pathlib.Path`; the last line is of `files.Path`."""
_OF_ERRORS = _names("args errno strerror filename name path msg code value lineno offset problem problem_mark")
_OPERANDS: tuple[type, ...] = (
    *(str, bytes, int, float, complex, bool, type(None), list, tuple, dict, set, frozenset, collections.Counter),
    *(collections.OrderedDict, PurePosixPath, type, Anything, AnyBase, types.GenericAlias),
)
_PRIVATE = frozenset(("_predicate_func",))
"""What launch files ask of launch although it is not for them."""
_UNSAFE = frozenset(("maketrans", "mro", "with_traceback", "add_note"))
_PUBLIC_OF_OBJECT = frozenset(("__name__", "__doc__", "__qualname__", "__class__", "__init__", "__module__"))
_FILES = ("Reading", "Writing", "UnknownFile")


def is_unknown_object(value: Any) -> bool:
    """Whether it stands for whatever is not known."""
    return isinstance(value, (Anything, AnyBase, AnyModule))


def is_program_class(kind: Any) -> bool:
    """Whether it is a class that the program makes."""
    return isinstance(kind, type) and "preflight_interpreted" in vars(kind)


def is_fake(kind: type) -> bool:
    """Whether it is one of the classes that take the place of those of launch."""
    return kind.__module__.startswith(FAKES) and not is_program_class(kind)


def may_have(thing: Any, name: str) -> bool:
    """Whether the program gets an attribute of something."""
    kind = type(thing)
    if name.startswith("preflight") or name in _UNSAFE:
        return False
    if isinstance(thing, type):
        if is_program_class(thing) or thing is object:
            return _is_in_program(thing, name) or (
                _of_class(thing, name) if _is_special(name) else _is_open(thing, name)
            )
        known = METHODS.get(thing)
        if known is not None:
            return name in known or name in ("__name__", "__init__", "__qualname__")
        is_open = is_fake(thing) and not name.startswith("_")
        is_of_path = issubclass(thing, PurePosixPath) and name in _OF_PATHS
        return is_open or is_of_path or name in ("__name__", "__init__", "__qualname__")
    if is_program_class(kind):
        if _is_special(name):
            return name == "__class__" or _is_in_program(kind, name) or (name == "__dict__" and _is_plain_class(kind))
        return _is_in_program(kind, name) or name in getattr(thing, "__dict__", ()) or _is_open(kind, name)
    if isinstance(thing, (Function, types.MethodType)):
        return name in ("__name__", "__qualname__", "__doc__")
    if name.startswith("_"):
        return name == "__class__" or (name in _PRIVATE and is_fake(kind))
    if isinstance(thing, BaseException):
        return name in _OF_ERRORS
    known = METHODS.get(kind)
    if known is not None:
        return name in known
    if isinstance(thing, PurePosixPath):
        return name in _OF_PATHS
    return is_fake(kind) or (kind.__module__ == FILES and kind.__name__ in _FILES)


def _of_class(kind: type, name: str) -> bool:
    return name in _PUBLIC_OF_OBJECT


def _is_open(kind: type, name: str) -> bool:
    """Whether a class of the program's may have what it has from what it is made from."""
    if name.startswith("_"):
        return not any(hasattr(each, name) for each in kind.__mro__ if not is_program_class(each))
    if issubclass(kind, BaseException):
        return name in _OF_ERRORS or not hasattr(BaseException, name)
    return True


def _is_plain_class(kind: type) -> bool:
    return all(each is object or is_program_class(each) for each in kind.__mro__)


def _is_special(name: str) -> bool:
    return name.startswith("__")


def _is_in_program(kind: type, name: str) -> bool:
    return any(name in vars(each) for each in kind.__mro__ if is_program_class(each))


def check_size(value: Any) -> Any:
    """The value; raises `NotRead` where it is larger than anyone writes."""
    if isinstance(value, (str, bytes)):
        if len(value) > MAX_TEXT:
            raise NotRead("a text is too long")
    elif isinstance(value, (list, tuple, dict, set, frozenset, collections.deque)) and len(value) > MAX_ITEMS:
        raise NotRead("a collection is too large")
    elif isinstance(value, int) and value.bit_length() > MAX_BITS:
        raise NotRead("a number is too large")
    return value


def whole(*values: Any) -> int:
    """How much is within values, each time that it is there; raises `NotRead` where that is more than anyone writes, or
    where a value is within itself."""
    left = MAX_ITEMS
    depth = 0
    level: list[Any] = list(values)
    while level:
        depth += 1
        left -= len(level)
        if left < 0 or depth > MAX_DEPTH:
            raise NotRead("a value is too large")
        below: list[Any] = []
        for each in level:
            if isinstance(each, (str, bytes)):
                left -= len(each) // 100
            elif isinstance(each, TextSubstitution):
                left -= len(each.text) // 100
            elif isinstance(each, (dict, list, tuple, set, frozenset, collections.deque)):
                if len(below) + len(each) > left:
                    raise NotRead("a value is too large")
                below += dict.keys(each) if isinstance(each, dict) else each
                if isinstance(each, dict):
                    below += dict.values(each)
        level = below
    return MAX_ITEMS - left


def check_keys(keys: Any) -> None:
    """The same for many: that they are equal to each other is found out for each pair of them at worst."""
    is_large = isinstance(keys, (list, tuple, set, frozenset, range)) and len(keys) > MAX_KEYS
    if is_large and not all(isinstance(each, str) for each in keys):
        raise NotRead("a collection is too large")


def check_key(key: Any) -> None:
    """Raise `NotRead` where a key takes long to compare, or is too deep for Python."""
    if isinstance(key, (tuple, frozenset)):
        whole(key)


def check_operation(name: str, left: Any, right: Any) -> None:
    """Raise `NotRead` where an operation makes something too large, or is one of values that are not known here."""
    for each in (left, right):
        if not isinstance(each, _OPERANDS) and not is_fake(type(each)) and not is_program_class(type(each)):
            raise NotRead(f"an operation with a {type(each).__name__}")
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


def _check_bits(count: int) -> None:
    if count > MAX_BITS:
        raise NotRead("a number is too large")
