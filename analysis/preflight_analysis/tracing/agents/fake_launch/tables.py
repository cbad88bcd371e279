"""Which names the launch file finds in which module of `launch`, `launch_ros` and the like."""

from __future__ import annotations

import os
import xml.etree.ElementTree
from typing import Any

from . import (
    actions,
    ament,
    base,
    boolean_substitutions,
    conditions,
    controller_manager,
    events,
    includes,
    launch_pal,
    library,
    moveit_configs,
    nav2_common,
    processes,
    ros_gz,
    ros_namespaces,
    ros_nodes,
    ros_parameters,
    ros_settings,
    ros_substitutions,
    settings,
    substitutions,
    typed,
    worded,
)
from .api import BY_SHORT_NAME, CALLS, Call
from .base import RECORDER


def _public(*modules: Any) -> dict[str, Any]:
    """The classes that modules define."""
    return {
        name: value
        for module in modules
        for name, value in vars(module).items()
        if isinstance(value, type) and value.__module__ == module.__name__ and not name.startswith("_")
    }


def _named(module: Any, *names: str) -> dict[str, Any]:
    return {name: getattr(module, name) for name in names}


_WITH_CALLS = (
    *(actions, base, boolean_substitutions, conditions, events, includes, processes, ros_nodes, ros_parameters),
    *(ros_settings, ros_substitutions, settings, substitutions),
)
_CLASSES = {
    (name, made.preflight_call.kind): made
    for module in _WITH_CALLS
    for name, made in _public(module).items()
    if issubclass(made, base.Made)
}


def _declared(module: str) -> dict[str, Any]:
    """The classes that `api` declares of a module of launch. Those are made here that but keep what they are given."""
    return {call.short_name: _class(call) for call in CALLS if call.name == f"{module}.{call.short_name}"}


def _class(call: Call) -> Any:
    key = call.short_name, call.kind
    if key not in _CLASSES:
        _CLASSES[key] = type(call.short_name, (_class(BY_SHORT_NAME[call.of]),), {"__module__": __name__})
    return _CLASSES[key]


