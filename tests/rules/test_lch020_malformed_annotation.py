"""LCH020: an annotation that cannot be read."""

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import check, findings_of


def test_an_annotation_that_cannot_be_read() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <!-- <topics><topic name="a" type="x/Y" class="both"/></topics> -->
                                                           ^^^^ warning[LCH020] allowed: pub, sub
          </node>
        </launch>
    """)


@pytest.mark.silent
def test_annotations_that_can_be_read() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <!-- <topics><topic name="/tf" type="tf2_msgs/TFMessage" class="sub"/></topics> -->
            <!-- the topics are in the manual -->
          </node>
        </launch>
    """)


def test_a_type_without_a_package() -> None:
    """Listing 4 of the paper has `type="String"`."""
    findings = findings_of("""
        <launch>
          <node pkg="p" type="t" name="n">
            <!-- <topics><topic name="a" type="String" class="pub"/></topics> -->
            <!-- <topics><topic name="b" type="Unheard" class="pub"/></topics> -->
            <!-- <services><service name="c" type="SetBool" class="server"/></services> -->
          </node>
        </launch>
    """)
    found = [each for each in findings if each.rule == "LCH020"]
    assert {each.severity for each in found} == {"info"}
    assert [each.message for each in found] == [
        "type 'String' has no package; std_msgs/String is used",
        "type 'Unheard' has no package; no known package has it, so any type matches",
        "type 'SetBool' has no package; std_srvs/SetBool is used",
    ]
    assert [[fix.title for fix in each.fixes] for each in found] == [
        ["Replace 'String' with 'std_msgs/String'"],
        [],
        ["Replace 'SetBool' with 'std_srvs/SetBool'"],
    ]


@pytest.mark.parametrize(("own", "mismatch"), [("", True), ("own_msgs", False)])
def test_the_type_of_the_one_package_that_has_it(tmp_path: Path, own: str, mismatch: bool) -> None:
    """Where several packages have it, it may be any."""
    package = tmp_path / "src" / (own or "p")
    (package / "msg").mkdir(parents=True)
    (package / "package.xml").write_text(f"<package><name>{package.name}</name></package>")
    if own:
        (package / "msg/String.msg").write_text("string text")
    launch = package / "a.launch"
    launch.write_text("""<launch>
      <node pkg="gone" type="t" name="one"><topics><topic name="a" type="String" class="pub"/></topics></node>
      <node pkg="gone" type="t" name="two"><topics><topic name="a" type="std_msgs/Int32" class="sub"/></topics></node>
    </launch>""")
    environment = detect_environment(str(tmp_path), {}, root=str(tmp_path / "nothing"))
    analysis = Workspace(environment, Sources()).analysed(str(launch))
    assert analysis.graph is not None
    assert ("std_msgs/String" in analysis.graph.topics["/a"].types) == mismatch
    assert ("TOP003" in {each.rule for each in analysis.findings}) == mismatch
