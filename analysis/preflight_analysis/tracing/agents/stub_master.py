"""A ROS master for one node: registrations are noted, every parameter call is answered from the launch file's values.

The calls and their answers are those of http://wiki.ros.org/ROS/Master_API and ROS/Parameter_Server_API:
`[code, message, value]` with code 1 success, 0 failure, -1 error.
"""

from __future__ import annotations

import os
import socket
import threading
import time
from typing import Any, BinaryIO, Callable, Optional

from . import xml_rpc
from .params import ParamTree

MAX_REQUEST = 16 << 20
"""Bytes of one call; nodes do upload robot descriptions and calibration tables."""
_MAX_HEADER = 65_536

Report = Callable[..., None]


class Master:
    """The calls by name. `report(event, **fields)` hears of each."""

    def __init__(self, uri: str, params: ParamTree, report: Report) -> None:
        self._uri = uri
        self._params = params
        self._report = report
        self._lock = threading.RLock()
        self._topics: dict[str, str] = {}
        self._sides: dict[str, dict[str, dict[str, str]]] = {"publisher": {}, "subscriber": {}, "service": {}}
        self._apis: dict[str, str] = {}
        self._param_subscribers: dict[str, set[str]] = {}
        self._ports: dict[str, int] = {}

    @property
    def uri(self) -> str:
        """Where it is called."""
        return self._uri

    def apis(self, role: str, name: str) -> list[str]:
        """The addresses of those that have this end of a topic."""
        with self._lock:
            return list(self._sides[role].get(name, {}).values())

    def withdrawn(self) -> list[tuple[str, str]]:
        """Role and name of what was registered once and is no more."""
        with self._lock:
            return [(role, name) for role, names in self._sides.items() for name, ends in names.items() if not ends]

    def call(self, method: str, arguments: tuple[Any, ...]) -> list[Any]:
        """Answer one call; what is not in the API is an error answer, as in rosmaster."""
        handler = None if method.startswith("_") else getattr(self, "api_" + method, None)
        if handler is None:
            return [-1, f"unknown method {method}", 0]
        with self._lock:
            try:
                result: list[Any] = handler(*arguments)
                return result
            except (TypeError, KeyError, ValueError, AttributeError) as error:
                return [-1, str(error), 0]

    def add_publisher(self, topic: str, port: int) -> None:
        """Be a publisher of the topic, at this port of the loopback."""
        with self._lock:
            self._ports[topic] = port
            self._topics.setdefault(topic, "*")
            publishers = self._sides["publisher"].setdefault(topic, {})
            publishers[""] = self._uri
            uris = list(publishers.values())
            subscribers = list(self._sides["subscriber"].get(topic, {}).values())
        for subscriber in subscribers:
            _in_background(subscriber, "publisherUpdate", "/master", topic, uris)

    # registrations

    def _register(self, role: str, caller: str, name: str, kind: str, api: str, uri: str) -> None:
        self._sides[role].setdefault(name, {})[caller] = uri
        self._apis[caller] = api
        self._report("m-endpoint", role=role, name=name, type=kind)

    def _unregister(self, role: str, caller: str, name: str) -> list[Any]:
        return [1, "", 1 if self._sides[role].get(name, {}).pop(caller, None) else 0]

    def api_registerPublisher(self, caller: str, topic: str, kind: str, api: str) -> list[Any]:
        if kind != "*" or topic not in self._topics:
            self._topics[topic] = kind
        self._register("publisher", caller, topic, kind, api, api)
        subscribers = list(self._sides["subscriber"].get(topic, {}).values())
        publishers = list(self._sides["publisher"][topic].values())
        for subscriber in subscribers:
            _in_background(subscriber, "publisherUpdate", "/master", topic, publishers)
        return [1, f"Registered [{caller}] as publisher of [{topic}]", subscribers]

    def api_unregisterPublisher(self, caller: str, topic: str, api: str) -> list[Any]:
        return self._unregister("publisher", caller, topic)

    def api_registerSubscriber(self, caller: str, topic: str, kind: str, api: str) -> list[Any]:
        if kind != "*":
            self._topics.setdefault(topic, kind)
        self._register("subscriber", caller, topic, kind, api, api)
        return [1, f"Subscribed to [{topic}]", list(self._sides["publisher"].get(topic, {}).values())]

    def api_unregisterSubscriber(self, caller: str, topic: str, api: str) -> list[Any]:
        return self._unregister("subscriber", caller, topic)

    def api_registerService(self, caller: str, service: str, uri: str, api: str) -> list[Any]:
        self._register("service", caller, service, "", api, uri)
        return [1, f"Registered [{caller}] as provider of [{service}]", 1]

    def api_unregisterService(self, caller: str, service: str, uri: str) -> list[Any]:
        return self._unregister("service", caller, service)

    def api_lookupService(self, caller: str, service: str) -> list[Any]:
        service = self._resolve(caller, service)
        providers = list(self._sides["service"].get(service, {}).values())
        if providers:
            return [1, f"rosrpc URI: [{providers}]"[-1], providers[-1]]
        self._report("m-lookup", name=service)
        return [-1, "no provider", ""]

    def api_requestTopic(self, caller: str, topic: str, protocols: list[Any]) -> list[Any]:
        if topic not in self._ports:
            return [0, f"[{topic}] is not published here", []]
        return [1, "ready", ["TCPROS", "127.0.0.1", self._ports[topic]]]

    # state

    def api_lookupNode(self, caller: str, node: str) -> list[Any]:
        return [1, "node api", self._apis[node]] if node in self._apis else [-1, f"unknown node [{node}]", ""]

    def api_getPublishedTopics(self, caller: str, subgraph: str) -> list[Any]:
        prefix = subgraph if subgraph.endswith("/") or not subgraph else subgraph + "/"
        published = [name for name, ends in self._sides["publisher"].items() if ends]
        return [1, "current topics", [[n, self._topics[n]] for n in published if n.startswith(prefix)]]

    def api_getTopicTypes(self, caller: str) -> list[Any]:
        return [1, "current system state", [[name, kind] for name, kind in self._topics.items()]]

    def api_getSystemState(self, caller: str) -> list[Any]:
        sides = [
            [[name, list(ends)] for name, ends in self._sides[role].items() if ends]
            for role in ("publisher", "subscriber", "service")
        ]
        return [1, "current system state", sides]

    def api_getUri(self, caller: str) -> list[Any]:
        return [1, "", self._uri]

    def api_getPid(self, caller: str) -> list[Any]:
        return [1, "", os.getpid()]

    # parameters

    def _resolve(self, caller: str, key: str) -> str:
        if key.startswith("~"):
            key = f"{caller}/{key[1:]}"
        elif not key.startswith("/"):
            key = caller.rpartition("/")[0] + "/" + key
        return "/" + "/".join(step for step in key.split("/") if step)

    def api_getParam(self, caller: str, key: str) -> list[Any]:
        key = self._resolve(caller, key)
        self._report("m-param", access="get", name=key)
        try:
            return [1, f"Parameter [{key}]", self._params.get(key)]
        except KeyError:
            return [-1, f"Parameter [{key}] is not set", 0]

    def api_hasParam(self, caller: str, key: str) -> list[Any]:
        key = self._resolve(caller, key)
        self._report("m-param", access="has", name=key)
        return [1, key, self._params.has(key)]

    def api_setParam(self, caller: str, key: str, value: Any) -> list[Any]:
        key = self._resolve(caller, key)
        self._report("m-param", access="set", name=key)
        self._params.set(key, value)
        for subscribed, apis in self._param_subscribers.items():
            if (key + "/").startswith(subscribed + "/"):
                for api in apis - {self._apis.get(caller, "")}:
                    _in_background(api, "paramUpdate", "/master", key + "/", value)
        return [1, f"parameter {key} set", 0]

    def api_deleteParam(self, caller: str, key: str) -> list[Any]:
        key = self._resolve(caller, key)
        self._report("m-param", access="delete", name=key)
        try:
            self._params.delete(key)
        except KeyError:
            return [-1, f"parameter [{key}] is not set", 0]
        return [1, f"parameter {key} deleted", 0]

    def api_searchParam(self, caller: str, key: str) -> list[Any]:
        self._report("m-param", access="search", name=key)
        found = self._params.search(caller, key)
        return [1, f"Found [{found}]", found] if found else [-1, f"Cannot find parameter [{key}]", ""]

    def api_subscribeParam(self, caller: str, api: str, key: str) -> list[Any]:
        key = self._resolve(caller, key)
        self._report("m-param", access="get", name=key)
        self._param_subscribers.setdefault(key.rstrip("/"), set()).add(api)
        value = self._params.get(key) if self._params.has(key) else {}
        return [1, f"Subscribed to parameter [{key}]", value]

    def api_unsubscribeParam(self, caller: str, api: str, key: str) -> list[Any]:
        key = self._resolve(caller, key)
        self._param_subscribers.get(key.rstrip("/"), set()).discard(api)
        return [1, f"Unsubscribe to parameter [{key}]", 1]

    def api_getParamNames(self, caller: str) -> list[Any]:
        self._report("m-param", access="list", name="/")
        return [1, "Parameter names", self._params.names()]


