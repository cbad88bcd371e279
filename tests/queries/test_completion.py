"""What is offered at a cursor (`$0`), and what it replaces."""

from __future__ import annotations

import textwrap
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from preflight_analysis.queries.completion import TRIGGERS, complete
from preflight_analysis.queries.completion_items import Completion
from preflight_analysis.queries.completion_values import Lookup
from support.query_harness import Executables, at_cursor


def completed(text: str, trigger: str | None = None, **options: object) -> Completion | None:
    there = at_cursor(text, options.get("variables"))  # type: ignore[arg-type]
    executables = Executables(options.get("executables", {}))  # type: ignore[arg-type]
    return complete(
        there.analysis,
        there.launch_file,
        there.offset,
        Lookup(there.sources, executables, there.ahead_of_runs),
        trigger,
    )


def offered(text: str, trigger: str | None = None, **options: object) -> list[str]:
    """The labels, in order."""
    found = completed(text, trigger, **options)
    return [item.label for item in found.items] if found else []


def applied(text: str, label: str, *, snippets: bool = False, **options: object) -> str:
    """The first file's text (that with the cursor) with the item of that label accepted."""
    found = completed(text, **options)
    assert found is not None
    (item,) = [each for each in found.items if each.label == label]
    there = at_cursor(text)
    source = there.document.text
    new = item.snippet if snippets and item.snippet is not None else item.text
    return (source[: found.span.start] + new + source[found.span.end :]).rstrip("\n")


def test_an_empty_file_begins_with_launch() -> None:
    assert offered("$0") == ["launch"]
    assert offered("<$0") == ["launch"]
    assert applied("<lau$0", "launch") == "<launch"
    assert applied("<lau$0", "launch", snippets=True) == "<launch>\n\t$0\n</launch>"
    assert applied("lau$0", "launch", snippets=True) == "<launch>\n\t$0\n</launch>"
    assert offered("<launch></launch><$0") == []


def test_elements_are_those_that_the_parent_reads() -> None:
    assert offered("<launch><$0</launch>")[:4] == ["node", "include", "arg", "param"]
    assert offered("<launch><node pkg='p' type='t' name='n'><$0</node></launch>") == [
        "param",
        "rosparam",
        "remap",
        "env",
    ]
    assert offered("<launch><include file='x'><$0</include></launch>") == ["arg", "env"]
    assert offered("<launch><arg name='a'><$0</arg></launch>") == []
    assert offered("<launch><nonsense><$0</nonsense></launch>") == []


def test_an_element_comes_with_what_it_needs() -> None:
    assert applied("<launch><no$0</launch>", "node") == "<launch><node</launch>"
    node = '<launch><node pkg="$1" type="$2" name="$3"/></launch>'
    assert applied("<launch><no$0</launch>", "node", snippets=True) == node
    assert applied("<launch>no$0</launch>", "node", snippets=True) == node
    include = "<launch><include file='x'><{}</include></launch>"
    assert applied(include.format("$0"), "arg", snippets=True) == include.format('arg name="$1" value="$2"/>')
    assert '<arg name="$1" default="$2"/>' in applied("<launch><$0</launch>", "arg", snippets=True)


def test_the_name_of_a_tag_with_attributes_is_replaced_alone() -> None:
    assert applied("<launch><no$0de pkg='p'/></launch>", "node", snippets=True) == "<launch><node pkg='p'/></launch>"
    assert applied("<launch><pa$0/></launch>", "param", snippets=True) == "<launch><param/></launch>"
    half = "<launch>\n  <no$0\n  <node pkg='p'/>\n</launch>"
    assert applied(half, "node", snippets=True).startswith('<launch>\n  <node pkg="$1"')


def test_what_is_open_can_be_closed() -> None:
    assert offered("<launch><group></$0") == ["group>"]
    assert applied("<launch><group></gr$0", "group>") == "<launch><group></group>"
    assert applied("<launch><group></gr$0o></launch>", "group>") == "<launch><group></group></launch>"
    assert offered("<launch>\n  <group>\n    <$0\n</launch>")[-1] == "/group>"
    assert "/launch>" not in offered("<launch>\n  <$0\n</launch>")


