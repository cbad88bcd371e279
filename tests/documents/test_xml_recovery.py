"""Half-typed and broken files: what is reported where, and the tree that is left.

Lines of `^` stand under the place that they speak of, with its message; they are taken out before parsing, and the
problems must be these and no others.
"""

from __future__ import annotations

import re
import textwrap

from preflight_analysis.documents.document import Comment, Document, Element, Node, Text
from preflight_analysis.documents.xml import parse_xml

_ANNOTATION = re.compile(r"^ *(\^+) (.*)$")


def check(annotated: str, tree: str) -> Document:
    """Parse what `annotated` holds; compare all its problems with the annotations and its elements with `tree`."""
    lines: list[str] = []
    expected: list[str] = []
    for line in textwrap.dedent(annotated).strip("\n").split("\n"):
        if found := _ANNOTATION.match(line):
            expected.append(f"{len(lines)}:{found.start(1) + 1}+{len(found[1])} {found[2]}")
        else:
            lines.append(line)
    document = parse_xml("/test.launch", "\n".join(lines) + "\n")
    problems = []
    for problem in document.problems:
        line, column = document.lines.position(problem.span.start)
        problems.append(f"{line + 1}:{column + 1}+{problem.span.end - problem.span.start} {problem.message}")
    assert problems == expected
    assert " ".join(filter(None, map(sketch, document.children))) == tree
    return document


def sketch(node: Node) -> str:
    if isinstance(node, Comment):
        return f"#{node.content.text.strip()}#"
    if isinstance(node, Text):
        return f"'{stripped}'" if (stripped := node.content.text.strip()) else ""
    attributes = "".join(f" {a.name}={a.value.text}" for a in node.attributes)
    children = " ".join(filter(None, map(sketch, node.children)))
    return f"<{node.tag}{attributes}{f'>{children}</>' if children else '/>'}"


def test_start_tag_without_its_end_stops_before_the_next_tag() -> None:
    check(
        """
        <launch>
          <node pkg="a"
                ^^^^^^^ the tag <node> has no '>'
          <node pkg="b"/>
        </launch>
        """,
        "<launch><node pkg=a/> <node pkg=b/></>",
    )


def test_start_tag_without_its_end_keeps_its_children() -> None:
    check(
        """
        <launch>
          <group ns="a"
                 ^^^^^^ the tag <group> has no '>'
            <node pkg="b"/>
          </group>
        </launch>
        """,
        "<launch><group ns=a><node pkg=b/></></>",
    )


def test_unfinished_attribute_before_a_line_break_does_not_take_the_next_tag() -> None:
    check(
        """
        <launch>
          <node pkg="a" type=
                        ^^^^^ a value in quotes is missing after 'type='
          <node pkg="b"/>
        </launch>
        """,
        "<launch><node pkg=a type=/> <node pkg=b/></>",
    )


def test_unfinished_attribute_before_another_one() -> None:
    check(
        """
        <launch>
          <node type= name="n"/>
                ^^^^^ a value in quotes is missing after 'type='
          <node type=
                ^^^^^ a value in quotes is missing after 'type='
                name="n"/>
          <node type
                ^^^^ the attribute 'type' has no value
                name="n"/>
        </launch>
        """,
        "<launch><node type= name=n/> <node type= name=n/> <node type= name=n/></>",
    )


def test_value_without_quotes() -> None:
    check(
        """
        <launch>
          <node pkg=a type=$(arg x y)/>
                    ^ the value must stand in quotes
                           ^^^^^^^^^^ the value must stand in quotes
        </launch>
        """,
        "<launch><node pkg=a type=$(arg x y)/></>",
    )


def test_missing_closing_quote_before_the_next_attribute() -> None:
    check(
        """
        <launch>
          <remap from="a to="/b"/>
                      ^^ the closing " is missing
          <node pkg="a"/>
        </launch>
        """,
        "<launch><remap from=a to=/b/> <node pkg=a/></>",
    )


