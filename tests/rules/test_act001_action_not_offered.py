"""ACT001: a node is a client of an action that nobody offers."""

import pytest
from support.action_interfaces import client, server
from support.check import apply, check, findings_of


@pytest.mark.silent
def test_client_and_server_that_meet_are_fine_and_so_is_a_server_alone() -> None:
    check(f"""
        <launch>
          <node pkg="p" type="t" name="base" ns="nav"/>
          <node pkg="p" type="t" name="dock"/>
          <node pkg="p" type="t" name="patrol"><remap from="move_base" to="nav/move_base"/></node>
        </launch>
        //- interfaces
        {{"/nav/base": {server("move_base", "m/MoveBaseAction")}, "/dock": {server("~dock", "m/DockAction")},
         "/patrol": {client("move_base", "m/MoveBaseAction")}}}
    """)


def test_a_near_miss_is_a_warning_that_names_both_and_the_topics_are_not_told() -> None:
    text = f"""
        <launch>
          <node pkg="p" type="t" name="base"/>
          <node pkg="p" type="t" name="patrol">
            <remap from="navigate" to="mov_base"/>
                                       ^^^^^^^^ warning[ACT001] action '/mov_base' has no server (client: /patrol);
          </node>
        </launch>
        //- interfaces
        {{"/base": {server("move_base", "m/MoveBaseAction")}, "/patrol": {client("navigate", "m/MoveBaseAction")}}}
    """
    (finding,) = check(text)
    assert "action '/mov_base' has no server" in finding.message
    assert finding.confidence == "likely"
    assert '<remap from="navigate" to="move_base"/>' in apply(text, finding.fixes[0].edits)["/main.launch"]


def test_a_name_from_the_code_gets_a_remap_of_the_whole_action() -> None:
    text = f"""
        <launch>
          <node pkg="p" type="t" name="base" ns="robot"/>
          <node pkg="p" type="t" name="patrol" ns="robot"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[ACT001] did you mean '/robot/move_base'
        </launch>
        //- interfaces
        {{"/robot/base": {server("move_base", "m/MoveBaseAction")},
         "/robot/patrol": {client("mov_base", "m/MoveBaseAction")}}}
    """
    (finding,) = check(text)
    assert '<remap from="mov_base" to="move_base"/>' in apply(text, finding.fixes[0].edits)["/main.launch"]


def test_remaps_of_the_single_topics_move_the_action_and_are_not_corrected_one_at_a_time() -> None:
    topics = ("goal", "cancel", "status", "feedback", "result")
    remaps = "\n            ".join(f'<remap from="navigate/{t}" to="mov_base/{t}"/>' for t in topics[1:])
    text = f"""
        <launch>
          <node pkg="p" type="t" name="base"/>
          <node pkg="p" type="t" name="patrol">
            {remaps}
            <remap from="navigate/goal" to="mov_base/goal"/>
                                            ^^^^^^^^^^^^^ warning[ACT001] did you mean '/move_base'
          </node>
        </launch>
        //- interfaces
        {{"/base": {server("move_base", "m/MoveBaseAction")}, "/patrol": {client("navigate", "m/MoveBaseAction")}}}
    """
    (finding,) = check(text)
    assert finding.fixes == ()


def test_without_a_near_name_it_is_a_hint() -> None:
    check(f"""
        <launch>
          <node pkg="p" type="t" name="base"/>
          <node pkg="p" type="t" name="patrol"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[ACT001] action '/gripper' (m/GripAction) has no server in this
        </launch>
        //- interfaces
        {{"/base": {server("move_base", "m/MoveBaseAction")}, "/patrol": {client("gripper", "m/GripAction")}}}
    """)


@pytest.mark.silent
def test_a_declared_end_meets_one_that_a_run_showed() -> None:
    check(f"""
        <launch>
          <node pkg="p" type="t" name="base">
            <!-- <actions><action name="move_base" type="m/MoveBaseAction" class="server"/></actions> -->
          </node>
          <node pkg="p" type="t" name="dock">
            <actions><action name="dock" type="m/Dock" class="server"/></actions>
          </node>
          <node pkg="p" type="t" name="patrol"/>
          <node pkg="p" type="t" name="home"/>
          <node pkg="p" type="t" name="watch"/>
        </launch>
        //- interfaces
        {{"/patrol": {client("move_base", "m/MoveBaseAction")}, "/home": {client("dock", "m/DockAction")},
         "/watch": {{"subscribers": {{"move_base/result": "m/MoveBaseActionResult"}}}}}}
    """)


def test_the_actions_of_ros_2() -> None:
    """Their hidden topics and services are no dangling ends of their own, and are not offered twice."""
    check("""
        //- /nav.launch.xml
        <launch>
          <node pkg="p" exec="base" name="base"/>
          <node pkg="p" exec="patrol" name="patrol">
            <remap from="navigate" to="/navigate_to_pse"/>
                                       ^^^^^^^^^^^^^^^^ warning[ACT001] action '/navigate_to_pse' has no server
          </node>
          <node pkg="p" exec="arm" name="arm"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[ACT002] type mismatch on '/dock': /base serves m/action/Dock,
          <node pkg="p" exec="spare" name="spare"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[ACT003] action '/lift' has 2 servers (/base and /spare):
          <node pkg="p" exec="far" name="far"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[ACT001] action '/fly' (m/action/Fly) has no server in this launch
        </launch>
        //- interfaces
        {"/base": {"action_servers": {"navigate_to_pose": "m/action/Nav", "dock": "m/action/Dock",
                                       "lift": "m/action/Lift"}},
         "/patrol": {"action_clients": {"navigate": "m/action/Nav"}},
         "/arm": {"action_clients": {"dock": "m/action/Grip"}},
         "/spare": {"action_servers": {"lift": "m/action/Lift"}},
         "/far": {"action_clients": {"fly": "m/action/Fly"}}}
    """)


@pytest.mark.silent
@pytest.mark.parametrize(
    "arm", ['{"source": "none", "status": "not-run"}', '{"source": "catalogue", "status": "not-run"}']
)
def test_an_action_below_the_name_of_a_node_of_which_nothing_is_known(arm: str) -> None:
    """The catalogue knows that it is there, and none of its actions: its base class may offer them."""
    found = findings_of(f"""
        <launch>
          <node pkg="p" type="t" name="fast_arm"/>
          <node pkg="p" type="t" name="arm"/>
          <node pkg="p" type="t" name="till"/>
        </launch>
        //- interfaces
        {{"/fast_arm": {arm},
         "/arm": {server("arm/follow_joint_trajectory", "m/FollowAction")},
         "/till": {client("fast_arm/follow_joint_trajectory", "m/FollowAction")}}}
    """)
    assert "ACT001" not in [finding.rule for finding in found]


def test_another_controller_is_named_but_not_put_in_its_place() -> None:
    (finding,) = check(f"""
        <launch>
          <node pkg="p" type="t" name="arm"/>
          <node pkg="p" type="t" name="till">
            <remap from="follow" to="fast_arm/follow_joint_trajectory"/>
                                     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[ACT001] did you mean '/arm/follow_joint
          </node>
        </launch>
        //- interfaces
        {{"/arm": {server("arm/follow_joint_trajectory", "m/FollowAction")},
         "/till": {client("follow", "m/FollowAction")}}}
    """)
    assert finding.fixes == ()
