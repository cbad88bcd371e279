"""What stands at a place of a parameter file of ROS 2: the nodes that a section is for, the parameters that they
declare."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation.ros2.param_files import FileParam
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.markdown import code, escaped
from preflight_analysis.launch.recognize import is_yaml
from preflight_analysis.model.declared_params import declared_params, undeclared
from preflight_analysis.model.nearest import did_you_mean
from preflight_analysis.model.plugin_params import declared_of_plugins
from preflight_analysis.model.refused_files import refusals
from preflight_analysis.model.sections import Getter, SectionUse, param_file
from preflight_analysis.queries.hover_text import Hover
from preflight_analysis.queries.param_texts import default_text, type_text, value_text
from preflight_analysis.queries.places import link, place
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.queries.references import made_at
from preflight_analysis.tracing.interface import NOT_RUN, Evidence, Interface, ParamUse
from preflight_analysis.workspace.workspace import Analysis

_SHOWN_NODES = 8
_SHOWN_REFUSALS = 3


@dataclass(frozen=True, slots=True)
class Reader:
    """A node that gets a parameter file."""

    node: LaunchNode
    interface: Interface

    def declared(self, name: str) -> ParamUse | None:
        """How the node declares a parameter."""
        return next((use for use in self.interface.params if use.name.removeprefix("~") == name), None)


def is_param_file(analysis: Analysis, path: str) -> bool:
    """Whether the launch reads that file for its parameters."""
    return analysis.tree.ros.own_parameters and is_yaml(path) and path not in analysis.launch_files


def readers(analysis: Analysis, path: str) -> tuple[Reader, ...]:
    """The nodes that get a parameter file, whether a section of it is for them or not."""
    used = param_file(analysis.context, path)
    return readers_of(analysis, used.getters) if used is not None else ()


def readers_of(analysis: Analysis, getters: Iterable[Getter]) -> tuple[Reader, ...]:
    """Nodes that get a file, with what is known of each."""
    graph = analysis.graph
    pairs = zip(graph.tree.nodes, graph.interfaces, strict=True) if graph is not None else ()
    known = {node.name: (node, interface) for node, interface in pairs}
    found = (known.get(each.name, (each.node._replace(name=each.name), NOT_RUN)) for each in getters)
    return tuple(Reader(node, _with_plugins(analysis, node, interface)) for node, interface in found)


def _with_plugins(analysis: Analysis, node: LaunchNode, interface: Interface) -> Interface:
    """The interface with what the plugins declare that the node loads, as far as they are known."""
    declared = declared_of_plugins({param.name: param.value for param in node.params}, analysis.context.plugins)
    if not declared:
        return interface
    known = {use.name.removeprefix("~") for use in interface.params}
    uses = (
        ParamUse(name, "get", default, default is not None, evidence=Evidence("catalogue", plugin.evidence))
        for name, (default, plugin) in declared.items()
        if name not in known
    )
    return replace(interface, params=(*interface.params, *uses))


def in_param_file(analyses: Sequence[Analysis], path: str, offset: int) -> Hover | None:
    """The hover of a key: which nodes of the first launch get the section; how they declare the parameter, and what
    they get."""
    analysis = analyses[0]
    found = _at(analysis, path, offset)
    if found is None:
        return None
    use, param, span = found
    first = {reader.node.name: reader for reader in reversed(_for_section(analysis, path, use))}
    readers = [first[name] for name in reversed(first)]
    if param is None:
        lines = [f"- {_node(analysis, reader)}" for reader in readers]
        pattern = code(use.section.pattern)
        title = f"{pattern} is for" if lines else f"{pattern} fits no node that gets this file"
    else:
        lines = [f"- {_declared(analysis, reader, param, path)}" for reader in readers]
        title = f"{code(param.name)} = {value_text(param.value)} ({type_text(param.value) or 'no value'})"
    if not lines:
        lines = list(_why_not(use))
    more = [f"- … and {len(lines) - _SHOWN_NODES} more"] if len(lines) > _SHOWN_NODES else []
    refused = (f"\n{each}" for each in _refusals(analyses, path)[:_SHOWN_REFUSALS])
    return Hover("\n".join([title, "", *lines[:_SHOWN_NODES], *more, *refused]).rstrip(), span)


def values_in_param_file(analysis: Analysis, path: str, offset: int) -> tuple[str, ...]:
    """The nodes of a launch that get the section of a key, or what each of them gets for the parameter."""
    found = _at(analysis, path, offset)
    if found is None:
        return ()
    use, param, _ = found
    readers = _for_section(analysis, path, use)
    if param is None:
        return tuple(dict.fromkeys(code(reader.node.name) for reader in readers))
    got = ((reader, next((p for p in reader.node.params if p.name == param.name), param)) for reader in readers)
    return tuple(dict.fromkeys(f"{code(reader.node.name)}: {value_text(each.value)}" for reader, each in got))


def _refusals(analyses: Sequence[Analysis], path: str) -> Sequence[str]:
    """Why rcl refuses a file, each with a link to the place."""
    found = ((analysis, each) for analysis in analyses for each in refusals(analysis.context) if each.path == path)
    return list(dict.fromkeys(f"{escaped(each.reason)} ({place(analysis, each.place)})" for analysis, each in found))


def _for_section(analysis: Analysis, path: str, use: SectionUse) -> tuple[Reader, ...]:
    """The nodes of a launch to which a section applies."""
    used = param_file(analysis.context, path)
    return readers_of(analysis, used.nodes_for(use.section.pattern)) if used is not None else ()


def _why_not(use: SectionUse) -> Iterator[str]:
    """Why a section applies to no node, behind a title that says so."""
    if use.is_lost and use.suggestion:
        yield f"{use.suggestion[:1].upper()}{use.suggestion[1:]}"
    elif not use.is_lost:
        yield f"{use.reason[:1].upper()}{use.reason[1:]}."
    yield from (f"- Not sure: {doubt.reason.sentence}." for doubt in use.doubts)


def _at(analysis: Analysis, path: str, offset: int) -> tuple[SectionUse, FileParam | None, Span] | None:
    used = param_file(analysis.context, path)
    for use in used.sections if used is not None else ():
        for span in use.section.spans:
            if span.contains(offset):
                return use, None, span
        for param in use.section.params:
            if param.name_span.contains(offset):
                return use, param, param.name_span
    return None


def _node(analysis: Analysis, reader: Reader) -> str:
    node = reader.node
    return f"{code(node.name)} {code(f'{node.package}/{node.executable}')}, started at {place(analysis, node.location)}"


def _declared(analysis: Analysis, reader: Reader, param: FileParam, path: str) -> str:
    use = reader.declared(param.name)
    if use is None:
        text = code(reader.node.name) + _undeclared(analysis, reader, param.name, path)
    else:
        made = f" — {link(use.source_file, use.source_line)}" if use.source_file else ""
        text = f"{code(reader.node.name)} declares it: {default_text(use)}{made}"
    effective = next((p for p in reader.node.params if p.name == param.name), None)
    own = analysis.context.location(path, param.name_span)
    if effective is not None and effective.name_location != own:
        where = place(analysis, effective.place)
        text += f"; it gets {value_text(effective.value)} from {where}"
    return text


def _undeclared(analysis: Analysis, reader: Reader, name: str, path: str) -> str:
    """That a node does not declare a parameter, in words that go on from its name; "" where it may well do so."""
    node, interface = reader.node, reader.interface
    declared = declared_params(node, interface)
    found = undeclared(analysis.context, node, interface, declared, name, path) if declared is not None else None
    if found is None or declared is None:
        return ""
    sure = "" if declared.closed else f" (not sure: {declared.open_because[0].reason.sentence})"
    return f" does not declare it{sure}{did_you_mean(found.meant)}"


def from_param_file(context: QueryContext, offset: int) -> Iterator[tuple[Location, Span]]:
    """Where a key leads: from a parameter to where the nodes' sources declare it, from a node's name to its tag."""
    found = _at(context.analyses[0], context.path, offset)
    if found is None:
        return
    section, param, span = found
    seen: set[Location] = set()
    for analysis in context.analyses:
        for reader in _for_section(analysis, context.path, section):
            use = reader.declared(param.name) if param is not None else None
            target = reader.node.location if param is None else made_at(context, use) if use is not None else None
            if target is not None and target not in seen:
                seen.add(target)
                yield target, span
