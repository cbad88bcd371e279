"""The roslaunch XML language as data: http://wiki.ros.org/roslaunch/XML, one entry a tag.

Validation, completion and hover read it. The default of an attribute is what roslaunch takes where it is left out;
`choices` are offered and, where roslaunch takes nothing else, required.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from preflight_analysis.launch.schema import Attribute, Tag

ANNOTATIONS = ("topics", "services", "params", "actions")
"""Our own tags in a `<node>`; roslaunch skips them with a warning, which is why a comment may hold them too."""


def _flag(name: str, doc: str) -> Attribute:
    return Attribute(name, doc, "flag", ("true", "false"), "false")


def _required(attribute: Attribute) -> Attribute:
    return replace(attribute, required=True)


_CONDITIONS = (
    Attribute("if", "Read the tag only if this is true (or 1).", "condition", ("true", "false")),
    Attribute("unless", "Read the tag only if this is false (or 0).", "condition", ("true", "false")),
)


def _attributes(*attributes: Attribute) -> Mapping[str, Attribute]:
    """Those of a tag, and the conditions."""
    return {each.name: each for each in (*attributes, *_CONDITIONS)}


_SCOPE = ("node", "include", "arg", "param", "rosparam", "remap", "group", "env", "machine", "test")
_NODE = ("param", "rosparam", "remap", "env")

_PKG = Attribute("pkg", "The package of the node.", "package", required=True)
_TYPE = Attribute("type", "The executable: a file of this name in the package.", "executable", required=True)
_NAME = Attribute("name", "The name of the node, without a namespace.", "node")
_ARGS = Attribute("args", "Command-line arguments for the node.")
_NS = Attribute("ns", "Start the node in this namespace.", "namespace")
_CLEAR = _flag("clear_params", "Delete all parameters in the node's private namespace before it starts.")
_PREFIX = Attribute("launch-prefix", "A command to put before the node's own, such as `gdb -ex run --args`.")
_MACHINE = Attribute("machine", "Start the node on this machine, which a `<machine>` tag declares.", "machine")
_CWD = Attribute(
    "cwd",
    "The node's working directory: `ROS_HOME`, or `node` for the folder of its executable.",
    "choice",
    ("ROS_HOME", "node"),
    "ROS_HOME",
)
_REQUIRED = _flag("required", "End the whole launch when the node ends.")

TAGS: Mapping[str, Tag] = {
    "launch": Tag(
        "The root of every launch file.",
        _attributes(
            Attribute("deprecated", "Tell users that the file should no longer be used, with this message.", "prose")
        ),
        children=_SCOPE,
    ),
    "group": Tag(
        "Tags that share a namespace, a condition, and remaps, environment and arguments of their own.",
        _attributes(
            Attribute("ns", "Put everything in the group into this namespace.", "namespace"),
            _flag("clear_params", "Delete all parameters in the group's namespace before the launch; needs `ns`."),
        ),
        children=_SCOPE,
        named_by=("ns",),
        starts=True,
    ),
    "node": Tag(
        "Starts a node.",
        _attributes(
            _PKG,
            _TYPE,
            _required(_NAME),
            _ARGS,
            _NS,
            Attribute("output", "Where the node's output goes.", "choice", ("log", "screen"), "log"),
            _flag("respawn", "Start the node again whenever it ends."),
            Attribute("respawn_delay", "Seconds to wait before the node is started again.", "number", default="0"),
            _REQUIRED,
            _PREFIX,
            _MACHINE,
            _CWD,
            _CLEAR,
        ),
        children=_NODE,
        named_by=("name", "type"),
        starts=True,
    ),
    "test": Tag(
        "Runs a test node; only `rostest` does, `roslaunch` leaves it out.",
        _attributes(
            _PKG,
            _TYPE,
            Attribute("test-name", "The name of the test in the results.", "node", required=True),
            replace(_NAME, doc="The name of the node, without a namespace; that of the test where it is left out."),
            _ARGS,
            _NS,
            _PREFIX,
            _MACHINE,
            _CWD,
            _CLEAR,
            Attribute("time-limit", "Seconds after which the test has failed.", "number", default="60"),
            Attribute("retry", "How often to try again before the test has failed.", "integer", default="0"),
            _REQUIRED,
        ),
        children=_NODE,
        refused=("respawn", "respawn_delay", "output"),
        named_by=("test-name", "name", "type"),
        starts=True,
    ),
    "include": Tag(
        "Reads another launch file. It sees only the arguments that are passed to it.",
        _attributes(
            Attribute("file", "The launch file to read.", "launch-file", required=True),
            Attribute("ns", "Put everything in the file into this namespace.", "namespace"),
            _flag("clear_params", "Delete all parameters in the namespace before the launch; needs `ns`."),
            _flag("pass_all_args", "Pass on all arguments of this file as well."),
        ),
        children=("arg", "env"),
        named_by=("file",),
        starts=True,
    ),
    "arg": Tag(
        "Declares an argument of this file; inside of an `<include>`: passes one on.",
        _attributes(
            Attribute("name", "The name of the argument, for `$(arg name)`.", "argument", required=True),
            Attribute("default", "The value where none is passed. Without `default` and `value` one has to be."),
            Attribute("value", "The value, which nobody can override."),
            Attribute("doc", "What it is for, shown by `roslaunch --ros-args`.", "prose"),
        ),
        named_by=("name",),
        detail=("value", "default"),
    ),
    "param": Tag(
        "Sets a parameter; inside of a `<node>` a private one.",
        _attributes(
            Attribute("name", "The name of the parameter, relative to the namespace.", "parameter", required=True),
            Attribute("value", "The value."),
            Attribute(
                "type",
                "The type of the value; `auto` goes by what the text looks like.",
                "choice",
                ("auto", "str", "string", "int", "double", "bool", "boolean", "yaml"),
                "auto",
            ),
            Attribute("textfile", "Set it to the text of this file.", "file"),
            Attribute("binfile", "Set it to the bytes of this file.", "file"),
            Attribute("command", "Set it to what this command prints."),
        ),
        named_by=("name",),
        detail=("value", "textfile", "binfile", "command"),
    ),
    "rosparam": Tag(
        "Sets parameters from YAML, in a file or between the tags.",
        _attributes(
            Attribute(
                "command",
                "`load` parameters, `dump` them to a file or `delete` them.",
                "choice",
                ("load", "dump", "delete"),
                "load",
            ),
            Attribute("file", "The YAML file.", "yaml-file"),
            Attribute("param", "The name of the parameter under which the YAML is put.", "parameter"),
            Attribute("ns", "Put the parameters into this namespace.", "namespace"),
            _flag("subst_value", "Resolve `$(...)` in the YAML text."),
        ),
        text=True,
        named_by=("param", "file", "ns"),
    ),
    "remap": Tag(
        "Gives a topic, service or action another name, for the nodes that come later in the same scope.",
        _attributes(
            Attribute("from", "The name that the node uses.", "remap-from", required=True),
            Attribute("to", "The name that it gets instead.", "remap-to", required=True),
        ),
        named_by=("from",),
        detail=("to",),
    ),
    "env": Tag(
        "Sets an environment variable for the nodes that come later in the same scope.",
        _attributes(
            Attribute("name", "The name of the variable.", "variable", required=True),
            Attribute("value", "Its value.", required=True),
        ),
        named_by=("name",),
        detail=("value",),
    ),
    "machine": Tag(
        "Declares a machine on which nodes can be started.",
        _attributes(
            Attribute("name", "The name for the attribute `machine` of nodes.", "machine", required=True),
            Attribute("address", "The host's name or address.", required=True),
            Attribute("env-loader", "A script on the machine that sets up the environment and runs what follows."),
            Attribute("ssh-port", "The port of its SSH server.", "integer", default="22"),
            Attribute("user", "The user to log in as."),
            Attribute("password", "The password; keys are safer."),
            Attribute(
                "default",
                "`true`: nodes that come later start here unless they say otherwise; `never`: this machine is not used "
                "for nodes that name none.",
                "choice",
                ("true", "false", "never"),
                "false",
            ),
            Attribute("timeout", "Seconds to wait for a node to start.", "number", default="10"),
        ),
        refused=("ros-root", "ros-package-path", "ros-ip", "ros-hostname", "env"),
        named_by=("name",),
    ),
}
