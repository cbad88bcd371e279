"""BTR001: a behaviour tree that cannot be loaded."""

import pytest
from support.behavior_trees import navigator
from support.check import check


def test_a_main_tree_that_is_not_there() -> None:
    check(
        navigator("""    <root main_tree_to_execute="Main">
                                ^^^^ warning[BTR001] behavior tree cannot be loaded: the file has no tree 'Main'
      <BehaviorTree ID="MainTree">
        <Wait/>
      </BehaviorTree>
    </root>
""")
    )


def test_no_main_tree_of_two() -> None:
    check(
        navigator("""    <root BTCPP_format="4">
     ^^^^ warning[BTR001] <root> has 2 trees and no 'main_tree_to_execute'
      <BehaviorTree ID="A"><Wait/></BehaviorTree>
      <BehaviorTree ID="B"><Wait/></BehaviorTree>
    </root>
""")
    )


def test_a_subtree_that_is_not_there() -> None:
    check(
        navigator("""    <root BTCPP_format="4" main_tree_to_execute="Main">
      <BehaviorTree ID="Main"><SubTree ID="Recovry"/></BehaviorTree>
                                           ^^^^^^^ warning[BTR001] subtree 'Recovry' does not exist in this file; did you mean 'Recovery'?
      <BehaviorTree ID="Recovery"><Wait/></BehaviorTree>
    </root>
""")  # noqa: E501
    )


def test_a_tree_with_two_children() -> None:
    check(
        navigator("""    <root>
      <BehaviorTree ID="Main"><Wait/><Spin/></BehaviorTree>
       ^^^^^^^^^^^^ warning[BTR001] <BehaviorTree> must have exactly one child, not 2
    </root>
""")
    )


def test_another_document_element() -> None:
    check(
        navigator("""    <BehaviorTree ID="Main"><Wait/></BehaviorTree>
     ^^^^^^^^^^^^ warning[BTR001] the document element must be <root>, not <BehaviorTree>
""")
    )


def test_a_tag_that_is_not_closed() -> None:
    check(
        navigator("""    <root>
      <BehaviorTree ID="Main"><Sequence><Wait/></BehaviorTree>
                               ^^^^^^^^ warning[BTR001] <Sequence> is not closed
    </root>
""")
    )


def test_an_included_file_that_is_not_there() -> None:
    check(
        navigator("""    <root>
      <include path="../b.xml"/>
                     ^^^^^^^^ warning[BTR001] behavior tree cannot be loaded: '/b.xml' does not exist
      <BehaviorTree ID="Main"><Wait/></BehaviorTree>
    </root>
""")
    )


def test_what_an_included_file_has() -> None:
    check(
        navigator("""    <root main_tree_to_execute="Main">
                                ^^^^ warning[BTR001] behavior tree cannot be loaded: there is no tree 'Main', its main tree
      <include path="trees/b.xml" ros_pkg="robot"/>
      <BehaviorTree ID="A"><SubTree ID="Recovry"/></BehaviorTree>
                                        ^^^^^^^ warning[BTR001] subtree 'Recovry' does not exist in this file and those that it includes; did you mean 'Recovery'?
    </root>
//- /robot/package.xml
<package format="3"><name>robot</name><version>1.0.0</version><export><build_type>ament_cmake</build_type></export></package>
//- /robot/trees/b.xml
    <root>
      <BehaviorTree ID="Recovery"><Wait/><Spin/></BehaviorTree>
       ^^^^^^^^^^^^ warning[BTR001] <BehaviorTree> must have exactly one child, not 2
    </root>
""")  # noqa: E501
    )


@pytest.mark.silent
@pytest.mark.parametrize(
    "tree",
    [
        '<root><BehaviorTree ID="A"><Wait/></BehaviorTree></root>',
        '<root main_tree_to_execute="B"><include path="./b.xml"/><BehaviorTree ID="A"><SubTree ID="C"/></BehaviorTree>'
        '</root>\n//- /trees/b.xml\n<root><BehaviorTree ID="B"><SubTree ID="A"/></BehaviorTree>'
        '<BehaviorTree ID="C"><Wait/></BehaviorTree></root>',
        '<root><include path="t.xml" ros_pkg="unknown"/><BehaviorTree ID="A"><SubTree ID="C"/></BehaviorTree></root>',
        '<root><include path="/elsewhere/t.xml"/><BehaviorTree ID="A"><SubTree ID="C"/></BehaviorTree></root>',
        '<root main_tree_to_execute="A"><BehaviorTree ID="A"><SubTree ID="B"/></BehaviorTree>'
        '<BehaviorTree ID="B"><Wait/></BehaviorTree></root>',
        '<root><BehaviorTree ID="A"><Wait _skipIf="a < 1 && b"/></BehaviorTree></root>',
    ],
    ids=["one tree", "includes", "an unknown package", "another machine", "a subtree", "what is no XML and taken"],
)
def test_trees_that_can_be_loaded(tree: str) -> None:
    check(navigator(f"{tree}\n"))
