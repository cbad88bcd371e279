"""Files that parameters and arguments name, whose content is parameters."""

from __future__ import annotations

from pathlib import Path

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import digest
from preflight_analysis.documents.span import LineIndex
from preflight_analysis.evaluation.lua_options import assignments, included
from preflight_analysis.model.frames import frames_of
from preflight_analysis.workspace.workspace import Analysis
from support.package_elsewhere import analysed

MUX = """
<launch>
  <node pkg="nodelet" type="nodelet" name="mux" args="standalone yocs_cmd_vel_mux/CmdVelMuxNodelet">
    <param name="yaml_cfg_file" value="$(dirname)/mux.yaml"/>
  </node>
</launch>
"""
SUBSCRIBERS = """
subscribers:
  - {name: default, topic: input/default, timeout: 0.1, priority: 0}
  - name: safety
    topic: /safe
publisher: output/cmd_vel
"""

LUA = """
include "map_builder.lua"
--[[ map_frame = "not this" ]]
options = {
  map_frame = "map",  -- REP 105
  tracking_frame = 'imu_link',
  published_frame = "base_link",
  odom_frame = "odom",
  provide_odom_frame = true,
  use_odometry = false,
  use_nav_sat = false,
  use_landmarks = false,
  num_multi_echo_laser_scans = 0,
  num_laser_scans = 1,
}
options.use_odometry = true
MAP_BUILDER.use_trajectory_builder_2d = true
TRAJECTORY_BUILDER_2D.use_imu_data = false
return options
"""
CARTOGRAPHER = """
<launch>
  <node pkg="cartographer_ros" exec="cartographer_node" name="slam"
    args="-configuration_directory $(dirname)/config -configuration_basename robot.lua"/>
</launch>
"""


def topics(analysis: Analysis) -> dict[str, str]:
    """The topics of the only node whose parameter or argument names a file: `<` for one that it subscribes to."""
    assert analysis.graph is not None
    ends = [end for end in analysis.graph.interfaces[0].endpoints if "what is known of" in end.evidence.said_by]
    return {end.name: f"{'<' if end.role == 'subscriber' else '>'} {end.type}" for end in ends}


def test_a_file_of_yaml(tmp_path: Path) -> None:
    analysis = analysed(tmp_path, MUX, distro="noetic", **{"mux.yaml": SUBSCRIBERS})
    assert topics(analysis) == {
        "~input/default": "< geometry_msgs/Twist",
        "/safe": "< geometry_msgs/Twist",
        "~output/cmd_vel": "> geometry_msgs/Twist",
    }


def test_a_finding_is_in_that_file(tmp_path: Path) -> None:
    driver = '<node pkg="p" type="t" name="joy"><!-- <topics><topic name="/saef" type="geometry_msgs/Twist" '
    launch = MUX.replace("</launch>", f'{driver}class="pub"/></topics> --></node></launch>')
    analysis = analysed(tmp_path, launch, distro="noetic", **{"mux.yaml": SUBSCRIBERS})
    found = next(each for each in analysis.findings if each.rule == "TOP001" and "did you mean" in each.message)
    text = analysis.documents[found.location.file].text
    assert text[slice(*found.location.span)] == "topic"
    (edit,) = found.fixes[0].edits
    assert (text[slice(*edit.location.span)], edit.text) == ("/safe", "/saef")


def test_a_file_that_is_no_such_thing(tmp_path: Path) -> None:
    for at, content in enumerate(("", "[", "3", "subscribers: {a: 1}", "&a [*a]")):
        analysis = analysed(tmp_path / str(at), MUX, distro="noetic", **{"mux.yaml": content})
        assert topics(analysis) == {}
    assert topics(analysed(tmp_path / "none", MUX, distro="noetic")) == {}


def test_a_file_of_lua_whose_folder_is_another_argument(tmp_path: Path) -> None:
    analysis = analysed(tmp_path, CARTOGRAPHER, "a.launch.xml", "humble", **{"config/robot.lua": LUA})
    assert topics(analysis) == {"scan": "< sensor_msgs/msg/LaserScan", "odom": "< nav_msgs/msg/Odometry"}
    frames = frames_of(analysis.context)
    assert {(edge.parent, edge.child) for edge in frames.edges} == {("map", "odom"), ("odom", "base_link")}
    assert {use.frame: use.looked_up for use in frames.uses} == {
        "map": False,
        "imu_link": True,
        "base_link": True,
        "odom": False,
    }


def test_without_the_file_its_frames_are_not_known(tmp_path: Path) -> None:
    analysis = analysed(tmp_path, CARTOGRAPHER, "a.launch.xml", "humble")
    assert frames_of(analysis.context).gaps == ("the frames that /slam broadcasts are not known",)


def _document(text: str) -> Document:
    return Document("/a.lua", text, digest(text), (), (), LineIndex(text))


def test_assignments_of_lua() -> None:
    text = """
    options = { a = "x", b = 1,
      c = true, }
    options.d = -2.5;  -- yes
    TABLE.e = 'it'
    f = prefix .. "g"
    local h = "i"
    if a == "x" then
    -- j = 1
    """
    values = {each.name: each.value for each in assignments(_document(text))}
    # What stands on one line with others is not plain.
    assert values == {"options": None, "c": True, "d": -2.5, "TABLE.e": "it", "f": None}


def test_files_that_lua_includes() -> None:
    assert included(_document('include "a.lua"\n-- include "b.lua"\ninclude("c/d.lua")')) == ("a.lua", "c/d.lua")


def test_a_file_that_is_not_in_its_folder(tmp_path: Path) -> None:
    analysis = analysed(tmp_path, CARTOGRAPHER, "a.launch.xml", "humble", **{"config/robt.lua": LUA})
    (found,) = [each for each in analysis.findings if each.rule == "PRM005"]
    assert "config/robot.lua' in the arguments of 'cartographer_node' does not exist; did you mean" in found.message
    there = analysed(tmp_path / "there", CARTOGRAPHER, "a.launch.xml", "humble", **{"config/robot.lua": LUA})
    assert not [each for each in there.findings if each.rule == "PRM005"]


def test_what_the_catalogue_has_under_other_conditions_is_not_made(tmp_path: Path) -> None:
    launch = CARTOGRAPHER.replace("exec=", "type=")
    names = topics_of_all(analysed(tmp_path, launch, "a.launch", "noetic", **{"config/robot.lua": LUA}))
    assert {"scan", "odom"} <= names
    assert names.isdisjoint({"imu", "fix", "landmark", "echoes"})
    unknown = topics_of_all(analysed(tmp_path / "unknown", launch, "a.launch", "noetic"))
    assert {"odom", "imu", "fix"} <= unknown


def topics_of_all(analysis: Analysis) -> set[str]:
    assert analysis.graph is not None
    return {end.name for end in analysis.graph.interfaces[0].endpoints}
