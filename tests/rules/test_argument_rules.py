"""ARG: arguments, declared and passed."""

from support.check import apply, check


def test_an_undeclared_argument_is_reported_in_its_own_file() -> None:
    text = """
        <launch>
          <include file="/inc.launch"/>
        </launch>
        //- /inc.launch
        <launch>
          <arg name="camera" default="front"/>
          <param name="a" value="$(arg camera)"/>
          <node pkg="p" type="t" name="$(arg camra)"/>
                                       ^^^^^^^^^^^^ error[ARG001] 'camra' is not declared; did you mean 'camera'
        </launch>
    """
    (finding,) = check(text)
    assert finding.stops_launch
    assert [related.message for related in finding.related] == ["included here"]
    assert '"$(arg camera)"' in apply(text, finding.fixes[0].edits)["/inc.launch"]


def test_an_argument_is_not_known_before_its_declaration() -> None:
    findings = check("""
        <launch>
          <param name="a" value="$(arg b)"/>
                                 ^^^^^^^^ error[ARG001] argument 'b' is not declared before this place
          <arg name="b" default="1"/>
          <group><arg name="c" value="1"/><param name="d" value="$(arg c)"/></group>
          <param name="e" value="$(arg c)"/>
                                 ^^^^^^^^ error[ARG001] argument 'c' is not declared here, but in another <group>
        </launch>
    """)
    assert [finding.related[0].message for finding in findings] == ["declared here"] * 2
    assert [finding.fixes for finding in findings] == [(), ()]


def test_an_argument_is_declared_by_a_fix() -> None:
    text = """
        <launch>
          <param name="a" value="$(arg rate)"/>
                                 ^^^^^^^^^^^ error[ARG001] argument 'rate' is not declared
        </launch>
    """
    (finding,) = check(text)
    changed = apply(text, finding.fixes[0].edits)["/main.launch"]
    assert changed.startswith('<launch>\n  <arg name="rate"/>\n  <param')


def test_a_required_argument_that_is_not_passed() -> None:
    check("""
        <launch>
          <include file="/inc.launch"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[ARG002] '/inc.launch' requires argument 'serial', which is not passed
        </launch>
        //- /inc.launch
        <launch><arg name="serial"/><param name="a" value="$(arg serial)"/></launch>
    """)


def test_a_required_argument_is_passed_by_a_fix() -> None:
    text = """
        <launch>
          <arg name="serial" default="7"/>
          <param name="a" value="$(arg serial)"/>
          <include file="/inc.launch"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[ARG002] '/inc.launch' requires argument 'serial', which is not passed
        </launch>
        //- /inc.launch
        <launch><arg name="serial"/><param name="a" value="$(arg serial)"/></launch>
    """
    (finding,) = check(text)
    assert finding.fixes[0].preferred
    changed = apply(text, finding.fixes[0].edits)["/main.launch"]
    assert '<include file="/inc.launch">\n    <arg name="serial" value="$(arg serial)"/>\n  </include>' in changed
    unknown = text.replace('name="serial" default', 'name="other" default').replace(
        '"a" value="$(arg serial)', '"a" value="$(arg other)', 1
    )
    (finding,) = check(unknown)
    assert not finding.fixes[0].preferred
    assert '<arg name="serial" value=""/>' in apply(unknown, finding.fixes[0].edits)["/main.launch"]


def test_an_argument_that_the_command_line_must_give() -> None:
    text = """
        <launch>
          <arg name="robot"/>
                     ^^^^^ info[ARG003] argument 'robot' has no default; launch with robot:=...
          <param name="a" value="$(arg robot)"/>
        </launch>
    """
    (finding,) = check(text)
    assert finding.stops_launch
    without = "\n".join(line for line in text.splitlines() if "^" not in line)
    assert check(without, args={"robot": "tb"}) == []


