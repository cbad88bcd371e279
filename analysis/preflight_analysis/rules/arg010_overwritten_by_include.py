"""ARG010: an argument of a file that an include in it sets to another value (ROS 2)."""

from collections.abc import Iterator, Mapping

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.tree import LaunchTree, Use
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.syntax import Tags
from preflight_analysis.rules.further_reading import LARGE_PROJECTS, LAUNCH_DESIGN
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    tags = Tags(context.launch_files)
    below: Mapping[str, set[str]] | None = None
    own: dict[tuple[str, str], str | None] = {}
    said: set[Location] = set()
    # In the order in which they are evaluated.
    for use in filter(None, context.each(_of_argument, context.tree.uses)):
        file, key = use.location.file, (use.location.file, use.name)
        if use.kind == "declaration":
            own[key] = use.value
        if use.kind != "arg" or own.get(key) in (None, use.value):
            continue
        setter = use.origin[-1]
        if use.location in said:
            continue
        if setter.file == file:
            tag = tags.around(setter)
            passed = tag is not None and tag.action.kind == "arg" and bool(tag.above) and tag.above[0].kind == "include"
            what = "an include above passes it this value"
        else:
            below = below if below is not None else _below(context.tree)
            passed, what = setter.file in below.get(file, set()), "an included file sets it"
        if passed:
            said.add(use.location)
            yield rule.claim(
                f"argument '{use.name}' is overwritten with '{use.value}' (was '{own[key]}'): {what}, and it stays "
                "set after the include; put the <include> into a <group>",
                use.location,
                subject=Subject("argument", use.name),
                related=(Related("set here", setter),),
            )


def _of_argument(use: Use) -> Use | None:
    """The use itself, if it declares an argument or has the value of one."""
    reads = use.kind == "arg" and bool(use.origin) and use.value is not None
    return use if reads or use.kind == "declaration" else None


def _below(tree: LaunchTree) -> Mapping[str, set[str]]:
    """The files that each one includes, directly or further down."""
    found: dict[str, set[str]] = {}
    for include in tree.includes:
        if include.path is not None:
            for location in include.origin:
                found.setdefault(location.file, set()).add(include.path)
    return found


RULE = Rule(
    id="ARG010",
    name="overwritten-by-include",
    effect="misbehaves",
    kind="conflict",
    what="Checks for `$(var name)` where an earlier include has changed the value that this file gave the argument.",
    why="In ROS 2 an included file shares the launch configurations of its includer. A value that is passed or set "
    "there stays set after the include. Only a `<group>` around the include restores the old values.",
    example='<arg name="name" default="robot"/>\n'
    '<include file="$(find-pkg-share camera)/launch/camera.launch.xml">\n  <arg name="name" value="front"/>\n'
    '</include>\n<node pkg="drive" exec="base" name="$(var name)_base"/>',
    instead='<arg name="name" default="robot"/>\n<group>\n'
    '  <include file="$(find-pkg-share camera)/launch/camera.launch.xml">\n    <arg name="name" value="front"/>\n'
    '  </include>\n</group>\n<node pkg="drive" exec="base" name="$(var name)_base"/>',
    references=(
        LARGE_PROJECTS,
        LAUNCH_DESIGN,
    ),
    generations=(2,),
    check=_check,
)
