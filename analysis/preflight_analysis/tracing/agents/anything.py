"""A stand-in for what is not known: it takes any call, has any attribute, and its value is unknown.

Launch files and nodes that import a module that is not installed get one in its place (`missing_modules`), so that all
that does not depend on it goes on as it is. Made to a text it is a mark that names where it comes from, and stays one
in every text that is made of it: the host takes such a text for unknown (`MARK`).
"""

from __future__ import annotations

import abc
import builtins
import dis
import re
import sys
import types
from typing import Any, Callable, Iterator

BEGIN, END = "\ufdd0", "\ufdd1"
"""Around what a text that is not known stands for: noncharacters, which no file has, and YAML and XML allow."""
_DIGITS = "".join(map(chr, range(0xFDD2, 0xFDE2)))
"""What the name is written with: whatever a program cuts out of a mark is known to be a part of one."""
_ENCODED, _DECODED = str.maketrans("0123456789abcdef", _DIGITS), str.maketrans(_DIGITS, "0123456789abcdef")
MARKS = re.compile("[\ufdd0-\ufdef]+")
_MARK = re.compile(f"{BEGIN}((?:[{_DIGITS}]{{2}})+){END}")
_ESCAPED = re.compile(r"\\u([fF][dD][dDeE][0-9a-fA-F])")
"""A mark as `repr`, JSON and YAML write it."""
_LOST = "..."
"""What stands for a mark of which only some is left."""
MAX_NAME = 100
MAX_ASKED = 1000
"""How often one place of a program has one answer to what is not known: `while camera.is_open()` has an end."""
_EXCEPTIONS = ("Error", "Exception", "Warning", "Interrupt", "Failure", "Timeout")
_FUNCTIONS = (types.FunctionType, types.MethodType, type)


on_condition: list[Callable[[str, Any, bool], bool]] = []
"""Called where a program asks whether something holds that is not known, and goes on in one way of several: with the
name of what that is, the frame that asks, and the answer that it would get; gives the answer that it gets."""


def asked(name: str, frame: Any, answer: bool = True) -> bool:
    """A program asks whether something of that name holds: what it is answered."""
    for each in on_condition:
        answer = each(name, frame, answer)
    return not answer if _too_often(frame) else answer


_asked: dict[Any, int] = {}


def _too_often(frame: Any) -> bool:
    """Whether a place of a program asks again and again: it waits for an answer that pleases."""
    place = (frame.f_code, frame.f_lasti)
    _asked[place] = _asked.get(place, 0) + 1
    return _asked[place] > MAX_ASKED


def unknown_text(name: str) -> str:
    """A text that is not known; `name` says of what."""
    encoded = readable(name)[:MAX_NAME].encode("utf-8", "surrogatepass").hex().translate(_ENCODED)
    text: str = marked(f"{BEGIN}{encoded}{END}")
    return text


def is_unknown(text: Any) -> bool:
    """Whether some of a text is not known."""
    return isinstance(text, str) and not text.isascii() and MARKS.search(text) is not None


def readable(text: str) -> str:
    """The same for people."""
    return str(text) if text.isascii() else MARKS.sub(lambda found: name_of(found[0]), text)


def name_of(marks: str) -> str:
    """What stands between marks: the names of what is not known."""
    names = (bytes.fromhex(each.translate(_DECODED)).decode("utf-8", "replace") for each in _MARK.findall(marks))
    return " ".join(names) or _LOST


def marked(text: Any) -> Any:
    """A text; where some of it is not known, and somebody wants to be told of conditions, one that tells."""
    if type(text) is not str or not on_condition:
        return text
    if "\\u" in text:
        text = _ESCAPED.sub(lambda found: chr(int(found[1], 16)), text)
    return UnknownText(text) if is_unknown(text) else text


class UnknownText(str):
    """A text of which some is not known: what is made of it stays so, and who compares it with another is told of."""

    __hash__ = str.__hash__

    def __radd__(self, other: Any) -> Any:
        return marked(str.__add__(other, self)) if isinstance(other, str) else NotImplemented

    def __bool__(self) -> bool:
        return asked(self, sys._getframe(1))

    def __repr__(self) -> str:
        return marked(str.__repr__(self))  # type: ignore[no-any-return]

    def __format__(self, spec: str) -> str:
        return self  # a precision would cut it

    def __iter__(self) -> Iterator[Any]:
        """Nobody knows how many characters there are."""
        return iter([self])


_TEXTS = (
    *(
        "__add__",
        "__getitem__",
        "__mod__",
        "__mul__",
        "capitalize",
        "casefold",
        "center",
        "expandtabs",
        "format",
        "format_map",
        "join",
        "ljust",
        "lower",
    ),
    *(
        "lstrip",
        "removeprefix",
        "removesuffix",
        "replace",
        "rjust",
        "rstrip",
        "strip",
        "swapcase",
        "title",
        "translate",
        "upper",
        "zfill",
    ),
)
_LISTS = ("partition", "rpartition", "rsplit", "split", "splitlines")
_TRUTHS = (
    *("__contains__", "__eq__", "__ge__", "__gt__", "__le__", "__lt__", "__ne__", "endswith", "startswith"),
    *("isalnum", "isalpha", "isdecimal", "isdigit", "isidentifier", "islower", "isnumeric", "isspace", "isupper"),
)


