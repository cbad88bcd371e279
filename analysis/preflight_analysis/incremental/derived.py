"""What follows from one immutable object alone is made once, and lives as long as the object."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from functools import wraps
from typing import Any, Concatenate, ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")
Item = TypeVar("Item", bound="Remembering")


class Remembering:
    """A base for immutable objects: what is `derived` from one is with it."""

    __slots__ = ("_made",)
    _made: dict[Hashable, Any]


def derived(function: Callable[Concatenate[Item, P], T]) -> Callable[Concatenate[Item, P], T]:
    """Make a pure function of an immutable object, and of hashable values given by their places, one that is called for
    the first who asks."""

    @wraps(function)
    def ask(item: Item, /, *arguments: P.args, **none: P.kwargs) -> T:
        key = (function, *arguments)
        try:
            found: T = item._made[key]
        except AttributeError:
            object.__setattr__(item, "_made", {})
        except KeyError:
            pass
        else:
            return found
        made = function(item, *arguments, **none)
        return item._made.setdefault(key, made)  # type: ignore[no-any-return]

    return ask
