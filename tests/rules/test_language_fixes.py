"""The quick fixes of the rules about the launch file's own language."""

import pytest
from support.check import apply, findings_of


def fixed(tag: str, rule: str, fix: int = 0) -> str:
    """The tag, alone in a launch file, after a fix of the only finding of that rule."""
    text = f"<launch>{tag}</launch>"
    (finding,) = [finding for finding in findings_of(text) if finding.rule == rule]
    after = apply(text, finding.fixes[fix].edits)["/main.launch"]
    return after.removeprefix("<launch>").removesuffix("</launch>\n")


def unfixable(tag: str, rule: str) -> bool:
    (finding,) = [finding for finding in findings_of(f"<launch>{tag}</launch>") if finding.rule == rule]
    return finding.fixes == ()


@pytest.mark.parametrize(
    ("tag", "after"),
    [
        ('<node pkg="p" name="n"/>', '<node pkg="p" name="n" type=""/>'),
        ("<arg/>", '<arg name=""/>'),
        ('<param name="a" />', '<param name="a" value="" />'),
        ('<node pkg="p" typ="t" name="n"/>', '<node pkg="p" type="t" name="n"/>'),
        ('<node pkg="p" name="n">\n</node>', '<node pkg="p" name="n" type="">\n</node>'),
    ],
)
def test_a_missing_attribute_is_added_or_its_misspelling_corrected(tag: str, after: str) -> None:
    assert fixed(tag, "LCH006") == after


def test_a_missing_attribute_that_another_one_looks_like_is_asked_for() -> None:
    findings = findings_of('<launch><node pkg="p" typ="t" name="n"/></launch>')
    assert "<node> needs 'type'; is 'typ' meant to be it?" in {finding.message for finding in findings}


def test_one_of_the_attributes_that_exclude_each_other_is_kept() -> None:
    tag = '<param name="a" value="1"\n  textfile="b"/>'
    assert fixed(tag, "LCH007", 0) == '<param name="a" value="1"/>'
    assert fixed(tag, "LCH007", 1) == '<param name="a"\n  textfile="b"/>'


@pytest.mark.parametrize(
    ("tag", "after"),
    [
        ('<node pkg="p" type="t" name="n" respawn="ture"/>', '<node pkg="p" type="t" name="n" respawn="true"/>'),
        ('<node pkg="p" type="t" name="n" respawn="1"/>', '<node pkg="p" type="t" name="n" respawn="true"/>'),
        ('<group if="yes"/>', '<group if="true"/>'),
        ('<group unless="Off"/>', '<group unless="false"/>'),
        ('<param name="a" value="1" type="duble"/>', '<param name="a" value="1" type="double"/>'),
        ('<param name="a" value="10.0" type="int"/>', '<param name="a" value="10" type="int"/>'),
        ('<rosparam command="laod" file="x"/>', '<rosparam command="load" file="x"/>'),
        (
            '<machine name="m" address="a" default="nevr"/>',
            '<machine name="m" address="a" default="never"/>',
        ),
    ],
)
def test_a_bad_value_becomes_the_one_that_is_meant(tag: str, after: str) -> None:
    assert fixed(tag, "LCH008") == after


@pytest.mark.parametrize(
    "tag", ['<group if="perhaps"/>', '<param name="a" value="10.5" type="int"/>', '<group ns=""/>']
)
def test_a_bad_value_that_could_be_anything_has_no_fix(tag: str) -> None:
    assert unfixable(tag, "LCH008")


@pytest.mark.parametrize(
    ("tag", "after"),
    [
        ('<node pkg="p" type="t" name="front/cam"/>', '<node pkg="p" type="t" name="cam" ns="front"/>'),
        ('<node pkg="p" type="t" name="front-cam"/>', '<node pkg="p" type="t" name="front_cam"/>'),
        ('<node pkg="p" type="t" name="2d nav"/>', '<node pkg="p" type="t" name="d_nav"/>'),
        ('<remap from="a b" to="c"/>', '<remap from="a_b" to="c"/>'),
        ('<remap from="~a-b" to="c"/>', '<remap from="~a_b" to="c"/>'),
    ],
)
def test_an_invalid_name_becomes_a_valid_one(tag: str, after: str) -> None:
    assert fixed(tag, "LCH009") == after


