"""Parts of a text that stay the same while others of it are edited."""

from __future__ import annotations

from dataclasses import field
from typing import TYPE_CHECKING, Any

from preflight_analysis.dataclass import dataclass
from preflight_analysis.incremental.derived import Remembering

if TYPE_CHECKING:
    from typing_extensions import Self


@dataclass(frozen=True, slots=True)
class Movable(Remembering):
    """A base for immutable objects with slots whose fields are texts, other scalars, what has `moved`, or tuples of
    such: what is parsed of a part of a text.

    A moved one is made field by field, when somebody asks: an edit near the start of a file moves thousands, and of
    nearly all of them nobody wants to know more than where they begin.
    """

    _original: Self | None = field(default=None, init=False, repr=False, compare=False)
    moved_by: int = field(default=0, init=False, repr=False, compare=False)
    """How far it is from where its original is."""

    def moved(self, by: int) -> Self:
        """The same where the text in front of it has become longer by so many characters."""
        original, by = self._original or self, self.moved_by + by
        if not by:
            return original
        new = object.__new__(type(self))
        object.__setattr__(new, "_original", original)
        object.__setattr__(new, "moved_by", by)
        return new

    @property
    def original(self) -> Self:
        """What this one was moved from, itself where it was not. What is made of that `once` is made once, however
        often it moves."""
        return self._original or self

    def __getattr__(self, name: str) -> Any:
        """A field that nobody has asked for yet."""
        if name.startswith("_") or self._original is None:
            raise AttributeError(f"{type(self).__name__} has no {name}", name=name, obj=self)
        value = moved(getattr(self._original, name), self.moved_by)
        object.__setattr__(self, name, value)
        return value


def moved(value: Any, by: int) -> Any:
    """What a field of a `Movable` may be, moved."""
    if not by:
        return value
    if type(value) is tuple:
        return tuple([moved(item, by) for item in value])
    return value.moved(by) if hasattr(value, "moved") else value
