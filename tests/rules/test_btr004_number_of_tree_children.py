"""BTR004: a behaviour tree node with a wrong number of children."""

import pytest
from support.behavior_trees import navigator
from support.check import check


def _tree(inner: str, attributes: str = "") -> str:
    return navigator(f'<root{attributes}>\n<BehaviorTree ID="Main">\n{inner}\n</BehaviorTree>\n</root>\n', "my_bt_node")


def test_of_nodes_that_are_known() -> None:
    check(
        _tree("""        <RecoveryNode><RateController hz="1"><Wait/><Wait/></RateController><Spin/><Wait/>
         ^^^^^^^^^^^^ warning[BTR004] behavior tree node 'RecoveryNode' must have 2 children, not 3
                       ^^^^^^^^^^^^^^ warning[BTR004] behavior tree node 'RateController' must have 1 child, not 2
        </RecoveryNode>""")
    )


def test_without_children() -> None:
    check(
        _tree("""        <Fallback><Sequence/><IfThenElse/><Inverter/></Fallback>
                   ^^^^^^^^ warning[BTR004] behavior tree node 'Sequence' must have children
                              ^^^^^^^^^^ warning[BTR004] behavior tree node 'IfThenElse' must have 2 to 3 children
                                           ^^^^^^^^ warning[BTR004] behavior tree node 'Inverter' must have 1 child""")
    )


def test_children_of_what_has_none() -> None:
    check(
        _tree("""        <Wait><Spin/></Wait>
         ^^^^ warning[BTR004] behavior tree node 'Wait' must not have children""")
    )


def test_what_the_tag_says() -> None:
    check(
        _tree("""        <Control ID="Mine"><Decorator ID="Own"/><Action ID="Open"><Wait/></Action></Control>
                                          ^^^ warning[BTR004] behavior tree node 'Own' must have 1 child
                                                            ^^^^ warning[BTR004] behavior tree node 'Open' must not""")
    )


def test_of_version_4() -> None:
    check(
        _tree(
            """        <Sequence><Wait/><ReactiveFallback/></Sequence>
                          ^^^^^^^^^^^^^^^^ warning[BTR004] behavior tree node 'ReactiveFallback' must have children""",
            ' BTCPP_format="4"',
        )
    )


@pytest.mark.silent
def test_numbers_that_are_right() -> None:
    check(
        _tree("""<RecoveryNode><Sequence><Switch2 variable="a" case_1="1" case_2="2"><Wait/><Wait/><Wait/></Switch2>
<WhileDoElse><IsStuck/><Wait/><Spin/></WhileDoElse><ReactiveFallback/><Mine><Wait/></Mine></Sequence><Wait/></RecoveryNode>""")
    )
