"""The writer of XML: launch files, manifests, robot descriptions, behavior trees, annotations."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import cached_property

from preflight_analysis.documents.document import Attribute, Comment, Document, Element, Node, Text
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.xml import parse_xml, without_comments
from preflight_analysis.documents.xml_text import quoted_attribute
from preflight_analysis.edits import layout
from preflight_analysis.edits.edit import Edit
from preflight_analysis.launch.model import Action, ActionAttribute

_DEPENDENCY = re.compile(r"^([ \t]*)<(?:depend|exec_depend|run_depend|test_depend)\b[^<>]*>[^<]*</\w+>", re.MULTILINE)
_END = re.compile(r"^([ \t]*)</package\s*>", re.MULTILINE)
_NAME = re.compile(r"[A-Za-z_][\w.-]*")


def tag(name: str, attributes: Mapping[str, str]) -> str:
    """An element without content."""
    return f"<{name}{''.join(f' {key}={quoted_attribute(value)}' for key, value in attributes.items())}/>"


class XmlWriter:
    """Edits of one file. An edit that cannot be made is no edit: the tuple is empty."""

    def __init__(self, document: Document) -> None:
        self._document = document

    def declare_argument(self, root: Action, name: str) -> tuple[Edit, ...]:
        """Declare an argument without a default before all else."""
        if self._document.problems:
            return ()
        return self.insert_child(root, tag("arg", {"name": name}))

    def pass_argument(self, include: Action, name: str, reference: str) -> tuple[Edit, ...]:
        """Pass the includer's own argument of that name on. `reference` is how its value is written."""
        if self._document.problems:
            return ()
        return self.insert_child(include, tag("arg", {"name": name, "value": reference}))

    def add_remap(self, node: Action, source: str, target: str) -> tuple[Edit, ...]:
        """Remap a name of a node."""
        return self.insert_child(node, tag("remap", {"from": source, "to": target}))

    def remove(self, action: Action) -> tuple[Edit, ...]:
        """Remove an element."""
        return (layout.removal(self._document, action.span),)

    def set_attribute(self, action: Action, name: str, value: str) -> tuple[Edit, ...]:
        """Give the tag another attribute, behind those that it has."""
        end = action.attributes[-1].span.end if action.attributes else action.kind_span.end
        return (layout.insertion(self._document, end, f" {name}={quoted_attribute(value)}"),)

    def replace_attribute(self, attribute: ActionAttribute, name: str, value: str) -> tuple[Edit, ...]:
        """Write another attribute in the place of one."""
        return (Edit(self._document.location(attribute.span), f"{name}={quoted_attribute(value)}"),)

    def remove_attribute(self, attribute: ActionAttribute) -> tuple[Edit, ...]:
        """Remove the attribute and the blanks before it."""
        start = attribute.span.start
        while start > 0 and self._document.text[start - 1].isspace():
            start -= 1
        return (Edit(self._document.location(Span(start, attribute.span.end)), ""),)

    def rename_element(self, action: Action, name: str) -> tuple[Edit, ...]:
        """Give an element another name, in its start tag and in its end tag."""
        return self.replace(action.kind_span, name)

    def annotate(self, action: Action, lines: Sequence[str]) -> tuple[Edit, ...]:
        """Write an annotation: a comment as the first thing in the element."""
        if not self._document.text[: action.head_span.end].endswith(">"):
            return ()  # still being typed
        return self.insert_child(action, "\n".join(("<!--", *(f"  {line}" for line in lines), "-->")))

    def suppress(self, offset: int, mark: str) -> tuple[Edit, ...]:
        """The places where a comment can suppress what is found at an offset, the best first: the line above it, that
        above the tag that it is in, and the end of its line."""
        comment = f"<!-- {mark} -->"
        places = dict.fromkeys((offset, self._start_of_tag(offset)))
        return (
            *(layout.lines_above(self._document, place, comment) for place in places),
            layout.at_end_of_line(self._document, offset, f" {comment}"),
        )

    def replace(self, span: Span, new: str) -> tuple[Edit, ...]:
        """Write `new` in the place of a part of a value, a text or a comment, or of the name of an attribute or of an
        element, in its end tag too."""
        where, text = self._around(span), self._document.text
        match where:
            case Attribute():
                written = _escaped(new, text[where.value.span.start - 1])
            case Text() if not text[: where.content.span.start].endswith("<![CDATA["):
                written = _escaped(new, "")
            case Text():
                written = new if "]]>" not in new else ""
            case Comment():
                written = new if "--" not in new else ""
            case _:
                places = self._names_at(span) if _NAME.fullmatch(new) else ()
                return tuple(Edit(self._document.location(place), new) for place in places)
        return (Edit(self._document.location(span), written),) if written or not new else ()

    def replace_beside(self, value: Span, name: str, old: str, new: str) -> tuple[Edit, ...]:
        """Replace the value of another attribute of the element that has a value at a span."""
        element = self._element_with_value(value)
        found = element.get(name) if element is not None else None
        return self.replace(found.value.span, new) if found is not None and found.value.text == old else ()

    def set_parameter(self, name: Span, old: object, new: object) -> tuple[Edit, ...]:
        """Give the parameter whose name is at a span another value, if the one that it has is written in its tag."""
        element = self._element_with_value(name)
        value = element.get("value") if element is not None else None
        if value is None or _unquoted(value.value.text) != _word(old) or isinstance(new, (list, str)):
            return ()
        return (Edit(self._document.location(value.value.span), _word(new)),)

    def insert_child(self, action: Action, child: str) -> tuple[Edit, ...]:
        """Make `child` the first thing in an element, on lines of its own.

        `child` may have several lines, each but the first with the indentation that it has relative to the first. A
        self-closing tag is opened. Line breaks and indentation follow those of the document.
        """
        document, text = self._document, self._document.text
        newline, base = layout.newline(text), layout.indent_of(document, action.head_span.start)
        body = "".join(newline + layout.deeper(base) + part for part in child.split("\n"))
        end = action.head_span.end
        if text[action.head_span.start : end].endswith("/>"):
            blank = end - 2
            while text[blank - 1] in " \t":
                blank -= 1
            span = Span(blank, end)
            return (Edit(document.location(span), f">{body}{newline}{base}</{action.kind}>"),)
        return (layout.insertion(document, end, body + ("" if layout.ends_line(text, end) else newline + base)),)

    def add_dependency(self, kind: str, package: str) -> tuple[Edit, ...]:
        """Name a package in a manifest, behind those that it names."""
        text, newline = without_comments(self._document.text), layout.newline(self._document.text)
        written, end = f"<{kind}>{package}</{kind}>", _END.search(text)
        last = next(reversed([*_DEPENDENCY.finditer(text)]), None)
        if last is not None:
            return (layout.insertion(self._document, last.end(), f"{newline}{last[1]}{written}"),)
        if end is not None:
            return (layout.insertion(self._document, end.start(), f"{end[1]}  {written}{newline}"),)
        return ()

    def insert_open_bracket(self, offset: int) -> tuple[Edit, ...]:
        """Write the `<` that a tag has lost."""
        return (layout.insertion(self._document, offset, "<"),)

    def comment_out(self, span: Span, remark: str) -> tuple[Edit, ...]:
        """Make a comment of a text."""
        if "--" in remark:
            return ()  # a comment cannot have two dashes in it
        return (Edit(self._document.location(span), f"<!-- {remark} -->"),)

    def remove_comment(self, comment: Comment) -> tuple[Edit, ...]:
        """Remove a comment."""
        return (layout.removal(self._document, comment.span),)

    def _start_of_tag(self, offset: int) -> int:
        """Where the start tag begins that an offset is in; the offset itself where it is in none."""
        inside: Document | Element = self._tree
        while True:
            children = (each for each in inside.children if isinstance(each, Element) and each.span.contains(offset))
            child = next(children, None)
            if child is None:
                return offset
            if child.open_span.contains(offset):
                return child.open_span.start
            inside = child

    @cached_property
    def _tree(self) -> Document:
        """The document as XML; of files other than launch files only the text was read."""
        return self._document if self._document.root else parse_xml(self._document.path, self._document.text)

    def _around(self, span: Span) -> Attribute | Comment | Text | None:
        """The innermost value, comment or text that has all of a span."""
        nodes: tuple[Node, ...] = self._tree.children
        while True:
            node = next((each for each in nodes if _covers(_span_of(each), span)), None)
            if not isinstance(node, Element):
                return node
            found = next((each for each in node.attributes if _covers(each.value.span, span)), None)
            if found is not None:
                return found
            nodes = node.children

    def _element_with_value(self, span: Span) -> Element | None:
        """The element of which an attribute has its value at a span."""
        waiting = list(self._tree.children)
        while waiting:
            node = waiting.pop()
            if isinstance(node, Element):
                if any(each.value.span == span for each in node.attributes):
                    return node
                waiting += node.children
        return None

    def _names_at(self, span: Span) -> tuple[Span, ...]:
        """Where the name of an attribute or an element stands that begins at a span."""
        waiting = list(self._tree.children)
        while waiting:
            node = waiting.pop()
            if isinstance(node, Element):
                if any(each.name_span == span for each in node.attributes):
                    return (span,)
                if node.tag_span == span:
                    at = self._document.text.rfind("</", node.open_span.end, node.span.end)
                    end = self._document.text[at + 2 : node.span.end].rstrip(" \t\r\n>") if at >= 0 else ""
                    return (span, Span(at + 2, at + 2 + len(node.tag))) if end == node.tag else (span,)
                waiting += node.children
        return ()


def _word(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _unquoted(text: str) -> str:
    """A text that launch takes for a text because it is in quotes, without them."""
    return text[1:-1] if len(text) > 1 and text[0] == text[-1] and text[0] in "'\"" else text


def _span_of(node: Node) -> Span:
    return node.content.span if isinstance(node, Text) else node.span


def _covers(whole: Span, part: Span) -> bool:
    return whole.start <= part.start and part.end <= whole.end


def _escaped(text: str, quote: str) -> str:
    """A text as it stands between those quotes, or without any between tags."""
    text = text.replace("&", "&amp;").replace("<", "&lt;")
    return text.replace(quote, "&quot;" if quote == '"' else "&apos;") if quote else text.replace("]]>", "]]&gt;")
