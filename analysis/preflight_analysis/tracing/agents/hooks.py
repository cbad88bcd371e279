"""Import hook and file notes: what has to be in place before the node's own code runs."""

from __future__ import annotations

import atexit
import json
import os
import sys
import threading
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any, Optional, Sequence

from . import channel, genpy_weave, randomness
from .variables import AGAIN, INSTALLED, SOURCES, STAND_INS

WOVEN = ("rospy", "actionlib.action_client", "actionlib.simple_action_client", "tf2_ros.buffer", genpy_weave.NAME)
RCLPY = (
    "rclpy",
    "rclpy.node",
    "rclpy.client",
    "rclpy.executors",
    "rclpy.timer",
    "rclpy.action.client",
    "rclpy.action.server",
    "rclpy.wait_for_message",
    "rclpy.lifecycle.node",
    "ament_index_python.packages",
)
_BATCH = 200
_MAX_FILES = 5_000
_MAX_WRITES = 20
_WRITE_FLAGS = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
_PRIVATE = ("/proc/", "/sys/", "/dev/", os.path.dirname(channel.PATH) + "/")


class Files:
    """Files that this process opened; told in batches until the first `flush`, one by one from then on."""

    def __init__(self) -> None:
        self._standard_library = os.path.dirname(os.path.abspath(os.__file__)) + os.sep
        self._seen: set[str] = set()
        self._waiting: list[str] = []
        self._writes = 0
        self._flushed = False
        self._inside = threading.local()

    def hook(self, event: str, args: tuple[Any, ...]) -> None:
        """Audit hook (PEP 578). It must be quick, and must never raise: that would fail the audited call."""
        if event == "open":
            path, mode, flags = args
        elif event == "import" and args[1]:
            path, mode, flags = args[1], "r", 0
        else:
            return
        if getattr(self._inside, "busy", False) or not isinstance(path, (str, bytes)):
            return
        self._inside.busy = True
        try:
            self._note(os.fsdecode(path), mode, flags or 0)
        except Exception:
            pass
        finally:
            self._inside.busy = False

    def _note(self, path: str, mode: object, flags: int) -> None:
        path = os.path.abspath(path)
        if path.startswith(_PRIVATE) or path == "/dev/null":
            return
        if (isinstance(mode, str) and set("wax+") & set(mode)) or flags & _WRITE_FLAGS:
            if self._writes < _MAX_WRITES and path not in self._seen and "__pycache__" not in path:
                self._writes += 1
                self._seen.add(path)
                channel.send("wrote", path=path)
            return
        if path in self._seen or len(self._seen) >= _MAX_FILES:
            return
        self._seen.add(path)
        if path.startswith(self._standard_library) and "-packages" not in path:
            return
        self._waiting.append(path)
        if self._flushed or len(self._waiting) >= _BATCH:
            self.flush(final=self._flushed)

    def flush(self, final: bool = True) -> None:
        """Tell what was opened since the last time."""
        self._flushed = self._flushed or final
        waiting, self._waiting = self._waiting, []
        for start in range(0, len(waiting), _BATCH):
            channel.send("files", paths=waiting[start : start + _BATCH])


class _WeavingLoader(Loader):
    """The module's own loader, and the weave after it."""

    def __init__(self, loader: Loader, library: str, files: Files) -> None:
        self._loader = loader
        self._library = library
        self._files = files

    def create_module(self, spec: ModuleSpec) -> Optional[ModuleType]:
        return self._loader.create_module(spec)

    def exec_module(self, module: ModuleType) -> None:
        self._loader.exec_module(module)
        if module.__spec__ is not None:
            module.__spec__.loader = self._loader
        module.__loader__ = self._loader
        sys.path.insert(0, self._library)
        try:
            if module.__name__ == "rospy":
                from . import rospy_weave  # noqa: PLC0415

                rospy_weave.weave(module, self._files.flush)
            elif module.__name__ in RCLPY:
                from . import rclpy_weave  # noqa: PLC0415

                rclpy_weave.weave(module, self._files.flush)
            elif module.__name__ in randomness.MODULES:
                randomness.weave(module)
            elif module.__name__ == genpy_weave.NAME:
                genpy_weave.weave(module)
            else:
                from . import fake_peers  # noqa: PLC0415

                fake_peers.weave(module)
        except Exception as error:
            channel.send("weave-failed", message=repr(error))
        finally:
            sys.path.remove(self._library)


class _Finder(MetaPathFinder):
    """Finds a module as the others do and puts the weave behind its loader."""

    def __init__(self, name: str, library: str, files: Files) -> None:
        self._name = name
        self._library = library
        self._files = files

    def find_spec(
        self,
        fullname: str,
        path: Optional[Sequence[str]],
        target: Optional[ModuleType] = None,
    ) -> Optional[ModuleSpec]:
        if fullname != self._name:
            return None
        sys.meta_path.remove(self)
        for finder in sys.meta_path:
            find = getattr(finder, "find_spec", None)
            spec: Optional[ModuleSpec] = find(fullname, path, target) if find else None
            if spec is not None:
                if spec.loader is not None:
                    spec.loader = _WeavingLoader(spec.loader, self._library, self._files)
                return spec
        return None


class _StandInsLater(MetaPathFinder):
    """Most nodes miss nothing: what stands in is imported when the first module is missing."""

    def find_spec(
        self, fullname: str, path: Optional[Sequence[str]], target: Optional[ModuleType] = None
    ) -> Optional[ModuleSpec]:
        sys.meta_path.remove(self)
        try:
            from .stand_ins import finder  # noqa: PLC0415

            finder.install()
        except Exception as error:
            channel.send("weave-failed", message=repr(error))
            return None
        for each in sys.meta_path[-2:]:
            spec: Optional[ModuleSpec] = each.find_spec(fullname, path, target)
            if spec is not None:
                return spec
        return None


def install(library: str) -> None:
    """Watch this process. `library` is the folder that holds aspectlib."""
    files = Files()
    sys.addaudithook(files.hook)
    sys.meta_path.insert(0, genpy_weave.WithoutNumpy())
    randomness.install()
    for name in (*WOVEN, *RCLPY, *(name for name in randomness.MODULES if name not in sys.modules)):
        sys.meta_path.insert(0, _Finder(name, library, files))
    atexit.register(files.flush)
    # Last of all: what is built or installed is found first.
    sys.path.extend(folder for folder in os.environ.get(SOURCES, "").split(os.pathsep) if folder)
    if INSTALLED in os.environ:
        from . import installed  # noqa: PLC0415 - as few nodes need it

        installed.install(json.loads(os.environ[INSTALLED]))
    if AGAIN in os.environ:
        from .stand_ins import finder  # noqa: PLC0415

        finder.install()
    elif STAND_INS in os.environ:
        sys.meta_path.append(_StandInsLater())
