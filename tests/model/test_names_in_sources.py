"""Topics and services that the sources of the workspace call otherwise: TOP001 and SRV001."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.check import findings_of

FIXTURE = """
    //- {0}/main.launch
    <launch><node pkg="p" type="t" name="reader"/></launch>
    //- interfaces
    {{"/reader": {{"{1}": {{"{2}": "{3}"}}}}}}
    //- {0}/package.xml
    <package><name>p</name></package>
"""
OFFERED = {
    "a.py": 'self.create_publisher(State, "as_status", 10)',
    "b.py": 'rospy.Publisher("/as_status", State, queue_size=1)',
    "c.cpp": 'node->create_publisher<my_msgs::msg::State>("as_status", 10);',
    "d.cpp": 'nh.advertise<my_msgs::State>("as_status", 10);',
}


def _told(folder: Path, sources: dict[str, str], role: str, name: str, type_: str) -> list[tuple[str, str, str]]:
    for file, text in sources.items():
        (folder / file).write_text(text)
    (folder / "main.launch").touch()
    found = findings_of(FIXTURE.format(folder, role, name, type_))
    return [(each.rule, each.severity, each.message) for each in found]


@pytest.mark.parametrize("file", list(OFFERED))
def test_what_a_node_of_another_launch_publishes(tmp_path: Path, file: str) -> None:
    ((rule, severity, message),) = _told(tmp_path, {file: OFFERED[file]}, "subscribers", "as_state", "my_msgs/State")
    assert (rule, severity) == ("TOP001", "warning")
    assert message.endswith("did you mean 'as_status', which a source file uses with this type?")


@pytest.mark.silent
@pytest.mark.parametrize(
    ("file", "text"),
    [
        ("sonar.urdf.xacro", "<remapping>~/out:=as_state</remapping>"),
        ("arm.sdf", "<topicName>/as_state</topicName>"),
        ("sim.launch.py", "arguments=['as_state@my_msgs/msg/State[gz.msgs.State']"),
    ],
)
def test_what_a_simulator_publishes_is_no_slip(tmp_path: Path, file: str, text: str) -> None:
    sources = {"a.py": OFFERED["a.py"], file: text}
    ((_, severity, _),) = _told(tmp_path, sources, "subscribers", "as_state", "my_msgs/State")
    assert severity == "hint"


def test_a_service_that_a_node_of_another_launch_offers(tmp_path: Path) -> None:
    sources = {"a.py": "rospy.Service('topological_localisation/tagged', GetTagged, self.tagged)"}
    name = "/opological_localisation/tagged"
    ((rule, severity, message),) = _told(tmp_path, sources, "clients", name, "my_srvs/GetTagged")
    assert (rule, severity) == ("SRV001", "warning")
    assert "did you mean 'topological_localisation/tagged'" in message


@pytest.mark.parametrize(("line", "severity"), [("Publisher('toMapImageGenerator', Pose)", "hint"), ("", "warning")])
def test_a_node_that_makes_both_names_means_two(tmp_path: Path, line: str, severity: str) -> None:
    (tmp_path / "b.py").write_text("rospy.Publisher('toMapImageGenerator', Pose)")
    (tmp_path / "a.py").write_text(f"rospy.Subscriber('fromMapImageGenerator', Pose, f)\n{line}\n")
    (tmp_path / "main.launch").touch()
    found = findings_of(f"""
        //- {tmp_path}/main.launch
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {{"/n": {{"subscribers": {{"fromMapImageGenerator": "my_msgs/Pose"}},
                 "made": {{"fromMapImageGenerator": ["{tmp_path}/a.py", 1]}}}}}}
        //- {tmp_path}/package.xml
        <package><name>p</name></package>
    """)
    assert [each.severity for each in found if each.rule == "TOP001"] == [severity]


def test_a_name_that_launch_files_give_is_no_slip(tmp_path: Path) -> None:
    sources = {"a.cpp": 'nh.advertise<nav_msgs::OccupancyGrid>("map", 1);'}
    for severity, written in (("warning", "/pmap0"), ("hint", "/pmap")):
        (tmp_path / "a.launch").write_text(f'<launch><remap from="map" to="{written}"/></launch>')
        (tmp_path / "b.launch").write_text(f'<launch><param name="map_in_topic" value="{written}"/></launch>')
        ((_, found, _),) = _told(tmp_path, sources, "subscribers", "/pmap", "nav_msgs/OccupancyGrid")
        assert found == severity


def test_what_several_others_subscribe_to(tmp_path: Path) -> None:
    other = 'nh.subscribe<sensor_msgs::JointState>("joint_states", 1, f);'
    sources = {"a.cpp": other, "own.cpp": 'nh.subscribe<sensor_msgs::JointState>("joint_state", 1, f);'}
    ((_, severity, _),) = _told(tmp_path, sources, "subscribers", "joint_state", "sensor_msgs/JointState")
    assert severity == "hint"
    ((_, severity, message),) = _told(
        tmp_path, {"b.cpp": other}, "subscribers", "joint_state", "sensor_msgs/JointState"
    )
    assert severity == "warning"
    assert "did you mean 'joint_states', which 2 source files use with this type?" in message


@pytest.mark.silent
@pytest.mark.parametrize(
    ("sources", "name", "type_"),
    [
        ({"a.py": OFFERED["a.py"], "b.py": 'rospy.Publisher("/robot/as_state", State)'}, "as_state", "my_msgs/State"),
        ({"a.py": OFFERED["a.py"]}, "as_state", "my_msgs/Other"),
        ({"a.py": OFFERED["a.py"]}, "mission", "my_msgs/State"),
        ({"a.py": 'rospy.Publisher("as_status", String)'}, "as_state", "std_msgs/String"),
        ({"a.py": 'rospy.Publisher("camera1", State)'}, "camera2", "my_msgs/State"),
    ],
)
def test_names_that_are_no_slips_of_what_the_sources_have(
    tmp_path: Path, sources: dict[str, str], name: str, type_: str
) -> None:
    assert "did you mean" not in _told(tmp_path, sources, "subscribers", name, type_)[0][2]