@pytest.mark.parametrize(
    "tag",
    ['<node pkg="p" type="t" name="a/b" ns="c"/>', '<arg name="x" default="a-b"/><remap from="$(arg x)" to="c"/>'],
)
def test_an_invalid_name_that_is_not_written_so_or_has_a_namespace_already_has_no_fix(tag: str) -> None:
    assert unfixable(tag, "LCH009")


def test_the_second_node_of_a_name_gets_a_free_one() -> None:
    node = '<node pkg="p" type="t" name="n"/>'
    assert fixed(f'{node}<node pkg="p" type="t" name="n_2"/>{node}', "LCH016").endswith('name="n_3"/>')


def test_a_node_whose_file_is_included_twice_is_said_to_be_so() -> None:
    (finding,) = findings_of("""
        <launch><include file="/inc.launch"/><include file="/inc.launch"/></launch>
        //- /inc.launch
        <launch><node pkg="p" type="t" name="n"/></launch>
    """)
    assert "this tag is read twice, the includes need different namespaces" in finding.message
    assert finding.fixes == ()


def test_the_name_of_roslaunch_itself() -> None:
    (finding,) = findings_of('<launch><node pkg="p" type="t" name="rosout"/></launch>')
    assert (finding.rule, finding.message) == ("LCH016", "'/rosout' is the name of roslaunch's own node")


def test_a_machine_gets_the_name_of_the_nearest() -> None:
    machine = '<machine name="base" address="localhost"/>'
    node = '<node pkg="p" type="t" name="n" machine="{}"/>'
    assert fixed(machine + node.format("bsae"), "LCH017") == machine + node.format("base")
    assert unfixable(machine + node.format("arm"), "LCH017")


@pytest.mark.parametrize(
    ("comment", "after"),
    [
        ("\n  <!-- preflight: ignore[LCH004] old -->\n  <group/>", "\n  <group/>"),
        ("<group/> <!-- preflight: ignore[LCH004] -->", "<group/> "),
        ("<ours/><!-- preflight: ignore[LCH004, LCH005] -->", "<ours/><!-- preflight: ignore[LCH004] -->"),
        ("<ours/><!-- preflight: ignore[LCH005, LCH004] -->", "<ours/><!-- preflight: ignore[LCH004] -->"),
    ],
)
def test_an_unused_suppression_is_removed(comment: str, after: str) -> None:
    assert fixed(comment, "LCH019") == after


@pytest.mark.parametrize(
    ("tag", "after"),
    [
        (
            '<nod pkg="p" type="t" name="n"><!-- </nod> --></nod >',
            '<node pkg="p" type="t" name="n"><!-- </nod> --></node >',
        ),
        ("<gruop>\n  <gruop/>\n</gruop>", "<group>\n  <gruop/>\n</group>"),
    ],
)
def test_the_name_of_an_element_is_mended_in_both_of_its_tags(tag: str, after: str) -> None:
    assert fixed(tag, "LCH004") == after


def test_no_attribute_becomes_a_second_one_of_its_name() -> None:
    assert unfixable('<param name="a" value="1" vaule="2"/>', "LCH005")


def test_an_invalid_name_that_several_includes_make_is_shown_once_and_as_it_is_written() -> None:
    findings = findings_of("""
        <launch>
          <include file="/inc.launch"><arg name="pc" value="pc-1"/></include>
          <include file="/inc.launch"><arg name="pc" value="pc-2"/></include>
        </launch>
        //- /inc.launch
        <launch><arg name="pc"/><node pkg="p" type="t" name="$(anon net)_$(arg pc)"/></launch>
    """)
    assert [(f.rule, f.message.split(":")[0]) for f in findings] == [
        ("LCH009", "node name '$(anon net)_pc-1' is not allowed")
    ]