def test_an_argument_that_the_included_file_does_not_declare() -> None:
    text = """
        <launch>
          <include file="/inc.launch">
            <arg name="frame" value="map"/>
                       ^^^^^ error[ARG004] '/inc.launch' declares no argument 'frame'; did you mean 'frames'?
          </include>
        </launch>
        //- /inc.launch
        <launch><arg name="frames" default="odom"/><param name="a" value="$(arg frames)"/></launch>
    """
    (finding,) = check(text)
    assert '<arg name="frames" value="map"/>' in apply(text, finding.fixes[0].edits)["/main.launch"]
    without = '<launch>\n  <include file="/inc.launch">\n  </include>'
    assert apply(text, finding.fixes[1].edits)["/main.launch"].startswith(without)


def test_pass_all_args_passes_what_nobody_declares() -> None:
    check("""
        <launch>
          <arg name="other" default="1"/>
          <include file="/inc.launch" pass_all_args="true"/>
        </launch>
        //- /inc.launch
        <launch><arg name="frames" default="odom"/><param name="a" value="$(arg frames)"/></launch>
    """)


def test_an_argument_declared_twice() -> None:
    (finding,) = check("""
        <launch>
          <arg name="a" default="1"/>
          <arg name="a" default="2"/>
                     ^ error[ARG005] argument 'a' is declared already
          <param name="b" value="$(arg a)"/>
        </launch>
    """)
    assert finding.related[0].message == "declared here"


def test_an_argument_that_is_passed_twice() -> None:
    text = """
        <launch>
          <include file="/inc.launch">
            <arg name="a" value="1"/>
            <arg name="a" value="2"/>
                       ^ error[ARG005] argument 'a' is passed already
          </include>
        </launch>
        //- /inc.launch
        <launch><arg name="a"/><param name="b" value="$(arg a)"/></launch>
    """
    (finding,) = check(text)
    assert finding.related[0].message == "passed here"
    assert 'value="2"' not in apply(text, finding.fixes[0].edits)["/main.launch"]


def test_of_two_declarations_under_conditions_one_counts() -> None:
    check("""
        <launch>
          <arg name="real" default="true"/>
          <arg name="a" default="1" if="$(arg real)"/>
          <arg name="a" default="2" unless="$(arg real)"/>
          <param name="b" value="$(arg a)"/>
        </launch>
    """)


def test_an_argument_that_the_file_fixes() -> None:
    check("""
        <launch>
          <include file="/inc.launch"><arg name="a" value="1"/></include>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[ARG006] argument 'a' cannot be passed
        </launch>
        //- /inc.launch
        <launch><arg name="a" value="2"/></launch>
    """)


def test_an_argument_that_is_passed_without_a_value() -> None:
    check("""
        <launch>
          <include file="/inc.launch"><arg name="a"/></include>
                                                 ^ error[ARG007] argument 'a' is passed without a value
        </launch>
        //- /inc.launch
        <launch><arg name="a" default="2"/></launch>
    """)


def test_an_argument_that_its_file_never_uses() -> None:
    text = """
        <launch>
          <arg name="rate" default="10"/>
                     ^^^^ hint[ARG008] argument 'rate' is declared and never used in this file
          <!-- <param name="rate" value="$(arg rate)"/> -->
          <arg name="used" default="1"/>
          <arg name="quoted" default="2"/>
          <group if="$(eval used == 1 or arg('quoted') == 2)">
            <arg name="inner" value="1"/>
                       ^^^^^ hint[ARG008] argument 'inner' is declared and never used in this file
          </group>
        </launch>
    """
    rate, _ = check(text)
    assert apply(text, rate.fixes[0].edits)["/main.launch"].startswith("<launch>\n  <!--")


def test_an_argument_that_only_what_is_not_taken_uses_is_used() -> None:
    check("""
        <launch>
          <arg name="rate" default="10"/>
          <arg name="fast" default="false"/>
          <group if="$(arg fast)"><param name="rate" value="$(arg rate)"/></group>
        </launch>
    """)


