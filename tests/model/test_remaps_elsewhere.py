"""Remaps that the launch files around one write otherwise: TOP001, TOP002 and SRV001."""

import time
from pathlib import Path

import pytest
from support.check import apply, check

LISTENER = '<launch><node pkg="p" type="t" name="other"><remap from="in" to="{}"/></node></launch>'
FIXTURE = """
    //- {0}/main.launch
    <launch>
      <node pkg="p" type="t" name="listener" ns="robot">
        <remap from="in" to="{1}"/>
                             {2}
      </node>
    </launch>
    //- interfaces
    {{"/robot/listener": {{"{3}": {{"in": "{4}"}}}}}}
    //- {0}/package.xml
    <package><name>p</name></package>
"""


def _fixture(folder: Path, said: str, role: str, type_: str, name: str, others: list[str]) -> str:
    for number, other in enumerate(others):
        (folder / f"other{number}.launch").write_text(LISTENER.format(other))
    (folder / "main.launch").touch()
    return FIXTURE.format(folder, name, "^" * len(name) + f" {said}", role, type_)


@pytest.mark.parametrize(
    ("rule", "role", "type_"),
    [
        ("TOP001", "subscribers", "sensor_msgs/LaserScan"),
        ("TOP002", "publishers", "sensor_msgs/LaserScan"),
        ("SRV001", "clients", "std_srvs/Empty"),
    ],
)
def test_a_slip_of_what_several_others_have(tmp_path: Path, rule: str, role: str, type_: str) -> None:
    text = _fixture(
        tmp_path, f"info[{rule}] did you mean '/base_scan', as in 2 launch files nearby?",
        role, type_, "/base_scann", ["/base_scan", "/base_scan"],
    )  # fmt: skip
    (finding,) = check(text)
    assert finding.confidence == "possible"
    (fix,) = finding.fixes
    assert 'to="/base_scan"' in apply(text, fix.edits)[f"{tmp_path}/main.launch"]


@pytest.mark.parametrize(
    ("name", "others"),
    [
        ("/base_scann", ["/base_scan"]),
        ("/base_scann", ["/base_scan", "/base_scan", "/base_scann"]),
        ("/base_scann", ["base_scan", "base_scan"]),
        ("/scan1", ["/scan2", "/scan2"]),
        ("/left/image", ["/right/image", "/right/image"]),
        ("/joint_x", ["/joint_y", "/joint_y"]),
        ("/base_scann", ["$(arg base_scan)", "$(arg base_scan)"]),
    ],
)
def test_others_than_slips_in_the_same_place_are_no_news(tmp_path: Path, name: str, others: list[str]) -> None:
    said = (
        f"hint[TOP001] '{name}' (sensor_msgs/LaserScan) has no publisher in this launch (subscriber: /robot/listener)"
    )
    (finding,) = check(_fixture(tmp_path, said, "subscribers", "sensor_msgs/LaserScan", name, others))
    assert "did you mean" not in finding.message


@pytest.mark.parametrize(("written", "severity"), [("/pmap", "info"), ("/other", "warning")])
def test_a_topic_that_several_launch_files_write_is_no_slip(tmp_path: Path, written: str, severity: str) -> None:
    (tmp_path / "a.launch").write_text(f"<launch><remap from='map' to='{written}'/></launch>")
    (tmp_path / "b.launch").write_text(f"<launch><node args='play'><remap from='{written}' to='/x'/></node></launch>")
    (tmp_path / "main.launch").touch()
    check(f"""
        //- {tmp_path}/main.launch
        <launch>
          <node pkg="p" type="t" name="slam"/>
          <node pkg="p" type="t" name="merge"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ {severity}[TOP001] '/pmap' has no publisher (subscriber: /merge)
        </launch>
        //- interfaces
        {{"/slam": {{"publishers": {{"/map": "nav_msgs/OccupancyGrid"}}}},
         "/merge": {{"subscribers": {{"/pmap": "nav_msgs/OccupancyGrid"}}}}}}
        //- {tmp_path}/package.xml
        <package><name>p</name></package>
    """)


