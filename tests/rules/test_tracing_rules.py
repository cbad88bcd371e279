"""TRC: how the nodes' runs ended, or why there were none."""

import json

import pytest
from support.check import check, findings_of


def test_a_crash_says_why() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TRC001] exit code 1; FileNotFoundError: no such file: '/m.json'
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "stderr":
                ["Traceback (most recent call last):", "FileNotFoundError: no such file: '/m.json'", "[shutdown]", ""]}}
    """)


def test_a_crash_after_a_made_up_answer_may_be_our_doing() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001] killed by SIGSEGV
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "signal": "SIGSEGV", "publishers": {"/tf": "x/Y"}, "speculative": ["/tf"]}}
    """)


def test_an_end_after_a_made_up_answer_may_be_our_doing_even_if_nothing_was_found_after_it() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001] IndexError
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "stderr": ["IndexError: 0"], "answers": ["it got an empty scan"]}}
    """)


def test_absence_after_a_made_up_answer_is_not_sure() -> None:
    for answers, sure in (([], "likely"), (["it got an empty scan"], "possible")):
        (finding,) = findings_of(f"""
            <launch><node pkg="p" type="t" name="n"/><node pkg="p" type="t" name="m"/></launch>
            //- interfaces
            {{"/n": {{"publishers": {{"chatter": "std_msgs/String"}}, "answers": {json.dumps(answers)}}},
              "/m": {{"subscribers": {{"chater": "std_msgs/String"}}}}}}
        """)
        assert (finding.rule, finding.confidence) == ("TOP001", sure)


def test_a_crash_for_want_of_a_command_that_was_not_run_is_our_doing() -> None:
    check("""
        <launch>
          <param name="robot_description" command="xacro robot.xacro"/>
                                                   ^^^^^^^^^^^^^^^^^ hint[LCH018] was not run
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001] asked for '/robot_description', which comes from a command
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "params": {"/robot_description": null}}}
        //- commands
        {"xacro robot.xacro": {"status": "not-run", "reason": "--no-run was given"}}
    """)


@pytest.mark.parametrize(
    "setting",
    [
        '<param name="robot_description" command="$(find nowhere)/xacro r.xacro"/>',
        '<param name="robot_description" textfile="$(find p)/r.urdf"/>',
        '<param name="robot_description" value="$(env NOT_SET_HERE)"/>',
        '<param name="robot_description" type="int" value="none"/>',
        '<rosparam param="robot_description" command="load" file="$(find p)/r.yaml"/>',
        '<rosparam file="$(find p)/r.yaml"/>',
        '<rosparam param="robot_description">{</rosparam>',
    ],
)
@pytest.mark.parametrize("access", ["get", "has"])
def test_a_crash_for_want_of_a_value_that_is_reported_itself_is_a_consequence(setting: str, access: str) -> None:
    found = findings_of(f"""
        <launch>
          {setting}
          <node pkg="p" type="t" name="n"/>
        </launch>
        //- interfaces
        {{"/n": {{"status": "crashed", "exit_code": 1, "params": {{"/robot_description": {{"access": "{access}"}}}},
                 "stderr": ["Could not find parameter robot_description on parameter server"]}}}}
    """)
    (crash,) = (each for each in found if each.rule != "PRM010" and each.rule.startswith(("TRC", "PRM01")))
    assert (crash.rule, crash.severity, crash.confidence) == ("TRC001", "info", "possible")
    assert "it asked for '/robot_description', which has no value: " in crash.message
    assert any(each.stops_launch for each in found)


def test_a_crash_for_want_of_a_private_value_that_is_reported_itself_is_a_consequence() -> None:
    check("""
        <launch>
          <param name="~model" value="$(find nowhere)/m"/>
                                      ^^^^^^^^^^^^^^^ error[PKG001] package 'nowhere' is not among
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001] asked for '/n/model', which has no value
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "params": {"~model": null}}}
    """)


def test_a_crash_for_another_reason_stays_a_warning_where_a_value_is_missing() -> None:
    check("""
        <launch>
          <param name="robot_description" value="$(find nowhere)/m"/>
                                                 ^^^^^^^^^^^^^^^ error[PKG001] package 'nowhere' is not among
          <param name="model" value="x"/>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TRC001] exit code 1
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "params": {"/model": null}}}
    """)


def test_a_crash_for_what_only_the_sandbox_lacks_is_no_warning() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001] /n needs a network; it ended with exit code 1; OSError
        </launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "lacks": "a network",
                 "stderr": ["OSError: [Errno 101] Network is unreachable"]}}
    """)


def test_an_early_end_and_a_slow_start() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="done"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC002] /done ended by itself when it was run, without error
          <node pkg="p" type="t" name="slow"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC003] before it reached its event loop: still waiting
          <node pkg="p" type="t" name="failed"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TRC001] exit code 3
        </launch>
        //- interfaces
        {"/done": {"status": "exited", "exit_code": 0}, "/slow": {"status": "timed-out", "reason": "still waiting"},
         "/failed": {"status": "exited", "exit_code": 3}}
    """)


def test_why_nothing_was_run_is_said_once() -> None:
    text = """
        <launch>
        ^^^^^^^^ info[TRC004] the 2 nodes of this launch were not run: the workspace is not trusted
          <node pkg="p" type="t" name="a"/>
          <node pkg="p" type="t" name="b"/>
        </launch>
    """
    check(text, why_not_run="the workspace is not trusted")
    check("<launch/>", why_not_run="the workspace is not trusted")


def test_nodes_that_were_not_run_are_told_together() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="a"/>
          <node pkg="p" type="t" name="b"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC004] not run: /b, /c; a value is unknown
          <node pkg="p" type="t" name="c"/>
          <node pkg="p" type="t" name="d">
            <!-- <topics><topic name="/tf" type="tf2_msgs/TFMessage" class="pub"/></topics> -->
          </node>
        </launch>
        //- interfaces
        {"/a": {}, "/b": {"status": "not-run", "reason": "a value is unknown"},
         "/c": {"status": "not-run", "reason": "a value is unknown"}}
    """)


def test_notes_of_a_run() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC005] /n: tried to write /home/me/x
        </launch>
        //- interfaces
        {"/n": {"notes": ["tried to write /home/me/x"]}}
    """)


def test_a_node_that_spins_is_not_mentioned() -> None:
    assert (
        findings_of("""
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {"/n": {}}
    """)
        == []
    )


def test_a_long_last_line_is_told_once_and_without_its_time() -> None:
    line = "[FATAL] [1795283767.248522279]: " + "no such device, " * 40
    reason = "it ended with exit code 1: " + ("no such device, " * 40)[:200]
    text = """
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {"/n": {"status": "crashed", "exit_code": 1, "reason": "REASON", "stderr": ["LINE"]}}
    """
    (finding,) = findings_of(text.replace("LINE", line).replace("REASON", reason))
    assert finding.message == f"/n crashed when it was run: {reason}"
    (finding,) = findings_of(text.replace("LINE", line).replace('"reason": "REASON", ', ""))
    assert finding.message == "/n crashed when it was run: exit code 1; " + ("no such device, " * 40)[:200]