def test_an_argument_that_reaches_an_include_with_all_others_is_used() -> None:
    check("""
        <launch>
          <arg name="rate" default="10"/>
          <include file="/inc.launch" pass_all_args="true"/>
        </launch>
        //- /inc.launch
        <launch><param name="rate" value="$(arg rate)"/></launch>
    """)


def test_an_argument_that_only_a_parameter_file_uses_is_used() -> None:
    check("""
        <launch>
          <arg name="rate" default="10"/>
          <arg name="inline" default="10"/>
          <rosparam command="load" file="/rates.yaml" subst_value="true"/>
          <rosparam subst_value="true">b: $(arg inline)</rosparam>
        </launch>
        //- /rates.yaml
        a: $(arg rate)
    """)
    check("""
        <launch>
          <arg name="rate" default="10"/>
                     ^^^^ hint[ARG008] argument 'rate' is declared and never used
          <rosparam command="load" file="/rates.yaml"/>
        </launch>
        //- /rates.yaml
        a: rate
    """)


def test_an_argument_may_be_used_by_a_parameter_file_that_is_not_known() -> None:
    check("""
        <launch>
          <arg name="rate" default="10"/>
          <arg name="fast" default="false"/>
          <group if="$(arg fast)"><rosparam command="load" file="/rates.yaml" subst_value="true"/></group>
        </launch>
    """)


def test_an_unused_argument_that_an_include_passes_is_left_alone() -> None:
    check("""
        <launch>
          <include file="/inc.launch"><arg name="rate" value="1"/></include>
        </launch>
        //- /inc.launch
        <launch>
          <arg name="rate"/>
          <arg name="other" default="1"/>
                     ^^^^^ hint[ARG008] argument 'other' is declared and never used
        </launch>
    """)


def test_an_argument_of_the_command_line_that_nothing_asks_for() -> None:
    fixture = """
        <launch>
         ^^^^^^ warning[ARG011] given 'cammera', and nothing in it declares that argument; did you mean 'camera'?
          <arg name="camera" default="true"/>
          <arg name="sim" default="false"/>
          <group if="$(arg sim)"><arg name="lidar" default="true"/><param name="a" value="$(arg lidar)"/></group>
          <node pkg="p" type="t" name="n" args="$(arg camera)"/>
        </launch>
    """
    check(fixture, args={"cammera": "false", "lidar": "x", "__ns": "/a"})


def test_an_include_may_be_handed_what_is_not_declared() -> None:
    check(
        """
        <launch>
          <include file="/camera.launch" pass_all_args="true"/>
        </launch>
        //- /camera.launch
        <launch><arg name="camera" default="true"/><node pkg="p" type="t" name="$(arg camera)"/></launch>
        """,
        args={"camera": "false"},
    )


def test_an_argument_of_a_ros_2_launch_that_nothing_asks_for() -> None:
    """What an included file declares is known in it without being passed; what is not read may ask for anything."""
    fixture = """
        //- /robot.launch.xml
        <launch>
         ^^^^^^ warning[ARG011] given 'cammera', and nothing in it declares that argument; did you mean 'camera'?
          <include file="/camera.launch.xml"/>
          <log message="$(var mode)"/>
        </launch>
        //- /camera.launch.xml
        <launch><arg name="camera" default="true"/><log message="$(var camera)"/></launch>
    """
    check(fixture, args={"cammera": "false", "camera": "true", "mode": "slow"})
    check(
        """
        //- /robot.launch.xml
        <launch>
          <arg name="mode" default="slow"/>
          <include file="/camera.launch.xml" if="$(equals $(var mode) fast)"/>
        </launch>
        //- /camera.launch.xml
        <launch><arg name="camera" default="true"/><log message="$(var camera)"/></launch>
        """,
        args={"camera": "false"},
    )
