"""The ports of the nodes of Nav2 and of BehaviorTree.CPP, by distribution.

Read of `providedPorts` in the headers and sources of the commits that `known_nodes.py` names; of BehaviorTree.CPP 3.8.6
and 9d624dc, and 4.5.2, 4.7.3 and 879522c. An attribute that is no port has the library refuse the tree:
`createNodeFromXML` in src/xml_parsing.cpp.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from preflight_analysis.trees.known_nodes import is_version_3

_LETTERS = {"h": "humble", "j": "jazzy", "k": "kilted", "l": "lyrical"}
_NAV = """
    AppendGoalPoseToGoals goal_pose input_goals output_goals
    AreErrorCodesPresent error_code error_codes_to_check
    ArePosesNear global_frame ref_pose target_pose tolerance
    AssistedTeleop error_code_id:jkl error_msg:kl is_recovery server_name server_timeout time_allowance
    BackUp backup_dist backup_speed disable_collision_checks:kl error_code_id:jkl error_msg:kl server_name
        server_timeout time_allowance
    CancelAssistedTeleop server_name server_timeout
    CancelBackUp server_name server_timeout
    CancelComputeAndTrackRoute server_name server_timeout
    CancelControl server_name server_timeout
    CancelDriveOnHeading server_name server_timeout
    CancelFollowObject server_name server_timeout
    CancelSpin server_name server_timeout
    CancelWait server_name server_timeout
    CheckPoseOccupancy consider_unknown_as_obstacle cost_threshold pose server_timeout service_name use_footprint
    CheckStopStatus duration_stopped velocity_threshold
    ClearCostmapAroundPose plugins:l pose reset_distance server_timeout service_name
    ClearCostmapAroundRobot plugins:l reset_distance server_timeout service_name
    ClearCostmapExceptRegion plugins:l reset_distance server_timeout service_name
    ClearEntireCostmap plugins:l server_timeout service_name
    ComputeAndTrackRoute current_edge_id error_code_id:jkl error_msg:kl execution_duration goal goal_id last_node_id
        next_node_id path rerouted route server_name server_timeout start start_id use_poses use_start
    ComputePathThroughPoses error_code_id:jkl error_msg:kl goals last_reached_index:l path planner_id server_name
        server_timeout start
    ComputePathToPose error_code_id:jkl error_msg:kl goal path planner_id server_name server_timeout start
        use_start:jkl viapoints:l
    ComputeRoute error_code_id:jkl error_msg:kl goal goal_id path planning_time route server_name server_timeout start
        start_id use_poses use_start
    ConcatenatePaths input_path1 input_path2 output_path
    ControllerSelector default_controller selected_controller topic_name
    DistanceController distance global_frame robot_base_frame
    DistanceTraveled distance global_frame robot_base_frame
    DockRobot dock_id dock_pose dock_type error_code_id error_msg:kl max_staging_time navigate_to_staging_pose
        num_retries server_name server_timeout success use_dock_id
    DriveOnHeading disable_collision_checks:kl dist_to_travel error_code_id:jkl error_msg:kl server_name
        server_timeout speed time_allowance
    ExtractRouteNodesAsGoals goals route
    FollowObject error_code_id error_msg max_duration pose_topic server_name server_timeout total_elapsed_time
        tracked_frame
    FollowPath controller_id error_code_id:jkl error_msg:kl goal_checker_id path path_handler_id:l
        progress_checker_id:jkl server_name server_timeout tracking_feedback:l
    GetCurrentPose current_pose global_frame robot_base_frame
    GetNextFewGoals input_goals num_goals output_goals
    GetPoseFromPath index path pose
    GlobalUpdatedGoal goal:jkl goals:jkl
    GoalCheckerSelector default_goal_checker selected_goal_checker topic_name
    GoalReached global_frame:hj goal robot_base_frame
    GoalUpdated goal:jkl goals:jkl
    GoalUpdatedController goal:jkl goals:jkl
    GoalUpdater input_goal input_goals:kl output_goal output_goals:kl
    InitialPoseReceived initial_pose_received
    IsBatteryCharging battery_topic
    IsBatteryLow battery_topic is_voltage min_battery
    IsGoalNearby global_frame max_robot_pose_search_dist path proximity_threshold robot_base_frame
    IsPathValid consider_unknown_as_obstacle:k max_cost:k path server_timeout
    IsStopped duration_stopped velocity_threshold
    IsStuck
    IsWithinPathTrackingBounds max_error_heading max_error_left max_error_right tracking_feedback
    NavigateThroughPoses behavior_tree error_code_id:jkl error_msg:kl goals server_name server_timeout
    NavigateToPose behavior_tree error_code_id:jkl error_msg:kl goal server_name server_timeout
    NonblockingSequence
    PathExpiringTimer path seconds
    PathHandlerSelector default_path_handler selected_path_handler topic_name
    PathLongerOnApproach length_factor path prox_len
    PauseResumeController pause_service_name resume_service_name
    PersistentSequence current_child_idx
    PipelineSequence
    PlannerSelector default_planner selected_planner topic_name
    ProgressCheckerSelector default_progress_checker selected_progress_checker topic_name
    RateController hz
    RecoveryNode number_of_retries
    ReinitializeGlobalLocalization server_timeout service_name
    RemoveInCollisionGoals consider_unknown_as_obstacle cost_threshold input_goals input_waypoint_statuses
        output_goals output_waypoint_statuses server_timeout service_name use_footprint
    RemovePassedGoals global_frame:hj input_goals input_waypoint_statuses:kl output_goals output_waypoint_statuses:kl
        radius robot_base_frame
    RoundRobin wrap_around:l
    SingleTrigger
    SmoothPath check_for_collisions error_code_id:jkl error_msg:kl max_smoothing_duration server_name server_timeout
        smoothed_path smoother_id smoothing_duration unsmoothed_path was_completed
    SmootherSelector default_smoother selected_smoother topic_name
    SpeedController goal:jkl goals:jkl max_rate max_speed min_rate min_speed
    Spin disable_collision_checks:kl error_code_id:jkl error_msg:kl is_recovery server_name server_timeout spin_dist
        time_allowance
    TimeExpired seconds
    ToggleCollisionMonitor enable server_timeout service_name
    TransformAvailable child parent
    TruncatePath distance input_path output_path
    TruncatePathLocal angular_distance_weight distance_backward distance_forward input_path max_robot_pose_search_dist
        output_path pose robot_base_frame:l robot_frame:hjk transform_tolerance
    UndockRobot dock_type error_code_id error_msg:kl max_undocking_time server_name server_timeout success
    ValidatePath collision_poses consider_unknown_as_obstacle footprint layer_name max_cost max_lookahead_distance
        path server_timeout service_name stop_at_first_collision
    Wait error_code_id:kl error_msg:kl server_name server_timeout wait_duration
    WouldAControllerRecoveryHelp error_code error_codes_to_check
    WouldAPlannerRecoveryHelp error_code error_codes_to_check
    WouldARouteRecoveryHelp error_code error_codes_to_check
    WouldASmootherRecoveryHelp error_code error_codes_to_check
