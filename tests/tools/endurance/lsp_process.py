"""The real server in a process of its own, as plain JSON: what it published, answered and logged, and what it uses."""

from __future__ import annotations

import contextlib
import json
import os
import queue
import re
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

COMMAND = (str(Path(sys.executable).with_name("ros-preflight")), "lsp", "--stdio")
ANSWER_SECONDS = 120.0
"""For an answer, and for the end of the process; the machine may be busy."""
_ALLOWED = (-32800, -32801, -32803)
"""Codes of answers: cancelled, the text has changed, cannot be done. Everything else is the server's fault, as all
requests are valid."""
_FAULT = re.compile(r"^(?:ERROR|CRITICAL)|^Traceback|Exception ignored|Fatal Python error|ResourceWarning", re.M)
CAPABILITIES: Mapping[str, Any] = {
    "window": {"workDoneProgress": True},
    "workspace": {"workspaceFolders": True, "configuration": False},
    "textDocument": {
        "publishDiagnostics": {"relatedInformation": True, "versionSupport": True},
        "hover": {"contentFormat": ["markdown"]},
        "definition": {"linkSupport": True},
        "documentSymbol": {"hierarchicalDocumentSymbolSupport": True},
        "completion": {"completionItem": {"snippetSupport": True}, "contextSupport": True},
        "codeAction": {"codeActionLiteralSupport": {"codeActionKind": {"valueSet": ["quickfix", "refactor"]}}},
    },
}


class Failure(AssertionError):
    """Something that the server did and must not do."""


