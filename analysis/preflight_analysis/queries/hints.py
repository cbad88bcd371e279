"""What values with substitutions come to, and to which nodes the sections of parameter files apply, to be shown behind
them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation import values
from preflight_analysis.launch.model import Action, ActionAttribute, LaunchFile
from preflight_analysis.launch.substitutions_ros2 import nested
from preflight_analysis.model.sections import param_file
from preflight_analysis.queries.param_files import is_param_file
from preflight_analysis.workspace.workspace import Analysis

MAX_LENGTH = 40
"""Of what is shown; the rest is in the tooltip."""
_SHOWN_VALUES = 10


@dataclass(frozen=True, slots=True)
class Hint:
    """A text for a place behind a value or a key. `values` are all that it comes to, in full, the first one shown;
    `note` says why it comes to nothing."""

    offset: int
    label: str
    values: tuple[str, ...]
    note: str = ""


def hints(analyses: Sequence[Analysis], file: str, within: Span) -> tuple[Hint, ...]:
    """The hints of a file for the values that touch `within`: in the context that it is shown in (the first of
    `analyses`), and marked where other contexts give other values."""
    launch_file = analyses[0].launch_files.get(file) if analyses else None
    if launch_file is None and analyses and is_param_file(analyses[0], file):
        return tuple(_of_sections(analyses, file, within))
    if launch_file is None or launch_file.root is None:
        return ()
    current = launch_file.document.version
    same_text = [a for a in analyses if file in a.documents and a.documents[file].version == current]
    known = _known(same_text, file, within)
    found = []
    for attribute in _attributes(launch_file.root, within):
        given = known.get(attribute.value.span)
        if given and (hint := _hint(launch_file, attribute, tuple(given))) is not None:
            found.append(hint)
    return tuple(found)


def _of_sections(analyses: Sequence[Analysis], file: str, within: Span) -> Iterator[Hint]:
    """Behind each key to which nodes its section applies, where it does not say so itself."""
    used = [found for each in analyses if (found := param_file(each.context, file)) is not None]
    document = analyses[0].context.document(file)
    if not used or document is None or not used[0].getters:
        return
    for use in used[0].sections:
        key = use.section.spans[-1]
        if key.end < within.start or key.start > within.end:
            continue
        nodes = tuple(dict.fromkeys(node.name for of in used for node in of.nodes_for(use.section.pattern)))
        if nodes != (use.section.pattern,):
            others = f" (+{len(nodes) - 1})" if len(nodes) > 1 else ""
            label = f"= {_short(nodes[0])}{others}" if nodes else "= no node"
            yield Hint(document.text.find(":", key.end) + 1, label, nodes[:_SHOWN_VALUES], "" if nodes else use.reason)


def _known(analyses: Sequence[Analysis], file: str, within: Span) -> dict[Span, dict[str, None]]:
    """The different values of each place, in the order of the contexts."""
    known: dict[Span, dict[str, None]] = {}
    for analysis in analyses:
        for use in analysis.tree.uses:
            if use.kind == "value" and use.value is not None and use.location.file == file:
                span = use.location.span
                if span.end >= within.start and span.start <= within.end:
                    known.setdefault(span, {})[use.value] = None
    return known


def _attributes(action: Action, within: Span) -> Iterator[ActionAttribute]:
    """Those with substitutions, below an action; what lies wholly outside is not looked into."""
    for attribute in action.attributes:
        span = attribute.value.span
        if "$" in attribute.value.text and span.end >= within.start and span.start <= within.end:
            yield attribute
    for child in action.children:
        if child.span.end >= within.start and child.span.start <= within.end:
            yield from _attributes(child, within)


def _hint(launch_file: LaunchFile, attribute: ActionAttribute, given: tuple[str, ...]) -> Hint | None:
    if any(part.command == "anon" for part in nested(attribute.value.parts)):
        return None  # another one at each launch
    if attribute.name in ("if", "unless"):
        given = tuple(dict.fromkeys(_truth(value) for value in given))
    text = launch_file.document.text
    end = attribute.value.span.end
    offset = end + 1 if text[end : end + 1] in ("'", '"') else end
    others = f" (+{len(given) - 1})" if len(given) > 1 else ""
    return Hint(offset, f"= {_short(given[0])}{others}", given[:_SHOWN_VALUES])


def _truth(value: str) -> str:
    """A condition as what it means, if it means something."""
    try:
        return "true" if values.to_bool(value) else "false"
    except values.BadValueError:
        return value


def _short(value: str) -> str:
    """One line of bounded length; of a path the end is what tells."""
    line = " ".join(value.split())
    if len(line) <= MAX_LENGTH:
        return line or "''"
    if line.startswith("/") and " " not in line:
        kept = line[-(MAX_LENGTH - 1) :]
        return "…" + (kept[kept.index("/") :] if "/" in kept else kept)
    return line[: MAX_LENGTH - 1].rstrip() + "…"
