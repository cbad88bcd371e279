"""What launch files call of `launch`, `launch_ros` and `ament_index_python`, as plain data: the one declaration of it.

The classes of this package get their `__init__` from here (`base.Declared`). The host reads the same for keywords that
are proposed, explained, refused or found again in the text (`launch/python_api.py`).
"""

from __future__ import annotations

from typing import Any, Iterator, Mapping, NamedTuple


class Call(NamedTuple):
    """A class, or a function, by its full name."""

    name: str
    takes: str = ""
    """Its parameters, as after `self` in a `def`. `**kwargs` is for the class `of`, less what is in `gives`."""
    kind: str = ""
    """What it makes: the kind of an action or of a part of one, the command of a substitution."""
    doc: str = ""
    """What it is, where neither a tag nor a substitution of the other formats says that."""
    of: str = ""
    """The name of the class that it is made from, where that takes something."""
    attributes: Mapping[str, str] = {}
    """The attributes of that kind whose parameter has another name."""
    gives: tuple[str, ...] = ()
    """What it gives to the class `of` itself."""
    since: str = ""
    """The first distribution that has it, where Humble has not."""

    @property
    def short_name(self) -> str:
        """The name without its module."""
        return self.name.rpartition(".")[2]

    @property
    def inherits(self) -> bool:
        """Whether it takes what the class `of` does, and nothing else."""
        return bool(self.of) and not self.takes


def _action(name: str, kind: str, takes: str = "", **more: Any) -> Call:
    return Call(name, f"{takes}, **kwargs" if takes else "**kwargs", kind, of="Action", **more)


def _in(module: str, *calls: Call) -> Iterator[Call]:
    return (each._replace(name=f"{module}.{each.name}") for each in calls)


