"""`check --fix`, `--diff` and `--add-noqa`: what is written, and what is left alone."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import digest
from preflight_analysis.documents.span import LineIndex, Span
from preflight_analysis.edits.edit import Edit
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.findings.report import Report
from preflight_server.cli.fixing import key_of, planned
from support.editor_harness import Harness

pytestmark = pytest.mark.ros
Run = Callable[..., Any]

WRONG = """<launch>
  <arg name="rate" defualt="10"/>
  <nod pkg="rospy_tutorials" type="talker" name="a" outpt="screen"/>
  <include file="$(dirname)/inner.launch"/>
</launch>
"""
RIGHT = WRONG.replace("defualt", "default").replace("<nod ", "<node ").replace("outpt", "output")
INNER = '<launch>\n  <param name="/p" value="1" tpye="int"/>\n</launch>\n'


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    folder = tmp_path / "robots"
    (folder / ".git").mkdir(parents=True)
    (folder / "robot.launch").write_text(WRONG)
    (folder / "inner.launch").write_text(INNER)
    return folder


def texts(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text() for path in folder.glob("*.launch")}


def test_fixes_are_made_until_there_is_none_left(workspace: Path, preflight: Run) -> None:
    """The attributes of the node are looked at once a fix has made it one."""
    done = preflight("check", "robot.launch", "--no-run", "--fix", cwd=workspace)
    assert texts(workspace) == {"robot.launch": RIGHT, "inner.launch": INNER.replace("tpye", "type")}
    assert done.err.splitlines() == [
        "fixed inner.launch:2:30: LCH005: Replace 'tpye' with 'type'",
        "fixed robot.launch:2:20: LCH005: Replace 'defualt' with 'default'",
        "fixed robot.launch:3:4: LCH004: Replace 'nod' with 'node'",
        "fixed robot.launch:3:54: LCH005: Replace 'outpt' with 'output'",
        "ros-preflight: fixed: 4, in files: 2",
    ]
    assert done.code == 0, done.out


def test_a_diff_is_what_would_be_written(workspace: Path, preflight: Run) -> None:
    done = preflight("check", "robot.launch", "--no-run", "--diff", cwd=workspace)
    assert (done.code, texts(workspace)["robot.launch"]) == (1, WRONG), "nothing is written"
    subprocess.run(["git", "apply", "-p0"], input=done.out, text=True, cwd=workspace, check=True)
    assert texts(workspace)["robot.launch"] == RIGHT.replace("output", "outpt")
    done = preflight("check", "robot.launch", "--no-run", "--diff", "--select", "LCH004", cwd=workspace)
    assert (done.code, done.out) == (0, "")


def test_a_patch_has_the_line_ends_of_the_file(workspace: Path, harness: Harness) -> None:
    file = workspace / "robot.launch"
    file.write_bytes(WRONG.replace("\n", "\r\n").replace('name="a"', 'name="a" ns="\x85"').encode())
    check = [str(harness.server), "check", "robot.launch", "--no-run"]
    environment = {**harness.environment, "LANG": "C"}
    done = subprocess.run([*check, "--diff"], cwd=workspace, env=environment, capture_output=True, check=False)
    assert b"robot.launch" not in done.stdout, "U+0085 may drive a terminal"
    assert b"robot.launch is left alone: its patch has characters that drive a terminal" in done.stderr
    file.write_bytes(WRONG.replace("\n", "\r\n").replace('name="a"', 'name="\xe4"').encode())
    done = subprocess.run([*check, "--diff"], cwd=workspace, env=environment, capture_output=True, check=False)
    subprocess.run(["git", "apply", "-p0"], input=done.stdout, cwd=workspace, check=True)
    assert b'<arg name="rate" default="10"/>\r\n' in file.read_bytes()


def test_only_what_is_selected_and_new_is_fixed(workspace: Path, preflight: Run) -> None:
    preflight("check", "robot.launch", "--no-run", "--fix", "--select", "LCH004", cwd=workspace)
    assert texts(workspace)["robot.launch"] == WRONG.replace("<nod ", "<node ")
    known = workspace / "known.json"
    preflight("check", "robot.launch", "--no-run", "--write-baseline", known, cwd=workspace)
    done = preflight("check", "robot.launch", "--no-run", "--fix", "--baseline", known, cwd=workspace)
    assert "fixed: 0" in done.err


def test_a_file_keeps_its_mark_and_line_ends(workspace: Path, preflight: Run) -> None:
    file = workspace / "robot.launch"
    file.write_bytes(b"\xef\xbb\xbf" + WRONG.replace("\n", "\r\n").encode())
    preflight("check", file, "--no-run", "--fix", cwd=workspace)
    assert file.read_bytes() == b"\xef\xbb\xbf" + RIGHT.replace("\n", "\r\n").encode()


def test_what_is_not_of_the_workspace_or_not_in_utf8_is_left_alone(workspace: Path, preflight: Run) -> None:
    outside = workspace.parent / "outside.launch"
    outside.write_text(INNER)
    (workspace / "inner.launch").unlink()
    (workspace / "inner.launch").symlink_to(outside)
    latin = '<?xml version="1.0" encoding="latin-1"?>\n<launch><!-- \xfc --><nod pkg="p"/></launch>\n'.encode("latin-1")
    (workspace / "latin.launch").write_bytes(latin)
    done = preflight("check", "robot.launch", "latin.launch", "--no-run", "--fix", cwd=workspace)
    assert outside.read_text() == INNER
    assert (workspace / "latin.launch").read_bytes() == latin
    assert "ros-preflight: inner.launch is left alone: it is outside of the workspace" in done.err
    assert "ros-preflight: latin.launch is left alone: it is not in UTF-8" in done.err


def test_uncertain_fixes_are_made_where_that_is_asked_for(workspace: Path, preflight: Run) -> None:
    text = (
        '<launch>\n  <node pkg="rospy_tutorials" type="talker" name="a"/>\n'
        '  <node pkg="rospy_tutorials" type="listener" name="b"><remap from="chatter" to="chater"/></node>\n</launch>\n'
    )
    (workspace / "robot.launch").write_text(text)
    check = ("check", "robot.launch", "--no-run")
    preflight(*check, "--fix", cwd=workspace)
    assert texts(workspace)["robot.launch"] == text
    preflight(*check, "--fix", "--unsafe", cwd=workspace)
    assert texts(workspace)["robot.launch"] == text.replace("chater", "chatter")


def test_fixes_that_together_leave_a_file_that_does_not_parse_are_not_made(tmp_path: Path) -> None:
    file = tmp_path / "a.launch"
    text = "<launch><a/></launch>"
    file.write_text(text)
    document = Document(str(file), text, digest(text), (), (), LineIndex(text))

    def finding(start: int, end: int, new: str) -> Finding:
        place = document.location(Span(start, end))
        fix = Fix(f"write {new}", (Edit(place, new),), preferred=True)
        return Finding("ABC001", "n", "error", "certain", "m", place, fixes=(fix,))

    report = Report([finding(9, 10, "b"), finding(10, 12, ">")], {str(file): document})
    plan = planned(report, [str(tmp_path)], {}, typed={}, unsafe=False)
    assert (plan.fixes, plan.changes) == ((), {})
    assert "cannot be made together" in plan.left[str(file)]
    same = Report([finding(9, 10, "b"), finding(9, 10, "c")], {str(file): document})
    plan = planned(same, [str(tmp_path)], {}, typed={}, unsafe=False)
    assert plan.changes[str(file)].after == "<launch><b/></launch>", "of two for one text the first"


def test_a_finding_that_stays_where_it_was_is_not_fixed(tmp_path: Path) -> None:
    file = tmp_path / "a.launch"
    text = "<launch>\n<a/>\n<b/>\n</launch>\n"
    file.write_text(text)
    document = Document(str(file), text, digest(text), (), (), LineIndex(text))

    def finding(start: int, end: int, new: str, rule: str) -> Finding:
        place = document.location(Span(start, end))
        return Finding(
            rule, "n", "error", "certain", rule, place, fixes=(Fix("f", (Edit(place, new),), preferred=True),)
        )

    one, two = finding(10, 11, "longer", "ABC001"), finding(15, 16, "c", "ABC002")
    report = Report([one, two], {str(file): document})
    plan = planned(report, [str(tmp_path)], {}, typed={}, unsafe=False)
    now = plan.changes[str(file)].after
    after = Document(str(file), now, digest(now), (), (), LineIndex(now))
    stays = replace(two, location=after.location(Span(20, 21)))
    assert plan.futile(Report([stays], {})) == [(two, two.fixes[0])]
    assert plan.futile(Report([], {})) == []
    again = planned(report, [str(tmp_path)], {}, {key_of(two)}, typed={}, unsafe=False)
    assert again.changes[str(file)].after == text.replace("<a/>", "<longer/>")


def test_a_file_that_cannot_be_written_leaves_all_as_they_were(workspace: Path) -> None:
    first, second = workspace / "inner.launch", workspace / "robot.launch"
    documents = {}
    found = []
    for path in (first, second):
        text = path.read_text()
        document = Document(str(path), text, digest(text), (), (), LineIndex(text))
        place = document.location(Span(1, 7))
        fix = Fix("f", (Edit(place, "launch"),), preferred=True)
        documents[str(path)] = document
        found.append(Finding("ABC001", "n", "error", "certain", "m", place, fixes=(fix,)))
    plan = planned(Report(found, documents), [str(workspace)], {}, typed={}, unsafe=False)
    second.unlink()
    second.symlink_to("/")
    with pytest.raises(OSError):
        plan.write()
    assert first.read_text() == INNER


def test_all_findings_can_be_suppressed(workspace: Path, preflight: Run) -> None:
    check = ("check", "robot.launch", "--no-run", "--fail-on", "warning")
    assert preflight(*check, cwd=workspace).code == 1
    done = preflight(*check, "--add-noqa", cwd=workspace)
    assert (done.code, done.out) == (0, "")
    text = texts(workspace)["robot.launch"]
    assert text.count("preflight: ignore[LCH004") == 1
    after = preflight(*check, cwd=workspace)
    assert (after.code, " error " in after.out) == (0, False)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--fix", "--add-noqa"), "--fix and --add-noqa cannot be combined"),
        (("--watch", "--write-baseline", "b"), "--watch and --write-baseline cannot be combined"),
        (("--unsafe",), "--unsafe is for --fix and --diff"),
        (("-",), "with --stdin-filename FILE"),
        (("--stdin-filename", "x.launch"), "with --stdin-filename FILE"),
        (("-", "--stdin-filename", "x.launch", "--fix"), "--fix is for files, not for standard input"),
    ],
)
def test_what_makes_no_sense_is_said(workspace: Path, preflight: Run, options: tuple[str, ...], said: str) -> None:
    done = preflight("check", *options, "--no-run", cwd=workspace)
    assert done.code == 2
    assert said in done.err


def test_standard_input_is_the_text_of_a_file(workspace: Path, preflight: Run) -> None:
    typed = RIGHT.replace("screen", "scren")
    check = ("check", "-", "--stdin-filename", "robot.launch", "--no-run")
    done = preflight(*check, "--format", "json", cwd=workspace, typed=typed)
    files = {(each["rule"], Path(each["file"]).name) for each in done.json["findings"]}
    assert ("LCH005", "inner.launch") in files, "what it includes is checked, too"
    assert not any(rule == "LCH004" for rule, _ in files), "the file on the disk does not count"
    done = preflight(*check, "--diff", cwd=workspace, typed=WRONG)
    assert '+  <arg name="rate" default="10"/>' in done.out
    done = preflight("check", "-", "--stdin-filename", "new.launch", "--no-run", cwd=workspace, typed=WRONG)
    assert "new.launch:2:20: warning LCH005" in done.out, "the file need not be there"
