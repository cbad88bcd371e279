"""Logs, to standard error."""

from __future__ import annotations

import enum
import pathlib
import sys
from typing import Any


class LoggingSeverity(enum.IntEnum):
    """Levels."""

    UNSET = 0
    DEBUG = 10
    INFO = 20
    WARN = 30
    ERROR = 40
    FATAL = 50


class RcutilsLogger:
    """A logger by name."""

    def __init__(self, name: str = "") -> None:
        self.name = name
        self._level = LoggingSeverity.INFO

    def get_child(self, name: str) -> Any:
        return RcutilsLogger(f"{self.name}.{name}" if self.name else name)

    def set_level(self, level: Any) -> None:
        self._level = LoggingSeverity(level)

    def get_effective_level(self) -> Any:
        return self._level

    def is_enabled_for(self, severity: Any) -> bool:
        return bool(severity >= self._level)

    def log(self, message: Any, severity: Any, **kwargs: Any) -> bool:
        if severity < self._level:
            return False
        sys.stderr.write(f"[{LoggingSeverity(severity).name}] [0.0] [{self.name}]: {message}\n")
        return True

    def debug(self, message: Any, *args: Any, **kwargs: Any) -> bool:
        return self.log(message, LoggingSeverity.DEBUG)

    def info(self, message: Any, *args: Any, **kwargs: Any) -> bool:
        return self.log(message, LoggingSeverity.INFO)

    def warning(self, message: Any, *args: Any, **kwargs: Any) -> bool:
        return self.log(message, LoggingSeverity.WARN)

    warn = warning

    def error(self, message: Any, *args: Any, **kwargs: Any) -> bool:
        return self.log(message, LoggingSeverity.ERROR)

    def fatal(self, message: Any, *args: Any, **kwargs: Any) -> bool:
        return self.log(message, LoggingSeverity.FATAL)


_loggers: dict[str, RcutilsLogger] = {}


def get_logger(name: str) -> RcutilsLogger:
    return _loggers.setdefault(name, RcutilsLogger(name))


def initialize() -> None:
    pass


def shutdown() -> None:
    pass


def clear_config() -> None:
    pass


def set_logger_level(name: str, level: Any, detailed_error: bool = False) -> None:
    get_logger(name).set_level(level)


def get_logger_effective_level(name: str) -> Any:
    return get_logger(name).get_effective_level()


get_logger_level = get_logger_effective_level


def get_logging_severity_from_string(log_severity: str) -> Any:
    return LoggingSeverity[log_severity.upper()]


def get_logging_directory() -> pathlib.Path:
    """As it is where no variable says otherwise."""
    return pathlib.Path.home() / ".ros" / "log"