def test_files_of_blanks_take_no_time(tmp_path: Path) -> None:
    blanks = ["\n" * 200_000, " \t" * 100_000, "- " * 100_000, "(" * 200_000, "<remap to='" * 20_000]
    for at, text in enumerate(blanks):
        (tmp_path / f"blank{at}.launch").write_text(text)
    said = "hint[TOP001] '/base_scann'"
    started = time.process_time()
    check(_fixture(tmp_path, said, "subscribers", "sensor_msgs/LaserScan", "/base_scann", ["/base_scan"]))
    assert time.process_time() - started < 10


@pytest.mark.parametrize(
    ("rule", "role", "name", "meant"),
    [
        ("TOP001", "subscribers", "/zednode/info", "/zed/node/info"),
        ("TOP002", "publishers", "/zed/nodergb/info", "/zed/node/rgb/info"),
        ("SRV001", "clients", "/zed/nodergb", "/zed/node/rgb"),
    ],
)
def test_a_slash_that_another_remap_of_the_node_has(rule: str, role: str, name: str, meant: str) -> None:
    check(
        f"""
        <launch>
          <node pkg="p" type="t" name="listener">
            <remap from="image" to="/zed/node/rgb/image"/>
            <remap from="in" to="{name}"/>
                                 {"^" * len(name)} \
warning[{rule}] did you mean '{meant}', as in '/zed/node/rgb/image' of the same node?
          </node>
        </launch>
        //- interfaces
        {{"/listener": {{"{role}": {{"in": "a/B"}}, "services": {{"image": "a/C"}}}}}}
        """
    )


@pytest.mark.parametrize("name", ["/zed/nodes/info", "/other/nodergb/info", "/zed/noder/info", "/zed/node/rgb/info"])
def test_no_other_remap_says_that_a_slash_is_missing(name: str) -> None:
    for finding in check(
        f"""
        //- interfaces
        {{"/listener": {{"subscribers": {{"in": "a/B"}}, "services": {{"image": "a/C"}}}}}}
        //- main.launch
        <launch>
          <node pkg="p" type="t" name="listener">
            <remap from="image" to="/zed/node/rgb/image"/>
            <remap from="in" to="{name}"/>
                                 {"^" * len(name)} hint[TOP001]
          </node>
        </launch>
        """
    ):
        assert "did you mean" not in finding.message


def _published(name: str, said: str, beside: str = "/teleop", type_: str = "a/B") -> str:
    return f"""
        <launch>
          <node pkg="p" type="t" name="joy">
            <remap from="one" to="{beside}"/>
            <remap from="two" to="{name}"/>
                                  {"^" * len(name)} {said}
          </node>
          <node pkg="p" type="t" name="mux"/>
        </launch>
        //- interfaces
        {{
          "/joy": {{"publishers": {{"one": "a/B", "two": "{type_}"}}}},
          "/mux": {{"subscribers": {{"{beside}": "a/B"}}}}
        }}
        """


def test_a_slip_of_what_the_same_node_publishes_too() -> None:
    check(_published("/teleo", "warning[TOP002] did you mean '/teleop', which the same node publishes?"))


@pytest.mark.parametrize(
    ("name", "beside", "type_"),
    [
        ("/teleo", "/teleop", "a/C"),
        ("/scan_2", "/scan_1", "a/B"),
        ("/left/cmd", "/right/cmd", "a/B"),
        ("/teleoperate", "/teleop", "a/B"),
        ("/joint_x", "/joint_y", "a/B"),
    ],
)
def test_no_slip_of_what_the_same_node_publishes(name: str, beside: str, type_: str) -> None:
    (finding,) = check(_published(name, "hint[TOP002]", beside, type_))
    assert "did you mean" not in finding.message
