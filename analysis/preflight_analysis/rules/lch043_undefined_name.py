"""LCH043: a name that nothing in a Python launch file defines (ROS 2)."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.span import Span
from preflight_analysis.edits.python import PythonWriter
from preflight_analysis.evaluation.problems import PythonException
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean
from preflight_analysis.model.problems import fix, problems_of
from preflight_analysis.model.undefined_names import undefined_names
from preflight_analysis.rules.further_reading import FORMATS
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    # Where the run came to it, its exception says it.
    raised = {problem.location.file for problem in problems_of(context, PythonException)}
    for path, launch_file in context.launch_files.items():
        for name, near, span, called in _names(launch_file) if path not in raised else ():
            edits = PythonWriter(launch_file.document).rename_names(name, near) if near is not None else ()
            yield rule.claim(
                f"undefined name '{name}'; this line raises a NameError{did_you_mean(near)}",
                context.location(path, span),
                subject=Subject("name", name),
                kind="absent" if near is None else "near",
                effect=None if called else "note",
                candidates=(near,),
                fixes=fix(f"Replace '{name}' with '{near}'", edits, preferred=True),
            )


def _names(launch_file: LaunchFile) -> tuple[tuple[str, str | None, Span, bool], ...]:
    return undefined_names(launch_file.document) if launch_file.is_python else ()


RULE = Rule(
    id="LCH043",
    name="undefined-name",
    effect="stops-launch",
    kind="absent",
    always=(Reason.FROM_SOURCE,),
    sometimes=("note",),
    what="Checks for a name in a Python launch file that the file does not define, import or take as an argument. "
    "Files that import `*` or create names at run time are not checked.",
    why="Python raises a NameError only when it executes the line. The launch fails for users who set the argument "
    "that leads there.",
    example="def setup(context):\n    gz_paused = LaunchConfiguration('paused').perform(context)\n"
    "    return simulation(world, paused)",
    instead="def setup(context):\n    gz_paused = LaunchConfiguration('paused').perform(context)\n"
    "    return simulation(world, gz_paused)",
    references=(FORMATS,),
    generations=(2,),
    check=_check,
)
