"""What SARIF 2.1.0 (OASIS, errata 01) lets stand in the objects that we write: a JSON schema that knows no others.

The schema of the standard says the same of these objects, and has a hundred more.
"""

from __future__ import annotations

from typing import Any


def _object(required: str = "", **properties: Any) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": properties,
        "required": required.split(),
        "additionalProperties": False,
    }


def _list(items: Any, **more: Any) -> dict[str, Any]:
    return {"type": "array", "items": items, **more}


_STRING = {"type": "string"}
_TEXT = _object("text", text={"type": "string", "minLength": 1}, markdown=_STRING)
_FROM_ONE = {"type": "integer", "minimum": 1}
_LEVEL = {"enum": ["none", "note", "warning", "error"]}
_ARTIFACT = _object("uri", uri={"type": "string", "format": "uri-reference"}, uriBaseId=_STRING)
_REGION = _object(
    "startLine startColumn endLine endColumn",
    startLine=_FROM_ONE,
    startColumn=_FROM_ONE,
    endLine=_FROM_ONE,
    endColumn=_FROM_ONE,
)
_PHYSICAL = _object("artifactLocation region", artifactLocation=_ARTIFACT, region=_REGION)
_FIX = _object(
    "artifactChanges",
    description=_TEXT,
    artifactChanges=_list(
        _object(
            "artifactLocation replacements",
            artifactLocation=_ARTIFACT,
            replacements=_list(
                _object("deletedRegion", deletedRegion=_REGION, insertedContent=_object("text", text=_STRING)),
                minItems=1,
            ),
        ),
        minItems=1,
        uniqueItems=True,
    ),
)
_RESULT = _object(
    "ruleId ruleIndex level message locations partialFingerprints",
    ruleId=_STRING,
    ruleIndex={"type": "integer", "minimum": 0},
    level=_LEVEL,
    message=_TEXT,
    locations=_list(_object("physicalLocation", physicalLocation=_PHYSICAL), minItems=1),
    relatedLocations=_list(
        _object("message physicalLocation", id={"type": "integer"}, message=_TEXT, physicalLocation=_PHYSICAL),
        uniqueItems=True,
    ),
    fixes=_list(_FIX, uniqueItems=True),
    partialFingerprints={"type": "object", "additionalProperties": _STRING},
    properties={"type": "object"},
)
_RULE = _object(
    "id",
    id=_STRING,
    name=_STRING,
    shortDescription=_TEXT,
    fullDescription=_TEXT,
    help=_TEXT,
    defaultConfiguration=_object("level", level=_LEVEL),
)
_DRIVER = _object("name", name=_STRING, version=_STRING, rules=_list(_RULE, uniqueItems=True))
_NOTIFICATION = _object(
    "message",
    level=_LEVEL,
    message=_TEXT,
    associatedRule=_object("id", id=_STRING),
    locations=_list(
        _object("physicalLocation", physicalLocation=_object("artifactLocation", artifactLocation=_ARTIFACT))
    ),
)
_INVOCATION = _object(
    "executionSuccessful",
    executionSuccessful={"type": "boolean"},
    toolConfigurationNotifications=_list(_NOTIFICATION),
    toolExecutionNotifications=_list(_NOTIFICATION),
)
_RUN = _object(
    "tool results",
    tool=_object("driver", driver=_DRIVER),
    columnKind={"enum": ["utf16CodeUnits", "unicodeCodePoints"]},
    originalUriBaseIds={
        "type": "object",
        "additionalProperties": _object("uri", uri={"type": "string", "pattern": "^file:///(.*/)?$"}),
    },
    invocations=_list(_INVOCATION),
    results=_list(_RESULT),
)
SARIF_SCHEMA = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    **_object(
        "version runs",
        **{"$schema": {"type": "string", "format": "uri"}, "version": {"enum": ["2.1.0"]}},
        runs=_list(_RUN),
    ),
}
