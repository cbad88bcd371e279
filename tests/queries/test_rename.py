"""Rename: arguments over all includes, nodes with what is named after them, and the refusals."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.catalogue import launches
from preflight_analysis.queries.rename import RenameRefusedError, prepare, rename
from preflight_analysis.workspace.index import Root
from support.workspace_harness import create_workspace


def renamed(tmp_path: Path, text: str, new: str, build_type: str | None = None) -> dict[str, str]:
    """The files that a rename changes, after it; line ends as blanks."""
    workspace = create_workspace(tmp_path, text, build_type=build_type)
    texts = workspace.edited(rename(workspace.context, workspace.offset, new))
    return {name: text.replace(str(tmp_path), "") for name, text in texts.items()}


def refused(
    tmp_path: Path, text: str, new: str = "other", *, named: tuple[Root, ...] = (), build_type: str | None = None
) -> str:
    workspace = create_workspace(tmp_path, text, named=named, build_type=build_type)
    with pytest.raises(RenameRefusedError) as refusal:
        rename(workspace.context, workspace.offset, new)
    return str(refusal.value)


ARGUMENTS = """
    <launch>
      <arg name="%srate" default="1"/>
      <include file="{folder}/inc.launch"><arg name="%srate" value="$(arg rate)"/></include>
    </launch>
    //- inc.launch
    <launch>
      <arg name="%srate"/>
      <param name="rate" value="$(arg %srate)" if="$(eval rate > 0 and arg('rate') != 'rate' and rated)"/>
    </launch>
    //- other.launch
    <launch>
      <include file="{folder}/inc.launch" if="false"><arg name="rate" value="3"/></include>
    </launch>
"""


def test_an_argument_and_those_who_pass_it(tmp_path: Path) -> None:
    for number in (1, 2, 3):
        text = ARGUMENTS % tuple("$0" if n == number else "" for n in range(4))
        assert renamed(tmp_path / str(number), text, "speed") == {
            "main.launch": '<launch>\n  <arg name="rate" default="1"/>\n'
            '  <include file="/inc.launch"><arg name="speed" value="$(arg rate)"/></include>\n</launch>\n',
            "inc.launch": '<launch>\n  <arg name="speed"/>\n  <param name="rate" value="$(arg speed)" '
            "if=\"$(eval speed > 0 and arg('speed') != 'rate' and rated)\"/>\n</launch>\n",
            "other.launch": '<launch>\n  <include file="/inc.launch" if="false">'
            '<arg name="speed" value="3"/></include>\n</launch>\n',
        }


def test_the_argument_of_the_includer_only(tmp_path: Path) -> None:
    assert renamed(tmp_path, ARGUMENTS % ("$0", "", "", ""), "speed") == {
        "main.launch": '<launch>\n  <arg name="speed" default="1"/>\n'
        '  <include file="/inc.launch"><arg name="rate" value="$(arg speed)"/></include>\n</launch>\n'
    }


def test_the_whole_chain_that_hands_it_on(tmp_path: Path) -> None:
    text = """
        <launch>
          <arg name="rate" default="1"/>
          <include file="{folder}/between.launch" pass_all_args="true"/>
        </launch>
        //- between.launch
        <launch>
          <include file="{folder}/inc.launch" pass_all_args="true"/>
        </launch>
        //- inc.launch
        <launch>
          <arg name="ra$0te"/>
        </launch>
        //- third.launch
        <launch>
          <include file="{folder}/inc.launch"><arg name="rate" value="1"/></include>
        </launch>
        """
    texts = renamed(tmp_path, text, "speed")
    assert sorted(texts) == ["inc.launch", "main.launch", "third.launch"]
    assert all('name="speed"' in text and "rate" not in text for text in texts.values())


def test_one_include_of_several_files(tmp_path: Path) -> None:
    texts = renamed(
        tmp_path,
        """
        <launch>
          <arg name="robot" default="a"/>
          <include file="{folder}/$(arg robot).xml"><arg name="rate" value="1"/></include>
        </launch>
        //- up.launch
        <launch><include file="{folder}/main.launch"><arg name="robot" value="b"/></include></launch>
        //- down.launch
        <launch><include file="{folder}/main.launch"/></launch>
        //- a.xml
        <launch><arg name="$0rate"/></launch>
        //- b.xml
        <launch><arg name="rate"/></launch>
        """,
        "speed",
    )
    assert sorted(texts) == ["a.xml", "b.xml", "main.launch"]


MANAGED = """
    <launch>
      <node pkg="nav2_map_server" exec="map_server" name="map_s$0erver"/>
      <node pkg="nav2_amcl" exec="amcl" name="amcl"/>
      <node pkg="nav2_lifecycle_manager" exec="lifecycle_manager" name="manager">
        PARAM
      </node>
    </launch>
    //- m.yaml
    manager:
      ros__parameters:
        node_names: ['map_server', "amcl"]
        bond_timeout: 0.0  # of map_server
