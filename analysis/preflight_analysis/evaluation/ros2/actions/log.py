"""`<log>` and its kin: `Log`, `LogInfo` and the like."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.entity import action_tag
from preflight_analysis.evaluation.ros2.walk import LaunchAction, only_read
from preflight_analysis.launch.schema import Attribute

_MESSAGE = Attribute("message", "The message.", "prose", required=True)
_LEVELS = ("DEBUG", "INFO", "WARNING", "ERROR", "CRITICAL")
_CLASSES = ("LogInfo", "Log", "LogDebug", "LogWarning", "LogError")


def _of_a_level(kind: str, doc: str, offered: int) -> LaunchAction:
    tag = action_tag(doc, _MESSAGE, named_by=("message",))
    return LaunchAction(kind=kind, tag=tag, evaluate=only_read, offered=offered)


ENTITIES = (
    LaunchAction(
        kind="log",
        tag=action_tag(
            "Prints a message.",
            _MESSAGE,
            Attribute("level", "Of a launch newer than 3.8.", "text", _LEVELS),
            named_by=("message",),
        ),
        evaluate=only_read,
        offered=240,
    ),
    _of_a_level("log_debug", "Prints a message for debugging. Of a launch newer than 3.8.", 250),
    _of_a_level("log_info", "Prints a message. Of a launch newer than 3.8.", 260),
    _of_a_level("log_warning", "Prints a warning. Of a launch newer than 3.8.", 270),
    _of_a_level("log_error", "Prints an error. Of a launch newer than 3.8.", 280),
)
