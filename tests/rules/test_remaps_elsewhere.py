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
