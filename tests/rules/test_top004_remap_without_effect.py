"""TOP004: a remap of a name that its node does not use."""

import json
from pathlib import Path

import pytest
from preflight_analysis.rules.registry import run_rules
from support import package_elsewhere
from support.check import apply, check, findings_of


def test_a_typo_in_from_is_shown_there_and_nowhere_else() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="laser"/>
          <node pkg="p" type="t" name="amcl">
            <remap from="scna" to="front/scan"/>
                         ^^^^ warning[TOP004] remap of '/scna' has no effect: /amcl does not use that name; did you
          </node>
        </launch>
        //- interfaces
        {"/laser": {"publishers": {"front/scan": "sensor_msgs/LaserScan"}},
         "/amcl": {"subscribers": {"scan": "sensor_msgs/LaserScan"}}}
    """
    (finding,) = check(text)
    assert finding.confidence == "likely"
    assert "/laser publishes '/front/scan' (sensor_msgs/LaserScan)" in finding.message
    mended = apply(text, finding.fixes[0].edits)["/main.launch"]
    assert findings_of(mended + "\n//- interfaces" + text.partition("//- interfaces")[2]) == []


def test_the_only_end_that_fits_the_target_is_what_was_meant() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="navigator"/>
          <node pkg="p" type="t" name="collision_stop">
            <remap from="input_cmd_vel" to="cmd_vel_nav"/>
                         ^^^^^^^^^^^^^ warning[TOP004] did you mean 'cmd_vel_in', which it subscribes to
          </node>
        </launch>
        //- interfaces
        {"/navigator": {"publishers": {"cmd_vel_nav": "geometry_msgs/Twist"}},
         "/collision_stop": {"subscribers": {"cmd_vel_in": "geometry_msgs/Twist"}}}
    """)


def test_a_missing_tilde() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="source"/>
          <node pkg="p" type="t" name="filter">
            <remap from="input" to="points"/>
                         ^^^^^ warning[TOP004] did you mean '~input'
          </node>
        </launch>
        //- interfaces
        {"/source": {"publishers": {"points": "sensor_msgs/PointCloud2"}},
         "/filter": {"subscribers": {"~input": "sensor_msgs/PointCloud2"}}}
    """)


def test_a_service_client() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="base"/>
          <node pkg="p" type="t" name="dock">
            <remap from="rest" to="base/clear"/>
                         ^^^^ warning[TOP004] did you mean 'reset', which it calls
          </node>
        </launch>
        //- interfaces
        {"/base": {"services": {"base/clear": "std_srvs/Empty"}}, "/dock": {"clients": {"reset": "std_srvs/Empty"}}}
    """)


def test_without_a_near_name_it_is_a_hint() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TOP002]
            <remap from="battery" to="power"/>
                         ^^^^^^^ hint[TOP004] remap of '/battery' has no effect: /n does not use that name before its
          </node>
        </launch>
        //- interfaces
        {"/n": {"publishers": {"odom": "nav_msgs/Odometry"}}}
    """)


@pytest.mark.silent
def test_what_libraries_make_of_names_is_used() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <remap from="image/compressed" to="small"/>
            <remap from="camera_info" to="info"/>
            <remap from="dock" to="station/dock"/>
            <remap from="/tf" to="tf"/>
            <remap from="rate" to="speed"/>
            <remap from="old" to="given"/>
          </node>
          <node pkg="p" type="t" name="m"/>
        </launch>
        //- interfaces
        {"/n": {"publishers": {"image": "x/I", "given": "x/J"}, "subscribers": {"dock/goal": "x/DockActionGoal"},
                "params": {"rate": 3}},
         "/m": {"subscribers": {"image": "x/I", "given": "x/J"}}}
    """)


def test_a_remap_around_nodes_has_to_be_idle_at_all_of_them() -> None:
    check("""
        <launch>
          <remap from="scan" to="front/scan"/>
          <remap from="sonar" to="front/sonar"/>
                       ^^^^^ hint[TOP004] remap of '/sonar' has no effect: none of its 2 nodes uses that name before
          <node pkg="p" type="t" name="a"/>
          <node pkg="p" type="t" name="b"/>
        </launch>
        //- interfaces
        {"/a": {"publishers": {"scan": "x/S"}, "subscribers": {"odom": "x/O"}},
         "/b": {"publishers": {"odom": "x/O"}, "subscribers": {"/front/scan": "x/S"}}}
    """)


