"""PRM005: a parameter or argument of a node names a file that is not there."""

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import check
from support.packaging import PYTHON, lay_out


def test_a_file_that_comes_to_be_is_there_without_an_edit(tmp_path: Path) -> None:
    share = tmp_path / "p"
    share.mkdir()
    text = '<launch><param name="map" value="$(find p)/office.yaml"/><node pkg="p" type="t" name="n{}"/></launch>'
    launch = share / "main.launch"
    launch.write_text(text)
    packages = {"p": Package("p", str(share), f"{share}/package.xml")}
    sources = Sources()
    workspace = Workspace(Environment(1, "noetic", {}, (), packages, {}, (), (), None), sources, str(share))

    def rules() -> list[str]:
        return [finding.rule for finding in workspace.static(str(launch)).findings]

    assert "PRM005" in rules()
    sources.open(str(launch), text.format(1))
    assert "PRM005" in rules()
    (share / "office.yaml").write_text("a: 1")
    workspace.refresh()
    assert "PRM005" not in rules()
    (share / "office.yaml").unlink()
    workspace.refresh()
    assert "PRM005" in rules()


def test_a_file_that_a_parameter_names_and_that_is_not_there() -> None:
    check("""
        <launch>
          <param name="map" value="$(find p)/maps/office.yaml"/>
                                   ^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/maps/office.yaml' in parameter 'map'
          <param name="info" value="file://$(find p)/left.yaml"/>
                                    ^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/left.yaml' in parameter 'info'
          <param name="mesh" value="package://p/arm.dae"/>
                                    ^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/arm.dae' in parameter 'mesh'
          <param name="list" value="$(find p)/a.yaml:$(find p)/b.yaml"/>
                                    ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/b.yaml'
          <rosparam file="/p/a.yaml"/>
          <rosparam subst_value="true">pose: $(find p)/pose.yaml</rosparam>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/pose.yaml' in parameter 'pose'
          <node pkg="p" type="t" name="n" args="-d $(find p)/all.rviz _a:=$(find p)/b.csv"/>
                                                ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/all.rviz'
                                                ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/b.csv'
        </launch>
        //- /p/a.yaml
        a: 1
    """)


def test_a_file_that_is_made_from_arguments_is_shown_where_its_folder_is_written() -> None:
    check("""
        <launch>
          <arg name="world" default="office"/>
          <include file="/inc.launch"><arg name="file" value="$(find p)/worlds/$(arg world).world"/></include>
                                                              ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005]
        </launch>
        //- /inc.launch
        <launch><arg name="file"/><node pkg="p" type="t" name="n" args="-e $(arg file)"/></launch>
    """)


def test_a_model_that_is_not_there_may_have_to_be_fetched() -> None:
    check("""
        <launch>
          <param name="model" value="$(find p)/trained/net.npz"/>
                                     ^^^^^^^^^^^^^^^^^^^^^^^^^ info[PRM005] file 'p/trained/net.npz' in parameter
        </launch>
    """)


@pytest.mark.silent
def test_a_file_that_is_there_or_need_not_be() -> None:
    check("""
        <launch>
          <param name="here" value="$(dirname)/p/a.yaml"/>
          <rosparam file="/p/a.yaml"/>
          <param name="output_file" value="$(find p)/new.yaml"/>
          <arg name="autom_gen_path" default="$(find p)/problem.pddl"/>
          <param name="problem_path" value="$(arg autom_gen_path)"/>
          <param name="trajectory" value="$(find p)/logs/new.csv"/>
          <param name="images" value="$(find p)/left_%04d.png"/>
          <param name="camera" value="package://p/${NAME}.yaml"/>
          <param name="mesh" value="package://elsewhere/arm.dae"/>
          <param name="model" value="model://ground/ground.sdf"/>
          <param name="folder" value="$(find p)/maps"/>
          <param name="version" value="/p/1.0"/>
          <param name="other" value="/srv/maps/office.yaml"/>
          <param name="text" value="see $(find p)/README.md"/>
          <node pkg="rosbag" type="record" name="rec" args="-O $(find p)/run.dat"/>
          <node pkg="p" type="map_saver" name="saver" args="-f $(find p)/map.yaml"/>
          <node pkg="p" type="t" name="n" args="--log-file=$(find p)/n.txt -o $(find p)/n.csv"/>
        </launch>
        //- /p/a.yaml
        a: 1
        //- /rosbag/package.xml
        <package/>
    """)


def test_files_that_parameters_and_arguments_of_ros2_name() -> None:
    check("""
        //- /p/robot.launch.xml
        <launch>
          <node pkg="p" exec="rviz" name="rviz" args="-d $(find-pkg-share p)/rviz/veiw.rviz"/>
                                                      ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'rviz'
          <node pkg="p" exec="server" name="server">
            <param name="map" value="$(find-pkg-share p)/office.pgm"/>
                                     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/office.pgm' in parameter 'map'
            <param from="$(find-pkg-share p)/server.yaml"/>
          </node>
          <executable cmd="gz sim $(find-pkg-share p)/office.sdf"/>
                           ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/office.sdf' in the arguments of 'gz'
        </launch>
        //- /p/server.yaml
        server:
          ros__parameters:
            mask: package://p/mask.yaml
            ^^^^ warning[PRM005] 'p/mask.yaml' in parameter 'mask'
    """)


