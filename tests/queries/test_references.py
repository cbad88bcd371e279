"""Find references: everything that names the thing at the cursor."""

from __future__ import annotations

from pathlib import Path

from preflight_analysis.queries.references import references
from support.workspace_harness import create_workspace


def referred(tmp_path: Path, text: str, build_type: str | None = None) -> list[str]:
    """Where the thing at the cursor is named; declarations have a star."""
    workspace = create_workspace(tmp_path, text, build_type=build_type)
    return [
        workspace.shown(r.location) + ("*" if r.declares else "")
        for r in references(workspace.context, workspace.offset)
    ]


ARGUMENTS = """
    <launch>
      <arg name="rate" default="1"/>
      <include file="{folder}/inc.launch"><arg name="ra%ste" value="$(arg rate)"/></include>
    </launch>
    //- inc.launch
    <launch>
      <arg name="r%sate"/>
      <param name="a" value="$(arg rate)" if="$(eval ra%ste > 0 and arg('rate') and 'rate')"/>
    </launch>
    //- other.launch
    <launch>
      <include file="{folder}/inc.launch" if="false">
        <arg name="rate" value="3"/>
      </include>
    </launch>
"""


def test_argument_from_its_pass_its_declaration_and_its_use(tmp_path: Path) -> None:
    found = [
        "inc.launch:2 rate*",
        "inc.launch:3 rate",
        "inc.launch:3 rate",
        "inc.launch:3 rate",
        "main.launch:3 rate",
        "other.launch:3 rate",
    ]
    for number in range(3):
        cursors = ["$0" if n == number else "" for n in range(3)]
        got = referred(tmp_path / str(number), ARGUMENTS % tuple(cursors))
        assert sorted(got) == found, number


def test_argument_of_the_includer_is_another_one(tmp_path: Path) -> None:
    text = ARGUMENTS.replace('"rate" default', '"$0rate" default') % ("", "", "")
    assert referred(tmp_path, text) == ["main.launch:2 rate*", "main.launch:3 rate"]


def test_argument_that_is_handed_on_with_all_others(tmp_path: Path) -> None:
    found = referred(
        tmp_path,
        """
        <launch>
          <arg name="rate" default="1"/>
          <include file="{folder}/between.launch" pass_all_args="true"/>
        </launch>
        //- between.launch
        <launch>
          <include file="{folder}/inc.launch" pass_all_args="true"/>
          <include file="{folder}/given.launch" pass_all_args="true"><arg name="rate" value="2"/></include>
        </launch>
        //- inc.launch
        <launch>
          <param name="a" value="$(arg $0rate)"/>
        </launch>
        //- given.launch
        <launch>
          <arg name="rate"/>
        </launch>
        """,
    )
    assert found == ["inc.launch:2 rate", "main.launch:2 rate*"]


def test_argument_of_files_that_include_a_third(tmp_path: Path) -> None:
    text = """
        <launch>
          <arg name="ra$0te" default="1"/>
          <include file="{folder}/inc.launch" pass_all_args="true"/>
        </launch>
        //- other.launch
        <launch>
          <arg name="rate" default="2"/>
          <include file="{folder}/inc.launch" pass_all_args="true"/>
        </launch>
        //- inc.launch
        <launch>
          <arg name="%s" default="3"/>
        </launch>
        """
    assert referred(tmp_path / "a", text % "speed") == ["main.launch:2 rate*"]
    assert referred(tmp_path / "b", text % "rate") == [
        "main.launch:2 rate*",
        "inc.launch:2 rate*",
        "other.launch:2 rate*",
    ]


def test_argument_in_a_parameter_file(tmp_path: Path) -> None:
    found = referred(
        tmp_path,
        """
        <launch>
          <arg name="ra$0te" default="1"/>
          <rosparam file="{folder}/a.yaml" subst_value="true"/>
          <rosparam subst_value="true">b: $(arg rate)</rosparam>
        </launch>
        //- a.yaml
        a: $(arg rate)
        """,
    )
    assert found == ["main.launch:2 rate*", "main.launch:4 rate", "a.yaml:1 rate"]


def test_who_includes_a_file(tmp_path: Path) -> None:
    text = """
        <launch>
          <include file="{folder}/p/launch/%sinc.launch"/>
        </launch>
        //- p/launch/inc.launch
        <!-- first -->
        <lau%snch>
        </launch>
        //- other.launch
        <launch>
          <include file="$(find p)/launch/inc.launch" unless="true"/>
        </launch>
        """
    found = [
        "main.launch:2 {folder}/p/launch/inc.launch",
        "other.launch:2 $(find p)/launch/inc.launch",
        "p/launch/inc.launch:2 <launch>*",
    ]
    for number, cursors in enumerate((("$0", ""), ("", "$0"))):
        folder = tmp_path / str(number)
        assert sorted(referred(folder, text % cursors)) == [f.replace("{folder}", str(folder)) for f in found]


