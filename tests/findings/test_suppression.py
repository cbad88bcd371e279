"""Comments that silence findings, and those that silence nothing (LCH019)."""

from support.check import apply, check


def test_on_the_line_and_on_the_line_above() -> None:
    check("""
        <launch>
          <!-- preflight: ignore[LCH004] ours -->
          <ours/>
          <ours/> <!-- preflight: ignore[LCH004] -->
          <ours/>
           ^^^^ warning[LCH004] unknown element <ours> in <launch>; roslaunch skips it
        </launch>
    """)


def test_a_comment_of_several_lines_counts_from_its_end() -> None:
    check("""
        <launch>
          <!-- preflight: ignore[LCH004]
               because it is ours -->
          <ours/>
        </launch>
    """)


def test_several_rules_in_one_comment_and_other_rules_go_on() -> None:
    check("""
        <launch>
          <!-- preflight: ignore[LCH004, ARG001] -->
          <ours/><param name="a" value="$(arg b)" vaule="1"/>
                                                  ^^^^^ warning[LCH005] did you mean 'value'?
        </launch>
    """)


def test_an_unused_one_is_a_finding() -> None:
    check("""
        <launch>
          <!-- preflight: ignore[LCH004, ARG001] -->
                                         ^^^^^^ warning[LCH019] unused suppression of 'ARG001': it has no finding here
          <ours/>
        </launch>
    """)


def test_a_rule_that_needs_the_graph_is_judged_only_with_one() -> None:
    text = """
        <launch>
          <!-- preflight: ignore[TOP001] the simulator publishes it -->
          UNUSED
          <node pkg="p" type="t" name="n"/>
        </launch>
    """
    silent = text.replace("          UNUSED\n", "")
    unused = text.replace("UNUSED", "                       ^^^^^^ warning[LCH019] unused suppression of 'TOP001'")
    check(silent)
    check(silent + '    //- interfaces\n        {"/n": {"subscribers": {"scan": "x/Y"}}}')
    check(unused + '    //- interfaces\n        {"/n": {}}')


def test_no_rule_and_an_unknown_rule() -> None:
    text = """
        <launch>
          <!-- preflight: ignore -->
               ^^^^^^^^^^^^^^^^^ warning[LCH019] names no rule
          <!-- preflight: ignore[top01] -->
                                 ^^^^^ warning[LCH019] unknown rule 'top01'; did you mean 'TOP001'?
        </launch>
    """
    _, unknown = check(text)
    assert "ignore[TOP001]" in apply(text, unknown.fixes[0].edits)["/main.launch"]


def test_a_comment_in_an_included_file_counts_there_only() -> None:
    check("""
        <launch>
          <!-- preflight: ignore[LCH004] -->
                                 ^^^^^^ warning[LCH019] unused suppression of 'LCH004': it has no finding here
          <include file="/inc.launch"/>
        </launch>
        //- /inc.launch
        <launch>
          <ours/>
           ^^^^ warning[LCH004] unknown element <ours> in <launch>; roslaunch skips it
        </launch>
    """)


def test_a_finding_cannot_be_silenced_by_text_that_is_no_comment() -> None:
    check("""
        <launch>
          <param name="a" value="preflight: ignore[LCH004]"/> <ours/>
                                                               ^^^^ warning[LCH004] unknown element <ours> in
        </launch>
    """)
