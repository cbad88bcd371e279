"""The nodes of behaviour trees that Nav2 and BehaviorTree.CPP have, by distribution.

Read of ros-navigation/navigation2 (`add_library` in the CMakeLists.txt, what each source registers):
nav2_behavior_tree, opennav_docking_bt and opennav_following_bt of humble 3c3db59d, jazzy f4108e5b, kilted 71a1d84f and
lyrical aa3dab8d; and of src/bt_factory.cpp of BehaviorTree/BehaviorTree.CPP, tags 3.8.8, 4.5.2, 4.7.3 and 879522c.
"""

from __future__ import annotations

from collections.abc import Mapping

from preflight_analysis.dataclass import dataclass

_WITH_VERSION_3 = frozenset({"humble"})
_DOCKING = ("opennav_dock", "opennav_undock")
_BY_DISTRIBUTION = {
    "humble jazzy kilted lyrical": """
        nav2_assisted_teleop_action_bt_node AssistedTeleop
        nav2_assisted_teleop_cancel_bt_node CancelAssistedTeleop
        nav2_back_up_action_bt_node BackUp
        nav2_back_up_cancel_bt_node CancelBackUp
        nav2_clear_costmap_service_bt_node ClearCostmapAroundRobot ClearCostmapExceptRegion ClearEntireCostmap
        nav2_compute_and_track_route_bt_node ComputeAndTrackRoute
        nav2_compute_path_through_poses_action_bt_node ComputePathThroughPoses
        nav2_compute_path_to_pose_action_bt_node ComputePathToPose
        nav2_compute_route_bt_node ComputeRoute
        nav2_controller_cancel_bt_node CancelControl
        nav2_controller_selector_bt_node ControllerSelector
        nav2_distance_controller_bt_node DistanceController
        nav2_distance_traveled_condition_bt_node DistanceTraveled
        nav2_drive_on_heading_bt_node DriveOnHeading
        nav2_drive_on_heading_cancel_bt_node CancelDriveOnHeading
        nav2_follow_path_action_bt_node FollowPath
        nav2_get_pose_from_path_action_bt_node GetPoseFromPath
        nav2_globally_updated_goal_condition_bt_node GlobalUpdatedGoal
        nav2_goal_checker_selector_bt_node GoalCheckerSelector
        nav2_goal_reached_condition_bt_node GoalReached
        nav2_goal_updated_condition_bt_node GoalUpdated
        nav2_goal_updated_controller_bt_node GoalUpdatedController
        nav2_goal_updater_node_bt_node GoalUpdater
        nav2_initial_pose_received_condition_bt_node InitialPoseReceived
        nav2_is_battery_charging_condition_bt_node IsBatteryCharging
        nav2_is_battery_low_condition_bt_node IsBatteryLow
        nav2_is_stuck_condition_bt_node IsStuck
        nav2_navigate_through_poses_action_bt_node NavigateThroughPoses
        nav2_navigate_to_pose_action_bt_node NavigateToPose
        nav2_path_longer_on_approach_bt_node PathLongerOnApproach
        nav2_pipeline_sequence_bt_node PipelineSequence
        nav2_planner_selector_bt_node PlannerSelector
        nav2_progress_checker_selector_bt_node ProgressCheckerSelector
        nav2_rate_controller_bt_node RateController
        nav2_recovery_node_bt_node RecoveryNode
        nav2_reinitialize_global_localization_service_bt_node ReinitializeGlobalLocalization
        nav2_remove_passed_goals_action_bt_node RemovePassedGoals
        nav2_round_robin_node_bt_node RoundRobin
        nav2_single_trigger_bt_node SingleTrigger
        nav2_smooth_path_action_bt_node SmoothPath
        nav2_smoother_selector_bt_node SmootherSelector
        nav2_speed_controller_bt_node SpeedController
        nav2_spin_action_bt_node Spin
        nav2_spin_cancel_bt_node CancelSpin
        nav2_time_expired_condition_bt_node TimeExpired
        nav2_transform_available_condition_bt_node TransformAvailable
        nav2_truncate_path_action_bt_node TruncatePath
        nav2_truncate_path_local_action_bt_node TruncatePathLocal
        nav2_wait_action_bt_node Wait
        nav2_wait_cancel_bt_node CancelWait
    """,
    "humble jazzy kilted": """
        nav2_is_path_valid_condition_bt_node IsPathValid
        nav2_path_expiring_timer_condition PathExpiringTimer
    """,
    "jazzy kilted lyrical": """
        nav2_are_error_codes_active_condition_bt_node AreErrorCodesPresent
        nav2_are_poses_near_condition_bt_node ArePosesNear
        nav2_compute_and_track_route_cancel_bt_node CancelComputeAndTrackRoute
        nav2_concatenate_paths_action_bt_node ConcatenatePaths
        nav2_get_current_pose_action_bt_node GetCurrentPose
        nav2_would_a_controller_recovery_help_condition_bt_node WouldAControllerRecoveryHelp
        nav2_would_a_planner_recovery_help_condition_bt_node WouldAPlannerRecoveryHelp
        nav2_would_a_smoother_recovery_help_condition_bt_node WouldASmootherRecoveryHelp
        opennav_dock_action_bt_node DockRobot
        opennav_undock_action_bt_node UndockRobot
    """,
    "jazzy lyrical": """
        nav2_clear_costmap_service_bt_node ClearCostmapAroundPose
    """,
    "kilted lyrical": """
        nav2_append_goal_pose_to_goals_action_bt_node AppendGoalPoseToGoals
        nav2_extract_route_nodes_as_goals_action_bt_node ExtractRouteNodesAsGoals
        nav2_get_next_few_goals_action_bt_node GetNextFewGoals
        nav2_remove_in_collision_goals_action_bt_node RemoveInCollisionGoals
        nav2_would_a_route_recovery_help_condition_bt_node WouldARouteRecoveryHelp
    """,
    "kilted": """
        nav2_is_stopped_condition_bt_node IsStopped
    """,
    "lyrical": """
        check_pose_occupancy_action_bt_node CheckPoseOccupancy
        check_stop_status_action_bt_node CheckStopStatus
        nav2_is_goal_nearby_condition_bt_node IsGoalNearby
        nav2_is_within_path_tracking_bounds_condition_bt_node IsWithinPathTrackingBounds
        nav2_nonblocking_sequence_bt_node NonblockingSequence
        nav2_path_expiring_timer_condition_bt_node PathExpiringTimer
        nav2_path_handler_selector_bt_node PathHandlerSelector
        nav2_pause_resume_controller_bt_node PauseResumeController
        nav2_persistent_sequence_bt_node PersistentSequence
        nav2_toggle_collision_monitor_service_bt_node ToggleCollisionMonitor
        opennav_follow_action_bt_node FollowObject
        opennav_follow_cancel_bt_node CancelFollowObject
        validate_path_action_bt_node ValidatePath
    """,
}
"""By distributions: a library in each line, and the nodes that it registers."""
_VERSION_3 = """
    Fallback Sequence SequenceStar Parallel ReactiveSequence ReactiveFallback IfThenElse WhileDoElse
    Inverter RetryUntilSuccesful RetryUntilSuccessful KeepRunningUntilFailure Repeat Timeout Delay
    ForceSuccess ForceFailure AlwaysSuccess AlwaysFailure SetBlackboard SubTree SubTreePlus
    BlackboardCheckInt BlackboardCheckDouble BlackboardCheckString BlackboardCheckBool Switch2 Switch3
    Switch4 Switch5 Switch6 ManualSelector
"""
_VERSION_4 = """
    Fallback AsyncFallback Sequence AsyncSequence SequenceWithMemory SequenceStar Parallel ParallelAll
    ReactiveSequence ReactiveFallback IfThenElse WhileDoElse TryCatch Inverter RetryUntilSuccessful
    KeepRunningUntilFailure Repeat Timeout Delay RunOnce ForceSuccess ForceFailure AlwaysSuccess
    AlwaysFailure Script ScriptCondition SetBlackboard Sleep UnsetBlackboard SubTree Precondition
    Switch2 Switch3 Switch4 Switch5 Switch6 LoopInt LoopBool LoopDouble LoopString WasEntryUpdated
    SkipUnlessUpdated WaitValueUpdate
"""