@pytest.mark.silent
def test_files_of_ros2_that_are_installed_elsewhere_or_made(tmp_path: Path) -> None:
    share = tmp_path / "robot"
    (share / "rviz").mkdir(parents=True)
    (share / "rviz" / "view.rviz").touch()
    (share / "arm.xacro").touch()
    (share / "CMakeLists.txt").write_text("""
        install(FILES rviz/view.rviz DESTINATION share/robot/config)
        set(MADE ${CMAKE_CURRENT_BINARY_DIR}/arm.urdf)
        install(FILES ${MADE} DESTINATION share/${PROJECT_NAME})""")
    launch = share / "robot.launch.xml"
    launch.write_text("""
        <launch>
          <node pkg="robot" exec="rviz" name="rviz" args="-d $(find-pkg-share robot)/config/view.rviz"/>
          <node pkg="robot" exec="server" name="server">
            <param name="map" value="$(find-pkg-share robot)/config/view.rviz"/>
            <param name="model" value="$(find-pkg-share robot)/arm.urdf"/>
            <param name="save_map_to" value="$(find-pkg-share robot)/office.yaml"/>
          </node>
          <executable cmd="ros2 run nav2_map_server map_saver_cli -f $(find-pkg-share robot)/office.yaml"/>
          <executable cmd="ros2 bag record -o $(find-pkg-share robot)/office.mcap"/>
        </launch>""")
    packages = {"robot": Package("robot", str(share), f"{share}/package.xml", build_type="ament_cmake")}
    environment = Environment(2, "jazzy", {}, (), packages, {}, (), (), None)
    findings = Workspace(environment, Sources(), str(share)).static(str(launch)).findings
    assert not [finding for finding in findings if finding.rule == "PRM005"]


def of_package(folder: Path, text: str, *others: str) -> list[Finding]:
    """What PRM005 says of a launch file in a package `robot`, beside the packages `others`."""
    packages = {}
    for name in ("robot", *others):
        share = folder / name
        share.mkdir(exist_ok=True)
        packages[name] = Package(name, str(share), f"{share}/package.xml")
    launch = folder / "robot" / "robot.launch"
    launch.write_text(f"<launch>{text}<node pkg='p' type='t' name='n'/></launch>")
    environment = Environment(1, "noetic", {}, (), packages, {}, (), (), None)
    findings = Workspace(environment, Sources(), str(folder)).static(str(launch)).findings
    return [finding for finding in findings if finding.rule == "PRM005"]


def test_a_file_that_the_build_makes_of_one_beside_it(tmp_path: Path) -> None:
    worlds = tmp_path / "robot" / "worlds"
    worlds.mkdir(parents=True)
    (worlds / "hall.world.xacro").touch()
    (tmp_path / "robot" / "CMakeLists.txt").write_text("xacro_add_files(worlds/hall.world.xacro INSTALL)")
    text = '<param name="world" value="$(find robot)/worlds/hall.world"/>'
    assert of_package(tmp_path, text) == []
    (tmp_path / "robot" / "CMakeLists.txt").write_text("")
    (finding,) = of_package(tmp_path, text)
    assert finding.severity == "warning"
    assert finding.message.endswith("did you mean 'robot/worlds/hall.world.xacro'?")


def test_files_that_no_package_has_for_the_same_argument(tmp_path: Path) -> None:
    """A planner writes them."""
    names = ("kitchen", "office", "garage")
    for name in ("robot", *names):
        (tmp_path / name / "config").mkdir(parents=True)
        (tmp_path / name / "a.launch").write_text(
            f'<launch><arg name="plan" default="$(find {name})/config/plan.txt"/></launch>'
        )
    text = '<param name="plan" value="$(find robot)/config/plan.txt"/>'
    (finding,) = of_package(tmp_path, text, *names)
    assert (finding.severity, finding.message.partition("; ")[2]) == (
        "info",
        "3 other packages set missing files for it too, so a node may create it",
    )
    for name in names:
        (tmp_path / name / "config" / "plan.txt").touch()
    (finding,) = of_package(tmp_path, text, *names)
    assert finding.severity == "warning"


def test_the_calibration_of_a_camera_is_written_when_that_is_calibrated() -> None:
    check("""
        <launch>
          <param name="camera_info_url" value="package://p/calibration/left.ini"/>
                                               ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[PRM005] file
          <node pkg="p" type="t" name="n"/>
        </launch>
    """)


def test_a_file_that_git_ignores_may_be_made_on_each_machine() -> None:
    check("""
        <launch>
          <param name="model" value="$(find p)/urdf/robot.urdf"/>
                                     ^^^^^^^^^^^^^^^^^^^^^^^^^ info[PRM005] git ignores it
        </launch>
        //- /p/.gitignore
        urdf/*.urdf
    """)


