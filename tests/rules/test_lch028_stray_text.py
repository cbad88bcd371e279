"""LCH028: text between tags."""

import pytest
from support.check import check


def test_text_between_tags_means_nothing() -> None:
    findings = check("""
        <launch>
          node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[LCH028] means nothing: roslaunch does not look at it; is a '<'
          <group ns="a">
            # the front camera
            ^^^^^^^^^^^^^^^^^^ hint[LCH028] the text '# the front camera' in <group> means nothing
            <node pkg="p" type="t" name="m"/>
          </group>
          <param name="x" value="1">2</param>
                                    ^ warning[LCH028] the text '2' in <param>
          <![CDATA[
            node pkg="p" type="t" name="o">
            ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH028] means nothing: roslaunch does not look at it
          ]]>
        </launch>
    """)
    titles = [fix.title for finding in findings for fix in finding.fixes]
    assert titles == ["Insert the '<'", "Make it a comment"]


@pytest.mark.silent
def test_text_of_rosparam_and_comments_is_meant() -> None:
    check("""
        <launch>
          <!-- node pkg="p" -->
          <rosparam>{rate: 5}</rosparam>
          <node pkg="p" type="t" name="n">
            <rosparam>
              # the front camera
              rate: 5
            </rosparam>
          </node>
        </launch>
    """)
