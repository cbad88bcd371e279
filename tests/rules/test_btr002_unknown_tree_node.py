"""BTR002: a behaviour tree node that no loaded library has."""

from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.registry import run_rules
from support import package_elsewhere
from support.behavior_trees import navigator
from support.check import check

_LAUNCH = """<launch><node pkg="nav2_bt_navigator" exec="bt_navigator" name="bt_navigator">
<param name="default_nav_to_pose_bt_xml" value="$(dirname)/t.xml"/>{}</node></launch>"""
_SOURCE = """#include <behaviortree_cpp/bt_factory.h>
BT_REGISTER_NODES(factory) { factory.registerNodeType<OpenDoor>("OpenDoor"); }
"""


def _launch(inner: str, libraries: str = "") -> str:
    tree = f'<root>\n<BehaviorTree ID="Main">\n{inner}\n</BehaviorTree>\n</root>\n'
    return navigator(tree, libraries)


def test_a_slip() -> None:
    check(
        _launch("""        <RecoveryNod number_of_retries="6">
         ^^^^^^^^^^^ warning[BTR002] unknown behavior tree node 'RecoveryNod'; did you mean 'RecoveryNode'?
          <Wait/><Action ID="Spn"/>
                             ^^^ warning[BTR002] unknown behavior tree node 'Spn'; did you mean 'Spin'?
        </RecoveryNod>""")
    )


def test_nothing_like_it() -> None:
    check(
        _launch(
            """        <OpenDoor/>
         ^^^^^^^^ info[BTR002] unknown behavior tree node 'OpenDoor'""",
            "nav2_wait_action_bt_node,nav2_spin_action_bt_node",
        )
    )


def test_a_slip_beside_other_libraries() -> None:
    check(
        _launch(
            """        <RecoveryNod><Wait/><OpenDoor/></RecoveryNod>
         ^^^^^^^^^^^ info[BTR002] unknown behavior tree node 'RecoveryNod'; did you mean 'RecoveryNode'?""",
            "my_door_bt_node,nav2_spin_action_bt_node",
        )
    )


def _found_in(folder: Path, node: str, libraries: str, distro: str = "jazzy") -> list[Finding]:
    tree = f'<root main_tree_to_execute="A"><BehaviorTree ID="A">{node}</BehaviorTree><BehaviorTree ID="B"><Wait/>'
    files = {"t.xml": f"{tree}</BehaviorTree></root>", "src/nodes.cpp": _SOURCE}
    param = f'<param name="plugin_lib_names" value="{libraries}" value-sep=","/>'
    analysis = package_elsewhere.analysed(folder, _LAUNCH.format(param), "a.launch.xml", distro, **files)
    return [each for each in run_rules(analysis.context) if each.rule == "BTR002"]


@pytest.mark.parametrize(
    ("distro", "node", "message"),
    [
        (
            "jazzy",
            '<SubTreePlus ID="B"/>',
            "'SubTreePlus' does not exist in BehaviorTree.CPP 4, which Nav2 of jazzy uses; did you mean 'SubTree'?",
        ),
        (
            "humble",
            "<SequenceWithMemory><Wait/></SequenceWithMemory>",
            "'SequenceWithMemory' does not exist in BehaviorTree.CPP 3, which Nav2 of humble uses; "
            "did you mean 'SequenceStar'?",
        ),
    ],
)
def test_a_node_of_another_version(tmp_path: Path, distro: str, node: str, message: str) -> None:
    (found,) = _found_in(tmp_path, node, "nav2_wait_action_bt_node,my_door_bt_node", distro)
    assert (found.message, found.severity) == (message, "warning")


def test_a_node_whose_library_is_not_listed(tmp_path: Path) -> None:
    """As in open-navigation/opennav_coverage, issue 78."""
    node = '<GetPoseFromPath path="{path}" pose="{pose}"/>'
    (found,) = _found_in(tmp_path, node, "nav2_wait_action_bt_node", "humble")
    assert found.message == (
        "behavior tree node 'GetPoseFromPath' needs 'nav2_get_pose_from_path_action_bt_node' in 'plugin_lib_names'"
    )


@pytest.mark.silent
def test_what_a_source_of_the_workspace_registers(tmp_path: Path) -> None:
    assert not _found_in(tmp_path, "<OpenDoor/>", "nav2_wait_action_bt_node")


@pytest.mark.silent
def test_what_the_file_describes_for_editors() -> None:
    tree = (
        '<root><BehaviorTree ID="A"><Spn/></BehaviorTree><TreeNodesModel><Action ID="Spn"/></TreeNodesModel></root>\n'
    )
    check(navigator(tree))


@pytest.mark.silent
def test_known_ones() -> None:
    check(_launch("        <RecoveryNode><Sequence><Wait/><Condition ID='IsStuck'/></Sequence><Spin/></RecoveryNode>"))
