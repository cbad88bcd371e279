"""Annotations: read from elements and comments, used where no run tells better, written from a run."""

import xml.etree.ElementTree as ET
from dataclasses import replace

import pytest
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.edits.edit import Edit
from preflight_analysis.evaluation.tree import LaunchNode, Tag
from preflight_analysis.findings.printable import printable
from preflight_analysis.graph.annotations import (
    annotation_edits,
    annotation_template,
    annotation_text,
    read_annotation,
)
from preflight_analysis.interfaces.declared import annotated
from preflight_analysis.interfaces.merge import Provider
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.ros1_xml import read_ros1
from preflight_analysis.tracing.interface import NOT_RUN, Endpoint, ParamUse
from support.check import analyse, interface_from_json, read_fixture


def node_action(text: str) -> Action:
    root = read_ros1(parse_xml("/main.launch", text)).root
    assert root is not None
    return next(action for action in root.walk() if action.kind == "node")


def _node(text: str) -> LaunchNode:
    (node,) = analyse(read_fixture(text)).tree.nodes
    return node


ANNOTATED = Provider(annotated)
CONTENT = (
    '<topics><topic name="chatter" type="std_msgs/String" class="sub"/><topic name="~out" class="pub"/></topics>'
    '<services><service name="reset" type="std_srvs/Trigger" class="server"/></services>'
    '<params><param name="~rate" default="10"/></params>'
    '<actions><action name="dock" type="x/Dock" class="client"/></actions>'
)


@pytest.mark.parametrize("form", [CONTENT, f"<!-- {CONTENT} -->", f"<!--\n{CONTENT}\n--> <!-- words -->"])
def test_elements_and_comments_say_the_same(form: str) -> None:
    interface, problems = read_annotation(
        node_action(f'<launch><node pkg="p" type="t" name="n">{form}</node></launch>')
    )
    assert problems == ()
    assert interface is not None
    assert interface.source == "annotation"
    assert interface.endpoints == (
        Endpoint("subscriber", "chatter", "std_msgs/String"),
        Endpoint("publisher", "~out", None),
        Endpoint("service", "reset", "std_srvs/Trigger"),
        Endpoint("action_client", "dock", "x/Dock"),
    )
    assert interface.params == (ParamUse("~rate", "get", "10", True),)


@pytest.mark.parametrize(
    ("inside", "underlined", "message"),
    [
        (
            '<topics><topic type="x/Y" class="pub"/></topics>',
            '<topic type="x/Y" class="pub"/>',
            "required attribute 'name'",
        ),
        ('<topics><topic name="a b" class="pub"/></topics>', "a b", "invalid name"),
        ('<topics><topic name="$(arg t)" class="pub"/></topics>', "$(arg t)", "substitutions are not evaluated"),
        ('<topics><topic name="a" class="out"/></topics>', "out", "allowed: pub, sub"),
        ('<topics><topic name="a"/></topics>', '<topic name="a"/>', "required attribute 'class'"),
        ('<topics><topic name="a" type="std msgs/String" class="pub"/></topics>', "std msgs/String", "package/Name"),
        ('<topics><topic name="a" class="pub" qos="1"/></topics>', "1", "unknown attribute 'qos'"),
        ('<topics><service name="a" class="server"/></topics>', "service", "expected <topic>"),
    ],
)
@pytest.mark.parametrize("comment", [False, True])
def test_what_is_malformed_is_shown_where_it_is(inside: str, underlined: str, message: str, comment: bool) -> None:
    form = f"<!-- {inside} -->" if comment else inside
    text = f'<launch>\n<node pkg="p" type="t" name="n">{form}</node></launch>'
    interface, (problem,) = read_annotation(node_action(text))
    assert interface is not None
    assert interface.endpoints == ()
    assert text[problem.span.start : problem.span.end] == underlined
    assert message in problem.message


def test_a_comment_that_is_no_xml_is_a_problem_within_the_comment() -> None:
    text = '<launch><node pkg="p" type="t" name="n"><!-- <topics><topic name="a" class="pub"> --></node></launch>'
    _, problems = read_annotation(node_action(text))
    assert problems
    start, end = text.index("<!--"), text.index("-->")
    assert all(start <= problem.span.start <= problem.span.end <= end for problem in problems)


def test_other_comments_are_left_alone() -> None:
    node = _node('<launch><node pkg="p" type="t" name="n"><!-- <param name="a"/> see < b --></node></launch>')
    assert read_annotation(node.action) == (None, ())
    assert ANNOTATED.added(node, NOT_RUN) is NOT_RUN


def test_a_run_that_spun_beats_the_annotation_and_one_that_failed_is_completed() -> None:
    node = _node(f'<launch><node pkg="p" type="t" name="n">{CONTENT}</node></launch>')
    spun = interface_from_json({"publishers": {"other": "x/Y"}})
    assert ANNOTATED.added(node, spun) is spun
    crashed = interface_from_json({"status": "crashed", "exit_code": 1, "subscribers": {"chatter": "x/Seen"}})
    both = ANNOTATED.added(node, crashed)
    assert both.source == "annotation"
    assert both.outcome == crashed.outcome
    assert both.complete
    assert [(e.name, e.type) for e in both.endpoints if e.role == "subscriber"] == [("chatter", "x/Seen")]
    assert len(both.endpoints) == 4


