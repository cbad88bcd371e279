"""PKG005: a file of the source that the package does not install (ROS 2)."""

import os
from collections.abc import Iterator

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.span import Location
from preflight_analysis.edits import cmake
from preflight_analysis.edits.python import PythonWriter
from preflight_analysis.environment.installed_paths import installed_at, installed_from, installs_more, package_around
from preflight_analysis.environment.model import Package
from preflight_analysis.environment.packages import MANIFEST
from preflight_analysis.evaluation.tree import Use
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.launch.recognize import LAUNCH_SUFFIXES
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import fix
from preflight_analysis.rules.further_reading import FILE_SYSTEM, LARGE_PROJECTS
from preflight_analysis.rules.rule import Rule

_IN_PYTHON = ("get_package_share_directory", "get_package_share_path", "FindPackageShare")
"""A program may name the folder anywhere."""


_LAUNCH = "launch"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    disk, named = context.disk, set[str]()
    for use in filter(None, context.each(_of_file, context.tree.uses)):
        if not _by_share(context, use.location):
            continue
        # What stands at the place in the source is taken for what is there once it is installed.
        path = os.path.normpath(use.name)
        package = _package_of(context, path)
        if package is None:
            continue
        named.add(path)
        below, places = os.path.relpath(path, package.share), installed_at(disk, package, path)
        if below in places or installed_from(disk, package, below) is not None or installs_more(disk, package):
            continue
        about = Subject("file", path)
        message = f"file '{below}' is not installed in the share folder: {_build_file(package)} of '{package.name}' "
        if places:
            yield rule.claim(
                f"{message}installs it as '{places[0]}'", use.location, subject=about, candidates=places[:1]
            )
        else:
            fixes = _fixes(context, package, below)
            yield rule.claim(f"{message}does not list it", use.location, subject=about, fixes=fixes)
    for path, launch_file in context.launch_files.items():
        package = _package_of(context, path) if path not in named and launch_file.root is not None else None
        if package is None or launch_file.root is None:
            continue
        below = os.path.relpath(path, package.share)
        if (
            below.startswith(_LAUNCH + os.sep)
            and not installed_at(disk, package, path)
            and not installs_more(disk, package)
        ):
            # A copy that somebody put aside has more behind `.launch`, and build files that name patterns leave it.
            is_copy = ".launch" in os.path.basename(path) and not path.endswith(LAUNCH_SUFFIXES)
            yield rule.claim(
                f"launch file '{below}' is not installed by {_build_file(package)} of '{package.name}': "
                f"`ros2 launch {package.name} {os.path.basename(path)}` does not find it",
                context.location(path, launch_file.root.head_span),
                subject=Subject("file", path),
                doubts=doubts(SET_ASIDE=is_copy),
                fixes=_fixes(context, package, below),
            )


def _of_file(use: Use) -> Use | None:
    """The use itself, if it names a file that is there."""
    return use if use.kind in ("include", "file") and use.target is not None else None


def _package_of(context: Context, path: str) -> Package | None:
    """The package of ROS 2 in whose source the file is."""
    package = package_around(context.environment, path)
    if package is None or not package.is_ament or not path.startswith(package.share + os.sep):
        return None
    if any(context.disk.is_file(os.path.join(folder, MANIFEST)) for folder in _between(package.share, path)):
        return None  # a package within, which that build does not know
    return package if context.disk.is_file(path) else None


def _between(share: str, path: str) -> Iterator[str]:
    folder = os.path.dirname(path)
    while len(folder) > len(share):
        yield folder
        folder = os.path.dirname(folder)


def _build_file(package: Package) -> str:
    return "setup.py" if package.build_type == "ament_python" else "CMakeLists.txt"


def _by_share(context: Context, location: Location) -> bool:
    """Whether the path is that of a share folder: what is named beside the launch file is found in the source too."""
    document = context.documents.get(location.file)
    if document is None:
        return False
    if is_python(document.path, document.text):
        return "__file__" not in document.text and any(name in document.text for name in _IN_PYTHON)
    return "find-pkg-share" in document.text[location.span.start : location.span.end]


def _fixes(context: Context, package: Package, below: str) -> tuple[Fix, ...]:
    python = package.build_type == "ament_python"
    path = os.path.join(package.share, "setup.py" if python else "CMakeLists.txt")
    found = context.disk.text(path)
    if not isinstance(found, Document):
        return ()
    folder = os.path.dirname(below)
    if python:
        edits = PythonWriter(found).add_data_files(f"share/{os.path.join(package.name, folder)}", below)
    else:
        what = f"DIRECTORY {folder}" if folder else f"FILES {below}"
        edits = cmake.install(found, what, "share/${PROJECT_NAME}")
    return fix(f"Install '{below}' in {os.path.basename(path)}", edits, preferred=True)


RULE = Rule(
    id="PKG005",
    name="not-installed",
    effect="misbehaves",
    kind="absent",
    sometimes=(Reason.SET_ASIDE,),
    what="Checks for a launch or parameter file that the `setup.py` or `CMakeLists.txt` of its package does not "
    "install in the share folder. The launch refers to it there, or it is in the folder `launch`.",
    why="`ros2 launch` searches the share folder of the installed package. The file is not there.",
    example='<include file="$(find-pkg-share robot)/launch/base.launch.xml"/>\n'
    "<!-- setup.py: data_files=[('share/robot/config', glob('config/*'))] -->",
    instead="data_files=[('share/robot/config', glob('config/*')), ('share/robot/launch', glob('launch/*'))]",
    references=(
        FILE_SYSTEM,
        LARGE_PROJECTS,
    ),
    generations=(2,),
    check=_check,
    in_branches=True,
)
