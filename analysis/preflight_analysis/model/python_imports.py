"""What the Python programs of the workspace import: modules of its own packages that are not there, and names that are
slips of modules which everybody knows."""

from __future__ import annotations

import ast
import os
import re
import sys
from collections.abc import Iterator
from itertools import islice
from pathlib import PurePath

from preflight_analysis.catalogue.released import DISTRIBUTIONS, distributions_with
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location
from preflight_analysis.environment.detect import BUILT
from preflight_analysis.environment.git_ignored import is_ignored
from preflight_analysis.environment.installed_paths import cmake_build, package_around
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.derived import derived
from preflight_analysis.incremental.query import query
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import folded, is_slip, nearest

_MADE = ("msg", "srv", "action", "cfg")
"""Modules of a package that its build makes."""
_BUILD_FILES = ("setup.py", "pyproject.toml", "setup.cfg", "CMakeLists.txt")
_MOST_FILES = 60
"""Modules that are looked into for one program."""
_PYTHON = re.compile(r"#!.*\bpython")
_DYNAMIC = re.compile(r"__path__|sys\.modules|__getattr__|import\s+\*|import_module|\bexec\(")
"""How the `__init__.py` of a package has more than its folder."""
_SHORT, _LONG = 5, 8
"""Letters of a name of which another one may be a slip, and of one that hardly another one is like."""
_INSTALLS = re.compile(
    r"(?i)(?:[\w.-]*(?:requirement|constraint|dependenc|depends|install)[\w.-]*|environment.*\.ya?ml|pipfile|poetry\.lock"
    r"|pyproject\.toml|setup\.(?:py|cfg)|cmakelists\.txt|package\.xml|rosdep.*\.ya?ml|.*\.(?:sh|bash|repos|rosinstall)"
    r"|readme.*|.*\.(?:md|rst)|makefile|justfile|(?:.*[._-])?(?:docker|container)file.*|(?:docker-?)?compose.*\.ya?ml"
    r"|\.(?:gitlab-ci|travis)\.ya?ml|\.gitmodules)\Z"
)
"""Files that install something, or say what is to be installed."""
_MOST_INSTALLING = 500
_WELL_KNOWN = """
numpy scipy matplotlib pandas requests serial yaml skimage sklearn torch torchvision tensorflow keras shapely
networkx transforms3d transformations tf_transformations tornado flask django fastapi uvicorn websockets websocket
paramiko psutil pyrealsense2 open3d pygame pyqtgraph PySide2 PySide6 PyQt5 PyQt6 jinja2 lxml construct bitstring
sympy numba cupy casadi cvxpy osqp pinocchio onnx onnxruntime ultralytics mediapipe imutils pynput evdev smbus
smbus2 gpiozero spidev pigpio adafruit_blinka depthai filterpy pyproj utm geopy rtree trimesh pybullet mujoco
gymnasium stable_baselines3 transformers whisper openai simplejson msgpack protobuf zenoh setuptools pytest
dynamixel_sdk pymodbus pyvisa modbus_tk seaborn plotly ruamel tqdm click typer rich colorama termcolor attrs
pydantic marshmallow sqlalchemy redis pymongo boto3 httpx aiohttp pillow imageio gtsam rospkg catkin_pkg xacro
rclpy rospy launch launch_ros launch_testing ament_index_python rosidl_runtime_py tf2_ros tf2_py tf2_geometry_msgs
cv_bridge sensor_msgs_py message_filters image_geometry std_msgs std_srvs sensor_msgs geometry_msgs nav_msgs
nav2_msgs nav2_simple_commander visualization_msgs diagnostic_msgs diagnostic_updater trajectory_msgs shape_msgs
control_msgs actionlib actionlib_msgs dynamic_reconfigure builtin_interfaces rcl_interfaces lifecycle_msgs
moveit_msgs moveit_commander moveit_configs_utils action_msgs unique_identifier_msgs tf2_msgs vision_msgs
Crypto Cryptodome OpenGL Xlib dateutil dotenv zmq socketio picamera picamera2 pymavlink dronekit sounddevice soundfile
pyaudio speech_recognition bluetooth tflite_runtime vtkmodules
"""
"""Modules that many programs of robots import."""
WELL_KNOWN = frozenset(_WELL_KNOWN.split())


@dataclass(frozen=True, slots=True)
class Absent:
    """A module that an own package does not have: its full name, the nearest that is there, and where it is
    imported."""

    name: str
    near: str | None
    location: Location


