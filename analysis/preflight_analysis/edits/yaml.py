"""The writer of YAML: launch files, parameter files, settings."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cached_property, lru_cache

import yaml

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, compose_fast, composed, constructed, span_of
from preflight_analysis.edits import layout
from preflight_analysis.edits.edit import Edit
from preflight_analysis.edits.hash_comments import HashComments
from preflight_analysis.launch.model import Action, ActionAttribute

_TEXT = "tag:yaml.org,2002:str"
_Pair = tuple[yaml.Node, yaml.Node]


def scalar(text: str) -> str:
    """A text as YAML has it, in quotes where it would be something else without."""
    if _is_plain(text):
        return text
    return f"'{text.replace(chr(39), chr(39) * 2)}'" if text.isprintable() else json.dumps(text)


def value(plain: object) -> str:
    """A value as YAML has it on one line."""
    if isinstance(plain, str):
        return scalar(plain)
    written: str = yaml.safe_dump(plain, default_flow_style=True, width=float("inf"))
    return written.removesuffix("...\n").strip()


@lru_cache(maxsize=512)
def _is_plain(text: str) -> bool:
    """Whether a text means itself without quotes, between brackets too."""
    try:
        node = compose_fast(f"[{text}]")
    except CONSTRUCTION_ERRORS:
        return False
    items: list[yaml.Node] = node.value if isinstance(node, yaml.SequenceNode) else []
    return len(items) == 1 and isinstance(items[0], yaml.ScalarNode) and (items[0].tag, items[0].value) == (_TEXT, text)


def _has_key(node: yaml.MappingNode, name: str) -> bool:
    return any(key.value == name for key, _ in node.value)


class YamlWriter(HashComments):
    """Edits of one file. An edit that cannot be made is no edit: the tuple is empty."""

    def __init__(self, document: Document) -> None:
        super().__init__(document)
        self._text = document.text

    @cached_property
    def root(self) -> yaml.Node | None:
        """What the text is; None where it is empty or malformed."""
        try:
            return composed(self._text)
        except CONSTRUCTION_ERRORS:
            return None

    def declare_argument(self, root: Action, name: str) -> tuple[Edit, ...]:
        """Declare an argument without a default before all else."""
        actions = self._entity(root)
        if not isinstance(actions, yaml.SequenceNode) or actions.flow_style or not actions.value:
            return ()
        column = actions.start_mark.column
        start = self._line_start(actions.start_mark.index)
        if self._text[start : actions.start_mark.index].strip():
            return ()
        first = actions.value[0]
        inner = first.value[0][1] if isinstance(first, yaml.MappingNode) and first.value else None
        below = isinstance(inner, yaml.MappingNode) and not inner.flow_style
        deep = inner.start_mark.column if inner is not None and below else column + 4
        end = layout.newline(self._text)
        text = f"{' ' * column}- arg:{end}{' ' * deep}name: {scalar(name)}{end}"
        return (layout.insertion(self._document, start, text),)

    def pass_argument(self, include: Action, name: str, reference: str) -> tuple[Edit, ...]:
        """Pass the includer's own argument of that name on. `reference` is how its value is written."""
        return self._add_child(include, "arg", {"name": name, "value": reference})

    def add_remap(self, node: Action, source: str, target: str) -> tuple[Edit, ...]:
        """Remap a name of a node."""
        return self._add_child(node, "remap", {"from": source, "to": target})

    def remove(self, action: Action) -> tuple[Edit, ...]:
        """Remove an entity, with the key of its list where it is the only one."""
        found = self._holder(action)
        if found is None:
            return ()
        entity, parents = found
        for parent in reversed(parents):
            if isinstance(parent, yaml.SequenceNode) and len(parent.value) > 1:
                return self._remove_item(parent, entity)
            if isinstance(parent, yaml.MappingNode) and len(parent.value) > 1:
                return self.remove_pair(parent, next(key for key, value in parent.value if value is entity))
            entity = parent
        return ()

    def set_attribute(self, action: Action, name: str, value: str) -> tuple[Edit, ...]:
        """Give an entity another attribute, behind those that it has. `value` is written as it stands."""
        entity = self._entity(action)
        return self.append(entity, f"{name}: {value}", f"{name}: {value}") if entity is not None else ()

    def remove_attribute(self, attribute: ActionAttribute) -> tuple[Edit, ...]:
        """Remove the attribute."""
        for node in self._nodes:
            if not isinstance(node, yaml.MappingNode):
                continue
            for key, _ in node.value:
                if span_of(key) == attribute.name_span:
                    return self.remove_pair(node, key)
        return ()

    def rename_element(self, action: Action, name: str) -> tuple[Edit, ...]:
        """Give an entity another name."""
        return self.replace(action.kind_span, name)

    def replace(self, span: Span, new: str) -> tuple[Edit, ...]:
        """Write `new` in the place of a part of a key or of a text, with its quotes."""
        node = self._scalar_at(span)
        if node is None:
            return self._in_comment(span, new)
        whole, quote = span_of(node), node.style
        written: str | None = new
        if quote == "'":
            written = new.replace("'", "''")
        elif quote == '"':
            written = json.dumps(new, ensure_ascii=False)[1:-1]
        elif quote in ("|", ">"):
            written = new if "\n" not in new else None
        else:
            after = self._text[whole.start : span.start] + new + self._text[span.end : whole.end]
            if node.tag == _TEXT and not _is_plain(after):
                span, written = whole, scalar(after)
        return (Edit(self._document.location(span), written),) if written is not None else ()

    def set_parameter(self, name: Span, old: object, new: object) -> tuple[Edit, ...]:
        """Give the parameter whose name is at a span another value: what the key has, or what is beside it under
        `value` in a launch file."""
        for node in self._nodes:
            for key, value in node.value if isinstance(node, yaml.MappingNode) else ():
                if span_of(key) == name:
                    return self._set(value, old, new)
                if key.value == "name" and name in (whole := span_of(value), Span(whole.start + 1, whole.end - 1)):
                    found = next((each for other, each in node.value if other.value == "value"), None)
                    return self._set(found, old, new) if found is not None else ()
        return ()

    def _set(self, node: yaml.Node, old: object, new: object) -> tuple[Edit, ...]:
        try:
            if constructed(node) != old or (isinstance(node, yaml.ScalarNode) and node.style in ("|", ">")):
                return ()
        except CONSTRUCTION_ERRORS:
            return ()
        if isinstance(node, yaml.CollectionNode) and not node.flow_style:
            return ()
        # As a text it is what is written: `1.50` and `yes` are not what they come to.
        as_text = isinstance(new, str) and isinstance(node, yaml.ScalarNode) and not isinstance(old, str)
        written = f"'{node.value}'" if as_text else value(new)
        return (Edit(self._document.location(span_of(node)), written),)

    def nest(self, key: Span, name: str) -> tuple[Edit, ...]:
        """Put what stands beside the key at a span, and the key, below another key of that name."""
        for node in self._nodes:
            if not isinstance(node, yaml.MappingNode) or node is self.root or node.flow_style:
                continue
            if any(span_of(each) == key for each, _ in node.value):
                if any(isinstance(value, yaml.MappingNode) and _has_key(value, name) for _, value in node.value):
                    return ()
                return self._nested(node, name)
        return ()

    def _nested(self, node: yaml.MappingNode, name: str) -> tuple[Edit, ...]:
        start, indent = self._line_start(node.start_mark.index), " " * node.start_mark.column
        if self._text[start : node.start_mark.index].strip() or any("\n" in str(v.value) for v in self._scalars(node)):
            return ()  # the text of a scalar of several lines has blanks of its own
        first, _ = self._document.lines.position(start)
        last, _ = self._document.lines.position(self._end_of_lines(node) - 1)
        lines = (self._document.lines.line_span(line) for line in range(first, last + 1))
        starts = [line.start for line in lines if self._text[line.start : line.end].strip()]
        head = self._insertion(start, f"{indent}{name}:\n  ")
        return (head, *(self._insertion(at, "  ") for at in starts if at != start))

    def ancestors(self, key: Span) -> tuple[Span, ...]:
        """The keys above the one at a span, the outermost first."""
        waiting: list[tuple[yaml.Node | None, tuple[Span, ...]]] = [(self.root, ())]
        while waiting:
            node, above = waiting.pop()
            for each, value in node.value if isinstance(node, yaml.MappingNode) else ():
                if span_of(each) == key:
                    return above
                waiting.append((value, (*above, span_of(each))))
        return ()

    def append(self, node: yaml.Node | None, block: str, flow: str) -> tuple[Edit, ...]:
        """One more entry behind those of a mapping or sequence; at the end of a text that has nothing yet. The lines
        of `block` are indented relative to its first."""
        if node is None:
            missing = "" if not self._text or self._text.endswith("\n") else layout.newline(self._text)
            return (self._insertion(len(self._text), f"{missing}{block}\n"),)
        if isinstance(node, yaml.CollectionNode) and node.flow_style:
            end = node.end_mark.index - 1
            while self._text[end - 1].isspace():
                end -= 1
            return (self._insertion(end, (", " if node.value and self._text[end - 1] != "," else "") + flow),)
        if isinstance(node, yaml.CollectionNode):
            indent = " " * node.start_mark.column
            return self.write_below(node, "\n" + "\n".join(indent + line for line in block.split("\n")))
        return ()

    def write_over(self, node: yaml.Node, written: str) -> tuple[Edit, ...]:
        """Written, as it stands, in the place of a node."""
        return (Edit(self._document.location(span_of(node)), written),)

    def write_below(self, node: yaml.Node, written: str) -> tuple[Edit, ...]:
        """Written behind the line on which a node ends."""
        end = self._end_of_lines(node)
        if self._text[end - 1 : end] == "\n":
            end -= 1 + (self._text[end - 2 : end] == "\r\n")
        return (self._insertion(end, written + ("" if end < len(self._text) else "\n")),)

    def remove_pair(self, mapping: yaml.MappingNode, key: yaml.Node) -> tuple[Edit, ...]:
        """Remove a key with its value, of several."""
        pairs: list[_Pair] = mapping.value
        at = next(number for number, pair in enumerate(pairs) if pair[0] is key)
        if mapping.flow_style:
            return self._remove_between(
                pairs[at - 1][1] if at else None,
                pairs[at][0],
                pairs[at][1],
                pairs[at + 1][0] if at + 1 < len(pairs) else None,
            )
        start = self._line_start(key.start_mark.index)
        if not self._text[start : key.start_mark.index].strip():
            return (self._removal(start, self._end_of_lines(pairs[at][1])),)
        # The first one, behind a dash: the next one comes in its place.
        return (self._removal(key.start_mark.index, pairs[at + 1][0].start_mark.index),) if at + 1 < len(pairs) else ()

    def _remove_item(self, sequence: yaml.SequenceNode, item: yaml.Node) -> tuple[Edit, ...]:
        items: list[yaml.Node] = sequence.value
        at = items.index(item)
        if sequence.flow_style:
            after = items[at + 1] if at + 1 < len(items) else None
            return self._remove_between(items[at - 1] if at else None, item, item, after)
        dash = self._text.rfind("-", 0, item.start_mark.index)
        start = self._line_start(dash)
        if self._text[start:dash].strip():
            return ()
        return (self._removal(start, self._end_of_lines(item)),)

    def _remove_between(
        self, before: yaml.Node | None, first: yaml.Node, last: yaml.Node, after: yaml.Node | None
    ) -> tuple[Edit, ...]:
        """Remove one of several between brackets, with its comma."""
        if after is not None:
            return (self._removal(first.start_mark.index, after.start_mark.index),)
        start = before.end_mark.index if before is not None else first.start_mark.index
        return (self._removal(start, last.end_mark.index),)

    def _add_child(self, action: Action, kind: str, pairs: Mapping[str, str]) -> tuple[Edit, ...]:
        """One more entity in the list of that kind that an entity has."""
        entity = self._entity(action)
        if not isinstance(entity, yaml.MappingNode):
            return ()
        block = "\n  ".join(f"{key}: {scalar(text)}" for key, text in pairs.items())
        flow = f"{{{', '.join(f'{key}: {scalar(text)}' for key, text in pairs.items())}}}"
        known = next((each for key, each in entity.value if key.value == kind), None)
        if isinstance(known, yaml.SequenceNode):
            return self.append(known, f"- {block}", flow)
        if known is not None:
            return ()
        nested = block.replace("\n", "\n" + self._step)
        return self.append(entity, f"{kind}:\n{self._step}- {nested}", f"{kind}: [{flow}]")

    @cached_property
    def _step(self) -> str:
        """How far the file indents the list of a key."""
        for key, value in self.root.value if isinstance(self.root, yaml.MappingNode) else ():
            if isinstance(value, yaml.SequenceNode) and not value.flow_style:
                indent: int = value.start_mark.column - key.start_mark.column
                return " " * indent
        return ""

    def _entity(self, action: Action) -> yaml.Node | None:
        """What holds the attributes of an action."""
        for node in self._nodes:
            for key, value in node.value if isinstance(node, yaml.MappingNode) else ():
                if span_of(key) == action.kind_span:
                    return value if key.value == action.kind else node
        return None

    def _holder(self, action: Action) -> tuple[yaml.Node, list[yaml.Node]] | None:
        """The item that an action is, and what it is in, the outermost first."""
        if self.root is None:
            return None
        waiting: list[tuple[yaml.Node, list[yaml.Node]]] = [(self.root, [])]
        while waiting:
            node, parents = waiting.pop()
            inside = [*parents, node]
            if isinstance(node, yaml.MappingNode):
                for key, value in node.value:
                    if span_of(key) == action.kind_span:
                        return (value, inside) if key.value == action.kind and len(node.value) > 1 else (node, parents)
                    waiting.append((value, inside))
            elif isinstance(node, yaml.SequenceNode):
                waiting += ((each, inside) for each in node.value)
        return None

    def _scalar_at(self, span: Span) -> yaml.ScalarNode | None:
        waiting = [self.root] if self.root is not None else []
        while waiting:
            node = waiting.pop()
            start, end = span_of(node)
            # An alias stands for a node elsewhere.
            if start <= span.start and span.end <= end:
                if isinstance(node, yaml.ScalarNode):
                    return node
                parts = [part for each in node.value for part in (each if isinstance(each, tuple) else (each,))]
                waiting += [part for part in parts if part.start_mark.index <= span.start]
        return None

    @cached_property
    def _nodes(self) -> list[yaml.Node]:
        """All nodes, each once."""
        found: dict[int, yaml.Node] = {}
        waiting = [self.root] if self.root is not None else []
        while waiting:
            node = waiting.pop()
            if id(node) in found:
                continue
            found[id(node)] = node
            for each in node.value if isinstance(node, yaml.CollectionNode) else ():
                waiting += each if isinstance(each, tuple) else (each,)
        return list(found.values())

    def _scalars(self, node: yaml.Node) -> list[yaml.ScalarNode]:
        inside = [node]
        for each in inside:
            for part in each.value if isinstance(each, yaml.CollectionNode) else ():
                inside += part if isinstance(part, tuple) else (part,)
        return [each for each in inside if isinstance(each, yaml.ScalarNode)]

    def _line_start(self, offset: int) -> int:
        line, _ = self._document.lines.position(offset)
        return self._document.lines.line_start(line)

    def _end_of_lines(self, node: yaml.Node) -> int:
        """Behind the line on which a node ends: a block ends only where something else begins."""
        while isinstance(node, yaml.CollectionNode) and not node.flow_style and node.value:
            last = node.value[-1]
            node = last[1] if isinstance(last, tuple) else last
        end = max(node.start_mark.index, len(self._text[: node.end_mark.index].rstrip()))
        line, _ = self._document.lines.position(end)
        return self._document.lines.line_span(line).end

    def _insertion(self, offset: int, text: str) -> Edit:
        return layout.insertion(self._document, offset, text.replace("\n", layout.newline(self._text)))

    def _removal(self, start: int, end: int) -> Edit:
        return Edit(self._document.location(Span(start, end)), "")
