"""What is printed drives no terminal, wherever it comes from: names in launch files, files' own names, nodes' words."""

from __future__ import annotations

import logging
import re
import sys
from pathlib import Path

import pytest
from preflight_server.cli.main import main
from preflight_server.cli.output import LogFormatter

CLIPBOARD = "\x1b]52;c;b3duZWQ=\x07"
C1 = "\x9b31m"
REVERSED = "\u202e"
COMMAND = "\n::error file=x::y\n  ::error::##[error]z"
ODD = CLIPBOARD + C1 + REVERSED + COMMAND
HOSTILE = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u200e\u200f\u2028-\u202e\u2066-\u2069]")


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """Launch files of ROS 2 in which all that can hold odd characters does."""
    package = tmp_path / "src" / "pkg"
    package.mkdir(parents=True)
    (package / "package.xml").write_text(
        '<package format="3"><name>pkg</name><export><build_type>ament_cmake</build_type></export></package>'
    )
    odd = "".join(f"\\x{ord(char):02x}" if ord(char) < 256 else f"\\u{ord(char):04x}" for char in ODD)
    (package / "a.launch.yaml").write_text(
        f"""launch:
- arg: {{name: "a{odd}", default: "{odd}"}}
- node:
    pkg: "pkg{odd}"
    exec: "x{odd}"
    name: "n{odd}"
    param: [{{name: "p{odd}", value: "v{odd}"}}]
    remap: [{{from: "from{odd}", to: "to{odd}"}}]
- include: {{file: "gone{odd}.launch.yaml"}}
- nonsense{odd}: {{}}
"""
    )
    named = package / f"b{CLIPBOARD}.launch.yaml"
    named.write_text("launch:\n- node: {pkg: gone, exec: gone, name: b, launch-prefix: [1}\n")
    return tmp_path


CALLS = [
    *(["check", "FILE", "--format", form] for form in ("text", "json", "sarif", "junit", "github", "gitlab")),
    ["explain", "FILE:10", "FILE"],
    ["explain", "nothing" + CLIPBOARD],
    ["check", "."],
    ["check", "missing" + CLIPBOARD],
    *(["tree", "FILE", "--format", form] for form in ("text", "json", "html")),
    *(["graph", "FILE", "--format", form] for form in ("text", "json", "dot", "mermaid", "svg", "html")),
    ["trace", "FILE"],
    ["frames", "FILE"],
    ["where", "FILE", "p"],
    ["why", "FILE", "n"],
    ["snapshot", "FILE"],
    ["diff", "FILE", "ODD"],
    ["diff", "FILE", "nothing" + CLIPBOARD + ":x"],
    ["check", "FILE", "--changed-since", "x" + CLIPBOARD],
    ["check", "ODD"],
    ["rules", "X" + CLIPBOARD],
]


@pytest.mark.parametrize("call", CALLS, ids=lambda call: re.sub(r"[^\w .-]", "", " ".join(call)))
@pytest.mark.parametrize("colour", [False, True], ids=["plain", "colours"])
def test_no_control_characters(
    workspace: Path,
    call: list[str],
    colour: bool,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    files = {"FILE": "src/pkg/a.launch.yaml", "ODD": f"src/pkg/b{CLIPBOARD}.launch.yaml"}
    words = [re.sub("FILE|ODD", lambda found: files[found[0]], word) for word in call]
    if call[0] != "rules":
        words.append("--no-run")
    for module in ("check", "diff", "explain", "tree"):
        monkeypatch.setattr(f"preflight_server.cli.{module}.colours", lambda: colour)
    for module in ("check", "explain"):
        monkeypatch.setattr(f"preflight_server.cli.{module}.links", lambda: "host" if colour else None)
    monkeypatch.chdir(workspace)
    main(words)
    done = capsys.readouterr()
    assert done.out + done.err
    painted = r"\x1b\[[0-9;]*m|\x1b\]8;;(?:file://[!-~]*)?\x1b\\"
    out = re.sub(painted, "", done.out) if colour else done.out
    assert HOSTILE.findall(out + done.err) == []
    # GitHub's runner takes off space before it looks for commands.
    ours = "::" if "github" in call else None
    lines = (out + done.err).splitlines()
    assert [line for line in lines if line.lstrip().startswith("::") and not line.startswith(ours or "\0")] == []
    assert [line for line in lines if "##[" in line and not line.startswith(ours or "\0")] == []


def test_what_is_hidden_can_be_seen(
    workspace: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(workspace)
    assert main(["check", "missing" + CLIPBOARD]) == 2
    assert "missing␛]52;c;b3duZWQ=␇ does not exist" in capsys.readouterr().err


def test_a_log_line_is_no_command() -> None:
    try:
        raise ValueError("a\n::error file=x::y")
    except ValueError:
        said = ("b\n::error::##[error]z",)
        record = logging.LogRecord("x", logging.ERROR, "f", 1, "broke on %s", said, sys.exc_info())
    lines = LogFormatter("%(message)s").format(record).splitlines()
    assert lines[0] == "broke on b"
    assert [line for line in lines if line.lstrip().startswith("::") or "##[" in line] == []
    assert lines[-1] == "| ::error file=x::y"