@dataclass(frozen=True, slots=True)
class Slip:
    """An import of a module that nobody knows and whose name is a slip of one that is known."""

    name: str
    near: str
    location: Location


@query
def imports_of(db: Database, environment: Environment, path: str) -> tuple[Absent | Slip, ...]:
    """What a program imports at its start that is not there, and what the own modules do that it imports."""
    return tuple(dict.fromkeys(_Imports(db, environment).of(path)))


def absent_module(context: Context, file: str, name: str) -> tuple[str, str | None] | None:
    """The module of an own package that is not there, of one that a file imports by its full name, and the nearest that
    is there."""
    found = _Imports(context.disk.db, context.environment).find(name, file)
    return found if isinstance(found, tuple) else None


def slip_of(context: Context, file: str, name: str) -> str | None:
    """The module that is meant by one that nobody knows; None where the name is no slip, or somebody may have it."""
    return _slip_of(context.disk.db, context.environment, file, name)


def _slip_of(db: Database, environment: Environment, file: str, name: str) -> str | None:
    top = re.split("[.:]", name)[0]
    known = WELL_KNOWN | sys.stdlib_module_names
    if len(top) < _SHORT or top in known or top in environment.packages:
        return None
    near = nearest(top, known)
    if near is None or not is_slip(top, near) or not _is_likely(top, near):
        return None
    package = package_around(environment, file)
    return near if package is not None and not _may_exist(db, environment, package, top) else None


def _is_likely(name: str, near: str) -> bool:
    """Whether a slip is likelier than a module that has the name: a short one is a letter away from many, and is a slip
    where a letter is doubled, or two are swapped."""
    return min(len(name), len(near)) >= _LONG or set(folded(name)) == set(folded(near))


def _may_exist(db: Database, environment: Environment, package: Package, name: str) -> bool:
    """Whether some distribution of ROS has a module of this name, or the package makes it, or the workspace says of it
    that it is needed or installed."""
    if any(distributions_with(name, generation) for generation in DISTRIBUTIONS):
        return True
    disk, share = Disk(db), package.share
    if any(disk.exists(os.path.join(share, each)) for each in (name, f"{name}.py", f"src/{name}")):
        return True
    pattern = re.compile(rf"(?i)(?<![a-z0-9]){re.escape(name).replace('_', '[_-]')}(?![a-z0-9])")
    return any(pattern.search(disk.content(path) or "") for path in _that_install(db, environment, share))


@query
def _that_install(db: Database, environment: Environment, share: str) -> tuple[str, ...]:
    """The files that say what the programs of a package need: its own, those of the folders above it, and those of the
    other packages of the workspace."""
    disk, folders = Disk(db), dict.fromkeys([share, *(each.share for each in environment.own_packages)])
    top = environment.workspace
    if top is not None:
        # Not the packages' alone: `requirements/dev.txt`, `docker/Dockerfile`.
        below = (os.path.join(top, name) for name in disk.names(top) if name not in BUILT)
        folders |= dict.fromkeys((top, *(path for path in below if disk.is_folder(path))))
        for folder in (*folders,):
            folders |= {str(each): None for each in PurePath(folder).parents if each.is_relative_to(top)}
    paths = (os.path.join(folder, name) for folder in folders for name in disk.names(folder) if _INSTALLS.match(name))
    return tuple(islice((path for path in paths if disk.is_file(path)), _MOST_INSTALLING))


