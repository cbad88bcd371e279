"""What kind of place a cursor is in, in a YAML launch file that is being typed.

Goes by lines and their indentation alone, so that it works in a text that no YAML parser takes. The answer is in the
same terms as for XML: entities are elements, their keys attributes, lists of maps and `children` the elements inside.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import field

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Attribute, Document, Element, SpannedText
from preflight_analysis.documents.span import Span
from preflight_analysis.queries.cursor import Place

_LINE = re.compile(
    r"(?P<indent> *)(?P<dashes>(?:-(?: +|(?=\n|\r|\Z)))*)"
    r"(?P<key>(?:\"[^\"\n]*\"|'[^'\n]*'|[^\s#:'\"\[\]{}]+|:(?=\S)|(?<=\S) (?! *#))*)(?P<colon> *:(?=[ \r\n]|\Z))?"
    r"(?P<rest>[^\r\n]*)"
)
_COMMENT = re.compile(r"(?:\A|\s)#.*\Z")
_BLOCK = re.compile(r"[|>][-+0-9]*\Z")
_MAX_LINES = 20_000


@dataclass(slots=True, eq=False)
class Entry:
    """A key with what is below it. `dash` is the column of the dash in front of it, None without one."""

    column: int
    dash: int | None
    key: str
    key_span: Span
    value: str
    value_span: Span
    start: int
    end: int
    below: list[Entry] = field(default_factory=list)
    above: Entry | None = None


def outline(text: str, offset: int, *, one_item: bool = False) -> tuple[list[Entry], Entry | None]:
    """The entries at the left margin, with all below them, and the one on the line of `offset`. On a blank line that
    is one without a name, where the cursor is. With `one_item`, of the list below `launch` only the item around it."""
    top: list[Entry] = []
    stack: list[Entry] = []
    here: Entry | None = None
    block: int | None = None
    lines = list(_lines(text))
    for at, line in _of_one_item(lines, offset) if one_item else lines:
        found = _LINE.match(line)
        cursor = at <= offset <= at + len(line)
        content = line.strip()
        if found is None or (not cursor and (not content or content.startswith(("#", "---")))):
            continue
        if block is not None and len(found["indent"]) > block and content:
            continue
        entry = _entry(found, at, offset - at if cursor and not content else None)
        block = entry.column if _BLOCK.match(entry.value) else None
        while stack and (stack[-1].column > entry.dash if entry.dash is not None else stack[-1].column >= entry.column):
            stack.pop()
        entry.above = stack[-1] if stack else None
        (entry.above.below if entry.above is not None else top).append(entry)
        stack.append(entry)
        end = max(at + len(line.rstrip()), offset if cursor else 0)
        for open_ in stack:
            open_.end = max(open_.end, end)
        if cursor:
            here = entry
    return top, here


def _lines(text: str) -> Iterator[tuple[int, str]]:
    at = 0
    for line in text.split("\n")[:_MAX_LINES]:
        yield at, line.rstrip("\r")
        at += len(line) + 1


def _of_one_item(lines: Sequence[tuple[int, str]], offset: int) -> Iterator[tuple[int, str]]:
    """The lines at the left margin, and those of the item of `launch:` that the cursor is in: a keystroke has to be
    answered soon, however long the file is."""
    heads = [n for n, (_, line) in enumerate(lines) if line[:1] not in ("", " ", "-", "#", "\t")]
    here = next((n for n in range(len(lines) - 1, -1, -1) if lines[n][0] <= offset), 0)
    head = next((n for n in reversed(heads) if n <= here), None)
    begin, end = 0, len(lines)
    if head is not None and lines[head][1].startswith("launch"):
        begin, end = head + 1, next((n for n in heads if n > here), end)
        dashed = (line for _, line in lines[begin:end] if line.lstrip(" ").startswith("-"))
        mark = next((line[: line.index("-") + 1] for line in dashed), None)
        items = [n for n in range(begin, end) if lines[n][1].startswith(mark)] if mark is not None else []
        begin = next((n for n in reversed(items) if n <= here), begin)
        end = next((n for n in items if n > here), end)
    yield from (lines[n] for n in sorted({*heads, *range(begin, end)}))


def _entry(found: re.Match[str], at: int, cursor: int | None) -> Entry:
    dashes = found["dashes"]
    column = found.start("key") if cursor is None else cursor
    dash = found.start("dashes") + dashes.rstrip().rfind("-") if dashes else None
    key = Span(at + found.start("key"), at + found.end("key")) if cursor is None else Span(at + cursor, at + cursor)
    raw = found["rest"] if found["colon"] is not None else ""
    rest = _COMMENT.sub("", raw)
    value = rest.strip()
    start = at + found.start("rest") + (len(rest) - len(rest.lstrip()) if value else min(1, len(rest)))
    begin = at + (column if dash is None else found.start("dashes"))
    return Entry(column, dash, found["key"].strip("'\""), key, value, Span(start, start + len(value)), begin, begin)


def place_at_yaml(document: Document, offset: int) -> Place | None:
    """The place of a cursor at `offset`; None where nothing of the language can stand, as in a comment."""
    text = document.text
    line = text[text.rfind("\n", 0, offset) + 1 : offset]
    if _COMMENT.search(line):
        return None
    top, here = outline(text, offset, one_item=True)
    if here is None:
        return None
    if here.above is None:
        free = here.dash is None and here.key_span.contains(offset) and not _named(top, here)
        return Place("element", here.key_span, ()) if free else None
    builder = _Builder(here)
    launch = next((entry for entry in top if entry.key == "launch"), None)
    if launch is None:
        return None
    launch.end = len(text)
    root = builder.entity(launch)
    if builder.role is None:
        return None
    if offset < here.key_span.start:
        return None
    in_key = offset <= here.key_span.end
    parents = tuple(e for e in _path(root, here) if e.tag_span != builder.own)
    element = next((e for e in _path(root, here) if e.tag_span == builder.own), None)
    if builder.role == "item":
        if not in_key:
            return None
        kind = "content" if here.dash is None and not here.key else "element"
        return Place("content" if kind == "content" else "element", here.key_span, parents, element)
    attribute = next((a for a in element.attributes if a.name_span == here.key_span), None) if element else None
    if in_key:
        return Place("attribute", here.key_span, parents, element, attribute if here.key else None)
    span = _unquoted(text, here.value_span)
    if offset > span.end and span.end == here.value_span.end and not text[span.end : offset].strip(" "):
        span = Span(span.start, offset)  # blanks that are just being typed
    if attribute is None or offset < here.key_span.end + 2 or not (span.start <= offset <= span.end):
        return None
    return Place("value", span, parents, element, attribute)


def _named(top: Sequence[Entry], here: Entry) -> bool:
    return any(entry.key == "launch" for entry in top if entry is not here)


def _unquoted(text: str, span: Span) -> Span:
    if span.end > span.start and text[span.start] in "'\"":
        closed = span.end - span.start > 1 and text[span.end - 1] == text[span.start]
        return Span(span.start + 1, span.end - closed)
    return span


def _path(root: Element, here: Entry) -> Iterator[Element]:
    """The elements around an entry, outermost first."""
    element: Element | None = root
    at = here.key_span.start
    while element is not None:
        yield element
        element = next((e for e in element.elements if e.span.start <= at <= e.span.end), None)


class _Builder:
    """Makes elements of entries. `role` is what the entry of the cursor is: the name of an entity (`item`), or one of
    the keys of the entity whose tag is `own` (`member`)."""

    def __init__(self, here: Entry) -> None:
        self._here = here
        self.role: str | None = None
        self.own: Span | None = None

    def entity(self, entry: Entry) -> Element:
        """An entity by its name, with what is below it."""
        if entry is self._here:
            self.role, self.own = "item", entry.key_span
        if _is_list(entry) or entry.key == "launch":
            return self._element(entry, entry.key_span, (), self._items(entry))
        return self._map(entry, entry.key_span, entry.below, entry.key)

    def _items(self, entry: Entry) -> list[Element]:
        if self._here in entry.below and self._here.dash is None and not self._here.key:
            self.role = "item"
            return [self.entity(each) for each in entry.below if each is not self._here]
        return [self.entity(each) for each in entry.below]

    def _map(self, entry: Entry, tag_span: Span, members: Sequence[Entry], tag: str) -> Element:
        attributes: list[Attribute] = []
        children: list[Element] = []
        for member in members:
            if member is self._here:
                self.role, self.own = "member", tag_span
            if member.key == "children":
                children += self._items(member)
            elif _is_list(member):
                children += self._listed(member)
            elif member.key:
                span = Span(member.key_span.start, max(member.key_span.end, member.value_span.end))
                value = member.value.strip("'\"")
                attributes.append(Attribute(member.key, member.key_span, SpannedText(value, member.value_span), span))
        end = max((m.end for m in members), default=entry.end)
        return self._element(entry, tag_span, attributes, children, tag, end)

    def _listed(self, member: Entry) -> Iterator[Element]:
        """`param:` and the like: each item of the list is an entity without a name of its own."""
        items: list[list[Entry]] = []
        for entry in member.below:
            if entry.dash is not None or not items:
                items.append([])
            items[-1].append(entry)
        for item in items:
            yield self._map(item[0], Span(item[0].start, item[0].start), item, member.key)

    def _element(
        self,
        entry: Entry,
        tag_span: Span,
        attributes: Sequence[Attribute],
        children: Sequence[Element],
        tag: str | None = None,
        end: int | None = None,
    ) -> Element:
        start = min(entry.start, tag_span.start) if tag is None or tag == entry.key else entry.start
        end = max(entry.end if end is None else end, tag_span.end, *(c.span.end for c in children), start)
        name = entry.key if tag is None else tag
        return Element(name, tag_span, tuple(attributes), tuple(children), tag_span, Span(tag_span.start, end))


def _is_list(entry: Entry) -> bool:
    return any(each.dash is not None for each in entry.below)
