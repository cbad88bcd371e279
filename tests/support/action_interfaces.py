"""The endpoints of a node with an action of ROS 1, as a fixture of `support.check` has them under `//- interfaces`."""

_COMMON = '"{0}/cancel": "actionlib_msgs/GoalID", "{0}/goal": "{1}Goal"'
_BACK = '"{0}/status": "actionlib_msgs/GoalStatusArray", "{0}/feedback": "{1}Feedback", "{0}/result": "{1}Result"'


def client(name: str, type_: str) -> str:
    """Those of a node that sends goals."""
    return f'{{"publishers": {{{_COMMON.format(name, type_)}}}, "subscribers": {{{_BACK.format(name, type_)}}}}}'


def server(name: str, type_: str) -> str:
    """Those of a node that takes goals."""
    return f'{{"publishers": {{{_BACK.format(name, type_)}}}, "subscribers": {{{_COMMON.format(name, type_)}}}}}'
