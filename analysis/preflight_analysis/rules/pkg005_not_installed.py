"""PKG005: a file of the source that the package does not install (ROS 2)."""

import os
from collections.abc import Iterator

from preflight_analysis.documents.document import Document
from preflight_analysis.edits import cmake
from preflight_analysis.edits.python import PythonWriter
from preflight_analysis.evaluation.tree import Use
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.launch.recognize import LAUNCH_SUFFIXES
from preflight_analysis.model.context import Context
from preflight_analysis.model.installation import Installation, installation, named_installation
from preflight_analysis.model.problems import fix
from preflight_analysis.rules.further_reading import FILE_SYSTEM, LARGE_PROJECTS
from preflight_analysis.rules.rule import Rule

_LAUNCH = "launch"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    named = set[str]()
    for use in filter(None, context.each(_of_file, context.tree.uses)):
        found = named_installation(context, use)
        if found is None:
            continue
        path = os.path.normpath(use.name)
        named.add(path)
        if found.problem:
            fixes = _fixes(context, found) if not found.places else ()
            about = Subject("file", path)
            yield rule.claim(found.problem, use.location, subject=about, candidates=found.places[:1], fixes=fixes)
    for path, launch_file in context.launch_files.items():
        found = installation(context, path) if path not in named and launch_file.root is not None else None
        if found is None or launch_file.root is None:
            continue
        if found.below.startswith(_LAUNCH + os.sep) and found.state == "nowhere":
            # A copy that somebody put aside has more behind `.launch`, and build files that name patterns leave it.
            is_copy = ".launch" in os.path.basename(path) and not path.endswith(LAUNCH_SUFFIXES)
            name = found.package.name
            yield rule.claim(
                f"launch file '{found.below}' is not installed by {found.build_file} of '{name}': "
                f"`ros2 launch {name} {os.path.basename(path)}` does not find it",
                context.location(path, launch_file.root.head_span),
                subject=Subject("file", path),
                doubts=doubts(SET_ASIDE=is_copy),
                fixes=_fixes(context, found),
            )


def _of_file(use: Use) -> Use | None:
    """The use itself, if it names a file that is there."""
    return use if use.kind in ("include", "file") and use.target is not None else None


def _fixes(context: Context, lost: Installation) -> tuple[Fix, ...]:
    package, below = lost.package, lost.below
    found = context.disk.text(os.path.join(package.share, lost.build_file))
    if not isinstance(found, Document):
        return ()
    folder = os.path.dirname(below)
    if lost.build_file == "setup.py":
        edits = PythonWriter(found).add_data_files(f"share/{os.path.join(package.name, folder)}", below)
    else:
        what = f"DIRECTORY {folder}" if folder else f"FILES {below}"
        edits = cmake.install(found, what, "share/${PROJECT_NAME}")
    return fix(f"Install '{below}' in {lost.build_file}", edits, preferred=True)


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
