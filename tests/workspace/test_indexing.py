"""What the index of a workspace has, and how it follows changes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.environment.detect import detect
from preflight_analysis.environment.packages import walk_unignored
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.workspace import indexing
from preflight_analysis.workspace.index import Root, WorkspaceIndex
from preflight_analysis.workspace.indexing import Earlier, Watch, build_index, entry_of
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

LEAF = '<launch><arg name="x"/><node pkg="p" type="t" name="$(arg x)"/></launch>'


def including(*lines: str) -> str:
    return "<launch>" + "".join(lines) + "</launch>"


def include(path: Path, x: str = "a", attributes: str = "") -> str:
    return f'<include file="{path}" {attributes}><arg name="x" value="{x}"/></include>'


class Harness:
    """A workspace of a few launch files."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        environment = detect(str(folder), package_path=(str(folder),))
        self.workspace = Workspace(environment, Sources())
        self.index = WorkspaceIndex()

    def write(self, name: str, text: str) -> Path:
        path = self.folder / name
        path.write_text(text)
        return path

    def build(self, *named: Root, changed: list[Path] | None = None) -> WorkspaceIndex:
        earlier = Earlier(self.index, [str(path) for path in changed]) if changed is not None else None
        built = build_index(self.workspace, str(self.folder), named, earlier=earlier)
        assert built is not None
        fresh = build_index(self.workspace, str(self.folder), named)
        assert built == fresh, "what is brought up to date equals what is made anew"
        self.index = built
        return built


@pytest.fixture
def harness(tmp_path: Path) -> Harness:
    return Harness(tmp_path)


def paths(roots: tuple[Root, ...]) -> list[str]:
    return sorted(Path(root.path).name for root in roots)


def test_roots_are_what_nothing_includes(harness: Harness) -> None:
    leaf = harness.write("leaf.launch", LEAF)
    middle = harness.write("middle.launch", including(include(leaf)))
    harness.write("one.launch", including(include(middle)))
    harness.write("two.launch", including(include(leaf, "b")))
    index = harness.build()
    assert paths(index.roots_of(str(leaf))) == ["one.launch", "two.launch"]
    assert paths(index.roots_of(str(middle))) == ["one.launch"]
    assert sorted(i.args["x"] or "" for i in index.includers(str(leaf))) == ["a", "b"]
    assert sorted(node.name for _, node in index.nodes()) == ["/a", "/b"]


def test_a_file_that_is_only_included_under_a_false_condition_is_its_own_root(harness: Harness) -> None:
    leaf = harness.write("leaf.launch", LEAF)
    harness.write("one.launch", including(include(leaf, attributes='if="false"')))
    index = harness.build()
    assert index.roots_of(str(leaf)) == (Root(str(leaf)),)
    assert [i.root for i in index.includers(str(leaf))] == [None], "but who would include it is known"


def test_a_file_whose_includer_only_the_evaluation_knows_is_no_root(harness: Harness) -> None:
    leaf = harness.write("leaf.launch", LEAF)
    where = f'<arg name="where" default="{harness.folder}"/>'
    harness.write("one.launch", including(where, '<include file="$(arg where)/leaf.launch"/>'))
    assert paths(harness.build().roots_of(str(leaf))) == ["one.launch"]


def test_files_that_include_each_other_have_a_root(harness: Harness) -> None:
    one, two = harness.folder / "one.launch", harness.folder / "two.launch"
    harness.write("one.launch", including(include(two)))
    harness.write("two.launch", including(include(one)))
    index = harness.build()
    assert index.roots_of(str(one)) == index.roots_of(str(two))


def test_a_root_that_the_settings_name_stays_one(harness: Harness) -> None:
    leaf = harness.write("leaf.launch", LEAF)
    harness.write("one.launch", including(include(leaf)))
    named = Root.of(str(leaf), {"x": "named"})
    assert harness.build(named).roots_of(str(leaf))[0] == named


def test_changes_are_followed(harness: Harness) -> None:
    leaf = harness.write("leaf.launch", LEAF)
    one = harness.write("one.launch", including(include(leaf)))
    harness.build()
    one = harness.write("one.launch", including())
    assert harness.build(changed=[one]).roots_of(str(leaf)) == (Root(str(leaf)),)
    two = harness.write("two.launch", including(include(leaf, "z")))
    assert paths(harness.build(changed=[two]).roots_of(str(leaf))) == ["two.launch"]
    two.unlink()
    assert harness.build(changed=[two]).roots_of(str(leaf)) == (Root(str(leaf)),)


