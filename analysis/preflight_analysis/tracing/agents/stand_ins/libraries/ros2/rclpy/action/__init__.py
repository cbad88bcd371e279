"""Actions (https://docs.ros.org/en/jazzy/Concepts/Basic/About-Actions.html)."""

from .client import ActionClient
from .server import ActionServer, CancelResponse, GoalResponse

__all__ = ["ActionClient", "ActionServer", "CancelResponse", "GoalResponse"]
