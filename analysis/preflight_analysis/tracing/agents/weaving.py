"""Puts our functions around those of a library, in the node's own process."""

from __future__ import annotations

import functools
import inspect
import threading
from typing import Any, Callable

from . import channel


def quiet(report: Callable[..., None]) -> Callable[..., None]:
    """What we do beside the node must not fail it."""

    @functools.wraps(report)
    def safe(*args: Any, **kwargs: Any) -> None:
        try:
            report(*args, **kwargs)
        except Exception as error:
            channel.send("weave-failed", message=repr(error))

    return safe


def wrap(owner: Any, name: str, advice: Callable[[Callable[..., Any]], Callable[..., Any]]) -> None:
    """Put `advice(original)` in the place of a function of a module or class; of what is not there nothing."""
    original = vars(owner).get(name)
    if callable(original):
        setattr(owner, name, functools.wraps(original)(advice(original)))


def bound_arguments(function: Callable[..., Any], args: Any, kwargs: Any) -> dict[str, Any]:
    """The arguments of a call by name, those of `**kwargs` among them."""
    arguments = dict(_signature(function).bind(*args, **kwargs).arguments)
    return {**arguments, **arguments.pop("kwargs", {})}


@functools.lru_cache(maxsize=256)
def _signature(function: Callable[..., Any]) -> inspect.Signature:
    return inspect.signature(function)


def in_main_thread() -> bool:
    """Whether the calling thread is the one that reaches the event loop."""
    return threading.current_thread() is threading.main_thread()
