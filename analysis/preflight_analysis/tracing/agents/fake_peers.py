"""Waits for action servers and transforms, in the libraries above rospy.

An action's result goes the library's own way, so that its states and callbacks follow. Of transforms the identity is
given. `tf` asks `tf2_ros` for them.
"""

from __future__ import annotations

import importlib
import threading
from types import ModuleType
from typing import Any, Callable

import aspectlib  # type: ignore[import-untyped]

from . import channel, mock_replies, polling
from .rospy_aspects import caller
from .weaving import in_main_thread

Advised = Callable[..., Any]

_SUCCEEDED = 3
_looking_up = threading.local()
"""`lookup_transform` asks `can_transform` first; that is no question of the node's own."""
_given: set[tuple[str, str]] = set()
_asked: set[tuple[Any, ...]] = set()


def weave(module: ModuleType) -> None:
    """Weave one of the modules that `hooks` watches for, freshly imported. rospy was before."""
    library: Any = module
    if module.__name__ == "actionlib.action_client":
        aspectlib.weave(library.ActionClient, _server, methods=["wait_for_server"], subclasses=False)
    elif module.__name__ == "actionlib.simple_action_client":
        aspectlib.weave(library.SimpleActionClient, _result, methods=["wait_for_result"], subclasses=False)
    else:
        aspectlib.weave(library.Buffer, _can_transform, methods=["can_transform"], subclasses=False)
        aspectlib.weave(library.Buffer, _lookup(library), methods=["lookup_transform"], subclasses=False)


class _Waiting:
    """While the node is in a wait, nothing else is made of its sleep."""

    def __init__(self, kind: str, name: str) -> None:
        self._event = {"kind": kind, "name": name, "main": in_main_thread()}

    def _report(self, state: str, change: int) -> None:
        channel.send("state", state=state, **self._event)
        if self._event["main"]:
            polling.watch().waits(change)

    def __enter__(self) -> None:
        self._report("wait", 1)

    def __exit__(self, *_: object) -> None:
        self._report("resume", -1)


def _shorter(given: Any) -> Any:
    """The duration that a wait gets: zero and None have no end."""
    grace = polling.watch().rospy.Duration.from_sec(mock_replies.grace())
    return grace if not given or given.to_sec() <= 0 or given > grace else given


def _server(cutpoint: Advised) -> Advised:
    def advised(self: Any, timeout: Any = None) -> Any:
        with _Waiting("action", str(self.ns)):
            # Without time there is no end to it.
            if not polling.watch().without_time() and cutpoint(self, _shorter(timeout)):
                return True
            mock_replies.made_up("action", str(self.ns))
            return True

    return advised


def _result(cutpoint: Advised) -> Advised:
    def advised(self: Any, timeout: Any = None) -> Any:
        if not self.gh:
            return cutpoint(self)
        client = self.action_client
        with _Waiting("result", str(client.ns)):
            if not polling.watch().without_time() and cutpoint(self, _shorter(timeout)):
                return True
            mock_replies.made_up("result", str(client.ns))
            message = mock_replies.empty(client.ActionResult)
            message.result = mock_replies.empty(type(message.result))
            message.status.goal_id = self.gh.comm_state_machine.action_goal.goal_id
            message.status.status = _SUCCEEDED
            client._result_cb(message)
            return True

    return advised


def _frames(target: Any, source: Any) -> tuple[str, str]:
    return str(target), str(source)


def _polled(target: Any, source: Any) -> bool:
    """Whether a transform that is not there is to be taken as there: it was before, or the node asks for it again from
    the same place."""
    frames = _frames(target, source)
    if frames in _given:
        return True
    site = (*frames, *caller())
    if site not in _asked:
        _asked.add(site)
        return False
    _give("transforms", frames)
    return True


def _give(kind: str, frames: tuple[str, str]) -> None:
    _given.add(frames)
    mock_replies.made_up(kind, f"{frames[0]} <- {frames[1]}")


def _can_transform(cutpoint: Advised) -> Advised:
    def advised(
        self: Any, target: Any, source: Any, time: Any, timeout: Any = None, return_debug_tuple: bool = False
    ) -> Any:
        yes = (True, "") if return_debug_tuple else True
        if not timeout or timeout.to_sec() <= 0:
            result = cutpoint(self, target, source, time, return_debug_tuple=return_debug_tuple)
            there = result[0] if return_debug_tuple else result
            if there or getattr(_looking_up, "inside", False):
                return result
            return yes if _polled(target, source) else result
        frames = _frames(target, source)
        with _Waiting("transform", f"{frames[0]} <- {frames[1]}"):
            if not polling.watch().without_time() and cutpoint(self, target, source, time, _shorter(timeout)):
                return yes
            _give("transform", frames)
            return yes

    return _named(advised, target="target_frame", source="source_frame")


def _lookup(library: Any) -> Callable[[Advised], Advised]:
    def aspect(cutpoint: Advised) -> Advised:
        def advised(self: Any, target: Any, source: Any, time: Any, *args: Any, **kwargs: Any) -> Any:
            _looking_up.inside = True
            try:
                return cutpoint(self, target, source, time, *args, **kwargs)
            except library.tf2.TransformException:
                if not _polled(target, source):
                    raise
                made = importlib.import_module("geometry_msgs.msg").TransformStamped()
                made.header.stamp, made.header.frame_id, made.child_frame_id = time, str(target), str(source)
                made.transform.rotation.w = 1.0
                return made
            finally:
                _looking_up.inside = False

        return _named(advised, target="target_frame", source="source_frame")

    return aspect


def _named(advised: Advised, **names: str) -> Advised:
    """Take arguments by the names that the library has for them, too."""

    def renamed(*args: Any, **kwargs: Any) -> Any:
        return advised(*args, **{next((k for k, n in names.items() if n == key), key): v for key, v in kwargs.items()})

    return renamed
