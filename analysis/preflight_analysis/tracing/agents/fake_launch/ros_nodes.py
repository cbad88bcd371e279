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
    preflight_kind = "node"

    def __init__(
        self,
        *,
        executable: Any,
        package: Any = None,
        name: Any = None,
        namespace: Any = None,
        exec_name: Any = None,
        parameters: Any = None,
        remappings: Any = None,
        ros_arguments: Any = None,
        arguments: Any = None,
        **kwargs: Any,
    ) -> None:
        first = executable if package is None else ExecutableInPackage(package=package, executable=executable)
        command = [first, *([] if arguments is None else arguments)]
        command += [] if ros_arguments is None else ["--ros-args", *ros_arguments]
        normalized: tuple[Any, ...] = ()
        if parameters is not None:
            ensure_argument_type(parameters, list, "parameters", "Node")
            normalized = normalize_parameters(parameters)
        kwargs["name"] = exec_name
        super().__init__(cmd=command, **kwargs)
        self.__named = (package, executable, name, namespace, exec_name)
        self.__parameters = normalized
        self.__remappings = [] if remappings is None else list(normalize_remap_rules(remappings))
        self.__arguments, self.__ros_arguments = arguments, ros_arguments

    @property
    def node_package(self) -> Any:
        return self.__named[0]

    @property
    def node_executable(self) -> Any:
        return self.__named[1]

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
        return self.__named[2], self.__named[3]

    def preflight_serialize(self, t: Any) -> None:
        t.kind = self.preflight_kind
        package, executable, name, namespace, exec_name = self.__named
        t.attribute("pkg", package)
        t.attribute("exec", executable)
        t.attribute("name", name)
        t.attribute("namespace", namespace)
        t.attribute("exec_name", exec_name)
        for word in self.__arguments or ():
            t.child("argument", value=word)
        for word in self.__ros_arguments or ():
            t.child("ros_argument", value=word)
        serialize_parameters(t, self.__parameters)
        serialize_remappings(t, self.__remappings)
        self.preflight_process(t)


class ComposableNode(Made):
    def __init__(
        self,
        *,
        package: Any,
        plugin: Any,
        name: Any = None,
        namespace: Any = None,
        parameters: Any = None,
        remappings: Any = None,
        extra_arguments: Any = None,
        condition: Any = None,
    ) -> None:
        self.__package = normalize_to_list_of_substitutions(package)
        self.__plugin = normalize_to_list_of_substitutions(plugin)
        self.__name = None if name is None else normalize_to_list_of_substitutions(name)
        self.__namespace = None if namespace is None else normalize_to_list_of_substitutions(namespace)
        self.__parameters = None if parameters is None else normalize_parameters(parameters)
        self.__remappings = list(normalize_remap_rules(remappings)) if remappings else None
        self.__extra_arguments = normalize_parameters(extra_arguments) if extra_arguments else None
        self.__condition = condition

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
        t.kind = "composable_node"
        t.condition(self.__condition)
        t.attribute("pkg", self.__package)
        t.attribute("plugin", self.__plugin)
        t.attribute("name", self.__name)
        t.attribute("namespace", self.__namespace)
        serialize_parameters(t, self.__parameters)
        serialize_parameters(t, self.__extra_arguments, "extra_dict")
        serialize_remappings(t, self.__remappings)


class ComposableLifecycleNode(ComposableNode):
    def __init__(self, *, autostart: Any = False, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__autostart = autostart

    @property
    def node_autostart(self) -> Any:
        return self.__autostart

    def preflight_serialize(self, t: Any) -> None:
        super().preflight_serialize(t)
        t.attribute("autostart", self.__autostart)


class ComposableNodeContainer(Node):
    preflight_kind = "node_container"

    def __init__(self, *, name: Any, namespace: Any, composable_node_descriptions: Any = None, **kwargs: Any) -> None:
        super().__init__(name=name, namespace=namespace, **kwargs)
        self.__descriptions = composable_node_descriptions

    def preflight_serialize(self, t: Any) -> None:
        super().preflight_serialize(t)
        for description in self.__descriptions or ():
            t.entity(description)


class LifecycleNode(Node):
    preflight_kind = "lifecycle_node"

    def __init__(self, *, name: Any, namespace: Any, autostart: Any = None, **kwargs: Any) -> None:
        super().__init__(name=name, namespace=namespace, **kwargs)
        self.preflight_autostart = autostart

    def preflight_serialize(self, t: Any) -> None:
        super().preflight_serialize(t)
        if self.preflight_autostart is not None:
            t.attribute("autostart", self.preflight_autostart)

    @property
    def is_autostart(self) -> Any:
        return self.preflight_autostart


class LifecycleTransition(Action):
    def __init__(self, *, lifecycle_node_names: Any, transition_ids: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        if len(lifecycle_node_names) == 0:
            raise RuntimeError("No lifecycle_node_names provided.")
        if len(transition_ids) == 0:
            raise RuntimeError("No transition_ids provided.")
        self.__names, self.__transitions = list(lifecycle_node_names), list(transition_ids)

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "lifecycle_transition"
        for name in self.__names:
            for transition in self.__transitions:
                t.child("asked", name=name, transition=transition)


class LoadComposableNodes(Action):
    def __init__(self, *, composable_node_descriptions: Any, target_container: Any, **kwargs: Any) -> None:
        types = (str, Substitution, AnyIterable, ComposableNodeContainer)
        ensure_argument_type(target_container, types, "target_container", "LoadComposableNodes")
        super().__init__(**kwargs)
        self.__descriptions, self.__target = composable_node_descriptions, target_container

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "load_composable_node"
        if isinstance(self.__target, ComposableNodeContainer):
            name, namespace = self.__target.preflight_named()
            t.child("target", name=name, namespace=namespace)
        else:
            t.attribute("target", self.__target)
        for description in self.__descriptions or ():
            t.entity(description)
