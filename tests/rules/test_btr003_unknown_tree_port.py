"""BTR003: an attribute in a behaviour tree that is no port of its node."""

from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.registry import run_rules
from support import package_elsewhere

_LAUNCH = """<launch><node pkg="nav2_bt_navigator" exec="bt_navigator" name="bt_navigator">
<param name="default_nav_to_pose_bt_xml" value="$(dirname)/t.xml"/>{}</node></launch>"""
_SOURCE = """#include <behaviortree_cpp/bt_factory.h>
class OpenDoor : public BT::SyncActionNode {
public:
  // BT::InputPort<double>("old")
  static BT::PortsList providedPorts() { return {BT::InputPort<double>("width"), BT::OutputPort<int>("angle", "")}; }
};
class Follow : public BtActionNode<Action> {
  static BT::PortsList providedPorts() { return providedBasicPorts({BT::InputPort<double>("width")}); }
};
BT_REGISTER_NODES(factory) {
  factory.registerNodeType<OpenDoor>("OpenDoor");
  factory.registerBuilder<my::Follow>("Follow", builder);
}
"""


def found_in(folder: Path, node: str, distro: str | None, libraries: str = "") -> list[Finding]:
    tree = f'<root><BehaviorTree ID="A">{node}</BehaviorTree></root>'
    listed = f'<param name="plugin_lib_names" value="{libraries}" value-sep=","/>' if libraries else ""
    files = {"t.xml": tree, "src/nodes.cpp": _SOURCE}
    analysis = package_elsewhere.analysed(folder, _LAUNCH.format(listed), "a.launch.xml", distro, **files)
    return [each for each in run_rules(analysis.context) if each.rule == "BTR003"]


def test_a_slip(tmp_path: Path) -> None:
    (found,) = found_in(tmp_path, '<ComputePathToPose gaol="{goal}" path="{path}"/>', "jazzy")
    assert found.message == "'gaol' is not a port of 'ComputePathToPose'; did you mean 'goal'?"
    assert (found.severity, found.fixes[0].edits[0].text) == ("warning", "goal")


def test_a_port_of_another_distribution(tmp_path: Path) -> None:
    (found,) = found_in(tmp_path, '<Action ID="Spin" spin_dist="1" error_code_id="{code}"/>', "humble")
    assert found.message.startswith("'error_code_id' is not a port of 'Spin' in humble")
    assert found.severity == "warning"


@pytest.mark.parametrize(
    ("node", "distro", "libraries", "severity"),
    [
        ('<Repeat num_cycle="3"><Wait/></Repeat>', "jazzy", "", "warning"),
        ('<Repeat num_cycle="3"><Wait/></Repeat>', None, "", "info"),
        ('<Repeat num_cycle="3"><Wait/></Repeat>', "jazzy", "my_door_bt_node", "info"),
        ('<Parallel success_threshold="1"><Wait/></Parallel>', "jazzy", "", "warning"),
        ('<OpenDoor width="1" angel="{a}"/>', "jazzy", "", "warning"),
    ],
)
def test_built_in_and_own_nodes(tmp_path: Path, node: str, distro: str | None, libraries: str, severity: str) -> None:
    (found,) = found_in(tmp_path, node, distro, libraries)
    assert found.severity == severity


@pytest.mark.silent
@pytest.mark.parametrize(
    ("node", "distro"),
    [
        ('<ComputePathToPose name="x" goal="{goal}" path="{path}" error_code_id="{e}"/>', "jazzy"),
        ('<Spin error_code_id="{e}"/>', None),
        ('<Wait wait_duration="1" _skipIf="a" _onSuccess="b := 1"/>', "jazzy"),
        ('<Parallel success_threshold="1"><Wait/></Parallel>', "humble"),
        ('<OpenDoor width="1" angle="{a}"/>', "jazzy"),
        ('<Follow widht="1"/>', "jazzy"),
        ('<SubTree ID="B" anything="1"/>', "jazzy"),
        ('<Unknown anything="1"/>', "jazzy"),
        ('<Switch3 variable="{a}" case_1="x"><Wait/></Switch3>', "jazzy"),
    ],
)
def test_ports_that_are_there(tmp_path: Path, node: str, distro: str | None) -> None:
    assert not found_in(tmp_path, node, distro)


