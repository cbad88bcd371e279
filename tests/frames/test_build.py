"""The frames of a launch, and who broadcasts them."""

import json

import pytest
from preflight_analysis.frames.forest import Branch, forest
from preflight_analysis.frames.model import Frames
from preflight_analysis.model.frames import frames_of, place_of_edge
from support.check import analyse, read_fixture

_PACKAGES = "".join(
    f"\n//- /{name}/package.xml\n<package><name>{name}</name></package>"
    for name in ("robot_state_publisher", "tf2_ros", "robot_localization", "rviz2", "rviz")
)
_URDF = (
    '<link name="base"/><link name="wheel"/><link name="lidar"/>'
    '<joint name="turn" type="continuous"><parent link="base"/><child link="wheel"/></joint>'
    '<joint name="hold" type="fixed"><parent link="base"/><child link="lidar"/></joint>'
)
_ESCAPED = f"<robot>{_URDF}</robot>".replace("<", "&lt;").replace('"', "&quot;")
_ROBOT = f'<param name="robot_description" value="{_ESCAPED}"/>'


def _frames(nodes: str, *, ros: int = 2, more: str = "") -> Frames:
    start = "//- /main.launch.xml\n" if ros == 2 else ""
    return frames_of(analyse(read_fixture(f"{start}<launch>\n{nodes}\n</launch>{_PACKAGES}{more}")))


def _edges(frames: Frames) -> set[tuple[str, str, bool]]:
    return {(edge.parent, edge.child, edge.static) for edge in frames.edges}


def _publisher(more: str = "") -> str:
    return f'<node pkg="robot_state_publisher" exec="robot_state_publisher" name="rsp">{_ROBOT}{more}</node>'


def test_a_robot_description() -> None:
    frames = _frames(_publisher())
    assert _edges(frames) == {("base", "wheel", False), ("base", "lidar", True)}
    assert {edge.by for edge in frames.edges} == {"/rsp (joint turn)", "/rsp (joint hold)"}


def test_links_with_a_slash() -> None:
    """As in an old URDF of cartographer_ros: who hears of it takes the slash off."""
    frames = _frames(_publisher().replace("lidar", "/lidar"))
    assert frames.names("") == {"base", "wheel", "lidar"}


def test_a_prefix_is_put_before_it_as_it_is() -> None:
    frames = _frames(_publisher('<param name="frame_prefix" value="one/"/>'))
    assert frames.names("") == {"one/base", "one/wheel", "one/lidar"}


@pytest.mark.parametrize(("where", "expected"), [("", "one/base"), ("rsp/", "one/base"), ("elsewhere/", "base")])
def test_the_prefix_of_ros_1_is_searched(where: str, expected: str) -> None:
    node = '<node pkg="robot_state_publisher" type="robot_state_publisher" name="rsp"/>'
    frames = _frames(f'{_ROBOT}<param name="{where}tf_prefix" value="/one"/>{node}', ros=1)
    assert expected in frames.names("")


def test_a_description_that_nobody_publishes() -> None:
    frames = _frames(_ROBOT, ros=1)
    assert _edges(frames) == {("base", "wheel", False), ("base", "lidar", True)}
    assert not any(edge.sure or edge.node for edge in frames.edges)


def test_the_xacro_of_ours_leaves_no_gap() -> None:
    line = "xacro /p/r.xacro"
    node = '<node pkg="robot_state_publisher" type="robot_state_publisher" name="rsp"/>'
    param = '<param name="robot_description" command="$(find xacro)/xacro /p/r.xacro"/>'
    made = f"\n//- commands\n{json.dumps({line: {'output': f'<robot>{_URDF}</robot>'}})}"
    frames = _frames(param + node, ros=1, more=made)
    assert not frames.gaps
    assert frames.names("") == {"base", "wheel", "lidar"}


def test_static_transforms() -> None:
    node = '<node pkg="tf2_ros" exec="static_transform_publisher" name="{}" args="{}"/>'
    frames = _frames(
        node.format("old", "0 0 0 0 0 0 /map odom")
        + node.format("new", "--x 1 --frame-id base --child-frame-id lidar --ros-args -p use_sim_time:=true")
        + node.format("half", "--frame-id base")
    )
    assert _edges(frames) == {("map", "odom", True), ("base", "lidar", True)}


def test_what_the_source_says() -> None:
    frames = {
        "frames": [
            ["odom", "base", False, True, False, "/p/d.cpp", 3],
            ["odom", "cart", False, True, True, "/p/d.cpp", 4],
        ]
    }
    found = _frames('<node pkg="p" exec="n" name="n"/>', more=f"\n//- interfaces\n{json.dumps({'/n': frames})}")
    assert [(edge.child, edge.by, edge.doubt) for edge in found.edges] == [
        ("base", "/n (d.cpp:3)", "likely"), ("cart", "/n (d.cpp:4)", "possible"),
    ]  # fmt: skip
    assert found.complete


def test_a_frame_that_the_source_does_not_tell() -> None:
    frames = {"frames": [["odom", "base", False, True, False, "/p/d.cpp", 3], ["", "cart", False, True]]}
    found = _frames('<node pkg="p" exec="n" name="n"/>', more=f"\n//- interfaces\n{json.dumps({'/n': frames})}")
    assert _edges(found) == {("odom", "base", False)}
    assert found.gaps == ("the frames that /n broadcasts are not known",)


def test_what_runs_saw() -> None:
    interfaces = json.dumps({"/n": {"frames": [["/odom", "base"]], "answers": [
        "it waits for the transform map <- lidar, and was given the identity",
        "it asks for the transform map <- /arm again and again, and was given the identity",
    ]}})  # fmt: skip
    frames = _frames('<node pkg="p" exec="n" name="n"/>', more=f"\n//- interfaces\n{interfaces}")
    assert _edges(frames) == {("odom", "base", False)}
    assert [(use.frame, use.written) for use in frames.uses] == [
        ("map", "map"), ("lidar", "lidar"), ("map", "map"), ("arm", "/arm"),
    ]  # fmt: skip


