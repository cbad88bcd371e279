"""What values come to, behind them."""

from __future__ import annotations

from preflight_analysis.documents.span import Span
from preflight_analysis.queries.hints import Hint, hints
from preflight_analysis.workspace.sources import Sources
from support.query_harness import at_cursor


def hinted(text: str, within: Span | None = None) -> list[str]:
    """What stands before each hint on its line, and the hint."""
    there = at_cursor(text)
    source = there.document.text
    found = hints([there.analysis], there.file, within or Span(0, len(source)))
    return [source[: h.offset].rpartition("\n")[2].strip() + " " + h.label for h in found]


def only(text: str) -> Hint:
    there = at_cursor(text)
    (found,) = hints([there.analysis], there.file, Span(0, len(there.document.text)))
    return found


def test_values_with_substitutions_and_no_others() -> None:
    assert hinted("""
        <launch>
          <arg name="robot" default="husky"/>
          <arg name="on" default="1"/>
          <param name="a" value="$(arg robot)_1"/>
          <param name="b" value="plain $ text"/>
          <param name="c" value="$(eval 2 * 3)"/>
          <param name="d" value="$(arg unknown)"/>
          <param name="$(anon e)" value="1"/>
          <group if="$(arg on)"/>
          <group unless="$(eval robot == 'husky')"/>
        </launch>
    """) == [
        '<param name="a" value="$(arg robot)_1" = husky_1',
        '<param name="c" value="$(eval 2 * 3)" = 6',
        '<group if="$(arg on)" = true',
        """<group unless="$(eval robot == 'husky')" = true""",
    ]


def test_the_nodes_to_which_the_sections_of_a_parameter_file_apply() -> None:
    text = """//- /main.launch.xml
<launch>
  <node pkg="p" exec="pump" name="pump" namespace="left"><param from="/p.yaml"/></node>
  <node pkg="p" exec="pump" name="pump" namespace="right"><param from="/p.yaml"/></node>
</launch>
//- /p.yaml
/**: {ros__parameters: {a: 1}}
/left/*:
  ros__parameters: {a: 1}
left:
  pump:
    ros__parameters: {a: 1}
right:
  pumo:$0
    ros__parameters: {a: 1}
"""
    assert hinted(text) == ["/**: = /left/pump (+1)", "/left/*: = /left/pump", "pumo: = no node"]
    there = at_cursor(text)
    (found,) = hints([there.analysis], there.file, Span(there.offset - 3, there.offset))
    assert found.note == "no node that gets the file is called so; did you mean '/right/pump'?"


def test_several_contexts_show_the_first_value_and_say_so() -> None:
    found = only("""
        <launch>
          <include file="/p/inner.launch"><arg name="rate" value="5"/></include>
          <include file="/p/inner.launch"><arg name="rate" value="7"/></include>
          <include file="/p/inner.launch"><arg name="rate" value="5"/></include>
        </launch>
        //- /p/inner.launch
        <launch><arg name="rate"/><param name="x" value="$(arg rate)"/>$0</launch>
    """)
    assert found.label == "= 5 (+1)"
    assert found.values == ("5", "7")


def test_values_of_other_roots_count_as_long_as_the_text_is_the_same() -> None:
    inner = "//- /p/inner.launch\n<launch><arg name='rate'/>{}<param name='x' value='$(arg rate)'/>$0</launch>"
    root = "<launch><include file='/p/inner.launch'><arg name='rate' value='{}'/></include></launch>\n"
    sources = Sources()
    old, one, two = (
        at_cursor(root.format(rate) + inner.format(extra), sources=sources)
        for rate, extra in ((3, "<group/>"), (1, ""), (2, ""))
    )
    whole = Span(0, len(one.document.text))
    (found,) = hints([one.analysis, two.analysis, old.analysis], one.file, whole)
    assert found.values == ("1", "2")


def test_long_values_are_cut() -> None:
    assert only(f"<launch><arg name='a' default='{'x ' * 50}'/><param name='x' value='$(arg a)'/></launch>").label == (
        "= " + ("x " * 20).strip() + "…"
    )
    path = "/home/user/catkin_ws/src/robot/robot_bringup/launch/base.launch"
    found = only(f"<launch><arg name='a' default='{path}'/><param name='x' value='$(arg a)'/></launch>")
    assert found.label == "= …/robot/robot_bringup/launch/base.launch"
    assert found.values == (path,)
    assert only("<launch><arg name='a' default=''/><param name='x' value='$(arg a)'/></launch>").label == "= ''"


def test_a_range_and_a_broken_file() -> None:
    text = "<launch>\n<arg name='a' default='1'/>\n<param name='x' value='$(arg a)'/>\n<param name='y' value='$(arg a)"
    assert hinted(text) == ["<param name='x' value='$(arg a)' = 1", "<param name='y' value='$(arg a) = 1"]
    assert hinted(text, Span(0, text.index("<param name='y'"))) == ["<param name='x' value='$(arg a)' = 1"]
    assert hinted("<lau") == []