@pytest.mark.parametrize(
    ("remap", "told"), [("~input_image", ["warning"]), ("input_imgae", []), ("other", []), ("input_image", [])]
)
def test_a_tilde_too_many_at_a_node_that_its_source_tells_in_part(remap: str, told: list[str]) -> None:
    found = findings_of(f"""
        <launch>
          <node pkg="p" type="t" name="servoing" ns="arm"><remap from="{remap}" to="/camera/image_raw"/></node>
        </launch>
        //- interfaces
        {{"/arm/servoing": {{"source": "source", "status": "not-run",
          "subscribers": {{"input_image": "sensor_msgs/Image"}}}}}}
    """)
    assert [each.severity for each in found if each.rule == "TOP004"] == told


@pytest.mark.parametrize(
    ("remap", "meant"),
    [("scam", "scan"), ("~scan", "scan"), ("mpa_metadata", "map_metadata"), ("scan2", None), ("clouds", None)],
)
def test_a_typo_at_a_node_that_the_catalogue_has_in_part(remap: str, meant: str | None) -> None:
    found = findings_of(f"""
        <launch>
          <node pkg="p" type="t" name="karto"><remap from="{remap}" to="base_scan"/></node>
        </launch>
        //- interfaces
        {{"/karto": {{"source": "catalogue", "status": "not-run", "params": {{"/": {{"access": "list"}}}},
          "subscribers": {{"scan": "sensor_msgs/LaserScan"}},
          "publishers": {{"map_metadata": "nav_msgs/MapMetaData"}}}}}}
    """)
    told = [(each.severity, each.confidence) for each in found if each.rule == "TOP004"]
    assert told == ([("warning", "possible")] if meant else [])
    assert all(f"did you mean '{meant}'" in each.message for each in found if each.rule == "TOP004")


@pytest.mark.parametrize(
    ("source", "target", "severity"),
    [
        ("/cloud", "/ouster/points", "warning"),
        ("/cloud", "/ouster/raw", "hint"),
        ("/pose", "/ouster/points", "hint"),
    ],
)
def test_a_remap_of_what_an_end_carries_to_what_ends_as_its_name(source: str, target: str, severity: str) -> None:
    found = findings_of(f"""
        <launch>
          <node pkg="p" type="t" name="localizer"><remap from="{source}" to="{target}"/></node>
        </launch>
        //- interfaces
        {{"/localizer": {{"subscribers": {{"velodyne_points": "sensor_msgs/PointCloud2"}},
          "publishers": {{"result": "x/Y"}}}}}}
    """)
    assert [each.severity for each in found if each.rule == "TOP004"] == [severity]


@pytest.mark.silent
def test_nothing_is_said_of_a_node_that_is_not_known_to_its_end() -> None:
    launch = """
        <launch>
          <node pkg="p" type="t" name="a"><remap from="scna" to="front"/></node>
        </launch>
        //- interfaces
    """
    crashed = '{"/a": {"status": "crashed", "exit_code": 1, "subscribers": {"scan": "x/S"}}}'
    nothing = '{"/a": {}}'
    guessed = '{"/a": {"subscribers": {"scan": "x/S"}, "speculative": ["scan"]}}'
    for interfaces in (crashed, nothing, guessed):
        assert [f for f in findings_of(launch + interfaces) if f.rule == "TOP004"] == []
    annotated = """
        <launch>
          <node pkg="p" type="t" name="a">
            <remap from="scna" to="front"/>
            <!-- <topics><topic name="scan" type="x/S" class="sub"/></topics> -->
          </node>
        </launch>
    """
    assert [f for f in findings_of(annotated) if f.rule == "TOP004"] == []


@pytest.mark.silent
def test_a_nodelet_may_subscribe_later() -> None:
    check("""
        <launch>
          <node pkg="nodelet" type="nodelet" name="manager" args="manager"/>
          <node pkg="nodelet" type="nodelet" name="rectify" args="load image_proc/rectify manager">
            <remap from="image_mono" to="camera/image_raw"/>
          </node>
        </launch>
        //- /nodelet/package.xml
        <package><name>nodelet</name></package>
        //- interfaces
        {"/manager": {}, "/rectify": {"publishers": {"~parameter_updates": "dynamic_reconfigure/Config"}}}
    """)


