"""Remaps, conditions, anonymous names and clear_params that do not do what they seem to."""

from support.check import apply, check, findings_of


def test_a_remap_that_a_later_one_beside_it_replaces() -> None:
    text = """
        <launch>
          <remap from="scan" to="front/scan"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[LCH023] no effect: a later one here maps 'scan' to 'rear/scan'
          <remap from="scan" to="rear/scan"/>
          <node pkg="p" type="t" name="n">
            <remap from="tf" to="a"/>
            ^^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH023] 'tf' is remapped to 'a' twice here
            <remap from="tf" to="a"/>
          </node>
        </launch>
    """
    scan, tf = check(text)
    assert scan.related[0].message == "the one that counts"
    mended = apply(text, scan.fixes[0].edits)["/main.launch"]
    assert 'to="front/scan"' not in mended
    assert tf.fixes


def test_a_remap_that_reached_a_node_before_it_was_replaced_is_not_hidden() -> None:
    check("""
        <launch>
          <remap from="scan" to="front/scan"/>
          <node pkg="p" type="t" name="a"/>
          <remap from="scan" to="rear/scan"/>
          <node pkg="p" type="t" name="b"/>
        </launch>
    """)


def test_defaults_and_alternatives_are_not_hidden_remaps() -> None:
    check("""
        <launch>
          <arg name="rear" default="true"/>
          <remap from="scan" to="front/scan"/>
          <remap from="scan" to="rear/scan" if="$(arg rear)"/>
          <remap from="odom" to="wheel_odom"/>
          <node pkg="p" type="t" name="n"><remap from="odom" to="visual_odom"/></node>
        </launch>
    """)


def test_two_remaps_of_a_node_for_one_name_written_differently() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <remap from="/scan" to="front"/>
            <remap from="scan" to="rear"/>
                         ^^^^ warning[LCH023] '/scan' and 'scan' are both '/scan' for /n; which of them wins depends
          </node>
          <node pkg="p" type="t" name="m" ns="a">
            <remap from="/scan" to="front"/>
            <remap from="scan" to="rear"/>
            <remap from="odom" to="wheels"/>
            <remap from="/a/odom" to="wheels"/>
                         ^^^^^^^ hint[LCH023] 'odom' and '/a/odom' are both '/a/odom' for /a/m
          </node>
        </launch>
    """)


def test_a_remap_to_itself() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="n">
            <remap from="scan" to="scan"></remap>
            ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH024] 'scan' is remapped to itself
          </node>
        </launch>
    """
    (finding,) = check(text)
    assert "remap" not in apply(text, finding.fixes[0].edits)["/main.launch"]


def test_a_remap_to_itself_that_may_be_another_or_undoes_one() -> None:
    check("""
        <launch>
          <arg name="scan" default="scan"/>
          <remap from="odom" to="wheels/odom"/>
          <node pkg="p" type="t" name="n">
            <remap from="scan" to="$(arg scan)"/>
            <remap from="odom" to="odom"/>
            <remap from="tf" to="/tf"/>
          </node>
        </launch>
    """)


