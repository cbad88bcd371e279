"""LCH022: something refers by name to a node whose name is made up anew with each launch."""

import pytest
from support.check import apply, check


def test_a_name_that_is_anonymous_and_referred_to() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="$(anon talker)"/>
          <node pkg="p" type="t" name="rviz_$(anon x)" ns="a"/>
          <node pkg="p" type="t" name="n" args="--listen /talker/chatter">
                                                ^^^^^^^^^^^^^^^^^^^^^^^^ warning[LCH022] in the arguments,
            <remap from="in" to="talker/chatter"/>
                                 ^^^^^^^^^^^^^^ warning[LCH022] the name 'talker/chatter' has no effect: the name of
          </node>
          <param name="/a/rviz_x/rate" value="10"/>
                       ^^^^^^^^^^^^^^ warning[LCH022] parameter '/a/rviz_x/rate' has no effect: the name of node
        </launch>
    """
    (_, remap, _) = check(text)
    assert 'to="$(anon talker)/chatter"' in apply(text, remap.fixes[0].edits)["/main.launch"]


@pytest.mark.silent
def test_references_that_an_anonymous_name_answers_to() -> None:
    check("""
        <launch>
          <param name="$(anon talker)/limit" value="10"/>
          <node pkg="p" type="t" name="$(anon talker)"><param name="rate" value="1"/></node>
          <node pkg="p" type="t" name="$(anon listener)"/>
          <node pkg="p" type="t" name="listener"><remap from="chatter" to="/listener/chatter"/></node>
          <node pkg="p" type="t" name="n"><remap from="talker" to="/talker"/></node>
          <node pkg="p" type="t" name="$(anon camera)"/>
          <node pkg="p" type="t" name="driver" ns="camera"><remap from="image" to="/camera/image"/></node>
        </launch>
    """)
