"""The parameters that plugins declare in the node that loads them, below the name that it gives them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from preflight_analysis.source.analyse import SourceAnalysis
from preflight_analysis.source.cpp_analysis import PLUGIN_NODE
from preflight_analysis.source.known_params import LaunchParams
from preflight_analysis.tracing.interface import ParamUse

_GIVEN = "preflight_plugin"
_BELOW = f"~{_GIVEN}."
_TWICE = f"{_GIVEN}."


def plugin_params(analysis: SourceAnalysis, name: str, package: str | None = None) -> Mapping[str, ParamUse] | None:
    """The parameters of a plugin by their names below its own; None where its source is not there.

    `{sources}.topic` stands for `front.topic` where the parameter `sources` has `front` among its items. `../speed` is
    not below the name of the plugin, but of the one that loads it.
    """
    found = _read(analysis, name, package, {})
    if found is None:
        return None
    marks = {each: f"preflight_{each}" for each, use in found.items() if _may_name_more(use)}
    given = {each: mark if isinstance(found[each].default, str) else [mark] for each, mark in marks.items()}
    more = _read(analysis, name, package, given) if given else None
    for param, use in (more or {}).items():
        mark = next((each for each in marks if f"{marks[each]}." in param), None)
        if mark is not None:
            found[param.replace(marks[mark], f"{{{mark}}}")] = replace(use, default=_unless(use.default, marks[mark]))
    return found


def _may_name_more(use: ParamUse) -> bool:
    """Whether it may have names that have parameters each, and has none by itself."""
    return use.default in ("", []) or (use.type == "string array" and not use.default)


def _unless(default: Any, mark: str) -> Any:
    return None if isinstance(default, str) and mark in default else default


def _read(
    analysis: SourceAnalysis, name: str, package: str | None, given: Mapping[str, Any]
) -> dict[str, ParamUse] | None:
    params = LaunchParams({f"{PLUGIN_NODE}/{_GIVEN}.{each}": value for each, value in given.items()})
    said = analysis.plugin(name, _GIVEN, params, package)
    if said is None:
        return None
    found = {use.name.removeprefix(_BELOW): use for use in said.params if use.name.startswith(_BELOW)}
    if not any(each.startswith(_TWICE) for each in found):
        return found
    # What a plugin loads gets the name of that as well.
    return {each.removeprefix(_TWICE) if each.startswith(_TWICE) else f"../{each}": use for each, use in found.items()}