def _of_text(method: Any, result: Callable[[Any], Any]) -> Any:
    def called(self: Any, *args: Any, **kwargs: Any) -> Any:
        return result(method(self, *args, **kwargs))

    return called


def _parts_of_text(method: Any) -> Any:
    """What takes a text apart. Where it finds nothing at which to do so, what is not known may have that."""

    def called(self: Any, *args: Any, **kwargs: Any) -> Any:
        found = method(self, *args, **kwargs)
        if isinstance(found, tuple) and not found[1]:
            found = tuple(each or unknown_text(self) for each in found)
        return type(found)(map(marked, found))

    return called


def _truth_of_text(method: Any) -> Any:
    def called(self: Any, *args: Any) -> Any:
        result = method(self, *args)
        return asked(self, sys._getframe(1), result) if isinstance(result, bool) else result

    return called


for _each in _TEXTS:
    if hasattr(str, _each):  # an older Python has fewer
        setattr(UnknownText, _each, _of_text(getattr(str, _each), marked))
for _each in _LISTS:
    setattr(UnknownText, _each, _parts_of_text(getattr(str, _each)))
for _each in _TRUTHS:
    setattr(UnknownText, _each, _truth_of_text(getattr(str, _each)))


on_use: list[Callable[[], None]] = []
"""Called, once, when a program does something with a stand-in, and what it does from then on may depend on it."""


def used() -> None:
    """A value that is not known takes part in what the program does."""
    while on_use:
        on_use.pop()()


class _AnyClass(abc.ABCMeta):
    """Has whatever is asked of a class; abstract classes can be bases beside it."""

    def __getattr__(cls, name: str) -> Any:
        if name.startswith("__") or name.startswith("_abc_"):
            raise AttributeError(name)
        return Anything(f"{cls.__name__}.{name}")


