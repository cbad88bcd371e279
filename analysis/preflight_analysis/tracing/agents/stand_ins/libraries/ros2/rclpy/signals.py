"""Which signals end rclpy."""

import enum


class SignalHandlerOptions(enum.Enum):
    """A choice of them."""

    NO = 0
    SIGINT = 1
    SIGTERM = 2
    ALL = 3
