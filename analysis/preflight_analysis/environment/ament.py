"""Installed packages of ROS 2: the prefixes that hold them, and what lies where in those.

https://github.com/ament/ament_cmake/blob/rolling/ament_cmake_core/doc/resource_index.md: a prefix lists its packages as
files in `share/ament_index/resource_index/packages`.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping

from preflight_analysis.environment.model import Package
from preflight_analysis.environment.packages import MANIFEST
from preflight_analysis.environment.walk import is_folder

INDEX = os.path.join("share", "ament_index", "resource_index", "packages")
RCLPY = os.path.join("rclpy", "__init__.py")
_PYTHON_FOLDER = re.compile(r"/lib/python(3\.\d+)/(?:dist|site)-packages/?\Z")
DISTRIBUTIONS = ("foxy", "galactic", "humble", "iron", "jazzy", "kilted", "lyrical", "rolling")
"""Oldest first; what is not sourced is looked for from the end."""


def ament_prefixes(variables: Mapping[str, str], workspace: str | None, root: str) -> list[str]:
    """The prefixes in the order in which they count: a workspace that is not sourced before all others, then those of
    AMENT_PREFIX_PATH, and the newest distribution if none is sourced."""
    sourced = [p for p in variables.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if p]
    own = list(workspace_prefixes(workspace)) if workspace else []
    prefixes = [*(p for p in own if p not in sourced), *sourced]
    opt = os.path.join(root, "opt", "ros")
    named = variables.get("ROS_DISTRO", "")
    if not any(p.startswith(opt + os.sep) for p in sourced):
        wanted = [named] if named in DISTRIBUTIONS else list(reversed(DISTRIBUTIONS))
        installed = (os.path.join(opt, name) for name in wanted)
        prefixes += [p for p in installed if os.path.isdir(os.path.join(p, INDEX))][:1]
    return list(dict.fromkeys(os.path.abspath(p) for p in prefixes))


def workspace_prefixes(workspace: str) -> Iterator[str]:
    """What colcon installs into: `install/` as a whole, or a folder of it for each package."""
    install = os.path.join(workspace, "install")
    if os.path.isdir(os.path.join(install, INDEX)):
        yield install
        return
    try:
        with os.scandir(install) as entries:
            folders = sorted(entry.path for entry in entries if is_folder(entry))
    except OSError:
        return
    yield from (folder for folder in folders if os.path.isdir(os.path.join(folder, INDEX)))


def installed_packages(prefixes: Iterable[str]) -> dict[str, Package]:
    """The packages of the prefixes' indexes; the first prefix that has one wins."""
    packages: dict[str, Package] = {}
    for prefix in prefixes:
        try:
            names = sorted(os.listdir(os.path.join(prefix, INDEX)))
        except OSError:
            continue
        for name in names:
            share = os.path.join(prefix, "share", name)
            if name not in packages and not name.startswith("."):
                packages[name] = Package(name, share, os.path.join(share, MANIFEST), build_type="ament_cmake")
    return packages


def rclpy_interpreter(variables: Mapping[str, str], prefixes: Iterable[str], root: str) -> str | None:
    """The interpreter of the first rclpy that there is: in a virtual environment of the PATH, on PYTHONPATH, or in one
    of the prefixes."""
    for folder in variables.get("PATH", "").split(os.pathsep):
        interpreter = os.path.join(folder, "python3")
        has_rclpy = os.path.isabs(folder) and any(_python_folders(os.path.dirname(os.path.normpath(folder))))
        if has_rclpy and os.access(interpreter, os.X_OK):
            return interpreter
    named = ((p, _PYTHON_FOLDER.search(p)) for p in variables.get("PYTHONPATH", "").split(os.pathsep) if p)
    found = [match[1] for path, match in named if match and os.path.isfile(os.path.join(path, RCLPY))]
    found += [version for prefix in prefixes for version in _python_folders(prefix)]
    for version in found:
        interpreter = os.path.join(root, "usr", "bin", f"python{version}")
        if os.access(interpreter, os.X_OK):
            return interpreter
    return None


def python_folders(prefix: str) -> list[str]:
    """Where rclpy is below a prefix."""
    return [os.path.join(prefix, "lib", f"python{version}", "site-packages") for version in _python_folders(prefix)]


def _python_folders(prefix: str) -> Iterator[str]:
    """The versions of Python that rclpy of a prefix is for."""
    try:
        names = sorted(os.listdir(os.path.join(prefix, "lib")))
    except OSError:
        return
    for name in names:
        if name.startswith("python3.") and os.path.isfile(os.path.join(prefix, "lib", name, "site-packages", RCLPY)):
            yield name.removeprefix("python")


def distribution(variables: Mapping[str, str], prefixes: Iterable[str]) -> str | None:
    """The name of the ROS 2 distribution, by the variable or by the prefix."""
    named = variables.get("ROS_DISTRO")
    if named and (variables.get("ROS_VERSION") == "2" or named in DISTRIBUTIONS):
        return named
    return next((name for p in prefixes if (name := os.path.basename(p)) in DISTRIBUTIONS), None)
