"""The launch that gives a parameter file to the nodes that it has sections for (ROS 2).

No launch that can be evaluated need do so: an argument or a program names the file, or somebody starts the node by
hand. What is wrong with the parameters is wrong all the same.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple
from xml.sax.saxutils import quoteattr

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Text, Unreadable
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.files import Files
from preflight_analysis.evaluation.ros2.param_files import Section, read_param_file
from preflight_analysis.evaluation.ros2.spawners import MANAGER
from preflight_analysis.incremental.database import Database
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.read import read_launch
from preflight_analysis.model.context import ExecutableNames
from preflight_analysis.model.loose_param_files import is_template
from preflight_analysis.model.programs_by_name import Program, program_called

_GENERATION = 2
_SUFFIX = "#launch.xml"
"""Behind the name of the parameter file: no file is called so."""
_TYPE = ".type"
_MOST = 60
"""Nodes of one file."""


class Supposed(NamedTuple):
    """A launch file that is not there: its path, and its text."""

    path: str
    text: str


def supposed_launch(
    db: Database, environment: Environment, executables: ExecutableNames, package: Package, document: Document
) -> Supposed | None:
    """A launch file that starts the nodes with the file; None where it is for none that is known."""
    if is_template(document.text):
        return None
    started: dict[str, Program] = {}
    loaded: list[tuple[str, str]] = []
    for section in read_param_file(document).sections:
        if not section.exact or len(started) > _MOST:
            continue
        controllers = list(_controllers(section))
        if controllers:
            started[section.pattern] = Program(*MANAGER)
            loaded += [(section.pattern, each) for each in controllers]
        elif (found := program_called(db, environment, executables, package, names.leaf(section.pattern))) is not None:
            started[section.pattern] = found
    if not started:
        return None
    nodes = [_node(full, program, document.path) for full, program in started.items()]
    text = "\n".join(["<launch>", *nodes, *(_spawner(*each) for each in loaded), "</launch>"])
    return Supposed(document.path + _SUFFIX, text)


def _controllers(section: Section) -> Iterator[str]:
    """Those of which a section has the type, as that of a controller manager does."""
    for param in section.params:
        name = param.name.removesuffix(_TYPE)
        if name != param.name and "." not in name and isinstance(param.value, str) and "/" in param.value:
            yield name


def _node(full: str, program: Program, path: str) -> str:
    space = f"namespace={quoteattr(names.parent(full))}"
    given = f"<param from={quoteattr(path)}/>"
    called = f"pkg={quoteattr(program.package)} name={quoteattr(names.leaf(full))} {space}"
    if not program.plugin:
        return f"<node exec={quoteattr(program.executable)} {called}>{given}</node>"
    component = f"<composable_node plugin={quoteattr(program.plugin)} {called}>{given}</composable_node>"
    container = "node_container pkg='rclcpp_components' exec='component_container' name='_'"
    return f"<{container} {space}>{component}</node_container>"


def _spawner(manager: str, controller: str) -> str:
    args = quoteattr(f"{controller} --controller-manager {manager}")
    return f"<node pkg='controller_manager' exec='spawner' name={quoteattr(f'spawner_{controller}')} args={args}/>"


class WithSupposed(Files):
    """Files, with the text of a launch file at the path of one that is not there."""

    def __init__(self, files: Files, path: str, text: str) -> None:
        super().__init__(files.db)
        self._files, self._path = files, path
        self._text = text

    def launch_file(self, path: str, generation: int | None = None) -> LaunchFile | Unreadable:
        """That launch file, or any other one."""
        if path != self._path:
            return self._files.launch_file(path, generation)
        return read_launch(Text.of(path, self._text), _GENERATION)
