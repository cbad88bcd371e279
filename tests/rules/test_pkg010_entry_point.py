"""PKG010: an entry point of setup.py that cannot be loaded (ROS 2)."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.packaging import PYTHON, SETUP, findings, said

DRIVER = "'driver = arm.driver:main',"
NEAR = "setup.py:15 error entry point 'driver': there is no module '{}' in package 'arm'; did you mean '{}'?"


@pytest.mark.parametrize(
    ("entry", "expected"),
    [
        ("'driver = arm.drivr:main',", [NEAR.format("arm.drivr", "arm.driver")]),
        ("'driver = arm.driver.py:main',", [NEAR.format("arm.driver.py", "arm.driver")]),
        ("'driver = arn.driver:main',", [NEAR.format("arn.driver", "arm.driver")]),
        ("'driver = arm.gripper:main',", ["setup.py:15 error entry point 'driver': there is no module 'arm.gripper'"]),
        (
            "'driver = arm.driver:mian',",
            ["setup.py:15 error entry point 'driver': arm/driver.py has no function 'mian'; did you mean 'main'?"],
        ),
        ("'driver = arm.driver:run',", ["setup.py:15 error entry point 'driver': arm/driver.py has no function 'run'"]),
        ("'driver = arm.driver',", ["setup.py:15 error entry point 'driver' names no function"]),
        (
            "'driver = arm.driver:main'",
            [
                "setup.py:15 error entry points run together, a comma is missing between them: "
                "'driver = arm.driver:mainplanner = arm.planner:main'"
            ],
        ),
        ("'driver = arm/driver:main',", ["setup.py:15 error entry point 'driver = arm/driver:main' cannot be read"]),
        (
            "'driver = arm.tools.driver:main',",
            [
                "setup.py:15 warning module 'arm.tools.driver' of entry point 'driver' is not installed: "
                "find_packages does not find a folder without __init__.py, and arm/tools has none"
            ],
        ),
    ],
)
def test_what_cannot_be_loaded(tmp_path: Path, entry: str, expected: list[str]) -> None:
    files = {**PYTHON, "setup.py": SETUP.replace(DRIVER, entry), "arm/tools/driver.py": "def main(): pass\n"}
    found = said(tmp_path, files, "PKG010")
    assert len(found) == len(expected)
    assert all(text.startswith(start) for text, start in zip(found, expected, strict=True)), found


@pytest.mark.parametrize(
    ("packages", "why"),
    [
        (
            "find_packages(exclude=['test'])",
            "find_packages does not find a folder without __init__.py, and arm has none",
        ),
        ("['amr']", "`packages` in setup.py does not list 'arm'"),
    ],
)
def test_a_package_that_is_left_out_is_told_of_once(tmp_path: Path, packages: str, why: str) -> None:
    setup = SETUP.replace("find_packages(exclude=['test'])", packages)
    (text,) = said(tmp_path, {**PYTHON, "setup.py": setup, "arm/__init__.py": None}, "PKG010")
    assert text == f"setup.py:15 warning module 'arm.driver' of entry point 'driver' is not installed: {why}"


def test_the_fix_names_what_was_meant(tmp_path: Path) -> None:
    files = {**PYTHON, "setup.py": SETUP.replace(DRIVER, "'driver = arm.drivr:main',")}
    (finding,) = findings(tmp_path, files, "PKG010")
    (edit,) = finding.fixes[0].edits
    assert (edit.text, finding.candidates) == ("arm.driver", ("arm.driver",))


@pytest.mark.silent
@pytest.mark.parametrize(
    "changed",
    [
        {},
        {"arm/driver.py": "from arm.planner import main\n"},
        {"arm/driver.py": "from arm.planner import *\n"},
        {"arm/driver.py": "try:\n    import rclpy\nexcept ImportError:\n    pass\nelse:\n    main = rclpy.init\n"},
        {"arm/driver.py": None, ".gitignore": "driver.py\n"},
        {
            "setup.py": SETUP.replace("arm.driver:main", "arm.driver"),
            "arm/driver.py": "import rclpy\nrclpy.spin(None)\n",
        },
        {"setup.py": SETUP.replace("find_packages(exclude=['test'])", "['arm']"), "arm/__init__.py": None},
        {"setup.py": SETUP.replace("find_packages(exclude=['test'])", "some_of_them()"), "arm/__init__.py": None},
        {
            "setup.py": SETUP.replace("find_packages(exclude=['test'])", "find_packages('src')"),
            "arm/__init__.py": None,
            "src/arm/__init__.py": "",
            "src/arm/driver.py": "def main(): pass\n",
            "arm/driver.py": None,
        },
        {"setup.py": "def"},
    ],
)
def test_what_can_be_loaded(tmp_path: Path, changed: dict[str, str | None]) -> None:
    assert said(tmp_path, {**PYTHON, **changed}, "PKG010") == []


@pytest.mark.parametrize("entry", ["a{}b", "a = b{}c"])
def test_an_entry_of_blanks_is_read_at_once(tmp_path: Path, entry: str) -> None:
    blanks = " " * 50_000  # to look for the end from each of them took a minute
    setup = SETUP.replace(DRIVER, f"'{entry.format(blanks)}',")
    (text,) = said(tmp_path, {**PYTHON, "setup.py": setup}, "PKG010")
    assert text.startswith("setup.py:15 error entry point 'a")
