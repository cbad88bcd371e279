"""SRV: who offers, who calls, with which type."""

from support.check import apply, check, findings_of


def test_a_near_miss_is_a_warning_that_names_both() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="base"/>
          <node pkg="p" type="t" name="dock"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[SRV001] '/base/reset_odometry', offered by /base (same type
        </launch>
        //- interfaces
        {"/base": {"services": {"~reset_odometry": "std_srvs/Trigger"}},
         "/dock": {"clients": {"base/reset_odom": "std_srvs/Trigger"}}}
    """
    (finding,) = check(text)
    assert "none of the 2 nodes of this launch offers service '/base/reset_odom', which /dock calls" in finding.message
    assert (
        '<remap from="base/reset_odom" to="base/reset_odometry"/>'
        in apply(text, finding.fixes[0].edits)["/main.launch"]
    )


def test_without_a_near_name_it_is_a_hint() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="base"/>
          <node pkg="p" type="t" name="dock"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[SRV001] offers service '/gazebo/pause' (std_srvs/Empty)
        </launch>
        //- interfaces
        {"/base": {"services": {"reset": "std_srvs/Empty", "~get_loggers": "roscpp/GetLoggers"}},
         "/dock": {"clients": {"/gazebo/pause": "std_srvs/Empty"}}}
    """)


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


def test_types_that_differ() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="base"/>
          <node pkg="p" type="t" name="dock"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[SRV002] /base offers it as std_srvs/Empty, /dock calls it as
        </launch>
        //- interfaces
        {"/base": {"services": {"reset": "std_srvs/Empty"}}, "/dock": {"clients": {"reset": "std_srvs/Trigger"}}}
    """)


def test_a_service_that_two_nodes_offer() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="left"/>
          <node pkg="p" type="t" name="right"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[SRV003] services '/reset' and '/stop' are offered by
        </launch>
        //- interfaces
        {"/left": {"services": {"reset": "std_srvs/Empty", "stop": "std_srvs/Empty", "~own": "std_srvs/Empty"}},
         "/right": {"services": {"reset": "std_srvs/Empty", "stop": "std_srvs/Empty", "~own": "std_srvs/Empty"}}}
    """
    (finding,) = check(text)
    assert [related.message for related in finding.related] == ["/left offers /reset"]


def test_a_service_that_two_nodes_of_ros2_offer() -> None:
    check("""
        //- /main.launch.xml
        <launch>
          <node pkg="p" exec="t" name="left"/>
          <node pkg="p" exec="t" name="right"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[SRV003] /left and /right: each of them carries out every
        </launch>
        //- interfaces
        {"/left": {"services": {"reset": "std_srvs/srv/Trigger"}},
         "/right": {"services": {"reset": "std_srvs/srv/Trigger"}}}
    """)


def test_services_of_two_namespaces_and_those_of_every_node_are_not_offered_twice() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="base" ns="left"/>
          <node pkg="p" type="t" name="base" ns="right"/>
        </launch>
        //- interfaces
        {"/left/base": {"services": {"reset": "std_srvs/Empty", "/x": "y/Z"}, "builtin": ["/x"]},
         "/right/base": {"services": {"reset": "std_srvs/Empty", "/x": "y/Z"}, "builtin": ["/x"]}}
    """)


def test_a_client_whose_type_is_not_known_is_judged_by_its_sum() -> None:
    text = """
        <launch><node pkg="p" type="t" name="base"/><node pkg="p" type="t" name="dock"/></launch>
        //- interfaces
        {"/base": {"services": {"reset": "std_srvs/Empty"}, "md5": {"reset": "11"}},
         "/dock": {"clients": {"reset": null}, "md5": {"reset": "SUM"}}}
    """
    (finding,) = findings_of(text.replace("SUM", "22"))
    assert finding.rule == "SRV002"
    assert "/dock calls it as an unknown type, with the MD5 sums 11 and 22" in finding.message
    assert findings_of(text.replace("SUM", "11")) == []
    assert findings_of(text.replace("SUM", "*")) == []


def test_one_service_type_of_two_definitions() -> None:
    (finding,) = findings_of("""
        <launch><node pkg="p" type="t" name="base"/><node pkg="p" type="t" name="dock"/></launch>
        //- interfaces
        {"/base": {"services": {"reset": "x/Reset"}, "md5": {"reset": "11"}},
         "/dock": {"clients": {"reset": "x/Reset"}, "md5": {"reset": "22"}}}
    """)
    assert "one of them was built from another definition" in finding.message


def test_types_of_one_definition_can_be_called() -> None:
    assert (
        findings_of("""
        <launch><node pkg="p" type="t" name="base"/><node pkg="p" type="t" name="dock"/></launch>
        //- interfaces
        {"/base": {"services": {"reset": "std_srvs/Empty"}, "md5": {"reset": "11"}},
         "/dock": {"clients": {"reset": "x/Nothing"}, "md5": {"reset": "11"}}}
    """)
        == []
    )


def test_a_service_that_is_waited_for_may_be_the_one_that_nobody_calls() -> None:
    check("""
        <launch>
          <node pkg="p" type="b" name="base"/>
          <node pkg="p" type="d" name="dock"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[SRV001] waits for when it starts; did you mean '/reset_od
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