class _Imports:
    def __init__(self, db: Database, environment: Environment) -> None:
        self._db, self._disk, self._environment = db, Disk(db), environment
        self._seen: set[str] = set()

    def of(self, path: str) -> Iterator[Absent | Slip]:
        pending = [path]
        while pending and len(self._seen) < _MOST_FILES:
            file = pending.pop()
            document = self._disk.text(file) if file not in self._seen else None
            self._seen.add(file)
            if not isinstance(document, Document) or not (file.endswith(".py") or _PYTHON.match(document.text)):
                continue
            for name, node in imported(document.text):
                found = self.find(name, file)
                line = document.location(document.lines.line_span(node.lineno - 1))
                if isinstance(found, tuple):
                    yield Absent(*found, line)
                elif found:
                    pending += found
                elif (
                    not name.startswith(".") and (near := _slip_of(self._db, self._environment, file, name)) is not None
                ):
                    top = re.split("[.:]", name)[0]
                    beside = os.path.join(os.path.dirname(path), top)
                    if not self._disk.exists(beside) and not self._disk.exists(f"{beside}.py"):
                        yield Slip(top, near, line)

    def find(self, name: str, file: str) -> tuple[str, str | None] | list[str]:
        """The files of an own module; of one that is not there its name, and the nearest that is."""
        folders, at, names = self._start(name, file)
        files: list[str] = []
        for index, part in enumerate(names):
            files += (path for folder in folders if self._disk.is_file(path := os.path.join(folder, "__init__.py")))
            inner = [path for folder in folders if self._disk.is_folder(path := os.path.join(folder, part))]
            modules = [path for folder in folders if self._disk.is_file(path := os.path.join(folder, f"{part}.py"))]
            if not inner and not modules:
                there = frozenset(each for folder in folders for each in self._modules(folder))
                last = index == len(names) - 1
                if not folders or self._may_be_there(part, folders, last=last and name.count(":") > 0):
                    return files
                near = nearest(part, there)
                return f"{at}.{part}", f"{at}.{near}" if near is not None else None
            files += modules
            if modules and not inner:
                return files
            folders, at = inner, f"{at}.{part}"
        return files + [path for folder in folders if self._disk.is_file(path := os.path.join(folder, "__init__.py"))]

    def _start(self, name: str, file: str) -> tuple[list[str], str, list[str]]:
        """The folders of the own package that an import begins with, its name, and what is imported of it."""
        level = len(name) - len(name.lstrip("."))
        parts = [part for part in re.split(r"[.:]", name[level:]) if part]
        if level:
            folder = os.path.dirname(file)
            for _ in range(level - 1):
                folder = os.path.dirname(folder)
            return [folder], os.path.basename(folder), parts
        packages = self._environment.packages
        near = (packages.get(parts[0]), package_around(self._environment, file))
        own = {each.share: each for each in near if each is not None and each in self._own()}
        folders: dict[str, None] = {}
        for package in own.values():
            cmake = package.is_ament and package.build_type != "ament_python"
            installed = cmake_build(self._disk, package).python_packages if cmake else {}
            places = (f"{package.share}/{parts[0]}", f"{package.share}/src/{parts[0]}", installed.get(parts[0], ""))
            folders |= {place: None for place in places if place and next(iter(self._modules(place)), None)}
        return list(folders), parts[0], parts[1:]

    def _own(self) -> list[Package]:
        return list(self._environment.own_packages)

    def _modules(self, folder: str) -> Iterator[str]:
        for name in self._disk.names(folder):
            stem, ending = os.path.splitext(name)
            if ending == ".py" and stem.isidentifier():
                yield stem
            elif not ending and self._disk.is_folder(os.path.join(folder, name)) and name.isidentifier():
                yield name

    def _may_be_there(self, part: str, folders: list[str], *, last: bool) -> bool:
        """Whether something else may bring a module: the build, an extension, the package itself. `last`: it may be a
        name that the package defines."""
        if part in _MADE or part.startswith("_") or part.endswith(("_pb2", "_pb2_grpc")):
            return True
        word = re.compile(rf"\b{re.escape(part)}\b")
        for folder in folders:
            beside = (name for name in self._disk.names(folder) if name.partition(".")[0] == part)
            if next(beside, None) is not None or is_ignored(self._disk, os.path.join(folder, f"{part}.py")):
                return True
            init = self._disk.content(os.path.join(folder, "__init__.py")) or ""
            if _DYNAMIC.search(init) or (last and word.search(init)):
                return True
            package = package_around(self._environment, folder)
            for name in _BUILD_FILES if package is not None else ():
                content = self._disk.content(os.path.join(package.share, name)) if package is not None else None
                if content is not None and word.search(content):
                    return True
        return False


@derived
def imported_tops(document: Document) -> tuple[tuple[str, int], ...]:
    """The modules at the top that a program imports whenever it is loaded, without its own by a relative name, and the
    lines that do so, counted from 0."""
    found = ((re.split("[.:]", name)[0], node.lineno - 1) for name, node in imported(document.text))
    return tuple((top, line) for top, line in found if top)


def imported(text: str) -> Iterator[tuple[str, ast.stmt]]:
    """The modules that a program imports whenever it is loaded, by their full names; of a name that may be one as well
    as something else in a module `module:name`."""
    try:
        module = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return
    for node in module.body:
        if isinstance(node, ast.Import):
            yield from ((alias.name, node) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = "." * node.level + (node.module or "")
            for alias in node.names:
                yield (base if alias.name == "*" else f"{base}:{alias.name}"), node
