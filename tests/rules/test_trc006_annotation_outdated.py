"""TRC006: an annotation says something else than the run of its node showed."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import pytest
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.build import build_graph
from preflight_analysis.rules.registry import run_rules
from support.check import Fixture, analyse, check, findings_of, interfaces_of


def test_another_type_is_a_warning() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <!-- <topics><topic name="/tf" type="tf/tfMessage" class="pub"/></topics> -->
                                                 ^^^^^^^^^^^^ warning[TRC006] annotation of '/tf' has another type
          </node>
        </launch>
        //- interfaces
        {"/n": {"publishers": {"/tf": "tf2_msgs/TFMessage"}}}
    """)


def test_another_type_is_one_where_the_run_failed_too() -> None:
    interface = {"services": {"reset": "std_srvs/Trigger"}, "status": "crashed", "exit_code": 1}
    assert complaints(
        '<services><service name="reset" type="std_srvs/Empty" class="server"/></services>', interface
    ) == ["annotation of 'reset' has another type than the run of /n: std_srvs/Trigger"]


def test_what_was_not_seen_and_what_is_missing_are_hints() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <!-- <services><service name="later" type="std_srvs/Empty" class="server"/></services> -->
                 ^^^^^^^^^^ hint[TRC006] annotation of /n is incomplete: in its run it offers the service 'now'
                                          ^^^^^ hint[TRC006] annotation of 'later' is not confirmed: the run of /n
          </node>
        </launch>
        //- interfaces
        {"/n": {"services": {"now": "std_srvs/Trigger"}, "params": {"~rate": 1}}}
    """)


def test_a_name_that_was_misspelt_or_renamed() -> None:
    (finding,) = [
        f
        for f in check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <!-- <services><service name="rest" type="std_srvs/Empty" class="server"/></services> -->
                 ^^^^^^^^^^ hint[TRC006] offers the service 'reset'
                                          ^^^^ info[TRC006] did you mean 'reset'?
          </node>
        </launch>
        //- interfaces
        {"/n": {"services": {"reset": "std_srvs/Empty"}}}
    """)
        if f.severity == "info"
    ]
    assert [fix.title for fix in finding.fixes] == [
        "Replace 'rest' with 'reset'",
        "Remove 'rest' from the annotation",
    ]


@pytest.mark.silent
@pytest.mark.parametrize(
    ("annotation", "interface"),
    [
        # alike, also by full names, and with an action as such or by its topics
        ('<topics><topic name="/a" type="x/Y" class="pub"/></topics>', {"publishers": {"a": "x/Y"}}),
        ('<topics><topic name="a" class="pub"/></topics>', {"publishers": {"a": "x/Y"}}),
        ('<topics><topic name="a" type="x/Y" class="pub"/></topics>', {"publishers": {"a": "*"}}),
        # what every node has, what rests on a made-up answer, and parameters where none are annotated
        (
            '<topics><topic name="a" class="pub"/></topics>',
            {"publishers": {"a": "x/Y", "/rosout": "x/L", "b": "x/Y"}, "builtin": ["/rosout"], "speculative": ["b"]},
        ),
        ('<topics><topic name="a" class="pub"/></topics>', {"publishers": {"a": "x/Y"}, "params": {"~p": 1}}),
        # a run that did not come to its end says nothing of what is not there
        (
            '<services><service name="a" type="x/Y" class="server"/></services>',
            {"services": {"b": "x/Y"}, "status": "timed-out"},
        ),
        (
            '<services><service name="a" type="x/Y" class="server"/></services>',
            {"services": {"b": "x/Y"}, "answers": ["it waits"]},
        ),
        ('<services><service name="a" type="x/Y" class="server"/></services>', {"status": "not-run"}),
        # what is malformed may be meant for it
        ('<services><service name="a" class="sever"/></services>', {"services": {"a": "x/Y"}}),
    ],
)
def test_it_is_silent(annotation: str, interface: dict[str, Any]) -> None:
    assert complaints(annotation, interface) == []


def fixture(annotation: str, interface: dict[str, Any]) -> str:
    text = f'<launch>\n  <node pkg="p" type="t" name="n">\n    <!-- {annotation} -->\n  </node>\n</launch>'
    return f"{text}\n//- interfaces\n{json.dumps({'/n': interface})}\n"


def complaints(annotation: str, interface: dict[str, Any]) -> list[str]:
    return [f.message for f in findings_of(fixture(annotation, interface)) if f.rule == "TRC006"]


TOPICS = [f"go/{name}" for name in ("goal", "cancel", "status", "feedback", "result")]
CLIENT = {
    "publishers": {"go/goal": "x/GoActionGoal", "go/cancel": "actionlib_msgs/GoalID"},
    "subscribers": {
        "go/status": "actionlib_msgs/GoalStatusArray",
        "go/feedback": "x/GoActionFeedback",
        "go/result": "x/GoActionResult",
    },
}


@pytest.mark.parametrize("type_", ["x/Go", "x/GoAction"])
def test_an_action_is_annotated_as_such_or_by_its_topics(type_: str) -> None:
    assert complaints(f'<actions><action name="go" type="{type_}" class="client"/></actions>', CLIENT) == []
    topics = "".join(f'<topic name="{n}" class="{"pub" if n in CLIENT["publishers"] else "sub"}"/>' for n in TOPICS)
    assert complaints(f"<topics>{topics}</topics>", CLIENT) == []
    (other,) = complaints('<actions><action name="go" type="x/Halt" class="client"/></actions>', CLIENT)
    assert "the run of /n: x/GoAction" in other


