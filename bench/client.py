"""Just enough of an editor for a benchmark: the real server over its standard input and output."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any


class Client:
    """A server in a process of its own, which may show progress."""

    def __init__(self, folder: Path, home: Path, *, trusted: bool) -> None:
        environment = {**os.environ, "HOME": str(home), "XDG_CACHE_HOME": str(home / ".cache")}
        self._server = subprocess.Popen(
            [sys.executable, "-m", "preflight_server.cli.main", "lsp"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment,
        )
        self._id = 0
        self._titles: dict[str, str] = {}
        self.begun: dict[str, float] = {}
        self.ended: dict[str, float] = {}
        """When the progress of a title began, and ended."""
        self.request(
            "initialize",
            {
                "processId": os.getpid(),
                "rootUri": folder.as_uri(),
                "capabilities": {"window": {"workDoneProgress": True}},
                "initializationOptions": {"workspaceTrusted": trusted},
            },
        )
        self.notify("initialized", {})

    def notify(self, method: str, params: Any) -> None:
        self._send({"method": method, "params": params})

    def request(self, method: str, params: Any) -> Any:
        self._id += 1
        self._send({"id": self._id, "method": method, "params": params})
        while (message := self.receive()).get("id") != self._id:
            pass
        return message.get("result")

    def diagnostics(self, fits: Callable[[Any], bool]) -> Any:
        """The next published diagnostics that fit."""
        while True:
            message = self.receive()
            if message.get("method") == "textDocument/publishDiagnostics" and fits(message["params"]):
                return message["params"]

    def receive(self) -> Any:
        assert self._server.stdout is not None
        length = 0
        while line := self._server.stdout.readline().strip():
            name, _, value = line.partition(b":")
            if name.lower() == b"content-length":
                length = int(value)
        if not length:
            raise SystemExit("the server ended")
        message = json.loads(self._server.stdout.read(length))
        if message.get("method") == "$/progress":
            self._progress(message["params"]["token"], message["params"]["value"])
        elif "method" in message and "id" in message:
            self._send({"id": message["id"], "result": None})
        return message

    def _progress(self, token: str, value: Any) -> None:
        if value["kind"] == "begin":
            self._titles[token] = value["title"]
            self.begun[value["title"]] = time.perf_counter()
        elif value["kind"] == "end":
            self.ended[self._titles[token]] = time.perf_counter()

    def megabytes(self) -> float:
        """Resident memory of the server."""
        status = Path(f"/proc/{self._server.pid}/status").read_text()
        return int(status.partition("VmRSS:")[2].split()[0]) / 1024

    def _send(self, message: dict[str, Any]) -> None:
        assert self._server.stdin is not None
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self._server.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        self._server.stdin.flush()

    def close(self) -> None:
        self.request("shutdown", None)
        self.notify("exit", None)
        self._server.wait(20)
