"""LCH029: a substitution that is none."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from itertools import chain

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document, SpannedText
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.documents.xml import without_comments
from preflight_analysis.edits.writer import writer_of
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix, Related
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.launch.problems import SubstitutionAsText
from preflight_analysis.launch.references import arg_references
from preflight_analysis.launch.substitutions import SUBSTITUTIONS, parse_value
from preflight_analysis.launch.substitutions_ros2 import SUBSTITUTIONS_ROS2
from preflight_analysis.model.arguments import declarations
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import fix, include_chain, problems_of, replacement
from preflight_analysis.model.syntax import Tags
from preflight_analysis.rules.further_reading import ANONYMOUS_NAMES, LAUNCH_SUBSTITUTIONS, ROSLAUNCH_ROSPARAM
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule

_COMMANDS = "|".join(map(re.escape, {**SUBSTITUTIONS, **SUBSTITUTIONS_ROS2}))
_SUBSTITUTION = re.compile(rf"\$\((?:{_COMMANDS})(?: [^()]*)?\)")
_ARGUMENT = re.compile(r"[\s\"',]+")
_LONGEST = 4096
_SOURCES = (".py", ".cpp", ".cc", ".h", ".hpp")
_MOST_SOURCES = 400
_LOOKED_FOR = r"\$\(find"
"""How a regular expression begins that looks for `$(find package)`."""
_FAR = 2000
"""How far behind its key a value is looked for."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, SubstitutionAsText):
        text, meant = problem.kind.text, problem.kind.meant
        place = problem.location
        exact = context.text(place) == text
        fixes = replacement(context, place, meant, f"Replace with '{meant}'") if exact else ()
        message = f"'{text}' is not a substitution; roslaunch treats it as literal text; did you mean '{meant}'?"
        yield problem_claim(
            rule, problem, message, subject=Subject("substitution", text), candidates=(meant,), fixes=fixes
        )
    of_tree = context.each(_left_in, context.tree.all_params)
    of_nodes = context.each(_left_in_node, context.tree.nodes)
    tags = Tags(context.launch_files)
    lost = {unknown.param for unknown in context.tree.unknowns if unknown.param is not None}
    for param, text in (*filter(None, of_tree), *chain.from_iterable(of_nodes)):
        if param.name not in lost:  # a `<param>` sets it again, to what is not known here
            yield from _not_made(rule, context, tags, param, text)


def _left_in_node(node: LaunchNode) -> tuple[tuple[Param, str], ...]:
    return tuple(filter(None, map(_left_in, node.params)))


def _left_in(param: Param) -> tuple[Param, str] | None:
    """The parameter with the first substitution that is still in its value or key, if there is one. The name may have
    one before the key: that of a namespace which is not known."""
    value = param.value
    texts = (names.leaf(param.name), *(value if isinstance(value, list) else (value,)))
    for text in texts:
        if not isinstance(text, str) or "$(" not in text or len(text) >= _LONGEST:
            continue
        if (found := _SUBSTITUTION.search(without_comments(text))) is not None:
            return param, found[0]
    return None


def _not_made(rule: Rule, context: Context, tags: Tags, param: Param, text: str) -> Iterator[Finding]:
    """What is said of a substitution in YAML that the launcher takes as it stands; nothing of other values, which are
    outputs of commands and contents of files."""
    ament = context.tree.ros.ament
    attribute, tag_name = ("allow_substs", "param") if ament else ("subst_value", "rosparam")
    # The last place in a launch file is that of the tag, or of its attribute that names the file.
    where = next((at for at in reversed(param.origin) if at.file in context.launch_files), None)
    tag = (tags.around(where) or tags.at(where)) if where is not None else None
    python = where is not None and context.launch_files[where.file].is_python
    if where is None or not (python or (tag is not None and tag.action.kind == tag_name)):
        return
    if tag is not None and tag.action.attribute("name" if ament else attribute) is not None:
        return  # a value in the launch file, or no substitutions on purpose
    document = context.documents.get(where.file)
    fixes: tuple[Fix, ...] = ()
    # Without the argument the launcher would refuse what it is told to replace.
    arg = next((name for name, _ in arg_references(parse_value(SpannedText(text, Span(0, len(text)))))), None)
    declared = {*declarations(context.launch_files[where.file]), *(context.tree.args if ament else ())}
    unknown = arg is not None and arg not in declared
    if tag is not None and not unknown and document is not None:
        edits = writer_of(document).set_attribute(tag.action, attribute, "true")
        fixes = fix(f'Add {attribute}="true" to the tag', edits, preferred=True)
    needed = f"ParameterFile(..., {attribute}=True)" if python else f'<{tag_name} {attribute}="true">'
    place = _place(context, param, text)
    idle = _is_of_idle_controller(context, param)
    own = None if idle or ament else _program_that_replaces(context, param)
    handed_on = not ament and _is_for_a_program_outside(context, param)
    related = (Related("the file is loaded here", where),) if place.file != where.file else ()
    yield rule.claim(
        f"'{text}' is treated as literal text; substitutions in YAML need {needed}"
        + ("; the launch file does not declare the argument" if unknown else "")
        + (f"; '{own}' of the package looks for such text itself" if own is not None else ""),
        place,
        subject=Subject("substitution", text),
        doubts=doubts(SHARED=idle, INTENDED=own is not None or handed_on, FROM_SOURCE=True),
        related=(*related, *include_chain((*param.origin[:-1], place))),
        fixes=fixes,
    )


