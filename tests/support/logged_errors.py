"""What is logged as an error: something of ours failed and costs a part of the result, which is a failure of a test."""

from __future__ import annotations

import logging


class LoggedErrors(logging.Handler):
    """A handler that keeps the messages."""

    def __init__(self) -> None:
        super().__init__(logging.ERROR)
        self.messages: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.messages.append(logging.Formatter().format(record))
