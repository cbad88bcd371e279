"""The real server behind its protocol, for messages that no editor would send."""

from __future__ import annotations

import itertools
import json
import os
import queue
import re
import subprocess
import sys
import tempfile
import threading
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from tools.endurance.scripted_editor import AT_PLACE

SECONDS = 20.0
"""For the answer to a question after the messages; the machine may be busy."""
_NOT_SENT = ("exit", "shutdown", "initialize")
"""What ends the server, as it should, or begins it."""
_OURS = re.compile(r'preflight_(?:analysis|server/lsp/(?!protocol))\S*\.py", line|a background task failed|CRITICAL')
"""In the log: a frame of ours in a traceback. pygls shows its own for each message that it does not understand."""
_ALLOWED = (-32700, -32600, -32601, -32602, -32800, -32801, -32803)
"""Codes of answers that are the client's fault, or say that something cannot be done. What broke is -32603."""
LAUNCH = """<launch>
  <arg name="a" default="1"/>
  <!-- ä𝄞 -->
  <node pkg="p" type="talker.py" name="$(arg a)"><remap from="x" to="y"/></node>
  <include file="$(find p)/launch/other.launch"><arg name="b" value="$(arg a)"/></include>
</launch>
"""


class ServerError(Exception):
    """What the server did that it must not."""