"""
"""A node in each line, which may go on further to the right, and its ports; after a colon the distributions that have
the port, where these are not all that have the node."""
_VERSION_3 = """
    AlwaysFailure; AlwaysSuccess; Delay delay_msec; Fallback; ForceFailure; ForceSuccess; IfThenElse; Inverter
    KeepRunningUntilFailure; ManualSelector repeat_last_selection; Parallel failure_threshold success_threshold
    ReactiveFallback; ReactiveSequence; Repeat num_cycles; RetryUntilSuccesful num_attempts
    RetryUntilSuccessful num_attempts; Sequence; SequenceStar; SetBlackboard output_key value; Timeout msec; WhileDoElse
"""
_VERSION_4 = """
    AlwaysFailure; AlwaysSuccess; AsyncFallback; AsyncSequence; Delay delay_msec; Fallback; ForceFailure; ForceSuccess
    IfThenElse; Inverter; KeepRunningUntilFailure; Parallel failure_count success_count; ParallelAll max_failures
    Precondition else if; ReactiveFallback; ReactiveSequence; Repeat num_cycles; RetryUntilSuccessful num_attempts
    RunOnce then_skip; Script code; ScriptCondition code; Sequence; SequenceStar; SequenceWithMemory
    SetBlackboard output_key value; SkipUnlessUpdated entry; Sleep msec; Timeout msec; TryCatch catch_on_halt
    UnsetBlackboard key; WaitValueUpdate entry; WasEntryUpdated entry; WhileDoElse
"""
_NODE = re.compile(r"^    \S.*(?:\n        .*)*", re.MULTILINE)
_RESERVED = frozenset({"ID", "name", "_description", "_autoremap", "__shared_blackboard", "__autoremap"})


def _nav() -> Iterator[tuple[str, Mapping[str, str]]]:
    for line in _NODE.findall(_NAV):
        name, *ports = line.split()
        yield name, {port: letters for port, _, letters in (each.partition(":") for each in ports)}


def _built_in(text: str) -> Mapping[str, frozenset[str]]:
    rows = (each.split() for line in text.strip().splitlines() for each in line.split(";"))
    return {name: frozenset(ports) for name, *ports in rows}


_OF_NAV: Mapping[str, Mapping[str, str]] = dict(_nav())
_OF_VERSION = {True: _built_in(_VERSION_3), False: _built_in(_VERSION_4)}


def ports_of(name: str, distribution: str | None) -> frozenset[str] | None:
    """The ports that the node has there, in any distribution where that is None; None where they are not known."""
    found = _OF_NAV.get(name)
    if found is not None:
        has = (
            port for port, letters in found.items() if not letters or distribution is None or _in(letters, distribution)
        )
        return frozenset(has)
    if distribution is not None:
        return _OF_VERSION[is_version_3(distribution)].get(name)
    either = [each[name] for each in _OF_VERSION.values() if name in each]
    return frozenset().union(*either) if either else None


def distributions_with(name: str, port: str) -> tuple[str, ...]:
    """Those in which the node has the port, while it lacks it in others."""
    letters = _OF_NAV.get(name, {}).get(port, "")
    return tuple(_LETTERS[each] for each in letters)


def is_port(attribute: str) -> bool:
    """Whether an attribute of a node is a port, and no name, condition or description of it."""
    return attribute not in _RESERVED and attribute[:1].isalpha()


def _in(letters: str, distribution: str | None) -> bool:
    return any(_LETTERS[each] == distribution for each in letters)