def test_package_and_executable(tmp_path: Path) -> None:
    text = """
        <launch>
          <node pkg="%sp" type="ta%slker.py" name="talker"/>
          <node pkg="q" type="talker.py" name="other"/>
        </launch>
        //- other.launch
        <launch>
          <param name="a" textfile="$(find p)/a.txt" if="false"/>
          <node pkg="p" type="talker.py" name="talker"/>
        </launch>
        //- p/package.xml
        <package/>
        //- p/scripts/talker.py
        #!/usr/bin/env python3
        """
    assert referred(tmp_path / "a", text % ("$0", "")) == [
        "main.launch:2 p",
        "other.launch:2 p",
        "other.launch:3 p",
        "p/package.xml:1*",
    ]
    assert referred(tmp_path / "b", text % ("", "$0")) == [
        "main.launch:2 talker.py",
        "other.launch:3 talker.py",
        "p/scripts/talker.py:1*",
    ]


BUILT = """
    <launch>
      <node pkg="%sp" exec="dri%sver" name="driver"/>
      <node_container pkg="p" exec="driver" name="c" namespace="">
        <composable_node pkg="p" plugin="p::Dri%sver" name="d"/>
      </node_container>
    </launch>
    //- p/package.xml
    <package format="3">
      <name>p</name>
      <depend>rclcpp</depend>
    </package>
    //- p/CMakeLists.txt
    project(p)
    find_package(rclcpp REQUIRED)
    add_executable(driver src/a.cpp)
    rclcpp_components_register_nodes(lib "p::Driver")
    ament_target_dependencies(driver p)
    //- p/src/a.cpp
    auto share = ament_index_cpp::get_package_share_directory("p");
    auto name = "driver";
"""


def test_what_builds_and_describes_a_package(tmp_path: Path) -> None:
    found = [referred(tmp_path / str(n), BUILT % tuple("$0" if n == m else "" for m in range(3)), "ament_cmake")
             for n in range(3)]  # fmt: skip
    assert found == [
        [
            "main.launch:2 p",
            "main.launch:3 p",
            "main.launch:4 p",
            "p/CMakeLists.txt:5 p",
            "p/package.xml:1*",
            "p/package.xml:2 p*",
            "p/src/a.cpp:1 p",
        ],
        ["main.launch:2 driver", "main.launch:3 driver", "p/CMakeLists.txt:3 driver*", "p/src/a.cpp:1*"],
        ["main.launch:4 p::Driver", "p/CMakeLists.txt:4 p::Driver"],
    ]


def test_an_entry_point(tmp_path: Path) -> None:
    text = """
        <launch>
          <node pkg="p" exec="dri$0ver" name="driver"/>
        </launch>
        //- p/package.xml
        <package format="3"><name>p</name></package>
        //- p/setup.py
        setup(entry_points={'console_scripts': ['driver = p.driver:main']})
        //- p/p/driver.py
        def main():
            print("driver = p:main")
        """
    assert referred(tmp_path, text, "ament_python") == [
        "main.launch:2 driver",
        "p/p/driver.py:1 def main():*",
        "p/setup.py:1 driver*",
    ]


def test_a_topic_in_a_configuration_of_rviz(tmp_path: Path) -> None:
    text = """
        <launch>
          <node pkg="p" exec="laser" name="laser"><remap from="scan" to="/front/s$0can"/></node>
          <node pkg="rviz2" exec="rviz2" name="rviz" args="-d {folder}/p/a.rviz"/>
        </launch>
        //- p/a.rviz
        Visualization Manager:
          Displays:
            - {Class: rviz_default_plugins/LaserScan, Enabled: true, Name: A, Topic: {Depth: 5, Value: /front/scan}}
            - {Class: rviz_default_plugins/LaserScan, Enabled: true, Name: B, Topic: {Value: /back/scan}}
        //- interfaces
        {"/laser": {"publishers": {"scan": "sensor_msgs/msg/LaserScan"}}}
        """
    assert referred(tmp_path, text, "ament_cmake") == [
        "main.launch:2 scan",
        "main.launch:2 /front/scan",
        "p/a.rviz:3 /front/scan",
    ]