class _Server:
    def __init__(self) -> None:
        self._scratch = tempfile.TemporaryDirectory(prefix="preflight-fuzz-server-")
        self.folder = Path(self._scratch.name) / "ws"
        share = self.folder / "src" / "p"
        (share / "launch").mkdir(parents=True)
        (share / "package.xml").write_text("<package><name>p</name></package>")
        self.launch = share / "launch" / "x.launch"
        self.launch.write_text(LAUNCH)
        (share / "launch" / "other.launch").write_text("<launch><arg name='b'/></launch>")
        self._numbers = itertools.count(1)
        self._process: subprocess.Popen[bytes] | None = None

    def send(self, data: bytes) -> None:
        """Send each line as the body of a message, then ask for what is at a place. Raises `ServerError`."""
        process = self._running()
        for body in data.replace(b"{uri}", self.launch.as_uri().encode()).split(b"\n"):
            if self._fit(body):
                self._write(body)
        number = f"after-{next(self._numbers)}"
        where = {"textDocument": {"uri": self.launch.as_uri()}, "position": {"line": 1, "character": 4}}
        self._message({"id": number, "method": "textDocument/hover", "params": where})
        try:
            self._until(number)
        except ServerError:
            process.kill()
            process.wait()
            self._process = None
            raise
        if said := _OURS.search(self._said()):
            text = self._said()
            self._errors.clear()
            raise ServerError(text[max(0, said.start() - 2000) :][:5000])

    def _fit(self, body: bytes) -> bool:
        try:
            found = json.loads(body)
        except (ValueError, RecursionError):
            return True
        method = found.get("method") if isinstance(found, dict) else None
        if method == "workspace/didChangeWorkspaceFolders":
            # Another folder is the user's choice, and walking it takes as long as it is large.
            return b"file:///" not in body.replace(self.folder.as_uri().encode(), b"")
        return method not in _NOT_SENT

    def _running(self) -> subprocess.Popen[bytes]:
        if self._process is not None and self._process.poll() is None:
            return self._process
        home = Path(self._scratch.name) / "home"
        home.mkdir(exist_ok=True)
        environment = {"PATH": "/usr/bin:/bin", "HOME": str(home), "ROS_PREFLIGHT_SANDBOX": "none", "LANG": "C.UTF-8"}
        self._process = subprocess.Popen(
            [str(Path(sys.executable).with_name("ros-preflight")), "lsp", "--stdio"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env=environment,
            cwd=self.folder,
        )
        self._answers: queue.Queue[Mapping[str, Any] | None] = queue.Queue()
        self._errors: list[bytes] = []
        threading.Thread(target=self._read, args=(self._process, self._answers), daemon=True).start()
        threading.Thread(target=self._listen, args=(self._process, self._errors), daemon=True).start()
        params = {
            "processId": os.getpid(),
            "rootUri": self.folder.as_uri(),
            "capabilities": {},
            "initializationOptions": {"workspaceTrusted": True, "status": True},
            "workspaceFolders": [{"uri": self.folder.as_uri(), "name": "ws"}],
        }
        self._message({"id": "initialize", "method": "initialize", "params": params})
        self._until("initialize")
        self._message({"method": "initialized", "params": {}})
        document = {"uri": self.launch.as_uri(), "languageId": "roslaunch", "version": 1, "text": LAUNCH}
        self._message({"method": "textDocument/didOpen", "params": {"textDocument": document}})
        return self._process

    def _message(self, content: Mapping[str, Any]) -> None:
        self._write(json.dumps({"jsonrpc": "2.0", **content}).encode())

    def _write(self, body: bytes) -> None:
        assert self._process is not None
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
            self._process.stdin.flush()
        except OSError:
            raise ServerError(f"the server is gone: {self._said()[-3000:]}") from None

    def _until(self, number: str) -> None:
        while True:
            try:
                answer = self._answers.get(timeout=SECONDS)
            except queue.Empty:
                raise ServerError(f"no answer within {SECONDS:g} s: {self._said()[-3000:]}") from None
            if answer is None:
                raise ServerError(f"the server ended: {self._said()[-3000:]}")
            code = (answer.get("error") or {}).get("code")
            if code is not None and code not in _ALLOWED:
                raise ServerError(f"it answers {answer} {self._said()[-3000:]}")
            if answer.get("method") == "window/showMessage":
                raise ServerError(f"a message box: {answer}")
            if answer.get("id") == number and "method" not in answer:
                return

    def _said(self) -> str:
        return b"".join(self._errors).decode(errors="replace")

    @staticmethod
    def _read(process: subprocess.Popen[bytes], answers: queue.Queue[Mapping[str, Any] | None]) -> None:
        assert process.stdout is not None
        while True:
            length = 0
            while (head := process.stdout.readline()) not in (b"\r\n", b""):
                name, _, value = head.partition(b":")
                if name.lower() == b"content-length":
                    length = int(value)
            if not head:
                answers.put(None)
                return
            answers.put(json.loads(process.stdout.read(length)))

    @staticmethod
    def _listen(process: subprocess.Popen[bytes], errors: list[bytes]) -> None:
        assert process.stderr is not None
        for each in process.stderr:
            errors.append(each)


@cache
def server() -> _Server:
    """One server for all messages, started when it is first asked for and again when it has ended."""
    return _Server()


_OF_FILE = (
    "documentSymbol",
    "foldingRange",
    "documentLink",
    "inlayHint",
    "semanticTokens/full",
    "semanticTokens/range",
    "codeLens",
    "codeAction",
    "diagnostic",
)
_OWN = ("trace", "doctor", "clearCache", "roots", "selectRoot", "tree", "graph", "watch")


def messages() -> list[bytes]:
    """One valid message of each kind, and a few in a row."""
    document = {"uri": "{uri}"}
    start, end = {"line": 0, "character": 0}, {"line": 4, "character": 3}
    here = {"textDocument": document, "position": {"line": 3, "character": 30}}
    range_ = {"textDocument": document, "range": {"start": start, "end": end}}
    more: dict[str, Any] = {"context": {"includeDeclaration": True, "diagnostics": [], "triggerKind": 1}}
    found: list[dict[str, Any]] = [
        *({"id": 7, "method": f"textDocument/{m}", "params": {**here, **more, "newName": "b"}} for m in AT_PLACE),
        *({"id": 7, "method": f"textDocument/{m}", "params": {**range_, **more}} for m in _OF_FILE),
        *({"id": 7, "method": f"rosPreflight/{m}", "params": {"uri": "{uri}", "args": {}}} for m in _OWN),
        {"id": 7, "method": "workspace/symbol", "params": {"query": "a"}},
        {"id": 7, "method": "workspace/executeCommand", "params": {"command": "x", "arguments": []}},
        {"method": "workspace/didChangeConfiguration", "params": {"settings": {"rosPreflight": {"args": {"a": 1}}}}},
        {"method": "workspace/didChangeWatchedFiles", "params": {"changes": [{"uri": "{uri}", "type": 2}]}},
        {"method": "rosPreflight/workspaceTrust", "params": {"trusted": False}},
        {"method": "$/cancelRequest", "params": {"id": 7}},
        {"method": "window/workDoneProgress/cancel", "params": {"token": "x"}},
    ]
    changed = {"range": {"start": start, "end": end}, "text": "<launch><node/>"}
    version = {"uri": "{uri}", "version": 2}
    edits: list[dict[str, Any]] = [
        {"method": "textDocument/didChange", "params": {"textDocument": version, "contentChanges": [changed]}},
        {"method": "textDocument/didChange", "params": {"textDocument": version, "contentChanges": [{"text": LAUNCH}]}},
        {"method": "textDocument/didSave", "params": {"textDocument": document}},
        {"method": "textDocument/didClose", "params": {"textDocument": document}},
        {"method": "textDocument/didOpen", "params": {"textDocument": {**version, "languageId": "x", "text": LAUNCH}}},
    ]
    lines = [json.dumps({"jsonrpc": "2.0", **each}).encode() for each in [*found, *edits]]
    return [*lines, b"\n".join(lines[-5:]), b"\n".join([*lines[:3], lines[-5], *lines[3:6]])]
