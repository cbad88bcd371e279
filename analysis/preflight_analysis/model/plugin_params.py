"""What plugins of pluginlib declare below the names that they are loaded by (ROS 2).

https://docs.nav2.org/configuration/: below the name of a plugin stand `plugin`, by which it is loaded, and what it
declares.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from preflight_analysis.model.context import Plugin, Plugins

KIND = ".plugin"
"""How the parameter ends that has the type of a plugin."""
LISTED = re.compile(r"\{(\w+)\}")
"""A part of a parameter's name that stands for each item of a list."""
_OF_PARENT = "../"
_CRITICS, _NAMESPACES = "critics", "default_critic_namespaces"
_MPPI = "mppi::critics"
_MOST = 64
"""Plugins that one loads."""


def declared_below(plugin: Plugin, values: Mapping[str, object], plugins: Plugins) -> Mapping[str, object]:
    """What is declared below the name of a plugin, with defaults: by itself, and by what it loads."""
    found: dict[str, object] = {}
    for name, default in plugin.params.items():
        listed = LISTED.match(name)
        if listed is None:
            found[name] = default
            continue
        for item in _items(values.get(listed[1])):
            found[f"{item}{name[listed.end() :]}"] = default
    for name in [*found]:
        value = values.get(name, found[name])
        inner = plugins.plugin(value) if isinstance(value, str) and "::" in value.replace("/", "::") else None
        for each, default in inner.params.items() if inner is not None else ():
            found.setdefault(each, default)
    for critic in _items(values.get(_CRITICS)):
        inner = _critic(plugin, critic, {**found, **values}, plugins)
        for each, default in inner.params.items() if inner is not None else ():
            at_parent = each.startswith(_OF_PARENT)
            found.setdefault(each.removeprefix(_OF_PARENT) if at_parent else f"{critic}.{each}", default)
    return found


def _critic(plugin: Plugin, name: str, values: Mapping[str, object], plugins: Plugins) -> Plugin | None:
    """What a controller loads by a name in the list of its critics."""
    if _NAMESPACES not in plugin.params:
        return plugins.plugin(f"{_MPPI}::{name}")
    cls = values.get(f"{name}.class") or name
    spaces = values.get(_NAMESPACES)
    names = [f"{space}::{cls}{end}" for space in _items(spaces) for end in ("", "Critic")]
    return next((found for each in (str(cls), *names) if (found := plugins.plugin(each)) is not None), None)


def _items(value: object) -> Sequence[str]:
    """What a list of texts has, or a text with spaces in between."""
    items = value.split() if isinstance(value, str) else value if isinstance(value, (list, tuple)) else ()
    return [each for each in items if isinstance(each, str)][:_MOST]


def declared_of_plugins(values: Mapping[str, object], plugins: Plugins) -> Mapping[str, tuple[object, Plugin]]:
    """The parameters that the plugins of a node declare, with default and plugin. `values` are those that the node is
    given: `FollowPath.plugin` has the type of the plugin of that name."""
    found: dict[str, tuple[object, Plugin]] = {}
    for param, type_ in values.items():
        name = param.removesuffix(KIND)
        plugin = plugins.plugin(type_) if name != param and name and isinstance(type_, str) else None
        if plugin is None:
            continue
        below = {each[len(name) + 1 :]: value for each, value in values.items() if each.startswith(f"{name}.")}
        for each, default in declared_below(plugin, below, plugins).items():
            if not each.startswith(_OF_PARENT):
                found.setdefault(f"{name}.{each}", (default, plugin))
    return found