def test_a_name_that_is_anonymous_and_referred_to() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="$(anon talker)"/>
          <node pkg="p" type="t" name="rviz_$(anon x)" ns="a"/>
          <node pkg="p" type="t" name="n" args="--listen /talker/chatter">
                                                ^^^^^^^^^^^^^^^^^^^^^^^^ warning[LCH022] '/talker/chatter' means nothing
            <remap from="in" to="talker/chatter"/>
                                 ^^^^^^^^^^^^^^ warning[LCH022] node '/talker' gets a name of its own at every launch
          </node>
          <param name="/a/rviz_x/rate" value="10"/>
                       ^^^^^^^^^^^^^^ warning[LCH022] parameter '/a/rviz_x/rate' means nothing
        </launch>
    """
    (_, remap, _) = check(text)
    assert 'to="$(anon talker)/chatter"' in apply(text, remap.fixes[0].edits)["/main.launch"]


def test_references_that_an_anonymous_name_answers_to() -> None:
    check("""
        <launch>
          <param name="$(anon talker)/limit" value="10"/>
          <node pkg="p" type="t" name="$(anon talker)"><param name="rate" value="1"/></node>
          <node pkg="p" type="t" name="$(anon listener)"/>
          <node pkg="p" type="t" name="listener"><remap from="chatter" to="/listener/chatter"/></node>
          <node pkg="p" type="t" name="n"><remap from="talker" to="/talker"/></node>
          <node pkg="p" type="t" name="$(anon camera)"/>
          <node pkg="p" type="t" name="driver" ns="camera"><remap from="image" to="/camera/image"/></node>
        </launch>
    """)


def test_a_condition_that_compares_an_argument_with_a_text_that_it_never_is() -> None:
    text = """
        <launch>
          <arg name="sim" default="true"/>
          <group if="$(eval arg('sim') == 'true')"/>
                     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[LCH025] 'arg('sim') == 'true'' is never true: $(eval)
          <group unless="$(eval sim != '1')"/>
                         ^^^^^^^^^^^^^^^^^^ warning[LCH025] 'sim != '1'' is always true: $(eval) makes a number
        </launch>
    """
    first, _ = check(text)
    assert "$(eval arg('sim') == true)" in apply(text, first.fixes[0].edits)["/main.launch"]


def test_conditions_that_are_never_true() -> None:
    check("""
        <launch>
          <arg name="debug" value="false"/>
          <group if="false"/>
                     ^^^^^ hint[LCH025] this <group> is never evaluated, its if is always false
          <group unless="1"/>
                         ^ hint[LCH025] its unless is always true
          <group if="$(arg debug)"/>
                     ^^^^^^^^^^^^ hint[LCH025] its if is always false: argument 'debug' is always 'false' here
          <group if="$(eval 1 == 2 and arg('debug'))"/>
                     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH025] its if is always false
        </launch>
    """)


def test_conditions_that_may_be_true() -> None:
    check("""
        <launch>
          <arg name="robot" default="turtle"/>
          <arg name="sim" default="false"/>
          <arg name="fast" value="true" if="$(arg sim)"/>
          <arg name="fast" value="false" unless="$(arg sim)"/>
          <group if="$(arg sim)"/>
          <group if="$(arg fast)"/>
          <group if="$(eval robot == 'turtle' or arg('sim') == true)"/>
          <group if="$(eval optenv('SIM', 'no') == 'true')"/>
          <group if="true"/>
          <group unless="$(eval 1 == 2)"/>
        </launch>
    """)


def test_clear_params_where_nothing_is_and_where_parameters_stay() -> None:
    check("""
        <launch>
          <param name="/arm/rate" value="10"/>
          <group ns="arm" clear_params="true">
                          ^^^^^^^^^^^^^^^^^^^ hint[LCH026] '/arm/rate' set before this will not be cleared
            <node pkg="p" type="t" name="n"/>
          </group>
          <group ns="leg" clear_params="true"/>
                          ^^^^^^^^^^^^^^^^^^^ hint[LCH026] nothing of this launch is below '/leg/'
        </launch>
    """)


def test_clear_params_that_has_a_use() -> None:
    check("""
        <launch>
          <group ns="arm" clear_params="true"><param name="rate" value="10"/></group>
          <group ns="leg" clear_params="true"><node pkg="p" type="t" name="n"/></group>
          <group ns="eye" clear_params="false"/>
          <rosparam>{n: {rate: 3}}</rosparam>
          <node pkg="p" type="t" name="n" clear_params="true"/>
        </launch>
    """)


def test_clear_params_of_what_is_not_known_is_not_called_dead() -> None:
    findings = findings_of("""
        <launch>
          <arg name="file"/>
          <group ns="arm" clear_params="true"><include file="$(arg file)"/></group>
        </launch>
    """)
    assert "LCH026" not in {finding.rule for finding in findings}
