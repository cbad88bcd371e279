"""The tools: what each takes, and the command that answers it. Nothing of the SDK, and nothing is started here."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from preflight_analysis.dataclass import dataclass

Arguments = Mapping[str, Any]
"""Of a call, valid by the input schema of its tool."""
_ASSIGNED = re.compile(r"[A-Za-z_][\w.\-/]*")
"""The name of an argument of a launch file: never an option of ours."""
_NAME = re.compile(r"[~/\w{][\w/:.~{}*\-]*")
"""A node, topic or parameter."""
_RULE_OR_PRINT = re.compile(r"[A-Za-z][\w-]*|[0-9a-f]{16}:\d+")
_PLACE = re.compile(r"(?P<file>.+?)(?P<at>:\d+(?::\d+)?)")
_REVISION = re.compile(r"(?P<revision>[\w][\w./^~@{}-]*):(?P<file>[^:]+)")
MOST_ITEMS = 1000
ITEMS = 100
"""Of each list of a result, at most and if the call does not say."""


class BadArgumentError(Exception):
    """Why a call cannot be answered, for whoever called."""


@dataclass(frozen=True, slots=True)
class Tool:
    """One verb. `properties` are those of its input schema, `required` their names; `words` makes the command's words
    of a call in a workspace, and raises `BadArgumentError`."""

    verb: str
    title: str
    description: str
    properties: Mapping[str, Mapping[str, Any]]
    required: tuple[str, ...]
    words: Callable[[str, Arguments], Sequence[str]]

    @property
    def input_schema(self) -> dict[str, Any]:
        """As JSON schema."""
        properties = {**self.properties, "limit": _LIMIT}
        return {
            "type": "object",
            "properties": properties,
            "required": list(self.required),
            "additionalProperties": False,
        }

    @property
    def output_schema(self) -> dict[str, Any]:
        """As far as the server promises it: the contract is that of the verb's JSON."""
        schema = {"type": "string", "const": f"ros-preflight/{self.verb}/1"}
        return {"type": "object", "properties": {"schema": schema}, "required": ["schema"]}


def inside(workspace: str, given: str) -> str:
    """The absolute path of a file or folder in the workspace, links resolved. Raises `BadArgumentError` for one that is
    outside or does not exist."""
    try:
        path = os.path.realpath(os.path.join(workspace, given))
    except ValueError:
        raise BadArgumentError(f"{given!r} is not a path") from None
    if os.path.commonpath((path, workspace)) != workspace:
        raise BadArgumentError(f"{given!r} is outside of the workspace {workspace}")
    if not os.path.exists(path):
        raise BadArgumentError(f"{given!r} does not exist in the workspace {workspace}")
    return path


def _check(workspace: str, given: Arguments) -> Sequence[str]:
    files = [inside(workspace, each) for each in given.get("files", [])]
    if given.get("arguments") and len(files) != 1:
        raise BadArgumentError("'arguments' need one launch file in 'files'")
    return [f"--severity={given.get('severity', 'hint')}", "--fail-on=never", *(files or ["."]), *_assigned(given)]


def _of_launch(workspace: str, given: Arguments) -> list[str]:
    return [inside(workspace, given["file"]), *_assigned(given)]


def _why(workspace: str, given: Arguments) -> Sequence[str]:
    if "channel" in given and "other" not in given:
        raise BadArgumentError("'channel' needs 'other', the second node")
    return [*_of_launch(workspace, given), *(_name(given, key) for key in ("node", "other", "channel") if key in given)]


def _where(workspace: str, given: Arguments) -> Sequence[str]:
    return [*_of_launch(workspace, given), _name(given, "parameter")]


def _explain(workspace: str, given: Arguments) -> Sequence[str]:
    what: str = given["what"]
    files = [inside(workspace, given["file"])] if "file" in given else []
    if _RULE_OR_PRINT.fullmatch(what):
        return [what, *files]
    found = _PLACE.fullmatch(what)
    if found is None:
        raise BadArgumentError(f"{what!r} is neither a rule (TOP001) nor the place of a finding (launch/a.launch:7)")
    return [inside(workspace, found["file"]) + found["at"], *files]


def _diff(workspace: str, given: Arguments) -> Sequence[str]:
    words: list[str] = []
    for side in ("before", "after"):
        words += [_operand(workspace, given[side]), *_assigned(given, f"{side}_arguments")]
    return words


def _operand(workspace: str, given: str) -> str:
    found = _REVISION.fullmatch(given)
    if found is None or os.path.exists(os.path.join(workspace, given)):
        return inside(workspace, given)
    # The file may not be there now; what a revision has cannot lead out of its repository.
    file = os.path.normpath(found["file"])
    if os.path.isabs(file) or file.split(os.sep)[0] == os.pardir:
        raise BadArgumentError(f"{given!r} is outside of the workspace {workspace}")
    return f"{found['revision']}:{file}"


