"""`check FILE` of files that are no launch files, and of folders that have none."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from support.descriptions import xacro
from support.packaging import CMAKE, LISTS, PYTHON, SETUP, lay_out

pytestmark = pytest.mark.ros
Run = Callable[..., Any]

PARAMS = "driver:\n  ros__parameters:\n    gains: [1, 2.5]\n"
BROKEN = LISTS.replace("DIRECTORY launch", "DIRECTORY lanch")
ROBOT = '<robot name="r"><link name="a"><visual><geometry><mesh filename="package://arm/meshes/a.stl"/></geometry></visual></link></robot>'


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    folder = tmp_path / "robots"
    (folder / ".git").mkdir(parents=True)
    return folder


def found(done: Any) -> list[tuple[str, str, str]]:
    return sorted((each["rule"], each["severity"], Path(each["file"]).name) for each in done.json["findings"])


@pytest.mark.parametrize(
    ("file", "text", "expected"),
    [
        ("config/p.yaml", PARAMS, [("PRM016", "warning", "p.yaml")]),
        ("config/p.yaml", "driver:\n  ros__parameters:\n    name: 'x\n", [("PRM004", "warning", "p.yaml")]),
        ("config/p.yaml", "driver:\n  ros__parameters:\n    a: 1\n    a: 2\n", [("PRM006", "warning", "p.yaml")]),
        ("config/p.yaml", "driver:\n  ros__parameters:\n    name: $(var name)\n    rates: [$(var a), 2]\n", []),
        ("rosdoc2.yaml", "a: 1\n---\nb: 2\n", []),
        ("params.yaml", PARAMS.replace("2.5", "2"), []),
        ("CMakeLists.txt", BROKEN, [("PKG012", "error", "CMakeLists.txt")]),
        ("CMakeLists.txt", LISTS, []),
        ("package.xml", CMAKE["package.xml"], []),
        ("urdf/r.xacro", xacro("<xacro:wheel/>"), [("URD011", "warning", "r.xacro")]),
        ("urdf/r.xacro", xacro("<link>"), [("URD001", "warning", "r.xacro")]),
        ("urdf/r.urdf", ROBOT, [("PKG005", "warning", "r.urdf")]),
        (
            "CMakeLists.txt",
            f"# preflight: ignore[PKG012] made later\n{BROKEN}",
            [("LCH019", "warning", "CMakeLists.txt"), ("PKG012", "error", "CMakeLists.txt")],
        ),
        (
            "CMakeLists.txt",
            BROKEN.replace("install(DIR", "# preflight: ignore[PKG012] made later\ninstall(DIR"),
            [],
        ),
    ],
)
def test_one_file(workspace: Path, preflight: Run, file: str, text: str, expected: list[tuple[str, str, str]]) -> None:
    package = lay_out(workspace, {**CMAKE, "meshes/a.stl": "solid", file: text})
    done = preflight("check", package / file, "--format", "json", cwd=workspace)
    assert found(done) == expected
    assert done.code == int(any(severity == "error" for _, severity, _ in expected))
    assert (done.json["files"], done.json["coverage"]["other_files"]) == (0, 1)


def test_a_package_in_python(workspace: Path, preflight: Run) -> None:
    package = lay_out(workspace, {**PYTHON, "setup.py": SETUP.replace("arm.driver", "arm.drivr")})
    done = preflight("check", "setup.py", "setup.cfg", "--format", "json", cwd=package)
    assert (found(done), done.code) == ([("PKG010", "error", "setup.py")], 1)
    manifest = PYTHON["package.xml"].replace("<exec_depend>", "\n  <exec_depend>")
    lay_out(
        workspace,
        {
            "arm/planner.py": "import sensor_msgs\n",
            "package.xml": manifest.replace("</exec_depend>", "</exec_depend>\n"),
        },
    )
    assert found(preflight("check", "arm/planner.py", "--format", "json", cwd=package)) == [
        ("PKG004", "info", "planner.py")
    ]
    done = preflight("check", "package.xml", cwd=package)
    assert "PKG004" in done.out, "it is mended there"
    assert "1 info; no launch files; 1 other file checked\n" in done.out


def test_files_of_several_kinds(workspace: Path, preflight: Run) -> None:
    package = lay_out(
        workspace,
        {**CMAKE, "CMakeLists.txt": BROKEN, "p.yaml": PARAMS, "launch/b.launch.xml": "<launch><nod/></launch>"},
    )
    check = ("check", "--no-run", "CMakeLists.txt", "p.yaml", "launch/b.launch.xml")
    done = preflight(*check, "--format", "json", cwd=package)
    assert [rule for rule, _, _ in found(done)] == ["LCH004", "PKG005", "PKG012", "PRM016"]
    assert "1 of 1 launch file evaluated, 0 nodes; 2 other files checked\n" in preflight(*check, cwd=package).out
    for form in ("sarif", "junit", "github", "gitlab"):
        assert "PRM016" in preflight(*check, "--format", form, cwd=package).out
    known = ("--write-baseline", str(workspace / "known.json"))
    assert preflight(*check, *known, cwd=package).code == 0
    done = preflight(*check, "--baseline", known[1], cwd=package)
    assert (done.code, done.out.split(";")[0]) == (0, "no findings")
    (workspace / ".ros-preflight.yaml").write_text("severities: {PRM016: 'off', PKG012: hint}\n")
    assert found(preflight(*check[:-1], "--format", "json", cwd=package)) == [("PKG012", "hint", "CMakeLists.txt")]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["notes.txt"], "notes.txt is no file that can be checked; files that can be checked: launch files, "),
        (["setup.py"], "setup.py is in no package, there is no package.xml in its folder or above"),
        (["p.yaml", "a:=1"], "name:=value is for a launch file, and none is named"),
    ],
)
def test_what_cannot_be_checked(workspace: Path, preflight: Run, arguments: list[str], message: str) -> None:
    (workspace / "notes.txt").write_text("notes\n")
    (workspace / "setup.py").write_text("setup()\n")
    (workspace / "p.yaml").write_text(PARAMS)
    done = preflight("check", *arguments, cwd=workspace)
    assert (done.code, done.out) == (2, "")
    assert message in done.err


@pytest.mark.parametrize("build_tool", ["ament_cmake", "catkin"])
def test_packages_without_a_launch_file(workspace: Path, preflight: Run, build_tool: str) -> None:
    files = {**CMAKE, "launch/arm.launch.xml": None, "launch/arm.txt": "", "config/p.yaml": PARAMS}
    files["package.xml"] = CMAKE["package.xml"].replace("ament_cmake", build_tool)
    lay_out(workspace, files)
    done = preflight("check", cwd=workspace)
    assert done.err == ("ros-preflight: there are no launch files in .; packages and parameter files are checked\n")
    assert done.code == 0
    expected = "1 warning" if build_tool == "ament_cmake" else "no findings"
    assert done.out.endswith(f"{expected}; no launch files; 1 package checked\n")


def test_another_launch_file_name(workspace: Path, preflight: Run) -> None:
    (workspace / "robot.txt").write_text("<launch><nod/></launch>")
    assert found(preflight("check", "--no-run", "robot.txt", "--format", "json", cwd=workspace)) == [
        ("LCH004", "warning", "robot.txt")
    ]


def test_a_package_that_is_ignored(workspace: Path, preflight: Run) -> None:
    package = lay_out(workspace, {**CMAKE, "CMakeLists.txt": LISTS.replace("project(arm)", "project(leg)")})
    (package.parent / "CATKIN_IGNORE").touch()
    done = preflight("check", package / "CMakeLists.txt", "--format", "json", cwd=workspace)
    assert ("PKG013", "error", "CMakeLists.txt") in found(done)
