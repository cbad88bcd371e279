"""Event loops, in which nothing happens."""

from __future__ import annotations

import inspect
import time
from typing import Any

from . import context as contexts
from .task import Future, Task


class TimeoutException(Exception):
    """The time is over."""


class ShutdownException(Exception):
    """The executor is shut down."""


class ExternalShutdownException(Exception):
    """rclpy is shut down."""


class ConditionReachedException(Exception):
    """What was waited for is there."""


class Executor:
    """Any event loop."""

    def __init__(self, *, context: Any = None) -> None:
        self.context = context or contexts.default
        self._nodes: list[Any] = []
        self._shut = False

    def create_task(self, callback: Any, *args: Any, **kwargs: Any) -> Task:
        return Task(callback)

    def create_future(self) -> Future:
        return Future()

    def shutdown(self, timeout_sec: Any = None) -> bool:
        self._shut = True
        return True

    def add_node(self, node: Any) -> bool:
        if node in self._nodes:
            return False
        self._nodes.append(node)
        node.executor = self
        return True

    def remove_node(self, node: Any) -> None:
        if node in self._nodes:
            self._nodes.remove(node)

    def wake(self) -> None:
        pass

    def get_nodes(self) -> list[Any]:
        return list(self._nodes)

    def spin(self) -> None:
        while self.context.ok() and not self._shut:
            self._wait(None)

    def spin_until_future_complete(self, future: Any, timeout_sec: Any = None) -> None:
        end = None if timeout_sec is None else time.monotonic() + timeout_sec
        while self.context.ok() and not future.done() and (end is None or time.monotonic() < end):
            time.sleep(0.02)

    def spin_once(self, timeout_sec: Any = None) -> None:
        self._wait(timeout_sec)

    def spin_once_until_future_complete(self, future: Any, timeout_sec: Any = None) -> None:
        self._wait(timeout_sec)

    def _wait(self, timeout_sec: Any) -> None:
        if not self.context.ok():
            raise ExternalShutdownException()
        time.sleep(0.5 if timeout_sec is None or timeout_sec < 0 else float(timeout_sec))

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *exception: Any) -> None:
        self.shutdown()


class SingleThreadedExecutor(Executor):
    """In one thread."""

    def spin_once(self, timeout_sec: Any = None) -> None:
        self._wait(timeout_sec)


class MultiThreadedExecutor(Executor):
    """In several threads."""

    def __init__(self, num_threads: Any = None, *, context: Any = None) -> None:
        super().__init__(context=context)

    def spin_once(self, timeout_sec: Any = None) -> None:
        self._wait(timeout_sec)


async def await_or_execute(callback: Any, *args: Any) -> Any:
    """What a callback gives, be it a coroutine or not."""
    found = callback(*args)
    return await found if inspect.iscoroutine(found) else found


class TimeoutObject:
    """A time that something may take."""

    def __init__(self, timeout: float) -> None:
        self.timeout = timeout
