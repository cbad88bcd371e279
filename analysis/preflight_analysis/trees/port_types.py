"""What the ports of the nodes of Nav2 and of BehaviorTree.CPP take, and which a node cannot do without.

Read of `providedPorts` of the commits that `known_nodes.py` and `ports.py` name, and of what nodes throw where
`getInput` finds nothing; a port of one name has one type in all of them. What a text converts to: `convertFromString`
in src/basic_types.cpp of BehaviorTree/BehaviorTree.CPP, tags 3.8.6, 4.5.2, 4.7.3 and 879522c.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Literal

Kind = Literal["a number", "an integer", "a boolean", "a pose", "poses", "a path", "a route", "tracking feedback"]

_NAMES: Mapping[Kind, str] = {
    "a number": """
        angular_distance_weight backup_dist backup_speed cost_threshold dist_to_travel distance distance_backward
        distance_forward hz length_factor max_duration max_error_heading max_error_left max_error_right
        max_lookahead_distance max_rate max_robot_pose_search_dist max_smoothing_duration max_speed max_staging_time
        max_undocking_time min_battery min_rate min_speed prox_len proximity_threshold radius reset_distance seconds
        speed spin_dist time_allowance tolerance transform_tolerance velocity_threshold wait_duration
    """,
    "an integer": """
        current_child_idx delay_msec duration_stopped failure_count failure_threshold goal_id index max_cost
        max_failures msec num_attempts num_cycles num_goals number_of_retries server_timeout start_id success_count
        success_threshold
    """,
    "a boolean": """
        catch_on_halt check_for_collisions consider_unknown_as_obstacle disable_collision_checks enable is_recovery
        is_voltage navigate_to_staging_pose repeat_last_selection stop_at_first_collision then_skip use_dock_id
        use_footprint use_poses use_start wrap_around
    """,
    "a pose": "current_pose dock_pose goal goal_pose input_goal output_goal pose ref_pose start target_pose",
    "poses": "goals input_goals output_goals",
    "a path": "input_path input_path1 input_path2 output_path path smoothed_path unsmoothed_path",
    "a route": "route",
    "tracking feedback": "tracking_feedback",
}
_KIND_OF: Mapping[str, Kind] = {name: kind for kind, names in _NAMES.items() for name in names.split()}
_OUTPUTS = """
    collision_poses current_edge_id current_pose error_code_id error_msg execution_duration last_node_id
    last_reached_index next_node_id num_retries output_goal output_goals output_path output_waypoint_statuses
    planning_time rerouted selected_controller selected_goal_checker selected_path_handler selected_planner
    selected_progress_checker selected_smoother smoothed_path smoothing_duration success total_elapsed_time
    was_completed
"""
_OUTPUT_NAMES = frozenset(_OUTPUTS.split())
_OUTPUTS_OF: Mapping[str, tuple[str, ...]] = {
    "ComputePathToPose": ("path",),
    "ComputePathThroughPoses": ("path",),
    "ComputeRoute": ("path", "route"),
    "ComputeAndTrackRoute": ("path", "route"),
    "ExtractRouteNodesAsGoals": ("goals",),
    "FollowPath": ("tracking_feedback",),
    "GetPoseFromPath": ("pose",),
}
_BOTH = frozenset({("PersistentSequence", "current_child_idx"), ("SetBlackboard", "output_key")})
_NEEDED = """
    AppendGoalPoseToGoals goal_pose input_goals; ArePosesNear ref_pose target_pose; ComputePathThroughPoses goals
    ComputePathToPose goal; ConcatenatePaths input_path1 input_path2; Delay delay_msec; ExtractRouteNodesAsGoals route
    FollowPath path; GetNextFewGoals input_goals; GetPoseFromPath path; GoalReached goal; IsPathValid path
    IsWithinPathTrackingBounds tracking_feedback; NavigateThroughPoses goals; NavigateToPose goal
    PathExpiringTimer path; PathLongerOnApproach path; PersistentSequence current_child_idx; Precondition if
    RemoveInCollisionGoals input_goals; RemovePassedGoals input_goals; Repeat num_cycles
    RetryUntilSuccesful num_attempts; RetryUntilSuccessful num_attempts; Script code; ScriptCondition code
    SetBlackboard output_key value; Sleep msec; SmoothPath unsmoothed_path; Timeout msec
    TransformAvailable child parent; TruncatePath input_path; TruncatePathLocal input_path; ValidatePath path
"""
_OF_CPP: Mapping[str, Kind] = {
    **dict.fromkeys(("double", "float"), "a number"),
    **dict.fromkeys(("int", "unsigned", "unsigned int", "long", "size_t", "std::size_t"), "an integer"),
    **{
        f"{std}{sign}int{bits}_t": "an integer"
        for std in ("", "std::")
        for sign in ("", "u")
        for bits in (8, 16, 32, 64)
    },
    "bool": "a boolean",
}
_TEXTS: Mapping[Kind, re.Pattern[str]] = {
    "a number": re.compile(r"\s*[+-]?(?:\d|\.\d|inf|nan)", re.IGNORECASE),
    "an integer": re.compile(r"\s*[+-]?\d"),
    "a boolean": re.compile(r"(?:0|1|true|TRUE|True|false|FALSE|False)\Z"),
}
"""How a text begins that is converted; of others there are poses and paths with a `;` in between."""
_OTHER_TEXT = re.compile(r".*;|json:|\Z", re.DOTALL)


def _needed() -> Iterator[tuple[str, tuple[str, ...]]]:
    for each in _NEEDED.replace(";", "\n").strip().splitlines():
        name, *ports = each.split()
        yield name, tuple(ports)


NEEDED: Mapping[str, tuple[str, ...]] = dict(_needed())
"""By node: the ports without which it throws, or has nothing to work on."""


def kind_of(port: str) -> Kind | None:
    """What a port of that name takes, of a node of Nav2 or BehaviorTree.CPP; None for texts and what is not known."""
    return _KIND_OF.get(port)


def kind_of_cpp(type_: str) -> Kind | None:
    """The same of a port that a source declares with that type."""
    return _OF_CPP.get(type_)


def is_output(node: str, port: str) -> bool:
    """Whether the node only writes the port."""
    return (port in _OUTPUT_NAMES or port in _OUTPUTS_OF.get(node, ())) and (node, port) not in _BOTH


def is_text_of(kind: Kind, text: str) -> bool:
    """Whether the library may make it of a text that names no entry of the blackboard."""
    return _TEXTS.get(kind, _OTHER_TEXT).match(text) is not None


def is_object(kind: Kind) -> bool:
    """Whether only the blackboard has it, in general."""
    return kind not in _TEXTS