def test_what_is_known_of_a_package() -> None:
    node = """<node pkg="robot_localization" exec="ekf_node" name="ekf">
      <param name="base_link_frame" value="base"/>{}</node>"""
    frames = _frames(node.format(""))
    assert ("odom", "base", False) in _edges(frames)
    assert {use.frame for use in frames.uses if use.looked_up} == {"base"}
    assert frames.complete
    assert not _frames(node.format('<param name="publish_tf" value="false"/>')).edges


def test_frames_that_no_parameter_names() -> None:
    madgwick = '<node pkg="imu_filter_madgwick" exec="imu_filter_madgwick_node" name="imu">{}</node>'
    package = "\n//- /imu_filter_madgwick/package.xml\n<package><name>imu_filter_madgwick</name></package>"
    frames = _frames(madgwick.format(""), more=package)
    assert not frames.edges
    assert frames.gaps == ("the frames that /imu broadcasts are not known",)
    silent = _frames(madgwick.format('<param name="publish_tf" value="false"/>'), more=package)
    assert "broadcasts" not in "".join(silent.gaps)


def test_a_frame_whose_name_is_made_of_a_parameter() -> None:
    node = '<node pkg="mavros" type="mavros_node" name="mavros"><param name="map_frame_id" value="local"/></node>'
    edges = _edges(_frames(node, ros=1, more="\n//- /mavros/package.xml\n<package><name>mavros</name></package>"))
    assert {("local", "local_ned", True), ("odom", "odom_ned", True)} <= edges


def test_namespaces_of_tf_are_apart() -> None:
    node = """<node pkg="tf2_ros" exec="static_transform_publisher" name="{0}" namespace="{0}"
      args="0 0 0 0 0 0 map odom">{1}</node>"""
    frames = _frames(node.format("a", '<remap from="/tf" to="tf"/>') + node.format("b", ""))
    assert frames.spaces == ("", "/a")


def test_what_may_be_missing() -> None:
    interfaces = json.dumps({"/b": {"publishers": {"/tf": "tf2_msgs/msg/TFMessage"}}, "/c": {}})
    nodes = "".join(f'<node pkg="p" exec="{name}" name="{name}"/>' for name in "abc")
    frames = _frames(nodes, more=f"\n//- interfaces\n{interfaces}")
    assert frames.gaps == ("the frames that /b broadcasts are not known", "1 of 3 nodes are not analysed: /a")


def test_parameters_that_name_frames() -> None:
    params = '<param name="lidarFrame" value="lidar"/><param name="frames" value="x"/>'
    frames = _frames(f'<node pkg="p" exec="n" name="n">{params}</node>')
    assert [(each.frame, each.parameter) for each in frames.mentions] == [("lidar", "lidarFrame")]


def test_the_fixed_frame_of_rviz() -> None:
    config = "\n//- /p/a.rviz\nVisualization Manager:\n  Global Options:\n    Fixed Frame: map\n"
    frames = _frames('<node pkg="rviz2" exec="rviz2" name="rviz" args="-d /p/a.rviz"/>', more=config)
    assert [(use.frame, use.what) for use in frames.uses] == [("map", "Fixed Frame of a.rviz")]


def test_trees_to_be_shown() -> None:
    interfaces = json.dumps({"/n": {"frames": [["odom", "base"], ["one", "two"], ["two", "one"], ["self", "self"]]}})
    frames = _frames(_publisher() + '<node pkg="p" exec="n" name="n"/>', more=f"\n//- interfaces\n{interfaces}")

    def plain(branch: Branch) -> object:
        return [branch.frame, *map(plain, branch.children)]

    trees = [plain(tree) for tree in forest(frames, "")]
    assert trees[0] == ["odom", ["base", ["wheel"], ["lidar"]]]
    assert sorted(str(tree) for tree in trees[1:]) == ["['self']", "['two', ['one']]"]
    assert frames.root("", "lidar") == "odom"
    assert [edge.parent for edge in frames.path("", "lidar")] == ["base", "odom"]


def test_the_place_of_a_joint() -> None:
    urdf = f"<!-- | autogenerated by xacro from /p/r.xacro | --><robot>{_URDF}</robot>"
    launch = '<launch><param name="robot_description" command="xacro r"/></launch>'
    more = f"\n//- commands\n{json.dumps({'xacro r': {'output': urdf}})}\n//- /p/r.xacro\n<robot>{_URDF}</robot>"
    context = analyse(read_fixture(launch + more))
    (turn, _) = frames_of(context).edges
    assert context.text(place_of_edge(context, turn)) == "turn"


@pytest.mark.parametrize(("distro", "doubt"), [("noetic", "likely"), ("jazzy", "possible")])
def test_a_joint_of_the_catalogue(distro: str, doubt: str) -> None:
    comment = f"&lt;!-- from the catalogue of ros-preflight for {distro}, parts --&gt;"
    described = _ROBOT.replace("&lt;robot", f"{comment}&lt;robot", 1).replace(
        "type=", "preflight=&quot;parts&quot; type=", 1
    )
    node = '<node pkg="robot_state_publisher" type="robot_state_publisher" name="rsp"/>'
    turn, hold = _frames(f"{described}{node}", ros=1).edges
    assert (turn.by, turn.sure, turn.doubt) == (f"/rsp (joint turn, catalogue: parts of {distro})", False, doubt)
    assert (hold.sure, hold.doubt) == (True, "")