def test_missing_closing_quote_at_the_end_of_a_tag() -> None:
    check(
        """
        <launch>
          <node pkg="a" name="b/>
                             ^^ the closing " is missing
          <node pkg='c>
                    ^^ the closing ' is missing
            <param name="d"/>
          </node>
        </launch>
        """,
        "<launch><node pkg=a name=b/> <node pkg=c><param name=d/></></>",
    )


def test_value_that_was_just_begun() -> None:
    check(
        """
        <launch>
          <node pkg="
                    ^ the closing " is missing
          <node pkg="b"/>
        </launch>
        """,
        "<launch><node pkg=/> <node pkg=b/></>",
    )


def test_quote_of_a_value_over_two_lines_is_not_missing() -> None:
    check(
        """
        <launch>
          <node args="one
             two" name=n/>
                       ^ the value must stand in quotes
        </launch>
        """,
        "<launch><node args=one      two name=n/></>",
    )


def test_less_than_inside_a_value() -> None:
    check(
        """
        <launch>
          <node if="$(eval a < b)" pkg="a"/>
                             ^ '<' must be written as &lt; in a value
        </launch>
        """,
        "<launch><node if=$(eval a < b) pkg=a/></>",
    )


def test_lone_less_than() -> None:
    check(
        """
        <launch>
          <
          ^ '<' must be written as &lt; where it starts no tag
          <node pkg="a"/>
          <rosparam>a: 1 < 2</rosparam>
                         ^ '<' must be written as &lt; where it starts no tag
        </launch>
        """,
        "<launch>'<' <node pkg=a/> <rosparam>'a: 1' '< 2'</></>",
    )


def test_unclosed_element_is_named_and_closed_with_its_parent() -> None:
    check(
        """
        <launch>
          <group ns="a">
           ^^^^^ <group> is not closed
            <node pkg="a"/>
        </launch>
        """,
        "<launch><group ns=a><node pkg=a/></></>",
    )


def test_unclosed_element_does_not_take_its_siblings() -> None:
    document = check(
        """
        <launch>
          <node pkg="a">
           ^^^^ <node> is not closed
            <param name="x"/>
          <node pkg="b">
            <param name="y"/>
          </node>
        </launch>
        """,
        "<launch><node pkg=a><param name=x/></> <node pkg=b><param name=y/></></>",
    )
    assert document.root is not None
    first, second = document.root.elements
    assert first.span.end <= second.span.start


def test_unclosed_document_element_keeps_what_is_not_indented() -> None:
    check(
        """
        <launch>
         ^^^^^^ <launch> is not closed
        <node pkg="a">
         ^^^^ <node> is not closed
        <node pkg="b"/>
        """,
        "<launch><node pkg=a/> <node pkg=b/></>",
    )


def test_siblings_of_several_unclosed_elements_find_their_level() -> None:
    check(
        """
        <launch>
          <group ns="a">
           ^^^^^ <group> is not closed
            <group ns="b">
             ^^^^^ <group> is not closed
              <node pkg="n1"/>
            <node pkg="n2"/>
          <node pkg="n3"/>
        </launch>
        """,
        "<launch><group ns=a><group ns=b><node pkg=n1/></> <node pkg=n2/></> <node pkg=n3/></>",
    )


def test_misspelt_end_tag_closes_its_element() -> None:
    check(
        """
        <launch>
          <node pkg="a"></nod>
                          ^^^ expected </node>
          <node pkg="b"></Node>
                          ^^^^ expected </node>
          <group><node pkg="c"/></gropu>
                                  ^^^^^ expected </group>
        </lanch>
          ^^^^^ expected </launch>
        """,
        "<launch><node pkg=a/> <node pkg=b/> <group><node pkg=c/></></>",
    )


def test_stray_end_tags() -> None:
    check(
        """
        <launch>
          <node pkg="a"></param></node>
                          ^^^^^ </param> closes nothing
          </group>
            ^^^^^ </group> closes nothing
          <node pkg="b"/>
        </launch>
        """,
        "<launch><node pkg=a/> <node pkg=b/></>",
    )


