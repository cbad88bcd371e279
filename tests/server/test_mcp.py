"""The server of the Model Context Protocol, asked by the SDK's own client over standard input and output."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import threading
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import asynccontextmanager, contextmanager
from pathlib import Path
from typing import Any, Literal

import pytest
from mcp import Client, StdioServerParameters
from mcp_types import CallToolResult, TextContent
from preflight_server.cli import mcp as verb
from preflight_server.mcp.results import MOST_BYTES, bounded, summary
from preflight_server.mcp.tools import TOOLS, BadArgumentError, inside
from preflight_server.mcp.transport import MOST_BYTES as MOST
from support.command import run_command
from support.editor_harness import ROOT, Harness, create_harness
from support.waiting import PATIENCE

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

pytestmark = pytest.mark.ros
FILE = "launch/talker_listener.launch"
CALLS: dict[str, dict[str, Any]] = {
    "check": {"files": [FILE]},
    "tree": {"file": FILE},
    "graph": {"file": FILE},
    "why": {"file": FILE, "node": "talker", "other": "listener"},
    "where": {"file": FILE, "parameter": "talker/rate"},
    "frames": {"file": FILE},
    "explain": {"what": "TOP001"},
    "diff": {"before": FILE, "after": "launch/fixed.launch"},
}


@pytest.fixture
def harness(tmp_path: Path) -> Harness:
    return create_harness(tmp_path, "workspace", server_on_path=True)


@asynccontextmanager
async def connected(
    harness: Harness, *options: str, mode: Literal["auto", "legacy"] = "auto"
) -> AsyncIterator[Callable[..., Any]]:
    """A client, as a function from a tool and its arguments to the result."""
    parameters = StdioServerParameters(
        command=str(harness.server), args=["mcp", str(harness.workspace), *options], env=dict(harness.environment)
    )
    async with Client(parameters, read_timeout_seconds=120, mode=mode) as client:
        yield client.call_tool


def text(result: CallToolResult) -> str:
    (content,) = result.content
    assert isinstance(content, TextContent)
    return content.text


def content_of(folder: Path) -> dict[str, bytes]:
    return {str(path): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("mode", ["auto", "legacy"])
async def test_the_tools_are_listed(harness: Harness, mode: Literal["auto", "legacy"]) -> None:
    parameters = StdioServerParameters(
        command=str(harness.server), args=["mcp"], env=dict(harness.environment), cwd=harness.workspace
    )
    async with Client(parameters, mode=mode) as client:
        tools = (await client.list_tools()).tools
        assert client.instructions is not None
        assert "Nothing is executed" in client.instructions
    assert [tool.name for tool in tools] == [*CALLS]
    assert all(tool.annotations is not None and tool.annotations.read_only_hint for tool in tools)


async def test_each_tool_answers_as_its_verb_does_and_runs_nothing(harness: Harness) -> None:
    before = content_of(harness.workspace)
    async with connected(harness) as call:
        results = {tool: await call(tool, given) for tool, given in CALLS.items()}
    for tool, result in results.items():
        assert not result.is_error, (tool, text(result))
        assert result.structured_content["schema"] == f"ros-preflight/{tool}/1"
        assert text(result)
    command = ("check", FILE, "--no-run", "--format", "json", "--paths", "relative")
    done = run_command(harness.server, *command, environment=harness.environment, cwd=harness.workspace)
    assert results["check"].structured_content == done.json
    assert "/talker -> /listener: not connected" in text(results["why"])
    assert "TOP001 subscribed-not-published" in text(results["explain"])
    assert harness.sandbox_starts() == 0
    assert content_of(harness.workspace) == before


async def test_paths_are_relative_to_the_folder_of_the_server(harness: Harness) -> None:
    folder = harness.workspace / "launch"
    parameters = StdioServerParameters(
        command=str(harness.server), args=["mcp", str(folder)], env=dict(harness.environment)
    )
    async with Client(parameters, read_timeout_seconds=120) as client:
        result = await client.call_tool("check", {"files": ["talker_listener.launch"]})
        first = result.structured_content["findings"][0]
        place = f"{first['file']}:{first['range']['start']['line']}"
        explained = await client.call_tool("explain", {"what": place})
    assert place.startswith("talker_listener.launch:")
    assert not explained.is_error, text(explained)
    assert first["rule"] in [each["rule"] for each in explained.structured_content["findings"]]


async def test_nodes_run_only_with_the_flag(harness: Harness) -> None:
    async with connected(harness, "--run") as call:
        result = await call("graph", {"file": FILE})
    assert {node["interface_source"] for node in result.structured_content["nodes"]} == {"trace"}
    assert harness.sandbox_starts() > 0


BAD_CALLS: list[tuple[str, dict[str, Any], str]] = [
    ("tree", {"file": "../../etc/passwd"}, "outside of the workspace"),
    ("tree", {"file": "/etc/passwd"}, "outside of the workspace"),
    ("tree", {"file": "link.launch"}, "outside of the workspace"),
    ("tree", {"file": "a\0b"}, "is not a path"),
    ("tree", {"file": "missing.launch"}, "does not exist"),
    ("tree", {"file": "launch"}, "is a folder"),
    ("tree", {"file": 3}, "file: 3 is not of type 'string'"),
    ("tree", {}, "'file' is a required property"),
    ("tree", {"file": FILE, "batch": "x"}, "Additional properties are not allowed"),
    ("tree", {"file": FILE, "arguments": {"--batch=/etc/passwd": "1"}}, "is not the name of an argument"),
    ("check", {"files": ["--write-baseline=/tmp/x"]}, "does not exist"),
    ("check", {"arguments": {"a": "1"}}, "need one launch file"),
    ("why", {"file": FILE, "node": "--no-run"}, "is not a name"),
    ("why", {"file": FILE, "node": "talkr"}, "did you mean /talker?"),
    ("why", {"file": FILE, "node": "talker", "channel": "/c"}, "needs 'other'"),
    ("where", {"file": FILE, "parameter": "rat"}, "did you mean /talker/rate?"),
    ("explain", {"what": "--help"}, "neither a rule"),
    ("explain", {"what": "/etc/passwd:1"}, "outside of the workspace"),
    ("diff", {"before": "main:../x.launch", "after": FILE}, "outside of the workspace"),
    ("diff", {"before": "main:x.launch", "after": FILE}, "main:x.launch"),
    ("delete", {}, "no tool 'delete'"),
]


async def test_bad_calls(harness: Harness) -> None:
    (harness.workspace / "link.launch").symlink_to("/etc/passwd")
    async with connected(harness) as call:
        results = [await call(tool, given) for tool, given, _ in BAD_CALLS]
    for (tool, given, why), result in zip(BAD_CALLS, results, strict=True):
        assert result.is_error, (tool, given)
        assert why in text(result), (tool, given)
        assert "Traceback" not in text(result)


@contextmanager
def killed_late(process: subprocess.Popen[bytes]) -> Iterator[None]:
    """What does not answer does not keep the tests waiting."""
    timer = threading.Timer(PATIENCE, process.kill)
    timer.start()
    yield
    timer.cancel()


def raw(harness: Harness, *lines: bytes) -> list[dict[str, Any]]:
    """What is answered to lines of standard input, which then ends, after the handshake."""
    start = {
        "protocolVersion": "2025-06-18",
        "capabilities": {},
        "clientInfo": {"name": "test", "version": "1"},
    }
    first = [
        {"jsonrpc": "2.0", "id": "start", "method": "initialize", "params": start},
        {"jsonrpc": "2.0", "method": "notifications/initialized"},
    ]
    process = subprocess.Popen(
        [str(harness.server), "mcp", str(harness.workspace)],
        env=harness.environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    with process, killed_late(process):
        assert process.stdin is not None
        assert process.stdout is not None
        assert process.stderr is not None
        answers = []
        sent = [json.dumps(each).encode() for each in first] + [*lines]
        for line in sent:
            process.stdin.write(line + b"\n")
            process.stdin.flush()
            if line not in (sent[1],):
                answers.append(json.loads(process.stdout.readline()))
        process.stdin.close()
        errors = process.stderr.read()
    assert process.returncode == 0
    assert b"Traceback" not in errors, errors.decode()
    assert answers[0]["id"] == "start"
    return answers[1:]


def call_of(message_id: Any, tool: str, given: dict[str, Any]) -> bytes:
    params = {"name": tool, "arguments": given}
    return json.dumps({"jsonrpc": "2.0", "id": message_id, "method": "tools/call", "params": params}).encode()


def test_what_is_no_message_is_answered(harness: Harness) -> None:
    garbage = (b"garbage", b"\xff\xfe", b'{"jsonrpc": "2.0", "id": 1, ', b"[" * 100_000, b" " * MOST + b"{}")
    invalid = (b"[]", b"7", b'{"id": 7}', b'{"jsonrpc": "2.0", "id": [1], "method": "ping"}')
    surrogate = call_of(8, "tree", {"file": "a\ud800"})
    answers = raw(harness, *garbage, *invalid, surrogate, call_of("next", "explain", {"what": "TOP001"}))
    codes = [answer.get("error", {}).get("code") for answer in answers]
    assert codes == [*[-32700] * len(garbage), *[-32600] * len(invalid), -32600, None]
    assert [answer["id"] for answer in answers] == [*[None] * len(garbage), None, None, 7, None, 8, "next"]
    assert answers[-1]["result"]["structuredContent"]["schema"] == "ros-preflight/explain/1"


def test_what_a_command_line_cannot_have_is_an_error_of_the_call(harness: Harness) -> None:
    given: tuple[dict[str, Any], ...] = ({"rate": "1\0"}, {"rate": "1" * 300_000})
    calls = [call_of(number, "tree", {"file": FILE, "arguments": each}) for number, each in enumerate(given)]
    answers = raw(harness, *calls)
    assert all(answer["result"]["isError"] for answer in answers)
    said = [answer["result"]["content"][0]["text"] for answer in answers]
    assert "NUL" in said[0]
    assert "Argument list too long" in said[1]


def test_a_file_name_that_is_no_utf8_is_answered(harness: Harness) -> None:
    path = os.fsencode(harness.workspace / "launch") + b"/gr\xf6.launch"
    Path(os.fsdecode(path)).write_text("<launch><nod/></launch>")
    (answer,) = raw(harness, call_of(1, "check", {"files": ["launch"]}))
    assert any("gr?.launch" in finding["file"] for finding in answer["result"]["structuredContent"]["findings"])


async def test_a_broken_file_has_findings(harness: Harness) -> None:
    (harness.workspace / "launch/broken.launch").write_text('<launch><node pkg="p" type="t" name="n"')
    async with connected(harness) as call:
        result = await call("check", {"files": ["launch/broken.launch"]})
    assert not result.is_error
    assert "LCH001" in text(result)


async def test_a_long_result_is_cut(harness: Harness) -> None:
    nodes = "".join(f'<node pkg="preflight_demo" type="talker.py" name="n{number}"/>' for number in range(150))
    (harness.workspace / "launch/long.launch").write_text(f"<launch>{nodes}</launch>")
    async with connected(harness) as call:
        whole = await call("tree", {"file": "launch/long.launch", "limit": 1000})
        cut = await call("tree", {"file": "launch/long.launch"})
    assert len(whole.structured_content["nodes"]) == 150
    assert "cut" not in whole.structured_content
    assert len(cut.structured_content["nodes"]) == 100
    assert cut.structured_content["cut"]["nodes"] == 150
    assert "The result is cut: 150 nodes" in text(cut)


async def test_an_answer_that_takes_too_long(harness: Harness) -> None:
    async with connected(harness, "--timeout", "0.01") as call:
        result = await call("tree", {"file": FILE})
    assert result.is_error
    assert text(result) == "no answer after 0.01 s"


async def test_modules_of_the_workspace_are_not_imported(harness: Harness) -> None:
    for name in ("json", "yaml", "preflight_server", "argparse"):
        (harness.workspace / f"{name}.py").write_text("raise SystemExit('the workspace was imported')\n")
    async with connected(harness) as call:
        result = await call("tree", {"file": FILE})
    assert not result.is_error, text(result)


def test_without_the_sdk_the_command_says_how_to_install_it(harness: Harness, tmp_path: Path) -> None:
    (tmp_path / "mcp_types.py").write_text("raise ModuleNotFoundError('no mcp')\n")
    done = subprocess.run(
        [sys.executable, "-m", "preflight_server", "mcp", str(harness.workspace)],
        env={**harness.environment, "PYTHONPATH": str(tmp_path)},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (2, "")
    assert f"-m pip install '{verb.REQUIREMENT}'" in done.stderr
    assert "Traceback" not in done.stderr


def test_the_requirement_is_that_of_the_extra() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    assert project["project"]["optional-dependencies"]["mcp"] == [verb.REQUIREMENT]
    assert verb.REQUIREMENT in project["dependency-groups"]["dev"]


def test_every_tool_has_a_call_here() -> None:
    assert [tool.verb for tool in TOOLS] == [*CALLS]


def test_the_page_lists_the_tools_with_their_arguments() -> None:
    rows = re.findall(r"^\| `(\w+)` \|.*\| (.+) \|$", (ROOT / "docs/mcp.md").read_text(), re.MULTILINE)
    assert {tool: re.findall(r"`(\w+)`", arguments) for tool, arguments in rows} == {
        tool.verb: [*tool.properties] for tool in TOOLS
    }


def test_a_document_is_never_longer_than_allowed() -> None:
    document = {"schema": "s", "findings": [{"message": "x" * 1000}] * 900, "environment": []}
    found = bounded(document, 1000)
    assert len(json.dumps(found)) <= MOST_BYTES
    assert found["cut"] == {"findings": 900}
    assert bounded({"findings": [1, 2]}, 2) == {"findings": [1, 2]}


def test_a_summary_is_short() -> None:
    at = {"start": {"line": 1, "column": 2}}
    finding = {"file": "a", "range": at, "severity": "error", "rule": "X", "message": "m"}
    document = {"findings": [finding] * 50, "failures": [], "files": 1, "nodes": 2}
    lines = summary("check", document).splitlines()
    assert lines[0] == "50 error; 1 launch files, 2 nodes"
    assert lines[1] == "a:1:2: error X: m"
    assert (len(lines), lines[-1]) == (21, "...")


def test_links_out_of_the_workspace_are_refused(tmp_path: Path) -> None:
    outside = tmp_path / "outside"
    workspace = tmp_path / "workspace"
    for folder in (outside, workspace):
        folder.mkdir()
    (workspace / "link").symlink_to(outside)
    (workspace / "in").symlink_to(workspace)
    assert inside(str(workspace), "in") == os.path.realpath(workspace)
    for given in ("link", "..", "../workspace2", str(outside)):
        with pytest.raises(BadArgumentError):
            inside(str(workspace), given)
