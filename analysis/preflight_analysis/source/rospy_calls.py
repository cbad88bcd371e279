"""What calls of rospy and of the libraries beside it make: endpoints and parameter uses."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from preflight_analysis.evaluation import names
from preflight_analysis.source.branches import Branches
from preflight_analysis.source.collector import Collector, is_name
from preflight_analysis.source.config_params import Config
from preflight_analysis.source.known_params import KnownParams
from preflight_analysis.source.python_frames import has_tree, message_of, note_frames
from preflight_analysis.source.python_libraries import makes_no_ends
from preflight_analysis.source.python_values import UNKNOWN, Imported, Later, StarImported, is_plain, known
from preflight_analysis.tracing.interface import Endpoint, ParamUse, Role

_TYPE = re.compile(r"([A-Za-z]\w*)\.(msg|srv)\.(?:_\w+\.)?([A-Za-z]\w*)\Z")
_TOPIC_TYPES = ("msg",)
_SERVICE_TYPES = ("srv",)
_TF = "tf2_msgs/TFMessage"

_ENDPOINTS: Mapping[str, tuple[Role, tuple[str, str], tuple[str, ...]]] = {
    "rospy.Publisher": ("publisher", ("name", "data_class"), _TOPIC_TYPES),
    "rospy.Subscriber": ("subscriber", ("name", "data_class"), _TOPIC_TYPES),
    "rospy.wait_for_message": ("subscriber", ("topic", "topic_type"), _TOPIC_TYPES),
    "rospy.Service": ("service", ("name", "service_class"), _SERVICE_TYPES),
    "rospy.ServiceProxy": ("client", ("name", "service_class"), _SERVICE_TYPES),
    "message_filters.Subscriber": ("subscriber", ("name", "data_class"), _TOPIC_TYPES),
    "actionlib.SimpleActionServer": ("action_server", ("name", "ActionSpec"), _TOPIC_TYPES),
    "actionlib.ActionServer": ("action_server", ("ns", "ActionSpec"), _TOPIC_TYPES),
    "actionlib.SimpleActionClient": ("action_client", ("ns", "ActionSpec"), _TOPIC_TYPES),
    "actionlib.ActionClient": ("action_client", ("ns", "ActionSpec"), _TOPIC_TYPES),
}
"""The role, the parameters for name and type, and in which kind of module the type is."""

_LIBRARIES = frozenset({"rospy", "actionlib", "message_filters", "tf", "tf2_ros", "dynamic_reconfigure"})
_FIXED: Mapping[str, tuple[tuple[Role, str, str], ...]] = {
    "tf.TransformBroadcaster": (("publisher", "/tf", _TF),),
    "tf2_ros.TransformBroadcaster": (("publisher", "/tf", _TF),),
    "tf2_ros.StaticTransformBroadcaster": (("publisher", "/tf_static", _TF),),
    "tf.TransformListener": (("subscriber", "/tf", _TF), ("subscriber", "/tf_static", _TF)),
    "tf2_ros.TransformListener": (("subscriber", "/tf", _TF), ("subscriber", "/tf_static", _TF)),
    "dynamic_reconfigure.Server": (
        ("service", "~set_parameters", "dynamic_reconfigure/Reconfigure"),
        ("publisher", "~parameter_descriptions", "dynamic_reconfigure/ConfigDescription"),
        ("publisher", "~parameter_updates", "dynamic_reconfigure/Config"),
    ),
}
_ACCESS = {
    "rospy.get_param": "get",
    "rospy.get_param_cached": "get",
    "rospy.has_param": "has",
    "rospy.search_param": "search",
    "rospy.set_param": "set",
    "rospy.delete_param": "delete",
}

HasType = Callable[[str, str, str], bool]
"""Whether a package has a message or service of a name: package, `msg` or `srv`, name."""


class RospyCalls:
    """Collects what the calls of one node make. Implements `python_modules.Calls`."""

    def __init__(
        self,
        node: str,
        remaps: Mapping[str, str],
        argv: Sequence[str],
        params: KnownParams,
        has_type: HasType,
        config: Config,
    ) -> None:
        self._node = node
        self._remaps = remaps
        self._argv = list(argv)
        self._params = params
        self._has_type = has_type
        self._config = config
        self.collected = Collector()

    def begin(self, branches: Branches) -> None:
        """What is made in one branch of a condition may well not be made."""
        self.collected.branches = branches

    def cut_short(self) -> None:
        """There may be more."""
        self.collected.miss()

    def given(self, value: Any) -> None:
        """Nodes are no objects in rospy."""

    def value(self, path: str) -> Any:
        """`sys.argv` is known; everything else is what its name says."""
        return list(self._argv) if path == "sys.argv" else Imported(path)

    def call(self, path: str, args: Sequence[Any], kwargs: Mapping[str, Any], file: str, line: int) -> Any:
        """Note what the call makes; its value where it has one that is known."""
        name = _plain(path)

        def given(index: int, keyword: str) -> Any:
            return known(args[index] if index < len(args) else kwargs.get(keyword, UNKNOWN))

        note_frames(self.collected, path, args, kwargs, file, line)
        if (message := message_of(path, kwargs)) is not None:
            return message
        if factory := _ENDPOINTS.get(name):
            role, (first, second), kinds = factory
            type_ = self._type(given(1, second), kinds)
            qos = {"latch": True} if role == "publisher" and known(kwargs.get("latch")) is True else {}
            self.collected.add_endpoint(Endpoint(role, given(0, first), type_, None, qos, file, line))
            return Imported(f"{name}()")
        if fixed := _FIXED.get(name):
            for role, topic, type_ in fixed:
                self.collected.add_endpoint(Endpoint(role, topic, type_, None, {}, file, line))
            if name == "dynamic_reconfigure.Server":
                self._configured(given(0, "type"))
            return Imported(f"{name}()")
        if has_tree(name):
            return Imported(f"{name}()")
        if name == "rospy.wait_for_service":
            service = given(0, "service")
            self.collected.await_service(Endpoint("client", service, None, None, {}, file, line))
            return None
        if name in _ACCESS:
            has_default = name.startswith("rospy.get_param") and (len(args) > 1 or "default" in kwargs)
            return self._param(_ACCESS[name], given(0, "param_name"), given(1, "default"), has_default, file, line)
        if name == "rospy.get_param_names":
            self.collected.use(ParamUse("/", "list", source_file=file, source_line=line))
        return self._other(name, args, given)

    def _configured(self, config: Any) -> None:
        """The parameters of a dynamic_reconfigure server, made of the module `package.cfg.NameConfig`."""
        package, _, module = config.path.partition(".cfg.") if isinstance(config, Imported) else ("", "", "")
        if module.endswith("Config"):
            for param in self._config(package, module.removesuffix("Config")):
                self._param("get", f"~{param.name}", param.default, True, param.file, param.line)

    def _other(self, name: str, args: Sequence[Any], given: Callable[[int, str], Any]) -> Any:
        if name == "rospy.myargv":
            return [word for word in self._argv if ":=" not in word]
        if name == "rospy.get_name":
            return self._node
        if name == "rospy.get_namespace":
            return names.parent(self._node)
        if name in ("rospy.resolve_name", "rospy.remap_name"):
            asked = given(0, "name")
            return names.resolve(asked, self._node, self._remaps) if is_name(asked) else UNKNOWN
        if name in ("os.path.join", "rospy.names.ns_join", "rospy.ns_join") and args:
            parts = [*map(known, args)]
            if all(isinstance(part, str) for part in parts):
                return os.path.join(*parts)
        if name == "rospy.numpy_msg":
            return given(0, "msg_type")
        if not makes_no_ends(name):
            self.collected.miss()
        return UNKNOWN

    def _param(self, access: str, name: Any, default: Any, has_default: bool, file: str, line: int) -> Any:
        default = default if has_default else UNKNOWN
        if not is_name(name):
            self.collected.miss()
            return default
        shown = default if is_plain(default) else None
        self.collected.use(ParamUse(name, access, shown, has_default, access == "get" and not has_default, file, line))
        if access not in ("get", "has"):
            return UNKNOWN
        full = names.resolve(name, self._node, self._remaps)
        if access == "has":
            return Later(lambda: UNKNOWN if self._params.look(full) is UNKNOWN else True)
        return self._params.later(full, default)

    def _type(self, value: Any, kinds: Sequence[str]) -> str | None:
        if isinstance(value, Imported):
            if _plain(value.path) == "rospy.AnyMsg":
                return "*"
            found = _TYPE.match(value.path)
            return f"{found[1]}/{found[3]}" if found and found[2] in kinds else None
        if isinstance(value, StarImported):
            packages = [m.rpartition(".") for m in value.modules if m.rpartition(".")[2] in kinds]
            having = [p for p, _, kind in packages if len(packages) == 1 or self._has_type(p, kind, value.name)]
            return f"{having[0]}/{value.name}" if len(having) == 1 else None
        return None


def _plain(path: str) -> str:
    """`rospy.topics.Publisher` is `rospy.Publisher`."""
    top, _, rest = path.partition(".")
    return f"{top}.{rest.rpartition('.')[2]}" if top in _LIBRARIES else path
