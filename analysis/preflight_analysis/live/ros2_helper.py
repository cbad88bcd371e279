"""Shows the graph of a ROS 2 domain, for `observe_ros2.py`, which starts this with the user's interpreter.

Standard library and rclpy only, from Python 3.8 on. A line of JSON each time the graph is not what it was:
`{"nodes": [name, ...], "endpoints": [[role, node, name, type, qos], ...], "lifecycle": {name: state}}`, or `{"error":
sentence}` as the last one. It ends with its standard input, so that none is left behind.
"""

from __future__ import annotations

import contextlib
import importlib
import json
import os
import sys
import threading
import time
from typing import Any

POLL_SECONDS = 0.3
WHOLE_SECONDS = 3.0
"""The names are asked for at each poll, and all that hangs on them when they changed, or after this time: of 150 nodes
that takes a tenth of a second of processor time."""
ANSWER_SECONDS = 1.0
"""How long lifecycle nodes have to tell their state."""
_GET_STATE = "lifecycle_msgs/srv/GetState"
_PART_OF_ACTION = "/_action/"
_NOBODY = ("_NODE_NAME_UNKNOWN_", "_CREATED_BY_BARE_DDS_APP_")
_SETTLED = {
    "reliability": ("reliable", "best_effort"),
    "durability": ("volatile", "transient_local"),
}


def _say(data: dict[str, Any]) -> None:
    sys.stdout.write(json.dumps(data) + "\n")
    sys.stdout.flush()


def _full(name: str, namespace: str) -> str:
    return namespace.rstrip("/") + "/" + name


def _qos(profile: Any) -> dict[str, str]:
    found = {}
    for policy, allowed in _SETTLED.items():
        word = str(getattr(getattr(profile, policy, None), "name", "")).lower()
        if word in allowed:
            found[policy] = word
    return found


def _graph(node: Any, action: Any) -> dict[str, Any]:
    """The graph without what this process adds to it."""
    own = (node.get_name(), node.get_namespace())
    pairs: list[tuple[str, str]] = [tuple(pair)[:2] for pair in node.get_node_names_and_namespaces()]
    pairs = [pair for pair in pairs if pair != own and pair[0] not in _NOBODY]
    endpoints: list[list[Any]] = []

    for topic, _ in node.get_topic_names_and_types():
        for role, ask_topic in (
            ("publisher", node.get_publishers_info_by_topic),
            ("subscriber", node.get_subscriptions_info_by_topic),
        ):
            for info in ask_topic(topic):
                if info.node_name not in _NOBODY and (info.node_name, info.node_namespace) != own:
                    owner = _full(info.node_name, info.node_namespace)
                    endpoints.append([role, owner, topic, info.topic_type, _qos(info.qos_profile)])
    for pair in sorted(set(pairs)):
        for role, ask in (
            ("service", node.get_service_names_and_types_by_node),
            ("client", node.get_client_names_and_types_by_node),
            ("action_server", lambda *of: action.get_action_server_names_and_types_by_node(node, *of)),
            ("action_client", lambda *of: action.get_action_client_names_and_types_by_node(node, *of)),
        ):
            with contextlib.suppress(Exception):  # it left meanwhile: a class of its own in each distribution
                found = ask(*pair)
                endpoints.extend([role, _full(*pair), name, kind, {}] for name, kinds in found for kind in kinds)
    unique = {json.dumps(end, sort_keys=True): end for end in endpoints if _PART_OF_ACTION not in end[2]}
    return {"nodes": sorted(_full(*pair) for pair in pairs), "endpoints": [unique[key] for key in sorted(unique)]}


class _Lifecycle:
    """Asks lifecycle nodes for their state, which nothing tells of itself."""

    def __init__(self, rclpy: Any, node: Any) -> None:
        self._rclpy, self._node = rclpy, node
        self._clients: dict[str, Any] = {}

    def states(self, endpoints: list[list[Any]]) -> dict[str, str]:
        """The state of each node that has one and answers; `endpoints` as they are told."""
        owners = {
            owner
            for role, owner, name, kind, _ in endpoints
            if role == "service" and kind == _GET_STATE and name == owner + "/get_state"
        }
        for owner in set(self._clients) - owners:
            self._node.destroy_client(self._clients.pop(owner))
        if not owners:
            return {}
        try:
            kind = importlib.import_module("lifecycle_msgs.srv").GetState
        except ImportError:
            return {}
        for owner in owners - set(self._clients):
            self._clients[owner] = self._node.create_client(kind, owner + "/get_state")
        asked = {o: c.call_async(kind.Request()) for o, c in self._clients.items() if c.service_is_ready()}
        end = time.monotonic() + ANSWER_SECONDS
        while time.monotonic() < end and not all(future.done() for future in asked.values()):
            self._rclpy.spin_once(self._node, timeout_sec=0.05)
        for owner, future in asked.items():
            if not future.done():
                self._clients[owner].remove_pending_request(future)
        done = {owner: future.result() for owner, future in asked.items() if future.done()}
        return {owner: str(answer.current_state.label) for owner, answer in done.items() if answer is not None}


def _end_with_input() -> None:
    sys.stdin.read()
    os._exit(0)


def main() -> None:
    """Show the graph until standard input ends. The arguments are folders to import from."""
    sys.path[:0] = sys.argv[1:]
    threading.Thread(target=_end_with_input, daemon=True).start()
    try:
        rclpy = importlib.import_module("rclpy")
        action = importlib.import_module("rclpy.action")
        rclpy.init(args=[])
        node = rclpy.create_node(
            "_ros_preflight_watch_%d" % os.getpid(),
            enable_rosout=False,
            start_parameter_services=False,
            use_global_arguments=False,
        )
        lifecycle = _Lifecycle(rclpy, node)
        last = names = None
        whole = 0.0
        while True:
            now_names = (
                sorted(node.get_node_names_and_namespaces()),
                sorted(node.get_topic_names_and_types()),
                sorted(node.get_service_names_and_types()),
            )
            if now_names != names or time.monotonic() - whole > WHOLE_SECONDS:
                names, whole = now_names, time.monotonic()
                now = _graph(node, action)
                now["lifecycle"] = lifecycle.states(now["endpoints"])
                if now != last:
                    _say(now)
                    last = now
            time.sleep(POLL_SECONDS)
    except Exception as error:
        _say({"error": " ".join(("%s: %s" % (type(error).__name__, error)).split())})
        os._exit(1)


if __name__ == "__main__":
    main()
