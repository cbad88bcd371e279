"""What takes part in the transitions of a node."""

from __future__ import annotations

import enum
import functools
from typing import Any


class TransitionCallbackReturn(enum.Enum):
    """How a transition went."""

    SUCCESS = 97
    FAILURE = 98
    ERROR = 99

    def to_label(self) -> str:
        return "transition_" + self.name.lower()


class ManagedEntity:
    """Does nothing, and that with success."""

    def on_configure(self, state: Any) -> Any:
        return TransitionCallbackReturn.SUCCESS

    def on_cleanup(self, state: Any) -> Any:
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, state: Any) -> Any:
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: Any) -> Any:
        return TransitionCallbackReturn.SUCCESS

    def on_deactivate(self, state: Any) -> Any:
        return TransitionCallbackReturn.SUCCESS

    def on_error(self, state: Any) -> Any:
        return TransitionCallbackReturn.SUCCESS


class SimpleManagedEntity(ManagedEntity):
    """One that is on or off."""

    def __init__(self) -> None:
        self._enabled = False

    def on_activate(self, state: Any) -> Any:
        self._enabled = True
        return TransitionCallbackReturn.SUCCESS

    def on_deactivate(self, state: Any) -> Any:
        self._enabled = False
        return TransitionCallbackReturn.SUCCESS

    @property
    def is_activated(self) -> bool:
        return self._enabled

    @staticmethod
    def when_enabled(wrapped: Any = None, *, when_not_enabled: Any = None) -> Any:
        """A method that does nothing while it is off."""

        def decorated(method: Any) -> Any:
            @functools.wraps(method)
            def when_on(self: Any, *args: Any, **kwargs: Any) -> None:
                if self._enabled:
                    method(self, *args, **kwargs)
                elif when_not_enabled is not None:
                    when_not_enabled()

            return when_on

        return decorated if wrapped is None else decorated(wrapped)
