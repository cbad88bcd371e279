"""PKG014: a variable in `CMakeLists.txt` that nothing sets, where one of a like name is set for nothing."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.packaging import CMAKE, LISTS, said

GENERATES = LISTS.replace(
    "ament_package()", "file(GLOB ARM_SRVS srv/*.srv)\nrosidl_generate_interfaces(arm ${ARM_SRVS})\nament_package()"
)
SLIP = GENERATES.replace("${ARM_SRVS}", "${AR_SRVS}")


@pytest.mark.parametrize(
    ("lists", "name"), [(SLIP, "AR_SRVS"), (SLIP.replace("file(GLOB ARM_SRVS", "set(ARM_SRVS"), "AR_SRVS")]
)
def test_a_slip(tmp_path: Path, lists: str, name: str) -> None:
    assert said(tmp_path, {**CMAKE, "CMakeLists.txt": lists}, "PKG014") == [
        f"CMakeLists.txt:9 warning variable '{name}' is set nowhere and is empty, and 'ARM_SRVS' is used nowhere; did "
        "you mean 'ARM_SRVS'?"
    ]


@pytest.mark.silent
@pytest.mark.parametrize(
    "changed",
    [
        {"CMakeLists.txt": GENERATES},
        {"CMakeLists.txt": SLIP.replace("project(arm)", "project(arm)\noption(AR_SRVS)")},
        {"CMakeLists.txt": SLIP + "message(${ARM_SRVS})\n"},
        {"CMakeLists.txt": SLIP + "if(ARM_SRVS)\nendif()\n"},
        {"CMakeLists.txt": SLIP, "cmake/more.cmake": "set(AR_SRVS srv/a.srv)\n"},
        {"CMakeLists.txt": SLIP, "test/CMakeLists.txt": "message(${ARM_SRVS})\n"},
        {"CMakeLists.txt": GENERATES.replace("(arm ${ARM_SRVS})", "(arm ${catkin_SRVS} ${ARM_SRVS})")},
        {"CMakeLists.txt": GENERATES + "# ${AR_SRVS}\n"},
        {"CMakeLists.txt": SLIP + "find_package(Ar REQUIRED)\n"},
    ],
)
def test_set_somewhere(tmp_path: Path, changed: dict[str, str]) -> None:
    assert said(tmp_path, {**CMAKE, **changed}, "PKG014") == []