def test_end_tags_being_typed() -> None:
    check(
        """
        <launch>
          <group><node pkg="a"/></
                                ^^ expected </group>
          <group><node pkg="b"/></gr
                                  ^^ the end tag </gr> has no '>'
                                  ^^ expected </group>
          </
          ^^ the name of an end tag is missing
        </launch>
        """,
        "<launch><group><node pkg=a/></> <group><node pkg=b/></></>",
    )


def test_attribute_given_twice_keeps_both() -> None:
    document = check(
        """
        <launch>
          <node pkg="a" pkg="b"/>
                        ^^^ the attribute 'pkg' is given twice
        </launch>
        """,
        "<launch><node pkg=a pkg=b/></>",
    )
    assert document.root is not None
    first = next(document.root.elements).get("pkg")
    assert first is not None
    assert first.value.text == "a"


def test_attributes_that_touch_and_things_that_are_none() -> None:
    check(
        """
        <launch>
          <node a="1"b="2" [x] ="3"/>
                     ^ a blank is missing before 'b'
                           ^^^ '[x]' does not belong in the tag <node>
                               ^ the name of an attribute is missing before '='
        </launch>
        """,
        "<launch><node a=1 b=2/></>",
    )


def test_end_of_an_empty_element_tag() -> None:
    check(
        """
        <launch>
          <node pkg="a" / >
                        ^ '/' must be followed by '>'
          <node pkg="b" /
                        ^ '/' must be followed by '>'
          <node pkg="c" //>
                        ^ '/' does not belong in the tag <node>
        </launch>
        """,
        "<launch><node pkg=a/> <node pkg=b/> <node pkg=c/></>",
    )


def test_only_one_document_element_and_no_text_around_it() -> None:
    check(
        """
        <launch/>
        <launch/>
         ^^^^^^ another element after the document element
        text
        """,
        "<launch/> <launch/> 'text'",
    )
    check(
        """
        text
        ^^^^ text before the document element
        <launch/>
        """,
        "'text' <launch/>",
    )


def test_comment_without_an_end_takes_its_line_only() -> None:
    check(
        """
        <launch>
          <!-- unclosed
          ^^^^ the comment is not closed with '-->'
          <node pkg="a"/>
          <!-- closed -->
          <!-- at the end
          ^^^^ the comment is not closed with '-->'
          <node pkg="b"/>
        </launch>
        """,
        "<launch>#unclosed# <node pkg=a/> #closed# #at the end# <node pkg=b/></>",
    )


def test_what_a_comment_cannot_hold() -> None:
    check(
        """
        <launch>
          <!-- outer <!-- inner --> <node/> -->
                     ^^^^ a comment cannot hold another one
          <!-- a -- b -->
                 ^^ '--' is not allowed in a comment
        </launch>
        """,
        "<launch>#outer <!-- inner --> <node/># #a -- b#</>",
    )


def test_references() -> None:
    check(
        """
        <launch>
          <param a="R&D" b="&nbsp;" c="&#0;" d="&#xD800;" e="&#99999999999;"/>
                     ^ '&' must be written as &amp;
                            ^^^^^^ the entity &nbsp; is not defined
                                       ^^^^ &#0; is not a character of XML
                                                ^^^^^^^^ &#xD800; is not a character of XML
                                                             ^^^^^^^^^^^^^^ &#99999999999; is not a character of XML
        </launch>
        """,
        "<launch><param a=R&D b=&nbsp; c=&#0; d=&#xD800; e=&#99999999999;/></>",
    )


def test_characters_and_marks_that_text_cannot_hold() -> None:
    check(
        """
        <launch>
          <rosparam>a: \x07</rosparam>
                       ^ the character U+0007 is not allowed in XML
          <rosparam>a: [[1]]></rosparam>
                          ^^^ ']]>' must be written as ]]&gt; in text
          <rosparam><![CDATA[a</rosparam>
                    ^^^^^^^^^ the CDATA section is not closed with ']]>'
        </launch>
        """,
        "<launch><rosparam>'a: \x07'</> <rosparam>'a: [[1]]>'</> <rosparam>'a'</></>",
    )


