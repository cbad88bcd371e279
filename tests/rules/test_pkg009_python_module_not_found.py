"""Modules that nodes in Python import, in packages that are only source."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

SETUP = """from setuptools import setup
setup(name='tank', packages=['tank'], entry_points={'console_scripts': ['sensor = tank.sensor:main']})
"""
MANIFEST = """<package format="3"><name>tank</name><version>0.1.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>BSD</license><exec_depend>python3-pyfoo</exec_depend>
<export><build_type>ament_python</build_type></export></package>
"""
LAUNCH = '<launch><node pkg="tank" exec="sensor"/></launch>'


def _found(folder: Path, source: str, files: dict[str, str] | None = None) -> list[Finding]:
    package = folder / "src" / "tank"
    given = {
        "package.xml": MANIFEST,
        "setup.py": SETUP,
        "tank/__init__.py": "",
        "tank/calibration.py": "def offset(): return 0\n",
        "tank/sensor.py": f"{source}\n\ndef main(): pass\n",
        "launch/a.launch.xml": LAUNCH,
        **(files or {}),
    }
    for name, text in given.items():
        path = package / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    environment = detect_environment(str(folder), {}, (str(folder / "src"),), root=str(folder / "nothing"))
    analysis = Workspace(environment, Sources()).static(str(package / "launch/a.launch.xml"))
    return [finding for finding in analysis.findings if finding.rule == "PKG009"]


ABSENT = {
    "from tank.calibraton import offset": "tank.calibraton",
    "import tank.calibraton": "tank.calibraton",
    "import os, tank.calibraton as c": "tank.calibraton",
    "from tank import calibraton": "tank.calibraton",
    "from .calibraton import offset": "tank.calibraton",
    "from . import calibraton": "tank.calibraton",
    "from tank.calibraton.deep import offset": "tank.calibraton",
}


@pytest.mark.parametrize("source", ABSENT)
def test_a_module_that_the_own_package_lacks_is_an_error(tmp_path: Path, source: str) -> None:
    (finding,) = _found(tmp_path, source)
    assert (finding.severity, finding.confidence) == ("error", "certain")
    assert finding.message == (
        f"module '{ABSENT[source]}' does not exist; /sensor imports it; did you mean 'tank.calibration'?"
    )
    assert finding.related[0].location.file.endswith("tank/sensor.py")


def test_one_that_is_like_no_other_and_is_imported_by_an_own_module(tmp_path: Path) -> None:
    files = {"tank/calibration.py": "from tank import filters\nimport tank.unheard\n", "tank/filters/__init__.py": ""}
    (finding,) = _found(tmp_path, "from tank.calibration import offset", files)
    assert finding.message == "module 'tank.unheard' does not exist; /sensor imports it"
    assert finding.related[0].location.file.endswith("tank/calibration.py")


THERE = {
    "a module": (
        "from tank.calibration import offset\nfrom tank import calibration\nimport tank\nfrom . import x",
        {"tank/x.py": ""},
    ),
    "a folder": ("from tank.filters import low\nimport tank.filters.low", {"tank/filters/low.py": ""}),
    "a name of the package": ("from tank import VERSION", {"tank/__init__.py": "VERSION = 1\n"}),
    "all names": ("from tank import other", {"tank/__init__.py": "from .calibration import *\n"}),
    "in a try": ("try:\n    import tank.calibraton\nexcept ImportError:\n    pass", {}),
    "in a function": ("def late():\n    import tank.calibraton", {}),
    "for types": ("import typing\nif typing.TYPE_CHECKING:\n    import tank.calibraton", {}),
    "an extension": ("import tank.native", {"tank/native.pyx": ""}),
    "what the build makes": ("from tank.parameters import P", {"setup.py": f"{SETUP}\nmodule_name = 'parameters'\n"}),
    "messages": ("from tank.msg import Level", {}),
    "protocol buffers": ("from tank import level_pb2", {}),
    "below itself": ("import tank.calibration.offset", {}),
    "foreign ones": ("import pyfoo, no_such_module, serial, yaml, numpy.linalg", {}),
}


@pytest.mark.silent
@pytest.mark.parametrize("case", THERE)
def test_what_may_be_there_is_not_reported(tmp_path: Path, case: str) -> None:
    assert [finding.message for finding in _found(tmp_path, *THERE[case])] == []


def test_a_slip_of_a_module_that_everybody_knows_is_a_warning(tmp_path: Path) -> None:
    (finding,) = _found(tmp_path, "import numpyy as np")
    assert (finding.severity, finding.confidence) == ("warning", "likely")
    assert finding.message == "module 'numpyy' is not known; /sensor imports it; did you mean 'numpy'?"


@pytest.mark.silent
def test_one_that_the_package_names_is_none(tmp_path: Path) -> None:
    assert _found(tmp_path, "import numpyy", {"requirements.txt": "numpyy==1.0\n"}) == []
    assert _found(tmp_path, "import numpyy", {"requirements.txt": "", "tank/numpyy.py": ""}) == []


MAY_EXIST = {
    "a name that is imported of a package, as its module": ("from tf import transformations", {}),
    "a name of a module that is like another": ("from tankfoo import numpyy", {}),
    "a module of another name than its distribution": ("from Crypto.Cipher import AES", {}),
    "one like a short one": ("import xmacro", {}),
    "a package of ROS that is not here": ("import mav_msgs.msg", {}),
    "what the read-me file installs": ("import numpyy", {"../../README.md": "pip3 install numpyy\n"}),
    "what an image installs": ("import numpyy", {"../../docker/Dockerfile": "RUN pip install numpyy==1.2\n"}),
    "what another package needs": (
        "import numpyy",
        {"../other/package.xml": MANIFEST.replace("pyfoo", "numpyy").replace("tank", "other")},
    ),
    "a list of its own": (
        "import numpyy",
        {"../../requirements/dev.txt": "numpyy\n", "../../requirements.txt": "Numpyy"},
    ),
}


@pytest.mark.silent
@pytest.mark.parametrize("case", MAY_EXIST)
def test_one_that_may_exist_somewhere_is_none(tmp_path: Path, case: str) -> None:
    assert [finding.message for finding in _found(tmp_path, *MAY_EXIST[case])] == []


@pytest.mark.parametrize("name", ["numpyy", "nmupy", "matplotlb", "transforms3"])
def test_a_letter_more_or_less_is_a_slip_of_a_long_name(tmp_path: Path, name: str) -> None:
    assert len(_found(tmp_path, f"import {name}", {"../../README.md": "pip3 install numpy matplotlib\n"})) == 1
