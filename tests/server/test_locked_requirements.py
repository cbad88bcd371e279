"""What the extension installs is pinned, as pyproject.toml is now, for every Python and processor."""

from __future__ import annotations

import re
from importlib.metadata import PackageNotFoundError, distribution
from itertools import chain
from pathlib import Path
from typing import NamedTuple

import pytest
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet
from packaging.tags import Tag, compatible_tags, cpython_tags
from packaging.utils import canonicalize_name, parse_wheel_filename

try:
    import tomllib
except ImportError:
    import tomli as tomllib

ROOT = Path(__file__).parents[2]
LOCKED = ROOT / "vscode-client/server-requirements.txt"
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
MINORS = [minor for minor in range(40) if f"3.{minor}" in SpecifierSet(PROJECT["requires-python"])]
PROCESSORS = ("x86_64", "aarch64")
OLDEST_GLIBC = 31
"""That of Ubuntu 20.04, ROS 1's last."""


class Pin(NamedTuple):
    requirement: Requirement
    wheels: tuple[str, ...]
    hashes: tuple[str, ...]

    @property
    def name(self) -> str:
        return canonicalize_name(self.requirement.name)

    @property
    def version(self) -> str:
        return str(self.requirement.specifier).removeprefix("==")


def read(text: str) -> list[Pin]:
    pins, wheels = [], []
    for line in text.replace("\\\n", "").splitlines():
        if line.startswith("# ") and line.endswith(".whl"):
            wheels.append(line.removeprefix("# "))
        elif line and not line.startswith("#"):
            requirement, *hashes = line.split("--hash=sha256:")
            pins.append(Pin(Requirement(requirement), tuple(wheels), tuple(each.strip() for each in hashes)))
            wheels = []
    return pins


PINS = read(LOCKED.read_text(encoding="utf-8"))


def environment(minor: int, processor: str) -> dict[str, str]:
    return {
        "python_version": f"3.{minor}",
        "python_full_version": f"3.{minor}.2",
        "platform_machine": processor,
        "sys_platform": "linux",
        "platform_system": "Linux",
        "os_name": "posix",
        "implementation_name": "cpython",
        "platform_python_implementation": "CPython",
    }


def applies(requirement: Requirement, minor: int, processor: str) -> bool:
    return requirement.marker is None or requirement.marker.evaluate(environment(minor, processor))


def tags(minor: int, processor: str) -> set[Tag]:
    platforms = [f"manylinux_2_{glibc}_{processor}" for glibc in range(OLDEST_GLIBC, 16, -1)]
    platforms += [f"manylinux2014_{processor}", f"linux_{processor}"]
    python = (3, minor)
    return {*cpython_tags(python, platforms=platforms), *compatible_tags(python, f"cp3{minor}", platforms)}


@pytest.mark.parametrize("processor", PROCESSORS)
@pytest.mark.parametrize("minor", MINORS)
def test_all_that_the_server_needs_is_pinned_to_a_wheel(minor: int, processor: str) -> None:
    pinned = {pin.name: pin for pin in PINS if applies(pin.requirement, minor, processor)}
    assert len(pinned) == sum(applies(pin.requirement, minor, processor) for pin in PINS), "two of one name"
    for needed in map(Requirement, PROJECT["dependencies"]):
        if applies(needed, minor, processor):
            pin = pinned.get(canonicalize_name(needed.name))
            assert pin is not None, f"{needed}: run make lock"
            assert needed.specifier.contains(pin.version), f"{needed} is pinned to {pin.version}: run make lock"
    fitting = tags(minor, processor)
    for pin in pinned.values():
        assert any(fitting & parse_wheel_filename(wheel)[3] for wheel in pin.wheels), f"{pin.name} has no wheel"
        # And what it needs in turn, where this very version is installed here and can be asked.
        try:
            installed = distribution(pin.name)
        except PackageNotFoundError:
            continue
        for needed in map(Requirement, (installed.requires or []) if installed.version == pin.version else []):
            if applies(needed, minor, processor):
                assert canonicalize_name(needed.name) in pinned, f"{needed}, which {pin.name} needs: run make lock"


def test_each_wheel_has_its_hash_and_no_other_file_has_one() -> None:
    for pin in PINS:
        assert len(pin.hashes) == len(pin.wheels) > 0
        assert all(re.fullmatch("[0-9a-f]{64}", digest) for digest in pin.hashes)
        for wheel in pin.wheels:
            name, version, _, _ = parse_wheel_filename(wheel)
            assert (name, str(version)) == (pin.name, pin.version)
    assert len({*chain.from_iterable(pin.hashes for pin in PINS)}) == sum(len(pin.hashes) for pin in PINS)


def test_the_lock_is_tried_for_the_pythons_of_the_project() -> None:
    script = (ROOT / ".ci/lock.py").read_text(encoding="utf-8")
    (pythons,) = re.findall(r"^PYTHONS = \((.*)\)$", script, re.MULTILINE)
    assert re.findall(r"3\.(\d+)", pythons) == [str(minor) for minor in MINORS]


def test_a_line_of_the_lock_is_read() -> None:
    (pin,) = read("# made\n# a_b-1.0-py3-none-any.whl\na-b==1.0 ; python_version < '3.11' \\\n    --hash=sha256:00\n")
    assert (pin.name, pin.version, pin.wheels, pin.hashes) == ("a-b", "1.0", ("a_b-1.0-py3-none-any.whl",), ("00",))