_SOURCES = {**_declared("launch.launch_description_sources"), **_named(includes, "LaunchDescriptionSource")}
_HANDLERS = _declared("launch.event_handlers")
_PROCESS = {k: v for k, v in _public(events).items() if "Process" in k and k not in _HANDLERS}
_MATCH = dict.fromkeys(("matches_pid", "matches_name", "matches_executable"), events.matches_anything)
_ENTITY = (base.LaunchDescriptionEntity, base.LaunchDescription)
_CORE = _named(
    base,
    "Action",
    "Condition",
    "Event",
    "LaunchContext",
    "LaunchDescription",
    "LaunchDescriptionEntity",
    "Substitution",
    "SomeSubstitutionsType_types_tuple",
)
_UTILITIES = _named(
    base,
    "ensure_argument_type",
    "is_a",
    "is_a_subclass",
    "isclassinstance",
    "normalize_to_list_of_entities",
    "normalize_to_list_of_substitutions",
    "perform_substitutions",
)
_UTILITIES.update(_named(library, "AsyncSafeSignalManager", "visit_all_entities_and_collect_futures"))
_UTILITIES["create_future"] = library.not_here("create_future")
_TYPES = {"SomeSubstitutionsType": Any, "SomeEntitiesType": Any, "SomeEntitiesType_types_tuple": _ENTITY}
_FRONTEND = {
    "Entity": library.Entity,
    "Parser": library.Parser,
    "InvalidFrontendLaunchFileError": library.InvalidFrontendLaunchFileError,
    "expose_action": library.expose,
    "expose_substitution": library.expose,
}
_LOG = {
    **_named(library, "LaunchConfig", "LaunchLogger", "get_logger", "get_output_loggers", "log_launch_config", "reset"),
    "launch_config": library.LaunchConfig(),
}
_FILES = _named(
    library,
    "InvalidFrontendLaunchFileError",
    "InvalidLaunchFileError",
    "InvalidPythonLaunchFileError",
    "get_launch_description_from_any_launch_file",
    "get_launch_description_from_frontend_launch_file",
    "get_launch_description_from_python_launch_file",
    "load_python_launch_file_as_module",
)
_PACKAGES = _named(
    ament,
    "PackageNotFoundError",
    "get_package_prefix",
    "get_package_share_directory",
    "get_package_share_path",
    "get_packages_with_prefixes",
)
_RESOURCES = _named(ament, "get_resource", "get_resources", "has_resource")
_ROS_EVENTS = _named(events, "ChangeState", "StateTransition")
_MATCHES_NODE = {"matches_node_name": events.matches_node_name}
_PARAMETER_TYPES = dict.fromkeys(
    (
        *("EvaluatedParameterValue", "EvaluatedParameters", "ParameterName", "ParameterValue", "Parameters"),
        *("ParametersDict", "SomeParameterFile", "SomeParameterName", "SomeParameterValue", "SomeParameters"),
        "SomeParametersDict",
    ),
    Any,
)
_VALUE_TYPES = dict.fromkeys(
    (
        *("AllowedTypesType", "AllowedValueType", "ListTypesType", "ListValueType", "NormalizedScalarType"),
        *("NormalizedSequenceType", "NormalizedValueType", "ScalarTypesType", "ScalarValueType", "SequenceValueType"),
        *("SomeScalarType", "SomeSequenceType", "SomeValueType", "StrSomeScalarType", "StrSomeSequenceType"),
        "StrSomeValueType",
    ),
    Any,
)
_NAMESPACES = _named(
    ros_namespaces, "prefix_namespace", "make_namespace_absolute", "is_root_namespace", "is_namespace_absolute"
)
_REMAPS = _named(ros_parameters, "normalize_remap_rule", "normalize_remap_rules")
_NODE_NAMES = _named(library, "add_node_name", "get_node_name_count")
_ROS_UTILITIES = {
    **_NAMESPACES,
    **_REMAPS,
    **_NODE_NAMES,
    **_named(ros_parameters, "normalize_parameter_dict", "normalize_parameters"),
    **_named(library, "LifecycleEventManager", "evaluate_parameters", "to_parameters_list"),
}
_SOME_ACTIONS = {"SomeActionsType": Any, "SomeActionsType_types_tuple": _ENTITY}
_INTROSPECTION = _named(
    library,
    "LaunchIntrospector",
    "format_action",
    "format_entities",
    "format_event_handler",
    "format_substitutions",
    "indent",
    "tree_like_indent",
)
TABLE: dict[str, dict[str, Any]] = {
    "launch": {
        **_CORE,
        **_TYPES,
        **_SOME_ACTIONS,
        "EventHandler": events.EventHandler,
        "InvalidLaunchFileError": library.InvalidLaunchFileError,
        "LaunchDescriptionSource": includes.LaunchDescriptionSource,
        "LaunchService": library.LaunchService,
        "LaunchIntrospector": library.LaunchIntrospector,
    },
    "launch.action": {"Action": base.Action},
    "launch.actions": _declared("launch.actions"),
    "launch.condition": {"Condition": base.Condition},
    "launch.conditions": {
        **_public(conditions),
        **_named(conditions, "evaluate_condition_expression", "VALID_TRUE_EXPRESSIONS", "VALID_FALSE_EXPRESSIONS"),
    },
    "launch.descriptions": {"Executable": processes.Executable},
    "launch.event": {"Event": base.Event},
    "launch.event_handler": _named(events, "BaseEventHandler", "EventHandler"),
    "launch.event_handlers": {**_HANDLERS, "event_named": library.event_named},
    "launch.event_handlers.on_shutdown": {"OnShutdown": events.OnShutdown, "gen_handler": library.gen_handler},
    "launch.events": {
        **_named(events, "ExecutionComplete", "TimerEvent"),
        "IncludeLaunchDescription": events.IncludeLaunchDescriptionEvent,
        "Shutdown": events.ShutdownEvent,
        "matches_action": events.matches_action,
    },
    "launch.events.matchers": {"matches_action": events.matches_action},
    "launch.events.process": {**_PROCESS, **_MATCH},
    "launch.frontend": _FRONTEND,
    "launch.frontend.entity": {"Entity": library.Entity, "TargetType": Any},
    "launch.frontend.expose": {
        "action_parse_methods": {},
        "expose_action": library.expose,
        "expose_substitution": library.expose,
        **_named(library, "instantiate_action", "instantiate_substitution"),
        "substitution_parse_methods": {},
    },
    "launch.frontend.parse_substitution": {
        **_named(library, "ExtractSubstitution", "parse_substitution", "parse_if_substitutions"),
        "get_grammar_path": library.not_here("get_grammar_path"),
        "replace_escaped_characters": library.replace_escaped_characters,
    },
    "launch.frontend.type_utils": _named(library, "check_is_list_entity", "get_data_type_from_identifier"),
    "launch.invalid_launch_file_error": {"InvalidLaunchFileError": library.InvalidLaunchFileError},
    "launch.launch_context": {"LaunchContext": base.LaunchContext},
    "launch.launch_description": {"LaunchDescription": base.LaunchDescription},
    "launch.launch_description_entity": {"LaunchDescriptionEntity": base.LaunchDescriptionEntity},
    "launch.launch_description_source": {"LaunchDescriptionSource": includes.LaunchDescriptionSource},
    "launch.launch_description_sources": {**_SOURCES, **_FILES},
    "launch.launch_introspector": _INTROSPECTION,
    "launch.launch_service": {"LaunchService": library.LaunchService},
    "launch.logging": _LOG,
    "launch.logging.handlers": {"with_per_logger_formatting": library.with_per_logger_formatting},
    "launch.some_actions_type": _SOME_ACTIONS,
    "launch.some_entities_type": _TYPES,
    "launch.some_substitutions_type": {
        **_TYPES,
        "SomeSubstitutionsType_types_tuple": base.SomeSubstitutionsType_types_tuple,
    },
    "launch.substitution": {"Substitution": base.Substitution},
    "launch.substitutions": {**_declared("launch.substitutions"), **_named(worded, "SubstitutionFailure")},
    "launch.utilities": _UTILITIES,
    "launch.utilities.type_utils": {**{k: v for k, v in vars(typed).items() if not k.startswith("_")}, **_VALUE_TYPES},
    "launch.utilities.typing_file_path": {"FilePath": Any},
    "launch_ros": {},
    "launch_ros.actions": _declared("launch_ros.actions"),
    "launch_ros.actions.lifecycle_transition": {
        "LifecycleTransition": ros_nodes.LifecycleTransition,
        **_named(library, "match_node_name_goal", "match_node_name_start_goal"),
    },
    "launch_ros.actions.load_composable_nodes": {
        "LoadComposableNodes": ros_nodes.LoadComposableNodes,
        "get_composable_node_load_request": library.not_here("get_composable_node_load_request"),
    },
    "launch_ros.actions.node": {
        "Node": ros_nodes.Node,
        **_named(library, "NodeActionExtension", "get_extensions", "instantiate_extension"),
        "g_entry_points_impl": None,
    },
    "launch_ros.descriptions": _declared("launch_ros.descriptions"),
    "launch_ros.event_handlers": {"OnStateTransition": events.OnStateTransition},
    "launch_ros.events": _MATCHES_NODE,
    "launch_ros.events.lifecycle": {**_ROS_EVENTS, **_MATCHES_NODE},
    "launch_ros.events.matchers": _MATCHES_NODE,
    "launch_ros.parameter_descriptions": _named(ros_parameters, "Parameter", "ParameterFile", "ParameterValue"),
    "launch_ros.parameters_type": {
        **_PARAMETER_TYPES,
        "ParameterFile": ros_parameters.ParameterFile,
        "SomeParameterValue_types_tuple": (*base.SomeSubstitutionsType_types_tuple, *typed.AllowedTypesTuple),
    },
    "launch_ros.remap_rule_type": dict.fromkeys(("RemapRules", "SomeRemapRules", "RemapRule", "SomeRemapRule"), Any),
    "launch_ros.substitutions": _declared("launch_ros.substitutions"),
    "launch_ros.ros_adapters": _named(library, "ROSAdapter", "get_ros_adapter", "get_ros_node"),
    "launch_ros.utilities": _ROS_UTILITIES,
    "launch_ros.utilities.evaluate_parameters": _named(library, "evaluate_parameter_dict", "evaluate_parameters"),
    "launch_ros.utilities.namespace_utils": {**_NAMESPACES, "OptionalText": Any},
    "launch_ros.utilities.parse_composable_node": {"parse_composable_node": library.not_here("parse_composable_node")},
    "launch_ros.utilities.plugin_support": _named(
        library, "PluginException", "get_upper_bound_caret_version", "satisfies_version"
    ),
    **{f"launch_testing{name}": {} for name in ("", ".actions", ".asserts", ".legacy", ".markers", ".tools", ".util")},
    "launch_xml": {"Entity": library.XMLEntity, "Parser": library.XMLParser},
    "launch_xml.launch_description_sources": {"XMLLaunchDescriptionSource": includes.XMLLaunchDescriptionSource},
    "launch_yaml": {"Entity": library.YAMLEntity, "Parser": library.YAMLParser},
    "launch_yaml.launch_description_sources": {"YAMLLaunchDescriptionSource": includes.YAMLLaunchDescriptionSource},
    "ament_index_python": {**_PACKAGES, **_RESOURCES, "get_search_paths": ament.get_search_paths},
    "ament_index_python.packages": _PACKAGES,
    "ament_index_python.resources": _RESOURCES,
    "ament_index_python.search_paths": {"get_search_paths": ament.get_search_paths},
}
_FOLDERS = {
    "launch": "actions conditions descriptions event_handlers events events.process frontend "
    "launch_description_sources logging substitutions utilities",
    "launch_ros": "actions descriptions event_handlers events events.lifecycle substitutions utilities",
    "launch_xml": "launch_description_sources",
    "launch_yaml": "launch_description_sources",
    "ament_index_python": "",
}
FOLDERS = {*_FOLDERS, *(f"{top}.{name}" for top, names in _FOLDERS.items() for name in names.split())}
"""Modules that are folders. They have the names that they say; any other module has what it imports, too."""
SIBLINGS = {
    "launch.actions": ("log", "shutdown_action"),
    "launch.conditions": ("evaluate_condition_expression_impl",),
    "launch.events.process": ("process_matchers",),
    "launch.launch_description_sources": (
        *("any_launch_file_utilities", "frontend_launch_file_utilities", "python_launch_file_utilities"),
    ),
    "launch.substitutions": ("boolean_substitution", "for_loop_var"),
    "launch.utilities": (
        *("class_tools_impl", "create_future_impl", "ensure_argument_type_impl", "normalize_to_list_of_entities_impl"),
        *("normalize_to_list_of_substitutions_impl", "perform_substitutions_impl", "signal_management"),
        "visit_all_entities_and_collect_futures_impl",
    ),
    "launch_ros.events.lifecycle": ("lifecycle_node_matchers",),
    "launch_ros.utilities": ("track_node_names",),
}
"""Modules that have what the one above them has, and are named after nothing in it."""
# lifecycle_msgs/msg/Transition.msg and State.msg: launch files name their constants.
_TRANSITIONS = {
    "TRANSITION_CREATE": 0,
    "TRANSITION_CONFIGURE": 1,
    "TRANSITION_CLEANUP": 2,
    "TRANSITION_ACTIVATE": 3,
    "TRANSITION_DEACTIVATE": 4,
    "TRANSITION_UNCONFIGURED_SHUTDOWN": 5,
    "TRANSITION_INACTIVE_SHUTDOWN": 6,
    "TRANSITION_ACTIVE_SHUTDOWN": 7,
    "TRANSITION_DESTROY": 8,
}
_STATES = {
    "PRIMARY_STATE_UNKNOWN": 0,
    "PRIMARY_STATE_UNCONFIGURED": 1,
    "PRIMARY_STATE_INACTIVE": 2,
    "PRIMARY_STATE_ACTIVE": 3,
    "PRIMARY_STATE_FINALIZED": 4,
}