def _is_of_idle_controller(context: Context, param: Param) -> bool:
    """Whether it configures a controller, or another plugin, that no node of the launch is told to start: a file of
    controllers is given to launch files that start one of them each."""
    section = param.name.rpartition("/")[0]
    while section:
        kind = context.tree.params.get(f"{section}/type")
        if kind is not None and isinstance(kind.value, str) and "/" in kind.value:
            name = names.leaf(section)
            words = {word for node in context.tree.nodes for word in _ARGUMENT.split(node.args)}
            return not any(word == name or "$" in word for word in words)
        section = section.rpartition("/")[0]
    return False


def _program_that_replaces(context: Context, param: Param) -> str | None:
    """A source of the package of the node that gets the parameter which looks for substitutions itself, with an
    expression for them."""
    node = next((node for node in context.tree.nodes if param.name.startswith(f"{node.name}/")), None)
    package = context.environment.packages.get(node.package) if node is not None else None
    if package is None or context.environment.is_installed(package):
        return None
    return _source_with(context.disk.db, package.share)


def _is_for_a_program_outside(context: Context, param: Param) -> bool:
    """Whether it is a command line that no node of the launch gets as its own: what reads it may start a launcher."""
    several = isinstance(param.value, str) and " --" in param.value
    return several and not any(param.name.startswith(f"{node.name}/") for node in context.tree.nodes)


@query
def _source_with(db: Database, folder: str) -> str | None:
    disk = Disk(db)
    sources = [path for path in files_in(disk, folder, deep=True) if path.endswith(_SOURCES)]
    for path in sources[:_MOST_SOURCES]:
        document = disk.text(path)
        if isinstance(document, Document) and _LOOKED_FOR in document.text:
            return os.path.basename(path)
    return None


def _place(context: Context, param: Param, text: str) -> Location:
    """The substitution itself, which stands near the key; else the key."""
    key = param.place
    document = context.documents.get(key.file)
    start = document.text.find(text, key.span.start, key.span.end + _FAR) if document is not None else -1
    return context.location(key.file, Span(start, start + len(text))) if start >= 0 else key


RULE = Rule(
    id="LCH029",
    name="substitution-as-text",
    effect="misbehaves",
    kind="invalid",
    sometimes=(Reason.SHARED, Reason.INTENDED, Reason.FROM_SOURCE),
    what="Checks for text that looks like a substitution and is none. It also checks substitutions in YAML without "
    "`subst_value` (ROS 1), and in parameter files without `allow_substs` (ROS 2).",
    why="`roslaunch` replaces only the form `$(arg name)` and treats everything else as literal text. The topic or "
    "file is then named `$(arg name`. In YAML both launchers replace substitutions only on request.",
    example='<param name="port" value="${arg port}"/>\n<rosparam>rate: $(arg rate)</rosparam>',
    instead='<param name="port" value="$(arg port)"/>\n<rosparam subst_value="true">rate: $(arg rate)</rosparam>',
    references=(
        ANONYMOUS_NAMES,
        ROSLAUNCH_ROSPARAM,
        LAUNCH_SUBSTITUTIONS,
    ),
    check=_check,
    problems=(SubstitutionAsText,),
)