@pytest.mark.silent
def test_a_remap_of_an_actions_name_has_an_effect() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="base"><remap from="move_base" to="go"/></node>
        </launch>
        //- interfaces
        {"/base": {"publishers": {"move_base/status": "actionlib_msgs/GoalStatusArray",
                                  "move_base/feedback": "m/GoActionFeedback", "move_base/result": "m/GoActionResult"},
                   "subscribers": {"move_base/goal": "m/GoActionGoal", "move_base/cancel": "actionlib_msgs/GoalID"}}}
    """)


@pytest.mark.parametrize(
    ("source", "args", "more", "severity"),
    [
        ("cmd_vel", "", {}, "info"),
        ("/base/cmd_vel", "", {}, "warning"),
        ("/robot/cmd_vel", "", {}, "info"),
        ("/image_rect/compressed", "", {}, "hint"),
        ("/base/cmd_vel", "/in1", {}, None),
        ("/base/cmd_vel", "", {"params": {"/": {"access": "list"}}}, None),
        ("/base/cmd_vel", "", {"subscribers": {}, "services": {"reset": "std_srvs/Empty"}}, None),
    ],
)
def test_a_node_that_the_catalogue_has(source: str, args: str, more: dict[str, object], severity: str | None) -> None:
    interface = {
        "source": "catalogue",
        "status": "not-run",
        "subscribers": {"joint_states": "sensor_msgs/JointState"},
        **more,
    }
    found = findings_of(f"""
        <launch>
          <node pkg="p" type="state" name="state" ns="robot" args="{args}"><remap from="{source}" to="/moves"/></node>
        </launch>
        //- interfaces
        {json.dumps({"/robot/state": interface})}
    """)
    remaps = [each for each in found if each.rule == "TOP004"]
    assert [(each.severity, each.confidence) for each in remaps] == ([(severity, "possible")] if severity else [])


def test_a_name_that_is_given_to_itself_in_place_of_the_node_s_own() -> None:
    findings = findings_of("""
        <launch>
          <node pkg="p" type="t" name="ekf"/>
          <node pkg="p" type="t" name="navsat">
            <remap from="imu/data" to="imu/data"/>
          </node>
        </launch>
        //- interfaces
        {"/ekf": {"subscribers": {"imu/data": "sensor_msgs/Imu"}},
         "/navsat": {"subscribers": {"imu": "sensor_msgs/Imu", "odom": "nav_msgs/Odometry"}}}
    """)
    assert "LCH024" not in [finding.rule for finding in findings]
    (finding,) = [finding for finding in findings if finding.rule == "TOP004"]
    assert finding.severity == "warning"
    assert "did you mean 'imu', which it subscribes to and which is unconnected?" in finding.message


@pytest.mark.silent
def test_a_name_that_is_given_to_itself_by_default_alone() -> None:
    findings = findings_of("""
        <launch>
          <arg name="imu" default="imu/data"/>
          <node pkg="p" type="t" name="ekf"/>
          <node pkg="p" type="t" name="navsat">
            <remap from="imu/data" to="$(arg imu)"/>
          </node>
        </launch>
        //- interfaces
        {"/ekf": {"subscribers": {"imu/data": "sensor_msgs/Imu"}},
         "/navsat": {"subscribers": {"imu": "sensor_msgs/Imu", "odom": "nav_msgs/Odometry"}}}
    """)
    assert "TOP004" not in [finding.rule for finding in findings]


def test_a_private_name_that_was_meant_by_the_plain_one() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="marker">
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TOP002] '/marker/cmd_vel' has no subscriber
            <remap from="cmd_vel" to="/cmd_vel"/>
                         ^^^^^^^ warning[TOP004] did you mean '~cmd_vel', which it publishes and which is unconnected?
          </node>
        </launch>
        //- interfaces
        {"/marker": {"source": "catalogue", "publishers": {"~cmd_vel": "geometry_msgs/Twist"}}}
    """)


@pytest.mark.silent
def test_a_name_that_the_node_uses_is_given_to_itself_out_of_habit() -> None:
    findings = findings_of("""
        <launch>
          <node pkg="p" type="t" name="navsat">
            <remap from="gps/fix" to="/gps/fix"/>
          </node>
        </launch>
        //- interfaces
        {"/navsat": {"subscribers": {"gps/fix": "sensor_msgs/NavSatFix"},
                     "publishers": {"fix": "sensor_msgs/NavSatFix"}}}
    """)
    assert "TOP004" not in [finding.rule for finding in findings]