def test_attributes_that_are_not_there_yet() -> None:
    assert offered("<launch><node pkg='p' $0/></launch>")[:3] == ["type", "name", "args"]
    assert offered("<launch><node\n  pkg='p'\n  $0\n  <param name='x' value='1'/>\n</launch>")[:2] == ["type", "name"]
    assert offered("<launch><arg name='a' default='1' $0/></launch>") == ["doc", "if", "unless"]
    assert offered("<launch><param name='a' textfile='f' if='true' $0/></launch>") == ["type"]
    assert offered("<launch><include file='x'><arg $0/></include></launch>") == ["name", "value", "if", "unless"]
    assert offered("<launch><nonsense $0/></launch>") == []


def test_an_attribute_replaces_the_word_around_the_cursor() -> None:
    assert applied("<launch><node na$0/></launch>", "name") == '<launch><node name=""/></launch>'
    assert applied("<launch><node na$0/></launch>", "name", snippets=True) == '<launch><node name="$1"/></launch>'
    output = applied("<launch><node out$0/></launch>", "output", snippets=True)
    assert output == '<launch><node output="${1|screen,log|}"/></launch>'
    assert applied("<launch><node na$0mme='x'/></launch>", "name") == "<launch><node name='x'/></launch>"


@pytest.mark.parametrize(
    ("text", "labels"),
    [
        ("<node output='$0'/>", ["log", "screen"]),
        ("<node respawn='$0'/>", ["true", "false"]),
        ("<node if='$0'/>", ["true", "false"]),
        ("<param type='$0'/>", ["auto", "str", "string", "int", "double", "bool", "boolean", "yaml"]),
        ("<rosparam command='$0'/>", ["load", "dump", "delete"]),
        ("<machine default='$0'/>", ["true", "false", "never"]),
        ("<node output='$0", ["log", "screen"]),
    ],
)
def test_values_of_the_language(text: str, labels: list[str]) -> None:
    assert offered(f"<launch>{text}</launch>", "'") == labels


def test_a_value_of_the_language_replaces_the_whole_value() -> None:
    text = "<launch><node output='lo$0gg'/></launch>"
    assert applied(text, "screen") == "<launch><node output='screen'/></launch>"


PACKAGES = """
//- /a/package.xml
<package/>
//- /b/package.xml
<package/>
"""


def test_packages() -> None:
    assert offered("<launch><node pkg='$0'/></launch>" + PACKAGES) == ["a", "b", "p"]
    assert offered("<launch><param name='x' value='$(find $0)/x'/></launch>" + PACKAGES) == ["a", "b", "p"]
    text = "<launch><include file='$(find $0/x.launch'/></launch>" + PACKAGES
    assert applied(text, "b") == "<launch><include file='$(find b)/x.launch'/></launch>"
    text = "<launch><include file='$(find q$0r)/x.launch'/></launch>" + PACKAGES
    assert applied(text, "b") == "<launch><include file='$(find b)/x.launch'/></launch>"
    text = '<launch>\n  <include file="$(find $0\n</launch>' + PACKAGES
    assert applied(text, "a") == '<launch>\n  <include file="$(find a)\n</launch>'


def test_executables_of_the_package() -> None:
    there = {"p": ["camera", "talker.py"]}
    assert offered("<launch><node pkg='p' type='$0'/></launch>", executables=there) == ["camera", "talker.py"]
    by_argument = "<launch><arg name='a' default='p'/><node pkg='$(arg a)' type='$0'/></launch>"
    assert offered(by_argument, executables=there) == ["camera", "talker.py"]
    assert offered("<launch><node type='$0'/></launch>", executables=there) == []