"""


@pytest.mark.parametrize(
    ("param", "file", "after"),
    [
        ('<param name="node_names" value="[map_server, amcl]"/>', "main.launch", 'value="[maps, amcl]"'),
        (
            '<param from="{folder}/m.yaml"/>',
            "m.yaml",
            "node_names: ['maps', \"amcl\"]\n    bond_timeout: 0.0  # of map_s",
        ),
        ('<param name="node_names"><param name="x" value="map_server"/></param>', "main.launch", 'value="map_server"'),
    ],
)
def test_a_node_whose_lifecycle_another_one_manages(tmp_path: Path, param: str, file: str, after: str) -> None:
    texts = renamed(tmp_path, MANAGED.replace("PARAM", param), "maps", "ament_cmake")
    assert 'exec="map_server" name="maps"' in texts["main.launch"]
    assert after in texts[file]


def test_a_managed_node_whose_name_is_made_up(tmp_path: Path) -> None:
    text = MANAGED.replace("PARAM", '<param name="node_names" value="[$(var which), amcl]"/>').replace(
        "<launch>", '<launch>\n      <arg name="which" default="map_server"/>'
    )
    assert refused(tmp_path, text, "maps", build_type="ament_cmake") == (
        "The value at main.launch:6 contains the node's name by a substitution: rename it by hand"
    )


@pytest.mark.parametrize("new", ["", "a b", "1x", "a-b", "~x", "a/b", "ä", "_x", "true", "lambda", "pi"])
def test_names_that_are_none_for_an_argument(tmp_path: Path, new: str) -> None:
    assert f"'{new}' is not a valid argument name" in refused(tmp_path, '<launch><arg name="$0x"/></launch>', new)


def test_arguments_that_are_there_already(tmp_path: Path) -> None:
    text = ARGUMENTS % ("", "", "$0", "")
    here = text.replace('name="$0rate"/>', 'name="$0rate"/><arg name="speed" default="1"/>')
    assert refused(tmp_path / "a", here, "speed") == "Duplicate argument 'speed', declared at inc.launch:2"
    there = text.replace('value="$(arg rate)"/></include>', 'value="1"/><arg name="speed" value="2"/></include>')
    assert refused(tmp_path / "b", there, "speed") == "Duplicate argument 'speed', declared at main.launch:3"


def test_arguments_that_cannot_be_renamed(tmp_path: Path) -> None:
    unknown = '<launch><include file="$(arg nothing)"><arg name="$0x" value="1"/></include></launch>'
    assert "the include is unresolved" in refused(tmp_path / "a", unknown)
    missing = '<launch><include file="/none.launch"><arg name="$0x" value="1"/></include></launch>'
    assert "/none.launch cannot be read" in refused(tmp_path / "b", missing)
    assert "has no name yet" in refused(tmp_path / "e", '<launch><arg name="$0"/></launch>')
    entity = '<launch><arg name="$0x"/><param name="a" value="1" if="$(eval x &gt; 1)"/></launch>'
    assert "cannot be replaced at main.launch:1" in refused(tmp_path / "c", entity)
    root = Root.of(str(tmp_path / "d/main.launch"), {"x": "1"})
    settings = refused(tmp_path / "d", '<launch><arg name="$0x"/></launch>', named=(root,))
    assert "the project's settings give it to main.launch" in settings


@pytest.mark.parametrize(
    ("tag", "message"),
    [
        (
            '<node pkg="$0p" type="t" name="n"/>',
            "This is a package: only arguments, nodes, parameters and topics can be renamed here",
        ),
        ('<remap from="$0a" to="b"/>', "'a' is a name of the node itself: rename it in the source"),
        ('<param name="$0a$(env HOME)" value="b"/>', "comes from a substitution"),
        ('<include file="$0a"/>', "This is a launch file"),
    ],
)
def test_what_cannot_be_renamed(tmp_path: Path, tag: str, message: str) -> None:
    assert message in refused(tmp_path, f"<launch>\n{tag}\n</launch>")


def test_nothing_to_rename(tmp_path: Path) -> None:
    workspace = create_workspace(tmp_path, "<launch>\n $0\n</launch>")
    assert prepare(workspace.context, workspace.offset) is None


NODES = """
    <launch>
      <param name="/lab/talker/rate" value="1"/>
      <group ns="lab">
        <rosparam>{talker: {y: 1, z: 2}, talkers: 1}</rosparam>
        <rosparam ns="talker">w: 1</rosparam>
        <node pkg="p" type="t" name="talker$0"><param name="own" value="talker"/><remap from="a" to="~talker"/></node>
        <include file="{folder}/inc.launch"/>
      </group>
    </launch>
    //- inc.launch
    <launch>
      <node pkg="p" type="t" name="listener">
        <!-- <topics><topic name="talker/chatter" type="std_msgs/String" class="sub"/></topics> -->
        <remap from="chatter" to="talker/chatter"/>
        <remap from="b" to="/lab/talker"/>
        <remap from="c" to="/talker/c"/>
      </node>
      <node pkg="nodelet" type="nodelet" name="let" args="load p/Let talker --talker"/>
    </launch>