def _assigned(given: Arguments, key: str = "arguments") -> list[str]:
    values: Mapping[str, str] = given.get(key, {})
    for name in values:
        if not _ASSIGNED.fullmatch(name):
            raise BadArgumentError(f"{name!r} is not the name of an argument of a launch file")
    return [f"{name}:={value}" for name, value in values.items()]


def _name(given: Arguments, key: str) -> str:
    name: str = given[key]
    if not _NAME.fullmatch(name) or ":=" in name:
        raise BadArgumentError(f"{key} {name!r} is not a name")
    return name


def _text(description: str) -> dict[str, Any]:
    return {"type": "string", "minLength": 1, "maxLength": 4096, "description": description}


def _values(description: str) -> dict[str, Any]:
    return {"type": "object", "additionalProperties": {"type": "string"}, "description": description}


_LIMIT = {
    "type": "integer",
    "minimum": 1,
    "maximum": MOST_ITEMS,
    "default": ITEMS,
    "description": "the most items of each list in the result; 'cut' has the lengths of lists that are longer",
}
_FILE = _text("a launch file, relative to the workspace")
_ARGUMENTS = _values("arguments of the launch file by name")

TOOLS = (
    Tool(
        "check",
        "Find problems in launch files",
        "Find problems in ROS 1 and ROS 2 launch files and in everything that they include: wrong names of topics, "
        "parameters, arguments, packages and executables, mismatched types and QoS. Each finding has a place, a "
        "confidence and fixes.",
        {
            "files": {
                "type": "array",
                "items": {"type": "string", "minLength": 1, "maxLength": 4096},
                "description": "launch files or folders, relative to the workspace; without them the whole workspace",
            },
            "arguments": _ARGUMENTS,
            "severity": {
                "type": "string",
                "enum": ["error", "warning", "info", "hint"],
                "default": "hint",
                "description": "report findings of this severity or worse",
            },
        },
        (),
        _check,
    ),
    Tool(
        "tree",
        "List what a launch file starts",
        "List the nodes of a launch with their names, parameters, remaps and environment, and the line that each comes "
        "from.",
        {"file": _FILE, "arguments": _ARGUMENTS},
        ("file",),
        _of_launch,
    ),
    Tool(
        "graph",
        "Topics, services and actions of a launch",
        "List the topics, services and actions of a launch under their resolved names, with types, QoS and the nodes "
        "at both ends.",
        {"file": _FILE, "arguments": _ARGUMENTS},
        ("file",),
        _of_launch,
    ),
    Tool(
        "why",
        "Why two nodes are connected or not",
        "Explain the connection of two nodes link by link, and name the first broken link. With one node, explain why "
        "the launch file starts it, or which condition leaves it out.",
        {
            "file": _FILE,
            "node": _text("a node, by its full name or its last part"),
            "other": _text("the second node"),
            "channel": _text("a topic, service or action that connects them"),
            "arguments": _ARGUMENTS,
        },
        ("file", "node"),
        _why,
    ),
    Tool(
        "where",
        "Where a parameter is set",
        "List all places that set a parameter, the one that applies first, its default in the code of the node, and "
        "the nodes that read it.",
        {
            "file": _FILE,
            "parameter": _text("/node/name, in ROS 2 /node:name, or the last part alone"),
            "arguments": _ARGUMENTS,
        },
        ("file", "parameter"),
        _where,
    ),
    Tool(
        "frames",
        "Coordinate frames of a launch",
        "List the coordinate frames of a launch: links of robot descriptions, static transforms and transforms "
        "that nodes broadcast, and frames that nodes use without a publisher.",
        {"file": _FILE, "arguments": _ARGUMENTS},
        ("file",),
        _of_launch,
    ),
    Tool(
        "explain",
        "Explain a rule or a finding",
        "Explain a rule by its id (TOP001), or the findings at a place (launch/robot.launch:7): cause, confidence and "
        "fixes.",
        {"what": _text("a rule or a place"), "file": _text("the launch file that has the finding, if it is another")},
        ("what",),
        _explain,
    ),
    Tool(
        "diff",
        "Compare two launch configurations",
        "Compare the nodes, connections, types, QoS and parameters of two launch configurations. Each is a launch "
        "file, a snapshot, or either in a git revision (main:launch/robot.launch).",
        {
            "before": _text("a launch file or snapshot, or REVISION:FILE"),
            "after": _text("the same for what it is compared with"),
            "before_arguments": _values("arguments of the first launch file"),
            "after_arguments": _values("arguments of the second launch file"),
        },
        ("before", "after"),
        _diff,
    ),
)
