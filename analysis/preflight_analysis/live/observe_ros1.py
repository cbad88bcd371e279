"""The running system of a ROS 1 master, by its XML-RPC API (http://wiki.ros.org/ROS/Master_API); no rospy is needed.

The master knows what is registered, not what lives: a node that was killed stays in it. So each node is asked for its
process id by its own API (http://wiki.ros.org/ROS/Slave_API). The types of services are what the servers say to a
probing connection (http://wiki.ros.org/ROS/TCPROS), as `rosservice type` asks them; nobody notices that.
"""

from __future__ import annotations

import contextlib
import http.client
import math
import socket
import struct
import time
import xmlrpc.client
from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from functools import partial
from typing import Any
from urllib.parse import urlsplit
from xml.parsers.expat import ExpatError

from preflight_analysis.live.bounded import BoundedSocket, Transport
from preflight_analysis.live.model import CannotObserveError, LiveEndpoint, LiveNode, Observation, is_builtin
from preflight_analysis.live.names import check_number, with_shown_names
from preflight_analysis.tracing.interface import Role

DEFAULT_MASTER = "http://localhost:11311"
_CALLER = "/ros_preflight_watch"
_TIMEOUT = 3.0
"""Seconds for an answer of the master, of a node or of a service."""
_LOOK_SECONDS = 10.0
"""For all answers of one look: who is not asked by then may live."""
_ALIVE_SECONDS = 2.0
"""How long a node that answered is taken to be alive: to ask all of a large robot at each look costs it too much."""
_WORKERS = 16
_MAX_HEADER = 64 * 1024
_FAILURES = (OSError, http.client.HTTPException, xmlrpc.client.Error, ExpatError, ValueError, TypeError, LookupError,
             AttributeError, RecursionError)  # fmt: skip
"""What asking a server leads to that is not there, or is something else: xmlrpc takes what it gets for right."""


class _RefusedError(Exception):
    """The server understood and says no."""


def _call(until: float, uri: str, method: str, *arguments: object) -> Any:
    """The value that a server of ROS answers with, which is the third of three. `until` is when the look ends."""
    if urlsplit(uri).scheme != "http":
        raise ValueError("no address of ROS")
    transport = Transport(min(until, time.monotonic() + _TIMEOUT))
    with xmlrpc.client.ServerProxy(uri, transport=transport, allow_none=True) as server:
        answer = getattr(server, method)(_CALLER, *arguments)
    if not isinstance(answer, list) or len(answer) != 3:
        raise ValueError("no answer of ROS")
    code, message, value = answer
    if code != 1:
        raise _RefusedError(str(message))
    return value


