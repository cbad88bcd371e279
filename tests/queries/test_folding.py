"""What can be folded."""

from __future__ import annotations

import textwrap

from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.launch.ros1_xml import read_ros1
from preflight_analysis.queries.folding import folds


def folded(text: str) -> list[tuple[str, int, int]]:
    """Kind, first and last line, counted from 0."""
    return [
        (f.kind, f.start, f.end) for f in folds(read_ros1(parse_xml("/a.launch", textwrap.dedent(text).lstrip("\n"))))
    ]


def test_elements_comments_and_regions() -> None:
    assert folded("""
        <launch>
          <!-- two
               lines -->
          <!-- #region cameras -->
          <node
            pkg="p"/>
          <!-- #endregion -->
          <group>
            <param name="a" value="1"/>
          </group>
          <node pkg="p">
          </node>
          <arg name="a"/>
        </launch>
    """) == [
        ("element", 0, 12),
        ("comment", 1, 2),
        ("region", 3, 6),
        ("element", 4, 5),
        ("element", 7, 8),
    ]


def test_an_end_tag_behind_something_else_is_folded_away() -> None:
    assert folded("<launch>\n<group>\n<arg name='a'/></group></launch>\n") == [("element", 0, 2), ("element", 1, 2)]


def test_a_file_that_does_not_parse() -> None:
    assert folded("""
        <launch>
          <group>
            <param name="a"
                   value="1
          <node pkg="p">
            <remap from="a"

    """) == [("element", 0, 5), ("element", 1, 3), ("element", 2, 3), ("element", 4, 5)]
    assert folded("") == []


def test_elements_nested_without_end() -> None:
    assert len(folded("<a>" * 5000 + "\n" + "</a>\n" * 5000)) == 4999
