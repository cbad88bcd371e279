"""Which callbacks may run at once: none run here."""

from __future__ import annotations

from typing import Any


class CallbackGroup:
    """Any group."""

    def add_entity(self, entity: Any) -> None:
        pass

    def has_entity(self, entity: Any) -> bool:
        return True

    def can_execute(self, entity: Any) -> bool:
        return True


class ReentrantCallbackGroup(CallbackGroup):
    """All at once."""


class MutuallyExclusiveCallbackGroup(CallbackGroup):
    """One at a time."""