def test_node(tmp_path: Path) -> None:
    found = referred(
        tmp_path,
        """
        <launch>
          <param name="/lab/talker/rate" value="1"/>
          <param name="/lab/talkers" value="1"/>
          <group ns="lab">
            <param name="talker/x" value="1"/>
            <rosparam>talker: {y: 1, z: 2}</rosparam>
            <rosparam ns="talker">w: 1</rosparam>
            <rosparam file="{folder}/a.yaml"/>
            <node pkg="p" type="t" name="tal$0ker"><param name="own" value="1"/></node>
            <node pkg="p" type="t" name="listener">
              <remap from="chatter" to="talker/chatter"/>
              <remap from="b" to="/lab/talker/b"/>
              <remap from="c" to="/talker/c"/>
            </node>
            <node pkg="nodelet" type="nodelet" name="let" args="load p/Let talker --x"/>
          </group>
        </launch>
        //- a.yaml
        talker:
          a: 1
        //- other.launch
        <launch>
          <node ns="lab" pkg="p" type="t" name="talker"/>
          <node pkg="p" type="t" name="talker"/>
        </launch>
        """,
    )
    assert found == [
        "main.launch:2 talker",
        "main.launch:5 talker",
        "main.launch:6 talker",
        "main.launch:7 talker",
        "main.launch:9 talker*",
        "main.launch:11 talker",
        "main.launch:12 talker",
        "main.launch:15 talker",
        "a.yaml:1 talker",
        "other.launch:2 talker*",
    ]


def test_parameter_where_it_is_set_and_read(tmp_path: Path) -> None:
    text = """
        <launch>
          <param name="/talker/rate" value="1"/>
          <rosparam>talker: {ra%ste: 2}</rosparam>
          <rosparam file="{folder}/a.yaml"/>
          <node pkg="p" type="t" name="talker">
            <param name="%srate" value="3"/>
            <!-- <params><param name="~rate"/></params> -->
          </node>
        </launch>
        //- a.yaml
        talker:
          rate: 4
        //- p/scripts/t.py
        import rospy
          rate = rospy.get_param("~rate")
        //- interfaces
        {"/talker": {"params": {"~rate": 10}, "made": {"~rate": ["{folder}/p/scripts/t.py", 2]}}}
        """
    for number, cursors in enumerate((("$0", ""), ("", "$0"))):
        assert referred(tmp_path / str(number), text % cursors) == [
            "main.launch:2 /talker/rate*",
            "main.launch:3 rate*",
            "main.launch:6 rate*",
            "main.launch:7 ~rate",
            "a.yaml:2 rate*",
            'p/scripts/t.py:2 rate = rospy.get_param("~rate")',
        ]


def test_topic_with_its_ends_in_the_nodes_sources(tmp_path: Path) -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="talker"><remap from="out" to="%schatter"/></node>
          <node pkg="p" type="l" name="listener"><remap from="%sin" to="/chatter"/></node>
          <node pkg="p" type="l" name="recorder">
            <!-- <topics><topic name="chat%ster" type="std_msgs/String" class="sub"/></topics> -->
          </node>
        </launch>
        //- p/scripts/t.py
        pub = Publisher("out")
        //- p/scripts/l.py
        sub = Subscriber("in")
        //- interfaces
        {"/talker": {"publishers": {"out": "std_msgs/String"}, "made": {"out": ["{folder}/p/scripts/t.py", 1]}},
         "/listener": {"subscribers": {"in": "std_msgs/String"}, "made": {"in": ["{folder}/p/scripts/l.py", 1]}}}
        """
    for number in range(3):
        cursors = ["$0" if n == number else "" for n in range(3)]
        assert referred(tmp_path / str(number), text % tuple(cursors)) == [
            "main.launch:2 out",
            "main.launch:2 chatter",
            "main.launch:3 in",
            "main.launch:3 /chatter",
            "main.launch:5 chatter",
            'p/scripts/l.py:1 sub = Subscriber("in")',
            'p/scripts/t.py:1 pub = Publisher("out")*',
        ]


def test_environment_variable_and_machine(tmp_path: Path) -> None:
    text = """
        <launch>
          <machine name="base" address="localhost"/>
          <env name="ROB%sOT" value="x"/>
          <node pkg="p" type="t" name="t" machine="ba%sse"/>
        </launch>
        //- other.launch
        <launch>
          <param name="a" value="$(optenv ROBOT none)"/>
        </launch>
        """
    assert referred(tmp_path / "a", text % ("$0", "")) == ["main.launch:3 ROBOT", "other.launch:2 ROBOT"]
    assert referred(tmp_path / "b", text % ("", "$0")) == ["main.launch:2 base*", "main.launch:4 base"]


def test_a_file_that_does_not_parse(tmp_path: Path) -> None:
    found = referred(
        tmp_path,
        """
        <launch>
          <arg name="ra$0te"/>
          <param name="a" value="$(arg rate)"
          <node pkg="p" type="$(arg rate)"
        """,
    )
    assert found == ["main.launch:2 rate*", "main.launch:3 rate", "main.launch:4 rate"]


def test_nothing_is_there(tmp_path: Path) -> None:
    assert referred(tmp_path, "<launch>\n  $0\n</launch>") == []
