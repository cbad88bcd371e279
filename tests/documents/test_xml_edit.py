"""What is parsed of an edited text beside that of before is what is parsed of it alone."""

import random

import pytest
from preflight_analysis.documents.document import Document, Element
from preflight_analysis.documents.reading import Text
from preflight_analysis.documents.span import LineIndex
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.documents.xml_edit import edited_children
from preflight_analysis.launch.read import read_launch

PATH = "/work/a.launch"
TEXT = """<?xml version="1.0"?>
<!-- A robot -->
<launch>
  <arg name="rate" default="5"/>
  <!-- preflight: ignore[TOP001] -->
  <node pkg="p" type="t" name="one">
    <param name="x" value="&lt;$(arg rate)&#62;"/>
    <rosparam><![CDATA[a: 1]]></rosparam>\r
  </node>
  <group ns="g"><node pkg="p" type="t" name="two"/></group><?pause?>
  <node pkg='p' type='t'
        name='three'/>
</launch>
<!-- The end -->
"""
PIECES = (
    *'<>/"&;=- \n\r!?]',
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "<?a?>",
    "<a/>",
    "<group>",
    "</group>",
    "</launch>",
    '<arg name="b"/>',
    "<a></a>",
    "&amp;",
    "text",
    "<launch>",
    "<!DOCTYPE launch>",
    "\x01",
    "é",
)


def parsed(text: str, before: Document | None = None) -> Document:
    return parse_xml(PATH, text, lines=LineIndex(text), before=before)


def shape(document: Document) -> tuple[object, ...]:
    return document.children, document.problems, document.entities, document.digest


def elements(document: Document) -> list[Element]:
    return [*document.root.elements] if document.root is not None else []


@pytest.mark.parametrize("seed", range(10))
def test_after_random_edits_nothing_tells_what_was_parsed_before(seed: int) -> None:
    chance = random.Random(seed)
    text, taken_over = TEXT, 0
    document, launch_file = parsed(text), read_launch(Text.of(PATH, text))
    for _ in range(120):
        start = chance.randrange(len(text) + 1)
        end = min(len(text), start + chance.choice((0, 0, 0, 1, 3, 20)))
        edited = text[:start] + chance.choice(("", *PIECES, text[end : end + 30])) + text[end:]
        if chance.random() < 0.4:
            edited = TEXT  # most of what is typed is well-formed again soon
        now, alone = parsed(edited, document), parsed(edited)
        assert shape(now) == shape(alone)
        file_now = read_launch(Text.of(PATH, edited), before=launch_file)
        file_alone = read_launch(Text.of(PATH, edited))
        assert (file_now.root, file_now.extra_roots) == (file_alone.root, file_alone.extra_roots)
        before = {id(element.original) for element in elements(document)}
        taken_over += any(id(element.original) in before for element in elements(now))
        text, document, launch_file = edited, now, file_now
    assert taken_over


@pytest.mark.parametrize(
    ("old", "new", "kept"),
    [
        ('default="5"', 'default="50"', 3),
        ("\n  <arg", "\n\n  <arg", 4),
        ('name="two"', 'name="zwei"', 3),
        ("</group>", '</group><arg name="x"/>', 4),
        ("\n</launch>", "\n\n</launch>", 4),
        ('  <node pkg="p" type="t" name="one">', "  <!-- <node> --><node>", 3),
    ],
)
def test_tags_that_an_edit_does_not_touch_are_those_of_before(old: str, new: str, kept: int) -> None:
    before = parsed(TEXT)
    now = parsed(TEXT.replace(old, new), before)
    originals = {id(element) for element in elements(before)}
    assert sum(id(element.original) in originals for element in elements(now)) == kept


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("<group ", "<!-- <group "),  # up to a comment's end further below
        ("  <arg", "  <a><arg"),  # all that follows is in it
        ("</group>", "</group></launch>"),
        ("<launch>", "<launch ns='x'>"),
        ("  <arg", "  text & <arg"),
        ("  <arg", "  ]]><arg"),
        ("<?xml", "<!DOCTYPE launch><?xml"),
    ],
)
def test_what_reaches_further_is_left_to_the_whole(old: str, new: str) -> None:
    text = TEXT.replace(old, new)
    assert edited_children(parsed(TEXT), text, LineIndex(text)) is None


def test_an_element_that_was_moved_is_moved_from_where_it_was_parsed() -> None:
    document = parsed(TEXT)
    last = elements(document)[-1]
    for number in range(1, 4):
        text = TEXT.replace("<arg", " " * number + "<arg")
        document = parsed(text, document)
        moved = elements(document)[-1]
        assert moved.original is last
        assert text[slice(*moved.span)] == TEXT[slice(*last.span)]
    assert elements(parsed(TEXT, document))[-1] is last