def test_a_file_opened_in_the_home_folder_does_not_make_all_of_it_a_workspace(
    harness: Harness, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HOME", str(harness.folder))
    (harness.folder / "project").mkdir()
    harness.write("project/other.launch", including())
    mine = harness.write("mine.launch", including())
    assert list(harness.build().files) == [str(mine)]


def test_it_can_be_stopped(harness: Harness) -> None:
    harness.write("leaf.launch", LEAF)
    assert build_index(harness.workspace, str(harness.folder), watch=Watch(cancelled=lambda: True)) is None


def test_what_the_build_ignores_is_not_checked(harness: Harness) -> None:
    for marker in ("CATKIN_IGNORE", "AMENT_IGNORE", "COLCON_IGNORE"):
        (harness.folder / marker / "launch").mkdir(parents=True)
        (harness.folder / marker / marker).touch()
        harness.write(f"{marker}/launch/{marker}.launch", LEAF)
        harness.write(f"{marker}/launch/a.launch.xml", '<launch><node pkg="p" exec="t"/></launch>')
        harness.write(f"{marker}/launch/a.launch.yaml", "launch: []")
    index = harness.build()
    assert paths(tuple(index.entries)) == ["AMENT_IGNORE.launch", "COLCON_IGNORE.launch"]


def test_parameters_of_a_launch_test_are_no_launch_file(harness: Harness) -> None:
    (harness.folder / "test").mkdir()
    harness.write("test/arm_launch.yaml", "/arm:\n  ros__parameters:\n    speed: 1.0\n")
    harness.write("test/leg_launch.yaml", "launch:\n- node: {pkg: p, exec: e}\n")
    assert paths(tuple(harness.build().entries)) == ["leg_launch.yaml"]


def test_what_eclipse_starts_programs_with_is_no_launch_file(harness: Harness) -> None:
    harness.write("Debug.launch", '<?xml version="1.0"?>\n<launchConfiguration type="com.st.debug"/>')
    harness.write("robot.launch", LEAF)
    assert paths(tuple(harness.build().entries)) == ["robot.launch"]


def test_a_world_of_a_simulator_is_no_launch_file(harness: Harness) -> None:
    (harness.folder / "launch").mkdir()
    harness.write("launch/world.launch", '<?xml version="1.0"?>\n<!-- x -->\n<sdf version="1.4"><world/></sdf>')
    harness.write("robot.launch", LEAF)
    harness.write("broken.launch", "<lunch/>")
    assert paths(tuple(harness.build().entries)) == ["broken.launch", "robot.launch"]


def test_tests_of_other_tools_are_no_launch_files(harness: Harness) -> None:
    harness.write("fuzzer.test", "RUN: %cpp_compiler %S/Fuzzer.cpp -o %t && %t\nCHECK: Done\n")
    harness.write("broken.test", "half a line\n<launch>")
    harness.write("node.test", LEAF)
    assert paths(tuple(harness.build().entries)) == ["broken.test", "node.test"]


def test_launch_files_are_known_by_their_content(harness: Harness) -> None:
    comment = f"<!-- {'x' * 10_000} -->"
    yaml = "launch:\n- node: {pkg: p, exec: e}\n"
    for name, text in {
        "launch/competition.xml": f'<?xml version="1.0"?>\n{LEAF}',
        "launch/licensed.xml": f"{comment}\n{LEAF}",
        "config/doctype.xml": f"<!DOCTYPE launch [<!ENTITY a 'b'>]>{LEAF}",
        "package.xml": "<package><name>p</name></package>",
        "urdf/arm.xml": '<robot name="launch"><launch/></robot>',
        "trees/tree.xml": f"{comment}<root/>",
        "launch/empty.xml": "",
        "launch/text.xml": "<launch",
        "launch/robot.yaml": f"# all of it\n---\n{yaml}",
        "launch/licensed.yml": f"# {'x' * 10_000}\n{yaml}",
        "launch/flow.yaml": "launch: [{node: {pkg: p, exec: e}}]\n",
        "config/launch.yaml": "launch:\n  ros__parameters: {rate: 1}\n",
        "config/two.yaml": f"{yaml}robot: 1\n",
        "config/later.yaml": f"robot: 1\n{yaml}",
    }.items():
        (harness.folder / name).parent.mkdir(parents=True, exist_ok=True)
        harness.write(name, text)
    expected = ["competition.xml", "doctype.xml", "flow.yaml", "licensed.xml", "licensed.yml", "robot.yaml"]
    assert sorted(paths(tuple(harness.build().entries))) == [*expected, "text.xml"]
    changed = harness.write("launch/empty.xml", LEAF)
    assert "empty.xml" in paths(tuple(harness.build(changed=[changed]).entries))


TESTS = {
    "a pytest that loads it": "def test_it():\n    assert load().generate_launch_description().entities\n",
    "a unit test": "import unittest\nfrom p.launch import generate_launch_description\n",
    "for launch_testing": "def generate_test_description():\n    return LaunchDescription([])\n",
    "for launch_pytest": "import launch_pytest\n\n@launch_pytest.fixture\ndef generate_it_description(): return None\n",
}


@pytest.mark.parametrize("kind", TESTS)
@pytest.mark.parametrize("folder", ["test", "launch"])
def test_tests_of_launch_files_are_no_launch_files(harness: Harness, kind: str, folder: str) -> None:
    (harness.folder / folder).mkdir()
    harness.write(f"{folder}/test_dock_launch.py", TESTS[kind])
    harness.write(f"{folder}/system_launch.py", f"{PYTHON}\n\ndef test_it():\n    pass\n")
    harness.write(f"{folder}/other_launch.py", "from p.all import (\n    a,\n    generate_launch_description,\n)\n")
    assert sorted(paths(tuple(harness.build().entries))) == ["other_launch.py", "system_launch.py"]


PYTHON = """
from launch import LaunchDescription

def generate_launch_description():
    return LaunchDescription([])
"""


def test_python_files_that_make_a_launch_description_are_launch_files(harness: Harness) -> None:
    for name, text in {
        "p/launch/hello-launch.py": PYTHON,
        "p/launch/robots/bringup_all.py": PYTHON,
        "p/launch/helper.py": "def generate(): pass\n",
        "p/launch/arms_launch.py": "def make_arms(): return []\n",
        "p/launch/legs.launch.py": "def generate_legs_description(): return []\n",
        "p/launch/wrong.launch.py": "def generate_launch_descripton(): return []\n",
        "p/launch/loads.py": "import runpy, arms_launch\nrunpy.run_path('legs.launch.py')\n",
        "p/bringup/installed.py": PYTHON,
        "p/p/module.py": PYTHON,
        "p/p/gen_launch.py": "from launch import LaunchDescription\n\ndef gen_launch(): return LaunchDescription([])\n",
        "p/bringup/wrong_launch.py": PYTHON.replace("launch_desc", "lauch_desc"),
        "p/package.xml": "<package><name>p</name><export><build_type>ament_python</build_type></export></package>",
        "p/setup.py": "from setuptools import setup\n"
        "setup(name='p', packages=['p'], data_files=[('share/p', ['package.xml', 'bringup/installed.py'])])\n",
    }.items():
        (harness.folder / name).parent.mkdir(parents=True, exist_ok=True)
        harness.write(name, text)
    harness.workspace = Workspace(detect(str(harness.folder), package_path=(str(harness.folder),)), Sources())
    assert paths(tuple(harness.build().entries)) == [
        *("bringup_all.py", "hello-launch.py", "installed.py", "wrong.launch.py", "wrong_launch.py")
    ]
    whole = harness.write(
        "whole.launch.xml", f'<launch><include file="{harness.folder}/p/launch/hello-launch.py"/></launch>'
    )
    index = harness.build(changed=[whole])
    assert paths(tuple(index.entries)) == [
        *("bringup_all.py", "installed.py", "whole.launch.xml", "wrong.launch.py", "wrong_launch.py")
    ]


INCLUDING = """\
import os
from ament_index_python import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    launch = os.path.join(get_package_share_directory("p"), "launch")
    robot = PathJoinSubstitution([FindPackageShare("p"), "launch", "robot.launch.py"])
    return LaunchDescription([
        IncludeLaunchDescription(PythonLaunchDescriptionSource(robot), launch_arguments={"robot": "r1"}.items()),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(os.path.join(launch, "view.launch.py")),
            condition=IfCondition(LaunchConfiguration("view")),
        ),
        IncludeLaunchDescription(PythonLaunchDescriptionSource(os.path.join(launch, LaunchConfiguration("more")))),
    ])
"""
INCLUDED = """\
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.descriptions import ParameterFile
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    config = PathJoinSubstitution([FindPackageShare("p"), "config", [LaunchConfiguration("robot"), ".yaml"]])
    return LaunchDescription([
        DeclareLaunchArgument("robot"),
        Node(package="p", executable="x", name="n", parameters=[ParameterFile(config), {"rate": 5}]),
    ])
"""


def test_what_a_python_file_that_was_not_run_includes_and_reads_is_known(harness: Harness) -> None:
    """A server that has run it, and one that has just begun, know the same roots of a file."""
    written = {
        "p/launch/robots.launch.py": INCLUDING,
        "p/launch/robot.launch.py": INCLUDED,
        "p/launch/view.launch.py": PYTHON,
        "p/config/r1.yaml": "n: {ros__parameters: {rate: 5}}",
        "p/package.xml": "<package><name>p</name><export><build_type>ament_python</build_type></export></package>",
    }
    for name, text in written.items():
        (harness.folder / name).parent.mkdir(parents=True, exist_ok=True)
        harness.write(name, text)
    harness.workspace = Workspace(detect(str(harness.folder), package_path=(str(harness.folder),)), Sources())
    index = harness.build()
    launch = harness.folder / "p/launch"
    assert [Path(i.includer).name for i in index.includers(str(launch / "robot.launch.py"))] == ["robots.launch.py"]
    assert [Path(i.includer).name for i in index.includers(str(launch / "view.launch.py"))] == ["robots.launch.py"]
    assert paths(index.roots_reading(str(harness.folder / "p/config/r1.yaml"))) == ["robots.launch.py"]


def test_a_large_circle_is_evaluated_in_parts(harness: Harness, monkeypatch: pytest.MonkeyPatch) -> None:
    count = 400
    for number in range(count):
        before = harness.folder / f"a{(number - 1) % count:03}.launch"
        harness.write(f"a{number:03}.launch", including(f'<include file="{before}"/>'))
    evaluated: list[str] = []
    tree = Workspace.tree

    def counting(workspace: Workspace, path: str, args: Mapping[str, str], *rest: Any) -> LaunchTree:
        evaluated.append(path)
        return tree(workspace, path, args, *rest)

    monkeypatch.setattr(Workspace, "tree", counting)
    index = build_index(harness.workspace, str(harness.folder))
    assert index is not None
    assert len(evaluated) <= 12
    assert all(index.roots_of(str(path)) for path in harness.folder.glob("*.launch"))


def test_includes_beyond_the_limit_are_not_evaluated(
    harness: Harness, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(indexing, "MAX_INCLUDED", 2)
    leaf = harness.write("leaf.launch", LEAF)
    for number in range(4):
        harness.write(f"root{number}.launch", including(include(leaf)))
    index = build_index(harness.workspace, str(harness.folder))
    assert index is not None
    assert len(index.roots_of(str(leaf))) == 2
    (said,) = [record.getMessage() for record in caplog.records]
    assert said.endswith("who includes whom is not known of 2 of them")


def test_the_order_of_a_folder_on_the_disk_does_not_show(harness: Harness, monkeypatch: pytest.MonkeyPatch) -> None:
    leaf = harness.write("leaf.launch", LEAF)
    for name in ("one", "two", "three"):
        harness.write(f"{name}.launch", including(include(leaf)))

    def names() -> list[str]:
        return [Path(each.includer).name for each in harness.build().includers(str(leaf))]

    expected = ["one.launch", "three.launch", "two.launch"]
    for reverse in (False, True):

        def walked(*given: Any, reverse: bool = reverse) -> Iterator[Any]:
            for place, folders, files, ignored in walk_unignored(*given):
                yield place, folders, sorted(files, reverse=reverse), ignored

        monkeypatch.setattr(indexing, "walk_unignored", walked)
        assert names() == expected


def test_what_the_index_does_not_keep_is_not_worked_out(harness: Harness) -> None:
    loaded = harness.write("loaded.yaml", "{a: [1, 2], $(anon n): 3, broken")
    leaf = harness.write(
        "leaf.launch",
        including(
            '<arg name="x"/><env name="E" value="1"/><remap from="a" to="b"/>',
            f'<rosparam command="load" file="{loaded}"/><rosparam file="{loaded}" subst_value="true"/>',
            '<node pkg="p" type="nowhere" name="$(anon n)"><rosparam file="no.yaml"/></node>',
            '<node pkg="p" type="t" name="/bad"/><test pkg="p" type="t" test-name="x"/><unknown/>',
        ),
    )
    root = harness.write("root.launch", including(include(leaf), include(leaf, "b", 'ns="n" clear_params="true"')))
    for path in (leaf, root):
        each = Root.of(str(path), {"x": "given"})
        whole = harness.workspace.tree(each.path, dict(each.args))
        outline = harness.workspace.outline(each.path, dict(each.args))
        assert entry_of(outline, each) == entry_of(whole, each)
        assert len(outline.nodes) == len(whole.nodes) > 0
        assert str(loaded) in outline.inputs
        kinds = {type(problem.kind).__name__ for problem in whole.problems}
        assert kinds - {type(problem.kind).__name__ for problem in outline.problems} >= {"BadYaml"}
