"""The same editing in the launch files of ROS 2, XML and YAML: what is offered, and what it replaces."""

from __future__ import annotations

import textwrap

import pytest
from hypothesis import given
from hypothesis import strategies as st
from preflight_analysis.queries.completion import TRIGGERS, complete
from preflight_analysis.queries.completion_items import Completion, Item
from preflight_analysis.queries.completion_values import Lookup
from support.query_harness import Executables, at_cursor

XML, YAML = "//- /main.launch.xml\n", "//- /main.launch.yaml\n"
INNER = """
//- /inner.launch.xml
<launch>
  <arg name="rate" default="10" description="In Hz"/>
  <arg name="robot"/>
  <let name="half" value="$(var rate)"/>
</launch>
"""


def completed(text: str, trigger: str | None = None) -> Completion | None:
    there = at_cursor(textwrap.dedent(text))
    executables = Executables({"p": ["talker", "listener"]})
    return complete(
        there.analysis,
        there.launch_file,
        there.offset,
        Lookup(there.sources, executables, there.ahead_of_runs),
        trigger,
    )


def items(text: str, trigger: str | None = None) -> dict[str, Item]:
    found = completed(text, trigger)
    return {item.label: item for item in found.items} if found else {}


def offered(text: str, trigger: str | None = None) -> list[str]:
    return list(items(text, trigger))


def applied(text: str, label: str, *, snippets: bool = False) -> str:
    """The file with the cursor after the item of that label was accepted."""
    found = completed(text)
    assert found is not None
    (item,) = [each for each in found.items if each.label == label]
    source = at_cursor(textwrap.dedent(text)).document.text
    new = item.snippet if snippets and item.snippet is not None else item.text
    return (source[: found.span.start] + new + source[found.span.end :]).rstrip("\n")


def test_xml_has_the_tags_and_attributes_of_ros2() -> None:
    assert offered(XML + "<launch><let name='a' value='b'/><$0</launch>")[:5] == [
        "node",
        "include",
        "arg",
        "let",
        "group",
    ]
    assert "rosparam" not in offered(XML + "<launch><let name='a' value='b'/><$0</launch>")
    attributes = offered(XML + "<launch><node pkg='p' exec='talker' $0/></launch>")
    assert attributes[:3] == ["name", "namespace", "args"]
    assert "type" not in attributes
    assert "ns" not in attributes
    assert offered(XML + "<launch><arg name='a'/><node pkg='p' exec='$0'/></launch>")[:2] == ["talker", "listener"]
    assert "from" not in offered(XML + "<launch><node pkg='p' exec='t'><param name='x' $0/></node></launch>")
    assert offered(XML + "<launch><node pkg='p' exec='t'><param name='x' type='$0'/></node></launch>")[0] == "str"


def test_substitutions_of_ros2_nest() -> None:
    begin = XML + "<launch><let name='a' value='b'/><arg name='c' default='1'/><let name='d' value='"
    commands = items(begin + "$$0'/></launch>")
    assert "$(var name [default])" in commands
    assert not any(label.startswith(("$(arg", "$(find ")) for label in commands)
    assert offered(begin + "$(var $0'/></launch>") == ["a", "c"]
    assert offered(begin + "$(find-pkg-share $0'/></launch>") == ["p"]
    assert offered(begin + "$(find-pkg-share $(var $0))'/></launch>") == ["a", "c"]
    assert "equals" in offered(begin + "$(not $($0'/></launch>")
    assert applied(begin + "$(not $(var $0))'/></launch>", "c").endswith("$(not $(var c))'/></launch>")
    assert applied(begin + "$0'/></launch>", "$(var a)").endswith("value='$(var a)'/></launch>")
    # What is closed is left: text follows.
    assert offered(begin + "$(var a)$0'/></launch>", '"') == []


def test_arguments_of_an_included_file_in_both_formats() -> None:
    include = "<launch><let name='x' value='1'/><include file='/inner.launch.xml'><arg name='$0'/></include></launch>"
    assert [(i.label, i.detail) for i in items(XML + include + INNER).values()] == [
        ("robot", "required"),
        ("rate", "default: 10"),
    ]
    yaml = (
        "launch:\n- include:\n    file: /inner.launch.xml\n    arg:\n    - name: robot\n      value: x\n    - name: $0"
    )
    assert offered(YAML + yaml + INNER) == ["rate"]


