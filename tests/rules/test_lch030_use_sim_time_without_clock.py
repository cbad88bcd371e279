"""LCH030: the launch runs on simulated time, and nobody tells the time."""

from pathlib import Path

import pytest
from support.check import check, findings_of

_INTERFACES = """
        //- interfaces
        {"/n": {"params": {"/use_sim_time": false}}}
"""


def test_simulated_time_without_a_clock() -> None:
    check(
        """
        <launch>
          <param name="/use_sim_time" value="true"/>
                       ^^^^^^^^^^^^^ warning[LCH030] '/use_sim_time' is true, but '/clock' has no publisher in this
          <node pkg="p" type="t" name="n"/>
        </launch>"""
        + _INTERFACES
    )


@pytest.mark.silent
@pytest.mark.parametrize(
    "launch",
    [
        '<param name="/use_sim_time" value="false"/><node pkg="p" type="t" name="n"/>',
        '<param name="/use_sim_time" value="true"/><node pkg="p" type="play" name="n" args="--clock a.bag"/>',
        '<param name="/use_sim_time" value="true"/><node pkg="p" type="gzserver" name="n"/>',
        '<param name="/use_sim_time" value="true"/>',
    ],
)
def test_silent_where_time_is_real_or_told(launch: str) -> None:
    interfaces = _INTERFACES if "<node" in launch else ""
    check(f"""
        <launch>{launch}</launch>{interfaces}""")


@pytest.mark.silent
def test_silent_where_a_node_publishes_clock_or_is_not_known() -> None:
    check("""
        <launch>
          <param name="/use_sim_time" value="true"/>
          <node pkg="p" type="t" name="n"/>
        </launch>
        //- interfaces
        {"/n": {"publishers": {"/clock": "rosgraph_msgs/Clock"}}}
    """)
    check("""
        <launch>
          <param name="/use_sim_time" value="true"/>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TRC001]
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1}}
    """)


_TRUE = """
        <launch>
          <param name="/use_sim_time" value="true"/>
          <node pkg="p" type="t" name="n"/>
        </launch>"""


def test_silent_where_the_settings_say_that_something_else_tells_the_time() -> None:
    settings = "\n        //- /workspace/.ros-preflight.yaml\n        external: {{topics: [{}]}}"
    check(_TRUE + settings.format("/clock") + _INTERFACES)
    assert [f.rule for f in findings_of(_TRUE + settings.format("/scan") + _INTERFACES)] == ["LCH030"]


def test_a_node_that_waits_for_the_time_does_not_hide_that_nobody_tells_it() -> None:
    waits = """
        //- interfaces
        {"/n": {"params": {"/use_sim_time": false}, "answers": ["it waits for simulated time"]}}
"""
    found = [f for f in findings_of(_TRUE + waits) if f.rule == "LCH030"]
    assert [(f.severity, f.confidence) for f in found] == [("warning", "possible")]


def test_the_project_has_a_launch_file_that_starts_a_simulator(tmp_path: Path) -> None:
    text = f"""
        //- {tmp_path}/main.launch
        <launch><param name="/use_sim_time" value="true"/><node pkg="p" type="t" name="n"/></launch>
        //- {tmp_path}/package.xml
        <package><name>p</name></package>
    """
    (tmp_path / "main.launch").touch()
    assert [f.severity for f in findings_of(text + _INTERFACES) if f.rule == "LCH030"] == ["warning"]
    include = '<include file="$(find gazebo_ros)/launch/empty_world.launch"/>'
    (tmp_path / "world.launch").write_text(f"<launch>{include}</launch>")
    assert [f.severity for f in findings_of(text + _INTERFACES) if f.rule == "LCH030"] == ["info"]
