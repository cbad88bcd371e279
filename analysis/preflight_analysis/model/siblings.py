"""Names that a launch gives wrongly, by the other names that it gives to the same node."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise

from preflight_analysis.evaluation import names
from preflight_analysis.graph.model import Channel, Connection
from preflight_analysis.model.nearest import is_slip_of_words, likeness

_LEAST = 2
"""Characters of each part that a slash would separate."""


def without_slash(connection: Connection) -> tuple[str, str] | None:
    """The name that a remap was most likely to give, and the name beside it that says so: `/zed/nodergb/info` lacks a
    slash where the same node has `/zed/node/rgb/image`. Names are put together with `+`, and the slash is forgotten."""
    node, remap = connection.node, connection.remap
    if remap is None:
        return None
    parts = connection.name.split("/")
    for other in node.remaps:
        full = names.resolve(other.target, node.name)
        if full == connection.name:
            continue
        others = full.split("/")
        for index, (one, two) in enumerate(pairwise(others)):
            split = min(len(one), len(two)) >= _LEAST and parts[index : index + 1] == [one + two]
            if split and parts[:index] == others[:index]:
                return "/".join((*parts[:index], one, two, *parts[index + 1 :])), full
    return None


def slips_beside(dangling: Iterable[Connection], channels: Iterable[Channel]) -> Mapping[int, str]:
    """For publishers without a subscriber, by id, the name that their remap or parameter was most likely to give: the
    node publishes the same type under that name, too, and it is a slip away and has a subscriber."""
    placed = [each for each in dangling if each.is_placed and each.endpoint.type not in (None, "*")]
    if not placed:
        return {}
    nodes = {id(each.node) for each in placed}
    heard: dict[int, list[Connection]] = {}
    for channel in channels:
        for provider in channel.providers if channel.consumers else ():
            if id(provider.node) in nodes:
                heard.setdefault(id(provider.node), []).append(provider)
    meant = ((each, _slip(each, heard.get(id(each.node), ()))) for each in placed)
    return {id(each): name for each, name in meant if name is not None}


def _slip(connection: Connection, heard: Sequence[Connection]) -> str | None:
    found = {
        other.name
        for other in heard
        if other.endpoint.type == connection.endpoint.type
        and (alike := likeness(connection.name, other.name)) is not None
        and alike == ("typo", 1)
        and is_slip_of_words(connection.name, other.name)
    }
    return found.pop() if len(found) == 1 else None
