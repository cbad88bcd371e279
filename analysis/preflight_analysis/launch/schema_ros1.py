"""The roslaunch XML language as data: http://wiki.ros.org/roslaunch/XML, one entry a tag.

`required` attributes are those without which roslaunch stops. `children` are the tags that it reads there.
"""

from __future__ import annotations

from dataclasses import dataclass

CONDITIONS = ("if", "unless")
ANNOTATIONS = ("topics", "services", "params", "actions")
"""Our own tags in a `<node>`; roslaunch skips them with a warning, which is why a comment may hold them too."""


@dataclass(frozen=True, slots=True)
class Tag:
    """What a tag may have. Names in the order in which they should be offered."""

    required: tuple[str, ...] = ()
    optional: tuple[str, ...] = ()
    children: tuple[str, ...] = ()
    text: bool = False
    refused: tuple[str, ...] = ()
    """Attributes and children on which roslaunch stops, where others that it does not know get a warning."""

    @property
    def attributes(self) -> tuple[str, ...]:
        """All attributes, the conditions included."""
        return (*self.required, *self.optional, *CONDITIONS)


_SCOPE = ("arg", "env", "group", "include", "machine", "node", "param", "remap", "rosparam", "test")
_NODE = ("remap", "param", "rosparam", "env")
_NODE_OPTIONAL = ("args", "ns", "output", "respawn", "respawn_delay", "required", "launch-prefix", "machine", "cwd")

TAGS: dict[str, Tag] = {
    "launch": Tag(optional=("deprecated",), children=_SCOPE),
    "group": Tag(optional=("ns", "clear_params"), children=_SCOPE),
    "node": Tag(("pkg", "type", "name"), (*_NODE_OPTIONAL, "clear_params"), _NODE),
    "test": Tag(
        ("pkg", "type", "test-name"),
        ("name", "args", "ns", "launch-prefix", "machine", "cwd", "clear_params", "time-limit", "retry", "required"),
        _NODE,
        refused=("respawn", "respawn_delay", "output"),
    ),
    "include": Tag(("file",), ("ns", "clear_params", "pass_all_args"), ("arg", "env")),
    "arg": Tag(("name",), ("default", "value", "doc")),
    "param": Tag(("name",), ("value", "type", "textfile", "binfile", "command")),
    "rosparam": Tag((), ("command", "file", "param", "ns", "subst_value"), (), text=True),
    "remap": Tag(("from", "to")),
    "env": Tag(("name", "value")),
    "machine": Tag(
        ("name", "address"),
        ("env-loader", "ssh-port", "user", "password", "default", "timeout"),
        refused=("ros-root", "ros-package-path", "ros-ip", "ros-hostname", "env"),
    ),
}
