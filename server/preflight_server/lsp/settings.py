"""The settings that the server itself reads: section `rosPreflight` of the editor, or the initialisation options."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from typing import Any

from preflight_analysis.dataclass import dataclass

_log = logging.getLogger(__name__)

SCHEMA: Mapping[str, Mapping[str, Any]] = {
    "runNodes": {
        "type": "boolean",
        "default": True,
        "description": "Run nodes, Python launch files and parameter commands (xacro) in the sandbox, in a trusted "
        "workspace. The runs show what nodes publish, subscribe to and read.",
    },
    "inlayHints": {
        "type": "boolean",
        "default": True,
        "markdownDescription": "Show the resolved value after each value with substitutions. "
        "`#editor.inlayHints.enabled#` switches the hints of all languages.",
    },
    "packagePath": {
        "type": ["array", "null"],
        "items": {"type": "string"},
        "default": None,
        "markdownDescription": "Search ROS packages in these folders only, in this order. By default they are found "
        "as ROS finds them: in the workspace, on `ROS_PACKAGE_PATH` and in the installed distributions.",
    },
}
"""What `Settings.read` reads, in the words of VS Code: `contribution.py` writes it into the extension's manifest."""


@dataclass(frozen=True, slots=True)
class Settings:
    """`package_path`: look for packages there and nowhere else, None to find them as ROS does. `run_nodes`: whether
    nodes and commands of parameters may be run in the sandbox once the workspace is trusted. `inlay_hints`: whether
    values with substitutions are followed by what they come to."""

    package_path: tuple[str, ...] | None = None
    run_nodes: bool = True
    inlay_hints: bool = True

    @classmethod
    def read(cls, given: Mapping[str, Any]) -> Settings:
        """From `packagePath` (list of folders), `runNodes` and `inlayHints` (booleans); a value of another type is left
        out."""
        path, run, hints = given.get("packagePath"), given.get("runNodes", True), given.get("inlayHints", True)
        if path is not None and not (isinstance(path, list) and all(isinstance(p, str) for p in path)):
            _log.warning("rosPreflight.packagePath must be a list of folders; it is ignored")
            path = None
        if not isinstance(run, bool):
            _log.warning("rosPreflight.runNodes must be true or false; nothing is run")
            run = False
        if not isinstance(hints, bool):
            _log.warning("rosPreflight.inlayHints must be true or false; hints stay on")
            hints = True
        return cls(tuple(path) if path else None, run, hints)


def as_mapping(value: Any) -> Mapping[str, Any]:
    """JSON of a client as a mapping: pygls gives named tuples for what LSP leaves open. Empty for anything else."""
    if isinstance(value, Mapping):
        return value
    fields = value._asdict() if hasattr(value, "_asdict") else {}
    return fields if isinstance(fields, Mapping) else {}
