"""Which files are launch files, and in which format: by what is in them, and by the name where that leaves it open.

An XML file is one by its document element, a YAML file by its only key, a Python file by the function that launch
calls. A file that is called like a launch file is one too as long as nothing in it says otherwise: it may be empty, or
be typed right now.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from typing import Literal

from preflight_analysis.documents.disk import beginning_of, text_of
from preflight_analysis.documents.python_text import LAUNCH_FUNCTION, PYTHON_SUFFIX, is_python
from preflight_analysis.documents.reading import Text
from preflight_analysis.documents.xml_text import document_element
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query

Format = Literal["xml", "yaml", "python"]
FileKind = Literal["launch file", "parameter file", "build file", "robot description", "behavior tree", "module"]
"""What a file is, as far as there are checks for it."""

YAML_SUFFIXES = (".yaml", ".yml")
LAUNCH_SUFFIXES = (
    ".launch",
    ".test",
    *(f"{mark}launch.{suffix}" for mark in "._" for suffix in ("xml", "yaml", "yml", "py")),
)
"""What launch files are called; others are known by what is in them."""
LAUNCH_FOLDER = "launch"
"""Where packages have their launch files, whatever they are called."""
_BUILD_FILES = ("package.xml", "CMakeLists.txt", "setup.py", "setup.cfg")
_DESCRIPTION_SUFFIXES = (".xacro", ".urdf", ".srdf", ".sdf", ".world")
_DESCRIPTION_ROOTS = frozenset(("robot", "sdf", "gazebo", "world", "model"))
_TREE_ROOT = "root"
"""Of behavior trees, as BehaviorTree.CPP has it."""
_SUFFIXES = (".xml", *YAML_SUFFIXES, PYTHON_SUFFIX)
"""Of files that may be launch files whatever else they are called."""
_OTHER_ROOTS = frozenset(("launchConfiguration", "sdf", "gazebo", "robot", "COLLADA", "html", "opencv_storage"))
"""Document elements that programs beside ROS read: Eclipse, simulators, robot models, OpenCV."""
_YAML_PROLOGUE = r"\A\ufeff?(?:[ \t]*(?:#[^\n]*)?\r?\n|%[^\n]*\n|---[^\n]*\n)*"
_LAUNCH_KEY = re.compile(_YAML_PROLOGUE + r"""(["']?)launch\1[ \t]*:(?:\s|#[^\n]*\n)*(?:-\s|\[)""")
"""A document that begins with a list of that name. launch takes one key alone."""
_SECOND_KEY = re.compile(r"""^[^\s#\-\[\]{}.'"][^\n]*:(?:\s|$)""", re.MULTILINE)
_ANY_KEY = re.compile(_YAML_PROLOGUE + r"[^\s#]")
_PARAMETERS = re.compile(r"^\s+ros__parameters:", re.MULTILINE)
_YAML_LAUNCH = re.compile(r"^launch:", re.MULTILINE)
_MAY_HAVE_FUNCTION = re.compile(
    r"^\s*(?:async\s+)?def\s+gen\w*_desc|^\s*from\s.*\bimport\s+\*|^gen\w*_desc\w*\s*[=:]"
    r"|^\s*from\s[^#()\n]*\bimport\s(?:[^#()\n]*|\s*\([^()]*)\bgen\w*_desc",
    re.MULTILINE,
)
_OF_TEST = re.compile(
    r"^(?:async\s+)?def\s+(?:test_|generate_test_description\b)|^class\s+Test"
    r"|^(?:import|from)\s+(?:pytest|unittest|launch_testing|launch_pytest)\b",
    re.MULTILINE,
)


def launch_format(path: str, text: str) -> Format | None:
    """The format of a launch file; None for a file that is none."""
    is_named = path.endswith(LAUNCH_SUFFIXES)
    if is_python(path, text):
        return "python" if _is_python_launch_file(path, text, is_named=is_named) else None
    if is_yaml(path):
        return "yaml" if _is_yaml_launch_file(text, is_named=is_named) else None
    return "xml" if _is_xml_launch_file(path, text, is_named=is_named) else None


def launch_format_on_disk(db: Database, path: str) -> Format | None:
    """The same of a file on the disk, or open in the editor. Of one that is not called like a launch file, its
    beginning is read where that tells."""
    return _format_of(db, path) if path.endswith((*LAUNCH_SUFFIXES, *_SUFFIXES)) else None


def launch_files_of(db: Database, paths: Iterable[str]) -> list[str]:
    """Those of these files that are launch files; in Python those that are called so or lie in a launch folder."""
    placed = (p for p in paths if not p.endswith(PYTHON_SUFFIX) or p.endswith(LAUNCH_SUFFIXES) or _in_launch_folder(p))
    return [path for path in placed if launch_format_on_disk(db, path) is not None]


def file_kind(db: Database, path: str) -> FileKind | None:
    """What a file is, by its name and by what is in it; None of a kind for which there are no checks. XML without any
    element is a launch file that is being written."""
    name = os.path.basename(path)
    if launch_format_on_disk(db, path) is not None:
        return "launch file"
    if name in _BUILD_FILES:
        return "build file"
    if is_yaml(path):
        return "parameter file"
    if path.endswith(_DESCRIPTION_SUFFIXES):
        return "robot description"
    text = text_of(db, path)
    content = text.text if isinstance(text, Text) else ""
    if is_python(path, content):
        return "module"
    tag = document_element(content)
    if tag == "launch" or (path.endswith(".xml") and tag is None):
        return "launch file"
    if tag in _DESCRIPTION_ROOTS:
        return "robot description"
    return "behavior tree" if tag == _TREE_ROOT and "BehaviorTree" in content else None


@query
def _format_of(db: Database, path: str) -> Format | None:
    if not path.endswith((*LAUNCH_SUFFIXES, PYTHON_SUFFIX)):
        beginning = beginning_of(db, path)
        tells = _ANY_KEY.match(beginning) if is_yaml(path) else document_element(beginning)
        if launch_format(path, beginning) is None and tells is not None:
            return None
    text = text_of(db, path)
    return launch_format(path, text.text if isinstance(text, Text) else "")


def is_yaml(path: str) -> bool:
    """Whether a launch file of that name is in YAML."""
    return path.endswith(YAML_SUFFIXES)


def _is_python_launch_file(path: str, text: str, *, is_named: bool) -> bool:
    if LAUNCH_FUNCTION.search(text) is not None:
        return True
    return is_named and _OF_TEST.search(text) is None and not _is_module(path, text)


def _is_module(path: str, text: str) -> bool:
    """Whether a file that ends in `_launch.py` is a module that helps to make launch files: it lies in no launch
    folder, and nothing in it may be the function that launch calls."""
    is_named = path.endswith("_launch" + PYTHON_SUFFIX) and not _in_launch_folder(path)
    return is_named and bool(text.strip()) and _MAY_HAVE_FUNCTION.search(text) is None


def _is_yaml_launch_file(text: str, *, is_named: bool) -> bool:
    if is_named:
        return _PARAMETERS.search(text) is None or _YAML_LAUNCH.search(text) is not None
    found = _LAUNCH_KEY.match(text)
    return found is not None and _SECOND_KEY.search(text, found.end()) is None


def _is_xml_launch_file(path: str, text: str, *, is_named: bool) -> bool:
    if not is_named and not path.endswith(".xml"):
        return False
    tag = document_element(text)
    if tag == "launch" or not is_named:
        return tag == "launch"
    if tag:
        return tag not in _OTHER_ROOTS
    # Tests of LLVM are command lines.
    is_other = bool(text.strip()) and not text.lstrip().startswith("<") and "<launch" not in text
    return not is_other or _in_launch_folder(path)


def _in_launch_folder(path: str) -> bool:
    return LAUNCH_FOLDER in path.split(os.sep)