_NODE = {"pkg": "package", "exec": "executable", "launch-prefix": "prefix"}
_PROCESS = {"launch-prefix": "prefix", "argument": "cmd"}
_LOG = {"message": "msg"}
_OF_EVENT = ("action_matcher", "on_event", "target_event_cls", "target_action_cls")
CALLS = (
    *_in(
        "launch",
        Call("Action", "*, condition=None", doc="What other actions are made from."),
        Call(
            "LaunchDescription",
            "initial_entities=None, *, deprecated_reason=None",
            "inline",
            doc="The actions of a launch file.",
        ),
        Call("Condition", "*, predicate=None", doc="Whether an action is executed, as a function tells."),
        Call(
            "LaunchDescriptionSource",
            "launch_description=None, location='<string>', method='unspecified mechanism from a script'",
            doc="A launch description that the file itself makes.",
        ),
        Call(
            "EventHandler",
            "*, matcher, entities=None, handle_once=False",
            doc="Executes actions upon the events that match.",
        ),
    ),
    *_in(
        "launch.actions",
        _action(
            "DeclareLaunchArgument",
            "arg",
            "name, *, default_value=None, description=None, choices=None",
            attributes={"default": "default_value"},
        ),
        _action(
            "IncludeLaunchDescription",
            "include",
            "launch_description_source, *, launch_arguments=None",
            attributes={"file": "launch_description_source"},
        ),
        Call(
            "GroupAction",
            "actions, *, scoped=True, forwarding=True, launch_configurations=None, **left_over_kwargs",
            "group",
            of="Action",
        ),
        _action("SetLaunchConfiguration", "let", "name, value"),
        _action("UnsetLaunchConfiguration", "unlet", "name", doc="Removes a launch configuration."),
        _action("ResetLaunchConfigurations", "reset", "launch_configurations=None"),
        _action(
            "PushLaunchConfigurations",
            "push_configurations",
            doc="Keeps the launch configurations, to come back to them.",
        ),
        _action(
            "PopLaunchConfigurations",
            "pop_configurations",
            doc="Goes back to the launch configurations of the last push.",
        ),
        _action("SetEnvironmentVariable", "set_env", "name, value"),
        _action("UnsetEnvironmentVariable", "unset_env", "name"),
        _action("AppendEnvironmentVariable", "append_env", "name, value, prepend=False, separator=':'"),
        _action("ResetEnvironment", "reset_env"),
        _action("PushEnvironment", "push_env", doc="Keeps the environment, to come back to it."),
        _action("PopEnvironment", "pop_env", doc="Goes back to the environment of the last push."),
        _action("Log", "log", "*, msg, level", attributes=_LOG, since="rolling"),
        Call("LogInfo", "*, msg, **kwargs", "log", doc="Prints a message.", of="Log", attributes=_LOG),
        Call(
            "LogDebug",
            kind="log",
            doc="Prints a message to debug.",
            of="LogInfo",
            attributes=_LOG,
            since="rolling",
        ),
        Call("LogWarning", kind="log", doc="Prints a warning.", of="LogInfo", attributes=_LOG, since="rolling"),
        Call("LogError", kind="log", doc="Prints an error.", of="LogInfo", attributes=_LOG, since="rolling"),
        _action("TimerAction", "timer", "*, period, actions, cancel_on_shutdown=True"),
        _action("EmitEvent", "emit_event", "*, event", doc="Makes an event happen."),
        Call("Shutdown", "*, reason='reason not given', **kwargs", "shutdown", of="EmitEvent", gives=("event",)),
        _action(
            "RegisterEventHandler", "event_handler", "event_handler", doc="Has an event handler wait for its event."
        ),
        _action(
            "UnregisterEventHandler",
            "unregister_event_handler",
            "event_handler",
            doc="Ends the wait of an event handler.",
        ),
        Call(
            "OpaqueFunction",
            "*, function, args=None, kwargs=None, **left_over_kwargs",
            "opaque",
            doc="Calls a function with the context of the launch; the actions that it returns are executed.",
            of="Action",
        ),
        Call(
            "OpaqueCoroutine",
            "*, coroutine, args=None, kwargs=None, ignore_context=False, **left_over_kwargs",
            "opaque_coroutine",
            doc="Runs a coroutine beside the launch.",
            of="Action",
        ),
        _action(
            "ForLoop",
            "opaque",
            "length, *, function, name=None",
            doc="Calls a function with 0, 1, ... up to a length.",
            since="kilted",
        ),
        _action(
            "ForEach",
            "opaque",
            "input_values, *, function",
            doc="Calls a function with each set of values.",
            since="kilted",
        ),
        Call(
            "ExecuteProcess",
            "*, cmd, prefix=None, name=None, cwd=None, env=None, additional_env=None, **kwargs",
            "executable",
            of="ExecuteLocal",
            attributes=_PROCESS,
            gives=("process_description",),
        ),
        _action(
            "ExecuteLocal",
            "executable",
            "*, process_description, shell=False, sigterm_timeout='5', sigkill_timeout='5', emulate_tty=False, "
            "output='log', output_format='[{this.process_description.final_name}] {line}', cached_output=False, "
            "log_cmd=False, on_exit=None, respawn=False, respawn_delay=None, respawn_max_retries=-1",
            doc="Starts the process of an `Executable`.",
        ),
    ),
    *_in(
        "launch_ros.actions",
        Call(
            "Node",
            "*, executable, package=None, name=None, namespace=None, exec_name=None, parameters=None, "
            "remappings=None, ros_arguments=None, arguments=None, **kwargs",
            "node",
            of="ExecuteProcess",
            attributes=_NODE,
            gives=("cmd",),
        ),
        Call(
            "LifecycleNode",
            "*, name, namespace, autostart=None, **kwargs",
            "lifecycle_node",
            doc="Starts a lifecycle node.",
            of="Node",
            attributes=_NODE,
        ),
        Call(
            "ComposableNodeContainer",
            "*, name, namespace, composable_node_descriptions=None, **kwargs",
            "node_container",
            of="Node",
            attributes=_NODE,
        ),
        _action(
            "LoadComposableNodes",
            "load_composable_node",
            "*, composable_node_descriptions, target_container",
            attributes={"target": "target_container"},
        ),
        _action(
            "LifecycleTransition",
            "lifecycle_transition",
            "*, lifecycle_node_names, transition_ids",
            doc="Takes lifecycle nodes through transitions.",
            since="jazzy",
        ),
        _action("PushROSNamespace", "push_ros_namespace", "namespace", since="jazzy"),
        Call("PushRosNamespace", kind="push_ros_namespace", of="PushROSNamespace"),
        Call("ROSTimer", "*, period, actions, **kwargs", "timer", of="TimerAction", since="jazzy"),
        Call("RosTimer", kind="timer", of="ROSTimer"),
        _action("SetParameter", "set_parameter", "name, value"),
        _action("SetParametersFromFile", "set_parameters_from_file", "filename"),
        _action("SetRemap", "set_remap", "src, dst", attributes={"from": "src", "to": "dst"}),
        _action("SetUseSimTime", "set_use_sim_time", "value"),
        _action("SetROSLogDir", "set_ros_log_dir", "new_log_dir", since="jazzy"),
    ),
    *_in(
        "launch_ros.descriptions",
        Call(
            "ComposableNode",
            "*, package, plugin, name=None, namespace=None, parameters=None, remappings=None, "
            "extra_arguments=None, condition=None",
            "composable_node",
            attributes={"pkg": "package"},
        ),
        Call(
            "ComposableLifecycleNode",
            "*, autostart=False, **kwargs",
            "composable_node",
            of="ComposableNode",
            attributes={"pkg": "package"},
            since="kilted",
        ),
        Call(
            "ParameterFile",
            "param_file, *, allow_substs=False",
            doc="A file of parameters, in which substitutions may be performed.",
        ),
        Call("ParameterValue", "value, *, value_type=None", doc="The value of a parameter, of the type that is said."),
        Call("Parameter", "name, value, *, value_type=None", doc="A parameter and its value."),
    ),
    *_in(
        "launch.descriptions",
        Call(
            "Executable",
            "*, cmd, prefix=None, name=None, cwd=None, env=None, additional_env=None, arguments=None",
            doc="What a process is made of.",
        ),
    ),
    *_in(
        "launch.conditions",
        Call("IfCondition", "predicate_expression", doc="Has an action executed only if it is true (or 1)."),
        Call("UnlessCondition", doc="Has an action executed only if it is false (or 0).", of="IfCondition"),
        Call(
            "LaunchConfigurationEquals",
            "launch_configuration_name, expected_value",
            doc="Has an action executed only if a launch configuration has that value.",
        ),
        Call(
            "LaunchConfigurationNotEquals",
            doc="Has an action executed only if a launch configuration has another value.",
            of="LaunchConfigurationEquals",
        ),
    ),
    *_in(
        "launch.launch_description_sources",
        Call("AnyLaunchDescriptionSource", "launch_file_path", doc="A launch file of any format."),
        Call(
            "FrontendLaunchDescriptionSource",
            "launch_file_path, *, method='interpreted frontend launch file', parser=None",
            doc="A launch file in XML or YAML.",
        ),
        Call("PythonLaunchDescriptionSource", "launch_file_path", doc="A launch file in Python."),
    ),
    *_in(
        "launch_xml.launch_description_sources",
        Call("XMLLaunchDescriptionSource", "launch_file_path", doc="A launch file in XML."),
    ),
    *_in(
        "launch_yaml.launch_description_sources",
        Call("YAMLLaunchDescriptionSource", "launch_file_path", doc="A launch file in YAML."),
    ),
    *_in(
        "launch.event_handler",
        Call("BaseEventHandler", "*, matcher=None, handle_once=False", doc="What other event handlers are made from."),
    ),
    *_in(
        "launch.event_handlers",
        Call(
            "OnActionEventBase",
            "*, action_matcher=None, on_event=None, target_event_cls=None, target_action_cls=None, **kwargs",
            doc="Executes actions upon the events of an action.",
            of="BaseEventHandler",
            gives=("matcher",),
        ),
        Call(
            "OnExecutionComplete",
            "*, target_action=None, on_completion, **kwargs",
            doc="Executes actions once another one is done.",
            of="OnActionEventBase",
            gives=_OF_EVENT,
        ),
        Call(
            "OnProcessExit",
            "*, target_action=None, on_exit, **kwargs",
            doc="Executes actions when a process ends.",
            of="OnActionEventBase",
            gives=_OF_EVENT,
        ),
        Call(
            "OnProcessStart",
            "*, target_action=None, on_start, **kwargs",
            doc="Executes actions when a process starts.",
            of="OnActionEventBase",
            gives=_OF_EVENT,
        ),
        Call(
            "OnProcessIO",
            "*, target_action=None, on_stdin=None, on_stdout=None, on_stderr=None, **kwargs",
            doc="Calls functions with what a process writes or reads.",
            of="OnActionEventBase",
            gives=_OF_EVENT,
        ),
        Call(
            "OnIncludeLaunchDescription",
            "**kwargs",
            doc="Executes actions when a launch file is included.",
            of="EventHandler",
        ),
        Call(
            "OnShutdown",
            "*, on_shutdown, **kwargs",
            doc="Executes actions when the launch ends.",
            of="BaseEventHandler",
            gives=("matcher",),
        ),
    ),
    *_in(
        "launch_ros.event_handlers",
        Call(
            "OnStateTransition",
            "*, entities, target_lifecycle_node=None, transition=None, start_state=None, goal_state=None, "
            "matcher=None, **kwargs",
            doc="Executes actions when a lifecycle node comes into a state.",
            of="EventHandler",
        ),
    ),
    *_in(
        "launch.substitutions",
        Call("TextSubstitution", "*, text", doc="A text as it is."),
        Call("LaunchConfiguration", "variable_name, *, default=None", "var"),
        Call("EnvironmentVariable", "name, *, default_value=None", "env"),
        Call("PathJoinSubstitution", "substitutions", "path-join"),
        Call("PathSubstitution", "path", "path-join", doc="A path, to which `/` adds parts.", since="kilted"),
        Call("Command", "command, *, on_stderr='fail'", "command"),
        Call("PythonExpression", "expression, python_modules=('math',)", "eval"),
        Call("ThisLaunchFileDir", kind="dirname"),
        Call("ThisLaunchFile", kind="filename"),
        Call("LaunchLogDir", kind="launch_log_dir", since="jazzy"),
        Call("AnonName", "name", "anon"),
        Call("FindExecutable", "*, name", "find-exec"),
        Call("FileContent", "path", "file-content", since="jazzy"),
        Call(
            "LocalSubstitution",
            "expression, description=None",
            "local",
            doc="What an event handler has in `context.locals`.",
        ),
        Call("StringJoinSubstitution", "substitutions, delimiter=''", "string-join", since="kilted"),
        Call("IfElseSubstitution", "condition, if_value='', else_value=''", "if", since="jazzy"),
        Call("NotSubstitution", "value", "not"),
        Call("AndSubstitution", "left, right", "and"),
        Call("OrSubstitution", "left, right", "or"),
        Call("AnySubstitution", "*args", "any", since="jazzy"),
        Call("AllSubstitution", "*args", "all", since="jazzy"),
        Call("EqualsSubstitution", "left, right", "equals", since="jazzy"),
        Call("NotEqualsSubstitution", "left, right", "not-equals", since="jazzy"),
        Call("ForEachVar", "name, *, default_value=None", "for-var", since="kilted"),
        Call("ForLoopIndex", "name, **kwargs", "index", since="kilted"),
    ),
    *_in(
        "launch_ros.substitutions",
        Call("FindPackage", "package", "find-pkg", doc="A folder of a package."),
        Call("FindPackageShare", "package", "find-pkg-share"),
        Call("FindPackagePrefix", "package", "find-pkg-prefix"),
        Call("ExecutableInPackage", "executable, package", "exec-in-pkg"),
        Call("Parameter", "name, *, default=None", "param"),
    ),
    *_in(
        "ament_index_python.packages",
        Call("get_package_share_directory", "package_name, print_warning=True", "find-pkg-share"),
        Call("get_package_share_path", "package_name, print_warning=True", "find-pkg-share"),
        Call("get_package_prefix", "package_name", "find-pkg-prefix"),
    ),
)
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
    "LifecycleNode.autostart": "Configure and activate the node once it is there. Of Kilted or newer.",
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
    "Parameter.default": "The text where nothing sets it. Of Jazzy or newer.",
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
    "python_modules": "Modules that the expression uses. Of Jazzy or newer.",
    "remappings": "The remaps: a list of pairs of a name and what it becomes.",
    "right": "The second of both.",
    "ExecuteLocal.respawn_max_retries": "How often to start it again; below 0 without end. Of Jazzy or newer.",
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
