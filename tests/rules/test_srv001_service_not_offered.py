"""SRV001: a node calls a service that nobody offers."""

import pytest
from support.check import apply, check, findings_of


def test_a_near_miss_is_a_warning_that_names_both() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="base"/>
          <node pkg="p" type="t" name="dock"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[SRV001] service '/base/reset_odom' has no server (client:
        </launch>
        //- interfaces
        {"/base": {"services": {"~reset_odometry": "std_srvs/Trigger"}},
         "/dock": {"clients": {"base/reset_odom": "std_srvs/Trigger"}}}
    """
    (finding,) = check(text)
    assert "service '/base/reset_odom' has no server (client: /dock)" in finding.message
    assert (
        '<remap from="base/reset_odom" to="base/reset_odometry"/>'
        in apply(text, finding.fixes[0].edits)["/main.launch"]
    )


def test_without_a_near_name_it_is_a_hint() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="base"/>
          <node pkg="p" type="t" name="dock"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[SRV001] service '/gazebo/pause' (std_srvs/Empty) has no server in
        </launch>
        //- interfaces
        {"/base": {"services": {"reset": "std_srvs/Empty", "~get_loggers": "roscpp/GetLoggers"}},
         "/dock": {"clients": {"/gazebo/pause": "std_srvs/Empty"}}}
    """)


@pytest.mark.silent
def test_services_that_meet_and_services_that_nobody_calls_are_fine() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="base"/>
          <node pkg="p" type="t" name="dock"><remap from="reset" to="base/reset"/></node>
        </launch>
        //- interfaces
        {"/base": {"services": {"~reset": "std_srvs/Empty", "other": "std_srvs/Empty"}},
         "/dock": {"clients": {"reset": "std_srvs/Empty"}}}
    """)


def test_a_service_that_is_waited_for_may_be_the_one_that_nobody_calls() -> None:
    check("""
        <launch>
          <node pkg="p" type="b" name="base"/>
          <node pkg="p" type="d" name="dock"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[SRV001] service '/base/reset_odom' (std_srvs/Empty) has no
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC005] it waits for the service /base/reset_odom
          <node pkg="p" type="c" name="calls"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[SRV001] '/calls/reset' (std_srvs/Empty)
          <node pkg="p" type="o" name="other"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[SRV001] '/load_map' (std_srvs/Empty)
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC005] it waits for the service /load_map
        </launch>
        //- interfaces
        {"/base": {"services": {"reset_odometry": "std_srvs/Empty"}},
         "/dock": {"clients": {"base/reset_odom": "std_srvs/Empty"},
                   "answers": ["it waits for the service /base/reset_odom, and was told that it is there"],
                   "notes": ["it waits for the service /base/reset_odom, and was told that it is there"]},
         "/calls": {"clients": {"~reset": "std_srvs/Empty"}},
         "/other": {"clients": {"load_map": "std_srvs/Empty"},
                    "answers": ["it waits for the service /load_map, and was told that it is there"],
                    "notes": ["it waits for the service /load_map, and was told that it is there"]}}
    """)


@pytest.mark.silent
def test_a_nodelet_that_asks_for_its_manager_is_lch034s() -> None:
    check("""
        <launch>
          <node pkg="nodelet" type="nodelet" name="manager" args="manager"/>
          <node pkg="nodelet" type="nodelet" name="a" args="load p/A maneger"/>
                                                                     ^^^^^^^ warning[LCH034] did you mean '/manager'?
        </launch>
        //- /nodelet/package.xml
        <package/>
        //- interfaces
        {"/manager": {"services": {"~load_nodelet": "nodelet/NodeletLoad"}},
         "/a": {"clients": {"maneger/load_nodelet": "nodelet/NodeletLoad"}}}
    """)


@pytest.mark.parametrize(("name", "fixes"), [("", 0), ('name="server"', 2)])
def test_a_private_name_of_a_node_whose_name_is_not_known_is_not_mended(name: str, fixes: int) -> None:
    launch = f"""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="server" {name}/>
          <node pkg="p" exec="client" name="client"/>
        </launch>
        //- interfaces
        {{"/server": {{"services": {{"~/load_map": "std_srvs/srv/Trigger"}}}},
          "/client": {{"clients": {{"serve/load_map": "std_srvs/srv/Trigger"}}}}}}
    """
    (finding,) = [each for each in findings_of(launch) if each.rule == "SRV001"]
    assert len(finding.fixes) == fixes
