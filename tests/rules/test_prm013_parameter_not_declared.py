"""PRM013: a parameter that its node does not declare (ROS 2)."""

from pathlib import Path

import pytest
from support.check import apply, check, findings_of


def test_a_parameter_that_is_not_declared() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="pump" name="pump">
            <param name="max_presure" value="4.5"/>
                         ^^^^^^^^^^^ warning[PRM013] parameter 'max_presure' is not declared by /pump; its value is
            <param name="use_sim_time" value="false"/>
            <param name="gains.p" value="4.5"/>
          </node>
          <node pkg="p" exec="any" name="any"><param from="/any.yaml"/></node>
          <node pkg="p" exec="takes_all" name="takes_all"><param name="b" value="1"/></node>
          <node pkg="p" exec="unknown" name="unknown"><param name="b" value="1"/></node>
        </launch>
        //- /any.yaml
        any:
          ros__parameters:
            gains:
              q: 1.0
              ^ warning[PRM013] parameter 'gains.q' is not declared by /any; its value is ignored
            speed: 2.0
        //- interfaces
        {"/pump": {"params": {"~max_pressure": 6.0, "~gains.p": 1.0}},
         "/any": {"params": {"~gains.p": 1.0, "~speed": 1.0}},
         "/takes_all": {"params": {"~a": 1, "/": {"access": "list"}}}}
    """)


def test_parameters_that_are_written_once_for_several_nodes() -> None:
    """Each takes what it declares: `speed` is one node's, `gain` perhaps the unknown one's, `limt` nobody's."""
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="left" name="left"><param from="/all.yaml"/></node>
          <node pkg="p" exec="right" name="right"><param from="/all.yaml"/></node>
          <node pkg="p" exec="unknown" name="unknown"><param from="/some.yaml"/></node>
          <node pkg="p" exec="left" name="other"><param from="/some.yaml"/></node>
        </launch>
        //- /all.yaml
        /**:
          ros__parameters:
            speed: 1.0
            limt: 2.0
            ^^^^ warning[PRM013] parameter 'limt' is not declared by /left and 1 more; its value is ignored; did you
        //- /some.yaml
        /**:
          ros__parameters:
            gain: 1.0
        //- interfaces
        {"/left": {"params": {"~speed": 6.0, "~limit": 1.0}},
         "/right": {"params": {"~limit": 1.0}},
         "/other": {"params": {"~limit": 1.0}}}
    """)


@pytest.mark.parametrize("wildcard", ["/**", "/*"])
def test_what_is_written_for_whoever_wants_it(wildcard: str) -> None:
    """A file of the robot has what some node may want; a slip in it is one all the same."""
    check(
        """
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="left" name="left"><param from="/robot.yaml"/></node>
        </launch>
        //- /robot.yaml
        WILDCARD:
          ros__parameters:
            mass_kg: 4.0
            ^^^^^^^ info[PRM013] parameter 'mass_kg' is not declared by /left; its value is ignored
            sped: 1.0
            ^^^^ warning[PRM013] parameter 'sped' is not declared by /left; its value is ignored; did you mean 'speed'?
        left:
          ros__parameters:
            mass: 4.0
            ^^^^ warning[PRM013] parameter 'mass' is not declared by /left; its value is ignored
        //- interfaces
        {"/left": {"params": {"~speed": 6.0}}}
        """.replace("WILDCARD", wildcard)
    )


def test_a_group_that_another_parameter_chooses() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="radio" name="radio">
            <param name="device" value="near"/>
            <param name="devices.rocket.host" value="a"/>
                         ^^^^^^^^^^^^^^^^^^^ info[PRM013] parameter 'devices.rocket.host' is not declared by
            <param name="devices.rocket.post" value="a"/>
                         ^^^^^^^^^^^^^^^^^^^ warning[PRM013] parameter 'devices.rocket.post' is not declared by
          </node>
        </launch>
        //- interfaces
        {"/radio": {"params": {"~device": "near", "~devices.near.host": "b"}}}
    """)


def test_what_a_section_shares_and_what_is_given_besides_is_not_near() -> None:
    found = check("""
        //- /robot.launch.xml
        <launch><node pkg="p" exec="guide" name="guide"><param from="/all.yaml"/></node></launch>
        //- /all.yaml
        guide:
          ros__parameters:
            topics:
              guidance:
                dp: a
                ^^ warning[PRM013] parameter 'topics.guidance.dp' is not declared by /guide; its value is ignored
                spede: 1.0
                ^^^^^ warning[PRM013] did you mean 'topics.guidance.speed'?
                limits: 1.0
                ^^^^^^ warning[PRM013] parameter 'topics.guidance.limits' is not declared by /guide; its value is
                limit: 1.0
        //- interfaces
        {"/guide": {"params":
          {"~topics.guidance.los": "b", "~topics.guidance.speed": 1.0, "~topics.guidance.limit": 1.0}}}
    """)
    assert sum("did you mean" in finding.message for finding in found) == 1


@pytest.mark.silent
def test_parameters_that_are_declared_or_may_be() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="pump" name="pump">
            <param name="max_pressure" value="4.5"/>
            <param name="use_sim_time" value="false"/>
          </node>
          <node pkg="p" exec="takes_all" name="takes_all"><param name="b" value="1"/></node>
        </launch>
        //- interfaces
        {"/pump": {"params": {"~max_pressure": 6.0}},
         "/takes_all": {"params": {"~a": 1, "/": {"access": "list"}}}}
    """)


def test_a_slip_of_what_each_node_has() -> None:
    text = """
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="unknown" name="unknown">
            <param name="use_sime_time" value="true"/>
                         ^^^^^^^^^^^^^ warning[PRM013] parameter 'use_sime_time' of /unknown has no effect; did you
          </node>
          <node pkg="p" exec="pump" name="pump">
            <param name="use_simtime" value="true"/>
                         ^^^^^^^^^^^ warning[PRM013] parameter 'use_simtime' of /pump has no effect; did you mean
          </node>
          <node pkg="p" exec="own" name="own"><param name="use_sim_times" value="true"/></node>
        </launch>
        //- interfaces
        {"/pump": {"params": {"~a": 1}}, "/own": {"params": {"~use_sim_times": false}}}
    """
    found = next(each for each in check(text) if "of /unknown" in each.message)
    assert '<param name="use_sim_time" value="true"/>' in apply(text, found.fixes[0].edits)["/robot.launch.xml"]


@pytest.mark.silent
def test_parameters_of_transports_are_declared_for_each_topic() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="camera" name="camera">
            <param name="camera.image.compressed.jpeg_quality" value="75"/>
            <param name="image_raw.enable_pub_plugins" value="image_transport/raw"/>
          </node>
        </launch>
        //- interfaces
        {"/camera": {"params": {"~rate": 6.0}}}
    """)


def test_of_a_row_of_parameters_a_node_may_take_as_many_as_it_is_given() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="ekf" name="ekf">
            <param name="odom1_queue_size" value="4"/>
            <param name="imu1_queue_size" value="4"/>
                         ^^^^^^^^^^^^^^^ info[PRM013] 'imu1_queue_size'
          </node>
          <node pkg="p" exec="whole" name="whole">
            <param name="odom1_queue_size" value="4"/>
                         ^^^^^^^^^^^^^^^^ warning[PRM013] 'odom1_queue_size'
          </node>
        </launch>
        //- interfaces
        {"/ekf": {"params": {"~odom0_queue_size": 6}, "answers": ["x"]},
         "/whole": {"params": {"~odom0_queue_size": 6}}}
    """)


COMPUTED = {
    "a sum": 'declare_parameter("corrections." + role + ".position", zero);',
    "its beginning": "self.declare_parameter(f'corrections.{role}', 0.0)",
    "its end": 'const auto name = definition.key + ".position"; declare_parameter(name, zero);',
    "a format": 'self.declare_parameter("corrections.{}.{}".format(role, "position"), 0.0)',
    "a text that is built": 'declare_parameter(std::string("corrections.") + name(role) + "." + kind, 0.0);',
}
_OPEN = """
    //- {0}/p/robot.launch.xml
    <launch>
      <node pkg="p" exec="pump" name="pump">
        <param name="corrections.left_hand.position" value="4.5"/>
        <param name="correction.left_hand.offset" value="4.5"/>
      </node>
    </launch>
    //- interfaces
    {{"/pump": {{"params": {{"~rate": 6.0}}}}}}
    //- {0}/p/package.xml
    <package><name>p</name></package>
"""


@pytest.mark.parametrize("case", COMPUTED)
def test_a_name_that_the_source_puts_together(tmp_path: Path, case: str) -> None:
    (tmp_path / "p" / "src").mkdir(parents=True)
    (tmp_path / "p" / "src" / "pump.cpp").write_text(COMPUTED[case])
    said = [each.message for each in findings_of(_OPEN.format(tmp_path)) if each.rule == "PRM013"]
    assert [message.split("'")[1] for message in said] == ["correction.left_hand.offset"]
