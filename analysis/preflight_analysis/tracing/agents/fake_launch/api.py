"""What launch files call of `launch`, `launch_ros` and `ament_index_python`, as plain data: the one declaration of it.

The classes of this package get their `__init__` from here (`base.Declared`). The host reads the same for keywords that
are proposed, explained, refused or found again in the text (`launch/python_api.py`).
"""

from __future__ import annotations

from typing import Mapping, NamedTuple


class Call(NamedTuple):
    """A class, or a function, by its full name."""

    name: str
    takes: str = ""
    """Its parameters, as after `self` in a `def`. `**kwargs` is for the class `of`, less what is in `gives`."""
    of: str = ""
    """The name of the class that it is made from, where that takes something."""
    kind: str = ""
    """What it makes: the kind of an action or of a part of one, the command of a substitution."""
    attributes: Mapping[str, str] = {}
    """The attributes of that kind whose parameter has another name."""
    gives: tuple[str, ...] = ()
    """What it gives to the class `of` itself."""
    doc: str = ""
    """What it is, where neither a tag nor a substitution of the other formats says that."""
    inherits: bool = False
    """Whether it takes what the class `of` does, and nothing else."""

    @property
    def short_name(self) -> str:
        """The name without its module."""
        return self.name.rpartition(".")[2]


def _same(name: str, of: str, kind: str = "", doc: str = "", attributes: Mapping[str, str] = {}) -> Call:
    """A class that takes what another one does."""
    return Call(name, of=of, kind=kind, doc=doc, attributes=attributes, inherits=True)


