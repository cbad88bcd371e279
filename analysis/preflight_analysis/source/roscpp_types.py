"""The types of messages, services and actions by the C++ classes that are made of them."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Any

from preflight_analysis.source.cpp_values import Argument, CppType, Function, Message, Unmade, values
from preflight_analysis.source.roscpp_api import ANY_MESSAGE

_WRAPPERS = frozenset({"shared_ptr", "MessageEvent", "ServiceEvent", "Ptr", "ConstPtr"})
_SUFFIX = re.compile(r"(?<=\w)(?:ConstPtr|Ptr|ConstWeakPtr|_)\Z")
_HALF = re.compile(r"::(?:Request|Response)\Z|(?<=\w)(?:Request|Response)\Z")
_TYPE = re.compile(r"(?:::)?([A-Za-z]\w*)::([A-Za-z]\w*)\Z")
_HEADER = re.compile(r"([A-Za-z]\w*)/([A-Za-z]\w*)\.h\Z")
_NO_PACKAGES = frozenset({"std", "boost", "ros", "Eigen", "cv", "tf", "tf2", "pcl"})
_PCL_CLOUDS = frozenset({"pcl::PointCloud", "pcl::PCLPointCloud2"})
"""Classes that roscpp sends as clouds, by pcl_ros/point_cloud.h and pcl_conversions/pcl_conversions.h."""


class MessageTypes:
    """`has_type(package, kind, name)` says whether a package has it, of kind `msg`, `srv` or `action`."""

    def __init__(self, has_type: Callable[[str, str, str], bool]) -> None:
        self._has_type = has_type
        self.includes: Sequence[str] = ()
        """What the files of the program include."""

    def first(self, types: Sequence[CppType]) -> str | None:
        """The type of the first template argument of a call."""
        return self.of(types[0]) if types else None

    def argument(self, type_: CppType, index: int) -> str | None:
        """The type that a class has as its template argument at `index`."""
        return self.of(type_.args[index]) if len(type_.args) > index else None

    def of_callback(self, args: Sequence[Argument]) -> str | None:
        """What the callback among the arguments takes."""
        callback = next((v for v in values(args[1:]) if isinstance(v, (Function, Unmade))), None)
        if isinstance(callback, Function):
            first = callback.parameters[0] if callback.parameters else None
            return self.of(first) if first is not None else None
        return None

    def of_service_callback(self, types: Sequence[CppType], args: Sequence[Argument]) -> str | None:
        """The service of a callback by the type of its request."""
        request = types[0] if types else None
        callback = next((v for v in values(args[1:]) if isinstance(v, Function)), None)
        if request is None and callback is not None and callback.parameters:
            request = callback.parameters[0]
        return self.of_half(request) if request is not None else None

    def of_half(self, type_: CppType) -> str | None:
        """The service that a request or response belongs to."""
        if type_.name.rpartition("::")[2] in _WRAPPERS and type_.args:
            type_ = type_.args[0]
        return self.of(CppType(_HALF.sub("", type_.name), type_.args, type_.file))

    def service_of(self, value: Any) -> str | None:
        """The service that an object of its class is for."""
        return self.of_half(value.type) if isinstance(value, (Message, Unmade)) else None

    def of(self, type_: CppType) -> str | None:
        """`pkg/Name` of a class that messages, services or actions are made of."""
        name = type_.name.removeprefix("::")
        space, _, last = name.rpartition("::")
        if space in ("boost", "std", "ros") and last in _WRAPPERS:
            return self.of(type_.args[0]) if type_.args else None
        if last in _WRAPPERS:
            name = space
        name = _SUFFIX.sub("", name)
        if name in ANY_MESSAGE:
            return "*"
        if name in _PCL_CLOUDS:
            return "sensor_msgs/PointCloud2"
        found = _TYPE.match(name)
        if found is not None:
            return f"{found[1]}/{found[2]}" if found[1] not in _NO_PACKAGES else None
        if "::" in name or type_.file is None:
            return None
        # Its namespace is used or around; the header that has it tells which.
        for includes in (type_.file.includes, self.includes):
            headers = (_HEADER.match(include) for include in includes)
            packages = {header[1] for header in headers if header is not None and header[2] == name}
            if packages:
                return f"{packages.pop()}/{name}" if len(packages) == 1 else None
        used = dict.fromkeys(path[0] for path in type_.file.namespaces if len(path) == 1)
        having = [p for p in used if any(self._has_type(p, kind, name) for kind in ("msg", "srv", "action"))]
        return f"{having[0]}/{name}" if len(having) == 1 else None
