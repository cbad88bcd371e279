"""The master (http://wiki.ros.org/ROS/Master_API) and its parameters."""

from __future__ import annotations

import os
import xmlrpc.client
from typing import Any

from .core import get_node_uri
from .names import get_caller_id, resolve_name


def call(method: str, *arguments: Any) -> Any:
    """Code, message and value of a call, with the node's name before its arguments."""
    with xmlrpc.client.ServerProxy(os.environ.get("ROS_MASTER_URI", ""), allow_none=True) as server:
        return getattr(server, method)(get_caller_id(), *arguments)


def register(role: str, name: str, kind: str = "") -> None:
    """Tell the master of an end; the real rospy has a server for others to connect to, here is none."""
    if role == "Service":
        call("registerService", name, "rosrpc://127.0.0.1:1", get_node_uri())
    else:
        call("register" + role, name, kind, get_node_uri())


def unregister(role: str, name: str) -> None:
    call("unregister" + role, name, "rosrpc://127.0.0.1:1" if role == "Service" else get_node_uri())


class MasterProxy:
    """The master's calls as methods, its parameters as items."""

    def __init__(self, uri: Any = None) -> None:
        self.target = uri

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return lambda *arguments: call(name, *arguments)

    def __getitem__(self, key: str) -> Any:
        code, _, value = call("getParam", resolve_name(key))
        if code != 1:
            raise KeyError(key)
        return value

    def __setitem__(self, key: str, value: Any) -> None:
        call("setParam", resolve_name(key), value)

    def __delitem__(self, key: str) -> None:
        if call("deleteParam", resolve_name(key))[0] == -1:
            raise KeyError(key)

    def __contains__(self, key: str) -> bool:
        return bool(call("hasParam", resolve_name(key))[2])

    def __iter__(self) -> Any:
        return iter(call("getParamNames")[2])

    def search_param(self, key: str) -> Any:
        """The nearest one of that name, from the node's own namespace upwards."""
        code, _, value = call("searchParam", key)
        return value if code == 1 else None