class AnyBase:
    """What a class is derived from whose base is a stand-in."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        pass

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__()

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return Anything(f"{type(self).__name__}.{name}")

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        return Anything(f"{type(self).__name__}()")

    def __fspath__(self) -> str:
        return unknown_text(type(self).__name__)


class Anything:
    """One stand-in. `name` is what it stands for as a program has it: `cv2.VideoCapture().read()`."""

    def __init__(self, name: str) -> None:
        self.__dict__["_preflight_name"] = name[:MAX_NAME]
        self.__dict__["_preflight_made"] = {}

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        used()
        return member(self._preflight_made, self._preflight_name, name)

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        used()
        if len(args) == 1 and not kwargs and isinstance(args[0], _FUNCTIONS):
            return args[0]  # as a decorator it leaves what it is given as it is
        return Anything(self._preflight_name if self._preflight_name.endswith(")") else self._preflight_name + "()")

    def __mro_entries__(self, bases: Any) -> tuple[type, ...]:
        """As the base of a class."""
        kinds = {type(each) for each in bases if isinstance(each, type)}
        kind = _AnyClass if kinds <= {type, abc.ABCMeta, _AnyClass} else type
        made = self._preflight_made
        if kind not in made:
            made[kind] = kind(self._preflight_name.rpartition(".")[2], (AnyBase,), {})
        return (made[kind],)

    def __instancecheck__(self, instance: Any) -> bool:
        return False

    def __subclasscheck__(self, subclass: Any) -> bool:
        return False

    # As a text

    def __str__(self) -> str:
        used()
        return unknown_text(self._preflight_name)

    __repr__ = __fspath__ = __str__

    def __format__(self, spec: str) -> str:
        return str(self)

    def __bytes__(self) -> bytes:
        return str(self).encode()

    # As a number

    def __bool__(self) -> bool:
        used()
        return asked(self._preflight_name, sys._getframe(1))

    def __int__(self) -> int:
        used()
        return 1

    __index__ = __trunc__ = __floor__ = __ceil__ = __len__ = __int__

    def __float__(self) -> float:
        used()
        return 1.0

    def __complex__(self) -> complex:
        return 1 + 0j

    def __round__(self, digits: Any = None) -> Any:
        return 1 if digits is None else self

    def __lt__(self, other: Any) -> bool:
        used()
        return asked(self._preflight_name, sys._getframe(1), False)

    __le__ = __gt__ = __ge__ = __lt__

    def __eq__(self, other: Any) -> bool:
        return asked(self._preflight_name, sys._getframe(1), self is other)

    def __ne__(self, other: Any) -> bool:
        return asked(self._preflight_name, sys._getframe(1), self is not other)

    __hash__ = object.__hash__

    # As a collection

    def __iter__(self) -> Iterator[Any]:
        """One item, or as many as it is taken apart to."""
        name, count = operation(sys._getframe(1))
        if name == "UNPACK_EX":
            count = (count & 0xFF) + (count >> 8)
        elif name != "UNPACK_SEQUENCE":
            count = int(asked(self._preflight_name, sys._getframe(1)))
        return iter([self[0] for _ in range(count)])

    def __next__(self) -> Any:
        return self[0]

    def __getitem__(self, key: Any) -> Any:
        used()
        return Anything(self._preflight_name if self._preflight_name.endswith("]") else self._preflight_name + "[...]")

    def __setitem__(self, key: Any, value: Any) -> None:
        return None

    def __delitem__(self, key: Any) -> None:
        return None

    def __contains__(self, item: Any) -> bool:
        used()
        return asked(self._preflight_name, sys._getframe(1), False)

    def keys(self) -> list[str]:
        """None for the arguments of a call; where a dictionary takes it in, one that stands for those not known."""
        name, _ = operation(sys._getframe(1))
        return [str(self)] if name in ("DICT_UPDATE", "BUILD_MAP_UNPACK") else []

    # In `with` and `await`

    def __enter__(self) -> Any:
        used()
        return Anything(self._preflight_name)

    def __exit__(self, *args: Any) -> None:
        return None

    async def __aenter__(self) -> Any:
        return Anything(self._preflight_name)

    async def __aexit__(self, *args: Any) -> None:
        return None

    def __await__(self) -> Any:
        return self
        yield

    async def __aiter__(self) -> Any:
        yield self[0]

    def __deepcopy__(self, memo: Any) -> Any:
        return self

    def __copy__(self) -> Any:
        return self

    def __reduce__(self) -> Any:
        return Anything, (self._preflight_name,)

    # With others

    def __add__(self, other: Any) -> Any:
        if isinstance(other, str):
            return str(self) + other
        return type(other)([self, *other]) if isinstance(other, (list, tuple)) else Anything(self._preflight_name)

    def __radd__(self, other: Any) -> Any:
        if isinstance(other, str):
            return other + str(self)
        return type(other)([*other, self]) if isinstance(other, (list, tuple)) else Anything(self._preflight_name)


def _same_kind(self: Any, *args: Any) -> Any:
    used()
    return Anything(self._preflight_name)


for _each in ("sub", "mul", "truediv", "floordiv", "mod", "pow", "matmul", "and", "or", "xor", "lshift", "rshift"):
    setattr(Anything, f"__{_each}__", _same_kind)
    setattr(Anything, f"__r{_each}__", _same_kind)
for _each in ("neg", "pos", "invert", "abs"):
    setattr(Anything, f"__{_each}__", _same_kind)
for _each in ("divmod", "rdivmod"):
    setattr(Anything, f"__{_each}__", lambda self, other: (self[0], self[0]))


def member(made: dict[str, Any], of: str, name: str) -> Any:
    """An attribute of a stand-in, the same each time; one that is called like an exception can be raised and caught.
    What we ask ourselves is no part of its name."""
    if name.startswith("preflight_"):
        return Anything(of)
    found = made.get(name)
    if found is None:
        raised = name[:1].isupper() and name.endswith(_EXCEPTIONS)
        found = type(name, (Exception,), {"__module__": of}) if raised else Anything(f"{of}.{name}")
        made[name] = found
    return found


class AnyModule(types.ModuleType):
    """A module that has whatever is asked of it."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.__path__: list[str] = []
        self.__version__ = "0.0.0"
        self.__dict__["_preflight_made"] = {}

    def __getattr__(self, name: str) -> Any:
        if name == "__all__":
            return wanted_names()
        if name.startswith("__"):
            raise AttributeError(f"module '{self.__name__}' has no attribute '{name}'")
        return member(self._preflight_made, self.__name__, name)


def wanted_names() -> list[str]:
    """What the program that says `from module import *` uses and has from nowhere else."""
    frame = importer()
    if frame is None:
        return []
    known = set(frame.f_globals) | set(vars(builtins))
    used: dict[str, None] = {}
    codes = [frame.f_code]
    while codes:
        code = codes.pop()
        codes += [each for each in code.co_consts if isinstance(each, types.CodeType)]
        for each in dis.get_instructions(code):
            if each.opname == "STORE_NAME" and code is frame.f_code:
                known.add(each.argval)
            elif each.opname in ("LOAD_NAME", "LOAD_GLOBAL") and isinstance(each.argval, str):
                used[each.argval] = None
    return [name for name in used if name not in known]


def importer() -> Any:
    """The frame that imports something, from within the import; None where no program does."""
    frame: Any = sys._getframe(1)
    while frame is not None:
        name = str(frame.f_globals.get("__name__"))
        ours = name.startswith(f"{__package__}.") and not name.startswith(f"{__package__}.fake_launch.")
        if not ours and not frame.f_code.co_filename.startswith("<frozen importlib") and name != "importlib":
            return frame
        frame = frame.f_back
    return None


def operation(frame: Any) -> tuple[str, int]:
    """The instruction at which a frame stands, and its argument."""
    code, at = frame.f_code.co_code, frame.f_lasti
    return (dis.opname[code[at]], code[at + 1]) if 0 <= at < len(code) - 1 else ("", 0)


Anything.__name__ = Anything.__qualname__ = "unknown value"
AnyModule.__name__ = AnyModule.__qualname__ = "module"
UnknownText.__name__ = UnknownText.__qualname__ = "str"
# As exceptions of Python call them.
