"""PKG013: a build file that the build tools refuse."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.packaging import CFG, CMAKE, LISTS, PYTHON, SETUP, said

CONFLICT = "<<<<<<< HEAD\n{}=======\n{}>>>>>>> 8ba7006e\n"
BROKEN = "; the package does not build"
CATKIN = {
    **CMAKE,
    "package.xml": CMAKE["package.xml"].replace("ament_cmake", "catkin"),
    "CMakeLists.txt": LISTS.replace("ament_package", "catkin_package").replace("ament_cmake", "catkin"),
}


@pytest.mark.parametrize(
    ("files", "changed", "expected"),
    [
        (
            CMAKE,
            {"CMakeLists.txt": LISTS + CONFLICT.format("# a\n", "# b\n")},
            f"CMakeLists.txt:9 error CMakeLists.txt has the marks of a merge conflict{BROKEN}",
        ),
        (
            CATKIN,
            {"package.xml": CATKIN["package.xml"] + "\n" + CONFLICT.format("", "<!-- -->\n")},
            f"package.xml:2 error package.xml has the marks of a merge conflict{BROKEN}",
        ),
        (
            PYTHON,
            {"setup.py": CONFLICT.format("import os\n", "import sys\n") + SETUP},
            f"setup.py:1 error setup.py has the marks of a merge conflict{BROKEN}",
        ),
        (
            CMAKE,
            {"CMakeLists.txt": LISTS.replace("project(arm)", "project(arm_robot)")},
            "CMakeLists.txt:2 error project 'arm_robot' has another name than its package 'arm' in package.xml; CMake "
            "stops",
        ),
        (
            CATKIN,
            {"CMakeLists.txt": CATKIN["CMakeLists.txt"].replace("project(arm)", "project(leg)")},
            "CMakeLists.txt:2 error project 'leg' has another name than its package 'arm' in package.xml; CMake stops",
        ),
        (
            PYTHON,
            {"setup.py": SETUP.replace("from glob import glob", "import glob")},
            "setup.py:11 error 'glob' is a module and cannot be called; setup.py raises a TypeError, and the package "
            "does not build; import it with `from glob import glob`",
        ),
        (
            PYTHON,
            {"setup.py": SETUP.replace("glob('launch/*')", "glob('launch', '*')")},
            "setup.py:11 error 'glob' takes one argument and gets 2; setup.py raises a TypeError, and the package does "
            "not build",
        ),
        (
            PYTHON,
            {"setup.py": SETUP.replace("from glob import glob\n", "")},
            "setup.py:10 error undefined name 'glob'; setup.py raises a NameError, and the package does not build",
        ),
        (PYTHON, {"setup.py": SETUP + "setup(\n"}, "setup.py:{} error setup.py is not valid Python: '('"),
        (
            PYTHON,
            {"setup.cfg": CFG.replace("script_dir", "script-dir")},
            "setup.cfg:2 info option 'script-dir' in setup.cfg is deprecated: setuptools warns, and versions 78.0.0 "
            "and 78.0.1 refuse it; write 'script_dir'",
        ),
    ],
)
def test_refused(tmp_path: Path, files: dict[str, str | None], changed: dict[str, str | None], expected: str) -> None:
    (text,) = said(tmp_path, {**files, **changed}, "PKG013")
    assert text.startswith(expected.format(SETUP.count("\n") + 1))


def test_a_manifest_that_is_no_xml(tmp_path: Path) -> None:
    (text,) = said(tmp_path, {**CMAKE, "package.xml": CMAKE["package.xml"].replace("</name>", "</nme>")}, "PKG013")
    assert text.startswith("package.xml:1 error package.xml is not well-formed: ")


@pytest.mark.silent
@pytest.mark.parametrize(
    ("files", "changed"),
    [
        (PYTHON, {}),
        (CMAKE, {}),
        (CATKIN, {}),
        (CMAKE, {"CMakeLists.txt": "# =======\n" + LISTS}),
        (CMAKE, {"CMakeLists.txt": LISTS.replace("project(arm)", "set(NAME arm)\nproject(${NAME})")}),
        (CMAKE, {"CMakeLists.txt": LISTS.replace("project(arm)", "project(leg)").replace("ament_package()\n", "")}),
        (PYTHON, {"setup.py": SETUP.replace("from glob import glob", "import glob").replace("glob('", "glob.glob('")}),
        (PYTHON, {"setup.py": "import glob\n" + SETUP}),
        (PYTHON, {"setup.cfg": CFG + "[tool:x]\na-b=1\n"}),
        (CATKIN, {"setup.py": "print 'of Python 2'\n"}),
    ],
)
def test_not_refused(tmp_path: Path, files: dict[str, str | None], changed: dict[str, str | None]) -> None:
    assert said(tmp_path, {**files, **changed}, "PKG013") == []
