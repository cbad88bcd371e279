"""Rename of parameters and topics through launch files, parameter files and remaps, and the refusals."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.queries.rename import RenameRefusedError, prepare, rename
from support.workspace_harness import create_workspace


def renamed(tmp_path: Path, text: str, new: str, build_type: str | None = None) -> dict[str, str]:
    """The lines that a rename changes, as they are after it, by file."""
    workspace = create_workspace(tmp_path, text, build_type=build_type)
    assert prepare(workspace.context, workspace.offset) is not None
    texts = workspace.edited(rename(workspace.context, workspace.offset, new))
    return {
        name: "\n".join(
            line.strip()
            for line, old in zip(text.split("\n"), (tmp_path / name).read_text().split("\n"), strict=True)
            if line != old
        )
        for name, text in texts.items()
    }


def refused(tmp_path: Path, text: str, new: str = "other") -> str:
    workspace = create_workspace(tmp_path, text)
    with pytest.raises(RenameRefusedError) as refusal:
        rename(workspace.context, workspace.offset, new)
    return str(refusal.value)


REMAPS = """
    <launch>
      <group ns="lab">
        <node pkg="p" type="t" name="talker"><remap from="chatter" to="wor$0ds"/></node>
        <node pkg="p" type="l" name="listener"><remap from="in" to="/lab/words"/></node>
      </group>
      <include file="{folder}/inc.launch"/>
    </launch>
    //- inc.launch
    <launch>
      <node pkg="p" type="l" name="other"><remap from="in" to="lab/words"/></node>
      <node pkg="p" type="l" name="deaf"><remap from="in" to="words"/></node>
    </launch>
    //- interfaces
    {"/lab/talker": {"publishers": {"chatter": "std_msgs/String"}},
     "/lab/listener": {"subscribers": {"in": "std_msgs/String"}},
     "/other": {"subscribers": {"in": "std_msgs/String"}}%s}
"""


def test_a_topic_that_all_nodes_have_by_a_remap(tmp_path: Path) -> None:
    assert renamed(tmp_path, REMAPS % "", "speech") == {
        "main.launch": '<node pkg="p" type="t" name="talker"><remap from="chatter" to="speech"/></node>\n'
        '<node pkg="p" type="l" name="listener"><remap from="in" to="/lab/speech"/></node>',
        "inc.launch": '<node pkg="p" type="l" name="other"><remap from="in" to="lab/speech"/></node>',
    }


def test_a_global_name_for_a_relative_one(tmp_path: Path) -> None:
    assert renamed(tmp_path, REMAPS % "", "/speech") == {
        "main.launch": '<node pkg="p" type="t" name="talker"><remap from="chatter" to="/speech"/></node>\n'
        '<node pkg="p" type="l" name="listener"><remap from="in" to="/speech"/></node>',
        "inc.launch": '<node pkg="p" type="l" name="other"><remap from="in" to="speech"/></node>',
    }


def test_a_topic_that_a_node_names_itself(tmp_path: Path) -> None:
    own = ', "/lab/loud": {"subscribers": {"words": "std_msgs/String"}}'
    text = REMAPS.replace("</group>", '<node pkg="p" type="x" name="loud"/></group>') % own
    assert refused(tmp_path / "a", text) == "/lab/loud uses '/lab/words' without a remap, at main.launch:5"
    taken = own.replace("words", "speech")
    text = REMAPS.replace("</group>", '<node pkg="p" type="x" name="loud"/></group>') % taken
    assert refused(tmp_path / "b", text, "speech") == "'/lab/speech' exists already: /lab/loud uses it"


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ('to="/lab/words"', 'to="/lab/$(env NO)words"', "comes from a substitution"),
        ('"chatter" to="wor$0ds"', '"chat$0ter" to="words"', "is the name that /lab/talker itself uses"),
    ],
)
def test_a_topic_that_is_left_alone(tmp_path: Path, before: str, after: str, message: str) -> None:
    text = (REMAPS % "").replace(before, after).replace("$(env NO)", "$(optenv NO_SUCH_NAME)")
    assert message in refused(tmp_path, text)


SHOWN = """
    <launch>
      <node pkg="p" exec="laser" name="laser"><remap from="scan" to="/front/s$0can"/></node>
      <node pkg="rviz2" exec="rviz2" name="rviz" args="-d {folder}/p/a.rviz"/>
      PARAM
    </launch>
    //- p/a.rviz
    Visualization Manager:
      Displays:
        - {Class: rviz_default_plugins/LaserScan, Enabled: true, Name: /front/scan, Topic: {Value: /front/scan}}
        - {Class: rviz_default_plugins/LaserScan, Enabled: true, Name: B, Topic: {Value: /back/scan}}
        - {Class: rviz_default_plugins/LaserScan, Enabled: false, Name: C, Topic: {Value: "/front/scan"}}
        - {Class: rviz_default_plugins/LaserScan, Enabled: false, Name: D, Topic: {Value: scan}}
    //- interfaces
    {"/laser": {"publishers": {"scan": "sensor_msgs/msg/LaserScan"}}}
