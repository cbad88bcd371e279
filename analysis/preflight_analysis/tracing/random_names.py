"""Names that a node makes up at random: another run makes others, and none of them is a fact."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from dataclasses import replace

from preflight_analysis.tracing.agents.variables import DRAWN
from preflight_analysis.tracing.interface import DOES, Endpoint, Interface
from preflight_analysis.tracing.observation import Observation
from preflight_analysis.tracing.recipe import Recipe

_MADE_UP = re.compile(r"\d{4}|[0-9a-f]{8}")
"""In a name that may have the time in it, or what a library drew."""


def may_make_up(observed: Observation) -> bool:
    """Whether a second run is needed to tell: the node drew something before it ended, or a name looks like that."""
    own = [each for each in observed.interface.endpoints if not each.builtin]
    return bool(own) and (bool(observed.drawn) or any(_MADE_UP.search(each.name) for each in own))


def otherwise(recipe: Recipe, observed: Observation) -> Recipe:
    """The same run, in which the node draws something else."""
    return replace(recipe, env={**recipe.env, DRAWN: json.dumps(observed.drawn)})


def without_made_up(interface: Interface, other: Interface) -> Interface:
    """The interface without the endpoints that the `other` run made under another name. Where that one ended otherwise
    nothing follows."""
    if interface.outcome.status != other.outcome.status:
        return interface
    there = {(each.role, each.name) for each in other.endpoints}
    here = {(each.role, each.name) for each in interface.endpoints}
    places = {_place(each) for each in other.endpoints if (each.role, each.name) not in here}
    made_up = tuple(
        each
        for each in interface.endpoints
        if not each.builtin and (each.role, each.name) not in there and _place(each) in places
    )
    if not made_up:
        return interface
    return replace(
        interface,
        endpoints=tuple(each for each in interface.endpoints if each not in made_up),
        unnamed=made_up,
        notes=(*interface.notes, *_notes(made_up)),
    )


def _place(endpoint: Endpoint) -> tuple[object, ...]:
    return endpoint.role, endpoint.type, endpoint.source_file, endpoint.source_line


def _notes(made_up: Iterable[Endpoint]) -> Iterable[str]:
    for each in made_up:
        at = f", line {each.source_line}" if each.source_line is not None else ""
        type_ = f" ({each.type})" if each.type else ""
        yield (
            f"unresolved name: it {DOES[each.role]} a name that is random in each run{type_}{at}; in one run it was "
            f"'{each.name}'"
        )
