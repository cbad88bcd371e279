"""The state between `init` and `shutdown`."""

from __future__ import annotations

import sys
from typing import Any


class Context:
    """One such state."""

    def __init__(self) -> None:
        self._up = False
        self._callbacks: list[Any] = []
        self.args: list[str] = []
        self.handle = self

    def init(self, args: Any = None, *, initialize_logging: bool = True, domain_id: Any = None) -> None:
        if self._up:
            raise RuntimeError("Context.init() must only be called once")
        self.args = [str(word) for word in (sys.argv if args is None else args)]
        self._up = True

    def ok(self) -> bool:
        return self._up

    def shutdown(self) -> None:
        if not self._up:
            raise RuntimeError("Context must be initialized before it can be shutdown")
        self.try_shutdown()

    def try_shutdown(self) -> None:
        if self._up:
            self._up = False
            for callback in self._callbacks:
                callback()

    def on_shutdown(self, callback: Any) -> None:
        self._callbacks.append(callback)

    def get_domain_id(self) -> int:
        return 0

    def __enter__(self) -> Any:
        if not self._up:
            self.init()
        return self

    def __exit__(self, *exception: Any) -> None:
        self.try_shutdown()


default = Context()
