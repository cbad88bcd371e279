"""What substitutions share. `words` are what the host performs them from; `perform` is for code of the user's that asks
for the text in the middle of a run."""

from __future__ import annotations

from typing import Any, List

from .base import LaunchContext, Substitution, normalize_to_list_of_substitutions, perform_substitutions

Parts = List[Substitution]


class SubstitutionFailure(RuntimeError):
    def __init__(self, msg: str) -> None:
        super().__init__(msg)


def truth(text: str) -> bool:
    if text.lower() in ("true", "1", "yes", "on"):
        return True
    if text.lower() in ("false", "0", "no", "off"):
        return False
    raise SubstitutionFailure(f"Failed to convert '{text}' to a boolean")


class Worded(Substitution):
    """One that the host knows by its kind, with the texts that `words` are."""

    preflight_kind = ""
    """Where it is no class of launch's."""
    words: tuple[Parts, ...] = ()

    def preflight_keep(self, given: dict[str, Any]) -> None:
        self._words(*(value for name, value in given.items() if value is not None or name != "default_value"))
        self.preflight_given = {**given, **dict(zip(given, self.words))}

    def _words(self, *values: Any) -> None:
        self.words = tuple(normalize_to_list_of_substitutions(value) for value in values)

    def _text(self, context: LaunchContext, index: int) -> str:
        return perform_substitutions(context, self.words[index])


def is_scalar(value: Any) -> bool:
    return isinstance(value, (bool, int, float))
