"""What a completion is made of."""

from __future__ import annotations

from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span

ItemKind = Literal[
    "element",
    "snippet",
    "end-tag",
    "attribute",
    "value",
    "package",
    "executable",
    "folder",
    "file",
    "argument",
    "command",
    "function",
    "constant",
    "variable",
    "machine",
    "namespace",
    "parameter",
    "endpoint",
    "type",
]


@dataclass(frozen=True, slots=True)
class Item:
    """One proposal. `text` replaces the completion's span; `snippet` is the same with tab stops, in LSP's syntax.

    `label` is shown, and what is typed is compared with it unless `filter` says otherwise. `doc` is Markdown;
    `about` is what `completion_docs.documentation` is asked for instead, once the user looks at the proposal.
    """

    kind: ItemKind
    label: str
    text: str
    doc: str = ""
    detail: str = ""
    snippet: str | None = None
    filter: str | None = None
    about: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Completion:
    """Proposals, best first, for what stands at `span`, which the cursor touches."""

    span: Span
    items: tuple[Item, ...]