def _in_background(api: str, method: str, *arguments: Any) -> None:
    """Call a node's own API without waiting: the node may be the one whose call is being answered."""

    def run() -> None:
        try:
            from xmlrpc.client import ServerProxy  # noqa: PLC0415

            getattr(ServerProxy(api, allow_none=True), method)(*arguments)
        except Exception:
            pass

    threading.Thread(target=run, daemon=True).start()


def _answer(master: Master, body: bytes) -> bytes:
    try:
        method, arguments = xml_rpc.read_call(body)
        answer = xml_rpc.answer(master.call(method, arguments))
    except Exception as error:
        answer = xml_rpc.fault(1, str(error))
    return answer.encode("utf-8", "xmlcharrefreplace")


def _headers(stream: BinaryIO) -> Optional[tuple[int, bool]]:
    """The length of the request's body and whether the connection stays open after it; None at the end of the stream.

    Raises `ValueError` for what is no request to be answered.
    """
    line = stream.readline(_MAX_HEADER)
    if not line:
        return None
    method, _, version = line.decode("latin-1").strip().partition(" ")
    if method != "POST":
        raise ValueError("not a call")
    length, lasting, total = -1, not version.endswith("HTTP/1.0"), 0
    while line not in (b"\r\n", b"\n", b""):
        line = stream.readline(_MAX_HEADER)
        total += len(line)
        if total > _MAX_HEADER:
            raise ValueError("too long a header")
        name, _, value = line.decode("latin-1").partition(":")
        if name.lower() == "content-length":
            length = int(value)
        elif name.lower() == "connection":
            lasting = value.strip().lower() != "close" and (lasting or value.strip().lower() == "keep-alive")
    if not 0 <= length <= MAX_REQUEST:
        raise ValueError("too long a call")
    return length, lasting


def _converse(connection: socket.socket, master: Master) -> None:
    """Answer the calls of one connection, which is kept open as roscpp and rospy expect."""
    try:
        with connection, connection.makefile("rb") as stream:
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            lasting = True
            while lasting:
                headers = _headers(stream)
                if headers is None:
                    return
                length, lasting = headers
                body = _answer(master, stream.read(length))
                head = f"HTTP/1.1 200 OK\r\nContent-Type: text/xml\r\nContent-Length: {len(body)}\r\n"
                head += "\r\n" if lasting else "Connection: close\r\n\r\n"
                connection.sendall(head.encode() + body)
    except (OSError, ValueError):
        pass  # a connection that a node broke off, or on which it says something else, is of no interest


def serve(listening: socket.socket, params: ParamTree, report: Report) -> Master:
    """Answer calls in the background for as long as this process lives."""
    host, port = listening.getsockname()[:2]
    master = Master(f"http://{host}:{port}/", params, report)

    def accept() -> None:
        while True:
            try:
                connection = listening.accept()[0]
            except OSError:
                time.sleep(0.01)  # too many are open, or it was broken off already
                continue
            threading.Thread(target=_converse, args=(connection, master), daemon=True).start()

    threading.Thread(target=accept, daemon=True).start()
    return master