def test_prologue() -> None:
    check(
        """
        <?xml version="1.0">
        ^^^^^ '?>' is missing
        <launch/>
        """,
        "<launch/>",
    )
    check(
        """
        <!-- licence -->
        <?xml version="1.0"?>
        ^^^^^ the XML declaration must be the very first thing in the file
        <launch/>
        """,
        "#licence# <launch/>",
    )
    check(
        """
        <!DOCTYPE launch [
        ^^^^^^^^^ the DOCTYPE is not closed with '>'
        <launch/>
        """,
        "<launch/>",
    )


def test_what_only_expat_finds_is_reported_in_code_points() -> None:
    check(
        """
        <launch doc="äöü 🤖"><xacro:if/></launch>
                            ^^^^^^^^^ a prefix is used here that no xmlns:... attribute declares
        """,
        "<launch doc=äöü 🤖><xacro:if/></>",
    )


def test_file_that_ends_while_it_is_typed() -> None:
    check(
        """
        <launch>
         ^^^^^^ <launch> is not closed
          <no
           ^^ the tag <no> has no '>'
        """,
        "<launch><no/></>",
    )


def test_empty_files_have_no_root_and_no_problem() -> None:
    for text in ("", " \n\t", "\ufeff", "<!-- nothing yet -->\n", '<?xml version="1.0"?>\n'):
        document = parse_xml("/test.launch", text)
        assert (document.root, document.problems) == (None, ())


def test_spans_cover_what_they_name() -> None:
    document = check(
        """
        <launch>
          <node pkg="a" type= name='n'>
                        ^^^^^ a value in quotes is missing after 'type='
            text
          </node>
        </launch>
        """,
        "<launch><node pkg=a type= name=n>'text'</></>",
    )
    assert document.root is not None
    node = next(document.root.elements)

    def source(element: Element) -> list[str]:
        spans = [element.tag_span, element.open_span, element.span]
        for attribute in element.attributes:
            spans += [attribute.name_span, attribute.value.span, attribute.span]
        return [document.text[span.start : span.end] for span in spans]

    start = "<node pkg=\"a\" type= name='n'>"
    values = ["pkg", "a", 'pkg="a"', "type", "", "type=", "name", "n", "name='n'"]
    assert source(node) == ["node", start, start + "\n    text\n  </node>", *values]


def test_quotes_that_are_half_there_doubled_mixed_or_curly() -> None:
    check(
        """
        <launch>
          <node pkg="a" type=b" name="n"/>
                             ^^ the opening " is missing
          <node pkg="a" type=""b" name="n"/>
                              ^ there is one " too many
          <node pkg="a" type="b' name="n"/>
                             ^^^ the value starts with " and ends with '
          <node pkg="a" type='b" name="n"/>
                             ^^^ the value starts with ' and ends with "
          <node pkg="a" type=“b” name="n"/>
                             ^^^ the quotes must be straight ones
          <node pkg="a" type "b" name="n"/>
                        ^^^^ '=' is missing after 'type'
        </launch>
        """,
        "<launch>" + " ".join(["<node pkg=a type=b name=n/>"] * 6) + "</>",
    )


def test_what_looks_like_a_tag_or_a_comment() -> None:
    check(
        """
        <launch>
          < node pkg="a"/>
          ^^^^^^ there cannot be a blank after the '<' of a tag
          <<node pkg="b"/>
          ^ there is one '<' too many
          <!- one -->
          ^^^ a comment starts with '<!--'
          <-- two -->
          ^^^ a comment starts with '<!--'
          <node pkg="c"\\>
                       ^ '\\' must be '/'
        <<<<<<< HEAD
        ^^^^^^^ this is the mark of a merge conflict
        </launch>
        """,
        "<launch><node pkg=a/> <node pkg=b/> #one# #two# <node pkg=c/> 'HEAD'</>",
    )


