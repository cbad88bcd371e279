"""What a process makes once, whichever threads ask for it."""

from __future__ import annotations

import functools
import threading
from collections.abc import Callable, Hashable
from typing import Generic, ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")


class once_per_process(Generic[P, T]):  # noqa: N801
    """A decorator as `functools.cache`, which lets threads that ask at once make a value twice: a sandbox would be
    tried, our code compiled, a folder taken away again while the other thread uses it. Here one makes it, and the
    others wait. Arguments are hashable and given by their places."""

    def __init__(self, function: Callable[P, T]) -> None:
        functools.update_wrapper(self, function)
        self._function = function
        self._made: dict[Hashable, T] = {}
        self._lock = threading.RLock()

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> T:
        """What the function gives for these arguments; what it raises is not kept."""
        with self._lock:
            if args not in self._made:
                self._made[args] = self._function(*args, **kwargs)
            return self._made[args]

    def cache_clear(self) -> None:
        """Make all of it again when it is asked for."""
        with self._lock:
            self._made.clear()
