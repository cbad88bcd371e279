"""Finds what launch files of ROS 2 are made of. Each module of this package has `ENTITIES`."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cache
from types import ModuleType

import preflight_analysis.evaluation.ros2.actions as package
from preflight_analysis.evaluation.ros2.entity import Entity, Part
from preflight_analysis.evaluation.ros2.walk import LaunchAction
from preflight_analysis.launch.schema import Tag


@cache
def entities() -> Mapping[str, Entity]:
    """Everything by its kind. Raises `TypeError` for a module without `ENTITIES`, `ValueError` for a doubled kind."""
    found: dict[str, Entity] = {}
    for module in _modules():
        for entity in _entities_of(module):
            if entity.kind in found:
                raise ValueError(f"'{entity.kind}' is declared twice")
            found[entity.kind] = entity
    return found


@cache
def actions() -> Mapping[str, LaunchAction]:
    """The actions, in the order in which they are offered."""
    found = [entity for entity in entities().values() if isinstance(entity, LaunchAction)]
    return {action.kind: action for action in sorted(found, key=lambda action: action.offered)}


@cache
def parts() -> Mapping[str, Part]:
    """What belongs to actions."""
    return {kind: entity for kind, entity in entities().items() if isinstance(entity, Part)}


@cache
def tags() -> Mapping[str, Tag]:
    """The tags of XML and YAML files, with the actions that they may hold."""
    anywhere = tuple(action.kind for action in actions().values() if action.tag is not None)
    found: dict[str, Tag] = {}
    for entity in (*parts().values(), *actions().values()):
        if entity.tag is not None:
            inside = anywhere if entity.holds_actions else ()
            starts = entity.tag.starts or entity.holds_actions
            found[entity.kind] = replace(entity.tag, children=(*entity.tag.children, *inside), starts=starts)
    return found


def _modules() -> Iterator[ModuleType]:
    for info in pkgutil.iter_modules(package.__path__):
        if info.name != "registry":
            yield importlib.import_module(f"{package.__name__}.{info.name}")


def _entities_of(module: ModuleType) -> tuple[Entity, ...]:
    found = getattr(module, "ENTITIES", None)
    if not isinstance(found, tuple) or not found or not all(isinstance(each, (LaunchAction, Part)) for each in found):
        raise TypeError(f"{module.__name__} declares no ENTITIES")
    return found
