"""PKG011: what a package installs where ROS 2 does not look for it, or cannot run it."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.packaging import CFG, CMAKE, LISTS, PYTHON, SCRIPT, SETUP, said
from support.unbuilt_packages import manifest

IN_BIN = "setup.py:15 error executables of 'arm' are installed in bin, not in lib/arm: "
ELSEWHERE = "executables of 'arm' are installed in lib/leg, not in lib/arm"
NOT_FOUND = "; `ros2 run` and launch files do not find them"
NO_RUN = (
    "script 'scripts/report.py' is installed without the permission to be executed: `ros2 run` and launch files do not "
    "find 'report.py'; use install(PROGRAMS ...)"
)


@pytest.mark.parametrize(
    ("changed", "expected"),
    [
        ({"setup.cfg": None}, [f"{IN_BIN}setup.cfg is missing{NOT_FOUND}"]),
        (
            {"setup.cfg": "[develop]\nscript_dir=$base/lib/arm\n"},
            [f"{IN_BIN}setup.cfg has no `install_scripts`{NOT_FOUND}"],
        ),
        (
            {"setup.cfg": CFG.replace("lib/arm", "lib/leg")},
            [
                f"setup.cfg:2 warning {ELSEWHERE} with `colcon build --symlink-install`{NOT_FOUND}",
                f"setup.cfg:4 error {ELSEWHERE}{NOT_FOUND}",
            ],
        ),
        (
            {"setup.cfg": None, "package.xml": manifest("arm", "ament_python")},
            [f"{IN_BIN.replace('error', 'info')}setup.cfg is missing{NOT_FOUND}"],
        ),
        (
            {"setup.py": SETUP.replace("+ '/launch'", "+ '_old/launch'")},
            [
                "setup.py:11 error launch/arm.launch.xml is installed in share/arm_old/launch, not below share/arm, "
                "where ROS 2 looks for it"
            ],
        ),
        (
            {"setup.py": SETUP.replace("('share/' + package_name + '/launch'", "('launch'")},
            [
                "setup.py:11 error launch/arm.launch.xml is installed in launch, not below share/arm, "
                "where ROS 2 looks for it"
            ],
        ),
        (
            {"setup.py": SETUP.replace("name=package_name", "name='leg'")},
            ["setup.py:5 info setup.py calls the package 'leg', package.xml calls it 'arm'"],
        ),
    ],
)
def test_of_python(tmp_path: Path, changed: dict[str, str | None], expected: list[str]) -> None:
    assert sorted(said(tmp_path, {**PYTHON, **changed}, "PKG011")) == expected


@pytest.mark.parametrize(
    ("lists", "expected"),
    [
        (LISTS.replace("PROGRAMS", "FILES"), [f"CMakeLists.txt:6 error {NO_RUN}"]),
        (
            LISTS.replace("PROGRAMS scripts/report.py", "DIRECTORY scripts/"),
            [f"CMakeLists.txt:6 error {NO_RUN}"],
        ),
        (
            LISTS.replace("DESTINATION lib/${PROJECT_NAME})", "DESTINATION lib/leg)"),
            [
                "CMakeLists.txt:5 error executable 'driver' is installed in lib/leg, not in lib/arm; `ros2 run` and "
                "launch files do not find it"
            ],
        ),
    ],
)
def test_of_cmake(tmp_path: Path, lists: str, expected: list[str]) -> None:
    assert said(tmp_path, {**CMAKE, "CMakeLists.txt": lists}, "PKG011") == expected


def test_a_link_to_a_script_that_may_be_executed_works(tmp_path: Path) -> None:
    files = {**CMAKE, "CMakeLists.txt": LISTS.replace("PROGRAMS", "FILES")}
    script = tmp_path / "src/arm/scripts/report.py"
    script.parent.mkdir(parents=True)
    script.touch(0o755)
    assert said(tmp_path, files, "PKG011") == [f"CMakeLists.txt:6 warning {NO_RUN}"]


@pytest.mark.silent
@pytest.mark.parametrize(
    "files",
    [
        # onkoe/auto_ros2: where it belongs, and elsewhere as well
        {
            **PYTHON,
            "setup.py": SETUP.replace(
                "        ('share/' + package_name + '/launch'",
                "        ('share/other', ['package.xml']),\n        ('share/' + package_name + '/launch'",
            ),
        },
        PYTHON,
        {**PYTHON, "setup.cfg": "[develop]\nscript-dir=$base/lib/arm\n[install]\ninstall-scripts=$base/lib/arm\n"},
        {
            **PYTHON,
            "setup.cfg": None,
            "setup.py": SETUP.replace(
                "name=package", "options={'install': {'install_scripts': '$base/lib/arm'}},\n    name=package"
            ),
        },
        {**PYTHON, "setup.py": SETUP.replace("name=package", "**more, name=package"), "setup.cfg": None},
        {**PYTHON, "setup.py": SETUP.replace("name=package_name", "name='ARM'")},
        CMAKE,
        # What a program beside it imports, and nobody starts.
        {
            **CMAKE,
            "CMakeLists.txt": LISTS.replace("PROGRAMS", "FILES"),
            "scripts/report.py": SCRIPT,
            "scripts/all_reports.py": "from report import main\n",
        },
        # What a program imports, and what gets its permissions otherwise.
        {**CMAKE, "CMakeLists.txt": LISTS.replace("PROGRAMS", "FILES"), "scripts/report.py": "def report(): pass\n"},
        {
            **CMAKE,
            "CMakeLists.txt": LISTS.replace("PROGRAMS scripts/report.py", "DIRECTORY scripts/").replace(
                "lib/${PROJECT_NAME})\ninstall(DIR", "lib/${PROJECT_NAME} USE_SOURCE_PERMISSIONS)\ninstall(DIR"
            ),
            "scripts/report.py": SCRIPT,
        },
    ],
)
def test_what_is_found(tmp_path: Path, files: dict[str, str | None]) -> None:
    assert said(tmp_path, files, "PKG011") == []


def test_a_script_that_another_imports_and_a_launch_file_starts(tmp_path: Path) -> None:
    node = '<launch><node pkg="arm" exec="report.py"/></launch>'
    files = {**CMAKE, "CMakeLists.txt": LISTS.replace("PROGRAMS", "FILES"), "launch/arm.launch.xml": node}
    files["scripts/all_reports.py"] = "import report\n"
    assert said(tmp_path, files, "PKG011") == [f"CMakeLists.txt:6 error {NO_RUN}"]


@pytest.mark.silent
def test_a_package_whose_name_has_a_slash(tmp_path: Path) -> None:
    files = {
        **PYTHON,
        "package.xml": manifest("src/arm", "ament_python"),
        "setup.py": SETUP.replace("package_name = 'arm'", "package_name = 'src/arm'"),
        "setup.cfg": CFG.replace("lib/arm", "lib/src/arm"),
    }
    assert said(tmp_path, files, "PKG011") == []
