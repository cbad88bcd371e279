"""`launch_ros.actions`, `.descriptions`, `.parameter_descriptions` and `.utilities`."""

from __future__ import annotations

import os
from collections.abc import Iterable as AnyIterable
from collections.abc import Mapping, Sequence
from typing import Any, Iterable, Optional

from .actions import TimerAction
from .base import (
    Action,
    LaunchContext,
    Made,
    Substitution,
    TextSubstitution,
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from .processes import ExecuteProcess
from .substitutions import ExecutableInPackage
from .typed import extract_type, normalize_typed_substitution, perform_typed_substitution

_SCALARS = (int, float, bool, str)


class ParameterValue(Made):
    def __init__(self, value: Any, *, value_type: Any = None) -> None:
        self.__value = normalize_typed_substitution(value, value_type)
        self.__value_type = value_type
        self.preflight_type: Optional[str] = None
        if value_type is not None:
            kind, is_list = extract_type(value_type)
            self.preflight_type = f"list_of_{kind.__name__}" if is_list else str(kind.__name__)

    @property
    def value(self) -> Any:
        return self.__value

    @property
    def value_type(self) -> Any:
        return self.__value_type

    def evaluate(self, context: LaunchContext) -> Any:
        return perform_typed_substitution(context, self.__value, self.__value_type)


class Parameter(Made):
    def __init__(self, name: Any, value: Any, *, value_type: Any = None) -> None:
        self.__name = normalize_to_list_of_substitutions(name)
        self.preflight_value = ParameterValue(value, value_type=value_type)

    @property
    def name(self) -> Any:
        return self.__name

    @property
    def value(self) -> Any:
        return self.preflight_value.value

    @property
    def value_type(self) -> Any:
        return self.preflight_value.value_type

    def evaluate(self, context: LaunchContext) -> tuple[str, Any]:
        return perform_substitutions(context, self.__name), self.preflight_value.evaluate(context)


class ParameterFile(Made):
    def __init__(self, param_file: Any, *, allow_substs: Any = False) -> None:
        types = (str, Substitution, AnyIterable, os.PathLike, bytes)
        ensure_argument_type(param_file, types, "param_file", "ParameterFile()")
        if isinstance(param_file, bytes):
            param_file = os.fsdecode(param_file)
        self.__param_file = normalize_to_list_of_substitutions(param_file)
        self.__allow_substs = allow_substs

    @property
    def param_file(self) -> Any:
        return self.__param_file

    @property
    def allow_substs(self) -> Any:
        return self.__allow_substs


def normalize_parameter_dict(parameters: Any, *, _prefix: Any = None) -> Any:
    """Each name (as substitutions) with what the host is told of its value."""
    if not isinstance(parameters, Mapping):
        raise TypeError("expected dict")
    normalized = {}
    for key, value in parameters.items():
        name = normalize_to_list_of_substitutions(key)
        if _prefix:
            name = [*_prefix, TextSubstitution(text="."), *name]
        if isinstance(value, Mapping):
            normalized.update(normalize_parameter_dict(value, _prefix=name))
        else:
            normalized[tuple(name)] = _parameter_value(value)
    return normalized


def _parameter_value(value: Any) -> Any:
    if isinstance(value, (ParameterValue, str, float, bool, int, bytes)):
        return value
    if isinstance(value, Substitution):
        return ("yaml", [value])
    if isinstance(value, Sequence):
        return _parameter_array(value)
    raise TypeError(f"Unexpected type for parameter value {value!r}")


def _kind(item: Any) -> type:
    for kind in (Substitution, str, bool, int, float):
        if isinstance(item, kind):
            return kind
    if isinstance(item, Sequence):
        return tuple
    raise RuntimeError(f"Failed to handle type {item!r}")


def _parameter_array(value: Any) -> Any:
    for each in value:
        ensure_argument_type(each, (float, int, str, bool, Substitution, AnyIterable), "subvalue")
    kinds = {_kind(each) for each in value}
    if kinds in ({int}, {bool}):
        return ("list", list(value))
    if kinds and kinds <= {int, float}:
        return ("list", [float(each) for each in value])
    if Substitution in kinds and kinds <= {str, Substitution}:
        return ("yaml", normalize_to_list_of_substitutions(value))
    items = [each if isinstance(each, _SCALARS) else normalize_to_list_of_substitutions(each) for each in value]
    return ("items", items)


def normalize_parameters(parameters: Any) -> tuple[Any, ...]:
    if isinstance(parameters, str) or not isinstance(parameters, Sequence):
        raise TypeError(f"Expecting list of parameters, got {parameters}")
    found: list[Any] = []
    for param in parameters:
        if isinstance(param, Mapping):
            found.append(normalize_parameter_dict(param))
        elif isinstance(param, (Parameter, ParameterFile)):
            found.append(param)
        else:
            found.append(ParameterFile(param))
    return tuple(found)


def normalize_remap_rule(remap_rule: Any) -> tuple[Any, Any]:
    ensure_argument_type(remap_rule, tuple, "remap_rule")
    if len(remap_rule) != 2:
        raise TypeError(f"remap_rule must be a tuple of length 2, got length {len(remap_rule)}")
    return (
        tuple(normalize_to_list_of_substitutions(remap_rule[0])),
        tuple(normalize_to_list_of_substitutions(remap_rule[1])),
    )


def normalize_remap_rules(remap_rules: Any) -> Iterable[tuple[Any, Any]]:
    return map(normalize_remap_rule, remap_rules)


def _serialize_parameters(t: Any, parameters: Any) -> None:
    for param in parameters or ():
        if isinstance(param, ParameterFile):
            allow = param.allow_substs
            t.child("param", **{"from": param.param_file, "allow_substs": allow if allow else None})
        elif isinstance(param, Parameter):
            with t.inside("param_dict"):
                t.parameter(param.name, param.preflight_value)
        else:
            with t.inside("param_dict"):
                for name, value in param.items():
                    t.parameter(list(name), value)


def _serialize_remappings(t: Any, remappings: Any) -> None:
    for source, target in remappings or ():
        t.child("remap", **{"from": list(source), "to": list(target)})


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
        _serialize_parameters(t, self.__parameters)
        _serialize_remappings(t, self.__remappings)
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
        _serialize_parameters(t, self.__parameters)
        _serialize_remappings(t, self.__remappings)


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

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "lifecycle_transition"


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


class PushROSNamespace(Action):
    def __init__(self, namespace: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__namespace = normalize_to_list_of_substitutions(namespace)

    @property
    def namespace(self) -> Any:
        return self.__namespace

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "push_ros_namespace"
        t.attribute("namespace", self.__namespace)


class ROSTimer(TimerAction):
    def __init__(self, *, period: Any, actions: Any, **kwargs: Any) -> None:
        super().__init__(period=period, actions=actions, **kwargs)


class SetParameter(Action):
    def __init__(self, name: Any, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        names = normalize_to_list_of_substitutions(name)
        self.__params = normalize_parameter_dict({tuple(names): value})

    @property
    def name(self) -> Any:
        return next(iter(self.__params))

    @property
    def value(self) -> Any:
        return next(iter(self.__params.values()))

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "set_parameter"
        for name, value in self.__params.items():
            t.attribute("name", list(name))
            t.parameter(list(name), value)


class SetParametersFromFile(Action):
    def __init__(self, filename: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._input_file = normalize_to_list_of_substitutions(filename)

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "set_parameters_from_file"
        t.attribute("filename", self._input_file)


class SetRemap(Action):
    def __init__(self, src: Any, dst: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__src = normalize_to_list_of_substitutions(src)
        self.__dst = normalize_to_list_of_substitutions(dst)

    @property
    def src(self) -> Any:
        return self.__src

    @property
    def dst(self) -> Any:
        return self.__dst

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "set_remap"
        t.attribute("from", self.__src)
        t.attribute("to", self.__dst)


class SetUseSimTime(Action):
    def __init__(self, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__value = value

    @property
    def value(self) -> Any:
        return self.__value

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "set_use_sim_time"
        t.attribute("value", self.__value if isinstance(self.__value, bool) else t.parts(self.__value))


class SetROSLogDir(Action):
    def __init__(self, new_log_dir: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__log_dir = normalize_to_list_of_substitutions(new_log_dir)

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "set_ros_log_dir"
        t.attribute("new_log_dir", self.__log_dir)


class RosTimer(ROSTimer):
    pass


def prefix_namespace(base_ns: Optional[str], ns: Optional[str]) -> Optional[str]:
    combined = base_ns
    if ns is not None:
        combined = ns if not base_ns or ns.startswith("/") else (("" if base_ns == "/" else base_ns) + "/" + ns)
    return combined.rstrip("/") if combined is not None and combined != "/" else combined


def make_namespace_absolute(ns: Optional[str]) -> Optional[str]:
    return ns if ns is None or ns.startswith("/") else "/" + ns


def is_root_namespace(ns: str) -> bool:
    return ns == "/"


def is_namespace_absolute(ns: str) -> bool:
    return ns.startswith("/")
