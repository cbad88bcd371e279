"""Attributes that nobody knows and that were meant to be one that is missing: one slip, and one finding."""

from __future__ import annotations

from collections.abc import Iterable

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.tags import tags_of
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.problems import MissingAttribute
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import nearest
from preflight_analysis.model.problems import problems_of
from preflight_analysis.model.syntax import Tag, Tags


@dataclass(frozen=True, slots=True)
class Misspelt:
    """An attribute of the name `name`, written at `location`, that was meant to be `meant`."""

    name: str
    location: Location
    meant: str


def misspelt(context: Context, tag: Tag, file: str, needed: Iterable[str]) -> Misspelt | None:
    """The attribute of a tag that was probably meant to be one of those needed."""
    kind = tag.action.kind
    tags = tags_of(context.tree.generation)
    schema = tags.get(kind) or tags.get(kind.lower())
    known = schema.attributes if schema is not None else {}
    unknown = {attribute.name: attribute for attribute in tag.action.attributes if attribute.name not in known}
    for name in needed:
        near = nearest(name, unknown)
        if near is not None:
            return Misspelt(near, context.location(file, unknown[near].name_span), name)
    return None


@derived
def explained(context: Context) -> frozenset[Location]:
    """Where those are written that stand for a missing one: that finding says it all."""
    tags = Tags(context.launch_files)
    found = set()
    for problem in problems_of(context, MissingAttribute):
        tag = tags.named_at(problem.location)
        each = misspelt(context, tag, problem.location.file, problem.kind.names) if tag else None
        if each is not None:
            found.add(each.location)
    return frozenset(found)