class LspProcess:
    """A server that was started and initialised. All methods are called from one thread."""

    def __init__(
        self,
        folders: Sequence[Path],
        log: Path,
        variables: Mapping[str, str],
        *,
        environments: Mapping[Path, Mapping[str, str]] | None = None,
        trusted: bool = False,
        command: Sequence[str] = COMMAND,
        cwd: Path | None = None,
    ) -> None:
        self.log = log
        self._log = log.open("wb")
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._log, env=dict(variables), cwd=cwd
        )
        self._news = threading.Condition()
        self._outbox: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        """Whoever reads must not wait for the server to read: it may wait for him."""
        self._number = 0
        self._ended = False
        self.published: dict[str, dict[str, Any]] = {}
        """By URI, as the last message had it."""
        self.answers: dict[int, dict[str, Any]] = {}
        self.unanswered: dict[int, str] = {}
        self.begun = 0
        """How many pieces of work with progress: the index of each folder is the first. Short ones show none."""
        self.runs = 0
        """How often it began to run something in the sandbox."""
        self.idle = False
        self.messages = 0
        self.boxes: list[str] = []
        """What it showed the user in message boxes."""
        threading.Thread(target=self._read, daemon=True).start()
        threading.Thread(target=self._write, daemon=True).start()
        self.capabilities = self.request(
            "initialize",
            {
                "processId": os.getpid(),
                "rootUri": folders[0].as_uri() if folders else None,
                "workspaceFolders": [{"uri": folder.as_uri(), "name": folder.name} for folder in folders],
                "capabilities": CAPABILITIES,
                "initializationOptions": {
                    "workspaceTrusted": trusted,
                    "status": True,
                    "environments": {folder.as_uri(): dict(v) for folder, v in (environments or {}).items()},
                },
            },
        )["result"]
        self.notify("initialized", {})

    # Messages

    def notify(self, method: str, params: Any) -> None:
        self._send({"method": method, "params": params})

    def ask(self, method: str, params: Any) -> int:
        """Send a request and do not wait; the number is that of its answer."""
        self._number += 1
        with self._news:
            self.unanswered[self._number] = method
        self._send({"id": self._number, "method": method, "params": params})
        return self._number

    def cancel(self, number: int) -> None:
        self.notify("$/cancelRequest", {"id": number})

    def answer(self, number: int, seconds: float = ANSWER_SECONDS) -> dict[str, Any]:
        """Wait for an answer and take it. Raises `Failure` if there is none."""
        self.until(lambda: number in self.answers, seconds, f"no answer to request {number}")
        return self.answers.pop(number)

    def request(self, method: str, params: Any) -> dict[str, Any]:
        return self.answer(self.ask(method, params))

    def until(self, what: Callable[[], object], seconds: float, otherwise: str) -> None:
        """Wait until something is so; it is asked again at each message. Raises `Failure` if that never comes."""
        deadline = time.monotonic() + seconds
        with self._news:
            while not what():
                if self._ended and not what():
                    raise Failure(f"{otherwise}: the server ended{self._tail()}")
                left = deadline - time.monotonic()
                if left <= 0:
                    raise Failure(f"{otherwise} within {seconds:g} s{self._tail()}")
                self._news.wait(left)

    def still(self, seconds: float) -> bool:
        """Whether it stays idle and says nothing for so long."""
        deadline = time.monotonic() + seconds
        with self._news:
            before = self.messages
            while (left := deadline - time.monotonic()) > 0 and self.messages == before:
                self._news.wait(left)
            return self.messages == before and self.idle and not self.unanswered

    def rest(self, folders: int, still: float, seconds: float) -> None:
        """Wait until as many folders are indexed and nothing is done any more. Raises `Failure` if that never comes."""
        self.until(lambda: self.begun >= folders, seconds, "it is not indexed")
        deadline = time.monotonic() + seconds
        while not self.still(still):
            if time.monotonic() > deadline:
                raise Failure(f"the server does not come to rest: {self.unanswered}{self._tail()}")

    def state(self) -> dict[str, list[str]]:
        """The diagnostics of each file that has any, in no order."""
        with self._news:
            published = dict(self.published)
        return {
            uri: sorted(json.dumps(each, sort_keys=True) for each in params["diagnostics"])
            for uri, params in published.items()
            if params["diagnostics"]
        }

    def close(self) -> int:
        """Leave as an editor does; the exit code."""
        self.request("shutdown", None)
        self.notify("exit", None)
        try:
            return self._process.wait(ANSWER_SECONDS)
        except subprocess.TimeoutExpired:
            raise Failure(f"the server does not end{self._tail()}") from None
        finally:
            self._let_go()

    def kill(self) -> None:
        """As the kernel does it when there is no memory left."""
        self._process.kill()
        self._process.wait()
        self._let_go()

    def _let_go(self) -> None:
        self._process.kill()
        self._outbox.put(None)
        for stream in (self._process.stdin, self._process.stdout, self._log):
            assert stream is not None
            with contextlib.suppress(OSError):
                stream.close()

    def _send(self, message: Mapping[str, Any]) -> None:
        if self._ended and "method" in message:
            raise Failure(f"the server is gone{self._tail()}")
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self._outbox.put(b"Content-Length: %d\r\n\r\n" % len(body) + body)

    def _write(self) -> None:
        stream = self._process.stdin
        assert stream is not None
        with contextlib.suppress(OSError, ValueError):
            while (message := self._outbox.get()) is not None:
                stream.write(message)
                stream.flush()

    def _read(self) -> None:
        stream = self._process.stdout
        assert stream is not None
        with contextlib.suppress(OSError, ValueError):
            while head := stream.readline():
                length = 0
                while head not in (b"\r\n", b""):
                    name, _, value = head.partition(b":")
                    length = int(value) if name.lower() == b"content-length" else length
                    head = stream.readline()
                self._take(json.loads(stream.read(length)))
        with self._news:
            self._ended = True
            self._news.notify_all()

    def _take(self, message: dict[str, Any]) -> None:
        method, params = message.get("method"), message.get("params")
        with self._news:
            self.messages += 1
            if method is None:
                self.unanswered.pop(message["id"], None)
                self.answers[message["id"]] = message
                if message.get("error") and message["error"]["code"] not in _ALLOWED:
                    self.boxes.append(f"answer: {message}")
            elif method == "textDocument/publishDiagnostics":
                self.published[params["uri"]] = params
            elif method == "rosPreflight/status":
                self.idle = params["state"] == "idle"
                self.runs += params["state"] == "tracing" and params["done"] == 0
            elif method == "window/workDoneProgress/create":
                self.begun += 1
            elif method in ("window/showMessage", "window/showMessageRequest"):
                self.boxes.append(f"message box: {params}")
            self._news.notify_all()
        if method is not None and "id" in message:
            self._send({"id": message["id"], "result": None})

    # What it must not do, and what it uses

    def faults(self) -> list[str]:
        """Internal errors that it answered or logged, and message boxes."""
        text = self.log.read_text(errors="replace")
        logged = [text[max(0, each.start() - 200) : each.start() + 3000] for each in _FAULT.finditer(text)]
        return [*self.boxes, *logged[:3]]

    def _tail(self) -> str:
        return "\n" + self.log.read_text(errors="replace")[-3000:]

    @property
    def pid(self) -> int:
        return self._process.pid

    def megabytes(self) -> float:
        """Resident memory."""
        status = Path(f"/proc/{self.pid}/status").read_text()
        return int(status.partition("VmRSS:")[2].split()[0]) / 1024

    def descriptors(self) -> int:
        return len(os.listdir(f"/proc/{self.pid}/fd"))

    def threads(self) -> int:
        return len(os.listdir(f"/proc/{self.pid}/task"))

    def children(self) -> list[str]:
        """The command lines of its descendants."""
        return [" ".join(words) for _, words in descendants(self.pid)]


def descendants(pid: int) -> list[tuple[int, list[str]]]:
    """Processes that a process started, directly or not, with their command lines."""
    parents: dict[int, list[int]] = {}
    for each in Path("/proc").iterdir():
        with contextlib.suppress(OSError, ValueError):
            number = int(each.name)
            parents.setdefault(int(each.joinpath("stat").read_text().rpartition(")")[2].split()[1]), []).append(number)
    found, todo = [], [pid]
    while todo:
        for child in parents.get(todo.pop(), ()):
            todo.append(child)
            with contextlib.suppress(OSError):
                words = Path(f"/proc/{child}/cmdline").read_bytes().decode(errors="replace").split("\0")
                found.append((child, words[:6]))
    return found
