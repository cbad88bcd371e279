"""The JSON schema of files that say what parameters mean, with which editors complete and check them.

`python -m preflight_analysis.knowledge.schema vscode-client/ros-preflight-knowledge.schema.json` writes it.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from preflight_analysis.knowledge.model import ENTRY_KINDS, ROLES

COMMAND = "python -m preflight_analysis.knowledge.schema vscode-client/ros-preflight-knowledge.schema.json"
_TEXT: dict[str, Any] = {"type": "string"}
_TEXTS: dict[str, Any] = {"type": "array", "items": _TEXT}
_CONDITIONS: dict[str, Any] = {"type": "object", "description": "Values that other parameters must have."}


def schema() -> dict[str, Any]:
    """The schema; `read` reads what it describes."""
    meaning = _object(
        "What the values of these parameters stand for.",
        {
            **{kind: {"enum": list(roles)} for kind, roles in ROLES.items()},
            "type": {
                "description": "The type of a topic, service or action, or types by the value of another parameter.",
                "anyOf": [_TEXT, {"type": "object", "additionalProperties": _of_texts()}],
            },
            "default": {"description": "The value where the parameter is not set."},
            "when": _CONDITIONS,
            "qos": {"type": "object"},
            "append": _TEXT,
            "remapped": {"type": "boolean", "description": "Whether a remap of the value changes the name."},
            "private": {"type": "boolean", "description": "Whether a relative name is below that of the node."},
            "folder": {**_TEXT, "description": "Of a file: the parameter or argument with its folder."},
            "names": {**_TEXTS, "description": "Of a plugin: the names that are known."},
            "formerly": {**_of_texts(), "description": "Of a plugin: names of older distributions, and the new ones."},
        },
    )
    meaning["anyOf"] = [*({"required": [kind]} for kind in ROLES), {"required": ["default"], "maxProperties": 1}]
    broadcast = _object(
        "A transform that the node broadcasts. A frame is a parameter, or a name after '='.",
        {"parent": _TEXT, "child": _TEXT, "static": {"type": "boolean"}, "when": _CONDITIONS},
        ["parent", "child"],
    )
    entry = _object(
        "Executables, components or plugins, and what is known of them.",
        {
            **dict.fromkeys(ENTRY_KINDS, _TEXTS),
            "parameters": {
                "type": "object",
                "description": "Patterns of names: odom{N}, sources.*.topic, {sources}.topic.",
                "additionalProperties": {
                    "oneOf": [meaning, {"type": "array", "items": meaning, "description": "Of several conditions."}]
                },
            },
            "arguments": {
                **_TEXTS,
                "description": "Forms of the command line: 'messages {topic} [{output}]', '{output} {inputs}...'.",
            },
            "options": {**_of_texts(), "description": "Options, and the name of the word behind each."},
            "whole": {"type": "boolean", "description": "Whether these are all endpoints of the node."},
            "broadcasts": {"type": "array", "items": broadcast},
            "distributions": _TEXTS,
            "node": {**_TEXT, "description": "The name that the code gives to the node, if there are others within."},
            "within": _of_texts(),
        },
    )
    whole = _object(
        "What the parameters of the nodes of a package mean.",
        {
            "package": _TEXT,
            "source": {"type": "object", "description": "Where this was read: repository, commit, files."},
            "distributions": _TEXTS,
            "entries": {"type": "array", "items": {**entry, "anyOf": [{"required": [kind]} for kind in ENTRY_KINDS]}},
        },
        ["package"],
    )
    return {"$schema": "http://json-schema.org/draft-07/schema#", "title": "Knowledge of parameters", **whole}


def text() -> str:
    """The schema as the file has it."""
    return json.dumps(schema(), indent=2) + "\n"


def main(arguments: Sequence[str]) -> int:
    """The command line: one argument, the file."""
    if len(arguments) != 1:
        print(f"usage: {COMMAND}", file=sys.stderr)
        return 2
    Path(arguments[0]).write_text(text(), encoding="utf-8")
    return 0


def _of_texts() -> dict[str, Any]:
    return {"type": "object", "additionalProperties": _TEXT}


def _object(description: str, properties: dict[str, Any], required: Sequence[str] = ()) -> dict[str, Any]:
    found: dict[str, Any] = {"type": "object", "description": description, "properties": properties}
    return {**found, **({"required": list(required)} if required else {}), "additionalProperties": False}


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
