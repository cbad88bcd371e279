"""Conditions that wake an executor."""

from __future__ import annotations

from typing import Any


class GuardCondition:
    """One of them."""

    def __init__(self, callback: Any) -> None:
        self.callback = callback

    def trigger(self) -> None:
        pass

    def destroy(self) -> None:
        pass
