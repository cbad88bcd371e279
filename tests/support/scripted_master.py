"""A master of ROS 1, with its nodes and services, whose answers are given: as HTTP to whoever asks by that."""

from __future__ import annotations

import contextlib
import socket
import threading
from collections.abc import Iterator
from functools import cache
from unittest import mock

from preflight_analysis.live import bounded

BETWEEN = b"\n--\n"
"""Between one answer and the next; after the last one they come again."""
URI = b"{uri}"
"""Stands for the address of this very server: others are refused."""
_connect = socket.create_connection


class _Master:
    def __init__(self) -> None:
        self._listener = socket.create_server(("127.0.0.1", 0), backlog=128)
        self.port = self._listener.getsockname()[1]
        self.uri = f"http://127.0.0.1:{self.port}/"
        self._answers: list[bytes] = [b""]
        self._next = 0
        self._lock = threading.Lock()
        threading.Thread(target=self._accept, daemon=True).start()

    def take(self, data: bytes) -> None:
        with self._lock:
            self._answers, self._next = data.replace(URI, self.uri.encode()).split(BETWEEN), 0

    def _accept(self) -> None:
        while True:
            threading.Thread(target=self._answer, args=(self._listener.accept()[0],), daemon=True).start()

    def _answer(self, connection: socket.socket) -> None:
        with connection, contextlib.suppress(OSError):
            connection.settimeout(2)
            asked = connection.recv(65536)
            http = asked.startswith(b"POST")
            while http and b"</methodCall>" not in asked and (more := connection.recv(65536)):
                asked += more
            with self._lock:
                answer = self._answers[self._next % len(self._answers)]
                self._next += 1
            if http and not answer.startswith(b"HTTP/"):
                head = b"HTTP/1.1 200 OK\r\nContent-Type: text/xml\r\nContent-Length: %d\r\n\r\n" % len(answer)
                answer = head + answer
            connection.sendall(answer)


@cache
def _started() -> _Master:
    return _Master()


@contextlib.contextmanager
def master(data: bytes) -> Iterator[str]:
    """The address of a master that answers with the parts of `data`."""
    started = _started()
    started.take(data)

    def connect(address: tuple[str, int], timeout: float | None = None) -> socket.socket:
        """To nobody else: what an answer names may be anybody."""
        if address != ("127.0.0.1", started.port):
            raise ConnectionRefusedError(111, "Connection refused")
        return _connect(address, timeout)

    with mock.patch.object(bounded.socket, "create_connection", connect):
        yield started.uri