"""


def test_a_node_and_what_is_named_after_it(tmp_path: Path) -> None:
    assert renamed(tmp_path, NODES, "speaker") == {
        "main.launch": """<launch>
  <param name="/lab/speaker/rate" value="1"/>
  <group ns="lab">
    <rosparam>{speaker: {y: 1, z: 2}, talkers: 1}</rosparam>
    <rosparam ns="speaker">w: 1</rosparam>
    <node pkg="p" type="t" name="speaker"><param name="own" value="talker"/><remap from="a" to="~talker"/></node>
    <include file="/inc.launch"/>
  </group>
</launch>
""",
        "inc.launch": """<launch>
  <node pkg="p" type="t" name="listener">
    <!-- <topics><topic name="speaker/chatter" type="std_msgs/String" class="sub"/></topics> -->
    <remap from="chatter" to="speaker/chatter"/>
    <remap from="b" to="/lab/speaker"/>
    <remap from="c" to="/talker/c"/>
  </node>
  <node pkg="nodelet" type="nodelet" name="let" args="load p/Let speaker --talker"/>
</launch>
""",
    }


def test_a_node_that_has_an_alternative(tmp_path: Path) -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="$0talker" if="true"/>
          <node pkg="p" type="sim" name="talker" unless="true"/>
          <node pkg="p" type="sim" name="talker" ns="lab"/>
        </launch>
        """
    assert renamed(tmp_path, text, "speaker")["main.launch"].count("speaker") == 2


def test_a_node_of_a_file_that_is_included_twice(tmp_path: Path) -> None:
    text = """
        <launch>
          <include ns="a" file="{folder}/inc.launch"/>
          <include ns="b" file="{folder}/inc.launch"/>
          <param name="a/talker/x" value="1"/>
          <param name="/b/talker/x" value="1"/>
        </launch>
        //- inc.launch
        <launch><node pkg="p" type="t" name="$0talker"/></launch>
        """
    texts = renamed(tmp_path, text, "speaker")
    assert texts["inc.launch"].count("speaker") == 1
    assert texts["main.launch"].count("speaker") == 2


def test_roots_that_were_not_analysed_are_looked_at(tmp_path: Path) -> None:
    text = """
        <launch><include file="{folder}/inc.launch"/></launch>
        //- second.launch
        <launch><include ns="b" file="{folder}/inc.launch"/><param name="/b/talker/x" value="1"/></launch>
        //- inc.launch
        <launch><node pkg="p" type="t" name="$0talker"/></launch>
        """
    workspace = create_workspace(tmp_path, text, analysed=1)
    assert len(workspace.context.trees) == 1
    assert sorted(workspace.edited(rename(workspace.context, workspace.offset, "speaker"))) == [
        "inc.launch",
        "second.launch",
    ]


@pytest.mark.parametrize("new", ["", "a b", "1x", "a/b", "~a", "/a", "a-b"])
def test_names_that_are_none_for_a_node(tmp_path: Path, new: str) -> None:
    assert f"'{new}' is not a valid node name" in refused(tmp_path, NODES, new)


def test_nodes_that_are_there_already(tmp_path: Path) -> None:
    assert refused(tmp_path, NODES, "listener") == "Duplicate node name '/lab/listener', used at inc.launch:2"


