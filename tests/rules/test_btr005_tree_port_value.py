"""BTR005: a port of a behaviour tree node with a value that it cannot have, or that it lacks."""

from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.registry import run_rules
from support import package_elsewhere
from support.behavior_trees import navigator
from support.check import check

_LAUNCH = """<launch><node pkg="nav2_bt_navigator" exec="bt_navigator" name="bt_navigator">
<param name="default_nav_to_pose_bt_xml" value="$(dirname)/t.xml"/></node></launch>"""
_SOURCE = """#include <behaviortree_cpp/bt_factory.h>
class OpenDoor : public BT::SyncActionNode {
  static BT::PortsList providedPorts() {
    return {BT::InputPort<double>("width"), BT::OutputPort<std::string>("state"), BT::InputPort<Door>("door")};
  }
};
BT_REGISTER_NODES(factory) { factory.registerNodeType<OpenDoor>("OpenDoor"); }
"""


def found_in(folder: Path, nodes: str, distro: str | None = None) -> list[Finding]:
    tree = f'<root><BehaviorTree ID="A"><Sequence>{nodes}</Sequence></BehaviorTree></root>'
    files = {"t.xml": tree, "src/nodes.cpp": _SOURCE}
    analysis = package_elsewhere.analysed(folder, _LAUNCH, "a.launch.xml", distro, **files)
    return [each for each in run_rules(analysis.context) if each.rule == "BTR005"]


def test_where_it_stands() -> None:
    check(
        navigator("""<root><BehaviorTree ID="Main"><Sequence>
        <ComputePathToPose goal="goal" path="path"/>
                                 ^^^^ warning[BTR005] 'goal' is not a blackboard entry: 'goal' of 'ComputePathToPose' takes a pose; did you mean '{goal}'?
                                             ^^^^ warning[BTR005] 'path' is not a blackboard entry: 'ComputePathToPose' cannot write its output 'path'; did you mean '{path}'?
        <FollowPath/>
         ^^^^^^^^^^ warning[BTR005] 'FollowPath' needs the port 'path', which is not set
        <RateController hz="fast"><Wait wait_duration="long"/></RateController>
                            ^^^^ warning[BTR005] 'fast' is not a number, which 'hz' of 'RateController' takes
                                                       ^^^^ warning[BTR005] 'long' is not a number, which 'wait_duration'
        <Spin is_recovery="yes"/>
                           ^^^ warning[BTR005] 'yes' is not a boolean, which 'is_recovery' of 'Spin' takes
        </Sequence></BehaviorTree></root>
""")  # noqa: E501
    )


@pytest.mark.parametrize(
    ("nodes", "distro", "message"),
    [
        ("<Repeat><Wait/></Repeat>", "humble", "'Repeat' needs the port 'num_cycles', which is not set"),
        ('<Delay delay_msec=""><Wait/></Delay>', "humble", "'Delay' needs the port 'delay_msec', which is empty"),
        ('<Wait wait_duration=""/>', "jazzy", "'wait_duration' of 'Wait' is empty; it takes a number"),
        (
            '<ComputePathToPose goal="{goal}" path="{path}"/><FollowPath path="{goal}"/>',
            "jazzy",
            "'{goal}' is a pose for 'goal' of 'ComputePathToPose', but 'path' of 'FollowPath' takes a path",
        ),
        ('<OpenDoor width="wide"/>', "jazzy", "'wide' is not a number, which 'width' of 'OpenDoor' takes"),
        (
            '<OpenDoor state="open"/>',
            None,
            "'open' is not a blackboard entry: 'OpenDoor' cannot write its output 'state'; did you mean '{open}'?",
        ),
    ],
)
def test_values_and_what_is_missing(tmp_path: Path, nodes: str, distro: str | None, message: str) -> None:
    (found,) = found_in(tmp_path, nodes, distro)
    assert (found.message, found.severity) == (message, "warning")


def test_the_fix_makes_an_entry_of_it(tmp_path: Path) -> None:
    (found,) = found_in(tmp_path, '<ComputePathToPose goal="{goal}" path="path"/>')
    assert [edit.text for fix in found.fixes for edit in fix.edits] == ["{path}"]


@pytest.mark.silent
@pytest.mark.parametrize(
    ("nodes", "distro"),
    [
        ('<Wait wait_duration="5.5"/><Wait wait_duration="{time}"/><Wait wait_duration=""/>', "humble"),
        ('<ComputePathToPose goal="0;0;0;map" path="{=}" planner_id="{a}" server_timeout="10"/>', "jazzy"),
        ('<SetBlackboard output_key="a" value="b"/>', "jazzy"),
        ('<Spin is_recovery="TRUE" spin_dist="-1.57"/><Repeat num_cycles="-1"><Wait/></Repeat>', "humble"),
        ('<OpenDoor width=".5" state="{state}" door="front"/><Unknown width="wide"/>', "jazzy"),
        ('<ComputePathToPose goal="{goal}" path="{path}"/><FollowPath path="{path}"/>', "humble"),
        ('<RemovePassedGoals input_goals="{goals}" output_goals="{goals}"/>', "humble"),
    ],
)
def test_values_that_are_right(tmp_path: Path, nodes: str, distro: str | None) -> None:
    assert not found_in(tmp_path, nodes, distro)
