"""What a reader wants to know of the thing under the cursor, as Markdown."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from preflight_analysis.documents.span import Origin
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import (
    Command,
    CommandValue,
    Include,
    LaunchNode,
    NotTaken,
    ParamValue,
    Remap,
    Use,
)
from preflight_analysis.findings.markdown import block, code, escaped
from preflight_analysis.graph.model import ChannelKind, Connection, Graph
from preflight_analysis.graph.tf_frames import frames_of
from preflight_analysis.launch.model import NODE_KINDS, Action
from preflight_analysis.model.installation import named_installation
from preflight_analysis.model.lifecycle import inactive
from preflight_analysis.model.lost_files import lost_files
from preflight_analysis.model.reach import notes
from preflight_analysis.queries.arguments import accepted
from preflight_analysis.queries.bridges import bridge_hover
from preflight_analysis.queries.frames import frame_hover
from preflight_analysis.queries.handed_over import hover_in, is_handed_over
from preflight_analysis.queries.hover_symbols import argument_notes, symbol_hover
from preflight_analysis.queries.hover_text import Hover
from preflight_analysis.queries.language import described
from preflight_analysis.queries.param_files import in_param_file, is_param_file, values_in_param_file
from preflight_analysis.queries.param_texts import default_text, value_text
from preflight_analysis.queries.places import (
    action_at,
    include_of,
    link,
    nodes_around,
    nodes_of,
    params_of,
    passed_at,
    place,
    remaps_of,
    shown_path,
    use_at,
    uses_at,
)
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.queries.symbol_at import remaps_at
from preflight_analysis.tracing.interface import NOT_RUN, Endpoint, Frame, Interface, ParamUse
from preflight_analysis.workspace.workspace import Analysis

_SHOWN_CONTEXTS = 3
"""A tag of a file that is included often makes many nodes; the first few say enough."""
_SHOWN_PARAMS = 40
_SHOWN_FRAMES = 40
_SHOWN_LINES = 12
_SHOWN_COLUMNS = 160
_SHOWN_ROOTS = 8
_SHOWN_VALUES = 4
_SHOWN_QOS = ("reliability", "durability")
_SHOWN_ENDPOINTS = 8
_SHOWN_NOTES = 4
_OF_ONE_RUN = (re.compile(r", kept from an earlier run"), re.compile(r" after \d+\.\d+ s(?=\.)"))
"""What two runs of the same node differ in."""

_OF_THE_TAG = ("value", "executable", "include", "node")
"""Uses of which the tag around them tells more."""
_SET_PARAMETERS = ("param", "rosparam", "set_parameter", "set_parameters_from_file")

_SOURCES = {
    "trace": "from a run in the sandbox",
    "annotation": "from the annotation in the launch file",
    "settings": "from the settings file",
    "nodl": "from its NoDL document",
    "source": "from its source code",
    "similar": "from a run of the same executable elsewhere",
    "catalogue": "from the catalogue",
}
_OUTCOMES = {
    "spinning": "reached its event loop",
    "exited": "ended by itself",
    "crashed": "crashed",
    "timed-out": "did not reach its event loop in time",
    "not-run": "was not run",
}
_SIDES: tuple[tuple[ChannelKind, tuple[str, str]], ...] = (
    ("topics", ("Publishers", "Subscribers")),
    ("services", ("Service servers", "Service clients")),
    ("actions", ("Action servers", "Action clients")),
)


def hover(
    analyses: Sequence[Analysis], file: str, offset: int, unseen: int = 0, context: QueryContext | None = None
) -> Hover | None:
    """What is known of the thing at `offset`, in the first of the roots in which there is something to say, what it
    comes to in each where that is not the same, and what the language says of a tag or attribute whose name is there.

    None where there is nothing to say. `unseen` is how many more roots there are that reach the file. With a `context`
    what other files say of a parameter, a package or an argument is there too.
    """
    known = next((a.launch_files[file] for a in analyses if file in a.launch_files), None)
    if (passed := passed_at(known, offset)) is not None:
        said = hover(analyses, file, passed.written, unseen, context)
        return Hover(said.markdown, passed.span) if said is not None else None
    left_out: NotTaken | None = None
    if context is not None:
        context, left_out = context.taking(offset)
        analyses = context.analyses
    if is_handed_over(analyses, file):
        return hover_in(analyses, file, offset)
    if (frame := frame_hover(analyses, file, offset)) is not None:
        return frame
    if (bridge := bridge_hover(analyses, file, offset)) is not None:
        return bridge
    if analyses and is_param_file(analyses[0], file):
        found = in_param_file(analyses, file, offset)
        contexts = _contexts(analyses, file, offset, unseen) if found is not None else ""
        return Hover(f"{found.markdown}\n\n{contexts}", found.span) if found is not None and contexts else found
    symbol = symbol_hover(context, offset) if context is not None else None
    found = symbol or next((h for a in analyses if (h := _known(a, file, offset)) is not None), None)
    notes = argument_notes(context, offset) if context is not None and found is not None else ""
    if found is not None and context is not None and left_out is not None and symbol is None:
        found = Hover(f"{found.markdown}\n\n{_left_out(context, left_out)}", found.span)
    if found is not None and notes:
        found = Hover(f"{found.markdown}\n\n{notes}", found.span)
    contexts = _contexts(analyses, file, offset, unseen) if found else ""
    if found is not None and contexts:
        found = Hover(f"{found.markdown}\n\n{contexts}", found.span)
    if found is not None and (problem := _not_installed(analyses, file, offset)):
        found = Hover(f"{found.markdown}\n\n{escaped(problem)}", found.span)
    launch_file = next((a.launch_files[file] for a in analyses if file in a.launch_files), None)
    language = described(launch_file, offset) if launch_file is not None else None
    if language is None:
        return found
    if found is None:
        return Hover(*language)
    return Hover(f"{found.markdown}\n\n---\n\n{language[0]}", found.span)


def _not_installed(analyses: Sequence[Analysis], file: str, offset: int) -> str:
    """Why a file that is named here will not be in the share folder; "" where it will, or may."""
    uses = ((analysis, use) for analysis in analyses for use in uses_at(analysis.tree, file, offset))
    found = (named_installation(analysis.context, use) for analysis, use in uses)
    problem = next((each.problem for each in found if each is not None and each.problem), "")
    return f"{problem[:1].upper()}{problem[1:]}" if problem else ""


def _left_out(context: QueryContext, tag: NotTaken) -> str:
    condition = f"condition {code(' '.join(context.text(tag.place).split()))} (`{tag.condition}`)"
    if tag.value is None:
        return f"It is not known whether this launch takes it: {condition} is not known"
    return f"Left out of this launch: {condition} is {escaped(tag.value.strip())}"


def _known(analysis: Analysis, file: str, offset: int) -> Hover | None:
    use = use_at(analysis.tree, file, offset)
    action = _tag_at(analysis, file, offset)
    if use is not None and use.kind not in _OF_THE_TAG:
        return Hover(_use(analysis, use), use.location.span)
    if (found := _remap_in_python(analysis, file, offset)) is not None:
        return found
    blocks = list(_action(analysis, file, action)) if action is not None else []
    if blocks and action is not None:
        return Hover("\n\n---\n\n".join(blocks), action.head_span)
    if use is not None:
        return Hover(_use(analysis, use), use.location.span)
    return None


def _tag_at(analysis: Analysis, file: str, offset: int) -> Action | None:
    """The innermost tag around `offset`. Of a Python file that was run the nodes are known better than by its text."""
    launch_file = analysis.launch_files.get(file)
    action = action_at(launch_file, offset) if launch_file else None
    if launch_file is not None and launch_file.is_python:
        made = [node.action for node in nodes_around(analysis.tree, file, offset)]
        return min(filter(None, (action, *made)), key=lambda each: each.span.end - each.span.start, default=None)
    return action


def _remap_in_python(analysis: Analysis, file: str, offset: int) -> Hover | None:
    """Of a remap in a Python file, which has no tag."""
    launch_file = analysis.launch_files.get(file)
    if launch_file is None or not launch_file.is_python:
        return None
    for node in analysis.tree.nodes:
        for remap in node.remaps:
            for location in (remap.source_location, remap.target_location):
                if location.file == file and location.span.contains(offset):
                    return Hover(_remap(analysis, remaps_at(analysis.tree, location)), location.span)
    return None


def _contexts(analyses: Sequence[Analysis], file: str, offset: int, unseen: int) -> str:
    """What the thing comes to, and in which roots; nothing where it is the same in all."""
    known = [(analysis, found) for analysis in analyses if (found := _values(analysis, file, offset))]
    common = frozenset.intersection(*(frozenset(found) for _, found in known)) if known else frozenset[str]()
    roots: dict[tuple[str, ...], list[str]] = {}
    for analysis, found in known:
        one = _is_of_use(analysis, file, offset)
        differing = tuple(value for value in found if one or value not in common)
        if differing:
            roots.setdefault(differing, []).append(_root(analysis))
    if not roots or (len(roots) == 1 and len(known) == len(next(iter(roots.values()))) and len(next(iter(roots))) == 1):
        return ""
    lines, left = ["By launch:"], _SHOWN_ROOTS
    for values, launches in roots.items():
        more = [f"… and {len(values) - _SHOWN_VALUES} more"] if len(values) > _SHOWN_VALUES else []
        if shown := launches[:left]:
            lines.append(f"- {', '.join((*values[:_SHOWN_VALUES], *more))} in {', '.join(code(n) for n in shown)}")
        left -= len(shown)
    if hidden := unseen + sum(map(len, roots.values())) - (_SHOWN_ROOTS - left):
        lines.append(f"- … and {hidden} more")
    return "\n".join(lines)


def _root(analysis: Analysis) -> str:
    path = shown_path(analysis.root, analysis.environment.workspace)
    return " ".join((path, *(f"{name}:={value}" for name, value in analysis.args)))


def _values(analysis: Analysis, file: str, offset: int) -> tuple[str, ...]:
    """What the thing at `offset` comes to in one root, once for each context in which its file is included."""
    if is_param_file(analysis, file):
        return values_in_param_file(analysis, file, offset)
    uses = uses_at(analysis.tree, file, offset)
    if _is_of_use(analysis, file, offset):
        uses = [u for u in uses if u.location == uses[0].location and u.kind == uses[0].kind]
        return tuple(dict.fromkeys(value_text(use.value) for use in uses))
    action = _tag_at(analysis, file, offset)
    return tuple(dict.fromkeys(_made(analysis, file, action))) if action else ()


def _is_of_use(analysis: Analysis, file: str, offset: int) -> bool:
    """Whether the hover speaks of a name in a value, not of what the tag around it makes."""
    if is_param_file(analysis, file):
        return True
    use = use_at(analysis.tree, file, offset)
    if use is None or use.kind not in _OF_THE_TAG:
        return use is not None
    action = _tag_at(analysis, file, offset)
    return action is None or not any(_made(analysis, file, action))


def _made(analysis: Analysis, file: str, action: Action) -> Iterator[str]:
    if action.kind in NODE_KINDS:
        yield from (code(node.name) for _, node in nodes_of(analysis, file, action))
    elif action.kind == "include":
        for include in analysis.tree.includes:
            if include.origin[-1].file == file and include.origin[-1].span == action.head_span:
                given = (" " + code(f"{name}:={value}") for name, value in include.args.items())
                yield f"{code(include.path or 'unresolved')}{''.join(given)}"
    elif action.kind in _SET_PARAMETERS:
        yield from (f"{code(p.name)} = {value_text(p.value)}" for p in params_of(analysis.tree, file, action))
    elif action.kind in ("remap", "set_remap"):
        for node, remap in remaps_of(analysis.tree, file, action):
            yield f"{code(names.resolve(remap.source, node.name))} → {code(names.resolve(remap.target, node.name))}"


def _action(analysis: Analysis, file: str, action: Action) -> Iterator[str]:
    """One block of text for each thing that the tag makes."""
    if action.kind in NODE_KINDS:
        yield from _nodes(analysis, list(nodes_of(analysis, file, action)))
    elif action.kind == "include":
        include = include_of(analysis.tree, file, action)
        if include is not None:
            yield _include(analysis, include)
    elif action.kind in _SET_PARAMETERS:
        params = list(params_of(analysis.tree, file, action))
        lines = [f"- {code(p.name)} = {value_text(p.value)} ({_type(p.value)})" for p in params[:_SHOWN_PARAMS]]
        if len(params) > _SHOWN_PARAMS:
            lines.append(f"- … and {len(params) - _SHOWN_PARAMS} more")
        if lines:
            yield "\n".join(["Sets", *lines])
        made = [
            c
            for c in analysis.tree.commands
            if not c.launch_file and c.location.file == file and action.head_span.contains(c.location.span.start)
        ]
        yield from dict.fromkeys(_command(command) for command in made[:_SHOWN_CONTEXTS])
    elif action.kind in ("remap", "set_remap"):
        text = _remap(analysis, remaps_of(analysis.tree, file, action))
        if text:
            yield text


def _nodes(analysis: Analysis, nodes: Sequence[tuple[int, LaunchNode]]) -> Iterator[str]:
    """The nodes of one tag. Of those that are alike but for their namespace all but the first are only named."""
    blocks: dict[str, tuple[str, list[LaunchNode]]] = {}
    for index, node in nodes:
        body = _node_body(analysis, index, node)
        _, alike = blocks.setdefault(_without_namespace(body, node), (_node_title(analysis, node) + body, []))
        alike.append(node)
    for text, alike in list(blocks.values())[:_SHOWN_CONTEXTS]:
        more = [f"- {code(node.name)}, {_chain(analysis, node.origin)}" for node in alike[1 : 1 + _SHOWN_CONTEXTS]]
        if len(alike) - 1 > len(more):
            more.append(f"- … and {len(alike) - 1 - len(more)} more")
        yield "\n".join([text, "", "Likewise:", *more]) if more else text
    if len(blocks) > _SHOWN_CONTEXTS:
        hidden = sum(len(alike) for _, alike in list(blocks.values())[_SHOWN_CONTEXTS:])
        yield f"… and {hidden} more nodes of this tag"


def _without_namespace(text: str, node: LaunchNode) -> str:
    """A text of a node without what differs in the same node of another namespace."""
    for pattern in _OF_ONE_RUN:
        text = pattern.sub("", text)
    above = names.parent(node.name)
    return text.replace(above, "\0/") if above != "/" else text


def _include(analysis: Analysis, include: Include) -> str:
    """The file and its arguments: those that are given, then those that keep their defaults."""
    if include.path is None:
        written = analysis.context.text(include.file_location)
        return f"Unresolved include{f': {code(written)}' if written else ''}"
    lines = [f"Includes {link(include.path, None)}", "", code(include.path)]
    launch_file = analysis.launch_files.get(include.path)
    declared = {each.name: each for each in accepted(launch_file)} if launch_file is not None else {}
    shown = []
    for name, value in include.args.items():
        known = declared.pop(name, None)
        doc = _doc(known.doc if known is not None else None)
        shown.append(f"- {code(name)} = {value_text(value)}, given{doc}")
    for each in declared.values():
        state = "required, not given" if each.required else f"{value_text(each.default or '')}, default"
        shown.append(f"- {code(each.name)}{': ' if each.required else ' = '}{state}{_doc(each.doc)}")
    more = [f"- … and {len(shown) - _SHOWN_PARAMS} more"] if len(shown) > _SHOWN_PARAMS else []
    return "\n".join([*lines, *(["", "Arguments"] if shown else []), *shown[:_SHOWN_PARAMS], *more])


def _doc(text: str | None) -> str:
    return f" — {escaped(text)}" if text else ""


def _command(command: Command) -> str:
    """What a command printed, or why that is not known."""
    result = command.result
    if result is None:
        return f"{code(command.line)} is not run yet"
    if result.status == "not-run":
        return f"{code(command.line)} was not run: {escaped(result.reason or '')}"
    if result.status == "done":
        said, lines = "printed", result.output.splitlines()
    else:
        said, lines = f"failed: {escaped(result.reason or '')}", list(result.stderr_tail)
    shown = [line[:_SHOWN_COLUMNS] for line in lines[:_SHOWN_LINES]]
    if len(lines) > len(shown):
        shown.append(f"… and {len(lines) - len(shown)} more lines")
    language = "xml" if lines and lines[0].startswith("<") else "text"
    return f"{code(command.line)} {said}\n\n{block(shown, language)}"


def _remap(analysis: Analysis, reached: Iterable[tuple[LaunchNode, Remap]]) -> str:
    """What a remap does to the nodes that it reaches: for the first robot with both sides of the new name."""
    named = (((names.resolve(r.source, n.name), names.resolve(r.target, n.name)), n.name) for n, r in reached)
    groups = list(_grouped(named))
    lines: list[str] = []
    for number, ((source, target), nodes) in enumerate(groups[: 1 + _SHOWN_CONTEXTS]):
        lines += ["", "Likewise:"] if number == 1 else []
        shown = f"{code(source)} → {code(target)} for {', '.join(code(n) for n in nodes)}"
        lines.append(f"- {shown}" if number else shown)
        if not number and analysis.graph is not None:
            lines += _connections(analysis, analysis.graph, target)
    if len(groups) > 1 + _SHOWN_CONTEXTS:
        lines.append(f"- … and {len(groups) - 1 - _SHOWN_CONTEXTS} more")
    return "\n".join(lines)


def _grouped(pairs: Iterable[tuple[tuple[str, str], str]]) -> Iterator[tuple[tuple[str, str], list[str]]]:
    groups: dict[tuple[str, str], list[str]] = {}
    for key, member in pairs:
        groups.setdefault(key, []).append(member)
    yield from groups.items()


def _connections(analysis: Analysis, graph: Graph, name: str) -> Iterator[str]:
    """Both sides of a topic, service or action: who is there, with type, QoS and the line of the source."""
    kinds: tuple[tuple[str, ChannelKind], ...] = (("topic", "topics"), ("service", "services"), ("action", "actions"))
    found = ((kind, of_kind, channel) for kind, of_kind in kinds for channel in graph.named(of_kind, name))
    for kind, of_kind, channel in found:
        ends = ("publisher", "subscriber") if kind == "topic" else ("server", "client")
        shown = f"{kind} {code(name)}" + (f" ({code(channel.domain)})" if channel.domain else "")
        yield from (f"- {shown}: {escaped(each)}" for each in notes(analysis.context, of_kind, channel)[:_SHOWN_NOTES])
        for end, connections in zip(ends, (channel.providers, channel.consumers), strict=True):
            for connection in sorted(connections, key=lambda each: each.node.name)[:_SHOWN_ENDPOINTS]:
                endpoint = connection.endpoint
                kind_of = f" {code(endpoint.type)}" if endpoint.type else ""
                more = f"{kind_of}{_quality(endpoint)}{_made_at(endpoint)}"
                yield f"- {shown}: {end} {code(connection.node.name)}{more}"
            if len(connections) > _SHOWN_ENDPOINTS:
                yield f"- … and {len(connections) - _SHOWN_ENDPOINTS} more"


def _quality(endpoint: Endpoint) -> str:
    text = ", latched" if endpoint.qos.get("latch") else ""
    return text + "".join(
        f", {escaped(str(endpoint.qos[each]).replace('_', ' '))}" for each in _SHOWN_QOS if endpoint.qos.get(each)
    )


def _use(analysis: Analysis, use: Use) -> str:
    value = value_text(use.value)
    if use.kind in ("arg", "argument", "declaration"):
        text = f"argument {code(use.name)} = {value}"
    elif use.kind == "find":
        text = f"package {code(use.name)}: {value}"
    elif use.kind == "env":
        text = f"environment variable {code(use.name)} = {value}"
    elif use.kind == "clear_params":
        text = f"deletes the parameters below {value} before the launch sets parameters"
    else:
        text = f"{code(use.name)} = {value}" if use.name else value
    chain = _chain(analysis, use.origin)
    return f"{text}\n\n{chain}" if chain else text


def _chain(analysis: Analysis, origin: Origin) -> str:
    """Where a value comes from, the place itself first, then the includes outwards."""
    if not origin:
        return ""
    *includes, last = origin
    steps = [f"given at {place(analysis, last)}"]
    steps += [f"included at {place(analysis, step)}" for step in reversed(includes)]
    return ", ".join(steps)


def _node_title(analysis: Analysis, node: LaunchNode) -> str:
    title = f"**{escaped(node.name)}** {code(f'{node.package}/{node.executable}')}"
    if node.resolved.path:
        title += f" — {link(node.resolved.path, None)}"
    return f"{title}\n\n{_chain(analysis, node.origin)}" if len(node.origin) > 1 else title


def _node_body(analysis: Analysis, index: int, node: LaunchNode) -> str:
    """All but the title of a node, beginning with an empty line."""
    graph = analysis.graph
    interface = graph.processes[index] if graph is not None else None
    lines = ["", "", _outcome(analysis, interface)]
    if (lost := inactive(analysis.context, node)) is not None:
        lines += ["", f"The lifecycle node {escaped(lost.reason)}"]
    if interface is not None and graph is not None and interface.known:
        of_process = [each for each in graph.tree.nodes if each.origin is node.origin]
        for kind, titles in _SIDES:
            for side, title in enumerate(titles):
                ends = [end for each in of_process for end in graph.ends_of(each, kind)[side]]
                if ends:
                    lines += ["", title, *(_connection(c, interface) for c in sorted(ends, key=lambda c: c.name))]
        reads = [p for p in interface.params if not p.builtin]
        if reads and not analysis.tree.ros.own_parameters:
            lines += ["", "Parameters", *(_read(analysis, graph, node, p) for p in reads[:_SHOWN_PARAMS])]
        lines += [f"\n{escaped(note)}" for note in interface.notes]
        if node.launch_prefix and interface.source == "trace":
            lines += [f"\nRun without its `launch-prefix` {code(node.launch_prefix)}"]
    if analysis.tree.ros.own_parameters:
        lines += _own_params(analysis, node, interface or NOT_RUN)
        lines += _lost_files(analysis, node)
    frames = frames_of(node, interface or NOT_RUN)
    if frames:
        lines += ["", "Broadcasts", *map(_frame, frames[:_SHOWN_FRAMES])]
        if len(frames) > _SHOWN_FRAMES:
            lines.append(f"- … and {len(frames) - _SHOWN_FRAMES} more")
    for unknown in node.unknowns:
        lines += ["", f"Unresolved: {escaped(unknown.what)} ({escaped(unknown.reason)})"]
    return "\n".join(lines)


def _outcome(analysis: Analysis, interface: Interface | None) -> str:
    if interface is None or interface.source == "none":
        reason = interface.outcome.reason if interface is not None else None
        reason = reason or analysis.why_not_run
        return f"Unknown interface: {escaped(reason)}" if reason else "Interface not analysed yet"
    source = _SOURCES.get(interface.source, interface.source) + _elsewhere(analysis, interface)
    outcome = interface.outcome
    if outcome.status == "not-run":
        return f"Interface {source}" + (f"; not run: {escaped(outcome.reason)}" if outcome.reason else "")
    ending = f" with exit code {outcome.exit_code}" if outcome.exit_code else ""
    ending += f" ({outcome.signal})" if outcome.signal else ""
    how = f"{_OUTCOMES[outcome.status].capitalize()}{ending}"
    cached = ", cached" if interface.cached else ""
    lines = [f"Interface {source}{cached}. {how} after {outcome.seconds:.2f} s."]
    if outcome.status != "spinning" and outcome.reason:
        lines.append(escaped(outcome.reason))
    if outcome.status == "crashed" and outcome.stderr_tail:
        lines.append(block(outcome.stderr_tail))
    return "\n\n".join(lines)


def _elsewhere(analysis: Analysis, interface: Interface) -> str:
    """Which run a similar trace is of."""
    run = interface.elsewhere
    if run is None:
        return ""
    where = f" in {code(shown_path(run.launch, analysis.environment.workspace))}" if run.launch else ""
    changed = ", before the executable changed" if run.changed else ""
    return f", that of {code(run.node)}{where}{changed}"


def _frame(frame: Frame) -> str:
    return f"- frame {code(frame.child)} in {code(frame.parent)}" + (", static" if frame.static else "")


def _made_at(what: Endpoint | ParamUse) -> str:
    return f" — {link(what.source_file, what.source_line)}" if what.source_file else ""


def _connection(connection: Connection, interface: Interface) -> str:
    endpoint = connection.endpoint
    text = f"- {code(connection.name)}"
    if endpoint.type:
        text += f" {code(endpoint.type)}"
    if connection.remap is not None:
        text += f", remapped from {code(endpoint.name)}"
    if endpoint.named_by is not None and endpoint.named_by.display:
        text += f", of the display {code(endpoint.named_by.display)}"
    elif endpoint.named_by is not None:
        text += f", named by the parameter {code(endpoint.named_by.parameter)}"
    text += _quality(endpoint)
    if "made-up answer" in endpoint.evidence.doubts:
        text += ", after a mock reply"
    if "on demand" in endpoint.evidence.doubts:
        text += ", on demand"
    if endpoint.evidence.source == "similar":
        text += ", seen in another run"
    return text + _made_at(endpoint)


def _own_params(analysis: Analysis, node: LaunchNode, interface: Interface) -> list[str]:
    """What a ROS 2 node gets and from where, then what else it declares."""
    declared = {u.name.removeprefix("~"): u for u in interface.params if not u.builtin and u.access != "set"}
    lines: list[str] = []
    for param in node.params:
        use = declared.pop(param.name, None)
        text = f"- {code(param.name)} = {value_text(param.value)} from {place(analysis, param.origin[-1])}"
        if param.overrides:
            text += f", overrides {value_text(param.overrides[-1].value)}"
        if use is not None and (default := default_text(use)):
            text += f" ({default})"
        lines.append(text)
    lines += [f"- {code(name)}: {default_text(use)}{_made_at(use)}" for name, use in declared.items()]
    more = [f"- … and {len(lines) - _SHOWN_PARAMS} more"] if len(lines) > _SHOWN_PARAMS else []
    return ["", "Parameters", *lines[:_SHOWN_PARAMS], *more] if lines else []


def _lost_files(analysis: Analysis, node: LaunchNode) -> Iterator[str]:
    """The parameter files that a node gets and that have nothing for it."""
    for lost in lost_files(analysis.context):
        if lost.getter.node is node:
            yield f"\n{code(shown_path(lost.used.path, analysis.environment.workspace))}: {escaped(lost.reason)}"


def _read(analysis: Analysis, graph: Graph, node: LaunchNode, use: ParamUse) -> str:
    full = next((r.name for r in graph.param_reads if r.node is node and r.use == use), use.name)
    param = analysis.tree.params.get(full)
    if param is not None:
        text = f"- {code(full)} = {value_text(param.value)}"
    elif use.access in ("set", "delete"):
        text = f"- {code(full)} is {use.access} by the node"
    else:
        text = f"- {code(full)} is not set"
    if use.has_default:
        text += f", default {value_text(use.default)}"
    elif use.mandatory:
        text += ", no default"
    return text + _made_at(use)


def _type(value: ParamValue) -> str:
    return "output of a command" if isinstance(value, CommandValue) else type(value).__name__
