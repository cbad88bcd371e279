"""What is completed later."""

from __future__ import annotations

from typing import Any


class Future:
    """A result that may come; from others none comes."""

    def __init__(self, *, executor: Any = None) -> None:
        self._done = self._cancelled = False
        self._result: Any = None
        self._exception: Any = None
        self._callbacks: list[Any] = []

    def __await__(self) -> Any:
        while not self._done:
            yield
        return self.result()

    def cancel(self) -> None:
        if not self._done:
            self._cancelled = self._done = True
            self._call()

    def cancelled(self) -> bool:
        return self._cancelled

    def done(self) -> bool:
        return self._done

    def result(self) -> Any:
        if self._exception is not None:
            raise self._exception
        return self._result

    def exception(self) -> Any:
        return self._exception

    def set_result(self, result: Any) -> None:
        self._result, self._done = result, True
        self._call()

    def set_exception(self, exception: Any) -> None:
        self._exception, self._done = exception, True
        self._call()

    def _call(self) -> None:
        waiting, self._callbacks = self._callbacks, []
        for callback in waiting:
            callback(self)

    def add_done_callback(self, callback: Any) -> None:
        if self._done:
            callback(self)
        else:
            self._callbacks.append(callback)

    def remove_done_callback(self, callback: Any) -> bool:
        found = callback in self._callbacks
        self._callbacks = [each for each in self._callbacks if each != callback]
        return found


class Task(Future):
    """Work for an executor, which never comes to it."""

    def __init__(self, handler: Any, args: Any = None, kwargs: Any = None, executor: Any = None) -> None:
        super().__init__()
