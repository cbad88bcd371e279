"""The package `fib` with an action, generated and compiled: PyPI has none."""

from __future__ import annotations

import subprocess
from dataclasses import dataclass
from pathlib import Path

from support.build_once import build_once
from support.ros2_harness import ROOT, ros2_prefix

_NEEDED = ("action_msgs", "unique_identifier_msgs", "builtin_interfaces", "service_msgs")
_FACTS = """import sysconfig, numpy
print(sysconfig.get_config_var('EXT_SUFFIX'), sysconfig.get_paths()['include'], numpy.get_include(), sep='\\n')"""


@dataclass(frozen=True)
class ActionPackage:
    """Where it is: the folder for includes and imports, and that of its libraries."""

    folder: Path
    libraries: Path


def action_package(distribution: str = "kilted") -> ActionPackage:
    """Made by the first test that asks, in seconds."""
    folder = build_once(f"action-{distribution}", lambda folder: _make(folder, ros2_prefix(distribution)))
    return ActionPackage(folder, folder / "lib")


def _make(folder: Path, prefix: Path) -> None:
    python = prefix / "bin" / "python"
    script = ROOT / "tests" / "tracing" / "generate_action.py"
    subprocess.run([python, script, folder], check=True, capture_output=True)
    asked = subprocess.run([python, "-c", _FACTS], check=True, capture_output=True, text=True)
    suffix, *paths = asked.stdout.splitlines()
    includes = [
        f"-I{path}"
        for path in (folder, folder / "introspection", prefix / "include", *(prefix / "include").iterdir(), *paths)
    ]
    libraries = folder / "lib"
    libraries.mkdir()
    compiling = ["gcc", "-w", "-shared", "-fPIC", "-Wl,--unresolved-symbols=ignore-all", *includes]
    linking = [f"-L{prefix / 'lib'}", "-lrosidl_runtime_c", "-lrosidl_typesupport_c", "-lfastcdr", "-lstdc++"]
    # One library under the names of all that are for C.
    kinds = ("generator_c", "typesupport_c", "typesupport_fastrtps_c", "typesupport_introspection_c")
    linking += [f"-l{package}__rosidl_{kind}" for package in _NEEDED for kind in kinds]
    code = folder / "fib"
    whole = libraries / "libfib__rosidl_generator_c.so"
    sources = [*folder.glob("**/action/detail/*.c*"), code / "action/fib__type_support.cpp"]
    subprocess.run([*compiling, *sources, "-o", whole, *linking], check=True)
    for kind in kinds[1:]:
        (libraries / f"libfib__rosidl_{kind}.so").symlink_to(whole.name)
    # The module for Python finds its functions in the interpreter.
    linking += [whole, *(f"-l{package}__rosidl_generator_py" for package in _NEEDED)]
    sources = [code / "action/_fib_s.c", code / "_fib_s.ep.rosidl_typesupport_c.c"]
    module = code / f"fib_s__rosidl_typesupport_c{suffix}"
    subprocess.run([*compiling, *sources, "-o", module, *linking], check=True)
