"""Asking servers that are not trusted: an answer has one deadline and a size, however it comes."""

from __future__ import annotations

import http.client
import io
import socket
import time
import xmlrpc.client
from typing import Any

MAX_BYTES = 8 << 20
"""Of an answer. The state of a system of 1,000 topics takes less than one."""
_CHUNK = 64 << 10


class _Received(io.RawIOBase):
    """What a connection receives, until the moment `until` on the monotonic clock and at most so many bytes."""

    def __init__(self, connection: socket.socket, until: float, most: int) -> None:
        # A file of the connection's own keeps it open: http.client closes the connection before it reads the answer.
        self._connection, self._file = connection, connection.makefile("rb", buffering=0)
        self._until, self._left = until, most

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: Any) -> int:
        self._connection.settimeout(remaining(self._until))
        count = self._file.readinto(buffer) or 0
        self._left -= count
        if self._left < 0:
            raise OSError("the answer is too large")
        return count

    def close(self) -> None:
        self._file.close()
        super().close()


class BoundedSocket:
    """A connection for one question and its answer, to be closed by the caller. Raises `OSError`, `TimeoutError`
    among them."""

    def __init__(self, address: tuple[str, int], until: float, most: int = MAX_BYTES) -> None:
        self._until, self._most = until, most
        self._connection = socket.create_connection(address, timeout=remaining(until))

    def sendall(self, data: Any) -> None:
        """As of a socket; what does not leave in time raises."""
        self._connection.settimeout(remaining(self._until))
        self._connection.sendall(data)

    def makefile(self, mode: str = "rb") -> io.BufferedReader:
        """What comes back, for `http.client` as well."""
        return io.BufferedReader(_Received(self._connection, self._until, self._most))

    def close(self) -> None:
        """As of a socket."""
        self._connection.close()


class _Connection(http.client.HTTPConnection):
    until = 0.0

    def connect(self) -> None:
        self.sock = BoundedSocket((self.host, self.port), self.until)


class Transport(xmlrpc.client.Transport):
    """XML-RPC with an answer before `until`."""

    accept_gzip_encoding = False
    """A master compresses what is longer than 1400 bytes for whoever says that he takes it."""

    def __init__(self, until: float) -> None:
        super().__init__()
        self._until = until

    def make_connection(self, host: Any) -> http.client.HTTPConnection:
        """A connection for one call."""
        chosen, self._extra_headers, _ = self.get_host_info(host)
        connection = _Connection(chosen)
        connection.until = self._until
        self._connection = host, connection
        return connection

    def parse_response(self, response: Any) -> Any:
        """What the answer says. A compressed one is refused: it may be of any size."""
        if response.getheader("Content-Encoding", "") != "":
            raise OSError("the answer is compressed")
        parser, unmarshaller = self.getparser()
        while data := response.read(_CHUNK):
            parser.feed(data)
        parser.close()
        return unmarshaller.close()


def remaining(until: float) -> float:
    """Seconds until then, raises `TimeoutError` where none are left."""
    left = until - time.monotonic()
    if left <= 0:
        raise TimeoutError
    return left
