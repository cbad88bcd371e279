"""Which topics Gazebo's sensors and system plugins have, as data (`topics.yaml` says how names are written)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import field
from functools import cache
from pathlib import Path
from typing import Any, Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.yaml import load_plain

_FILE = Path(__file__).with_name("topics.yaml")
_AROUND = re.compile(r"(?:lib)?(?:(?:gz-sim|ignition-gazebo)\d*-)?(?P<name>.+?)(?:[-_]system)?(?:\.so)?\Z")
_CLASSIC = re.compile(r"(?:lib)?gazebo_ros_")

Direction = Literal["publishes", "subscribes"]


@dataclass(frozen=True, slots=True)
class TopicForm:
    """A topic of a sensor or plugin. `names` are forms of which the first counts whose parts are all there; `type` is
    that of Gazebo without its package, `*` for any; `when` has the values that elements must have, None for not set."""

    names: tuple[str, ...]
    type: str
    direction: Direction
    when: Mapping[str, str | None] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class SensorForm:
    """What a kind of sensor has: the last part of its default topic, the plugin that publishes it, its topics."""

    default: str
    system: str
    topics: tuple[TopicForm, ...]


@dataclass(frozen=True, slots=True)
class GazeboTopics:
    """`sensors` by their type, `plugins` by their name without `gz-sim-` and `-system`; `defaults` are those of a world
    that names none."""

    sensors: Mapping[str, SensorForm]
    plugins: Mapping[str, tuple[TopicForm, ...]]
    world: tuple[TopicForm, ...]
    defaults: tuple[str, ...]


@cache
def gazebo_topics() -> GazeboTopics:
    """All that is known."""
    data = load_plain(_FILE.read_text(encoding="utf-8"))
    sensors = {
        type_: SensorForm(row["default"], row["system"], tuple(_forms(row)))
        for row in data["sensors"]
        for type_ in row["types"]
    }
    plugins = {name: tuple(_forms(row)) for name, row in data["plugins"].items()}
    silent = dict.fromkeys(data["silent"], ())
    return GazeboTopics(sensors, {**silent, **plugins}, tuple(_forms(data["world"])), tuple(data["defaults"]))


def plugin_name(filename: str) -> str:
    """The name of a plugin by its file: `diff-drive` of `libgz-sim-diff-drive-system.so`."""
    found = _AROUND.match(filename.rpartition("/")[2])
    return found["name"] if found is not None else filename


def is_of_classic(filename: str) -> bool:
    """Whether it is a plugin of gazebo_ros_pkgs, which Gazebo does not load."""
    return _CLASSIC.match(filename) is not None


def _forms(row: Mapping[str, Any]) -> Iterator[TopicForm]:
    directions: tuple[Direction, ...] = ("publishes", "subscribes")
    for direction in directions:
        for each in row.get(direction, ()):
            when = {key: None if value == "unset" else value for key, value in each.get("when", {}).items()}
            yield TopicForm(tuple(each["name"]), each["type"], direction, when)
