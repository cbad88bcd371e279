"""The table of the roslaunch language: complete in itself, and what evaluation checks against."""

import pytest
from preflight_analysis.launch.schema import one_of
from preflight_analysis.launch.schema_ros1 import TAGS
from support.check import check


@pytest.mark.parametrize("name", TAGS)
def test_each_tag_and_attribute_says_what_it_is(name: str) -> None:
    tag = TAGS[name]
    assert tag.doc.endswith(".")
    assert set(tag.children) <= set(TAGS)
    assert not set(tag.refused) & {*tag.attributes, *tag.children}
    for attribute in tag.attributes.values():
        assert attribute.doc.endswith("."), attribute.name
        assert (attribute.kind in ("choice", "flag", "condition")) == bool(attribute.choices), attribute.name
        assert attribute.default is None or not attribute.choices or attribute.default in attribute.choices


def test_choices_in_words() -> None:
    assert one_of(("load", "dump", "delete")) == "load, dump or delete"
    assert one_of(("log", "screen")) == "log or screen"


def test_choices_are_checked_in_children_of_a_node_written_in_capitals() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <ROSPARAM command="laod">{}</ROSPARAM>
                               ^^^^ error[LCH008] invalid value 'laod' of attribute 'command' of <ROSPARAM>
            <Param name="a" value="1" if="tru"/>
                                          ^^^ error[LCH008] did you mean 'true'?
          </node>
        </launch>
    """)
