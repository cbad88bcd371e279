"""Builds everything that a release consists of into `dist/`: `make release`. It publishes nothing.

- `ros_preflight-V.tar.gz`: the sources.
- `ros_preflight-V-py3-none-any.whl`: for all processors, without compiled libraries.
- `ros_preflight-V-py3-none-manylinux_2_24_x86_64.whl`, `..._aarch64.whl`: with the libraries that are preloaded into
  nodes in C++, for one processor each.
- `ros-preflight-V.vsix`: the VS Code extension, with the server for all platforms.
- `ros-preflight-V.cdx.json`: what the extension installs the server with, as CycloneDX (SBOM).
- `CHANGES.md`: the section of the version in CHANGELOG.md.
- `SHA256SUMS`: of all of them.

`--dry-run` does the same for a version that is not released yet; without it the version has to have its date in the
changelog, a tag of its own on a clean checkout, and the address of the repository may not be a placeholder.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import venv
import zipfile
from collections.abc import Iterable, Iterator
from pathlib import Path

import apply  # beside this file
import pin
from apply import Project

ROOT = Path(__file__).resolve().parents[1]
DIST = ROOT / "dist"
MACHINES = ("x86_64", "aarch64")
"""The processors that have libraries, as `tracing/preload_compile.py` names them."""
MANYLINUX = "manylinux_2_24"
"""glibc 2.24 and the C++ library of GCC 6, which is what the libraries ask for; `auditwheel show` is the judge."""
_LIBRARIES = ("roscpp_preload", "rcl_preload")
_ELF_MACHINE = {"x86_64": b"\x3e\x00", "aarch64": b"\xb7\x00"}
"""`e_machine` of the ELF header: EM_X86_64 and EM_AARCH64 of elf.h."""
_PLACEHOLDER = "/OWNER/"


class NotReady(SystemExit):
    """Why there is no release; ends the command with 1."""


def run(*command: str | Path, **variables: str) -> str:
    """Run a command in the repository; its standard output."""
    done = subprocess.run(
        [str(word) for word in command],
        cwd=ROOT,
        env={**os.environ, **variables},
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    return done.stdout


def project() -> Project:
    """Version and address. Raises `NotReady` where files state others."""
    stale = [path for path, was, now in apply.written(apply.project()) if was != now]
    if stale:
        raise NotReady(f"run `make docs` first: {', '.join(str(path.relative_to(ROOT)) for path in stale)}")
    return apply.project()


def changes(version: str, text: str) -> tuple[str, str]:
    """What stands behind the version in its heading of the changelog, and the section without the heading."""
    found = re.search(rf"(?ms)^## {re.escape(version)} \(([^)]*)\)\n(.*?)(?=^## |\Z)", text)
    if found is None:
        raise NotReady(f"CHANGELOG.md has no section '## {version} (date)'")
    return found[1], found[2].strip() + "\n"


def check_ready(known: Project, date: str) -> None:
    """Raise `NotReady` for what a release may not have."""
    tags = run("git", "tag", "--points-at", "HEAD").split()
    reasons = [
        *(["the address in packaging/project.toml is a placeholder"] if _PLACEHOLDER in known.repository else []),
        *([] if re.fullmatch(r"\d{4}-\d\d-\d\d", date) else [f"CHANGELOG.md has '{date}' instead of a date"]),
        *([] if f"v{known.version}" in tags else [f"the commit has no tag v{known.version}"]),
        *(f"{each} is named by a tag: run `make pin`" for each in pin.all_by_tag()),
        *(["there are uncommitted changes"] if run("git", "status", "--porcelain") else []),
    ]
    if reasons:
        raise NotReady("no release: " + "; ".join(reasons))


def build(known: Project) -> None:
    """Write sdist, wheels, extension and SBOM into `dist/`."""
    shutil.rmtree(DIST, ignore_errors=True)
    DIST.mkdir()
    # The same bytes whenever it is built.
    epoch = run("git", "log", "-1", "--format=%ct").strip()
    hatch = (sys.executable, "-m", "hatchling", "build", "-d", DIST)
    run(*hatch, "-t", "sdist", SOURCE_DATE_EPOCH=epoch)
    for prebuilt in ("0", *(f"{MANYLINUX}_{machine}" for machine in MACHINES)):
        run(*hatch, "-t", "wheel", SOURCE_DATE_EPOCH=epoch, ROS_PREFLIGHT_PREBUILT=prebuilt)
    vsix = ("make", "--no-print-directory", "vsix", f"BUILD={sys.executable}")
    run(*vsix, SOURCE_DATE_EPOCH=epoch, ROS_PREFLIGHT_PREBUILT="1")
    shutil.copyfile(ROOT / "out/ros-preflight.vsix", DIST / f"ros-preflight-{known.version}.vsix")
    sbom = DIST / f"ros-preflight-{known.version}.cdx.json"
    tool = Path(sys.executable).with_name("cyclonedx-py")
    pinned = ROOT / "vscode-client/server-requirements.txt"
    options = ("--output-reproducible", "--of", "JSON", "--output-file", sbom)
    run(tool, "requirements", "--pyproject", ROOT / "pyproject.toml", *options, pinned)


def inspect(known: Project) -> None:
    """Look into what was built, and use it: the pure wheel in an environment of its own. Raises `NotReady`."""
    (sdist,) = DIST.glob("*.tar.gz")
    with tarfile.open(sdist) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    wanted = {"pyproject.toml", "LICENSE", "README.md", "action.yml", "analysis/hatch_build.py"}
    _require(wanted <= names, f"{sdist.name} lacks {wanted - names}")
    for wheel in DIST.glob("*.whl"):
        with zipfile.ZipFile(wheel) as files:
            check_libraries(wheel.name, files, [machine for machine in MACHINES if wheel.stem.endswith(f"_{machine}")])
    with zipfile.ZipFile(DIST / f"ros-preflight-{known.version}.vsix") as files:
        inside = [name for name in files.namelist() if name.endswith(".whl")]
        _require(len(inside) == 1, f"the extension has {inside}")
        with files.open(inside[0]) as wheel_inside, zipfile.ZipFile(wheel_inside) as wheel_files:
            check_libraries(inside[0], wheel_files, MACHINES)
    (pure,) = DIST.glob("*-py3-none-any.whl")
    with tempfile.TemporaryDirectory() as folder:
        venv.create(folder, with_pip=True)
        python = Path(folder, "bin/python")
        install = (python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check")
        run(*install, "--require-hashes", "--requirement", ROOT / "vscode-client/server-requirements.txt")
        run(*install, "--no-deps", pure)
        said = run(Path(folder, "bin/ros-preflight"), "--version").strip()
        _require(said == f"ros-preflight {known.version}", f"the installed wheel says {said}")
        demo = ROOT / "fixtures/ros1/demo/launch/fixed.launch"
        run(Path(folder, "bin/ros-preflight"), "check", "--no-run", demo)


def check_libraries(name: str, files: zipfile.ZipFile, machines: Iterable[str]) -> None:
    """Raise `NotReady` where the libraries of a wheel are not those of these processors, by their ELF headers."""
    expected = {f"{library}.{machine}.so": machine for library in _LIBRARIES for machine in machines}
    found = {Path(path).name: files.read(path) for path in files.namelist() if path.endswith(".so")}
    _require(found.keys() == expected.keys(), f"{name} has {sorted(found)}")
    for library, machine in expected.items():
        _require(found[library][18:20] == _ELF_MACHINE[machine], f"{library} of {name} is not for {machine}")


def _require(condition: bool, why: str) -> None:
    if not condition:
        raise NotReady(why)


def checksums() -> Iterator[str]:
    """The lines of SHA256SUMS."""
    for path in sorted(DIST.iterdir()):
        yield f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n"


def main() -> None:
    """Build and check."""
    parser = argparse.ArgumentParser(description="Build everything that a release consists of into dist/.")
    parser.add_argument("--dry-run", action="store_true", help="build also what may not be released yet")
    args = parser.parse_args()
    known = project()
    date, section = changes(known.version, (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"))
    if not args.dry_run:
        check_ready(known, date)
    build(known)
    inspect(known)
    (DIST / "CHANGES.md").write_text(section, encoding="utf-8")
    (DIST / "SHA256SUMS").write_text("".join(checksums()), encoding="utf-8")
    for path in sorted(DIST.iterdir()):
        print(f"{path.stat().st_size:>10}  {path.name}")


if __name__ == "__main__":
    main()
