"""LCH013: an include, or a launch by a process, of a file that is not there."""

import re
from collections.abc import Iterator, Sequence

from preflight_analysis.catalogue.launches import launch_files_of
from preflight_analysis.evaluation.problems import IncludeNotCatalogued, IncludeNotFound, LaunchedFileNotFound
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.model.catalogued import catalogue_doubts, is_of_distribution
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import is_slip, nearest, nearest_slip
from preflight_analysis.model.problems import problems_of, rename
from preflight_analysis.rules.further_reading import LARGE_PROJECTS, ROSLAUNCH_INCLUDE
from preflight_analysis.rules.missing_files import check_missing_files
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule

_check_here = check_missing_files({IncludeNotFound: "included file", LaunchedFileNotFound: "launched file"})

_MARK = re.compile(r"(?:[._]launch)?(?:\.\w+)?\Z")


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from _check_here(rule, context)
    for problem in problems_of(context, IncludeNotCatalogued):
        file = problem.kind
        folder, _, name = file.below.rpartition("/")
        known = (each.rpartition("/") for each in launch_files_of(file.package, file.distro))
        near = _near(name, [other for where, _, other in known if where == folder])
        if near is None:
            continue  # it may have been added, or taken away, by another version
        same = is_of_distribution(context, file.distro)
        fixes: tuple[Fix, ...] = rename(context, problem.location, name, near, preferred=same)
        message = f"package '{file.package}' of {file.distro} has no launch file '{file.below}'; did you mean '{near}'?"
        yield problem_claim(
            rule,
            problem,
            message,
            subject=Subject("file", f"{file.package}/{file.below}"),
            kind="near",
            doubts=(*catalogue_doubts(context, file.distro), *doubts(UNSEEN=True)),
            candidates=(near,),
            fixes=fixes,
        )


def _near(name: str, others: Sequence[str]) -> str | None:
    """The one that a name is a slip of, whatever marks it as a launch file."""
    near = nearest(name, others, key=_stem)
    if near is not None and (_stem(name) == _stem(near) or is_slip(_stem(name), _stem(near))):
        return near
    return nearest_slip(name, others)  # `camera_lanch.py`


def _stem(name: str) -> str:
    return _MARK.sub("", name)


RULE = Rule(
    id="LCH013",
    name="include-not-found",
    effect="stops-launch",
    kind="absent",
    sometimes=(
        "misbehaves",
        Reason.NOT_HERE,
        Reason.NOT_SET,
        Reason.MADE_ELSEWHERE,
        Reason.ON_ROBOT,
        Reason.WHERE_STARTED,
        Reason.PARTLY_READ,
        Reason.OTHER_DISTRIBUTION,
        Reason.UNSEEN,
    ),
    what="Checks for an `<include>` of a file that does not exist, and for a process that launches one (`ros2 launch "
    "PACKAGE FILE`). The catalogue knows the launch files of common packages that are not installed.",
    why="`roslaunch` stops and starts nothing, at any depth of includes. A relative path starts at the folder in "
    "which `roslaunch` runs, not at the folder of the file.",
    example='<include file="$(find camera)/launch/camrea.launch"/>',
    instead='<include file="$(find camera)/launch/camera.launch"/>',
    references=(
        ROSLAUNCH_INCLUDE,
        LARGE_PROJECTS,
    ),
    check=_check,
    problems=(IncludeNotFound, LaunchedFileNotFound, IncludeNotCatalogued),
    in_branches=True,
)