def test_a_comment_in_a_tag() -> None:
    check(
        """
        <launch>
          <node pkg="a" <!-- type="b" --> name="n"/>
                        ^^^^^^^^^^^^^^^^^ a comment cannot stand in a tag
          <node pkg="a"
                ^^^^^^^ the tag <node> has no '>'
          <!-- type="b" -->
          <node pkg="c"/>
        </launch>
        """,
        '<launch><node pkg=a name=n/> <node pkg=a>#type="b"#</> <node pkg=c/></>',
    )


def test_an_end_tag_of_the_wrong_name_where_the_right_one_should_stand() -> None:
    check(
        """
        <launch>
          <group ns="a">
            <node pkg="b">
            </group>
              ^^^^^ expected </node>
          </node>
            ^^^^ expected </group>
          <node pkg="c"/>
        </launch>
        """,
        "<launch><group ns=a><node pkg=b/></> <node pkg=c/></>",
    )


def test_an_end_tag_too_many_is_not_taken_for_that_of_the_element_around_it() -> None:
    check(
        """
        <launch>
          <group ns="a">
            <node pkg="b"/>
            </node>
              ^^^^ </node> closes nothing, it is closed by its '/>' already
          </group>
          </group>
            ^^^^^ </group> closes nothing
        </launch>
        """,
        "<launch><group ns=a><node pkg=b/></></>",
    )


def test_an_end_tag_without_its_slash_or_its_bracket() -> None:
    check(
        """
        <launch>
          <group ns="a">
            <node pkg="b"/>
          <group>
           ^^^^^ '/' is missing: </group> is expected
          <group ns="c">
            <node pkg="d"/>
          /group>
          ^^^^^^^ '<' is missing before '/group>'
          <node pkg="e"/>
        </launch>
        """,
        "<launch><group ns=a><node pkg=b/></> <group/> <group ns=c><node pkg=d/> '/group>'</> <node pkg=e/></>",
    )


def test_a_start_tag_without_its_bracket() -> None:
    check(
        """
        <launch>
          node pkg="a" type="b">
          ^^^^ '<' is missing before 'node'
            <param name="c"/>
          </node>
        </launch>
        """,
        '<launch>\'node pkg="a" type="b">\' <param name=c/></>',
    )


def test_an_end_tag_that_is_typed_while_the_element_has_its_own() -> None:
    check(
        """
        <launch>
          <group ns="a">
            <node pkg="b"/>
          </
          ^^ expected </group>
          <node pkg="c"/>
          </
          ^^ the name of an end tag is missing
          <node pkg="d"/>
        </launch>
        """,
        "<launch><group ns=a><node pkg=b/></> <node pkg=c/> <node pkg=d/></>",
    )


def test_a_reference_without_its_semicolon() -> None:
    check(
        """
        <launch>
          <group if="$(eval a &lt 3)">&amplify</group>
                              ^^^ ';' is missing after '&lt'
                                      ^ '&' must be written as &amp;
        </launch>
        """,
        "<launch><group if=$(eval a &lt 3)>'&amplify'</></>",
    )


def test_the_xml_declaration() -> None:
    check(
        """
        <xml version="1.0"?>
        ^^^^ the XML declaration starts with '<?xml'
        <launch/>
        """,
        "<launch/>",
    )
    check(
        """
        <?xml version="1.0?>
        ^^^^^^^^^^^^^^^^^^^ not well-formed XML: XML declaration not well-formed
        <launch/>
        """,
        "<launch/>",
    )


def test_an_encoding_that_the_file_does_not_have() -> None:
    for name in ("UTF-16", "latin-9x"):
        message = f"the file is not in the encoding '{name}', or XML does not know it; it is UTF-8"
        check(
            f"""
            <?xml version="1.0" encoding="{name}"?>
                                          {"^" * len(name)} {message}
            <launch/>
            """,
            "<launch/>",
        )
    for name in ("UTF-8", "utf8", "ISO-8859-1", "us-ascii"):
        check(f"<?xml version='1.0' encoding='{name}'?><launch/>", "<launch/>")
