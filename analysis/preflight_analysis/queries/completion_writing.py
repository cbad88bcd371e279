"""How tags and attributes are written in a format: the texts and snippets of proposals."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from preflight_analysis.documents.document import Document
from preflight_analysis.launch.schema import Attribute
from preflight_analysis.queries.completion_items import Item
from preflight_analysis.queries.cursor import Place, is_closed
from preflight_analysis.queries.language import Language, attribute_doc

_WITH_CONTENT = ("launch", "group")


class XmlWriting:
    """`<tag attribute="value"/>`."""

    def __init__(self, language: Language) -> None:
        self._language = language

    def elements(self, document: Document, place: Place, names: Sequence[str]) -> Iterator[Item]:
        """The tags, then the end tag of the one that is open."""
        following = document.text[place.word.end : place.word.end + 1]
        less = "<" if place.kind == "content" else ""
        goes_on = following in (">", "/") or (place.element is not None and bool(place.element.attributes))
        for name in names:
            template = None if goes_on and not less else less + self._template(name, place)
            yield Item("element", name, less + name, self._language.tags[name].doc, snippet=template)
        for each in self._language.snippets if not goes_on or less else ():
            if each.tag in names:
                text = f"{less}{each.tag}"
                yield Item("snippet", each.label, text, each.doc, snippet=less + each.xml, filter=f"{less}{each.label}")
        if place.parent is not None and not is_closed(document.text, place.parent):
            yield Item("end-tag", f"{less}/{place.parent.tag}>", f"{less}/{place.parent.tag}>")

    def _template(self, name: str, place: Place) -> str:
        """A snippet of the element with what it needs: `node pkg="$1" type="$2" name="$3"/>`."""
        if name in _WITH_CONTENT:
            return f"{name}>\n\t$0\n</{name}>"
        written = written_with(self._language, name, place)
        return name + "".join(f' {attribute}="${n}"' for n, attribute in enumerate(written, 1)) + "/>"

    def attributes(self, document: Document, place: Place, attributes: Sequence[Attribute]) -> Iterator[Item]:
        """The attributes, with an empty value where there is none yet."""
        has_value = document.text.startswith("=", place.word.end)
        for attribute in attributes:
            yield Item(
                "attribute",
                attribute.name,
                attribute.name if has_value else f'{attribute.name}=""',
                attribute_doc(attribute),
                "required" if attribute.required else "",
                snippet=None if has_value else f'{attribute.name}="{_tab_stop(attribute)}"',
            )


class YamlWriting:
    """`- tag:` with the attributes below it; what is a child tag in XML may be a list below its name here."""

    def __init__(self, language: Language) -> None:
        self._language = language

    def elements(self, document: Document, place: Place, names: Sequence[str]) -> Iterator[Item]:
        """The entities of a list, with their dash where none is written."""
        has_colon = document.text.startswith(":", place.word.end)
        dash = "- " if place.kind == "content" else ""
        if place.parent is None:
            yield Item("element", "launch", "launch:", self._language.tags["launch"].doc, snippet="launch:\n  - $0")
            return
        for name in names:
            text = name if has_colon else f"{dash}{name}:"
            snippet = None if has_colon else f"{dash}{self._template(name, place)}"
            yield Item("element", name, text, self._language.tags[name].doc, snippet=snippet)
        for each in self._language.snippets if not has_colon else ():
            if each.tag in names and each.yaml:
                yield Item("snippet", each.label, f"{dash}{each.tag}:", each.doc, snippet=dash + each.yaml)

    def _template(self, name: str, place: Place) -> str:
        if name in _WITH_CONTENT:
            return f"{name}:\n    - $0"
        written = written_with(self._language, name, place)
        if not written:
            return f"{name}:\n    $0"
        return f"{name}:" + "".join(f"\n    {attribute}: ${n}" for n, attribute in enumerate(written, 1))

    def attributes(self, document: Document, place: Place, attributes: Sequence[Attribute]) -> Iterator[Item]:
        """The attributes, then the lists of what is inside."""
        has_colon = document.text.startswith(":", place.word.end)
        for attribute in attributes:
            name = attribute.name
            yield Item(
                "attribute",
                name,
                name if has_colon else f"{name}: ",
                attribute_doc(attribute),
                "required" if attribute.required else "",
                snippet=None if has_colon else f"{name}: {_tab_stop(attribute)}",
            )
        tag = self._language.tag(place.element.tag) if place.element is not None else None
        present = {child.tag for child in place.element.elements} if place.element is not None else set[str]()
        actions = self._language.tags["launch"].children
        for name in tag.children if tag is not None else ():
            if name in present or (name in actions and name != "arg"):
                continue
            inside = written_with(self._language, name, place, place.element.tag if place.element is not None else "")
            body = "\n    ".join(f"{a}: ${n}" for n, a in enumerate(inside, 1)) or "$0"
            snippet = None if has_colon else f"{name}:\n  - {body}"
            text = name if has_colon else f"{name}:"
            yield Item("element", name, text, self._language.tags[name].doc, snippet=snippet)
        if tag is not None and "node" in tag.children and "children" not in present:
            doc = "The actions inside."
            yield Item("element", "children", "children" if has_colon else "children:", doc)


Writing = XmlWriting | YamlWriting


def written_with(language: Language, name: str, place: Place, parent: str | None = None) -> Sequence[str]:
    """The attributes that a new tag is written with: those that it needs, and those that it nearly always has."""
    parent = parent or (place.parent.tag if place.parent is not None else None)
    required = language.tags[name].required
    if parent is not None and parent.lower() == "include" and name == "arg":
        return (*required, "value")
    also = language.also.get(name, ())
    return tuple(dict.fromkeys((*(() if set(required) <= set(also) else required), *also)))


def _tab_stop(attribute: Attribute) -> str:
    """A place to type in, or to choose in: first what is not the default, which would not have to be written."""
    if attribute.kind not in ("choice", "flag"):
        return "$1"
    choices = sorted(attribute.choices, key=lambda choice: choice == attribute.default)
    return f"${{1|{','.join(choices)}|}}"
