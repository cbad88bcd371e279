"""TRC001: a node crashed when it was run."""

import re
from collections.abc import Iterator
from dataclasses import replace
from itertools import compress

from preflight_analysis.documents.document import SpannedText
from preflight_analysis.documents.span import Span
from preflight_analysis.environment.git_ignored import is_ignored
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.partial_text import is_whole
from preflight_analysis.evaluation.ros2.unknown_text import is_unknown
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.claim import Subject, Text, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.lack import Lack
from preflight_analysis.graph.model import Graph, ParamRead
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Substitution
from preflight_analysis.launch.references import first_word
from preflight_analysis.launch.substitutions import parse_value
from preflight_analysis.model.asked_variables import lack_of_asked
from preflight_analysis.model.context import Context
from preflight_analysis.model.elsewhere import absent_top_said, lacks_recording, paths_said
from preflight_analysis.model.files import is_template
from preflight_analysis.model.installed import (
    lack_of_made,
    lack_of_own_file,
    lack_of_python,
    lack_of_submodule_said,
    lack_said,
)
from preflight_analysis.model.missing_params import missing_params
from preflight_analysis.model.problems import include_chain
from preflight_analysis.model.python_imports import absent_module
from preflight_analysis.model.said import (
    asks_for_input,
    cause_of,
    is_of_called,
    killed_program,
    lacks_param,
    missing_module,
    missing_name,
    shows_conflict,
    words_of,
)
from preflight_analysis.model.well_known import describes_robot, is_for_tools
from preflight_analysis.rules.further_reading import RUNS, SECURITY
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.interface import REASON_COLUMNS, Interface, Outcome, ParamUse, telling_line
from preflight_analysis.tracing.request import split_args

