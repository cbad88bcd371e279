"""LCH028: text between tags."""

import pytest
from support.check import check


def test_text_between_tags_means_nothing() -> None:
    findings = check("""
        <launch>
          node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[LCH028] stray text 'node pkg="p" type="t" name="n"/>' in <launch>:
          <group ns="a">
            # the front camera
            ^^^^^^^^^^^^^^^^^^ hint[LCH028] stray text '# the front camera' in <group>: roslaunch ignores it
            <node pkg="p" type="t" name="m"/>
          </group>
          <param name="x" value="1">2</param>
                                    ^ warning[LCH028] stray text '2' in <param>: roslaunch ignores it
          <![CDATA[
            node pkg="p" type="t" name="o">
            ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH028] stray text 'node pkg="p" type="t" name="o">' in <launch>:
          ]]>
        </launch>
    """)
    titles = [fix.title for finding in findings for fix in finding.fixes]
    assert titles == ["Insert '<'", "Convert the text to a comment"]


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
