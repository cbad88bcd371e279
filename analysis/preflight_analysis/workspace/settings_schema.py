"""The JSON schema of the settings file, with which editors complete and check it, and its page in the documentation.

`COMMAND` writes both.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from preflight_analysis.environment.distribution import known_distributions
from preflight_analysis.findings.severities import ALL, CHOICES
from preflight_analysis.graph.annotations import CLASSES, GROUPS
from preflight_analysis.rules.registry import all_rules, families
from preflight_analysis.workspace.project_settings import PROFILES

COMMAND = (
    "python -m preflight_analysis.workspace.settings_schema "
    "vscode-client/ros-preflight.schema.json docs/settings_reference.md"
)

_FEW = 20
_PAGE = f"""<!-- Written by `{COMMAND}`. Do not edit. -->
# Reference of `.ros-preflight.yaml`
The keys of the [settings](settings.md) of a workspace, from the JSON schema with which editors complete the file. `[]`
marks each item of a list.

| key | value | description |
| --- | --- | --- |"""
_SEVERITIES = {"$ref": "#/definitions/severities"}
_SELECTORS = {
    "select": {"$ref": "#/definitions/selectors", "description": "The rules and families that speak; all by default."},
    "ignore": {"$ref": "#/definitions/selectors", "description": "Rules and families that do not."},
}


def schema() -> dict[str, Any]:
    """The schema; `project_settings` reads what it describes."""
    properties = {
        "roots": _list(
            "The launch files that are launched, in addition to those that no other file includes.",
            {
                "oneOf": [
                    {"type": "string", "description": "A launch file, relative to this file."},
                    _object(
                        "A launch file with arguments; one entry for each profile.",
                        {
                            "file": _text("A launch file, relative to this file."),
                            "args": {
                                "type": "object",
                                "description": "The value of each argument, as on a command line.",
                                "additionalProperties": {"type": ["string", "number", "boolean"]},
                            },
                        },
                        ["file"],
                    ),
                ]
            },
        ),
        "external": _object(
            "What programs outside of the launch files publish or subscribe to.",
            {"topics": _list("Full names; * matches any text, including slashes.", {"type": "string"})},
        ),
        "nodes": _list(
            "The interfaces of nodes that cannot run, as in the annotations of launch files.",
            {
                **_object(
                    "The nodes of an executable, or the node of one name.",
                    {
                        "package": _text("The package of the executable."),
                        "executable": _text("The executable, `type` in ROS 1."),
                        "name": _text("The full name of a single node."),
                        **{group: _items(group) for group in GROUPS},
                    },
                ),
                "anyOf": [{"required": ["package", "executable"]}, {"required": ["name"]}],
            },
        ),
        "knowledge": _list(
            "Files that say what the parameters of nodes mean.",
            {"type": "string", "description": "A file, relative to this file."},
        ),
        "distribution": {
            "description": "The distribution of ROS that the workspace is for.",
            "enum": [*known_distributions(1), *known_distributions(2)],
        },
        **_SELECTORS,
        "severities": _SEVERITIES,
        "paths": _list(
            "Severities for some files; the last matching entry applies.",
            _object(
                "The severities of rules for some files.",
                {
                    "path": _text("A folder or a pattern, relative to this file; * matches any text."),
                    **_SELECTORS,
                    "severities": _SEVERITIES,
                },
                ["path"],
            ),
        ),
        "profile": {
            "description": "Of `check`: with strict, warnings fail; with launch, only what stops a launch is reported.",
            "enum": list(PROFILES),
        },
    }
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "The settings of ros-preflight for a workspace, .ros-preflight.yaml",
        **_object("What ros-preflight cannot find out itself.", properties),
        "type": ["object", "null"],
        "definitions": {
            "severities": _severities(),
            "selectors": {"type": "array", "items": {"enum": [ALL, *families(), *(rule.id for rule in all_rules())]}},
        },
    }


def text() -> str:
    """The schema as the file has it."""
    return json.dumps(schema(), indent=2) + "\n"


def page() -> str:
    """The reference of the settings file: each key, what it takes and what it is for."""
    return "\n".join((_PAGE, *_rows(schema(), schema()["properties"], ""))) + "\n"


def _rows(whole: Mapping[str, Any], properties: Mapping[str, Any], above: str) -> Iterator[str]:
    for name, given in properties.items():
        found = (
            {**whole["definitions"].get(given["$ref"].rpartition("/")[2], {}), **given} if "$ref" in given else given
        )
        inner, items = found, found.get("items", {})
        key = f"{above}{name}"
        if found.get("type") == "array" and "properties" in (each := next(iter(items.get("oneOf", ())[1:]), items)):
            inner, key = each, f"{key}[]"
        yield f"| `{key}` | {_takes(found)} | {found.get('description', '')} |"
        if "$ref" not in given:
            yield from _rows(whole, inner.get("properties", {}), f"{key}.")


def _takes(found: Mapping[str, Any]) -> str:
    """What a key takes, in words."""
    if "enum" in found:
        return ", ".join(f"`{each}`" for each in found["enum"])
    match found.get("type"):
        case "array":
            each = found["items"].get("oneOf", [found["items"]])[0]
            few = "enum" not in each or len(each["enum"]) <= _FEW
            return f"list of {_takes(each)}" if few else "list of rules and families, or `all`"
        case "object" if found.get("additionalProperties"):
            return "names with values"
        case "object" if len(found["properties"]) > _FEW:
            choices = next(iter(found["properties"].values()))["enum"]
            return f"rules, families or `all`, each with one of {', '.join(f'`{each}`' for each in choices)}"
        case "object":
            return "keys"
        case list() as several:
            return " or ".join(several)
        case other:
            return {"string": "text"}.get(str(other), str(other))


def main(arguments: Sequence[str]) -> int:
    """The command line: two arguments, the files of the schema and of the page."""
    if len(arguments) != 2:
        print(f"usage: {COMMAND}", file=sys.stderr)
        return 2
    for file, content in zip(arguments, (text(), page()), strict=True):
        Path(file).write_text(content, encoding="utf-8")
    return 0


def _severities() -> dict[str, Any]:
    choice = {"enum": list(CHOICES)}
    rules = {rule.id: {**choice, "description": rule.name} for rule in all_rules()}
    every = {ALL: {**choice, "description": "All rules that are not named."}}
    groups = {name: {**choice, "description": f"All {name} rules that are not named."} for name in families()}
    return _object("Severities that replace those of the rules.", {**every, **groups, **rules})


def _items(group: str) -> dict[str, Any]:
    named = {"name": _text("The name in the node's code, before namespaces and remaps.")}
    if group not in CLASSES:
        return _list("", _object("", {**named, "default": {"type": ["string", "number", "boolean"]}}, ["name"]))
    properties = {**named, "type": _text("As package/Type."), "class": {"enum": list(CLASSES[group])}}
    return _list("", _object("", properties, ["name", "class"]))


def _text(description: str) -> dict[str, Any]:
    return {"type": "string", "description": description}


def _list(description: str, items: Mapping[str, Any]) -> dict[str, Any]:
    return {"type": "array", **_described(description), "items": dict(items)}


def _object(description: str, properties: Mapping[str, Any], required: Sequence[str] = ()) -> dict[str, Any]:
    found = {"type": "object", **_described(description), "properties": dict(properties)}
    return {**found, **({"required": list(required)} if required else {}), "additionalProperties": False}


def _described(description: str) -> dict[str, str]:
    return {"description": description} if description else {}


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