def test_a_file_that_is_not_there_is_shown_where_it_is_written() -> None:
    text = """
        <launch>
          <include file="/inc.launch"><arg name="map" value="$(find p)/ofice.yaml"/></include>
                                                             ^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/ofice.yaml' in
        </launch>
        //- /inc.launch
        <launch>
          <arg name="map" default=""/>
          <arg name="copy" value="$(arg map)"/>
          <node pkg="p" type="t" name="n"><param name="map" value="$(arg copy)"/></node>
        </launch>
    """
    (finding,) = check(text)
    assert finding.related[0].message == "parameter 'map' is set here"
    assert finding.related[0].location.file == "/inc.launch"


def test_the_file_that_was_meant_may_be_in_another_folder(tmp_path: Path) -> None:
    share = tmp_path / "camera"
    (share / "config" / "calibration").mkdir(parents=True)
    (share / "config" / "calibration" / "left_7cd1.yaml").touch()
    launch = share / "camera.launch"
    launch.write_text(
        '<launch><arg name="serial" default="7cd1"/>'
        '<param name="info" value="file://$(find camera)/config/left_$(arg serial).yaml"/></launch>'
    )
    packages = {"camera": Package("camera", str(share), f"{share}/package.xml")}
    environment = Environment(1, "noetic", {}, (), packages, {}, (), (), None)
    (finding,) = Workspace(environment, Sources(), str(share)).static(str(launch)).findings
    assert finding.message.endswith("did you mean 'camera/config/calibration/left_7cd1.yaml'?")
    assert finding.confidence == "likely"
    assert [(edit.text) for edit in finding.fixes[0].edits] == ["/config/calibration/"]


def test_a_file_in_the_folder_where_the_launch_is_started() -> None:
    check("""
        <launch>
          <arg name="solution" default="$(optenv PWD /p)/my_solution.py"/>
                                        ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[PRM005] file 'p/my_solution.py' in the
          <node pkg="p" type="t" name="n" args="$(arg solution)"/>
        </launch>
    """)


def test_one_that_git_ignores_beside_another_elsewhere() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <param name="filepath_gt" value="/p/data/state_groundtruth.txt"/>
                                             ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[PRM005] git ignores it
          </node>
        </launch>
        //- /p/.gitignore
        data/
        //- /p/example/stamped_groundtruth.txt
        1
    """)


def test_one_that_git_ignores_beside_what_describes_it() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <param name="model_path" value="/p/models/best_of_all.rknn"/>
                                            ^^^^^^^^^^^^^^^^^^^^^^^^^^ info[PRM005] git ignores it
          </node>
        </launch>
        //- /p/.gitignore
        *.rknn
        //- /p/models/best_of_all.json
        {}
    """)


def test_one_that_git_ignores_and_another_folder_has() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <param name="yaml_filename" value="/p/map/reality/hall.yaml"/>
                                               ^^^^^^^^^^^^^^^^^^^^^^^^ info[PRM005] git ignores it
          </node>
        </launch>
        //- /p/.gitignore
        map/reality/*.yaml
        //- /p/map/simulation/hall.yaml
        a: 1
    """)


def test_what_an_include_passes_that_nobody_can_read(tmp_path: Path) -> None:
    files = {
        **PYTHON,
        "maps/hall.yaml": "",
        "launch/arm.launch.xml": """<launch>
          <arg name="maps" default="$(find-pkg-share arm)/maps"/>
          <include file="$(find-pkg-share not_here)/launch/a.launch.xml">
            <arg name="map" value="$(var maps)/hal.yaml"/>
            <arg name="params" value="$(find-pkg-share arm)/maps/room.yaml"/>
            <arg name="there" value="$(var maps)/hall.yaml"/>
            <arg name="other" value="$(find-pkg-share nor_this)/maps/hall.yaml"/>
            <arg name="log_file" value="$(var maps)/a.txt"/>
          </include>
          <include file="$(find-pkg-share arm)/launch/$(env ROBOT nothing).launch.xml">
            <arg name="params" value="$(find-pkg-share arm)/maps/shed.yaml"/>
          </include>
        </launch>
""",
    }
    package = lay_out(tmp_path, files)
    environment = detect_environment(str(tmp_path), {}, root=str(tmp_path / "nothing"))
    workspace = Workspace(environment, Sources(), str(tmp_path))
    found = workspace.static(str(package / "launch/arm.launch.xml")).findings
    assert [(f.severity, f.message) for f in found if f.rule == "PRM005"] == [
        (
            "warning",
            "file 'arm/maps/hal.yaml' in argument 'map' of an include does not exist; did you mean "
            "'arm/maps/hall.yaml'?",
        ),
        ("warning", "file 'arm/maps/room.yaml' in argument 'params' of an include does not exist"),
        ("warning", "file 'arm/maps/shed.yaml' in argument 'params' of an include does not exist"),
    ]
    assert [f.message for f in found if f.rule == "PKG001" and "nor_this" in f.message] == []
