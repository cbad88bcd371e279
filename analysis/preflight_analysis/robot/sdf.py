"""The text of a world or model of Gazebo to what it says (http://sdformat.org/spec)."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import Literal

from lxml import etree

from preflight_analysis.documents.reading import SIZE_LIMIT
from preflight_analysis.robot.model import GazeboPlugin, IncludedModel, Simulated, SimulatedSensor
from preflight_analysis.robot.parse import plugin_of, sensor_of, xml_root

_KEPT = 32
_MAX_DEPTH = 8
"""Of models in models."""


@lru_cache(maxsize=_KEPT)
def parse_sdf(text: str) -> tuple[Simulated, ...] | None:
    """The worlds and models of a file; None for what is no SDF. Never raises."""
    if len(text) > SIZE_LIMIT:
        return None
    try:
        root = xml_root(text)
    except (etree.XMLSyntaxError, ValueError):
        return None
    if root.tag != "sdf":
        return None
    worlds = [_simulated(each, "world", 0) for each in root.iterchildren("world")]
    return (*worlds, *(_simulated(each, "model", 0) for each in root.iterchildren("model")))


def _simulated(element: etree._Element, kind: Literal["world", "model"], depth: int) -> Simulated:
    models = element.iterchildren("model") if depth < _MAX_DEPTH else ()
    includes = list(element.iterchildren("include"))
    added = (Simulated("model", _text(each, "name") or "*", _plugins(each)) for each in includes if _plugins(each))
    return Simulated(
        kind,
        element.get("name") or "*",
        _plugins(element),
        tuple(_sensors(element)),
        (*(_simulated(each, "model", depth + 1) for each in models), *added),
        tuple(IncludedModel(_text(each, "uri"), _text(each, "name")) for each in includes),
    )


def _plugins(element: etree._Element) -> tuple[GazeboPlugin, ...]:
    return tuple(map(plugin_of, element.iterchildren("plugin")))


def _sensors(element: etree._Element) -> Iterator[SimulatedSensor]:
    for tag in ("link", "joint"):
        for each in element.iterchildren(tag):
            within = f"/{tag}/{each.get('name') or '*'}"
            yield from (sensor_of(sensor, within) for sensor in each.iterchildren("sensor"))


def _text(element: etree._Element, tag: str) -> str:
    return (element.findtext(tag) or "").strip()
