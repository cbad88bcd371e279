"""The launch language of ROS 2's XML and YAML files as data, one entry a tag.

From the `parse` methods of the actions in ros2/launch and ros2/launch_ros: what one of them does not read is an error
there ("Unexpected attribute(s) found"), and the whole file is not launched.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from preflight_analysis.launch.schema import Attribute, Tag

PARAM_TYPES = ("str", "bool", "float", "int", "list_of_str", "list_of_bool", "list_of_float", "list_of_int", "yaml")
"""`launch.frontend.type_utils.get_data_type_from_identifier`."""

_CONDITIONS = (
    Attribute("if", "Execute this only if it is true (or 1).", "condition", ("true", "false")),
    Attribute("unless", "Execute this only if it is false (or 0).", "condition", ("true", "false")),
)


def _flag(name: str, doc: str, default: str = "false") -> Attribute:
    return Attribute(name, doc, "flag", ("true", "false"), default)


def _required(attribute: Attribute) -> Attribute:
    return replace(attribute, required=True)


def _action(doc: str, *attributes: Attribute, children: tuple[str, ...] = ()) -> Tag:
    return Tag(doc, {a.name: a for a in (*attributes, *_CONDITIONS)}, children)


def _entity(doc: str, *attributes: Attribute, children: tuple[str, ...] = ()) -> Tag:
    """Part of an action: without conditions of its own."""
    return Tag(doc, {a.name: a for a in attributes}, children)


ACTIONS = (
    "node",
    "include",
    "arg",
    "let",
    "group",
    "push_ros_namespace",
    "push-ros-namespace",
    "set_remap",
    "set_parameter",
    "set_parameters_from_file",
    "set_use_sim_time",
    "node_container",
    "load_composable_node",
    "lifecycle_node",
    "executable",
    "timer",
    "ros_timer",
    "for",
    "for_each",
    "set_env",
    "unset_env",
    "append_env",
    "reset_env",
    "reset",
    "log",
    "log_debug",
    "log_info",
    "log_warning",
    "log_error",
    "shutdown",
    "set_ros_log_dir",
)
"""The tags that may stand in `<launch>`, `<group>` and timers."""

_VALUE_NAME = Attribute("name", "The name of the launch configuration.", "argument", required=True)
_NAMESPACE = Attribute(
    "namespace", "The namespace, relative to the pushed one unless it starts with a slash.", "namespace"
)
_PROCESS = (
    Attribute("cwd", "The working directory of the process.", "file"),
    Attribute("on_exit", "`shutdown`: end the whole launch when the process ends.", "choice", ("shutdown",)),
    Attribute("launch-prefix", "A command to put before the process's own, such as `gdb -ex run --args`."),
    Attribute("output", "Where the output goes.", "text", ("screen", "log", "both", "own_log", "full")),
    _flag("respawn", "Start the process again whenever it ends."),
    Attribute("respawn_max_retries", "How often to start it again; below 0 without end.", "integer", default="-1"),
    Attribute("respawn_delay", "Seconds to wait before it is started again.", "number"),
    Attribute("sigkill_timeout", "Seconds from SIGTERM to SIGKILL at shutdown.", "number"),
    Attribute("sigterm_timeout", "Seconds from SIGINT to SIGTERM at shutdown.", "number"),
    _flag("shell", "Run the command in a shell."),
    _flag("emulate_tty", "Give the process a terminal, so that its output is not buffered."),
)
_NODE = (
    Attribute("pkg", "The package of the node.", "package"),
    Attribute("exec", "The executable of the package.", "executable", required=True),
    Attribute("name", "The name of the node; without it the one that its code gives."),
    _NAMESPACE,
    Attribute("args", "Command-line arguments for the node."),
    Attribute("ros_args", "Arguments that follow `--ros-args`."),
    Attribute("exec_name", "What the process is called in the logs."),
    *_PROCESS,
)
_NODE_CHILDREN = ("param", "remap", "env")
_MESSAGE = Attribute("message", "The message.", "prose", required=True)
_TIMER = (Attribute("period", "Seconds to wait.", "number", required=True),)

TAGS_ROS2: Mapping[str, Tag] = {
    "launch": _entity(
        "The root of every launch file.",
        Attribute("deprecated", "Tell users that the file should no longer be used, with this message.", "prose"),
        children=ACTIONS,
    ),
    "arg": _action(
        "Declares an argument of this file; inside of an `<include>`: passes one on.",
        replace(_VALUE_NAME, doc="The name of the argument, for `$(var name)`."),
        Attribute("default", "The value where none is given. Without it one has to be."),
        Attribute("value", "In an `<include>`: the value to pass."),
        Attribute("description", "What it is for, shown by `ros2 launch --show-args`.", "prose"),
        children=("choice",),
    ),
    "choice": _entity("A value that the argument may have.", Attribute("value", "The value.", required=True)),
    "let": _action("Sets a launch configuration.", _VALUE_NAME, Attribute("value", "The value.", required=True)),
    "include": _action(
        "Executes another launch file. What it sets stays set after it.",
        Attribute("file", "The launch file.", "launch-file", required=True),
        children=("arg",),
    ),
    "group": _action(
        "Actions whose launch configurations, namespace, remaps and environment end with the group.",
        _flag("scoped", "Whether what is set inside ends with the group.", "true"),
        _flag("forwarding", "Whether what was set before is known inside.", "true"),
        children=("keep", *ACTIONS),
    ),
    "keep": _entity(
        "A launch configuration that is set in the group, also where it forwards nothing.",
        _VALUE_NAME,
        Attribute("value", "The value.", required=True),
    ),
    "reset": _action("Forgets all launch configurations but those to keep.", children=("keep",)),
    "node": _action("Starts a node.", *_NODE, children=_NODE_CHILDREN),
    "lifecycle_node": _action(
        "Starts a lifecycle node. Of a launch_ros of 2025 or newer; Python launch files have it since long.",
        *(_required(a) if a.name in ("name", "namespace") else a for a in _NODE),
        _flag("autostart", "Configure and activate the node once it is there."),
        children=_NODE_CHILDREN,
    ),
    "node_container": _action(
        "Starts a container and loads composable nodes into it.",
        *(_required(a) if a.name in ("name", "namespace") else a for a in _NODE),
        children=(*_NODE_CHILDREN, "composable_node"),
    ),
    "composable_node": _action(
        "A node to load into the container.",
        Attribute("pkg", "The package that has the plugin.", "package", required=True),
        Attribute("plugin", "The class of the node.", "component", required=True),
        Attribute("name", "The name of the node.", required=True),
        _NAMESPACE,
        children=("param", "remap", "extra_arg"),
    ),
    "load_composable_node": _action(
        "Loads composable nodes into a container that runs.",
        Attribute("target", "The full name of the container.", required=True),
        children=("composable_node",),
    ),
    "extra_arg": _entity(
        "An argument for the container about this node, such as `use_intra_process_comms`.",
        Attribute("name", "Its name.", required=True),
        Attribute("value", "Its value.", required=True),
    ),
    "param": _entity(
        "A parameter of the node, or a file of them.",
        Attribute("name", "The name of the parameter.", "parameter"),
        Attribute("value", "The value."),
        Attribute("type", "What to make of the value; YAML's rules where it is left out.", "choice", PARAM_TYPES),
        Attribute("from", "A YAML file with parameters.", "yaml-file"),
        _flag("allow_substs", "Make the substitutions in that file."),
        children=("param",),
    ),
    "remap": _entity(
        "Gives a topic, service or action another name, for this node.",
        Attribute("from", "The name that the node uses.", "remap-from", required=True),
        Attribute("to", "The name that it gets instead.", "remap-to", required=True),
    ),
    "env": _entity(
        "Sets an environment variable for this process.",
        Attribute("name", "The name of the variable.", "variable", required=True),
        Attribute("value", "Its value.", required=True),
    ),
    "executable": _action(
        "Starts a process that is no node.",
        Attribute("cmd", "The command line.", required=True),
        Attribute("name", "What the process is called in the logs."),
        *_PROCESS,
        children=("env",),
    ),
    "push_ros_namespace": _action(
        "Puts the nodes that come later in this group into a namespace.", _required(_NAMESPACE)
    ),
    "push-ros-namespace": _action(
        "Puts the nodes that come later in this group into a namespace.", _required(_NAMESPACE)
    ),
    "set_remap": _action(
        "Gives a name to the nodes that come later in this group.",
        Attribute("from", "The name that the nodes use.", "remap-from", required=True),
        Attribute("to", "The name that they get instead.", "remap-to", required=True),
    ),
    "set_parameter": _action(
        "Sets a parameter of the nodes that come later in this group.",
        Attribute("name", "The name of the parameter.", "parameter", required=True),
        Attribute("value", "The value, in YAML.", required=True),
    ),
    "set_parameters_from_file": _action(
        "Gives a parameter file to the nodes that come later in this group.",
        Attribute("filename", "The YAML file.", "yaml-file", required=True),
    ),
    "set_use_sim_time": _action(
        "Has the launch itself use simulated time; it sets no parameter of a node.",
        Attribute("value", "true or false.", "condition", ("true", "false"), required=True),
    ),
    "set_ros_log_dir": _action(
        "Sets the folder of the logs.", Attribute("new_log_dir", "The folder.", "file", required=True)
    ),
    "timer": _action(
        "Executes what is inside after some time.",
        *_TIMER,
        _flag("cancel_on_shutdown", "Whether a shutdown ends the wait.", "true"),
        children=ACTIONS,
    ),
    "ros_timer": _action("Executes what is inside after some time of the ROS clock.", *_TIMER, children=ACTIONS),
    "for": _action(
        "Executes what is inside a number of times; `$(index NAME)` is the round. Of a launch newer than 3.7.",
        Attribute("len", "How many times.", "integer", required=True),
        Attribute("name", "What the round is called.", required=True),
        children=ACTIONS,
    ),
    "for_each": _action(
        "Executes what is inside once for each set of values, which `$(for-var NAME)` reads. Of a launch newer than "
        "3.7.",
        Attribute("values", "Maps in YAML with semicolons between: `{name: a};{name: b}`.", required=True),
        children=ACTIONS,
    ),
    "set_env": _action(
        "Sets an environment variable for what comes later in this group.",
        Attribute("name", "The name of the variable.", "variable", required=True),
        Attribute("value", "Its value.", required=True),
    ),
    "unset_env": _action(
        "Removes an environment variable for what comes later in this group.",
        Attribute("name", "The name of the variable.", "variable", required=True),
    ),
    "append_env": _action(
        "Adds to an environment variable for what comes later in this group.",
        Attribute("name", "The name of the variable.", "variable", required=True),
        Attribute("value", "What to add.", required=True),
        _flag("prepend", "Whether to add it in front."),
        Attribute("separator", "What to put between.", default=":"),
    ),
    "reset_env": _action("Takes back all changes of the environment."),
    "log": _action(
        "Prints a message.",
        _MESSAGE,
        Attribute("level", "Of a launch newer than 3.8.", "text", ("DEBUG", "INFO", "WARNING", "ERROR", "CRITICAL")),
    ),
    "log_debug": _action("Prints a message for debugging. Of a launch newer than 3.8.", _MESSAGE),
    "log_info": _action("Prints a message. Of a launch newer than 3.8.", _MESSAGE),
    "log_warning": _action("Prints a warning. Of a launch newer than 3.8.", _MESSAGE),
    "log_error": _action("Prints an error. Of a launch newer than 3.8.", _MESSAGE),
    "shutdown": _action("Ends the launch.", Attribute("reason", "Why, for the log.", "prose")),
}