def test_a_tag_that_makes_several_nodes_is_judged_by_all_of_them() -> None:
    text = """
        <launch>
          <include file="/inner.launch"/>
          <group ns="b"><include file="/inner.launch"/></group>
        </launch>
        //- /inner.launch
        <launch>
          <node pkg="p" type="t" name="n">
            <!-- <services><service name="a" type="x/Y" class="server"/></services> -->
          </node>
        </launch>
        //- interfaces
        {"/n": {"services": {"a": "x/Y", "c": "x/Y"}}, "/b/n": %s}
    """
    assert [f for f in findings_of(text % '{"services": {"b": "x/Y"}}') if f.rule == "TRC006"] == []
    both = [f for f in findings_of(text % '{"services": {"c": "x/Y"}}') if f.rule == "TRC006"]
    assert [f.message.partition(": ")[0] for f in both] == ["annotation of /n is incomplete"]


RUN = {"publishers": {"a": "x/New", "b": "x/Y"}, "services": {"s": "x/S"}, "params": {"~rate": 1}}
NODE = '<node pkg="p" type="t" name="n">'


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (  # on lines of its own, with the user's words and attributes in the user's order
            """<launch>
  <node pkg="p" type="t" name="n">
    <!-- <topics>
           <topic class="pub"  type='x/Old' name="a" />
         </topics> -->
  </node>
</launch>
""",
            """<launch>
  <node pkg="p" type="t" name="n">
    <!-- <topics>
           <topic class="pub"  type='x/New' name="a" />
           <topic name="b" type="x/Y" class="pub"/>
         </topics><services><service name="s" type="x/S" class="server"/></services> -->
  </node>
</launch>
""",
        ),
        (  # as this program writes it
            f"""<launch>
\t{NODE}
\t\t<!--
\t\t  <topics>
\t\t    <topic name="a" type="x/New" class="pub"/>
\t\t  </topics>
\t\t  <params/>
\t\t-->
\t</node>
</launch>
""",
            f"""<launch>
\t{NODE}
\t\t<!--
\t\t  <topics>
\t\t    <topic name="a" type="x/New" class="pub"/>
\t\t    <topic name="b" type="x/Y" class="pub"/>
\t\t  </topics>
\t\t  <params>
\t\t  \t<param name="~rate"/>
\t\t  </params>
\t\t  <services>
\t\t  \t<service name="s" type="x/S" class="server"/>
\t\t  </services>
\t\t-->
\t</node>
</launch>
""",
        ),
        (  # elements, on one line
            f'<launch>{NODE}<topics><topic name="a" class="pub"/></topics></node></launch>',
            f'<launch>{NODE}<topics><topic name="a" class="pub"/><topic name="b" type="x/Y" class="pub"/></topics>'
            '<services><service name="s" type="x/S" class="server"/></services></node></launch>',
        ),
        (  # an empty group with an end tag
            f"<launch>\n  {NODE}\n    <topics>\n    </topics>\n    <services></services>\n  </node>\n</launch>\n",
            f'<launch>\n  {NODE}\n    <topics>\n      <topic name="a" type="x/New" class="pub"/>\n'
            '      <topic name="b" type="x/Y" class="pub"/>\n    </topics>\n    <services>\n'
            '      <service name="s" type="x/S" class="server"/>\n    </services>\n  </node>\n</launch>\n',
        ),
    ],
)
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_it_is_brought_up_to_date_in_the_users_style(before: str, after: str, newline: str, mark: str) -> None:
    text, wanted = (mark + each.replace("\n", newline) for each in (before, after))
    assert brought_up_to_date(text) == wanted
    assert parse_xml("/main.launch", wanted).problems == ()
    assert "TRC006" not in [f.rule for f in findings(wanted)]


def findings(text: str) -> list[Finding]:
    context = analyse(Fixture({"/main.launch": text}, "/main.launch", {}, {}, ()))
    graph = build_graph(context.tree, interfaces_of(context.tree, {"/n": RUN}))
    return run_rules(replace(context, graph=graph))


def brought_up_to_date(text: str) -> str:
    fixes = {
        fix for f in findings(text) if f.rule == "TRC006" for fix in f.fixes if "Update the annotation" in fix.title
    }
    (fix,) = fixes
    for edit in sorted(fix.edits, key=lambda e: e.location.span, reverse=True):
        start, end = edit.location.span
        text = text[:start] + edit.text + text[end:]
    return text


def test_what_was_not_seen_can_be_removed_with_its_line() -> None:
    item = '      <service name="later" type="x/Y" class="server"/>\n'
    text = f"<launch>\n  {NODE}\n    <!-- <services>\n{item}    </services> -->\n  </node>\n</launch>\n"
    (finding,) = [f for f in findings(text) if "'later'" in f.message]
    (fix,) = [fix for fix in finding.fixes if fix.title == "Remove 'later' from the annotation"]
    (edit,) = fix.edits
    start, end = edit.location.span
    assert text[:start] + edit.text + text[end:] == text.replace(item, "")


def test_what_agreed_once_is_compared_again_where_something_changed() -> None:
    both = """
        <launch>
          <include file="/inner.launch"/>
          <group ns="b" if="%s"><include file="/inner.launch"/></group>
        </launch>
        //- /inner.launch
        <launch>
          <node pkg="p" type="t" name="n">
            <param name="own" value="1"/>
            <!-- <services><service name="rarely" type="x/Y" class="server"/></services> -->
          </node>
        </launch>
        //- interfaces
        %s
    """
    one, other = '"/n": {}', '"/b/n": {"services": {"rarely": "x/Y"}}'
    for _ in range(2):
        assert "TRC006" not in [f.rule for f in findings_of(both % (1, f"{{{one}, {other}}}"))]
        assert "TRC006" in [f.rule for f in findings_of(both % (0, f"{{{one}}}"))]
