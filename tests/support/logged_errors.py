"""What is logged as an error: a rule that raises is logged and left out, which is a failure of a test."""

from __future__ import annotations

import logging


class LoggedErrors(logging.Handler):
    """A handler that keeps the messages."""

    def __init__(self) -> None:
        super().__init__(logging.ERROR)
        self.messages: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.messages.append(logging.Formatter().format(record))
