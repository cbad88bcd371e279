"""What launch refuses while it reads an XML or YAML file, as the real one does (launch 3.7, launch_ros 0.28)."""

from support.check import check


def test_yaml_that_is_no_text() -> None:
    """`launch_yaml` makes nothing of anything, and most attributes are texts."""
    check("""
        //- /a.launch.yaml
        launch:
          - arg: {name: rate, default: 5}
                                       ^ error[LCH008] default='5' of <arg> is not a text: in YAML it needs quotes
          - let: {name: sim, value: true}
                                    ^^^^ error[LCH008] value='true' of <let> is not a text: in YAML it needs quotes
          - log: {message: $(var rate)}
          - executable: {cmd: ls, sigterm_timeout: 5}
                                                   ^ error[LCH008] sigterm_timeout='5' of <executable> is not a number with a decimal point
    """)  # noqa: E501


def test_yaml_that_is_what_it_has_to_be() -> None:
    check("""
        //- /a.launch.yaml
        launch:
          - arg: {name: rate, default: '5'}
          - log: {message: $(var rate)}
          - executable: {cmd: ls, sigterm_timeout: 5.0, shell: true, respawn: 'false', respawn_max_retries: 3}
          - group: {scoped: true, children: []}
          - node: {pkg: p, exec: e, name: n, param: [{name: a, value: 1}, {name: b, value: [1]}]}
    """)


def test_a_refused_value_where_a_condition_is_false() -> None:
    """The whole file is read before any of it is executed."""
    check("""
        //- /a.launch.xml
        <launch>
          <group if="false">
            <node pkg="p" exec="e" name="n" args="it's" respawn_delay="$(var delay)">
                                                  ^^^^ error[LCH008] args='it's' of <node> is not a command line: a quote in it is never closed
                                                                       ^^^^^^^^^^^^ error[LCH008] respawn_delay='$(var delay)' of <node> is not a number that is not negative
              <param name="a" value="[1, 2.5]"/>
                                     ^^^^^^^^ error[LCH008] value='[1, 2.5]' of <param> is not a bool, a number, a text or a list of one of them
              <param name="b" value="[$(var x), 1, y]"/>
                                     ^^^^^^^^^^^^^^^^ error[LCH008] value='[$(var x), 1, y]' of <param> is not a list of one type
              <param name="c" type="float" value="fast"/>
                                                  ^^^^ error[LCH008] value='fast' of <param> is not a number with a decimal point
              <param name="d" value="$(unknown x)"/>
                                     ^^^^^^^^^^^^ error[LCH011] 'unknown' is not a substitution
            </node>
          </group>
        </launch>
    """)  # noqa: E501


def test_substitutions_that_launch_cannot_read() -> None:
    check("""
        //- /a.launch.xml
        <launch>
          <log message="$(any true false)"/>
                        ^^^^^^^^^^^^^^^^^ error[LCH011] launch cannot read $(any ...) in XML and YAML files: write $(or ...)
          <log message="$(or true false)"/>
        </launch>
    """)  # noqa: E501


def test_simulated_time_by_a_tag() -> None:
    """The frontends hand a text over where the action takes a bool only."""
    check("""
        //- /a.launch.xml
        <launch>
          <set_use_sim_time value="true" if="false"/>
          <set_use_sim_time value="true"/>
                                   ^^^^ error[LCH008] value='true' of <set_use_sim_time> is not what launch can use: it takes no text; write <set_parameter name="use_sim_time" value="..."/>
        </launch>
    """)  # noqa: E501


def test_an_argument_needed_though_it_is_set_before() -> None:
    """launch looks for required arguments before it executes anything."""
    check("""
        //- /a.launch.xml
        <launch>
          <let name="a" value="1"/>
          <arg name="a"/>
          ^^^^^^^^^^^^^^^ info[ARG003] argument 'a' has no default; launch with a:=...
        </launch>
    """)


def test_the_namespace_of_a_composable_node() -> None:
    """That one is seen by the container, not by launch."""
    check("""
        //- /a.launch.xml
        <launch>
          <node_container pkg="p" exec="container" name="c" namespace="">
            <composable_node pkg="p" plugin="p::A" name="a" namespace="a-b"/>
                                                                       ^^^ warning[LCH009] namespace name '/a-b' is not allowed: a namespace is made of letters, digits and underscores between single slashes
          </node_container>
        </launch>
    """)  # noqa: E501