@dataclass(frozen=True, slots=True)
class NavNode:
    """A node of Nav2: the libraries that have it, by distribution."""

    libraries: Mapping[str, str]


def _read() -> dict[str, NavNode]:
    found: dict[str, dict[str, str]] = {}
    for distributions, lines in _BY_DISTRIBUTION.items():
        for library, *names in map(str.split, lines.strip().splitlines()):
            for name in names:
                found.setdefault(name, {}).update(dict.fromkeys(distributions.split(), library))
    return {name: NavNode(libraries) for name, libraries in found.items()}


NAV_NODES: Mapping[str, NavNode] = _read()
NAV_LIBRARIES = frozenset(library for node in NAV_NODES.values() for library in node.libraries.values())
NAV_DISTRIBUTIONS = frozenset(distribution for node in NAV_NODES.values() for distribution in node.libraries)
BUILT_IN = frozenset((*_VERSION_3.split(), *_VERSION_4.split()))


_REPLACED = {
    True: {"SequenceWithMemory": "SequenceStar"},
    False: {"SubTreePlus": "SubTree", "RetryUntilSuccesful": "RetryUntilSuccessful"},
}
"""By whether it is version 3: what nodes of the other version are called."""


def built_in(distribution: str | None) -> frozenset[str]:
    """The nodes of BehaviorTree.CPP itself there; of all versions where Nav2's distribution is not known."""
    if distribution not in NAV_DISTRIBUTIONS:
        return BUILT_IN
    return frozenset((_VERSION_3 if is_version_3(distribution) else _VERSION_4).split())


def instead_of(name: str, distribution: str) -> str | None:
    """What a node of BehaviorTree.CPP is called there that another version has."""
    return _REPLACED[is_version_3(distribution)].get(name)


def is_version_3(distribution: str) -> bool:
    """Whether Nav2 uses version 3 of BehaviorTree.CPP there."""
    return distribution in _WITH_VERSION_3


def loads_by_default(distribution: str, library: str) -> bool:
    """Whether bt_navigator loads the library beside those that `plugin_lib_names` lists: all of nav2_behavior_tree,
    since Jazzy."""
    return distribution not in _WITH_VERSION_3 and not library.startswith(_DOCKING)
