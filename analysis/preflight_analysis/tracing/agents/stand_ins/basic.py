"""Definitions that the stand-ins of the client libraries cannot do without, by full name.

Fields, types and values of http://docs.ros.org/en/noetic/api/std_msgs/html/index-msg.html, of
http://docs.ros.org/en/noetic/api/actionlib_msgs/html/index-msg.html and of
https://docs.ros.org/en/jazzy/p/rcl_interfaces/interfaces/message_definitions.html.
"""

from __future__ import annotations

_HEADER = {
    "1": "uint32 seq\ntime stamp\nstring frame_id",
    "2": "builtin_interfaces/Time stamp\nstring frame_id",
}
_STATUS = (
    "uint8 PENDING=0\nuint8 ACTIVE=1\nuint8 PREEMPTED=2\nuint8 SUCCEEDED=3\nuint8 ABORTED=4\nuint8 REJECTED=5\n"
    "uint8 PREEMPTING=6\nuint8 RECALLING=7\nuint8 RECALLED=8\nuint8 LOST=9\n"
    "GoalID goal_id\nuint8 status\nstring text"
)
_STATUS_ROS2 = (
    "int8 STATUS_UNKNOWN=0\nint8 STATUS_ACCEPTED=1\nint8 STATUS_EXECUTING=2\nint8 STATUS_CANCELING=3\n"
    "int8 STATUS_SUCCEEDED=4\nint8 STATUS_CANCELED=5\nint8 STATUS_ABORTED=6\nGoalInfo goal_info\nint8 status"
)
_KINDS = ("NOT_SET", "BOOL", "INTEGER", "DOUBLE", "STRING", "BYTE_ARRAY", "BOOL_ARRAY", "INTEGER_ARRAY",
          "DOUBLE_ARRAY", "STRING_ARRAY")  # fmt: skip
_VALUE = (
    "uint8 type\nbool bool_value\nint64 integer_value\nfloat64 double_value\nstring string_value\n"
    "byte[] byte_array_value\nbool[] bool_array_value\nint64[] integer_array_value\nfloat64[] double_array_value\n"
    "string[] string_array_value"
)
_DESCRIPTOR = (
    "string name\nuint8 type\nstring description\nstring additional_constraints\nbool read_only false\n"
    "bool dynamic_typing false\nFloatingPointRange[<=1] floating_point_range\nIntegerRange[<=1] integer_range"
)
DEFINITIONS: dict[str, object] = {
    "std_msgs/msg/Header": _HEADER,
    "actionlib_msgs/msg/GoalID": "time stamp\nstring id",
    "actionlib_msgs/msg/GoalStatus": _STATUS,
    "actionlib_msgs/msg/GoalStatusArray": "Header header\nGoalStatus[] status_list",
    "action_msgs/msg/GoalStatus": _STATUS_ROS2,
    "action_msgs/msg/GoalInfo": "unique_identifier_msgs/UUID goal_id\nbuiltin_interfaces/Time stamp",
    "unique_identifier_msgs/msg/UUID": "uint8[16] uuid",
    "builtin_interfaces/msg/Time": "int32 sec\nuint32 nanosec",
    "builtin_interfaces/msg/Duration": "int32 sec\nuint32 nanosec",
    "rcl_interfaces/msg/ParameterType": "\n".join(f"uint8 PARAMETER_{name}={at}" for at, name in enumerate(_KINDS)),
    "rcl_interfaces/msg/ParameterValue": _VALUE,
    "rcl_interfaces/msg/Parameter": "string name\nParameterValue value",
    "rcl_interfaces/msg/ParameterDescriptor": _DESCRIPTOR,
    "rcl_interfaces/msg/FloatingPointRange": "float64 from_value\nfloat64 to_value\nfloat64 step",
    "rcl_interfaces/msg/IntegerRange": "int64 from_value\nint64 to_value\nuint64 step",
    "rcl_interfaces/msg/SetParametersResult": "bool successful\nstring reason",
    "lifecycle_msgs/msg/State": "uint8 PRIMARY_STATE_UNKNOWN=0\nuint8 PRIMARY_STATE_UNCONFIGURED=1\n"
    "uint8 PRIMARY_STATE_INACTIVE=2\nuint8 PRIMARY_STATE_ACTIVE=3\nuint8 PRIMARY_STATE_FINALIZED=4\n"
    "uint8 id\nstring label",
}
