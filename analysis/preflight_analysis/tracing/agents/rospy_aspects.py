"""Aspects around the functions of rospy, and who calls those."""

from __future__ import annotations

import inspect
import sys
from types import FrameType
from typing import Any, Callable, Optional

from .weaving import quiet

Advised = Callable[..., Any]
_LIBRARIES = frozenset(
    (
        "rospy",
        "aspectlib",
        "preflight_agents",
        "functools",
        "message_filters",
        "actionlib",
        "tf",
        "tf2_ros",
        "dynamic_reconfigure",
        "ddynamic_reconfigure_python",
        "image_transport",
        "rosparam",
        "diagnostic_updater",
    )
)
"""Frames in these are not the node's own."""


def _top(frame: FrameType) -> str:
    return str(frame.f_globals.get("__name__", "")).partition(".")[0]


def caller() -> tuple[Optional[str], Optional[int], bool]:
    """File and line of the node's own call, and whether rospy itself made the call."""
    frame: Optional[FrameType] = sys._getframe(1)
    while frame is not None and _top(frame) in ("preflight_agents", "aspectlib", "functools"):
        frame = frame.f_back
    internal = frame is not None and _top(frame) == "rospy"
    while frame is not None and _top(frame) in _LIBRARIES:
        frame = frame.f_back
    if frame is None:
        return None, None, internal
    return frame.f_code.co_filename, frame.f_lineno, internal


def before(report: Callable[..., None]) -> Callable[[Advised], Advised]:
    """Aspect: `report(bound arguments)` before the call."""
    report = quiet(report)

    def aspect(cutpoint: Advised) -> Advised:
        signature = inspect.signature(cutpoint)

        def advised(*args: Any, **kwargs: Any) -> Any:
            try:
                arguments = signature.bind(*args, **kwargs).arguments
            except TypeError:
                return cutpoint(*args, **kwargs)
            report(arguments)
            return cutpoint(*args, **kwargs)

        return advised

    return aspect


def after(report: Callable[..., None]) -> Callable[[Advised], Advised]:
    """Aspect: `report(bound arguments)` after the call returned."""
    report = quiet(report)

    def aspect(cutpoint: Advised) -> Advised:
        signature = inspect.signature(cutpoint)

        def advised(*args: Any, **kwargs: Any) -> Any:
            result = cutpoint(*args, **kwargs)
            report(signature.bind(*args, **kwargs).arguments)
            return result

        return advised

    return aspect
