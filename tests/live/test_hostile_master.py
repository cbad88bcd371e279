"""Masters, nodes and services that mean no good: each question has one deadline, and each answer a size."""

from __future__ import annotations

import gzip
import resource
import socket
import threading
import time
import xmlrpc.client
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from xmlrpc.server import SimpleXMLRPCServer

import pytest
from preflight_analysis.live.model import CannotObserveError
from preflight_analysis.live.observe_ros1 import Ros1Observer

Answer = Callable[[socket.socket, bytes], None]
HEAD = b"HTTP/1.1 200 OK\r\nContent-Type: text/xml\r\n"
SLOW = 0.2


@pytest.fixture
def serve() -> Iterator[Callable[[Answer], str]]:
    """A server that answers every connection with what a function sends."""
    listeners: list[socket.socket] = []

    def start(answer: Answer) -> str:
        listener = socket.create_server(("127.0.0.1", 0))
        listeners.append(listener)

        def one(connection: socket.socket) -> None:
            with connection, suppress(OSError):
                asked = b""
                while b"</methodCall>" not in asked and (more := connection.recv(65536)):
                    asked += more
                answer(connection, asked)

        def accept() -> None:
            with suppress(OSError):
                while True:
                    threading.Thread(target=one, args=(listener.accept()[0],), daemon=True).start()

        threading.Thread(target=accept, daemon=True).start()
        return f"http://127.0.0.1:{listener.getsockname()[1]}/"

    yield start
    for listener in listeners:
        listener.shutdown(socket.SHUT_RDWR)
        listener.close()


def dripping_head(connection: socket.socket, asked: bytes) -> None:
    for letter in HEAD * 1000:
        connection.sendall(bytes([letter]))
        time.sleep(SLOW)  # the answer is what is slow


def dripping_body(connection: socket.socket, asked: bytes) -> None:
    connection.sendall(HEAD + b"Content-Length: 100000\r\n\r\n<?xml version='1.0'?>")
    while True:
        connection.sendall(b" ")
        time.sleep(SLOW)  # the answer is what is slow


def endless(connection: socket.socket, asked: bytes) -> None:
    connection.sendall(HEAD + b"\r\n<?xml version='1.0'?><methodResponse><params><param><value><string>")
    while True:
        connection.sendall(b"x" * 65536)


def endless_head(connection: socket.socket, asked: bytes) -> None:
    connection.sendall(HEAD)
    while True:
        connection.sendall(b"X-A: " + b"x" * 60000 + b"\r\n")


def compressed(connection: socket.socket, asked: bytes) -> None:
    # In members: a gigabyte takes seconds to compress, which would count as the observer's.
    data = gzip.compress(b"<methodResponse><params><param><value>") + gzip.compress(b" " * (1 << 20)) * 1024
    connection.sendall(HEAD + b"Content-Encoding: gzip\r\nContent-Length: %d\r\n\r\n" % len(data) + data)


def nested(connection: socket.socket, asked: bytes) -> None:
    data = b"<methodResponse><params><param><value>" + b"<array><data><value>" * 300000
    connection.sendall(HEAD + b"Content-Length: %d\r\n\r\n" % len(data) + data)


def elsewhere(connection: socket.socket, asked: bytes) -> None:
    connection.sendall(b"HTTP/1.1 302 Found\r\nLocation: file:///etc/passwd\r\nContent-Length: 0\r\n\r\n")


@pytest.mark.parametrize("answer", [dripping_head, dripping_body, endless, endless_head, compressed, nested, elsewhere])
def test_an_answer_has_a_deadline_and_a_size(serve: Callable[[Answer], str], answer: Answer) -> None:
    observer = Ros1Observer(serve(answer))
    before, started = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, time.monotonic()
    with pytest.raises(CannotObserveError, match="does not answer"):
        observer.observe(1.0)
    took, grown = time.monotonic() - started, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    observer.close()
    # An answer that dripped took as long as it liked, an endless one 1.5 GB.
    assert took < 10
    if answer is not compressed:  # which this very process has made
        assert grown < 200_000


def test_nodes_that_do_not_answer_cost_one_look(serve: Callable[[Answer], str]) -> None:
    """A master that names a thousand nodes, each at an address that only listens."""
    silent = serve(lambda connection, asked: time.sleep(60))  # longer than anybody waits
    state = [[["/t", [f"/n{index}" for index in range(1000)]]], [], []]

    def answer(connection: socket.socket, asked: bytes) -> None:
        value = state if b"getSystemState" in asked else [] if b"getTopicTypes" in asked else silent
        body = xmlrpc.client.dumps(([1, "", value],), methodresponse=True).encode()
        connection.sendall(HEAD + b"Content-Length: %d\r\n\r\n" % len(body) + body)

    observer = Ros1Observer(serve(answer))
    started = time.monotonic()
    found = observer.observe(3.0)
    took = time.monotonic() - started
    observer.close()
    assert took < 20
    assert len(found.nodes) == 1000
    assert sum(node.dead is None for node in found.nodes.values()) > 900, "who was not asked may live"


def test_a_large_system_is_seen() -> None:
    """rosmaster compresses what is longer than 1,400 bytes, for clients that say that they take it."""
    topics = [[f"/topic{index}", [f"/node{index}"]] for index in range(500)]

    class Master(SimpleXMLRPCServer):
        def _dispatch(self, method: str, params: Sequence[object]) -> list[object]:
            answers = {"getSystemState": [topics, [], []], "getTopicTypes": []}
            return [1, "", answers.get(method, self.uri)]

        @property
        def uri(self) -> str:
            return f"http://127.0.0.1:{self.server_address[1]}/"

    with Master(("127.0.0.1", 0), logRequests=False) as master:
        threading.Thread(target=master.serve_forever, daemon=True).start()
        observer = Ros1Observer(master.uri)
        found = observer.observe()
        observer.close()
        master.shutdown()
    assert len(found.nodes) == 500
    assert len(found.endpoints) == 500