class Ros1Observer:
    """Observes one master. What does not change while it runs is asked once: the type of a service at its address."""

    def __init__(self, uri: str | None) -> None:
        self.uri = uri or DEFAULT_MASTER
        self._addresses: dict[str, str] = {}
        self._answered: dict[str, float] = {}
        self._service_types: dict[tuple[str, str], str] = {}
        self._pool = ThreadPoolExecutor(_WORKERS, thread_name_prefix="observe")

    @property
    def place(self) -> str:
        """What is observed, for people."""
        return f"the master at {self.uri}"

    def close(self) -> None:
        """Ask nothing more."""
        self._pool.shutdown(wait=False, cancel_futures=True)

    def observe(self, within: float = math.inf) -> Observation:
        """The system as it is now, asked for so many seconds at most. Raises `CannotObserveError`."""
        until = time.monotonic() + min(within, _LOOK_SECONDS)
        try:
            publishers, subscribers, services = (_by_name(pairs) for pairs in _call(until, self.uri, "getSystemState"))
            types = {str(name): str(kind) for name, kind in _call(until, self.uri, "getTopicTypes")}
        except (*_FAILURES, _RefusedError) as error:
            raise CannotObserveError(
                f"{self.place} does not answer: {_reason(error)}", final=_is_no_uri(self.uri)
            ) from None
        names = sorted(
            {node for side in (publishers, subscribers, services) for nodes in side.values() for node in nodes}
        )
        sides = (publishers, subscribers, services)
        check_number(self.place, names, [node for side in sides for nodes in side.values() for node in nodes])
        nodes = dict(zip(names, self._pool.map(partial(self._node, until), names), strict=True))
        alive = [
            name
            for name, of in services.items()
            if any(nodes[n].dead is None for n in of) and not is_builtin(1, "service", name)
        ]
        service_types = dict(zip(alive, self._pool.map(partial(self._service_type, until), alive), strict=True))
        endpoints = [
            *_endpoints("publisher", publishers, types),
            *_endpoints("subscriber", subscribers, types),
            *_endpoints("service", services, service_types),
        ]
        return with_shown_names(Observation(1, nodes, tuple(endpoints), self._run(until)))

    def _run(self, until: float) -> str | None:
        """roslaunch gives each run of a master an id."""
        try:
            return str(_call(until, self.uri, "getParam", "/run_id"))
        except (*_FAILURES, _RefusedError):
            return None

    def _node(self, until: float, name: str) -> LiveNode:
        """A node that refuses the connection has ended. One whose address is not known on this machine may live."""
        reason: str | None = None
        if time.monotonic() - self._answered.get(name, -math.inf) < _ALIVE_SECONDS:
            return LiveNode(name)
        for known in (self._addresses.get(name), None):
            try:
                # A node that was started again has another address.
                address = known or str(_call(until, self.uri, "lookupNode", name))
                if known is None and address == self._addresses.get(name):
                    break
                self._addresses[name] = address
                _call(until, address, "getPid")
                self._answered[name] = time.monotonic()
                return LiveNode(name)
            except socket.gaierror:
                return LiveNode(name)
            except _RefusedError:
                return LiveNode(name)  # it left meanwhile, or answers
            except _FAILURES as error:
                if time.monotonic() >= until:
                    return LiveNode(name)
                reason = _reason(error)
        return LiveNode(name, dead=reason)

    def _service_type(self, until: float, name: str) -> str | None:
        try:
            address = str(_call(until, self.uri, "lookupService", name))
            known = self._service_types.get((name, address))
            if known is not None:
                return known
            found = _probe(min(until, time.monotonic() + _TIMEOUT), address, name)
        except (*_FAILURES, _RefusedError, struct.error):
            return None
        if found is not None:
            self._service_types[name, address] = found
        return found


def _by_name(given: Any) -> dict[str, list[str]]:
    return {str(name): [str(node) for node in nodes] for name, nodes in given}


def _endpoints(role: Role, side: Mapping[str, Iterable[str]], types: Mapping[str, str | None]) -> list[LiveEndpoint]:
    # The master writes `*` where nobody told a type.
    known = {name: kind for name, kind in types.items() if kind not in (None, "", "*")}
    return [LiveEndpoint(role, node, name, known.get(name)) for name, nodes in side.items() for node in nodes]


def _probe(until: float, address: str, service: str) -> str | None:
    """The type that a service tells to who only asks: a header each way, fields with their length before them."""
    parts = urlsplit(address)
    fields = (b"probe=1", b"md5sum=*", b"callerid=" + _CALLER.encode(), b"service=" + service.encode())
    header = b"".join(struct.pack("<I", len(each)) + each for each in fields)
    with closing(BoundedSocket((parts.hostname or "", parts.port or 0), until, _MAX_HEADER)) as connection:
        connection.sendall(struct.pack("<I", len(header)) + header)
        with connection.makefile("rb") as answer:
            (size,) = struct.unpack("<I", answer.read(4))
            data = answer.read(min(size, _MAX_HEADER - 4))
    while len(data) >= 4:
        (size,) = struct.unpack("<I", data[:4])
        name, _, value = data[4 : 4 + size].partition(b"=")
        if name == b"type":
            return value.decode(errors="replace")
        data = data[4 + size :]
    return None


def _is_no_uri(uri: str) -> bool:
    with contextlib.suppress(ValueError):
        parts = urlsplit(uri)
        return parts.scheme != "http" or not parts.hostname
    return True


def _reason(error: Exception) -> str:
    """In a few words, the same whichever way it was met."""
    if isinstance(error, ConnectionRefusedError):
        return "connection refused"
    if isinstance(error, TimeoutError):
        return f"no answer within {_TIMEOUT:.0f} s"
    if isinstance(error, OSError) and error.strerror:
        return error.strerror
    return str(error) or type(error).__name__