@pytest.mark.parametrize(
    ("text", "first"),
    [
        ("$0", ["launch"]),
        ("lau$0", ["launch"]),
        ("launch:\n- $0", ["node", "include", "arg"]),
        ("launch:\n- no$0", ["node", "include", "arg"]),
        ("launch:\n  - no$0\n  - arg:\n      name: a\n", ["node", "include", "arg"]),
        ("launch:\n  - node:\n      $0", ["pkg", "exec", "name"]),
        ("launch:\n  - node:\n      pkg: p\n      $0\n  - arg:\n      name: a\n", ["exec", "name", "namespace"]),
        ("launch:\n  - node:\n      pkg: p\n      ex$0", ["exec", "name", "namespace"]),
        ("launch:\n  - node:\n      pkg: $0", ["p"]),
        ("launch:\n  - node:\n      pkg: p\n      exec: ta$0", ["talker", "listener"]),
        ("launch:\n  - node:\n      pkg: p\n      exec: '$0'", ["talker", "listener"]),
        ("launch:\n  - node:\n      pkg: p\n      param:\n        - $0", ["name", "value", "type"]),
        ("launch:\n  - node:\n      pkg: p\n      param:\n      - name: a\n        $0", ["value", "type"]),
        ("launch:\n  - node:\n      param:\n      - name: a\n        type: $0", ["str", "bool"]),
        ("launch:\n  - group:\n      - $0", ["keep", "node", "include"]),
        ("launch:\n  - group:\n      scoped: $0", ["true", "false"]),
        ("launch:\n  - timer:\n      period: 1.0\n      children:\n        - $0", ["node", "include"]),
        ("launch:\n  - node_container:\n      composable_node:\n        - pkg: p\n          $0", ["plugin", "name"]),
        ("launch:\n  - arg: {name: a}\n  - let:\n      name: b\n      value: $(var $0", ["a"]),
        ("launch:\n  - arg:\n      name: a\n  - let:\n      name: b\n      value: $(var $0", ["a"]),
        ("launch:\n  - arg:\n      name: a\n  - let:\n      name: b\n      value: x # $0", []),
        ("launch:\n  # $0", []),
        ("other:\n  - $0", []),
    ],
)
def test_places_in_yaml(text: str, first: list[str]) -> None:
    found = offered(YAML + text)
    assert found[: len(first)] == first
    assert first or not found
    assert "b" not in found


def test_what_is_inserted_in_yaml() -> None:
    node = "launch:\n- node:\n    pkg: $1\n    exec: $2\n    name: $3"
    assert applied(YAML + "launch:\n- $0", "node", snippets=True) == node.replace("    ", "    ")
    assert applied(YAML + "launch:\n- n$0", "node") == "launch:\n- node:"
    assert applied(YAML + "launch:\n- n$0:\n    pkg: p", "node") == "launch:\n- node:\n    pkg: p"
    assert applied(YAML + "launch:\n  $0", "node").endswith("\n  - node:")
    assert applied(YAML + "launch:\n- node:\n    $0", "pkg") == "launch:\n- node:\n    pkg: "
    assert applied(YAML + "launch:\n- node:\n    $0", "output", snippets=True).endswith("output: $1")
    param = applied(YAML + "launch:\n- node:\n    $0", "param", snippets=True)
    assert param.endswith("    param:\n  - name: $1\n    value: $2"), "an editor indents the lines like the first"
    assert applied(YAML + "launch:\n- node:\n    pkg: p # x\n    exec: tal$0k # y", "talker").endswith(
        "exec: talker # y"
    )


def test_blanks_in_yaml_ask_only_where_something_begins() -> None:
    assert offered(YAML + "launch:\n- node:\n    pkg: $0", " ") == ["p"]
    assert offered(YAML + "launch:\n- $0", " ")[0] == "node"
    assert offered(YAML + "launch:\n- node:\n    $0", " ") == []
    assert offered(YAML + "launch:\n- node:\n    name: a $0", " ") == []


INTERFACES = """
//- interfaces
{"/n": {"publishers": {"chatter": "std_msgs/msg/String"}, "params": {"rate": 10.0, "frame": "map", "name": null}},
 "/m": {"subscribers": {"words": "std_msgs/msg/String"}}}
"""


@pytest.mark.parametrize(
    "begin",
    [
        XML + "<launch><node pkg='p' exec='m' name='m'/><node pkg='p' exec='t' name='n'>{}</node></launch>",
        YAML + "launch:\n- node: {{pkg: p, exec: m, name: m}}\n- node:\n    pkg: p\n    exec: t\n    name: n\n{}",
    ],
)
def test_names_that_a_node_uses(begin: str) -> None:
    xml = "xml" in begin
    written = (
        "<param name='rate' value='1.0'/><param name='$0'/>"
        if xml
        else ("    param:\n    - name: rate\n      value: 1.0\n    - name: $0")
    )
    found = items(begin.format(written) + INTERFACES)
    assert [(i.label, i.detail) for i in found.values()] == [("frame", "string, default map"), ("name", "no default")]
    written = "<remap from='$0'/>" if xml else "    remap:\n    - from: $0"
    assert [(i.label, i.detail) for i in items(begin.format(written) + INTERFACES).values()] == [
        ("chatter", "std_msgs/msg/String, publishes")
    ]
    written = "<remap from='chatter' to='/$0'/>" if xml else "    remap:\n    - from: chatter\n      to: /$0"
    assert offered(begin.format(written) + INTERFACES) == ["/words"] if xml else True


@given(
    st.lists(
        st.sampled_from(
            [
                "launch:",
                "\n",
                "  ",
                "- ",
                "node:",
                "param:",
                "name: a",
                ": ",
                "$(var ",
                "'",
                '"',
                "#",
                "{",
                "-",
                "x",
                "|",
                "\t",
            ]
        ),
        max_size=25,
    ),
    st.integers(0, 60),
    st.sampled_from([None, *TRIGGERS]),
)
def test_nothing_that_is_typed_in_yaml_raises(pieces: list[str], cursor: int, trigger: str | None) -> None:
    text = "".join(pieces)
    fixture = YAML + text[:cursor] + "$0" + text[cursor:]
    found, there = completed(fixture, trigger), at_cursor(textwrap.dedent(fixture))
    if found is not None:
        assert found.span.start <= there.offset <= found.span.end
        assert "\n" not in there.text(found.span)
