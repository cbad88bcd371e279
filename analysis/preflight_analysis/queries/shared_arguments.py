"""Where an argument of a launch file is declared, used and given, over all files that share it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from preflight_analysis.documents.document import SpannedText
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.launch.references import arg_references
from preflight_analysis.launch.substitutions import parse_value
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.workspace.facts import may_be_true
from preflight_analysis.workspace.index import Inclusion, WorkspaceIndex


def sharing(index: WorkspaceIndex, files: Iterable[str], name: str, *, by_tag: bool = False) -> frozenset[str]:
    """The files in which `name` is the same argument as in `files`, since `pass_all_args` hands it on under its name.

    With `by_tag` also the files that one and the same `<include>` leads to when its `file` changes: it can give the
    argument under one name only.
    """
    found: set[str] = set()
    left = list(files)
    while left:
        path = left.pop()
        if path in found:
            continue
        found.add(path)
        for inclusion in index.included_from(path):
            if _hands_on(index, inclusion, name):
                left.append(inclusion.target)
        for inclusion in index.includers(path):
            if _hands_on(index, inclusion, name) and _has(index, inclusion.includer, name, set()):
                left.append(inclusion.includer)
            if by_tag and _given(index, inclusion, name):
                left += (i.target for i in index.included_from(inclusion.includer) if i.tag == inclusion.tag)
    return frozenset(found)


def _hands_on(index: WorkspaceIndex, inclusion: Inclusion, name: str) -> bool:
    facts = index.files.get(inclusion.includer)
    return facts is not None and inclusion.tag.span in facts.passing_all and not _given(index, inclusion, name)


def _given(index: WorkspaceIndex, inclusion: Inclusion, name: str) -> bool:
    facts = index.files.get(inclusion.includer)
    return facts is not None and any(m.action == inclusion.tag.span for m in facts.named("arg-passed", name))


def _has(index: WorkspaceIndex, path: str, name: str, seen: set[str]) -> bool:
    """Whether a file knows an argument of that name: its own, or one that it gets from its includers."""
    if path in seen:
        return False
    seen.add(path)
    facts = index.files.get(path)
    if facts is not None and any(m.kind in ("arg-declaration", "arg-use") and m.name == name for m in facts.mentions):
        return True
    return any(
        _given(index, i, name) or (_hands_on(index, i, name) and _has(index, i.includer, name, seen))
        for i in index.includers(path)
    )


def declared_at(context: QueryContext, files: Iterable[str], name: str) -> Iterator[Location]:
    """The names of its `<arg>` tags."""
    for path in files:
        if (facts := context.facts(path)) is not None:
            yield from (context.location(path, m.span) for m in facts.named("arg-declaration", name))


def used_at(context: QueryContext, files: Iterable[str], name: str) -> Iterator[Location]:
    """Each use in `$(arg)` and `$(eval)`, in the YAML of `<rosparam subst_value="true">` too."""
    for path in files:
        if (facts := context.facts(path)) is not None:
            yield from (context.location(path, m.span) for m in facts.named("arg-use", name))
            for yaml in _substituted_files(context, path):
                yield from (context.location(yaml, span) for used, span in _uses_in(context, yaml) if used == name)


def given_at(context: QueryContext, files: Iterable[str], name: str) -> Iterator[Location]:
    """The `<arg>` tags that give it, in the files that include these."""
    seen: set[Location] = set()
    for path in files:
        for inclusion in context.current.includers(path):
            facts = context.facts(inclusion.includer)
            if facts is not None and inclusion.tag not in seen:
                seen.add(inclusion.tag)
                given = (m for m in facts.named("arg-passed", name) if m.action == inclusion.tag.span)
                yield from (context.location(inclusion.includer, m.span) for m in given)


def _substituted_files(context: QueryContext, path: str) -> Iterator[str]:
    """The YAML files whose substitutions are resolved with the arguments of a launch file."""
    launch_file = context.launch_file(path)
    loads: set[Span] = set()
    for action in launch_file.root.walk() if launch_file and launch_file.root else ():
        file, substituted = action.value("file"), action.value("subst_value")
        if action.kind == "rosparam" and file is not None and substituted is not None and may_be_true(substituted):
            loads.add(file.span)
    uses = (u for tree in context.trees for u in tree.uses if loads and u.kind == "file" and u.target is not None)
    found = (u.target.file for u in uses if u.target and u.location.file == path and u.location.span in loads)
    yield from dict.fromkeys(found)


def _uses_in(context: QueryContext, path: str) -> Iterator[tuple[str, Span]]:
    document = context.document(path)
    if document is not None:
        value = parse_value(SpannedText(document.text, Span(0, len(document.text))))
        if value.problem is None:
            yield from arg_references(value)
