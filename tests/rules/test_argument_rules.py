"""ARG: arguments, declared and passed."""

from preflight_check import apply, check


def test_an_undeclared_argument_is_reported_in_its_own_file() -> None:
    text = """
        <launch>
          <arg name="camera" default="left"/>
          <include file="/inc.launch"/>
        </launch>
        //- /inc.launch
        <launch>
          <arg name="camera" default="front"/>
          <node pkg="p" type="t" name="$(arg camra)"/>
                                       ^^^^^^^^^^^^ error[ARG001] 'camra' is not declared; did you mean 'camera'
        </launch>
    """
    (finding,) = check(text)
    assert finding.stops_launch
    assert [related.message for related in finding.related] == ["included here"]
    assert '"$(arg camera)"' in apply(text, finding.fixes[0].edits)["/inc.launch"]


def test_an_argument_is_not_known_before_its_declaration() -> None:
    check("""
        <launch>
          <param name="a" value="$(arg b)"/>
                                 ^^^^^^^^ error[ARG001] argument 'b' is not declared
          <arg name="b" default="1"/>
        </launch>
    """)


def test_a_required_argument_that_is_not_passed() -> None:
    check("""
        <launch>
          <include file="/inc.launch"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[ARG002] '/inc.launch' requires argument 'serial', which is not passed
        </launch>
        //- /inc.launch
        <launch><arg name="serial"/><param name="a" value="$(arg serial)"/></launch>
    """)


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
        <launch><arg name="frames" default="odom"/></launch>
    """
    (finding,) = check(text)
    assert '<arg name="frames" value="map"/>' in apply(text, finding.fixes[0].edits)["/main.launch"]


def test_pass_all_args_passes_what_nobody_declares() -> None:
    check("""
        <launch>
          <arg name="other" default="1"/>
          <include file="/inc.launch" pass_all_args="true"/>
        </launch>
        //- /inc.launch
        <launch><arg name="frames" default="odom"/></launch>
    """)


def test_an_argument_declared_twice() -> None:
    (finding,) = check("""
        <launch>
          <arg name="a" default="1"/>
          <arg name="a" default="2"/>
                     ^ error[ARG005] argument 'a' is declared already
        </launch>
    """)
    assert finding.related[0].message == "declared here"


def test_of_two_declarations_under_conditions_one_counts() -> None:
    check("""
        <launch>
          <arg name="real" default="true"/>
          <arg name="a" default="1" if="$(arg real)"/>
          <arg name="a" default="2" unless="$(arg real)"/>
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
