"""With includes remembered a tree is what it is without: at first, when nothing changed, and when text has moved."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect
from preflight_analysis.environment.executables import ExecutableIndex
from preflight_analysis.evaluation.ros1 import evaluate as evaluate_module
from preflight_analysis.evaluation.ros1.evaluate import evaluate
from preflight_analysis.evaluation.ros1.scope import Scope
from preflight_analysis.evaluation.ros1.state import State
from preflight_analysis.evaluation.surroundings import Surroundings
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.incremental.database import MOST_ANSWERS, Database
from preflight_analysis.incremental.query import query
from preflight_analysis.launch.model import Action
from preflight_analysis.workspace.sources import Sources

FIXTURES = Path(__file__).parents[2] / "fixtures" / "ros1"

INCLUDED = """\
<launch>
  <arg name="speed" default="1"/>
  <arg name="fixed" value="1"/>
  <param name="~shared" value="$(arg speed)"/>
  <group ns="inner"><node pkg="p" type="t" name="node"><param name="speed" value="$(arg speed)"/></node></group>
  <rosparam>{rate: 5}</rosparam>
</launch>
"""


@query
def remembering(db: Database, within: Surroundings, path: str) -> LaunchTree:
    """A launch, of which includes and nodes are remembered."""
    return evaluate(path, {}, within, by_parts=True)


class Twice:
    """Evaluates a launch file with includes and nodes remembered throughout, and without."""

    def __init__(self, folder: Path) -> None:
        self.sources = Sources()
        environment = detect(str(folder), package_path=(str(folder),))
        executables = ExecutableIndex(environment, self.sources)
        self._surroundings = Surroundings(self.sources, executables, environment, str(folder))

    def tree(self, path: Path) -> LaunchTree:
        """The tree, which is the same both ways."""
        without = evaluate(str(path), {}, self._surroundings)
        remembered = remembering(self.sources.db, self._surroundings, str(path))
        assert remembered == without
        assert [node.action for node in remembered.nodes] == [node.action for node in without.nodes]
        self.remembered = remembered
        return without


@pytest.mark.parametrize("folder", sorted(FIXTURES.iterdir()), ids=lambda folder: folder.name)
def test_the_fixtures(folder: Path) -> None:
    twice = Twice(folder)
    for path in sorted((*folder.rglob("*.launch"), *folder.rglob("*.xml"))):
        for text in (path.read_text(errors="replace"), path.read_text(errors="replace").replace(">", ">\n", 1)):
            twice.sources.open(str(path), text)
            twice.tree(path)
        twice.sources.close(str(path))


DEPENDING = {
    "namespaces": '<include file="{0}"/><include file="{0}" ns="b"/>',
    "duplicate names": '<include file="{0}"/><include file="{0}"/>',
    "private parameters are shared": '<param name="~x" value="1"/><include file="{0}"/>',
    "a remap from above": '<remap from="a" to="b"/><include file="{0}"/>',
    "env": '<env name="E" value="1"/><include file="{0}"><env name="F" value="2"/></include>',
    "pass_all_args": '<arg name="speed" value="7"/><include file="{0}" pass_all_args="true"/>',
    "an argument": '<include file="{0}"><arg name="speed" value="3"/></include>',
    "an undeclared argument": '<include file="{0}"><arg name="sped" value="3"/></include>',
    "a parameter is set again": '<rosparam>{{rate: 1}}</rosparam><include file="{0}"/>',
    "a default machine": '<machine name="m" address="a" default="true"/><include file="{0}"/>',
    "another default machine": '<machine name="n" address="a" default="true"/><include file="{0}"/>',
    "another environment": '<include file="{0}"><env name="F" value="3"/></include>',
    "another remap": '<remap from="a" to="c"/><include file="{0}"/>',
    "an own namespace": '<include file="{0}" ns="b"/>',
    "a fixed argument": '<include file="{0}"><arg name="fixed" value="2"/></include>',
    "a fixed argument with all": '<include file="{0}" pass_all_args="true"><arg name="fixed" value="2"/></include>',
    "a namespace": '<group ns="c"><include file="{0}"/></group>',
    "deeper": '<group><group><include file="{0}"/></group></group>',
}
"""What is above an include, all of which may change what it adds."""


@pytest.mark.parametrize("what", DEPENDING)
def test_what_an_include_depends_on(tmp_path: Path, what: str) -> None:
    inner, root = tmp_path / "inner.launch", tmp_path / "root.launch"
    inner.write_text(INCLUDED)
    twice = Twice(tmp_path)
    for above in ("", "\n\n", '<param name="before" value="1"/>', ""):
        twice.sources.open(str(root), f"<launch>{above}{DEPENDING[what].format(inner)}</launch>")
        twice.tree(root)
    for other in DEPENDING.values():
        for text in (other, DEPENDING[what]):
            twice.sources.open(str(root), f"<launch>{text.format(inner)}</launch>")
            twice.tree(root)


@pytest.mark.parametrize(
    "text",
    [
        '<launch><node pkg="p" type="t" name="$(anon x)"/></launch>',
        '<launch><machine name="m" address="b"/><node pkg="p" type="t" name="n" machine="m"/></launch>',
        '<launch><include file="$(dirname)/root.launch"/></launch>',
        '<launch><node pkg="p" type="t" nam="n"/></launch>',
    ],
)
def test_what_depends_on_the_whole_launch(tmp_path: Path, text: str) -> None:
    inner, root = tmp_path / "inner.launch", tmp_path / "root.launch"
    inner.write_text(text)
    twice = Twice(tmp_path)
    body = f'<include file="{inner}"/><machine name="m" address="a"/><node pkg="p" type="t" name="$(anon x)"/>'
    for parts in (body, body + f'<include file="{inner}"/>', f'<include file="{inner}" ns="c"/>' + body):
        root.write_text(f"<launch>{parts}</launch>")
        twice.tree(root)


def test_a_changed_file_below_is_seen(tmp_path: Path) -> None:
    inner, root = tmp_path / "inner.launch", tmp_path / "root.launch"
    root.write_text(f'<launch><include file="{inner}"/></launch>')
    twice = Twice(tmp_path)
    assert not twice.tree(root).params
    inner.write_text(INCLUDED)
    assert "/rate" in twice.tree(root).params
    twice.sources.open(str(inner), INCLUDED.replace("rate", "pace"))
    assert "/pace" in twice.tree(root).params


def test_what_only_moved_is_not_evaluated_again(tmp_path: Path) -> None:
    inner, root = tmp_path / "inner.launch", tmp_path / "root.launch"
    inner.write_text(INCLUDED)
    include = f'<include file="{inner}">\n<arg name="speed" value="$(arg a)"/>\n</include>'
    text = f'<launch>\n<arg name="a" default="3"/>\n{include}\n</launch>'
    twice = Twice(tmp_path)
    nodes = []
    for above in ("", "\n", "<!-- a comment -->\n\n", ""):
        twice.sources.open(str(root), above + text)
        twice.tree(root)
        nodes.append(twice.remembered.nodes[0])
    assert all(node is nodes[0] for node in nodes)


NODE = '<node pkg="p" type="t" name="one"><param name="rate" value="$(arg rate)"/><remap from="a" to="b"/></node>'
ABOVE = (
    '<arg name="rate" default="5"/>',
    '<arg name="rate" default="6"/>',
    '<arg\n name="rate" default="6"/>',
    '<arg name="rate"/>',
    '<arg name="rate" default="5"/><remap from="a" to="c"/>',
    '<arg name="rate" default="5"/><env name="E" value="1"/>',
    '<arg name="rate" default="5"/><param name="~shared" value="1"/>',
    '<arg name="rate" default="5"/><param name="one/rate" value="1"/>',
    '<arg name="rate" default="5"/><machine name="m" address="a" default="true"/>',
    '<arg name="rate" default="5"/><node pkg="p" type="t" name="one"/>',
    '<arg name="rate" default="5"/><node pkg="p" type="t" name="$(anon x)"/>',
    '<arg name="rate" default="5"/><node pkg="p" type="t" name="other"/>',
)
"""What stands above a node, all of which may change what its tag adds, but the last."""
BELOW = (
    "",
    '<node pkg="p" type="t" name="two"><rosparam>{a: 1}</rosparam><rosparam file="$(dirname)/p.yaml"/></node>',
    '<node pkg="p" type="t" name="$(anon x)"/><node pkg="p" type="t" name="$(anon x)_2"/>',
    '<node pkg="p" type="t" name="two" if="$(eval rate == 6)"/><node pkg="p" nam="three"/>',
    '<group ns="g"><node pkg="p" type="t" name="one"/><node pkg="p" type="t" name="one"/></group>',
)


@pytest.mark.parametrize("below", BELOW)
def test_what_the_tag_of_a_node_depends_on(tmp_path: Path, below: str) -> None:
    root, params = tmp_path / "root.launch", tmp_path / "p.yaml"
    params.write_text("c: 1")
    twice = Twice(tmp_path)
    for number, first in enumerate(ABOVE):
        for other in (first, "\n" + first, ABOVE[number - 1], first):
            twice.sources.open(str(root), f"<launch>\n{other}\n{NODE}\n{below}\n</launch>")
            twice.tree(root)
        params.write_text(f"c: {number}")


def test_a_node_that_only_moved_is_the_same_and_has_its_new_place(tmp_path: Path) -> None:
    root = tmp_path / "root.launch"
    twice = Twice(tmp_path)
    nodes = []
    for above in ("", "\n", '<node pkg="p" type="t" name="other"/>\n'):
        text = f'<launch>\n<arg name="rate" default="5"/>\n{above}{NODE}\n</launch>'
        twice.sources.open(str(root), text)
        fresh = twice.tree(root).nodes[-1]
        node = twice.remembered.nodes[-1]
        assert node.action == fresh.action and text[slice(*node.action.span)] == NODE
        nodes.append(node)
    assert all(node is nodes[0] for node in nodes)


def test_an_anonymous_name_that_another_node_made(tmp_path: Path) -> None:
    root, twice = tmp_path / "root.launch", Twice(tmp_path)
    before = '<group><node pkg="p" type="t" name="$(anon n)"/></group>'
    others = "".join(f'<node pkg="p" type="t" name="{name}" args="$(anon n)"/>\n' for name in "ab")
    for first in ('name="$(anon m)"', 'name="$(anon n)"', 'name="x"', 'name="$(anon n)"'):
        for above in ("", before, ""):
            twice.sources.open(str(root), f'<launch>{above}\n<node pkg="p" type="t" {first}/>\n{others}</launch>')
            twice.tree(root)


def test_an_edit_evaluates_the_include_that_it_touches(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    inner, root = tmp_path / "inner.launch", tmp_path / "root.launch"
    inner.write_text(INCLUDED)
    twice = Twice(tmp_path)
    tags = '<include file="{0}" ns="a"/>\n<node pkg="p" type="t" name="{1}"/>\n<include file="{0}" ns="{2}"/>\n'
    sources, surroundings = twice.sources, twice._surroundings
    sources.open(str(root), f"<launch>\n\n{tags.format(inner, 'n', 'b')}</launch>")
    remembering(sources.db, surroundings, str(root))
    evaluated: list[str | None] = []
    include = evaluate_module._EVALUATED_APART["include"]

    def noted(state: State, scope: Scope, action: Action, default_machine: str | None) -> str | None:
        ns = action.value("ns")
        evaluated.append(ns.text if ns is not None else None)
        return include(state, scope, action, default_machine)

    monkeypatch.setitem(evaluate_module._EVALUATED_APART, "include", noted)  # type: ignore[arg-type]
    for node, ns, again in (("n", "c", ["c"]), ("m", "c", []), ("m", "a", ["a", "a"])):
        evaluated.clear()
        sources.open(str(root), f"<launch>\n\n{tags.format(inner, node, ns)}</launch>")
        tree = remembering(sources.db, surroundings, str(root))
        assert (evaluated, f"/{ns}/inner/node" in {node.name for node in tree.nodes}) == (again, True)


ASKING = """\
<launch>
<arg name="rate"/><arg name="frame" default="odom"/><arg name="level" default="1"/>
<node pkg="p" type="t" name="plain"/>
<node pkg="p" type="t" name="framed"><param name="frame" value="$(arg frame)"/></node>
<node pkg="p" type="t" name="eval" if="$(eval rate > 3)"/>
<rosparam subst_value="true">{a: $(arg level)}</rosparam>
<include file="$(dirname)/below.launch" pass_all_args="true"/>
</launch>
"""
PASSING = (
    {"rate": "5"},
    {"rate": "5", "frame": "map"},
    {"rate": "2", "frame": "map"},
    {"rate": "x"},
    {},
    {"frame": "map", "unknown": "1"},
    {"rate": "5", "level": "2"},
    {"rate": "5"},
)


@pytest.mark.parametrize("all_args", [False, True])
def test_arguments_of_an_include_come_and_go_and_change(tmp_path: Path, all_args: bool) -> None:
    (tmp_path / "inner.launch").write_text(ASKING)
    below = '<launch><arg name="rate" default="1"/><param name="b" value="$(arg rate) $(arg level)"/></launch>'
    (tmp_path / "below.launch").write_text(below)
    root, twice = tmp_path / "root.launch", Twice(tmp_path)
    head = f'<include file="{tmp_path}/inner.launch"' + (' pass_all_args="true">' if all_args else ">")
    for passed in PASSING:
        tags = "\n".join(f'<arg name="{name}" value="{value}"/>' for name, value in passed.items())
        twice.sources.open(str(root), f"<launch>\n{tags if all_args else ''}\n{head}\n{tags}\n</include>\n</launch>")
        twice.tree(root)


def test_an_argument_is_for_those_that_ask_for_it(tmp_path: Path) -> None:
    inner, root, twice = tmp_path / "inner.launch", tmp_path / "root.launch", Twice(tmp_path)
    inner.write_text(
        ASKING.replace(' pass_all_args="true"', "").replace("<include", "<!--").replace("/>\n</l", "-->\n</l")
    )
    trees = []
    for frame in ("map", "odom", "world", "map"):
        args = f'<arg name="rate" value="5"/><arg name="frame" value="{frame}"/>'
        twice.sources.open(str(root), f'<launch><include file="{inner}">{args}</include></launch>')
        twice.tree(root)
        trees.append(twice.remembered)
    first, *others = trees
    for tree in others:
        # A node whose parameter has another value is still the same node.
        assert all(one is other for one, other in zip(first.nodes, tree.nodes, strict=True))
        assert tree.params["/a"] is first.params["/a"]
    assert [tree.params["/framed/frame"].value for tree in trees] == ["map", "odom", "world", "map"]


def test_of_values_of_an_argument_only_the_latest_are_kept(tmp_path: Path) -> None:
    inner, root, twice = tmp_path / "inner.launch", tmp_path / "root.launch", Twice(tmp_path)
    (tmp_path / "below.launch").write_text("<launch/>")
    inner.write_text(ASKING)
    db = twice.sources.db
    sizes = []
    for number in range(3 * MOST_ANSWERS):
        args = f'<arg name="rate" value="5"/><arg name="frame" value="{number}"/>'
        twice.sources.open(str(root), f'<launch><include file="{inner}">{args}</include></launch>')
        twice.tree(root)
        cells = [*db.cells.values(), *(cell for answered in db._answered.values() for cell in answered)]
        sizes.append(len(cells) + len({id(part) for cell in cells for known in cell.parts.values() for part in known}))
    assert sizes[-1] == sizes[2 * MOST_ANSWERS]


def test_an_edit_below_asks_for_an_argument_that_nobody_asked_for(tmp_path: Path) -> None:
    inner, root, yaml = (tmp_path / name for name in ("inner.launch", "root.launch", "p.yaml"))
    args = '<arg name="rate" value="5"/><arg name="other" value="6"/>'
    root.write_text(f'<launch><include file="{inner}">{args}</include></launch>')
    inner.write_text(f'<launch><rosparam param="p" subst_value="true" file="{yaml}"/></launch>')
    twice = Twice(tmp_path)
    for name, value in (("rate", 5), ("other", 6), ("rate", 5)):
        twice.sources.open(str(yaml), f"$(eval {name})")
        assert twice.tree(root).params["/p"].value == value