class _Manifest:
    """What launch files ask of a `package.xml`."""

    def __init__(self, path: str) -> None:
        root = xml.etree.ElementTree.parse(path).getroot()  # noqa: S314 - in the sandbox
        self.name, self.version = root.findtext("name"), root.findtext("version")
        self.exports = [_Export(each) for each in root.findall("export/*")]


class _Export:
    def __init__(self, element: Any) -> None:
        self.tagname, self.attributes, self.content = element.tag, dict(element.attrib), element.text


def _manifest(path: str, **_: Any) -> _Manifest:
    return _Manifest(os.path.join(path, "package.xml") if os.path.isdir(path) else path)


FALLBACK: dict[str, dict[str, Any]] = {
    "lifecycle_msgs": {},
    "lifecycle_msgs.msg": {"Transition": type("Transition", (), _TRANSITIONS), "State": type("State", (), _STATES)},
    "nav2_common": {},
    "nav2_common.launch": {k: v for k, v in _public(nav2_common).items() if not k.startswith("_")},
    "moveit_configs_utils": _named(moveit_configs, "MoveItConfigs", "MoveItConfigsBuilder"),
    "moveit_configs_utils.moveit_configs_builder": _named(moveit_configs, "MoveItConfigs", "MoveItConfigsBuilder"),
    "moveit_configs_utils.launch_utils": _named(moveit_configs, "DeclareBooleanLaunchArg", "add_debuggable_node"),
    "moveit_configs_utils.launches": {
        **moveit_configs.LAUNCHES,
        **_named(moveit_configs, "DeclareBooleanLaunchArg", "add_debuggable_node"),
    },
    "moveit_configs_utils.substitutions": _named(moveit_configs, "Xacro"),
    "launch_param_builder": _named(moveit_configs, "ParameterBuilder", "load_xacro", "load_yaml"),
    "controller_manager": {},
    "controller_manager.launch_utils": controller_manager.CONTROLLERS,
    "launch_pal": {},
    "launch_pal.actions": _named(launch_pal, "CheckPublicSim", "ValidateLaunchArgs"),
    "launch_pal.arg_utils": _named(
        launch_pal, "LaunchArgCreator", "LaunchArgumentsBase", "parse_launch_args_from_yaml", "read_launch_argument"
    ),
    "launch_pal.composition_utils": _named(launch_pal, "generate_component_list"),
    "launch_pal.include_utils": _named(
        launch_pal,
        "get_nested_launch_configurations",
        "include_launch_py_description",
        "include_scoped_launch_py_description",
    ),
    "launch_pal.param_utils": _named(
        launch_pal, "insert_ros_param_prefix", "merge_param_files", "parse_parametric_yaml", "substitute_variables"
    ),
    "launch_pal.robot_arguments": _named(launch_pal, "CommonArgs", "RobotArgs"),
    "ros_gz_bridge": {},
    "ros_gz_bridge.actions": _named(ros_gz, "RosGzBridge"),
    "ros_gz_bridge.actions.ros_gz_bridge": _named(ros_gz, "RosGzBridge"),
    "ros_gz_sim": {},
    "ros_gz_sim.actions": _named(ros_gz, "GzServer", "GzSpawnModel"),
    "ros_gz_sim.actions.gz_spawn_model": _named(ros_gz, "GzSpawnModel"),
    "ros_gz_sim.actions.gzserver": _named(ros_gz, "GzServer"),
    "ros2pkg": {},
    "ros2pkg.api": {
        "get_package_names": lambda: list(RECORDER.packages),
        "get_prefix_path": lambda name: ament.get_package_prefix(name) if name in RECORDER.packages else None,
    },
    "catkin_pkg": {},
    "catkin_pkg.package": {
        "PACKAGE_MANIFEST_FILENAME": "package.xml",
        "InvalidPackage": type("InvalidPackage", (Exception,), {}),
        "parse_package": _manifest,
    },
}