def test_what_is_written_reads_back() -> None:
    traced = interface_from_json(
        {
            "publishers": {"chatter": "std_msgs/String", "/rosout": "rosgraph_msgs/Log", "late": "x/Y"},
            "subscribers": {"any": "*"},
            "clients": {"reset": "std_srvs/Empty"},
            "params": {"~rate": 10},
            "builtin": ["/rosout"],
            "speculative": ["late"],
        }
    )
    text = annotation_text(traced, "    ")
    assert "--" not in text.removeprefix("<!--").removesuffix("-->")
    read, problems = read_annotation(node_action(f'<launch><node pkg="p" type="t" name="n">{text}</node></launch>'))
    assert problems == ()
    assert read is not None
    assert {(e.role, e.name, e.type) for e in read.endpoints} == {
        ("publisher", "chatter", "std_msgs/String"),
        ("subscriber", "any", "*"),
        ("client", "reset", "std_srvs/Empty"),
    }
    assert [use.name for use in read.params] == ["~rate"]
    assert annotation_text(interface_from_json({})) == ""


def edited(text: str, edit: Edit) -> str:
    span = edit.location.span
    return text[: span.start] + edit.text + text[span.end :]


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (
            '<launch>\n  <node pkg="p" type="t" name="n" />\n</launch>\n',
            '<launch>\n  <node pkg="p" type="t" name="n">\n    BODY\n  </node>\n</launch>\n',
        ),
        (
            '<launch>\n\t<node pkg="p" type="t" name="n">\n\t\t<env name="" value=""/>\n\t</node>\n</launch>',
            '<launch>\n\t<node pkg="p" type="t" name="n">\n\t\tBODY\n\t\t<env name="" value=""/>\n\t</node>\n</launch>',
        ),
        (
            '<launch>\r\n<node pkg="p" type="t" name="n"></node>\r\n</launch>\r\n',
            '<launch>\r\n<node pkg="p" type="t" name="n">\r\n  BODY\r\n</node>\r\n</launch>\r\n',
        ),
    ],
)
def test_the_edit_opens_the_tag_and_keeps_the_style(before: str, after: str) -> None:
    context = analyse(read_fixture('<launch><node pkg="p" type="t" name="n"/></launch>'))
    document = parse_xml("/main.launch", before)
    root = read_ros1(document).root
    assert root is not None
    node = context.tree.nodes[0]
    node = node._replace(tag=Tag(root.children[0], document.location(root.children[0].head_span)))
    text = annotation_text(interface_from_json({"publishers": {"a": "x/Y"}}))
    (edit,) = annotation_edits(node, text, document)
    result = edited(before, edit)
    start, end = result.index("<!--"), result.index("-->") + 3
    assert result[:start] + "BODY" + result[end:] == after
    assert parse_xml("/main.launch", result).problems == ()
    newlines = {line[-2:] for line in result.splitlines(keepends=True)}
    assert newlines == {"\r\n"} if "\r\n" in before else "\r\n" not in newlines
    action, of_result = node_action(result), parse_xml("/main.launch", result)
    again = node._replace(tag=Tag(action, of_result.location(action.head_span)))
    assert annotation_edits(again, text, document) == ()
    assert annotation_edits(node, "", document) == ()


def test_a_tag_that_is_still_being_typed_is_left_alone() -> None:
    context = analyse(read_fixture('<launch><node pkg="p" type="t" name="n"/></launch>'))
    document = parse_xml("/main.launch", '<launch>\n  <node pkg="p" type="t" name="n"')
    root = read_ros1(document).root
    assert root is not None
    node = context.tree.nodes[0]._replace(tag=Tag(root.children[0], document.location(root.children[0].head_span)))
    assert annotation_edits(node, annotation_template(), document) == ()


def test_the_template_has_one_of_each_to_fill_in() -> None:
    text = annotation_template()
    assert text.count("<topic ") == 2
    assert text.count("<service ") == 2
    assert "<param " in text
    read, problems = read_annotation(node_action(f'<launch><node pkg="p" type="t" name="n">{text}</node></launch>'))
    assert read is not None
    assert read.endpoints == ()
    assert "required attribute 'name'" in problems[0].message


@pytest.mark.parametrize("name", ["a--b", "--", "---", "a-->b", "x\ny", "<!--", "é\x1b"])
def test_no_name_breaks_the_comment(name: str) -> None:
    """A node may send what it likes; the file stays well-formed, and the name is read as it was."""
    interface = replace(NOT_RUN, source="trace", endpoints=(Endpoint("publisher", name, "std_msgs/String"),))
    comment = annotation_text(interface)
    ET.fromstring(f"<launch>{comment}</launch>")
    inside = ET.fromstring(f"<launch>{comment.removeprefix('<!--').removesuffix('-->')}</launch>")
    assert [topic.get("name") for topic in inside.iter("topic")] == [printable(name)]
