"""A publisher of messages that are made up, for nodes in other languages than Python: they say when they need some.

The master names itself as a publisher of the topic. Whoever connects gets messages of the type that it asks for,
whatever that is: zeros are a message of any type, since numbers are 0 and strings and arrays empty, and what is too
much of them is ignored. http://wiki.ros.org/ROS/TCPROS tells the protocol.
"""

from __future__ import annotations

import socket
import struct
import threading
import time
from typing import Optional

from .stub_master import Master
from .tcpros import header, read_header

MESSAGES = 20
SECONDS_BETWEEN = 0.01
"""Each topic gets so many messages, so far apart: some nodes collect a few."""
MAX_TOPICS = 50
CLOCK = "/clock"
_ZEROS = bytes(65536)
_ONE = b"\1" + _ZEROS[1:]
"""What comes first is often a yes or no, or the count in a header."""
_SUCCEEDED = 3
ANY_TYPE = "preflight/Any"
_UNTYPED = {"type": ANY_TYPE, "md5sum": "992ce8a1687cec8c8bd883ec73ca41d1"}
"""For those who take any type. What they advertise with it has whatever type their input has."""
_LONGEST = 3.0
"""Seconds until a subscriber that waits for a message is given up."""


class FakePublisher:
    """Feeds the topics that it is told to."""

    def __init__(self, master: Master) -> None:
        self._master = master
        self._lock = threading.Lock()
        self._goals: dict[str, str] = {}
        self._waiting: dict[str, float] = {}
        """Since when they wait for the last message."""
        self._listening = socket.socket()
        self._listening.bind(("127.0.0.1", 0))
        self._listening.listen(16)
        threading.Thread(target=self._accept, daemon=True).start()

    def publish(self, topic: str, goal: Optional[str] = None) -> None:
        """Send messages to who subscribes to `topic`, now or later; the result of `goal` if that is an action's."""
        with self._lock:
            if topic in self._goals or len(self._goals) >= MAX_TOPICS:
                return
            self._goals[topic] = goal or ""
            self._waiting[topic] = time.monotonic()
        self._master.add_publisher(topic, self._listening.getsockname()[1])

    def busy(self) -> bool:
        """Whether something is still on its way."""
        with self._lock:
            return any(time.monotonic() - since < _LONGEST for since in self._waiting.values())

    def _accept(self) -> None:
        while True:
            connection = self._listening.accept()[0]
            threading.Thread(target=self._serve, args=(connection,), daemon=True).start()

    def _serve(self, connection: socket.socket) -> None:
        topic = ""
        try:
            with connection:
                asked = read_header(connection)
                topic = asked.get("topic", "")
                if topic not in self._goals:
                    return
                described = _UNTYPED if asked.get("md5sum") == "*" else asked
                answer = {"callerid": "/master", "latching": "0", "message_definition": "string data"}
                answer.update({key: described.get(key, "*") for key in ("type", "md5sum")})
                connection.sendall(header(answer))
                self._send(connection, topic)
        except (OSError, ValueError, struct.error):
            pass
        finally:
            with self._lock:
                self._waiting.pop(topic, None)

    def _send(self, connection: socket.socket, topic: str) -> None:
        if topic == CLOCK:
            while True:
                now = time.time()
                _message(connection, struct.pack("<II", int(now), int(now % 1 * 1e9)))
                with self._lock:
                    self._waiting.pop(topic, None)
                time.sleep(SECONDS_BETWEEN)
        if self._goals[topic]:
            _message(connection, _result(self._goals[topic]))
        else:
            for number in range(MESSAGES):
                _message(connection, _ONE if number % 2 else _ZEROS)
                time.sleep(SECONDS_BETWEEN)
        with self._lock:
            self._waiting.pop(topic, None)
        # The connection stays: one that ends is made anew.
        connection.recv(1)


def _result(goal: str) -> bytes:
    """Any `...ActionResult`: a header, the status with the goal's id, and a result of zeros."""
    name = goal.encode(errors="replace")
    return bytes(16) + bytes(8) + struct.pack("<I", len(name)) + name + bytes([_SUCCEEDED]) + bytes(4) + _ZEROS


def _message(connection: socket.socket, content: bytes) -> None:
    connection.sendall(struct.pack("<I", len(content)) + content)
