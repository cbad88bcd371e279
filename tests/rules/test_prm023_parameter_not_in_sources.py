"""PRM023: a parameter whose name is in no source of the workspace, which has one of a similar name."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import apply, findings_of

ROS_1 = """
    //- {0}/p/main.launch
    <launch>{1}</launch>
    //- interfaces
    {{"/n": {{"status": "not-run"}}}}
    //- {0}/p/package.xml
    <package><name>p</name></package>
    //- {0}/q/package.xml
    <package><name>q</name></package>
"""
NODE = '<node pkg="p" type="t" name="n">{0}</node>'
READS = 'nh.param("subscribe_laserScan", a, false);\nprivate_nh->param<int>("queue_size", b, 1);\n'


def found(folder: Path, inside: str, sources: dict[str, str], launch: str = NODE) -> list[Finding]:
    """What the rule says of the launch file of package `p`, which stands beside package `q`."""
    for file, text in sources.items():
        (folder / file).parent.mkdir(parents=True, exist_ok=True)
        (folder / file).write_text(text)
    (folder / "p").mkdir(exist_ok=True)
    (folder / "p" / "main.launch").touch()
    return [f for f in findings_of(ROS_1.format(folder, launch.format(inside))) if f.rule == "PRM023"]


def param(name: str) -> str:
    """A parameter in a tag."""
    return f'<param name="{name}" value="1"/>'


@pytest.mark.parametrize(
    ("name", "source", "meant"),
    [
        ("subscribe_scan", READS, "subscribe_laserScan"),
        ("qeue_size", READS, "queue_size"),
        ("global_flame", 'declare_parameter_if_not_declared(node, name_ + ".global_frame", value);', "global_frame"),
        ("frame_id", "rospy.get_param('~body_frame_id', 'BODY')", "body_frame_id"),
    ],
)
def test_a_slip_of_what_the_package_reads(tmp_path: Path, name: str, source: str, meant: str) -> None:
    (finding,) = found(tmp_path, param(name), {"p/src/a.cpp": source})
    assert finding.severity == "warning"
    assert finding.message == f"parameter '{name}' is in no source of the workspace; did you mean '{meant}', which " + (
        "a.cpp reads?"
    )
    text = ROS_1.format(tmp_path, NODE.format(param(name)))
    assert f'name="{meant}"' in apply(text, finding.fixes[0].edits)[f"{tmp_path}/p/main.launch"]


def test_what_a_plugin_of_another_package_reads_in_a_namespace_of_that_name(tmp_path: Path) -> None:
    source = {"q/include/radio.h": 'nh.getParam("radio/x_channel_index", x);', "p/src/a.cpp": ""}
    (finding,) = found(tmp_path, param("radio/x_channel"), source)
    assert "did you mean 'x_channel_index', which radio.h reads?" in finding.message
    assert found(tmp_path, param("audio/x_channel"), source) == []


def test_parameters_beside_the_nodes_of_which_one_source_reads_most(tmp_path: Path) -> None:
    source = {"p/src/config.h": "".join(f'nh->param<int>("{name}", {name}, 1);\n' for name in ("a1", "b1", "c1"))}
    source["p/src/config.h"] += 'nh->param<std::string>("odom_frame", odom_frame_id, "odom");'
    beside = "<rosparam>{{a1: 1, b1: 2, c1: 3, odom_frame_id: odom}}</rosparam>" + NODE
    (finding,) = found(tmp_path, "", source, beside)
    assert "parameter 'odom_frame_id' is in no source of the workspace; did you mean 'odom_frame'" in finding.message
    few = "<rosparam>{{a1: 1, x1: 2, y1: 3, odom_frame_id: odom}}</rosparam>" + NODE
    assert found(tmp_path, "", source, few) == []


@pytest.mark.silent
@pytest.mark.parametrize(
    ("inside", "sources"),
    [
        # Its name stands somewhere, be it in another package or as what a macro is given.
        (param("subscribe_scan"), {"p/a.cpp": READS, "q/scripts/tool": 'x = {"subscribe_scan": 1}'}),
        (param("subscribe_scan"), {"p/a.cpp": READS + "READ_PARAM(subscribe_scan, false);"}),
        (param("subscribe_scan"), {"p/a.cpp": READS, "p/cfg/P.cfg": 'gen.add("subscribe_scan", bool_t, 0, "", True)'}),
        # What it may be meant for is set, too.
        (param("subscribe_scan") + param("subscribe_laserScan"), {"p/a.cpp": READS}),
        # Two may be meant, or another thing.
        (param("laser_frame"), {"p/a.cpp": 'nh.param("laser_frame_id", a); nh.param("my_laser_frame", b);'}),
        (param("min_speed"), {"p/a.cpp": 'nh.param("max_speed", a);'}),
        (param("Odom/MaxDepth"), {"p/a.cpp": 'nh.param("max_depth", a);'}),
        (param("j_max"), {"p/a.cpp": 'nh.param("max_j_z", a);'}),
        (param("rate"), {"p/a.cpp": 'nh.param("publish_rate", a);'}),
        # MoveIt's library reads it in any node.
        (param("ompl/planning_plugins"), {"p/a.cpp": 'nh.param("planning_plugin", a);'}),
        (param("camera1_frame"), {"p/a.cpp": 'nh.param("camera2_frame", a);'}),
    ],
)
def test_names_that_are_known_or_like_nothing(tmp_path: Path, inside: str, sources: dict[str, str]) -> None:
    assert found(tmp_path, inside, sources) == []


MADE = (
    'std::string name = stream_name_[index] + "_width";',
    'name += "_width";',
    'name = f"{stream}_width"',
    'name = "%s_width" % stream',
    'name = "depth" + kind + "dth"',
)


@pytest.mark.silent
@pytest.mark.parametrize("source", MADE)
def test_a_name_that_a_program_may_put_together(tmp_path: Path, source: str) -> None:
    sources = {"p/src/a.cpp": f'nh.param("depth_roi_width", a, 0);\n{source}\nnh.param(name, a, 0);\n'}
    assert found(tmp_path, param("depth_width"), sources) == []


@pytest.mark.parametrize("source", MADE)
def test_a_slip_that_no_program_puts_together(tmp_path: Path, source: str) -> None:
    sources = {"p/src/a.cpp": f'nh.param("depth_roi_width", a, 0);\n{source}\nnh.param(name, a, 0);\n'}
    assert len(found(tmp_path, param("depth_roi_widht"), sources)) == 1


@pytest.mark.parametrize("source", ['log("the " + name + " width");', 'a = "x" + name;', 'b = "depth" + "_height";'])
def test_a_text_that_says_nothing_of_the_name(tmp_path: Path, source: str) -> None:
    sources = {"p/src/a.cpp": f'nh.param("depth_roi_width", a, 0);\n{source}\n'}
    assert len(found(tmp_path, param("depth_width"), sources)) == 1


def test_two_that_are_like_one_are_no_slips_of_it(tmp_path: Path) -> None:
    source = {"p/src/a.cpp": 'nh.getParam("serials", s);'}
    assert [f.severity for f in found(tmp_path, param("serial"), source)] == ["warning"]
    assert found(tmp_path, param("serial") + param("serialz"), source) == []


@pytest.mark.parametrize("comment", ["// {}", "/* {} */"])
def test_what_is_commented_out_asks_for_nothing(comment: str, tmp_path: Path) -> None:
    source = 'nh.getParam("new_mux_idx", idx);'
    assert found(tmp_path, param("new_mux_idxs"), {"p/src/a.cpp": comment.format(source)}) == []
    assert [f.severity for f in found(tmp_path, param("new_mux_idxs"), {"p/src/b.cpp": source})] == ["warning"]


def _loose(folder: Path, text: str) -> list[str]:
    """What is said of a parameter file that no launch file names."""
    reads = "".join(f'nh.param("{name}", x, 1);\n' for name in ("axis_x", "axis_y", "scale_x", "fixed_resolution"))
    texts = {
        "package.xml": "<package><name>p</name></package>",
        "launch/a.launch": "<launch/>",
        "src/a.cpp": reads,
        "config/xd3.yaml": text,
    }
    for place, each in texts.items():
        path = folder / "src/p" / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(each)
    environment = detect_environment(str(folder), {"ROS_VERSION": "1"}, root=str(folder / "nowhere"))
    workspace = Workspace(environment, Sources())
    static = workspace.static(str(folder / "src/p/launch/a.launch"))
    return [each.message for each, _ in workspace.branches(static).findings if each.rule == "PRM023"]


def test_a_file_that_no_launch_file_names(tmp_path: Path) -> None:
    assert _loose(tmp_path, "axis_x: 1\naxis_y: 2\nscale_x: 3\nresolution_fixed: 4\n") == [
        "parameter 'resolution_fixed' is in no source of the workspace; did you mean 'fixed_resolution', which a.cpp "
        "reads?"
    ]


@pytest.mark.silent
@pytest.mark.parametrize(
    "text", ["axis_x: 1\naxis_y: 2\nscale_x: 3\nfixed_resolution: 4\n", "a: 1\nb: 2\nc: 3\nresolution_fixed: 4\n", "["]
)
def test_a_file_of_something_else_or_without_a_slip(tmp_path: Path, text: str) -> None:
    assert _loose(tmp_path, text) == []
