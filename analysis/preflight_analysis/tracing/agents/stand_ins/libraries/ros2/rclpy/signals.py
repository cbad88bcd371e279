"""Which signals end rclpy."""

import enum
from typing import Any

from .guard_condition import GuardCondition


class SignalHandlerOptions(enum.Enum):
    """A choice of them."""

    NO = 0
    SIGINT = 1
    SIGTERM = 2
    ALL = 3


def install_signal_handlers(options: SignalHandlerOptions = SignalHandlerOptions.ALL) -> None:
    """Signals end the program in any case."""


def uninstall_signal_handlers() -> None:
    """Likewise."""


def get_current_signal_handlers_options() -> SignalHandlerOptions:
    return SignalHandlerOptions.ALL


class SignalHandlerGuardCondition(GuardCondition):
    """Wakes an executor when a signal has come."""

    def __init__(self, context: Any = None) -> None:
        super().__init__(None)