_TEMPORARY = re.compile(r"(?<![\w/.])/(?:var/)?tmp/[\w.+-]+(?![\w.+/-])")
"""A file right in the folder for temporary ones, which another program writes before."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if context.graph is None:
        return
    processes = context.graph.processes
    failures = context.each(_failed, processes)
    for node, interface in compress(zip(context.tree.nodes, processes, strict=True), failures):
        outcome, lost = interface.outcome, _lost_params(context)
        # After a mock reply of ours, or without a value that we did not compute, the crash may be our own doing.
        reads = [read for read in context.graph.param_reads if read.node is node]
        lacking = next(filter(None, map(lost.why, reads)), None)
        lacking = lacking or next((why for read in reads if (why := lost.possible_cause(read, outcome))), None)
        told = f"{outcome.reason or ''}\n{telling_line(outcome.stderr_tail)}"
        if _lacks_own_module(context, node, told):
            continue  # PKG009 says it
        lacking = lacking or lost.named_in(told) or _unresolved_param(node, told)
        # Of a parameter that is missing another rule says more, as a warning.
        reported = any(missing.died is not None for missing in missing_params(context).get(id(node), ()))
        reported = reported or any(_is_reported(context.graph, node, use) for use in interface.params)
        sandbox = (
            outcome.lacks is not None
            or bool(outcome.answers)
            or _is_of_another_program(outcome)
            or _is_of_two_modules(context, telling_line(outcome.stderr_tail))
            or is_of_called(telling_line(outcome.stderr_tail))
            or any("made-up answer" in e.evidence.doubts for e in interface.endpoints)
            or node.kind == "test"
        )
        absent = absent_top_said(context.disk, told)
        made = (
            is_template(told)
            or _TEMPORARY.search(told) is not None
            or _gets_temporary_file(context, node, told)
            or lacks_recording(told)
            or any(is_ignored(context.disk, path) for path in paths_said(told))
        )
        empty = _empty_param(node, told) or _empty_argument(context, node, told)
        beside = f"; it reads {lacking}" if lacking else ""
        beside += f"; {empty} is empty" if empty is not None else ""
        beside += f"; this machine has no '{absent}'" if absent else ""
        found = rule.claim(
            _message(node.name, outcome, beside),
            node.location,
            subject=Subject("node", node.name),
            doubts=doubts(
                SANDBOX=node.name if sandbox else "",
                PARTLY_READ=lacking or "$(" in node.args or is_unknown(node.args),
                NOT_SET=empty,
                ON_ROBOT=absent,
                MADE_ELSEWHERE=made,
                INTENDED=_waits(node, outcome),
                EXPLAINED=reported,
            ),
            related=include_chain(node.origin),
            lack=_lack(context, node, outcome),
        )
        yield replace(found, crash_of=node.name) if reported else found


def _lacks_own_module(context: Context, node: LaunchNode, told: str) -> bool:
    """Whether the node ends for a module that a package of the workspace does not have."""
    module, path = missing_module(told), node.resolved.path
    return module is not None and path is not None and absent_module(context, path, module) is not None


def _lack(context: Context, node: LaunchNode, outcome: Outcome) -> Lack | None:
    if (made := next(filter(None, (lack_of_made(context, word) for word in _paths_of(node))), None)) is not None:
        return made
    telling = telling_line(outcome.stderr_tail)
    for path in paths_said(f"{outcome.reason or ''}\n{telling}"):
        if (made := lack_of_made(context, path)) is not None:
            return made
        if (own := lack_of_own_file(context, path)) is not None:
            return own
    said = lack_said(context, (outcome.reason or "", telling))
    said = said or lack_of_python(context, telling, outcome.stderr_tail)
    said = said or next(filter(None, (_lack_of_value(context, param) for param in node.params)), None)
    return said or lack_of_submodule_said(context, node.package or "", f"{outcome.reason or ''}\n{telling}")


def _lack_of_value(context: Context, param: Param) -> Lack | None:
    """The environment variable that a parameter has its value of, which is empty as that is not set."""
    if param.value != "":
        return None
    files = dict.fromkeys(place.file for place in param.origin)
    return next(filter(None, (lack_of_asked(context, file, names.leaf(param.name)) for file in files)), None)


def _is_of_another_program(outcome: Outcome) -> bool:
    """Whether a shell script says that a signal killed a program that it started, which is not of the project: in the
    sandbox a browser or a window may end so."""
    return "/" not in (killed_program(telling_line(outcome.stderr_tail)) or "/")


def _empty_param(node: LaunchNode, told: str) -> str | None:
    """The parameter that the node names before it ends, and which is empty until somebody gives it a value."""
    words = words_of(told)
    empty = (param.name for param in node.params if param.value == "" and names.leaf(param.name) in words)
    return next((f"parameter '{name}'" for name in empty), None)


def _unresolved_param(node: LaunchNode, told: str) -> str | None:
    """`'x', which is unresolved` of a parameter in the node's own tag that has no value here, as nobody gave the
    argument that it is made of, or only a part of it is known, and which the node names before it ends."""
    words, known = words_of(told), {names.leaf(param.name) for param in node.params}
    for param in node.params:
        if param.name in words and not is_whole(param.value):
            return f"'{param.name}', which is unresolved"
    pending = [*node.action.children]
    while pending:
        action = pending.pop()
        pending += action.children
        name = action.value("name") if action.kind == "param" else None
        if name is not None and name.text in words and name.text not in known:
            return f"'{name.text}', which is unresolved"
    return None


def _empty_argument(context: Context, node: LaunchNode, told: str) -> str | None:
    """The argument of the launch file that stands in the node's command line and is empty until somebody gives it a
    value, of a node that ends for a file or an argument."""
    span = node.tag.span_of("args")
    written = context.text(context.location(node.location.file, span)) if span is not None else ""
    if "$(arg" not in written or not asks_for_input(told):
        return None
    parts = parse_value(SpannedText(written, Span(0, len(written)))).parts
    named = [first_word(part)[0] for part in parts if isinstance(part, Substitution) and part.command == "arg"]
    is_argument = [isinstance(part, Substitution) and part.command == "arg" for part in parts]
    pattern = "".join("(.*?)" if yes else re.escape(part.text) for part, yes in zip(parts, is_argument, strict=True))
    found = re.fullmatch(pattern, node.args, re.DOTALL)
    given = zip(named, found.groups(), strict=True) if found is not None else ()
    return next((f"argument '{name}'" for name, value in given if not value.strip()), None)


def _gets_temporary_file(context: Context, node: LaunchNode, told: str) -> bool:
    """Whether the node ends for a file, and gets one in the folder for temporary ones that is not there: the launch
    file or another program writes it before."""
    given = (word for word in _paths_of(node) if _TEMPORARY.fullmatch(word) is not None)
    return asks_for_input(told) and any(not context.disk.exists(word) for word in given)


def _is_of_two_modules(context: Context, telling: str) -> bool:
    """Whether a name was not found in a module of which two packages of the workspace have one: which of them is
    imported is decided by the order in which they are built."""
    found = missing_name(telling)
    if found is None:
        return False
    module = f"src/{found.module.partition('.')[0]}"
    return sum(context.disk.is_folder(f"{each.share}/{module}") for each in context.environment.packages.values()) > 1


def _waits(node: LaunchNode, outcome: Outcome) -> bool:
    """Whether the node is started again and again until another has set the parameter that it misses."""
    return node.respawn and "parameter" in telling_line(outcome.stderr_tail)


def _paths_of(node: LaunchNode) -> tuple[str, ...]:
    return tuple(word for word in split_args(node.args) if word.startswith("/")) if "/" in node.args else ()


def _failed(interface: Interface) -> bool:
    outcome = interface.outcome
    return outcome.status == "crashed" or (outcome.status == "exited" and outcome.exit_code not in (None, 0))


class _LostParams:
    """Parameters that the launch file sets to a value that is not known here: of those that are, a crash tells less
    than the finding at the value does."""

    def __init__(self, context: Context) -> None:
        tree = context.tree
        self._reasons = {u.param.rstrip("/"): u.reason for u in tree.unknowns if u.param is not None}
        self._commands = {p.name for p in tree.params.values() if not is_whole(p.value)}
        self._commands |= {c.param for c in tree.commands if c.result is None}
        self._set = tree.params.keys() - self._commands
        self._leaves = {names.leaf(name) for name in tree.params}
        self._complete = tree.complete

    def why(self, read: ParamRead) -> str | None:
        """`'/x', which has no value: ...` of one that is lost, None of any other."""
        if read.name in self._commands:
            return f"'{read.name}', whose command has no result"
        if read.name in self._set:
            return None
        for lost, reason in self._reasons.items():
            full = f"{read.node.name}/{lost[1:]}" if names.is_private(lost) else lost
            leaf = names.leaf(full)
            below = f"{read.name}/".startswith(f"{full}/")
            # A search looks for it in every namespace around the node.
            found = read.use.access == "search" and read.use.name.strip("~/") == leaf
            if below or found:
                return f"'{read.name}', which is unresolved: {reason}"
        return None

    def named_in(self, told: str) -> str | None:
        """The same of one that the node names at its end, whatever it was seen to read."""
        words = words_of(told)
        for name in (*self._reasons, *sorted(self._commands)):
            if names.leaf(name) in words and "_" in names.leaf(name) and name not in self._set:
                return f"'{name}', which is unresolved"
        unset = not self._complete and lacks_param(told)
        return "a parameter, which an unresolved part of the launch may set" if unset else None

    def possible_cause(self, read: ParamRead, outcome: Outcome) -> str | None:
        """The same of one that nobody sets and of which the node complained at its end, where something else may set
        it: an include of a package that is not here, or a launch that is started beside this one, which has the
        description of the robot."""
        if read.name in self._set or read.use.has_default:
            return None
        # The process has the name to which a remap leads, and what it says before it ends is its own.
        node = read.node
        remapped = (each.source for each in node.remaps if names.resolve(each.target, node.name) == read.name)
        written = (read.name, *remapped)
        known = any(is_for_tools(name) or describes_robot(name) for name in written)
        beside = known and names.leaf(read.name) not in self._leaves
        if self._complete and not beside:
            return None
        told = words_of("\n".join((outcome.reason or "", *outcome.stderr_tail)))
        said = not told.isdisjoint(map(names.leaf, written))
        setter = "another launch" if self._complete else "an unresolved part of the launch"
        return f"'{read.name}', which {setter} may set" if said else None


@derived
def _lost_params(context: Context) -> _LostParams:
    return _LostParams(context)


def _is_reported(graph: Graph, node: LaunchNode, use: ParamUse) -> bool:
    """Whether a node of ROS 2 ended for the parameter and another rule tells it: not where no value of the launch is at
    fault."""
    if use.refused is None or use.mandatory:
        return use.refused is not None
    in_process = (each for each in graph.tree.nodes if each.origin is node.origin)
    return any(f"~{param.name}" == use.name for each in in_process for param in each.params)


def _message(name: str, outcome: Outcome, beside: str) -> Text:
    """What is said of a crash, quoted from the first of it that the node says itself."""
    does, said = "crashes on start: ", ""
    if outcome.lacks:
        code = f" with exit code {outcome.exit_code}" if outcome.exit_code is not None else ""
        does = f"needs {outcome.lacks}; it exited{code}"
    elif outcome.reason:
        said = cause_of(outcome.reason)
    elif outcome.signal:
        does += f"killed by {outcome.signal}"
    else:
        does += f"exit code {outcome.exit_code}"
    telling = telling_line(outcome.stderr_tail)[:REASON_COLUMNS]
    if telling and telling not in f"{name} {does}{said}":
        said += f"; {telling}"
    conflict = telling.startswith("SyntaxError") and shows_conflict(outcome.stderr_tail)
    said += "; its source has marks of a merge conflict" if conflict else ""
    return say("{node} {does}{quoted}{beside}", node=name, does=does, quoted=said, beside=beside)


RULE = Rule(
    id="TRC001",
    name="node-crashed",
    effect="stops-node",
    kind="invalid",
    always=(Reason.UNSEEN,),
    sometimes=(
        Reason.SANDBOX,
        Reason.PARTLY_READ,
        Reason.NOT_SET,
        Reason.ON_ROBOT,
        Reason.MADE_ELSEWHERE,
        Reason.INTENDED,
        Reason.EXPLAINED,
        Reason.NOT_HERE,
    ),
    what="Checks for a node that exits with an error before its event loop. The finding quotes the line of its "
    "standard error that gives the cause.",
    why="With these parameters and arguments the node most likely exits on the robot too. What it does "
    "later is unknown.",
    example='<param name="model" value="/home/me/model.json"/> <!-- FileNotFoundError -->',
    instead='<param name="model" value="$(find my_package)/config/model.json"/>',
    references=(
        RUNS,
        SECURITY,
    ),
    settings=("nodes",),
    check=_check,
    needs_graph=True,
)
