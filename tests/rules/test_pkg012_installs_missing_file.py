"""PKG012: a build file installs what is not there."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.packaging import CMAKE, LISTS, PYTHON, SETUP, said

MISSING = "installs '{}', which does not exist: the package does not build"


@pytest.mark.parametrize(
    ("changed", "expected"),
    [
        ({"resource/arm": None}, [f"setup.py:9 error setup.py {MISSING.format('resource/arm')}"]),
        (
            {"resource/arm": None, "resource/leg": ""},
            [f"setup.py:9 error setup.py {MISSING.format('resource/arm')}; did you mean 'resource/leg'?"],
        ),
        (
            {"setup.py": SETUP.replace("glob('launch/*')", "['launch/arm.launch.xml', 'launch/arm2.launch.xml']")},
            [
                f"setup.py:11 error setup.py {MISSING.format('launch/arm2.launch.xml')}; did you mean "
                "'launch/arm.launch.xml'?"
            ],
        ),
        (
            {"setup.py": SETUP.replace("glob('launch/*')", "['launch']")},
            ["setup.py:11 error setup.py installs 'launch', which is a folder: data_files takes files only"],
        ),
        (
            {
                "setup.py": SETUP.replace("glob('launch/*')", "['launch/made.launch.xml']"),
                ".gitignore": "made.launch.xml\n",
            },
            [f"setup.py:11 info setup.py {MISSING.format('launch/made.launch.xml')}"],
        ),
    ],
)
def test_of_python(tmp_path: Path, changed: dict[str, str | None], expected: list[str]) -> None:
    assert said(tmp_path, {**PYTHON, **changed}, "PKG012") == expected


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("DIRECTORY launch", "DIRECTORY lanch", ["lanch", "launch"]),
        ("DIRECTORY launch", "DIRECTORY launch\n  configuration", ["configuration", ""]),
        ("scripts/report.py", "scripts/reprot.py", ["scripts/reprot.py", "scripts/report.py"]),
    ],
)
def test_of_cmake(tmp_path: Path, old: str, new: str, expected: list[str]) -> None:
    (text,) = said(tmp_path, {**CMAKE, "CMakeLists.txt": LISTS.replace(old, new)}, "PKG012")
    written, near = expected
    assert text.partition(" ")[2] == f"error CMakeLists.txt {MISSING.format(written)}" + (
        f"; did you mean '{near}'?" if near else ""
    )


CATKIN = {
    **CMAKE,
    "package.xml": CMAKE["package.xml"].replace("ament_cmake", "catkin"),
    "CMakeLists.txt": """project(arm)
find_package(catkin REQUIRED)
catkin_package()
install(PROGRAMS scripts/report.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(
  DIRECTORY launch
  DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
catkin_install_python(PROGRAMS scripts/report.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
""",
}


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        (
            "install(PROGRAMS scripts/report",
            "install(PROGRAMS scripts/reprot",
            "4 warning {}: `catkin_make install` fails",
        ),
        ("DIRECTORY launch", "DIRECTORY lanch", "6 warning {}: `catkin_make install` fails"),
        ("python(PROGRAMS scripts/report", "python(PROGRAMS scripts/reprot", "8 error {}: the package does not build"),
    ],
)
def test_of_catkin(tmp_path: Path, old: str, new: str, expected: str) -> None:
    (text,) = said(tmp_path, {**CATKIN, "CMakeLists.txt": CATKIN["CMakeLists.txt"].replace(old, new, 1)}, "PKG012")
    written = new.rpartition(" ")[2] + (".py" if "report" in old else "")
    missing = f"CMakeLists.txt installs '{written}', which does not exist"
    assert text.startswith(f"CMakeLists.txt:{expected.format(missing)}")


@pytest.mark.silent
@pytest.mark.parametrize(
    "lists",
    [
        CATKIN["CMakeLists.txt"],
        CATKIN["CMakeLists.txt"].replace("install(PROGRAMS", "install(\n  PROGRAMS src/driver.cpp\n  PROGRAMS"),
        CATKIN["CMakeLists.txt"].replace(
            "install(", "install(FILES ${catkin_FOLDER}/x DESTINATION share)\ninstall(", 1
        ),
    ],
)
def test_nothing_of_catkin(tmp_path: Path, lists: str) -> None:
    assert said(tmp_path, {**CATKIN, "CMakeLists.txt": lists}, "PKG012") == []


def test_a_folder_of_which_git_keeps_nothing(tmp_path: Path) -> None:
    lists = LISTS.replace("DIRECTORY launch", "DIRECTORY launch maps")
    (text,) = said(tmp_path, {**CMAKE, "CMakeLists.txt": lists, ".gitignore": "/maps/*\n"}, "PKG012")
    assert text.partition(" ")[2] == f"info CMakeLists.txt {MISSING.format('maps')}"


def test_what_the_build_may_make(tmp_path: Path) -> None:
    lists = LISTS.replace(
        "install(DIR", "add_custom_command(OUTPUT maps/a.pgm)\ninstall(DIRECTORY maps DESTINATION b)\ninstall(DIR"
    )
    (text,) = said(tmp_path, {**CMAKE, "CMakeLists.txt": lists}, "PKG012")
    assert text.startswith("CMakeLists.txt:8 hint")


@pytest.mark.silent
@pytest.mark.parametrize(
    "lists",
    [
        LISTS,
        LISTS.replace("DIRECTORY launch", "DIRECTORY maps OPTIONAL"),
        LISTS.replace("install(DIR", "install(DIRECTORY maps/${HALL} DESTINATION share/arm)\ninstall(DIR"),
        LISTS.replace(
            "install(DIR", "if(WITH_MAPS)\n  install(DIRECTORY maps DESTINATION share/arm)\nendif()\ninstall(DIR"
        ),
        LISTS.replace(
            "install(DIR", "install(FILES ${CMAKE_CURRENT_BINARY_DIR}/a.yaml DESTINATION share/arm)\ninstall(DIR"
        ),
        LISTS.replace("install(DIR", "install(FILES /opt/maps/a.yaml DESTINATION share/arm)\ninstall(DIR"),
    ],
)
def test_what_is_there_or_may_be(tmp_path: Path, lists: str) -> None:
    assert said(tmp_path, {**CMAKE, "CMakeLists.txt": lists}, "PKG012") == []
