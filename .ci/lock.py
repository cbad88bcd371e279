"""Pins what the VS Code extension installs the server with, and what builds a release: `make lock` writes
vscode-client/server-requirements.txt and packaging/build-requirements.txt.

Each file is named by its SHA-256, so that pip (`--require-hashes`) takes it and no other. Wheels for Linux alone: what
is built from source runs code that no digest covers. The resolution is uv's, for all Python versions and processors at
once; before anything is written it is tried for each of them.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).resolve().parents[1]
LOCKED = ROOT / "vscode-client/server-requirements.txt"
PYTHONS = ("3.10", "3.11", "3.12", "3.13", "3.14")
PLATFORMS = ("x86_64-manylinux_2_31", "aarch64-manylinux_2_31")
"""glibc 2.31 is that of Ubuntu 20.04, ROS 1's last."""
BUILD = ROOT / "packaging/build-requirements.txt"
HEADER = """\
# What {}, for pip's --require-hashes. `make lock` writes this file.
# Above each requirement stand the wheels that its hashes are of, in that order.
"""


def uv(*arguments: str) -> None:
    """Run uv with wheels alone, whatever the user's configuration of it says."""
    command = [str(Path(sys.executable).with_name("uv")), "pip", *arguments, "--no-config", "--only-binary", ":all:"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def resolved(folder: Path, *what: str) -> dict[str, Any]:
    """What is needed for that, for all Pythons and platforms, as a `pylock.toml` (PEP 751)."""
    lock = folder / "pylock.toml"
    how = ("--quiet", "--universal", "--python-version", PYTHONS[0], "--format", "pylock.toml")
    uv("compile", *how, "--output-file", str(lock), *what)
    return tomllib.loads(lock.read_text(encoding="utf-8"))


def requirement(package: dict[str, Any]) -> str:
    """The lines of one package."""
    named = {unquote(urlsplit(wheel["url"]).path).rpartition("/")[2]: wheel for wheel in package["wheels"]}
    wheels = {name: named[name] for name in sorted(named) if name.endswith("-any.whl") or "linux" in name}
    lines = [f"# {name}" for name in wheels]
    marker = f" ; {package['marker']}" if "marker" in package else ""
    hashes = [f"    --hash=sha256:{wheel['hashes']['sha256']}" for wheel in wheels.values()]
    return "\n".join([*lines, " \\\n".join([f"{package['name']}=={package['version']}{marker}", *hashes])]) + "\n"


def tried(requirements: Path, folder: Path) -> None:
    """Whether nothing is missing: an installation for each Python and platform, without installing."""
    for python in PYTHONS:
        for platform in PLATFORMS:
            for_it = ("--python-version", python, "--python-platform", platform, "--target", str(folder / "none"))
            uv("install", "--quiet", "--dry-run", "--require-hashes", *for_it, "--requirements", str(requirements))


def main() -> None:
    """Resolve, try, write."""
    project = str(ROOT / "pyproject.toml")
    for file, says, what in (
        (LOCKED, "the extension installs the server with", (project,)),
        (BUILD, "builds and uploads a release", ("--group", f"{project}:release")),
    ):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            made = folder / file.name
            packages = resolved(folder, *what)["packages"]
            made.write_text(HEADER.format(says) + "".join(map(requirement, packages)), encoding="utf-8")
            tried(made, folder)
            file.write_bytes(made.read_bytes())


if __name__ == "__main__":
    main()