@pytest.mark.parametrize(
    ("tags", "message"),
    [
        ('<arg name="n" default="x"/><node pkg="p" type="t" name="$0$(arg n)"/>', "a substitution is part of its name"),
        ('<node pkg="p" type="t" name="$0"/>', "has no name yet"),
        ('<node pkg="p" type="t" name="$0a"/><node pkg="p" type="t" name="b" ns="a"/>', "namespace of '/a/b'"),
        (
            '<node pkg="p" type="t" name="$0a"/><group ns="a"><param name="b" value="1"/></group>',
            "node's name by a substitution",
        ),
        (
            '<arg name="n" default="a"/><node pkg="p" type="t" name="$0a"/><param name="$(arg n)/x" value="1"/>',
            "by hand",
        ),
        (
            '<remap from="x" to="a/x"/><node pkg="p" type="t" name="$0a"/><node pkg="p" type="t" name="b" ns="c"/>'
            '<node pkg="p" type="t" name="a" ns="c"/>',
            "node's name by a substitution",
        ),
    ],
)
def test_nodes_that_cannot_be_renamed(tmp_path: Path, tags: str, message: str) -> None:
    assert message in refused(tmp_path, f"<launch>{tags}</launch>")


def test_a_node_that_another_root_starts_from_another_file(tmp_path: Path) -> None:
    text = """
        <launch>
          <arg name="real" default="true"/>
          <include file="{folder}/real.xml" if="$(arg real)"/>
          <include file="{folder}/false.xml" unless="$(arg real)"/>
        </launch>
        //- up.launch
        <launch><include file="{folder}/main.launch"><arg name="real" value="false"/></include>
        <include file="{folder}/real.xml" ns="x"/></launch>
        //- down.launch
        <launch><include file="{folder}/main.launch"/></launch>
        //- real.xml
        <launch><node pkg="p" type="t" name="$0talker"/></launch>
        //- false.xml
        <launch><node pkg="p" type="t" name="talker"/></launch>
        """
    assert "the name is ambiguous" in refused(tmp_path, text)


def test_in_a_file_that_does_not_parse(tmp_path: Path) -> None:
    text = """
        <launch>
          <arg name="ra$0te"/>
          <param name="a" value="$(arg rate)"
          <node pkg="p" type="t" name="$(arg rate)"
        """
    assert renamed(tmp_path, text, "speed")["main.launch"].count("speed") == 3


