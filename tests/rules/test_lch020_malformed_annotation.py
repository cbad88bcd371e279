"""LCH020: an annotation that cannot be read."""

import pytest
from support.check import check


def test_an_annotation_that_cannot_be_read() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <!-- <topics><topic name="a" type="x/Y" class="both"/></topics> -->
                                                           ^^^^ warning[LCH020] allowed: pub, sub
          </node>
        </launch>
    """)


@pytest.mark.silent
def test_annotations_that_can_be_read() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <!-- <topics><topic name="/tf" type="tf2_msgs/TFMessage" class="sub"/></topics> -->
            <!-- the topics are in the manual -->
          </node>
        </launch>
    """)
