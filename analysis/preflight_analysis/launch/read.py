"""Which format and generation a launch file is of, and reading it as that.

The name says what YAML and Python files are. XML files of both generations may have the same name: what they hold
decides (`exec=` and `$(var)` against `type=` and `$(arg)`), then the package that they are in.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from preflight_analysis.catalogue.launches import catalogued_file
from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.reading import Text
from preflight_analysis.documents.xml import parse_xml, without_comments
from preflight_analysis.documents.yaml import parse_yaml
from preflight_analysis.launch.catalogued import read_catalogued
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.recognize import is_yaml
from preflight_analysis.launch.ros1_xml import read_ros1
from preflight_analysis.launch.ros2_python import read_ros2_python
from preflight_analysis.launch.ros2_xml import read_ros2_xml
from preflight_analysis.launch.ros2_yaml import read_ros2_yaml

_OF_XML = {1: read_ros1, 2: read_ros2_xml}
"""Who reads XML, by generation."""
# Each begins with what is quickly found: all of a long file is looked through on each keystroke.
_TAGS_OF_ROS2 = re.compile(
    r"""<(?:let|push[_-]ros[_-]namespace|set_(?:remap|parameter|env|use_sim_time|parameters_from_file)"""
    r"""|unset_env|append_env|node_container|composable_node|load_composable_node|executable|timer)[\s/>]"""
)
_TAG_OF_BOTH = re.compile(r"<(arg|node|test|param)\s([^<>]*)")
_ATTRIBUTES_OF_ROS2 = {"arg": "description", "node": "exec", "test": "exec", "param": "from"}
"""By tag one that it never had in roslaunch."""
_ROS2_MARKS = (
    re.compile(
        r"\$\((?:var|find-pkg-share|find-pkg-prefix|exec-in-pkg|find-exec|filename|not|and|or|equals|not-equals)\s"
    ),
    re.compile(r"<log[\s/>]"),
    re.compile(r"""<include\s[^<>]*\.(?:py|ya?ml)["']"""),
)
_ROS1_MARKS = re.compile(
    r"""\$\((?:arg|find|optenv)\s|<(?:rosparam|machine|test)[\s/>]"""
    r"""|<node\s[^<>]*\btype\s*=|<(?:include|node|group)\s[^<>]*\bns\s*="""
    r"""|<param\s[^<>]*\b(?:command|textfile|binfile)\s*=|\bpass_all_args\s*="""
)
_AMENT = re.compile(r"<build_type[^<>]*>\s*ament_|<buildtool_depend[^<>]*>\s*ament_")
_CATKIN = re.compile(r"<buildtool_depend[^<>]*>\s*catkin\s*<")


OfPackage = Callable[[str], "int | None"]
"""The generation of the package that a file is in, None where that is not known."""


def no_package(path: str) -> int | None:
    """Of a file that is in no package that is known."""
    return None


def read_launch(
    source: Text,
    generation: int | None = None,
    undecided: int = 1,
    of_package: OfPackage = no_package,
    before: LaunchFile | None = None,
) -> LaunchFile:
    """The launch file of a text, read as that generation of ROS reads it; None: as it looks, and as `undecided` where
    nothing tells. `of_package` gives the generation of the package that a file
    is in. `before` is the file as it was: what an edit leaves alone is taken over. Never raises."""
    path, text = source.path, source.text
    if catalogued_file(path) is not None:
        return read_catalogued(source)
    if is_python(path, text):
        return read_ros2_python(source)
    if is_yaml(path):
        return read_ros2_yaml(parse_yaml(path, text, source.lines))
    document = parse_xml(path, text, source.encoding, source.lines, before.document if before is not None else None)
    return _OF_XML[generation or generation_of(path, text, undecided, of_package)](document)


def generation_of(path: str, text: str, undecided: int = 1, of_package: OfPackage = no_package) -> int:
    """1 or 2; `undecided` for what has no mark of either, in no package that has one."""
    if is_yaml(path) or is_python(path, text):
        return 2
    code = without_comments(text)
    never_ros1 = _is_never_ros1(code)
    ros2, ros1 = never_ros1 or any(mark.search(code) for mark in _ROS2_MARKS), _ROS1_MARKS.search(code) is not None
    if ros2 and not ros1:
        return 2
    if ros1 and not ros2:
        # By that name, and in a package of ROS 2, it is one that speaks the older language by mistake.
        return 2 if path.endswith(".launch.xml") and of_package(path) == 2 else 1
    found = of_package(path)
    if found is None and ros2:  # what only ROS 2 has, beside what both have had at some time
        return 2 if never_ros1 else 1
    return found or undecided


def _is_never_ros1(code: str) -> bool:
    """Whether a tag or an attribute is there that roslaunch never had."""
    return _TAGS_OF_ROS2.search(code) is not None or any(
        (name := _ATTRIBUTES_OF_ROS2[tag]) in rest and re.search(rf"\b{name}\s*=", rest) is not None
        for tag, rest in _TAG_OF_BOTH.findall(code)
    )


def generation_of_manifest(text: str) -> int | None:
    """The generation of a package by the build tool that its `package.xml` names, None where that tells nothing."""
    content = without_comments(text)
    return 2 if _AMENT.search(content) else 1 if _CATKIN.search(content) else None