def test_the_catalogue_s_files_are_not_edited(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    data = tmp_path / "catalogue"
    file = data / "noetic" / "scanner" / "launch" / "scan.launch.json"
    file.parent.mkdir(parents=True)
    file.write_text('[\n["makers/scanner", "0123456", "2024-01-01", 1],\n[0, "arg", {"name": "frame"}]\n]\n')
    monkeypatch.setattr(launches, "LAUNCHES", data)
    launches.launch_files_of.cache_clear()
    text = (
        '<launch><include file="$(find scanner)/launch/scan.launch"><arg name="$0frame" value="x"/></include></launch>'
    )
    assert "cannot be" in refused(tmp_path / "ws", text)
    launches.launch_files_of.cache_clear()


LEAKS = """
    <launch>
      <arg name="spe$0ed" default="0.4"/>
      <include file="{folder}/b.launch.py"/>
      <log message="$(var speed)"/>
    </launch>
    //- two.launch.xml
    <launch>
      <arg name="speed" default="0.5"/>
      <include file="{folder}/b.launch.py"/>
    </launch>
    //- b.launch.py
    from launch import LaunchDescription
    from launch.actions import DeclareLaunchArgument

    def generate_launch_description():
        return LaunchDescription([DeclareLaunchArgument('%s', default_value='1')])
"""


def test_files_that_include_a_third_do_not_share_what_that_has_nothing_to_do_with(tmp_path: Path) -> None:
    texts = renamed(tmp_path, LEAKS % "use_sim_time", "velocity", "ament_python")
    assert list(texts) == ["main.launch"]
    assert texts["main.launch"].count("velocity") == 2


def test_an_argument_that_no_include_passes_is_that_of_all_who_read_it(tmp_path: Path) -> None:
    workspace = create_workspace(tmp_path, LEAKS % "speed", build_type="ament_python")
    edits = rename(workspace.context, workspace.offset, "velocity")
    assert sorted(workspace.edited(edits)) == ["b.launch.py", "main.launch", "two.launch.xml"]
    assert {(e.label, e.reason) for e in edits if e.indirect} == {
        (
            "Argument 'speed' of b.launch.py",
            "Shared with main.launch: no include between them passes it by name",
        ),
        (
            "Argument 'speed' of two.launch.xml",
            "Shared with b.launch.py: no include between them passes it by name",
        ),
    }


def test_an_argument_that_is_passed_is_another_one(tmp_path: Path) -> None:
    text = (LEAKS % "speed").replace(
        '<include file="{folder}/b.launch.py"/>',
        '<include file="{folder}/b.launch.py"><arg name="speed" value="$(var speed)"/></include>',
    )
    texts = renamed(tmp_path / "a", text, "velocity", "ament_python")
    assert list(texts) == ["main.launch"]
    assert '<arg name="speed" value="$(var velocity)"/>' in texts["main.launch"]
    assert "$(var velocity)" in texts["main.launch"].split("</include>")[1]
    of_b = text.replace("$0", "").replace("DeclareLaunchArgument('", "DeclareLaunchArgument('$0")
    texts = renamed(tmp_path / "b", of_b, "velocity", "ament_python")
    assert sorted(texts) == ["b.launch.py", "main.launch", "two.launch.xml"]
    assert '<arg name="speed" default="0.4"/>' in texts["main.launch"]
    assert '<arg name="velocity" value="$(var speed)"/>' in texts["main.launch"]
    assert "$(var speed)" in texts["main.launch"].split("</include>")[1]


def test_what_an_include_sets_is_read_after_it(tmp_path: Path) -> None:
    text = """
        <launch>
          <include file="{folder}/a.launch.xml"><arg name="speed" value="2"/></include>
          %s<include file="{folder}/b.launch.xml"/>%s
          <log message="$(var speed)"/>
        </launch>
        //- a.launch.xml
        <launch><arg name="spe$0ed"/></launch>
        //- b.launch.xml
        <launch><arg name="speed" default="1"/></launch>
        """
    texts = renamed(tmp_path / "a", text % ("", ""), "velocity", "ament_python")
    assert sorted(texts) == ["a.launch.xml", "b.launch.xml", "main.launch"]
    assert texts["main.launch"].count("velocity") == 2
    reset = text % ('<group forwarding="false">', "</group>")
    texts = renamed(tmp_path / "b", reset.replace('<log message="$(var speed)"/>', ""), "velocity", "ament_python")
    assert sorted(texts) == ["a.launch.xml", "main.launch"]


def test_what_a_scoped_group_includes_is_not_read_after_it(tmp_path: Path) -> None:
    text = """
        <launch>
          <group><include file="{folder}/a.launch.xml"/></group>
          <include file="{folder}/b.launch.xml"/>
        </launch>
        //- a.launch.xml
        <launch><arg name="spe$0ed" default="2"/></launch>
        //- b.launch.xml
        <launch><arg name="speed" default="1"/></launch>
        """
    assert list(renamed(tmp_path, text, "velocity", "ament_python")) == ["a.launch.xml"]


def test_a_missing_include_of_another_root(tmp_path: Path) -> None:
    text = LEAKS.replace("<launch>\n      <arg", '<launch>\n      <include file="/none.launch.xml"/>\n      <arg')
    assert list(renamed(tmp_path, text % "other", "velocity", "ament_python")) == ["main.launch"]


def test_an_argument_that_would_be_taken_for_another_one(tmp_path: Path) -> None:
    text = """
        <launch>
          <arg name="velocity" default="%s"/>
          <include file="{folder}/b.launch.xml"><arg name="speed" value="%s"/></include>
          %s
        </launch>
        //- b.launch.xml
        <launch><arg name="spe$0ed"/><log message="$(var speed)"/></launch>
        //- c.launch.xml
        <launch><arg name="velocity" default="1"/></launch>
        """
    same = renamed(tmp_path / "a", text % ("1", "$(var velocity)", ""), "velocity", "ament_python")
    assert '<arg name="velocity" value="$(var velocity)"/>' in same["main.launch"]
    other = refused(tmp_path / "b", text % ("1", "2", ""), "velocity", build_type="ament_python")
    assert other == "'velocity' is already an argument of the same launch, at main.launch:2"
    beside = (text % ("1", "2", '<include file="{folder}/c.launch.xml"/>')).replace(
        'name="velocity" default="1"/>\n', 'name="x" default="1"/>\n', 1
    )
    assert "at c.launch.xml:1" in refused(tmp_path / "c", beside, "velocity", build_type="ament_python")


def test_an_argument_that_is_passed_by_a_name_made_up(tmp_path: Path) -> None:
    text = """
        <launch>
          <arg name="spe$0ed" default="1"/>
        </launch>
        //- up.launch.xml
        <launch>
          <let name="which" value="speed"/>
          <include file="{folder}/main.launch"><arg name="$(var which)" value="2"/></include>
        </launch>
        """
    message = refused(tmp_path, text, "velocity", build_type="ament_python")
    assert message == "'speed' is passed to main.launch by a name made up at up.launch.xml:3"
