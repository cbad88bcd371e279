"""Actions of ROS 1 (http://wiki.ros.org/actionlib/DetailedDescription): five topics, on which nobody answers."""

from .action_client import ActionClient, ClientGoalHandle, CommState, TerminalState
from .action_server import ActionServer
from .simple_action_client import SimpleActionClient, SimpleGoalState
from .simple_action_server import SimpleActionServer

GoalStatus = __import__("actionlib_msgs.msg", fromlist=["GoalStatus"]).GoalStatus

__all__ = [
    "ActionClient",
    "ActionServer",
    "ClientGoalHandle",
    "CommState",
    "GoalStatus",
    "SimpleActionClient",
    "SimpleActionServer",
    "SimpleGoalState",
    "TerminalState",
]
