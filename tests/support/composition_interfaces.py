"""The service by which a container loads components, generated and compiled for C++: PyPI has none."""

from __future__ import annotations

import subprocess
from dataclasses import dataclass
from pathlib import Path

from support.build_once import build_once
from support.ros2_harness import ROOT, ros2_prefix

_NEEDED = ("rcl_interfaces", "service_msgs")


@dataclass(frozen=True)
class CompositionInterfaces:
    """Where it is: the folders for includes, and that of its libraries."""

    includes: tuple[Path, ...]
    libraries: Path


def composition_interfaces(distribution: str = "kilted") -> CompositionInterfaces:
    """Made by the first test that asks."""
    folder = build_once(f"composition-{distribution}", lambda folder: _make(folder, ros2_prefix(distribution)))
    return CompositionInterfaces(_includes(folder), folder / "lib")


def _includes(folder: Path) -> tuple[Path, ...]:
    return tuple(sorted(each for each in folder.iterdir() if each.name.startswith("rosidl_")))


def _make(folder: Path, prefix: Path) -> None:
    script = ROOT / "tests" / "tracing" / "generate_load_node.py"
    subprocess.run([prefix / "bin" / "python", script, folder], check=True, capture_output=True)
    includes = [f"-I{path}" for path in (*_includes(folder), prefix / "include", *(prefix / "include").iterdir())]
    libraries = folder / "lib"
    libraries.mkdir()
    linking = [f"-L{prefix / 'lib'}", "-lrosidl_runtime_c", "-lrosidl_typesupport_cpp", "-lfastcdr", "-lstdc++"]
    kinds = ("cpp", "fastrtps_cpp", "introspection_cpp")
    linking += [f"-l{package}__rosidl_typesupport_{kind}" for package in _NEEDED for kind in kinds]
    linking += [f"-l{package}__rosidl_generator_c" for package in _NEEDED]
    # One library under the names of all that are for C++.
    whole = libraries / "libcomposition_interfaces__rosidl_typesupport_cpp.so"
    sources = [*folder.glob("rosidl_*/**/*.c"), *folder.glob("rosidl_*/**/*.cpp")]
    compiling = ["gcc", "-w", "-shared", "-fPIC", "-Wl,--unresolved-symbols=ignore-all", *includes]
    subprocess.run([*compiling, *sources, "-o", whole, *linking], check=True)
    for kind in kinds[1:]:
        (libraries / f"libcomposition_interfaces__rosidl_typesupport_{kind}.so").symlink_to(whole.name)
