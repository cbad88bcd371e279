"""Puts the compiled libraries for nodes in C++ into the wheel, so that a machine without a compiler can watch them.

They are files of data that are only used where they fit (`tracing/preload.py`), so a wheel with them may be one for all
platforms. `ROS_PREFLIGHT_PREBUILT` says what is built: `0` a wheel without them, `1` one with those for all processors,
a platform tag such as `manylinux_2_28_x86_64` one for that platform with those for it. Where it is not set the wheel
has those for which there is a compiler.
"""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface  # type: ignore[import-not-found]

_MODULE = "analysis/preflight_analysis/tracing/preload_compile.py"
_VARIABLE = "ROS_PREFLIGHT_PREBUILT"
_INSIDE = "preflight_analysis/tracing/agents"


class PreloadHook(BuildHookInterface):  # type: ignore[misc]
    """Compiles while a wheel is built; an editable installation compiles at the first use."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Called by hatchling before the files are gathered."""
        wanted = os.environ.get(_VARIABLE, "")
        if version == "editable" or wanted == "0":
            return
        self._folder = tempfile.TemporaryDirectory()
        try:
            made = self._compile(Path(self._folder.name), wanted)
        except Exception as error:
            if wanted:
                raise
            said = error.stderr.decode(errors="replace") if isinstance(error, subprocess.CalledProcessError) else ""
            self.app.display_warning(f"without the compiled libraries for nodes in C++: {error} {said[:1000]}")
            return
        if wanted not in ("", "1"):
            build_data["tag"] = f"py3-none-{wanted}"
            build_data["pure_python"] = False
        build_data["force_include"].update({str(path): f"{_INSIDE}/{path.name}" for path in made})

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Called by hatchling when the wheel is done."""
        folder = getattr(self, "_folder", None)
        if folder is not None:
            folder.cleanup()

    def _compile(self, folder: Path, wanted: str) -> list[Path]:
        spec = importlib.util.spec_from_file_location("preload_compile", Path(self.root, _MODULE))
        assert spec is not None
        assert spec.loader is not None
        module: Any = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        machines = [machine for machine in module.MACHINES if wanted in ("", "1") or wanted.endswith(f"_{machine}")]
        compilers = {machine: module.compiler(machine) for machine in machines if sys.platform == "linux"}
        lacking = [machine for machine in machines if compilers.get(machine) is None]
        if lacking and (wanted or lacking == machines):
            raise OSError(f"a C++ compiler for {' and '.join(lacking)} Linux is needed")
        made = []
        for machine in machines:
            for watched in module.WATCHED if machine not in lacking else ():
                made.append(folder / watched.prebuilt(machine).name)
                module.compile_library(compilers[machine], watched, made[-1], portable=True)
        return made