_NODE = {"pkg": "package", "exec": "executable", "launch-prefix": "prefix"}
_PROCESS = {"launch-prefix": "prefix", "argument": "cmd"}
_LOG = {"message": "msg"}
_OF_EVENT = ("action_matcher", "on_event", "target_event_cls", "target_action_cls")
_ACTIONS = (
    Call("launch.Action", "*, condition=None", doc="What other actions are made from."),
    Call(
        "launch.actions.DeclareLaunchArgument",
        "name, *, default_value=None, description=None, choices=None, **kwargs",
        "Action",
        "arg",
        {"default": "default_value"},
    ),
    Call(
        "launch.actions.IncludeLaunchDescription",
        "launch_description_source, *, launch_arguments=None, **kwargs",
        "Action",
        "include",
        {"file": "launch_description_source"},
    ),
    Call(
        "launch.actions.GroupAction",
        "actions, *, scoped=True, forwarding=True, launch_configurations=None, **left_over_kwargs",
        "Action",
        "group",
    ),
    Call("launch.actions.SetLaunchConfiguration", "name, value, **kwargs", "Action", "let"),
    Call(
        "launch.actions.UnsetLaunchConfiguration",
        "name, **kwargs",
        "Action",
        "unlet",
        doc="Removes a launch configuration.",
    ),
    Call("launch.actions.ResetLaunchConfigurations", "launch_configurations=None, **kwargs", "Action", "reset"),
    Call(
        "launch.actions.PushLaunchConfigurations",
        "**kwargs",
        "Action",
        "push_configurations",
        doc="Keeps the launch configurations, to come back to them.",
    ),
    Call(
        "launch.actions.PopLaunchConfigurations",
        "**kwargs",
        "Action",
        "pop_configurations",
        doc="Goes back to the launch configurations of the last push.",
    ),
    Call("launch.actions.SetEnvironmentVariable", "name, value, **kwargs", "Action", "set_env"),
    Call("launch.actions.UnsetEnvironmentVariable", "name, **kwargs", "Action", "unset_env"),
    Call(
        "launch.actions.AppendEnvironmentVariable",
        "name, value, prepend=False, separator=':', **kwargs",
        "Action",
        "append_env",
    ),
    Call("launch.actions.ResetEnvironment", "**kwargs", "Action", "reset_env"),
    Call(
        "launch.actions.PushEnvironment",
        "**kwargs",
        "Action",
        "push_env",
        doc="Keeps the environment, to come back to it.",
    ),
    Call(
        "launch.actions.PopEnvironment",
        "**kwargs",
        "Action",
        "pop_env",
        doc="Goes back to the environment of the last push.",
    ),
    Call("launch.actions.Log", "*, msg, level, **kwargs", "Action", "log", _LOG),
    Call("launch.actions.LogInfo", "*, msg, **kwargs", "Log", "log", _LOG, doc="Prints a message."),
    _same("launch.actions.LogDebug", "LogInfo", "log", "Prints a message for debugging.", _LOG),
    _same("launch.actions.LogWarning", "LogInfo", "log", "Prints a warning.", _LOG),
    _same("launch.actions.LogError", "LogInfo", "log", "Prints an error.", _LOG),
    Call("launch.actions.TimerAction", "*, period, actions, cancel_on_shutdown=True, **kwargs", "Action", "timer"),
    Call("launch.actions.EmitEvent", "*, event, **kwargs", "Action", "emit_event", doc="Makes an event happen."),
    Call(
        "launch.actions.Shutdown",
        "*, reason='reason not given', **kwargs",
        "EmitEvent",
        "shutdown",
        gives=("event",),
    ),
    Call(
        "launch.actions.RegisterEventHandler",
        "event_handler, **kwargs",
        "Action",
        "event_handler",
        doc="Has an event handler wait for its event.",
    ),
    Call(
        "launch.actions.UnregisterEventHandler",
        "event_handler, **kwargs",
        "Action",
        "unregister_event_handler",
        doc="Ends the wait of an event handler.",
    ),
    Call(
        "launch.actions.OpaqueFunction",
        "*, function, args=None, kwargs=None, **left_over_kwargs",
        "Action",
        "opaque",
        doc="Calls a function with the context of the launch; the actions that it returns are executed.",
    ),
    Call(
        "launch.actions.OpaqueCoroutine",
        "*, coroutine, args=None, kwargs=None, ignore_context=False, **left_over_kwargs",
        "Action",
        "opaque_coroutine",
        doc="Runs a coroutine beside the launch.",
    ),
    Call(
        "launch.actions.ForLoop",
        "length, *, function, name=None, **kwargs",
        "Action",
        "opaque",
        doc="Calls a function with 0, 1, ... up to a length. Of a launch newer than 3.7.",
    ),
    Call(
        "launch.actions.ForEach",
        "input_values, *, function, **kwargs",
        "Action",
        "opaque",
        doc="Calls a function with each set of values. Of a launch newer than 3.7.",
    ),
    Call(
        "launch.actions.ExecuteProcess",
        "*, cmd, prefix=None, name=None, cwd=None, env=None, additional_env=None, **kwargs",
        "ExecuteLocal",
        "executable",
        _PROCESS,
        ("process_description",),
    ),
    Call(
        "launch.actions.ExecuteLocal",
        "*, process_description, shell=False, sigterm_timeout='5', sigkill_timeout='5', emulate_tty=False, "
        "output='log', output_format='[{this.process_description.final_name}] {line}', cached_output=False, "
        "log_cmd=False, on_exit=None, respawn=False, respawn_delay=None, respawn_max_retries=-1, **kwargs",
        "Action",
        "executable",
        doc="Starts the process of an `Executable`.",
    ),
    Call(
        "launch_ros.actions.Node",
        "*, executable, package=None, name=None, namespace=None, exec_name=None, parameters=None, remappings=None, "
        "ros_arguments=None, arguments=None, **kwargs",
        "ExecuteProcess",
        "node",
        _NODE,
        ("cmd",),
    ),
    Call(
        "launch_ros.actions.LifecycleNode",
        "*, name, namespace, autostart=None, **kwargs",
        "Node",
        "lifecycle_node",
        _NODE,
        doc="Starts a lifecycle node.",
    ),
    Call(
        "launch_ros.actions.ComposableNodeContainer",
        "*, name, namespace, composable_node_descriptions=None, **kwargs",
        "Node",
        "node_container",
        _NODE,
    ),
    Call(
        "launch_ros.actions.LoadComposableNodes",
        "*, composable_node_descriptions, target_container, **kwargs",
        "Action",
        "load_composable_node",
        {"target": "target_container"},
    ),
    Call(
        "launch_ros.actions.LifecycleTransition",
        "*, lifecycle_node_names, transition_ids, **kwargs",
        "Action",
        "lifecycle_transition",
        doc="Takes lifecycle nodes through transitions.",
    ),
    Call("launch_ros.actions.PushROSNamespace", "namespace, **kwargs", "Action", "push_ros_namespace"),
    _same("launch_ros.actions.PushRosNamespace", "PushROSNamespace", "push_ros_namespace"),
    Call("launch_ros.actions.ROSTimer", "*, period, actions, **kwargs", "TimerAction", "timer"),
    _same("launch_ros.actions.RosTimer", "ROSTimer", "timer"),
    Call("launch_ros.actions.SetParameter", "name, value, **kwargs", "Action", "set_parameter"),
    Call("launch_ros.actions.SetParametersFromFile", "filename, **kwargs", "Action", "set_parameters_from_file"),
    Call("launch_ros.actions.SetRemap", "src, dst, **kwargs", "Action", "set_remap", {"from": "src", "to": "dst"}),
    Call("launch_ros.actions.SetUseSimTime", "value, **kwargs", "Action", "set_use_sim_time"),
    Call("launch_ros.actions.SetROSLogDir", "new_log_dir, **kwargs", "Action", "set_ros_log_dir"),
)
_PARTS = (
    Call(
        "launch.LaunchDescription",
        "initial_entities=None, *, deprecated_reason=None",
        kind="inline",
        doc="The actions of a launch file.",
    ),
    Call(
        "launch_ros.descriptions.ComposableNode",
        "*, package, plugin, name=None, namespace=None, parameters=None, remappings=None, extra_arguments=None, "
        "condition=None",
        kind="composable_node",
        attributes={"pkg": "package"},
    ),
    Call(
        "launch_ros.descriptions.ComposableLifecycleNode",
        "*, autostart=False, **kwargs",
        "ComposableNode",
        "composable_node",
        {"pkg": "package"},
    ),
    Call(
        "launch.descriptions.Executable",
        "*, cmd, prefix=None, name=None, cwd=None, env=None, additional_env=None, arguments=None",
        doc="What a process is made of.",
    ),
    Call(
        "launch_ros.descriptions.ParameterFile",
        "param_file, *, allow_substs=False",
        doc="A file of parameters, in which substitutions may be performed.",
    ),
    Call(
        "launch_ros.descriptions.ParameterValue",
        "value, *, value_type=None",
        doc="The value of a parameter, of the type that is said.",
    ),
    Call("launch_ros.descriptions.Parameter", "name, value, *, value_type=None", doc="A parameter and its value."),
    Call("launch.Condition", "*, predicate=None", doc="Whether an action is executed, as a function tells."),
    Call(
        "launch.conditions.IfCondition",
        "predicate_expression",
        doc="Has an action executed only if it is true (or 1).",
    ),
    _same("launch.conditions.UnlessCondition", "IfCondition", doc="Has an action executed only if it is false (or 0)."),
    Call(
        "launch.conditions.LaunchConfigurationEquals",
        "launch_configuration_name, expected_value",
        doc="Has an action executed only if a launch configuration has that value.",
    ),
    _same(
        "launch.conditions.LaunchConfigurationNotEquals",
        "LaunchConfigurationEquals",
        doc="Has an action executed only if a launch configuration has another value.",
    ),
    Call(
        "launch.LaunchDescriptionSource",
        "launch_description=None, location='<string>', method='unspecified mechanism from a script'",
        doc="A launch description that the file itself makes.",
    ),
    Call(
        "launch.launch_description_sources.AnyLaunchDescriptionSource",
        "launch_file_path",
        doc="A launch file of any format.",
    ),
    Call(
        "launch.launch_description_sources.FrontendLaunchDescriptionSource",
        "launch_file_path, *, method='interpreted frontend launch file', parser=None",
        doc="A launch file in XML or YAML.",
    ),
    Call(
        "launch.launch_description_sources.PythonLaunchDescriptionSource",
        "launch_file_path",
        doc="A launch file in Python.",
    ),
    Call(
        "launch_xml.launch_description_sources.XMLLaunchDescriptionSource",
        "launch_file_path",
        doc="A launch file in XML.",
    ),
    Call(
        "launch_yaml.launch_description_sources.YAMLLaunchDescriptionSource",
        "launch_file_path",
        doc="A launch file in YAML.",
    ),
)
_HANDLERS = (
    Call(
        "launch.event_handler.BaseEventHandler",
        "*, matcher=None, handle_once=False",
        doc="What other event handlers are made from.",
    ),
    Call(
        "launch.EventHandler",
        "*, matcher, entities=None, handle_once=False",
        doc="Executes actions upon the events that match.",
    ),
    Call(
        "launch.event_handlers.OnActionEventBase",
        "*, action_matcher=None, on_event=None, target_event_cls=None, target_action_cls=None, **kwargs",
        "BaseEventHandler",
        gives=("matcher",),
        doc="Executes actions upon the events of an action.",
    ),
    Call(
        "launch.event_handlers.OnExecutionComplete",
        "*, target_action=None, on_completion, **kwargs",
        "OnActionEventBase",
        gives=_OF_EVENT,
        doc="Executes actions once another one is done.",
    ),
    Call(
        "launch.event_handlers.OnProcessExit",
        "*, target_action=None, on_exit, **kwargs",
        "OnActionEventBase",
        gives=_OF_EVENT,
        doc="Executes actions when a process ends.",
    ),
    Call(
        "launch.event_handlers.OnProcessStart",
        "*, target_action=None, on_start, **kwargs",
        "OnActionEventBase",
        gives=_OF_EVENT,
        doc="Executes actions when a process starts.",
    ),
    Call(
        "launch.event_handlers.OnProcessIO",
        "*, target_action=None, on_stdin=None, on_stdout=None, on_stderr=None, **kwargs",
        "OnActionEventBase",
        gives=_OF_EVENT,
        doc="Calls functions with what a process writes or reads.",
    ),
    Call(
        "launch.event_handlers.OnIncludeLaunchDescription",
        "**kwargs",
        "EventHandler",
        doc="Executes actions when a launch file is included.",
    ),
    Call(
        "launch.event_handlers.OnShutdown",
        "*, on_shutdown, **kwargs",
        "BaseEventHandler",
        gives=("matcher",),
        doc="Executes actions when the launch ends.",
    ),
    Call(
        "launch_ros.event_handlers.OnStateTransition",
        "*, entities, target_lifecycle_node=None, transition=None, start_state=None, goal_state=None, matcher=None, "
        "**kwargs",
        "EventHandler",
        doc="Executes actions when a lifecycle node comes into a state.",
    ),
)
_SUBSTITUTIONS = (
    Call("launch.substitutions.TextSubstitution", "*, text", doc="A text as it is."),
    Call("launch.substitutions.LaunchConfiguration", "variable_name, *, default=None", kind="var"),
    Call("launch.substitutions.EnvironmentVariable", "name, *, default_value=None", kind="env"),
    Call("launch.substitutions.PathJoinSubstitution", "substitutions", kind="path-join"),
    Call(
        "launch.substitutions.PathSubstitution",
        "path",
        kind="path-join",
        doc="A path, to which `/` adds parts. Of a launch newer than 3.7.",
    ),
    Call("launch.substitutions.Command", "command, *, on_stderr='fail'", kind="command"),
    Call("launch.substitutions.PythonExpression", "expression, python_modules=('math',)", kind="eval"),
    Call("launch.substitutions.ThisLaunchFileDir", kind="dirname"),
    Call("launch.substitutions.ThisLaunchFile", kind="filename"),
    Call("launch.substitutions.LaunchLogDir", kind="launch_log_dir"),
    Call("launch.substitutions.AnonName", "name", kind="anon"),
    Call("launch.substitutions.FindExecutable", "*, name", kind="find-exec"),
    Call("launch.substitutions.FileContent", "path", kind="file-content"),
    Call(
        "launch.substitutions.LocalSubstitution",
        "expression, description=None",
        kind="local",
        doc="What an event handler has in `context.locals`.",
    ),
    Call("launch.substitutions.StringJoinSubstitution", "substitutions, delimiter=''", kind="string-join"),
    Call("launch.substitutions.IfElseSubstitution", "condition, if_value='', else_value=''", kind="if"),
    Call("launch.substitutions.NotSubstitution", "value", kind="not"),
    Call("launch.substitutions.AndSubstitution", "left, right", kind="and"),
    Call("launch.substitutions.OrSubstitution", "left, right", kind="or"),
    Call("launch.substitutions.AnySubstitution", "*args", kind="any"),
    Call("launch.substitutions.AllSubstitution", "*args", kind="all"),
    Call("launch.substitutions.EqualsSubstitution", "left, right", kind="equals"),
    Call("launch.substitutions.NotEqualsSubstitution", "left, right", kind="not-equals"),
    Call("launch.substitutions.ForEachVar", "name, *, default_value=None", kind="for-var"),
    Call("launch.substitutions.ForLoopIndex", "name, **kwargs", kind="index"),
    Call("launch_ros.substitutions.FindPackage", "package", kind="find-pkg", doc="A folder of a package."),
    Call("launch_ros.substitutions.FindPackageShare", "package", kind="find-pkg-share"),
    Call("launch_ros.substitutions.FindPackagePrefix", "package", kind="find-pkg-prefix"),
    Call("launch_ros.substitutions.ExecutableInPackage", "executable, package", kind="exec-in-pkg"),
    Call("launch_ros.substitutions.Parameter", "name, *, default=None", kind="param"),
)
_FUNCTIONS = (
    Call(
        "ament_index_python.packages.get_package_share_directory",
        "package_name, print_warning=True",
        kind="find-pkg-share",
    ),
    Call(
        "ament_index_python.packages.get_package_share_path",
        "package_name, print_warning=True",
        kind="find-pkg-share",
    ),
    Call("ament_index_python.packages.get_package_prefix", "package_name", kind="find-pkg-prefix"),
)
CALLS = (*_ACTIONS, *_PARTS, *_HANDLERS, *_SUBSTITUTIONS, *_FUNCTIONS)
BY_SHORT_NAME = {each.short_name: each for each in reversed(CALLS)}
"""`Parameter` is that of `launch_ros.descriptions`."""
CHILDREN = {
    "arg": "launch_arguments",
    "arg_passed": "launch_arguments",
    "argument": "arguments",
    "choice": "choices",
    "env": "additional_env",
    "extra_dict": "extra_arguments",
    "keep": "launch_configurations",
    "param": "parameters",
    "param_dict": "parameters",
    "remap": "remappings",
    "target": "target_container",
}
"""The parameters that give the children of a kind which are no objects of their own."""
PARAMETERS = {
    "action_matcher": "The action whose events count, or a function that tells.",
    "actions": "The actions.",
    "additional_env": "Environment variables of the process, beside those that it has anyway.",
    "allow_substs": "Whether the launch performs the substitutions in the file.",
    "args": "What the function gets behind the context, in order.",
    "arguments": "Command-line arguments for the node, one an item.",
    "autostart": "Configure and activate the node once it is there.",
    "cached_output": "Keep all that the process prints, for event handlers.",
    "choices": "The values that the argument may have.",
    "cmd": "The command line, one word an item.",
    "command": "The command line.",
    "composable_node_descriptions": "The `ComposableNode`s to load.",
    "Action.condition": "Executed only if the condition is true: `IfCondition(...)`, `UnlessCondition(...)`.",
    "ComposableNode.condition": "Loaded only if the condition is true: `IfCondition(...)`, `UnlessCondition(...)`.",
    "condition": "The condition.",
    "coroutine": "The coroutine function.",
    "cwd": "The working directory of the process.",
    "default": "The text where there is none.",
    "default_value": "The text where there is none.",
    "delimiter": "The text between.",
    "deprecated_reason": "Why the launch file should not be used any more, for a warning.",
    "description": "What it is for.",
    "else_value": "The text where the condition is false.",
    "entities": "The actions that are executed.",
    "env": "All environment variables of the process; those of the launch do not count then.",
    "event": "The event, such as `Shutdown(...)` of `launch.events`.",
    "event_handler": "The handler, such as `OnProcessExit(...)`.",
    "executable": "The executable.",
    "expected_value": "The value to compare with.",
    "expression": "The expression.",
    "extra_arguments": "What the container is told of this node, such as `{'use_intra_process_comms': True}`.",
    "function": "The function.",
    "goal_state": "The state that the node comes into.",
    "handle_once": "Whether the first event that matches is the last one that counts.",
    "if_value": "The text where the condition is true.",
    "ignore_context": "Whether the coroutine is called without the context.",
    "initial_entities": "The actions.",
    "input_values": "The sets of values, as a text: `{name: 'a'};{name: 'b'}`.",
    "kwargs": "What the function gets by keyword.",
    "launch_arguments": "The arguments to pass: pairs of a name and a value, such as `{...}.items()`.",
    "launch_configuration_name": "The name of the launch configuration.",
    "launch_configurations": "Launch configurations that are set, also where nothing is forwarded.",
    "launch_description": "The launch description.",
    "launch_file_path": "The path of the launch file.",
    "left": "The first of both.",
    "length": "How often the function is called.",
    "lifecycle_node_names": "The names of the lifecycle nodes.",
    "location": "What is said of where it comes from.",
    "log_cmd": "Print the command line when the process starts.",
    "matcher": "The function that tells which events count.",
    "method": "What is said of how it was made.",
    "ForLoop.name": "What the loop is called.",
    "name": "The name.",
    "on_completion": "The actions that are executed then, or a function that returns them.",
    "on_event": "The actions that are executed then, or a function that returns them.",
    "ExecuteLocal.on_exit": "The actions that are executed when the process ends, or a function that returns them.",
    "on_exit": "The actions that are executed then, or a function that returns them.",
    "on_shutdown": "The actions that are executed then, or a function that returns them.",
    "on_start": "The actions that are executed then, or a function that returns them.",
    "OnProcessIO.on_stderr": "The function that gets what the process writes on its error channel.",
    "on_stderr": "What an output on the error channel does: `fail`, `ignore`, `warn` or `capture`.",
    "on_stdin": "The function that gets what the process reads.",
    "on_stdout": "The function that gets what the process writes.",
    "ExecuteLocal.output": "Where the output goes: `screen`, `log`, `both`, `own_log` or `full`, for each channel too.",
    "output_format": "How a line of the output is shown on the screen.",
    "package": "The package.",
    "package_name": "The package.",
    "param_file": "The path of the file.",
    "parameters": "The parameters: a list of dictionaries and of paths of YAML files.",
    "parser": "The parser of the file, where not its name tells which.",
    "path": "The path.",
    "predicate": "A function from the context to true or false.",
    "predicate_expression": "The condition: true, false, 1 or 0.",
    "prefix": "A command to put before the process's own, such as `gdb -ex run --args`.",
    "print_warning": "Whether a share folder that does not exist is warned of.",
    "process_description": "The `Executable`.",
    "python_modules": "Modules that the expression uses.",
    "remappings": "The remaps: a list of pairs of a name and what it becomes.",
    "right": "The second of both.",
    "ros_arguments": "Arguments that follow `--ros-args`, one an item.",
    "start_state": "The state that the node leaves.",
    "substitutions": "The parts.",
    "target_action": "The action whose events count; without it all.",
    "target_action_cls": "The class of the actions whose events count.",
    "LoadComposableNodes.target_container": "The container: its full name, or the action that starts it.",
    "target_event_cls": "The class of the events.",
    "target_lifecycle_node": "The lifecycle node whose states count; without it all.",
    "text": "The text.",
    "transition": "The transition that the node goes through.",
    "transition_ids": "The numbers of the transitions, of `lifecycle_msgs.msg.Transition`.",
    "value": "The value.",
    "value_type": "The type of the value, such as `str`.",
    "variable_name": "The name of the launch configuration.",
}
"""What parameters are, where no attribute of the other formats says that: by their names, or `Class.name`."""
