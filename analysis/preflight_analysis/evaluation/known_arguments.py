"""What the words of a node's command line stand for, by what is known of its executable."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.evaluation.words import beside_ros, words_of
from preflight_analysis.knowledge.model import Entry

_REMAP = ":="
_REST = "..."
_KEPT = 256
_MOST = 256
"""Words of a command line."""


class _Word(NamedTuple):
    """A word of a form: a name for what stands there, or the text itself."""

    text: str
    is_name: bool
    optional: bool
    rest: bool


def arguments_of(node: LaunchNode, entry: Entry) -> Mapping[str, Any]:
    """The values of the arguments by their names: texts, a list for `{name}...`. Of words that are unresolved, or fit
    no form, none."""
    if not (entry.arguments or entry.options) or node.unknowns:
        return {}
    options, words = _split(node.args, entry.options)
    for form in entry.arguments:
        found = _fitting(_form(form), words)
        if found is not None:
            return {**found, **options}
    return options


def _split(args: str, options: Mapping[str, str]) -> tuple[dict[str, Any], list[str]]:
    """The values of options, and the words that belong to none. Remaps and private parameters (`_lazy:=true`) may
    stand anywhere."""
    found, words = dict[str, Any](), list[str]()
    given = iter([word for word in beside_ros(words_of(args)[:_MOST]) if _REMAP not in word])
    for word in given:
        option, sign, value = word.partition("=")
        if word in options:
            found[options[word]] = next(given, "")
        elif sign and option in options:
            found[options[option]] = value
        elif not word.startswith("-"):
            words.append(word)
    return found, words


def _fitting(form: Sequence[_Word], words: Sequence[str]) -> dict[str, Any] | None:
    found = dict[str, Any]()
    for at, word in enumerate(form):
        if word.rest:
            found[word.text] = list(words[at:])
            return found
        if at >= len(words):
            return found if word.optional else None
        if word.is_name:
            found[word.text] = words[at]
        elif word.text != words[at]:
            return None
    return found


@lru_cache(maxsize=_KEPT)
def _form(form: str) -> tuple[_Word, ...]:
    return tuple(map(_word, form.split()))


def _word(text: str) -> _Word:
    optional = text.startswith("[") and text.endswith("]")
    inner = text[1:-1] if optional else text
    rest = inner.endswith(_REST)
    inner = inner.removesuffix(_REST)
    is_name = inner.startswith("{") and inner.endswith("}")
    return _Word(inner[1:-1] if is_name else inner, is_name, optional, rest and is_name)
