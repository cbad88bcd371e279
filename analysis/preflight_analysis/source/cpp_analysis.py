"""The C++ source of a node to what it may do: its program is put together, gone through, and asked what it makes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.span import Place
from preflight_analysis.environment.model import Package
from preflight_analysis.source.collector import Collector
from preflight_analysis.source.config_params import Config
from preflight_analysis.source.cpp_files import CppFiles
from preflight_analysis.source.cpp_frames import BROADCAST
from preflight_analysis.source.cpp_interpreter import interpret_class, interpret_main, interpret_plugin
from preflight_analysis.source.cpp_libraries import may_hide_ends
from preflight_analysis.source.cpp_program import CppProgram, words_in
from preflight_analysis.source.known_params import KnownParams
from preflight_analysis.source.rclcpp_api import CONTROLLERS, PLUGINS
from preflight_analysis.source.rclcpp_api import LIBRARIES as RCLCPP_LIBRARIES
from preflight_analysis.source.rclcpp_calls import RclcppCalls
from preflight_analysis.source.roscpp_api import LIBRARIES
from preflight_analysis.source.roscpp_calls import RoscppCalls
from preflight_analysis.tracing.interface import Endpoint
from preflight_analysis.tracing.nodelets import nodelet_of

PLUGIN_NODE = "/node"
"""The node that a plugin is read in."""
_NODELETS = frozenset({"nodelet::Nodelet"})


class CppAnalysis:
    """Reads the C++ sources of nodes."""

    def __init__(self, packages: Mapping[str, Package], disk: Disk, has_type: Callable[[str, str, str], bool]) -> None:
        self._packages = packages
        self._disk = disk
        self._has_type = has_type

    def read(
        self,
        node: tuple[str, str, str],
        args: Sequence[str],
        remaps: Mapping[str, str],
        params: KnownParams,
        config: Config,
    ) -> Collector:
        """What a node (its name, package and executable) makes."""
        name, package, executable = node
        files = CppFiles(self._packages, self._disk, LIBRARIES)
        calls = RoscppCalls(name, remaps, params, self._has_type, config)
        if (nodelet := nodelet_of(package, executable, args)) is not None:
            self._nodelet(files, nodelet.plugin, calls)
            if nodelet.manager is not None and (calls.collected.endpoints or calls.collected.params):
                calls.collected.add_endpoint(
                    Endpoint("client", f"{nodelet.manager}/load_nodelet", "nodelet/NodeletLoad")
                )
        elif (program := files.executable(package, executable)) is not None:
            calls.include(program.includes)
            _judge(program, calls)
            interpret_main(program, (executable, *(arg for arg in args if ":=" not in arg)), calls)
            _expect_broadcasts(program, calls.collected)
            for loaded in calls.nodelets:
                calls.loaded = loaded
                self._nodelet(files, loaded.plugin, calls)
        return calls.collected

    def read_ros2(
        self,
        node: tuple[str, str, str],
        args: Sequence[str],
        params: KnownParams,
        plugin: str | None,
    ) -> Collector:
        """What a node of ROS 2 makes, `plugin` if it is a component that is loaded into a container, or a controller
        (`package/Name`) that a controller manager loads."""
        name, package, executable = node
        files = CppFiles(self._packages, self._disk, RCLCPP_LIBRARIES)
        calls = RclcppCalls(name, params, self._has_type, partial(files.parameter_library, package))
        cls = plugin or files.build(package).component_programs.get(executable)
        if plugin is not None and "/" in plugin:
            controller = files.plugin(plugin, CONTROLLERS, package)
            program, cls = (controller.program, controller.cls) if controller is not None else (None, None)
        else:
            program = files.component(package, cls) if cls is not None else files.executable(package, executable)
        if program is not None:
            calls.includes = program.includes
            _judge(program, calls)
            if cls is not None:
                interpret_class(program, cls.removeprefix("::"), None, calls)
            else:
                interpret_main(program, (executable, *args), calls)
            _expect_broadcasts(program, calls.collected)
        calls.finish()
        return calls.collected

    def read_plugin(self, name: str, package: str | None, given: str, params: KnownParams) -> Collector | None:
        """What a plugin (`package::Name`) makes in the node that loads it as `given`. `package`: the one that has it,
        where that is known. None where none has, or nothing is known of how its base class gets parameters."""
        files = CppFiles(self._packages, self._disk, RCLCPP_LIBRARIES)
        found = files.plugin(name, PLUGINS, package)
        if found is None:
            return None
        calls = RclcppCalls(PLUGIN_NODE, params, self._has_type, partial(files.parameter_library, found.package))
        calls.includes = found.program.includes
        _judge(found.program, calls)
        interpret_plugin(found.program, found.cls, PLUGINS[found.base], given, calls)
        calls.finish()
        return calls.collected

    def plugins(self, package: str) -> tuple[str, ...]:
        """The plugins that a package exports of which is known how they get their parameters."""
        return CppFiles(self._packages, self._disk).plugins(package, PLUGINS)

    def exported(self, package: str) -> tuple[str, ...]:
        """All plugins that a package exports."""
        return CppFiles(self._packages, self._disk).plugins(package)

    def controllers(self, package: str) -> tuple[str, ...]:
        """The controllers of ros2_control that a package exports."""
        return CppFiles(self._packages, self._disk).plugins(package, CONTROLLERS)

    def component(self, package: str, cls: str) -> Place | None:
        """Where the class is defined that a package registers as an rclcpp component."""
        files = CppFiles(self._packages, self._disk, LIBRARIES)
        program = files.component(package, cls)
        found = program.classes.get(tuple(cls.removeprefix("::").split("::"))) if program is not None else None
        return Place(found.file.path, found.line) if found is not None else None

    def _nodelet(self, files: CppFiles, plugin: str, calls: RoscppCalls) -> None:
        found = files.plugin(plugin, _NODELETS)
        if found is not None:
            calls.include(found.program.includes)
            _judge(found.program, calls)
            interpret_class(found.program, found.cls, "onInit", calls)
            _expect_broadcasts(found.program, calls.collected)


def _expect_broadcasts(program: CppProgram, collected: Collector) -> None:
    """Note the functions of the program that broadcast transforms."""
    for function in (each for functions in program.functions.values() for each in functions):
        if collected.frames and function.body is not None and BROADCAST in words_in(function.body):
            first, last = function.body.start_point.row + 1, function.body.end_point.row + 1
            collected.expect_broadcast(function.file.path, first, last)


def _judge(program: CppProgram, calls: RoscppCalls | RclcppCalls) -> None:
    if may_hide_ends(program):
        calls.collected.miss()