def _of_subtree(folder: Path, distro: str | None, subtree: str) -> list[Finding]:
    tree = f'<BehaviorTree ID="A">{subtree}</BehaviorTree><BehaviorTree ID="B"><Wait/></BehaviorTree>'
    files = {"t.xml": f'<root main_tree_to_execute="A">{tree}</root>'}
    analysis = package_elsewhere.analysed(folder, _LAUNCH.format(""), "a.launch.xml", distro, **files)
    return [each for each in run_rules(analysis.context) if each.rule == "BTR003"]


@pytest.mark.parametrize(
    ("distro", "attribute", "message"),
    [
        (
            "jazzy",
            "__shared_blackboard",
            "'__shared_blackboard' of <SubTree> has no effect in BehaviorTree.CPP 4, which Nav2 of jazzy uses; "
            "did you mean '_autoremap'?",
        ),
        (
            "humble",
            "_autoremap",
            "'_autoremap' of <SubTree> has no effect in BehaviorTree.CPP 3, which Nav2 of humble uses; "
            "did you mean '__autoremap' of <SubTreePlus>?",
        ),
    ],
)
def test_what_shares_the_blackboard_in_another_version(
    tmp_path: Path, distro: str, attribute: str, message: str
) -> None:
    (found,) = _of_subtree(tmp_path, distro, f'<SubTree ID="B" {attribute}="true"/>')
    assert found.message == message


@pytest.mark.silent
@pytest.mark.parametrize(
    ("distro", "subtree"),
    [
        ("jazzy", '<SubTree ID="B" _autoremap="true"/>'),
        ("jazzy", '<SubTree ID="B" __shared_blackboard="false"/>'),
        ("humble", '<SubTreePlus ID="B" __autoremap="1"/>'),
        (None, '<SubTree ID="B" __shared_blackboard="true"/>'),
    ],
)
def test_what_shares_it_in_this_version(tmp_path: Path, distro: str | None, subtree: str) -> None:
    assert not _of_subtree(tmp_path, distro, subtree)


_RUNNER = """<launch><node pkg="robot" exec="runner" name="runner"><param name="tree" value="$(dirname)/t.xml"/></node>
</launch>"""


def _of_runner(folder: Path, tree: str) -> list[Finding]:
    files = {"t.xml": tree, "src/nodes.cpp": _SOURCE}
    context = package_elsewhere.analysed(folder, _RUNNER, "a.launch.xml", **files).context
    return [each for each in run_rules(context) if each.rule.startswith("BTR")]


def test_a_tree_that_a_node_of_the_workspace_loads(tmp_path: Path) -> None:
    tree = '<root><BehaviorTree ID="A"><OpenDoor angel="1"/></BehaviorTree></root>'
    (found,) = _of_runner(tmp_path, tree)
    assert found.message == "'angel' is not a port of 'OpenDoor'; did you mean 'angle'?"
    assert [each.message for each in found.related] == [
        "/runner loads the file by 'tree'",
        "'OpenDoor' is registered here",
    ]


@pytest.mark.silent
@pytest.mark.parametrize(
    "tree",
    [
        '<root><BehaviorTree ID="A"><OpenDoor/></BehaviorTree><BehaviorTree ID="B"><Spn/></BehaviorTree></root>',
        '<root><BehaviorTree ID="A"><Spin anything="1"/></BehaviorTree></root>',
        '<root><BehaviorTree ID="A"><SubTree ID="InAnotherFile"/></BehaviorTree></root>',
        "<robot><link/></robot>",
    ],
)
def test_what_only_that_node_knows(tmp_path: Path, tree: str) -> None:
    assert not _of_runner(tmp_path, tree)


_SERVER = """<launch><node pkg="robot" exec="tree_server" name="bt_action_server">
<param name="behavior_trees" value="robot/trees,robot/nowhere,elsewhere/trees" value-sep=","/></node></launch>"""


def test_the_folders_of_a_tree_execution_server(tmp_path: Path) -> None:
    tree = '<root><BehaviorTree ID="A"><OpenDoor angel="1"/></BehaviorTree></root>'
    files = {"trees/a.xml": tree, "trees/b.xml": tree, "src/nodes.cpp": _SOURCE, "trees/below/c.xml": tree}
    context = package_elsewhere.analysed(tmp_path, _SERVER, "a.launch.xml", **files).context
    missing, *found = [each for each in run_rules(context) if each.rule.startswith("BTR")]
    assert missing.message.startswith("folder 'robot/nowhere' in 'behavior_trees' of /bt_action_server does not exist")
    assert [Path(each.location.file).name for each in found] == ["a.xml", "b.xml"]
    assert found[0].related[0].message == "/bt_action_server loads the file by 'behavior_trees'"