def test_files_of_a_package(tmp_path: Path) -> None:
    for name in ("launch/inner.launch", "launch/old/x.launch", "launch/notes.txt", "launch/.hidden.launch", "a.yaml"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    (tmp_path / "launch" / ".ring").symlink_to(".ring")
    (tmp_path / "launch" / "old" / "ring").symlink_to("ring")
    package = f"\n//- {tmp_path}/package.xml\n<package/>"
    find = f"$(find {tmp_path.name})"
    assert offered(f"<launch><include file='{find}/launch/old/$0'/></launch>{package}") == ["x.launch"]
    assert offered(f"<launch><include file='{find}/$0'/></launch>{package}") == ["launch/"]
    assert offered(f"<launch><include file='{find}/launch/in$0'/></launch>{package}", "/") == ["inner.launch", "old/"]
    assert offered(f"<launch><rosparam file='{find}/$0'/></launch>{package}") == ["a.yaml", "launch/"]
    assert offered(f"<launch><param textfile='{find}/launch/$0'/></launch>{package}") == [
        "inner.launch",
        "notes.txt",
        "old/",
    ]
    assert offered(f"<launch><node args='-d {find}/$0'/></launch>{package}") == ["a.yaml", "launch/"]
    text = f"<launch><include file='{find}/launch/ol$0dd/x.launch'/></launch>{package}"
    assert applied(text, "old/") == f"<launch><include file='{find}/launch/old/x.launch'/></launch>"
    by_argument = f"<launch><arg name='a' default='launch'/><include file='{find}/$(arg a)/$0'/></launch>{package}"
    assert offered(by_argument) == ["inner.launch", "old/"]
    assert offered("<launch><include file='$(find nowhere)/$0'/></launch>") == []


def test_where_a_file_can_be() -> None:
    text = "<launch><arg name='dir' default='x'/><include file='$0'/></launch>"
    assert offered(text, "'") == ["$(dirname)/", "$(find p)/", "$(arg dir)"]


INNER = """
//- /p/inner.launch
<launch>
  <arg name="rate" default="5" doc="How often, in Hz"/>
  <arg name="robot"/>
  <arg name="fixed" value="1"/>
  <group><arg name="inside" default="2"/></group>
</launch>
"""


def test_arguments_of_an_included_file_required_ones_first() -> None:
    found = completed("<launch><include file='$(find p)/inner.launch'><arg name='$0'/></include></launch>" + INNER)
    assert found is not None
    assert [(i.label, i.detail, i.doc) for i in found.items] == [
        ("robot", "required", ""),
        ("rate", "default: 5", "How often, in Hz\n\nDefault: `5`"),
    ]
    half = "<launch><include file='$(find p)/inner.launch'><arg name='robot' value='x'/><arg name='$0" + INNER
    assert offered(half) == ["rate"]
    not_taken = (
        "<launch><group if='false'><include file='$(find p)/inner.launch'><arg name='$0'/></include></group></launch>"
    )
    assert offered(not_taken + INNER) == ["robot", "rate"]
    assert offered("<launch><arg name='$0'/></launch>" + INNER) == []


def test_declared_arguments_those_before_the_place_first() -> None:
    text = """
        <launch>
          <arg name="robot" default="husky"/>
          <group><arg name="elsewhere" default="1"/></group>
          <group>
            <arg name="here" default="2"/>
            <param name="x" value="$(arg $0)"/>
          </group>
          <arg name="late" default="3"/>
        </launch>
    """
    found = completed(text, " ")
    assert found is not None
    assert [(i.label, i.detail) for i in found.items] == [
        ("robot", "= husky"),
        ("here", "= 2"),
        ("late", "= 3, declared below"),
    ]
    assert applied("<launch><arg name='a'/><param name='x' value='$(arg $0'/></launch>", "a").endswith(
        "'$(arg a)'/></launch>"
    )


def test_substitution_commands() -> None:
    labels = ["arg", "find", "env", "optenv", "anon", "dirname", "eval"]
    assert offered("<launch><param name='x' value='$($0'/></launch>", "(") == labels
    assert offered("<launch><param name='x' value='a $($0'/></launch>") == labels[:-1]
    after_dollar = offered("<launch><param name='x' value='$$0'/></launch>", "$")
    assert after_dollar[:2] == ["$(arg name)", "$(find package)"]
    param = "<launch><param name='x' value='{}'/></launch>"
    assert applied(param.format("$(fi$0"), "find") == param.format("$(find )")
    assert applied(param.format("$(fi$0"), "find", snippets=True) == param.format("$(find $1)")
    assert applied(param.format("$(fi$0nn p)"), "find") == param.format("$(find p)")
    assert applied(param.format("$(di$0)"), "dirname") == param.format("$(dirname)")
    assert applied(param.format("$$0"), "$(find package)", snippets=True) == param.format("\\$(find $1)")


def test_names_in_expressions() -> None:
    head = "<launch><arg name='rate' default='1'/><arg name='list' default='1'/><group if="
    labels = offered(head + '"$(eval ra$0)"/></launch>')
    assert labels[:2] == ["rate", "arg"]
    assert {"find", "and", "sqrt", "pi", "true", "str"} <= set(labels)
    assert labels.count("list") == 1, "the function is meant, not the argument"
    assert offered(head + "\"$(eval arg('$0'))\"/></launch>") == ["rate", "list"]
    assert offered(head + "\"$(eval find('$0'))\"/></launch>") == ["p"]
    assert offered(head + "\"$(eval rate == 'a$0')\"/></launch>") == []
    assert offered(head + '"$(eval rate.$0)"/></launch>') == []
    assert applied(head + '"$(eval 1 + ra$0tt * 2)"/></launch>', "rate").endswith('"$(eval 1 + rate * 2)"/></launch>')


def test_environment_variables_without_their_values() -> None:
    variables = {"HOME": "/root", "ROS_IP": "1.2.3.4", "TOKEN": "secret"}
    text = "<launch><param name='x' value='$({} $0)'/></launch>"
    for command in ("env", "optenv"):
        found = completed(text.format(command), " ", variables=variables)
        assert found is not None
        assert [i.label for i in found.items] == ["ROS_IP", "HOME", "TOKEN"]
        assert not any("secret" in (i.detail + i.doc) for i in found.items)
    assert applied(text.replace(")", "").format("optenv"), "HOME", variables=variables).endswith(
        "'$(optenv HOME'/></launch>"
    )


def test_machines() -> None:
    text = "<launch><machine name='base' address='10.0.0.2'/><node pkg='p' type='t' name='n' machine='$0'/></launch>"
    assert offered(text) == ["base"]


NODES = """
//- interfaces
{"/cam": {"publishers": {"image": "sensor_msgs/Image"},
          "params": {"~rate": 10, "~frame": null, "/use_sim_time": false}},
 "/r/view": {"subscribers": {"picture": "sensor_msgs/Image", "text": "std_msgs/String"},
             "services": {"~reset": "std_srvs/Empty"}},
 "/say": {"publishers": {"words": "std_msgs/String"}}}
"""
CAMERA = "<node pkg='p' type='cam' name='cam'>{}</node>"
VIEW = "<node pkg='p' type='view' name='view' ns='r'>{}</node>"
SAY = "<node pkg='p' type='say' name='say'/>"


def launched(camera: str = "", view: str = "") -> str:
    return f"<launch>{CAMERA.format(camera)}{VIEW.format(view)}{SAY}</launch>" + NODES


def test_parameters_of_a_node() -> None:
    found = completed(launched("<param name='$0'/>"))
    assert found is not None
    assert [(i.label, i.detail) for i in found.items] == [("rate", "default: 10"), ("frame", "no default")]
    assert offered(launched("<param name='rate' value='1'/><param name='$0' value='1'/>")) == ["frame"]
    outside = f"<launch><param name='$0'/>{CAMERA.format('')}{VIEW.format('')}{SAY}</launch>" + NODES
    assert "/use_sim_time" in offered(outside)


def test_topics_of_a_node_and_of_the_graph() -> None:
    found = completed(launched("", "<remap from='$0' to='x'/>"))
    assert found is not None
    assert [(i.label, i.detail) for i in found.items] == [
        ("picture", "sensor_msgs/Image, subscribes"),
        ("text", "std_msgs/String, subscribes"),
        ("~reset", "std_srvs/Empty, offers service"),
    ]
    found = completed(launched("", "<remap from='text' to='$0'/>"))
    assert found is not None
    assert [(i.label, i.detail) for i in found.items][:2] == [
        ("/r/text", "std_msgs/String"),
        ("/words", "std_msgs/String"),
    ]
    assert "/wo" not in offered(launched("", "<remap from='text' to='/wo$0'/>")), "only this remap makes the name"
    relative = offered(launched("", "<remap from='text' to='wo$0'/>"))
    assert "picture" in relative and "/words" in relative


def test_remaps_outside_of_nodes_reach_those_in_their_scope() -> None:
    text = f"<launch>{SAY}<group><remap from='$0'/>{CAMERA.format('')}{VIEW.format('')}</group></launch>" + NODES
    assert offered(text) == ["image", "picture", "text", "~reset"]


def test_a_new_node_is_known_by_others_of_its_executable() -> None:
    text = f"<launch>{CAMERA.format('')}{VIEW.format('')}{SAY}<node pkg='p' type='cam'><param name='$0</launch>" + NODES
    assert offered(text) == ["rate", "frame"]


@pytest.mark.parametrize(
    ("text", "trigger"),
    [
        ("<launch>\n  $0</launch>", " "),
        ("<launch><param name='x' value='two $0words'/></launch>", " "),
        ("<launch><param name='x' value='a:$0'/></launch>", ":"),
        ("<launch><param name='x' value='a/$0'/></launch>", "/"),
        ("<launch><param name='x' value='$0'/></launch>", "'"),
        ("<launch><!-- <$0 --></launch>", "<"),
        ("<launch><node pkg='p' /$0></launch>", "/"),
    ],
)
def test_silence_where_nothing_was_asked_for(text: str, trigger: str) -> None:
    assert offered(text, trigger) == []


WHOLE = """<launch>
  <arg name="größe" default="5" doc="🤖"/>
  <include file="$(find p)/inner.launch" if="$(eval größe &lt; 3 and env('HOME') != '')">
    <arg name="rate" value="$(arg größe)"/>
  </include>
  <!-- a comment -->
  <group ns="r"><node pkg="p" type="t" name="n" args="-d $(find p)/x.rviz _a:=$(optenv HOME b)" output='screen'>
    <rosparam command="load" subst_value="true">a: $(arg größe)</rosparam>
    <remap from="picture" to="/image"/>
  </node></group>
</launch>
"""


@example(at=125, deleted=14, typed="", trigger=None)  # a value over two lines
@given(
    st.integers(0, len(WHOLE)),
    st.integers(0, 40),
    st.sampled_from(["", "<", "</", " ", '"', "'", "$", "$(", "$(eval ", "=", "é", "/"]),
    st.sampled_from([None, *TRIGGERS]),
)
def test_whatever_is_typed_or_deleted_the_edit_is_within_a_line(
    at: int, deleted: int, typed: str, trigger: str | None
) -> None:
    text = WHOLE[:at] + typed + "$0" + WHOLE[at + deleted :]
    there = at_cursor(text + INNER)
    found = complete(
        there.analysis,
        there.launch_file,
        there.offset,
        Lookup(there.sources, Executables(), there.ahead_of_runs),
        trigger,
    )
    if found is not None:
        assert found.span.start <= there.offset <= found.span.end
        assert "\n" not in there.text(found.span)
        assert len({item.label for item in found.items}) == len(found.items)


def test_a_long_file_is_no_trouble() -> None:
    assert offered(textwrap.dedent("<launch>" + "<group>" * 120 + "<$0")) != []
