"""What concerns the process."""

from __future__ import annotations

import sys
from typing import Any

from . import arguments
from . import context as contexts


def get_default_context(*, shutting_down: bool = False) -> Any:
    return contexts.default


def remove_ros_args(args: Any = None) -> list[str]:
    """The command line without what stands after `--ros-args`."""
    return arguments.without(sys.argv if args is None else args)


def ok(*, context: Any = None) -> bool:
    return bool((context or contexts.default).ok())


def shutdown(*, context: Any = None) -> None:
    (context or contexts.default).shutdown()


def try_shutdown(*, context: Any = None) -> None:
    (context or contexts.default).try_shutdown()


def get_rmw_implementation_identifier() -> str:
    return "rmw_fastrtps_cpp"


def get_available_rmw_implementations() -> set[str]:
    return {"rmw_fastrtps_cpp"}


def timeout_sec_to_nsec(timeout_sec: Any) -> int:
    """-1 for no end."""
    return -1 if timeout_sec is None or timeout_sec < 0 else int(float(timeout_sec) * 1_000_000_000)
