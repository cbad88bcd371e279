"""A publisher of messages that are made up, for nodes in other languages than Python: they say when they need some.

The master names itself as a publisher of the topic. Whoever connects gets messages of the type that it asks for,
whatever that is: zeros are a message of any type, since numbers are 0 and strings and arrays empty, and what is too
much of them is ignored. http://wiki.ros.org/ROS/TCPROS tells the protocol.

A node that waits for one message takes the newest of those that came before it looked, so all that it gets are alike;
one that polls until some message says yes gets both.
"""

from __future__ import annotations

import select
import socket
import struct
import threading
import time
from contextlib import suppress

from .stub_master import Master
from .tcpros import header, read_header

MESSAGES = 20
SECONDS_BETWEEN = 0.01
"""Each topic gets so many messages, so far apart: some nodes collect a few."""
MAX_TOPICS = 50
MAX_ROUNDS = 500
"""So often messages of one topic are asked for."""
CLOCK = "/clock"
_ZEROS = bytes(65536)
_ONE = b"\1" + _ZEROS[1:]
"""What comes first is often a yes or no, or the count in a header."""
_SUCCEEDED = 3
ANY_TYPE = "preflight/Any"
_UNTYPED = {"type": ANY_TYPE, "md5sum": "992ce8a1687cec8c8bd883ec73ca41d1"}
"""For those who take any type. What they advertise with it has whatever type their input has."""
_YES_OR_NO = "std_msgs/Bool"
_LONGEST = 3.0
"""Seconds until a subscriber that waits for a message is given up."""
_TICK = 0.02
"""Seconds between looks whether more is asked for."""


class FakePublisher:
    """Feeds the topics that it is told to."""

    def __init__(self, master: Master) -> None:
        self._master = master
        self._lock = threading.Lock()
        self._rounds: dict[str, list[str]] = {}
        """By topic how often its messages were asked for: each time the goal whose result it was, else nothing."""
        self._awaited: set[str] = set()
        """The topics of which one message is waited for."""
        self._waiting: dict[str, float] = {}
        """Since when they wait for the last message."""
        self._listening = socket.socket()
        self._listening.bind(("127.0.0.1", 0))
        self._listening.listen(16)
        threading.Thread(target=self._accept, daemon=True).start()

    def publish(self, topic: str, goal: str = "", awaited: bool = False) -> None:
        """Send messages to who subscribes to `topic`, now or later: the result of `goal` if that is an action's, what
        can be taken for an answer if one message is `awaited`."""
        with self._lock:
            known = topic in self._rounds
            if len(self._rounds.get(topic, ())) >= MAX_ROUNDS or (not known and len(self._rounds) >= MAX_TOPICS):
                return
            if awaited:
                self._awaited.add(topic)
            elif known and not goal:
                return
            self._rounds.setdefault(topic, []).append(goal)
            self._waiting[topic] = time.monotonic()
        if not known:
            self._master.add_publisher(topic, self._listening.getsockname()[1])

    def busy(self) -> bool:
        """Whether something is still on its way."""
        with self._lock:
            return any(time.monotonic() - since < _LONGEST for since in self._waiting.values())

    def _accept(self) -> None:
        with suppress(OSError):  # the socket was closed
            while True:
                connection = self._listening.accept()[0]
                threading.Thread(target=self._serve, args=(connection,), daemon=True).start()

    def _serve(self, connection: socket.socket) -> None:
        topic = ""
        try:
            with connection:
                asked = read_header(connection)
                topic = asked.get("topic", "")
                if topic not in self._rounds:
                    return
                described = _UNTYPED if asked.get("md5sum") == "*" else asked
                answer = {"callerid": "/master", "latching": "0", "message_definition": "string data"}
                answer.update({key: described.get(key, "*") for key in ("type", "md5sum")})
                connection.sendall(header(answer))
                self._send(connection, topic, asked.get("type", ""))
        except (OSError, ValueError, struct.error):
            pass
        finally:
            self._arrived(topic)

    def _send(self, connection: socket.socket, topic: str, kind: str) -> None:
        if topic == CLOCK:
            while True:
                now = time.time()
                _message(connection, struct.pack("<II", int(now), int(now % 1 * 1e9)))
                self._arrived(topic)
                time.sleep(SECONDS_BETWEEN)
        rounds = self._rounds[topic]
        # Who comes late still wants each of its results, but not what others waited for.
        done = 0 if rounds[-1] else len(rounds) - 1
        while True:
            for goal in rounds[done:]:
                done += 1
                if goal:
                    _message(connection, _result(goal))
                    continue
                for number in range(MESSAGES):
                    _message(connection, self._content(topic, kind, number))
                    time.sleep(SECONDS_BETWEEN)
            self._arrived(topic)
            # The connection stays: one that ends is made anew. The node says nothing more on it until it ends.
            while len(rounds) == done:
                if select.select([connection], [], [], _TICK)[0]:
                    return

    def _arrived(self, topic: str) -> None:
        with self._lock:
            self._waiting.pop(topic, None)

    def _content(self, topic: str, kind: str, number: int) -> bytes:
        if topic in self._awaited:
            return _ONE if kind == _YES_OR_NO else _ZEROS
        return _ONE if number % 2 else _ZEROS


def _result(goal: str) -> bytes:
    """Any `...ActionResult`: a header, the status with the goal's id, and a result of zeros."""
    name = goal.encode(errors="replace")
    return bytes(16) + bytes(8) + struct.pack("<I", len(name)) + name + bytes([_SUCCEEDED]) + bytes(4) + _ZEROS


def _message(connection: socket.socket, content: bytes) -> None:
    connection.sendall(struct.pack("<I", len(content)) + content)
