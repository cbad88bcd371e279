"""What subscribers get of the publisher of made-up messages, over real connections."""

from __future__ import annotations

import socket
import struct
import threading
from collections.abc import Iterator

import pytest
from preflight_analysis.tracing.agents import fake_publisher, tcpros
from preflight_analysis.tracing.agents.fake_publisher import MESSAGES, FakePublisher

SIZE = 65536
ONCE = [("std_msgs/String", b"\0"), ("std_msgs/Bool", b"\1"), ("sensor_msgs/LaserScan", b"\0")]


class Listening:
    """The part of the master: it hears of the port."""

    port = 0

    def add_publisher(self, topic: str, port: int) -> None:
        self.port = port


class Subscriber:
    """Connects as roscpp does, and reads what comes."""

    def __init__(self, port: int, topic: str, kind: str) -> None:
        connection = socket.create_connection(("127.0.0.1", port), 20)
        connection.sendall(tcpros.header({"topic": topic, "type": kind, "md5sum": "0", "callerid": "/node"}))
        tcpros.read_header(connection)
        self._stream = connection.makefile("rb")

    def message(self) -> bytes:
        (size,) = struct.unpack("<I", self._stream.read(4))
        return self._stream.read(size)

    def firsts(self) -> list[bytes]:
        """The first bytes of the messages of one round."""
        return [self.message()[:1] for _ in range(MESSAGES)]


@pytest.fixture
def publisher(monkeypatch: pytest.MonkeyPatch) -> Iterator[tuple[FakePublisher, Listening]]:
    monkeypatch.setattr(fake_publisher, "SECONDS_BETWEEN", 0)
    listening = Listening()
    made = FakePublisher(listening)  # type: ignore[arg-type]
    yield made, listening
    made._listening.shutdown(socket.SHUT_RDWR)
    made._listening.close()


@pytest.mark.parametrize(("kind", "first"), ONCE)
def test_whichever_message_a_wait_takes_it_is_the_same(
    publisher: tuple[FakePublisher, Listening], kind: str, first: bytes
) -> None:
    """A node that comes to it late takes another one than the first of them."""
    made, master = publisher
    made.publish("/goal", awaited=True)
    subscriber = Subscriber(master.port, "/goal", kind)
    assert {subscriber.message() for _ in range(MESSAGES)} == {first + bytes(SIZE - 1)}


def test_a_poll_gets_a_yes_and_a_no(publisher: tuple[FakePublisher, Listening]) -> None:
    made, master = publisher
    made.publish("/ready")
    assert set(Subscriber(master.port, "/ready", "std_msgs/Bool").firsts()) == {b"\0", b"\1"}


def test_who_listens_already_gets_messages_for_the_next_wait(publisher: tuple[FakePublisher, Listening]) -> None:
    made, master = publisher
    made.publish("/goal")
    subscriber = Subscriber(master.port, "/goal", "std_msgs/String")
    assert set(subscriber.firsts()) == {b"\0", b"\1"}
    made.publish("/goal", awaited=True)
    assert set(subscriber.firsts()) == {b"\0"}
    made.publish("/goal", awaited=True)
    assert set(subscriber.firsts()) == {b"\0"}


def test_each_goal_has_a_result(publisher: tuple[FakePublisher, Listening]) -> None:
    made, master = publisher
    made.publish("/move/result", "first")
    early = Subscriber(master.port, "/move/result", "actionlib/TestActionResult")
    assert b"first" in early.message()
    made.publish("/move/result", "second")
    assert b"second" in early.message()
    late = Subscriber(master.port, "/move/result", "actionlib/TestActionResult")
    assert [b"first" in late.message(), b"second" in late.message()] == [True, True]


def test_the_publisher_is_busy_until_what_was_asked_for_has_come(publisher: tuple[FakePublisher, Listening]) -> None:
    made, master = publisher
    assert not made.busy()
    made.publish("/goal", awaited=True)
    assert made.busy()
    Subscriber(master.port, "/goal", "std_msgs/String").firsts()
    while made.busy():
        pass


def test_a_flood_of_requests_has_an_end(publisher: tuple[FakePublisher, Listening]) -> None:
    made, _ = publisher
    for number in range(2 * fake_publisher.MAX_ROUNDS):
        made.publish("/move/result", str(number))
        made.publish(f"/topic{number}")
    assert len(made._rounds["/move/result"]) == fake_publisher.MAX_ROUNDS
    assert len(made._rounds) == fake_publisher.MAX_TOPICS


def test_who_is_closed_waits_for_nobody(monkeypatch: pytest.MonkeyPatch) -> None:
    raised: list[object] = []
    monkeypatch.setattr(threading, "excepthook", raised.append)
    before = {*threading.enumerate()}
    made = FakePublisher(Listening())  # type: ignore[arg-type]
    (waiting,) = {*threading.enumerate()} - before
    made._listening.shutdown(socket.SHUT_RDWR)
    made._listening.close()
    waiting.join(20)
    assert not waiting.is_alive()
    assert not raised
