"""BTR002: a behaviour tree node that no loaded library has."""

import pytest
from support.behavior_trees import navigator
from support.check import check


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


@pytest.mark.silent
def test_known_ones() -> None:
    check(_launch("        <RecoveryNode><Sequence><Wait/><Condition ID='IsStuck'/></Sequence><Spin/></RecoveryNode>"))
