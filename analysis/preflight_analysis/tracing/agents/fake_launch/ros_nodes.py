"""Those of `launch_ros.actions` and `launch_ros.descriptions` that start nodes."""

from __future__ import annotations

from collections.abc import Iterable as AnyIterable
from typing import Any

from .base import Action, Made, Substitution, ensure_argument_type, normalize_to_list_of_substitutions
from .processes import ExecuteProcess
from .ros_parameters import normalize_parameters, normalize_remap_rules, serialize_parameters, serialize_remappings
from .ros_substitutions import ExecutableInPackage


class Node(ExecuteProcess):
    UNSPECIFIED_NODE_NAME = "<node_name_unspecified>"
    UNSPECIFIED_NODE_NAMESPACE = "<node_namespace_unspecified>"

    def preflight_take(self, given: Any, left: Any) -> None:
        first = given.executable
        if given.package is not None:
            first = ExecutableInPackage(package=given.package, executable=given.executable)
        command = [first, *([] if given.arguments is None else given.arguments)]
        command += [] if given.ros_arguments is None else ["--ros-args", *given.ros_arguments]
        normalized: tuple[Any, ...] = ()
        if given.parameters is not None:
            ensure_argument_type(given.parameters, list, "parameters", "Node")
            normalized = normalize_parameters(given.parameters)
        left["name"] = given.exec_name
        super().__init__(cmd=command, **left)
        self.__given = given
        self.__parameters = normalized
        self.__remappings = [] if given.remappings is None else list(normalize_remap_rules(given.remappings))

    @property
    def node_package(self) -> Any:
        return self.__given.package

    @property
    def node_executable(self) -> Any:
        return self.__given.executable

    @property
    def node_name(self) -> Any:
        raise RuntimeError("cannot access 'node_name' before executing action")

    @property
    def expanded_node_namespace(self) -> Any:
        return self.UNSPECIFIED_NODE_NAMESPACE

    @property
    def expanded_remapping_rules(self) -> Any:
        return None

    def preflight_named(self) -> Any:
        """Its name and namespace, as given."""
        return self.__given.name, self.__given.namespace

    def preflight_serialize(self, t: Any) -> None:
        given = self.__given
        t.attribute("pkg", given.package)
        t.attribute("exec", given.executable)
        t.attribute("name", given.name)
        t.attribute("namespace", given.namespace)
        t.attribute("exec_name", given.exec_name)
        for word in given.arguments or ():
            t.child("argument", value=word)
        for word in given.ros_arguments or ():
            t.child("ros_argument", value=word)
        serialize_parameters(t, self.__parameters)
        serialize_remappings(t, self.__remappings)
        self.preflight_process(t)


class ComposableNode(Made):
    def preflight_take(self, given: Any, left: Any) -> None:
        self.__package = normalize_to_list_of_substitutions(given.package)
        self.__plugin = normalize_to_list_of_substitutions(given.plugin)
        self.__name = None if given.name is None else normalize_to_list_of_substitutions(given.name)
        self.__namespace = None if given.namespace is None else normalize_to_list_of_substitutions(given.namespace)
        self.__parameters = None if given.parameters is None else normalize_parameters(given.parameters)
        self.__remappings = list(normalize_remap_rules(given.remappings)) if given.remappings else None
        self.__extra_arguments = normalize_parameters(given.extra_arguments) if given.extra_arguments else None
        self.__condition = given.condition

    @property
    def package(self) -> Any:
        return self.__package

    @property
    def node_plugin(self) -> Any:
        return self.__plugin

    @property
    def node_name(self) -> Any:
        return self.__name

    @property
    def node_namespace(self) -> Any:
        return self.__namespace

    @property
    def parameters(self) -> Any:
        return self.__parameters

    @property
    def remappings(self) -> Any:
        return self.__remappings

    @property
    def extra_arguments(self) -> Any:
        return self.__extra_arguments

    def condition(self) -> Any:
        return self.__condition

    def preflight_serialize(self, t: Any) -> None:
        t.condition(self.__condition)
        t.attribute("pkg", self.__package)
        t.attribute("plugin", self.__plugin)
        t.attribute("name", self.__name)
        t.attribute("namespace", self.__namespace)
        serialize_parameters(t, self.__parameters)
        serialize_parameters(t, self.__extra_arguments, "extra_dict")
        serialize_remappings(t, self.__remappings)


class ComposableLifecycleNode(ComposableNode):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)
        self.__autostart = given.autostart

    @property
    def node_autostart(self) -> Any:
        return self.__autostart

    def preflight_serialize(self, t: Any) -> None:
        super().preflight_serialize(t)
        t.attribute("autostart", self.__autostart)


class ComposableNodeContainer(Node):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(name=given.name, namespace=given.namespace, **left)
        self.__descriptions = given.composable_node_descriptions

    def preflight_serialize(self, t: Any) -> None:
        super().preflight_serialize(t)
        for description in self.__descriptions or ():
            t.entity(description)


class LifecycleNode(Node):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(name=given.name, namespace=given.namespace, **left)
        self.preflight_autostart = given.autostart

    def preflight_serialize(self, t: Any) -> None:
        super().preflight_serialize(t)
        if self.preflight_autostart is not None:
            t.attribute("autostart", self.preflight_autostart)

    @property
    def is_autostart(self) -> Any:
        return self.preflight_autostart


class LifecycleTransition(Action):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)
        if len(given.lifecycle_node_names) == 0:
            raise RuntimeError("No lifecycle_node_names provided.")
        if len(given.transition_ids) == 0:
            raise RuntimeError("No transition_ids provided.")
        self.__names, self.__transitions = list(given.lifecycle_node_names), list(given.transition_ids)

    def preflight_serialize(self, t: Any) -> None:
        for name in self.__names:
            for transition in self.__transitions:
                t.child("asked", name=name, transition=transition)


class LoadComposableNodes(Action):
    def preflight_take(self, given: Any, left: Any) -> None:
        types = (str, Substitution, AnyIterable, ComposableNodeContainer)
        ensure_argument_type(given.target_container, types, "target_container", "LoadComposableNodes")
        super().__init__(**left)
        self.__descriptions, self.__target = given.composable_node_descriptions, given.target_container

    def preflight_serialize(self, t: Any) -> None:
        if isinstance(self.__target, ComposableNodeContainer):
            name, namespace = self.__target.preflight_named()
            t.child("target", name=name, namespace=namespace)
        else:
            t.attribute("target", self.__target)
        for description in self.__descriptions or ():
            t.entity(description)
