"""What a part of a launch asks of what is before and around it: where the answers are the same, so is the part."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any

Question = tuple[Hashable, ...]
"""What is asked, and of what: `("configuration", "rate")`."""


class Before:
    """What a part of a launch asks of the launch before it, and the answers."""

    def __init__(self, look: Callable[[Question], object]) -> None:
        self._look = look
        self.answers: dict[Question, object] = {}

    def ask(self, *question: Hashable) -> Any:
        """What is answered."""
        if question not in self.answers:
            self.answers[question] = self._look(question)
        return self.answers[question]
