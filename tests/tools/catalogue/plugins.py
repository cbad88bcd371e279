"""What plugins of nodes make and declare, as it stands in the catalogue: by what they are loaded as."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from preflight_analysis.environment.model import Package
from preflight_analysis.interfaces.nodl_groups import GROUPS
from preflight_analysis.model.plugin_params import LISTED
from preflight_analysis.source.analyse import SourceAnalysis
from preflight_analysis.source.cpp_analysis import PLUGIN_NODE
from preflight_analysis.source.known_params import LaunchParams
from preflight_analysis.source.plugins import plugin_params
from preflight_analysis.tracing.interface import Endpoint, ParamUse, Role

from tools.catalogue.sources import VALUES

_NAME = "preflight_plugin"
_ITEM = "preflight_item_of_"
_MARK = "preflight_named"
_OF_NODE = re.compile(rf"\A/?{PLUGIN_NODE[1:]}/")

Ends = Mapping[tuple[Role, str], Endpoint]


def plugins_of(analysis: SourceAnalysis, package: Package) -> Iterator[tuple[str, dict[str, Any], dict[str, ParamUse]]]:
    """The plugins that a package has: name, what it makes in the groups of NoDL, parameters.

    In names `{}` stands for the name that a plugin is loaded by, and `{sources}` for each item of that parameter of
    it; the parameters of `named_by` and `typed_by` stand below its name."""
    for name in analysis.plugins(package.name):
        params = dict(plugin_params(analysis, name, package.name) or {})
        yield name.replace("/", "::"), _Plugin(analysis, name, package.name, params).ends(), params


@dataclass(frozen=True, slots=True)
class _Plugin:
    analysis: SourceAnalysis
    name: str
    package: str
    params: Mapping[str, ParamUse]

    def ends(self) -> dict[str, list[dict[str, Any]]]:
        plain = self._read({})
        rows = {key: _row(end) for key, end in plain.items()}
        named: list[tuple[Role, dict[str, Any]]] = []
        for param, use in self.params.items():
            if not (use.default is None or isinstance(use.default, str)) or param in self._listed():
                continue
            more = self._read({_place(param): _MARK})
            for (role, name), end in more.items():
                gone = [key for key in plain if key not in more and key[0] == role]
                if name == _MARK and len(gone) == 1:
                    rows[gone[0]]["named_by"] = param
                elif name == _MARK:
                    named.append((role, {**_row(end), "name": None, "named_by": param}))
            for value in VALUES.get(param.rpartition(".")[2], ()):
                for key, end in self._read({_place(param): value}).items():
                    if key in plain and end.type is not None:
                        rows[key].setdefault("typed_by", {}).setdefault(param, {})[value.lower()] = end.type
        for row in rows.values():
            _without_one_type(row)
        found: dict[str, list[dict[str, Any]]] = {}
        for role, row in (*((role, row) for (role, _), row in rows.items()), *named):
            plain_row = {key: value for key, value in row.items() if value is not None}
            found.setdefault(GROUPS[role], []).append(plain_row)
        return found

    def _listed(self) -> set[str]:
        return {match[1] for each in self.params if (match := LISTED.match(each)) is not None}

    def _read(self, given: Mapping[str, str]) -> Ends:
        items: dict[str, Any] = {
            each: f"{_ITEM}{each}" if isinstance(self.params[each].default, str) else [f"{_ITEM}{each}"]
            for each in self._listed()
        }
        below = {f"{PLUGIN_NODE}/{_NAME}.{each}": value for each, value in {**items, **given}.items()}
        said = self.analysis.plugin(self.name, _NAME, LaunchParams(below), self.package)
        return {(end.role, end.name): end for end in (said.endpoints if said is not None else ()) if not end.builtin}


def _place(param: str) -> str:
    match = LISTED.match(param)
    return f"{_ITEM}{match[1]}{param[match.end() :]}" if match is not None else param


def _row(end: Endpoint) -> dict[str, Any]:
    # What is made of the name of the node is private.
    name = _OF_NODE.sub("~/", end.name).replace(_NAME, "{}")
    if _ITEM in name:
        before, _, item = name.partition(_ITEM)
        name = f"{before}{{{item}}}"
    return {
        "name": name,
        "type": end.type,
        "qos": dict(end.qos) or None,
        "conditional": True if "condition" in end.evidence.doubts else None,
    }


def _without_one_type(row: dict[str, Any]) -> None:
    """Values that give the same type decide nothing."""
    by = {param: types for param, types in row.pop("typed_by", {}).items() if len(set(types.values())) > 1}
    if by:
        row["typed_by"] = by
