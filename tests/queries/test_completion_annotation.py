"""What is offered in the annotation of a node."""

from __future__ import annotations

import pytest
from preflight_analysis.queries.completion import complete
from preflight_analysis.queries.completion_items import Completion
from preflight_analysis.queries.completion_values import Lookup
from support.query_harness import Executables, at_cursor

NODE = """
<launch>
  <node pkg="p" type="t" name="listener">
    %s
    <remap from="heard" to="chatter"/>
  </node>
  <node pkg="p" type="u" name="talker">
    <topics><topic name="chatter" type="std_msgs/String" class="pub"/></topics>
  </node>
</launch>
"""


def completed(text: str, trigger: str | None = None) -> Completion | None:
    there = at_cursor(text)
    return complete(
        there.analysis,
        there.launch_file,
        there.offset,
        Lookup(there.sources, Executables(), there.ahead_of_runs),
        trigger,
    )


def offered(annotation: str, trigger: str | None = None) -> list[str]:
    found = completed(NODE % annotation, trigger)
    return [item.label for item in found.items] if found else []


@pytest.mark.parametrize("form", ["%s", "<!-- %s -->"])
def test_items_attributes_and_classes(form: str) -> None:
    assert offered(form % "<topics><$0</topics>") == ["topic pub", "topic sub"]
    assert offered(form % "<services><$0</services>", "<") == ["service server", "service client"]
    assert offered(form % "<params><$0</params>") == ["param"]
    assert offered(form % '<topics><topic name="a" $0/></topics>', " ") == ["type", "class"]
    assert offered(form % '<actions><action class="$0"/></actions>') == ["server", "client"]


@pytest.mark.parametrize("form", ["%s", "<!-- %s -->"])
def test_names_are_those_of_the_node_and_types_first_those_of_the_other_end(form: str) -> None:
    assert offered(form % '<topics><topic name="$0" type="" class="sub"/></topics>') == ["heard"]
    types = offered(form % '<topics><topic name="heard" type="$0" class="sub"/></topics>')
    assert types[0] == "std_msgs/String"
    assert types.count("std_msgs/String") == 1
    assert "geometry_msgs/Twist" in types
    assert "std_srvs/Trigger" in offered(form % '<services><service name="heard" type="$0"/></services>')


def test_what_was_typed_is_replaced() -> None:
    text = NODE % '<!-- <topics><topic name="heard" type="std_msgs/Str$0ing" class="sub"/></topics> -->'
    found = completed(text, "/")
    assert found is not None
    assert at_cursor(text).text(found.span) == "std_msgs/String"
    assert at_cursor(NODE % "<topics><to$0pic/></topics>").text(found.span) is not None


@pytest.mark.parametrize(
    ("before", "call"),
    [
        ("# preflight: ", "Node(package='p', executable='e', name='n')"),
        ("# preflight: <topics>\n    # ", "Node(package='p', executable='e', name='n')"),
    ],
)
def test_in_a_comment_of_a_python_file(before: str, call: str) -> None:
    opened = before if "<topics>" in before else f"{before}<topics>"
    lines = f"def generate_launch_description():\n    {opened}<topic name='x' type='$0'/>\n    {call}\n"
    found = completed(f"//- /a.launch.py\n{lines}")
    assert found is not None
    assert "std_msgs/msg/String" in [item.label for item in found.items]


@pytest.mark.silent
@pytest.mark.parametrize(
    "annotation",
    [
        "<topics><topic/></topics>$0",
        "<!-- <topics><topic/></topics> $0 -->",
        "<topics>$0<topic/></topics>",
        '<topics><topic name="a"$0/></topics>',
        '<params><param name="x" default="$0"/></params>',
    ],
)
def test_elsewhere_nothing_of_it_is_offered(annotation: str) -> None:
    assert not {"topic pub", "pub", "class", "std_msgs/String"}.intersection(offered(annotation))


@pytest.mark.silent
def test_after_a_character_that_asks_for_something_else() -> None:
    assert offered("<topics><$0</topics>", " ") == []
    assert offered('<topics><topic type="std_msgs $0"/></topics>', " ") == []
    hash_file = "//- /a.launch.py\n# preflight: <topics>\nx = '<topic type=\"$0\"/>'\n"
    assert completed(hash_file) is None
