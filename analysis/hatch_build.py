"""Puts the compiled library for roscpp nodes into the wheel, so that a machine without a compiler can watch them.

It is a file of data that is only used where it fits (`tracing/preload.py`), so the wheel stays one for all platforms.
Where it cannot be compiled the wheel is made without; `make wheel` insists.
"""

from __future__ import annotations

import importlib.util
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface  # type: ignore[import-not-found]

_MODULE = "analysis/preflight_analysis/tracing/preload_compile.py"
_INSIDE = "preflight_analysis/tracing/agents/roscpp_preload.so"


class PreloadHook(BuildHookInterface):  # type: ignore[misc]
    """Compiles while a wheel is built; an editable installation compiles at the first use."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Called by hatchling before the files are gathered."""
        if version == "editable":
            return
        self._folder = tempfile.TemporaryDirectory()
        made = Path(self._folder.name, "roscpp_preload.so")
        try:
            self._compile(made)
        except Exception as error:
            if os.environ.get("ROS_PREFLIGHT_PREBUILT"):
                raise
            said = error.stderr.decode(errors="replace") if isinstance(error, subprocess.CalledProcessError) else ""
            self.app.display_warning(f"without the compiled library for roscpp nodes: {error} {said[:1000]}")
            return
        build_data["force_include"][str(made)] = _INSIDE

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Called by hatchling when the wheel is done."""
        folder = getattr(self, "_folder", None)
        if folder is not None:
            folder.cleanup()

    def _compile(self, path: Path) -> None:
        spec = importlib.util.spec_from_file_location("preload_compile", Path(self.root, _MODULE))
        assert spec is not None
        assert spec.loader is not None
        module: Any = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        compiler = module.compiler()
        if sys.platform != "linux" or platform.machine() not in module.MACHINES or compiler is None:
            raise OSError("a C++ compiler on x86-64 Linux is needed")
        module.compile_library(compiler, module.SOURCE, path, portable=True)