def test_a_name_that_a_module_of_the_package_has_may_be_used_later(tmp_path: Path) -> None:
    text = f"""
        //- {tmp_path}/main.launch
        <launch><node pkg="p" type="t" name="n"><remap from="align/cancel" to="control/cancel"/></node></launch>
        //- {tmp_path}/package.xml
        <package><name>p</name></package>
        //- interfaces
        {{"/n": {{"publishers": {{"follow/cancel": "std_msgs/Empty"}}}}}}
    """
    (tmp_path / "main.launch").touch()
    assert [f.severity for f in findings_of(text) if f.rule == "TOP004"] == ["warning"]
    (tmp_path / "states.py").write_text('State("align/cancel", Trigger)')
    (finding,) = [f for f in findings_of(text) if f.rule == "TOP004"]
    assert finding.severity == "hint"
    assert finding.message.endswith("before its event loop; a source of its package has the name")


@pytest.mark.silent
def test_a_name_below_one_that_the_node_may_have_resolved() -> None:
    findings = findings_of("""
        <launch>
          <node pkg="p" type="t" name="view">
            <remap from="image" to="front"/>
            <remap from="/front/point" to="/point"/>
          </node>
        </launch>
        //- interfaces
        {"/view": {"source": "catalogue", "subscribers": {"image": "x/Y"}, "publishers": {"image/point": "x/Z"}}}
    """)
    assert "TOP004" not in [finding.rule for finding in findings]


_SWAPPED = """
        <launch>
          <node pkg="p" type="t" name="laser"/>
          <node pkg="p" type="t" name="slam">
            <remap from="{}" to="{}"/>
          </node>
        </launch>
        //- interfaces
        {{"/laser": {{"source": "source", "publishers": {{"{}": "sensor_msgs/LaserScan"}}}},
          "/slam": {{"source": "source", "subscribers": {{"beams": "sensor_msgs/LaserScan"}}}}}}
    """


def test_from_and_to_the_wrong_way_around() -> None:
    (finding,) = [f for f in findings_of(_SWAPPED.format("scan", "beams", "scan")) if f.rule == "TOP004"]
    assert finding.severity == "warning"
    assert finding.message.endswith("'from' and 'to' are swapped: it subscribes to 'beams'")


@pytest.mark.silent
@pytest.mark.parametrize(
    ("source", "target", "published"), [("beams", "scan", "scan"), ("scan", "beams", "beams"), ("scan", "beams", "x")]
)
def test_from_and_to_as_they_are_meant(source: str, target: str, published: str) -> None:
    assert [f for f in findings_of(_SWAPPED.format(source, target, published)) if f.rule == "TOP004"] == []


_CONTROLLERS = """
controller_manager:
  ros__parameters:
    base: {type: diff_drive_controller/DiffDriveController}
base:
  ros__parameters: {left_wheel_names: [l], right_wheel_names: [r]}
"""


@pytest.mark.parametrize(
    ("source", "severity", "said"),
    [
        ("/base/cmd_vel", "warning", "only asks for /base, which subscribes to '/base/cmd_vel' in the process of /c"),
        (
            "~/odom",
            "warning",
            "only asks for /base, which publishes '/base/odom' in the process of /controller_manager",
        ),
        ("cmd_vel", "info", "/spawn does not use that name according to the catalogue"),
        ("/controller_manager/list_controllers", None, ""),
    ],
)
def test_a_spawner_hands_no_remap_on_to_its_controllers(
    tmp_path: Path, source: str, severity: str | None, said: str
) -> None:
    text = f"""
        <launch>
          <node pkg="controller_manager" exec="ros2_control_node"><param from="$(dirname)/c.yaml"/></node>
          <node pkg="controller_manager" exec="spawner" name="spawn" args="base">
            <remap from="{source}" to="/moves"/>
          </node>
        </launch>
    """
    analysis = package_elsewhere.analysed(tmp_path, text, "a.launch.xml", "jazzy", **{"c.yaml": _CONTROLLERS})
    found = [each for each in run_rules(analysis.context) if each.rule == "TOP004"]
    assert [each.severity for each in found] == ([severity] if severity else [])
    assert all(said in each.message for each in found)
