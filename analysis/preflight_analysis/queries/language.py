"""What the language itself says of a tag or an attribute."""

from __future__ import annotations

from preflight_analysis.documents.document import Document, Element
from preflight_analysis.documents.span import Span
from preflight_analysis.launch.schema import Attribute, Tag
from preflight_analysis.launch.schema_ros1 import TAGS
from preflight_analysis.queries.cursor import place_at


def tag_of(element: Element) -> Tag | None:
    """What the language says of an element; roslaunch takes some tags in capitals, too."""
    return TAGS.get(element.tag) or TAGS.get(element.tag.lower())


def attribute_doc(attribute: Attribute) -> str:
    """What an attribute is, what it may be and what it is where it is left out, as Markdown."""
    lines = [attribute.doc]
    if attribute.kind == "choice":
        lines.append(f"One of {', '.join(f'`{choice}`' for choice in attribute.choices)}.")
    if attribute.default is not None:
        lines.append(f"Default: `{attribute.default}`.")
    return "\n\n".join(lines)


def described(document: Document, offset: int) -> tuple[str, Span] | None:
    """The description, as Markdown, of the tag or attribute whose name is at `offset`, and where that name is."""
    place = place_at(document, offset)
    element = place.element if place is not None else None
    tag = tag_of(element) if element is not None else None
    if place is None or element is None or tag is None:
        return None
    if place.kind == "element":
        return f"`<{element.tag}>` {tag.doc}", place.word
    if place.kind == "attribute" and place.attribute is not None:
        attribute = tag.attributes.get(place.attribute.name)
        if attribute is not None:
            required = " (required)" if attribute.required else ""
            return f"`{attribute.name}`{required}: {attribute_doc(attribute)}", place.word
    return None
