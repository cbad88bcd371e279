"""From what the evaluation met to findings: what all rules about problems share."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import chain
from pathlib import Path
from typing import TypeVar, cast

from preflight_analysis.catalogue.launches import catalogued_file
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location, Origin, Span
from preflight_analysis.edits.edit import Edit
from preflight_analysis.edits.writer import replaced
from preflight_analysis.evaluation.problems import Problem
from preflight_analysis.findings.finding import Fix, Related
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.problems import ProblemKind
from preflight_analysis.model.context import Context

_ANONYMOUS = re.compile(r"_ANON\d+")


K = TypeVar("K", bound=ProblemKind)


def problems_of(context: Context, *kinds: type[K]) -> Iterator[Problem[K]]:
    """The problems of these kinds, in the order in which they were met."""
    return (problem for _, problem in numbered_problems(context, *kinds))


def numbered_problems(context: Context, *kinds: type[K]) -> list[tuple[int, Problem[K]]]:
    """As `problems_of`, with their places among all problems of the tree."""
    by_kind = _by_kind(context)
    found = sorted(chain.from_iterable(by_kind.get(kind, ()) for kind in kinds))
    return cast(list[tuple[int, Problem[K]]], found)


@derived
def _by_kind(context: Context) -> dict[type[ProblemKind], list[tuple[int, Problem[ProblemKind]]]]:
    """All rules about problems look here, lest each looks at all of them."""
    found: dict[type[ProblemKind], list[tuple[int, Problem[ProblemKind]]]] = {}
    for numbered in enumerate(context.tree.problems):
        found.setdefault(type(numbered[1].kind), []).append(numbered)
    return found


def include_chain(origin: Origin) -> tuple[Related, ...]:
    """The include tags on the way to a place, the innermost first."""
    return tuple(Related("included here", location, "included") for location in reversed(origin[:-1]))


def rename(context: Context, location: Location, old: str, new: str, *, preferred: bool = True) -> tuple[Fix, ...]:
    """A fix that writes `new` for `old` in the value at `location`; none if that does not hold `old` exactly once."""
    document = context.document(location.file)
    return rename_in(document, location.span, old, new, preferred=preferred) if document is not None else ()


def rename_in(document: Document, span: Span, old: str, new: str | None, *, preferred: bool = True) -> tuple[Fix, ...]:
    """The same in a document that no launch has; none where nothing is meant."""
    edits = replaced(document, span, old, new) if new is not None else ()
    return fix(f"Replace '{old}' with '{new}'", edits, preferred=preferred)


def replacement(
    context: Context, location: Location, new: str, title: str, *, preferred: bool = True
) -> tuple[Fix, ...]:
    """A fix that writes `new` for all that stands at `location`, which is a part of a value."""
    writer = context.writer(location.file)
    return fix(title, writer.replace(location.span, new) if writer is not None else (), preferred=preferred)


def fix(title: str, edits: tuple[Edit, ...], *, preferred: bool = False) -> tuple[Fix, ...]:
    """A fix with these edits, if there are any."""
    return (Fix(title, edits, preferred),) if edits else ()


def all_of(*parts: tuple[Edit, ...]) -> tuple[Edit, ...]:
    """Edits that are right together only: none if one part of them cannot be made."""
    return tuple(chain(*parts)) if all(parts) else ()


def quoted(names: Iterable[str]) -> str:
    """`'a', 'b' and 'c'`."""
    return enumerated(f"'{name}'" for name in names)


def enumerated(names: Iterable[str]) -> str:
    """`a, b and c`."""
    words = [*names]
    return " and ".join(filter(None, (", ".join(words[:-1]), *words[-1:])))


def shortened(text: str) -> str:
    """A value as a message shows it, which may be as long as a file."""
    return text if len(text) <= 40 else f"{text[:37]}..."


def as_written(name: str) -> str:
    """A name with `$(anon x)` in place of what the evaluation makes of it, which is another at every launch."""
    pieces: list[str] = []
    at = 0
    for mark in _ANONYMOUS.finditer(name):
        start = max(at, name.rfind("/", at, mark.start()) + 1)
        if start < mark.start():
            pieces += (name[at:start], f"$(anon {name[start : mark.start()]})")
            at = mark.end()
    return "".join((*pieces, name[at:]))


def shown(path: str, context: Context) -> str:
    """A path as a message shows it: below its package or the workspace if it is there, else in full."""
    if (catalogued := catalogued_file(path)) is not None:
        return str(catalogued)
    best = ""
    for package in context.environment.packages.values():
        share = package.share.rstrip("/")
        if path.startswith(share + "/") and len(share) > len(best):
            best = share
    if best:
        return f"{Path(best).name}{path[len(best) :]}"
    return path
