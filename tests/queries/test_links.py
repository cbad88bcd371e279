"""What can be followed to another file."""

from __future__ import annotations

from pathlib import Path

from preflight_analysis.queries.links import links
from support.query_harness import at_cursor


def linked(text: str) -> list[tuple[str, str]]:
    """What is underlined, and where it leads to."""
    there = at_cursor(text)
    return [(there.text(link.span), link.path) for link in links(there.analysis, there.file)]


def test_what_names_a_file_that_is_there(tmp_path: Path) -> None:
    for name in ("a.launch", "b.yaml", "c.rviz", "d.txt"):
        (tmp_path / name).write_text("<launch/>" if name == "a.launch" else "x: 1")
    find = f"$(find {tmp_path.name})"
    assert linked(f"""
        <launch>
          <arg name="kind" default="a"/>
          <arg name="config" default="{find}/b.yaml"/>
          <include file="{find}/$(arg kind).launch"/>
          <rosparam file="$(arg config)"/>
          <param name="x" textfile="{find}/d.txt"/>
          <param name="y" value="{tmp_path}/d.txt"/>
          <node pkg="p" type="t" name="n" args="-d {find}/c.rviz _file:={find}/d.txt {find}/gone"/>
          <group if="false"><include file="{find}/a.launch"/></group>
          <param name="url" value="http://example.org/d.txt"/>
          <param name="folder" value="{find}"/>
        </launch>
        //- {tmp_path}/package.xml
        <package/>
    """) == [
        (f"{find}/b.yaml", f"{tmp_path}/b.yaml"),
        (f"{find}/$(arg kind).launch", f"{tmp_path}/a.launch"),
        ("$(arg config)", f"{tmp_path}/b.yaml"),
        (f"{find}/d.txt", f"{tmp_path}/d.txt"),
        (f"{tmp_path}/d.txt", f"{tmp_path}/d.txt"),
        (f"{find}/c.rviz", f"{tmp_path}/c.rviz"),
        (f"{find}/d.txt", f"{tmp_path}/d.txt"),
        (f"{find}/a.launch", f"{tmp_path}/a.launch"),
    ]


def test_a_file_that_does_not_parse(tmp_path: Path) -> None:
    (tmp_path / "a.launch").write_text("<launch/>")
    find = f"$(find {tmp_path.name})"
    text = f"<launch>\n  <include file='{find}/a.launch'\n  <node\n//- {tmp_path}/package.xml\n<package/>"
    assert linked(text) == [(f"{find}/a.launch", f"{tmp_path}/a.launch")]
