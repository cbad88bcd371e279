"""The server: lists the tools, and answers a call with the output of the command, started anew for it.

A process of its own for each call can be cancelled, leaves no memory behind, and gives what the command line gives.
"""

from __future__ import annotations

import json
import logging
import subprocess
import sys
from collections.abc import Sequence
from typing import Any

import anyio
import mcp_types as types
from jsonschema import Draft202012Validator  # type: ignore[import-untyped]
from jsonschema.exceptions import best_match  # type: ignore[import-untyped]
from mcp.server.context import ServerRequestContext
from mcp.server.lowlevel import Server
from preflight_analysis import __version__
from preflight_analysis.dataclass import dataclass
from preflight_analysis.findings.failure import error_line

from preflight_server.mcp.results import bounded, summary
from preflight_server.mcp.tools import ITEMS, TOOLS, BadArgumentError, Tool
from preflight_server.mcp.transport import standard_streams

_log = logging.getLogger(__name__)
_PROGRAM = (
    "import json, sys; sys.path[:] = json.loads(sys.argv.pop(1)); "
    "from preflight_server.cli.main import main; sys.exit(main())"
)
_FAILED, _BROKEN = 2, 3
"""The exit codes for what could not be done, and for an error of ours, which may cost a part of the document only."""
_INSTRUCTIONS = """Answers questions about the ROS launch files of one workspace and changes nothing. Start with
`check`. Use `explain` for a finding, `why` for two nodes that are not connected, `where` for a parameter with an
unexpected value. {runs}"""
_RUNS = {
    True: "Nodes and Python launch files run in a sandbox without network.",
    False: "Nothing is executed: Python launch files and the sources of nodes are read statically.",
}
_READS = types.ToolAnnotations(read_only_hint=True, destructive_hint=False, idempotent_hint=True, open_world_hint=False)


@dataclass(frozen=True, slots=True)
class Workspace:
    """What the tools answer about. `folder` has no links; `run`: nodes and Python launch files may run in the sandbox;
    `seconds` is the most for one call."""

    folder: str
    run: bool
    seconds: float


def serve(workspace: Workspace) -> None:
    """Answer on standard input and output until the client closes them."""
    anyio.run(_serve, workspace)


async def _serve(workspace: Workspace) -> None:
    async def list_tools(
        _context: ServerRequestContext[Any], _params: types.PaginatedRequestParams | None
    ) -> types.ListToolsResult:
        return types.ListToolsResult(tools=[_described(tool) for tool in TOOLS])

    async def call_tool(
        _context: ServerRequestContext[Any], params: types.CallToolRequestParams
    ) -> types.CallToolResult:
        try:
            return await _called(workspace, params.name, params.arguments or {})
        except BadArgumentError as error:
            return _failed(str(error))
        except Exception as error:
            _log.exception("calling %s failed", params.name)
            return _failed(f"internal error: {error_line(error)}. Please report this.")

    server: Server[Any] = Server(
        "ros-preflight",
        version=__version__,
        instructions=_INSTRUCTIONS.format(runs=_RUNS[workspace.run]),
        on_list_tools=list_tools,
        on_call_tool=call_tool,
    )
    async with standard_streams() as (read, write):
        await server.run(read, write, server.create_initialization_options())


def _failed(why: str) -> types.CallToolResult:
    return types.CallToolResult(content=[types.TextContent(text=why)], is_error=True)


def _described(tool: Tool) -> types.Tool:
    return types.Tool(
        name=tool.verb,
        title=tool.title,
        description=tool.description,
        input_schema=tool.input_schema,
        output_schema=tool.output_schema,
        annotations=_READS,
    )


async def _called(workspace: Workspace, name: str, given: dict[str, Any]) -> types.CallToolResult:
    tool = next((tool for tool in TOOLS if tool.verb == name), None)
    if tool is None:
        raise BadArgumentError(f"no tool {name!r}; there are {', '.join(tool.verb for tool in TOOLS)}")
    wrong = best_match(Draft202012Validator(tool.input_schema).iter_errors(given))
    if wrong is not None:
        raise BadArgumentError(f"{'.'.join(map(str, wrong.absolute_path)) or 'arguments'}: {wrong.message[:500]}")
    words = [tool.verb, "--format=json", "--paths=cwd", "--workspace-only", *([] if workspace.run else ["--no-run"])]
    output = await _output(workspace, [*words, *tool.words(workspace.folder, given)])
    document = bounded(json.loads(output), given.get("limit", ITEMS))
    return types.CallToolResult(
        content=[types.TextContent(text=summary(tool.verb, document))], structured_content=document
    )


async def _output(workspace: Workspace, words: Sequence[str]) -> bytes:
    """What the command prints. Raises `BadArgumentError` with its message where it fails."""
    if any("\0" in word for word in words):
        raise BadArgumentError("an argument has the character NUL, which no launch file and no name can have")
    # Isolated, and without the current folder, so that nothing of the workspace is imported.
    path = json.dumps([each for each in sys.path if each not in ("", workspace.folder)])
    try:
        with anyio.fail_after(workspace.seconds):
            done = await anyio.run_process(
                [sys.executable, "-I", "-c", _PROGRAM, path, *words],
                cwd=workspace.folder,
                stdin=subprocess.DEVNULL,
                check=False,
            )
    except TimeoutError:
        raise BadArgumentError(f"no answer after {workspace.seconds:g} s") from None
    except OSError as error:  # the arguments together may be longer than a command line
        raise BadArgumentError(f"the command cannot be started: {error.strerror}") from None
    if done.returncode in (0, 1) or (done.returncode == _BROKEN and done.stdout):
        return done.stdout
    said = done.stderr.decode(errors="replace").strip().splitlines()
    if done.returncode == _FAILED and said:
        raise BadArgumentError(said[-1].removeprefix("ros-preflight: "))
    raise BadArgumentError(f"the command ended with exit code {done.returncode}; this is a bug of ros-preflight")