"""


def test_a_topic_that_rviz_shows(tmp_path: Path) -> None:
    texts = renamed(tmp_path, SHOWN.replace("      PARAM\n", ""), "/front/scan_raw", "ament_cmake")
    assert 'to="/front/scan_raw"' in texts["main.launch"]
    first, second = texts["p/a.rviz"].split("\n")
    assert first.endswith("Name: /front/scan, Topic: {Value: /front/scan_raw}}")
    assert second.endswith('Name: C, Topic: {Value: "/front/scan_raw"}}')


def test_a_topic_that_rviz_shows_in_another_launch(tmp_path: Path) -> None:
    rviz = '<node pkg="rviz2" exec="rviz2" name="rviz" args="-d {folder}/p/a.rviz"/>'
    other = f"//- other.launch\n    <launch>{rviz}</launch>\n    //- interfaces"
    text = SHOWN.replace("      PARAM\n", "").replace("//- interfaces", other)
    workspace = create_workspace(tmp_path, text, build_type="ament_cmake")
    with pytest.raises(RenameRefusedError) as why:
        rename(workspace.context, workspace.offset, "/front/scan_raw")
    assert str(why.value).startswith("/rviz uses '/front/scan' without a remap, at main.launch:3")


AMCL = '<node pkg="nav2_amcl" exec="amcl" name="amcl"><param name="scan_topic" value="VALUE"/></node>'


@pytest.mark.parametrize("value", ["/front/scan", "front/scan"])
def test_a_topic_that_a_parameter_names(tmp_path: Path, value: str) -> None:
    text = SHOWN.replace("PARAM", AMCL.replace("VALUE", value))
    found = renamed(tmp_path, text, "/front/scan_raw", "ament_cmake")["main.launch"]
    assert f'<param name="scan_topic" value="{value}_raw"/>' in found


def test_a_topic_name_that_is_none(tmp_path: Path) -> None:
    assert "is not a topic name" in refused(tmp_path, REMAPS % "", "5 words")


PARAMETERS = """
    <launch>
      <node pkg="p" type="t" name="talker">
        <param name="ra$0te" value="1"/>
      </node>
      <rosparam file="{folder}/params.yaml"/>
      <param name="/talker/rate" value="3"/>
      <param name="/listener/rate" value="3"/>
    </launch>
    //- params.yaml
    talker:
      rate: 2
    //- interfaces
    {"/talker": {"params": {"%s": null}}}
"""


def test_a_parameter_in_launch_and_yaml(tmp_path: Path) -> None:
    assert renamed(tmp_path, PARAMETERS % "~speed", "speed") == {
        "main.launch": '<param name="speed" value="1"/>\n<param name="/talker/speed" value="3"/>',
        "params.yaml": "speed: 2",
    }


def test_a_parameter_that_a_node_reads_by_that_name(tmp_path: Path) -> None:
    message = refused(tmp_path, PARAMETERS % "~rate", "speed")
    assert message == "/talker reads 'rate': rename it in the source first"


def test_a_parameter_that_is_there_already(tmp_path: Path) -> None:
    text = (PARAMETERS % "~speed").replace("</node>", '<param name="speed" value="1"/></node>')
    assert refused(tmp_path, text, "speed") == "'speed' is already set at main.launch:4"
    assert "is not a parameter name" in refused(tmp_path / "b", PARAMETERS % "~speed", "a b")


def test_a_parameter_of_ros2(tmp_path: Path) -> None:
    text = """
        <launch>
          <node pkg="p" exec="t" name="talker">
            <param from="{folder}/params.yaml"/>
            <param name="gains.$0p" value="1"/>
          </node>
          <node pkg="p" exec="t" name="other"><param from="{folder}/params.yaml"/></node>
        </launch>
        //- params.yaml
        /**:
          ros__parameters:
            gains: {p: 2, i: 1}
    """
    assert renamed(tmp_path, text, "kp", build_type="ament_python") == {
        "main.launch": '<param name="gains.kp" value="1"/>',
        "params.yaml": "gains: {kp: 2, i: 1}",
    }


def test_a_parameter_of_a_file_that_another_launch_reads(tmp_path: Path) -> None:
    text = """
        <launch>
          <node pkg="p" exec="t" name="talker">
            <param name="ra$0te" value="1"/>
            <param from="{folder}/params.yaml"/>
          </node>
        </launch>
        //- other.launch.xml
        <launch>
          <node pkg="p" exec="t" name="talker">
            <param from="{folder}/params.yaml"/>
            <param name="rate" value="3"/>
          </node>
        </launch>
        //- params.yaml
        talker:
          ros__parameters:
            rate: 2
    """
    workspace = create_workspace(tmp_path, text, build_type="ament_python")
    edits = rename(workspace.context, workspace.offset, "speed")
    assert [(workspace.shown(e.location), e.reason, e.indirect) for e in edits] == [
        ("main.launch:3 rate", "", False),
        ("other.launch.xml:4 rate", "Also set for nodes of other.launch.xml", True),
        ("params.yaml:3 rate", "Also set for nodes of other.launch.xml", True),
    ]


def test_a_topic_in_a_file_that_another_launch_includes(tmp_path: Path) -> None:
    text = (REMAPS % "").replace(
        "//- inc.launch",
        """//- second.launch
    <launch>
      <include file="{folder}/inc.launch"/>
      <node pkg="p" type="t" name="speaker" ns="lab"><remap from="chatter" to="words"/></node>
    </launch>
    //- inc.launch""",
    )
    found = renamed(tmp_path, text, "speech")
    assert found["second.launch"].count('to="speech"') == 1
    assert sorted(found) == ["inc.launch", "main.launch", "second.launch"]
