"""Somebody at the other end of a node's topics, for what it makes only then.

Nodes that are told of their subscribers (lazy nodelets, image_transport) often subscribe to their own input only once
there is one, and tools for any type of message (topic_tools) advertise with the first message, which has their type. So
once a node spins, its topics of these kinds are connected to, by the protocol of http://wiki.ros.org/ROS/TCPROS. What
it makes after that is marked. A node that is told of nothing of the kind is not probed, and pays nothing.
"""

from __future__ import annotations

import contextlib
import os
import socket
import threading
import time
from typing import TYPE_CHECKING, Any, Callable

from . import xml_rpc
from .tcpros import header, read_header

if TYPE_CHECKING:
    from .stub_master import Master

_CALLER = "/preflight_visitor"
_LIMIT = 4.0
"""Seconds for all probes."""
_QUIET = 0.1
"""Seconds that a node must have nothing to do after a probe."""
_MOST = 200
_TIMEOUT = 3.0
_MAX_ANSWER = 65_536


class TopicProbes:
    """The probes of one run. `publish(topic)` sends messages, `report(event)` hears of the first probe."""

    def __init__(self, master: Master, publish: Callable[[str], None], report: Callable[[str], object]) -> None:
        self._master = master
        self._publish = publish
        self._report = report
        self._probed: dict[tuple[str, str], bool] = {}
        """Role and name of the topics of the node, and whether they were probed."""
        self._began = 0.0
        self._since = 0.0
        self._threads: list[threading.Thread] = []
        self._open: list[socket.socket] = []

    @property
    def made(self) -> bool:
        """Whether there was one."""
        return self._began > 0

    def add(self, role: str, topic: str) -> None:
        """A topic of the node that is to be probed."""
        if len(self._probed) < _MOST:
            self._probed.setdefault((role, topic), False)

    def busy(self, pid: int, active: float, fed: bool) -> bool:
        """Whether the node, last `active` then and perhaps just being `fed`, may still have something to do because of
        a probe. Makes those that are due."""
        due = [end for end, probed in self._probed.items() if not probed]
        if not self._probed or (self.made and time.monotonic() - self._began > _LIMIT):
            return False
        if due:
            if not self.made:
                self._began = time.monotonic()
                self._report("probed")
            self._probed.update(dict.fromkeys(due, True))
            for topic in [topic for role, topic in due if role == "subscriber"]:
                self._publish(topic)
            lazy = [topic for role, topic in due if role == "publisher"]
            self._threads.append(threading.Thread(target=self._subscribe_to, args=(lazy,), daemon=True))
            self._threads[-1].start()
        if due or fed or any(thread.is_alive() for thread in self._threads) or _runs(pid):
            self._since = time.monotonic()
        return time.monotonic() - max(self._since, active) < _QUIET

    def _subscribe_to(self, topics: list[str]) -> None:
        for topic in topics:
            for api in self._master.apis("publisher", topic):
                # It may have been withdrawn, or the node does not speak as it should.
                with contextlib.suppress(Exception):
                    self._subscribe(api, topic)

    def _subscribe(self, api: str, topic: str) -> None:
        code, _, protocol = _call(api, "requestTopic", _CALLER, topic, [["TCPROS"]])
        if code != 1:
            return
        connection = socket.create_connection(("127.0.0.1", int(protocol[2])), _TIMEOUT)
        self._open.append(connection)
        connection.sendall(
            header({"callerid": _CALLER, "topic": topic, "md5sum": "*", "type": "*", "tcp_nodelay": "1"})
        )
        read_header(connection)


def _call(api: str, method: str, *arguments: object) -> list[Any]:
    """Call the API of the node. Only its port counts: there is no other host."""
    port = int(api.rstrip("/").rpartition(":")[2])
    body = xml_rpc.call(method, *arguments).encode()
    with socket.create_connection(("127.0.0.1", port), _TIMEOUT) as connection:
        head = f"POST / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nContent-Type: text/xml\r\nConnection: close\r\n"
        connection.sendall(head.encode() + f"Content-Length: {len(body)}\r\n\r\n".encode() + body)
        with connection.makefile("rb") as stream:
            length = 0
            while (line := stream.readline(_MAX_ANSWER)) not in (b"\r\n", b"\n", b""):
                name, _, value = line.decode("latin-1").partition(":")
                length = int(value) if name.lower() == "content-length" else length
            answered = xml_rpc.read_answer(stream.read(min(length, _MAX_ANSWER)))
    if not isinstance(answered, list) or len(answered) != 3:
        raise ValueError("no answer of the slave API")
    return answered


def _runs(pid: int) -> bool:
    """Whether any thread of the process has something to do just now."""
    try:
        for thread in os.listdir(f"/proc/{pid}/task"):
            with open(f"/proc/{pid}/task/{thread}/stat") as stat:
                if stat.read().rpartition(")")[2].split()[0] in ("R", "D"):
                    return True
    except (OSError, IndexError):
        pass
    return False
