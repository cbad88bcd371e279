"""What kind of place a cursor is in, whatever the rest of the text looks like."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.queries.cursor import Place, place_at


def shown(marked: str) -> str:
    """Kind, word, and the tags and attribute around; `$0` is the cursor."""
    offset = marked.index("$0")
    text = marked.replace("$0", "")
    place = place_at(parse_xml("/a.launch", text), offset)
    if place is None:
        return "nothing"
    words = [place.kind, repr(text[place.word.start : place.word.end]), *(e.tag for e in place.parents)]
    if place.kind in ("attribute", "value"):
        assert place.element is not None
        words.append(f"<{place.element.tag} {place.attribute.name if place.attribute else ''}".rstrip())
    return " ".join(words)


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("$0", "content ''"),
        ("<$0", "element ''"),
        ("<lau$0", "element 'lau'"),
        ("<la$0un", "element 'laun'"),
        ("la$0un", "content 'laun'"),
        ("<launch>$0", "content '' launch"),
        ("<launch>$0</launch>", "content '' launch"),
        ("<launch></launch>$0", "content ''"),
        ("<launch><$0</launch>", "element '' launch"),
        ("<launch><no$0de/></launch>", "element 'node' launch"),
        ("<launch>\n  <no$0\n  <node/>\n</launch>", "element 'no' launch"),
        ("<launch>\n  <$0\n  <node/>\n</launch>", "element '' launch"),
        ("<launch>\n  <group>\n    <$0\n  <node/>\n</launch>", "element '' launch group"),
        ("<launch>\n  <node/>$0\n</launch>", "content '' launch"),
        ("<launch>\n  <group></group>$0\n</launch>", "content '' launch"),
        ("<launch><group></$0", "end-tag '' launch group"),
        ("<launch><group></$0\n</launch>", "end-tag '' launch group"),
        ("<launch><group></gr$0ou>\n</launch>", "end-tag 'grou' launch group"),
        ("<launch><group></group></$0", "end-tag '' launch"),
        ("<launch><node $0", "attribute '' launch <node"),
        ("<launch><node\n  $0\n  <param/>\n</launch>", "attribute '' launch <node"),
        ("<launch><node $0/></launch>", "attribute '' launch <node"),
        ("<launch><node pk$0g='a'/></launch>", "attribute 'pkg' launch <node pkg"),
        ("<launch><node pkg='a' na$0/></launch>", "attribute 'na' launch <node na"),
        ("<launch><node pkg='a'$0/></launch>", "nothing"),
        ("<launch><node pkg='a' /$0></launch>", "nothing"),
        ("<launch><node pkg=$0/></launch>", "nothing"),
        ("<launch><node pkg='$0'/></launch>", "value '' launch <node pkg"),
        ("<launch><node pkg='a$0b'/></launch>", "value 'ab' launch <node pkg"),
        ('<launch><node pkg="$0\n  <node/>\n</launch>', "value '' launch <node pkg"),
        ("<launch><node pkg=\"$0 type='b'/>\n</launch>", "value '' launch <node pkg"),
        ('<launch><include file="$(find $0\n</launch>', "value '$(find ' launch <include file"),
        ('<launch><include file="$(find $0/>\n</launch>', "value '$(find ' launch <include file"),
        ('<launch><group if="$(eval a < $03)"/></launch>', "value '$(eval a < 3)' launch <group if"),
        ("<launch><!-- <no$0 --></launch>", "nothing"),
        ("<launch><!-- <no$0", "nothing"),
        ("<launch><!-- --><$0</launch>", "element '' launch"),
        ("<launch><rosparam><![CDATA[ <$0 ]]></rosparam></launch>", "nothing"),
        ("<?xml version=$0", "nothing"),
        ("<?xml version='1.0'?><$0", "element ''"),
        ("<launch><rosparam>a: b$0</rosparam></launch>", "content 'b' launch rosparam"),
    ],
)
def test_places(text: str, place: str) -> None:
    assert shown(text) == place


_PIECES = ("<", ">", "/", "</", '"', "'", "=", " ", "\n", "node", "launch", "pkg", "$(", "find ", ")", "<!--", "-->")


@given(st.lists(st.sampled_from((*_PIECES, "é", "🤖", "<?", "<![CDATA[", "]]>")), max_size=40), st.integers(0, 80))
def test_any_text_has_a_place_or_none(pieces: list[str], at: int) -> None:
    text = "".join(pieces)
    offset = min(at, len(text))
    place = place_at(parse_xml("/a.launch", text), offset)
    if isinstance(place, Place):
        assert 0 <= place.word.start <= offset <= place.word.end <= len(text)
