"""What the writer of each format makes of the same change: nothing else of the text is touched."""

import textwrap

import pytest
from preflight_analysis.documents.span import Span
from preflight_analysis.edits.edit import Edit, applied
from preflight_analysis.edits.gate import refusal
from preflight_analysis.edits.writer import Writer, replaced, writer_of
from preflight_analysis.edits.yaml import YamlWriter
from preflight_analysis.launch.model import Action, LaunchFile
from preflight_analysis.workspace.sources import Sources

_PYTHON = """
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        {}
    ])
"""


class _Text:
    """A launch file, and what it is after an edit."""

    def __init__(self, path: str, text: str) -> None:
        self.text = textwrap.dedent(text).lstrip("\n")
        sources = Sources()
        sources.open(path, self.text)
        found = sources.launch_file(path, 2)
        assert isinstance(found, LaunchFile)
        self.document, self.root = found.document, found.root
        self.writer: Writer = writer_of(found.document)

    def first(self, kind: str) -> Action:
        assert self.root is not None
        return next(each for each in self.root.walk() if each.kind == kind)

    def named(self, name: str) -> Action:
        assert self.root is not None
        values = ((each, each.value("name")) for each in self.root.walk())
        return next(each for each, value in values if value is not None and value.text == name)

    def after(self, edits: tuple[Edit, ...]) -> str | None:
        """None where there is no edit."""
        assert refusal(edits, {self.document.path: self.text}.get) is None
        return applied(self.text, edits) if edits else None

    def changed(self, edits: tuple[Edit, ...]) -> list[str]:
        """The lines that are new or other ones."""
        old = self.text.splitlines()
        return [line for line in (self.after(edits) or "").splitlines() if line not in old]


def _python(*items: str) -> _Text:
    return _Text("/a.launch.py", _PYTHON.format("\n        ".join(items)))


@pytest.mark.parametrize(
    ("path", "text", "expected"),
    [
        ("/a.launch.xml", "<launch>\n  <group/>\n</launch>\n", ['  <arg name="rate"/>']),
        ("/a.launch.xml", "<launch/>\n", ["<launch>", '  <arg name="rate"/>', "</launch>"]),
        ("/a.launch.yaml", "launch:\n  - group: []\n", ["  - arg:", "      name: rate"]),
        ("/a.launch.yaml", "launch:\n- node:\n   pkg: p\n   exec: e\n", ["- arg:", "   name: rate"]),
        ("/a.launch.yaml", "launch: [{group: []}]\n", []),
        ("/a.launch.xml", "<launch>\n", []),
    ],
)
def test_declare_an_argument(path: str, text: str, expected: list[str]) -> None:
    file = _Text(path, text)
    assert file.root is not None
    assert file.changed(file.writer.declare_argument(file.root, "rate")) == expected


@pytest.mark.parametrize(
    ("imports", "body", "expected"),
    [
        (
            "from launch.actions import DeclareLaunchArgument as Arg",
            "return LaunchDescription([\n        Node(),\n    ])",
            ["        Arg('rate'),"],
        ),
        (
            "from launch.actions import (\n    DeclareLaunchArgument,\n)",
            "return LaunchDescription([Node()])",
            ["    return LaunchDescription([DeclareLaunchArgument('rate'), Node()])"],
        ),
        (
            "from launch.actions import (\n    ExecuteProcess,\n    GroupAction,\n)",
            "return LaunchDescription([])",
            [
                "    DeclareLaunchArgument, ExecuteProcess,",
                "    return LaunchDescription([DeclareLaunchArgument('rate')])",
            ],
        ),
        (
            "import launch.actions",
            "ld = LaunchDescription()\n    ld.add_action(Node())\n    return ld",
            ["    ld.add_action(launch.actions.DeclareLaunchArgument('rate'))"],
        ),
        (
            "",
            "items = [\n        # the node\n        Node(),\n    ]\n    return LaunchDescription(items)",
            ["from launch.actions import DeclareLaunchArgument", "        DeclareLaunchArgument('rate'),"],
        ),
        ("", "return LaunchDescription([*a, *b])", ["from launch.actions import DeclareLaunchArgument"]),
        ("", "return LaunchDescription(make())", []),
        ("", "x = LaunchDescription([])\n    return LaunchDescription([x])", []),
    ],
)
def test_declare_an_argument_in_python(imports: str, body: str, expected: list[str]) -> None:
    text = "from launch import LaunchDescription\n" + imports + "\nfrom launch_ros.actions import Node\n\n\n"
    file = _Text("/a.launch.py", f"{text}def generate_launch_description():\n    {body}\n")
    assert file.root is not None
    changed = file.changed(file.writer.declare_argument(file.root, "rate"))
    assert changed[: len(expected)] == expected
    assert bool(changed) == bool(expected)


_INCLUDE = "IncludeLaunchDescription(source, launch_arguments={}),"


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("{'a': '1'}.items()", None),
        ("{'a': '1', 'b': '2'}.items()", "{'b': '2'}.items()"),
        ("{'b': '2', 'a': '1'}.items()", "{'b': '2'}.items()"),
        ("{'b': '2', 'a': '1',}.items()", "{'b': '2',}.items()"),
        ("[('a', '1'), ('b', '2')]", "[('b', '2')]"),
        ("[('b', '2'), ('a', '1')]", "[('b', '2')]"),
        ("[('a', '1')]", None),
        ("{\n            'a': '1',  # one\n            'b': '2',\n        }.items()", ...),
    ],
)
def test_do_not_pass_an_argument_in_python(before: str, after: object) -> None:
    file = _python(_INCLUDE.format(before))
    result = file.after(file.writer.remove(file.named("a"))) or ""
    if after is None:
        assert "IncludeLaunchDescription(source)," in result
    elif after is ...:
        assert "launch_arguments={\n" in result and "'b': '2',\n        }.items()" in result and "'a'" not in result
    else:
        assert _INCLUDE.format(after) in result


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("- include:\n    file: f\n    arg:\n    - name: a\n      value: '1'\n", "- include:\n    file: f\n"),
        (
            "- include:\n    file: f\n    arg:\n    - name: a\n      value: '1'\n"
            "    - name: b\n      value: '2'  # two\n",
            "- include:\n    file: f\n    arg:\n    - name: b\n      value: '2'  # two\n",
        ),
        (
            "- include:\n    file: f\n    arg:\n      -\n        name: a\n        value: '1'\n    if: 'true'\n",
            "- include:\n    file: f\n    if: 'true'\n",
        ),
        (
            "- include: {file: f, arg: [{name: a, value: '1'}, {name: b, value: '2'}]}\n",
            "- include: {file: f, arg: [{name: b, value: '2'}]}\n",
        ),
        ("- include: {file: f, arg: [{name: a, value: '1'}]}\n", "- include: {file: f}\n"),
    ],
)
def test_do_not_pass_an_argument_in_yaml(before: str, after: str) -> None:
    file = _Text("/a.launch.yaml", "launch:\n" + before)
    assert file.after(file.writer.remove(file.named("a"))) == "launch:\n" + after


@pytest.mark.parametrize(
    ("path", "text", "expected"),
    [
        (
            "/a.launch.xml",
            '<launch>\n  <node pkg="p" exec="e"/>\n</launch>\n',
            ['  <node pkg="p" exec="e">', '    <remap from="a" to="b&amp;"/>', "  </node>"],
        ),
        (
            "/a.launch.yaml",
            "launch:\n  - node:\n      pkg: p\n      exec: e\n  - group: []\n",
            ["      remap:", "        - from: a", "          to: b&"],
        ),
        (
            "/a.launch.yaml",
            "launch:\n- node:\n    remap:\n    - from: x\n      to: y\n    pkg: p\n    exec: e",
            ["    - from: a", "      to: b&"],
        ),
        (
            "/a.launch.yaml",
            "launch:\n- node: {pkg: p, exec: e}\n",
            ["- node: {pkg: p, exec: e, remap: [{from: a, to: b&}]}"],
        ),
    ],
)
def test_a_remap_of_a_node(path: str, text: str, expected: list[str]) -> None:
    file = _Text(path, text)
    assert file.changed(file.writer.add_remap(file.first("node"), "a", "b&")) == expected


@pytest.mark.parametrize(
    ("item", "expected"),
    [
        ("Node(package='p'),", ["        Node(package='p', remappings=[('a', 'b')]),"]),
        ("Node(package='p', remappings=[]),", ["        Node(package='p', remappings=[('a', 'b')]),"]),
        (
            "Node(package='p', remappings=[('x', 'y')]),",
            ["        Node(package='p', remappings=[('x', 'y'), ('a', 'b')]),"],
        ),
        (
            "Node(\n            package='p',\n"
            "            remappings=[\n                ('x', 'y'),\n            ],\n        ),",
            ["                ('a', 'b'),"],
        ),
        (
            "Node(\n            package='p'  # the package\n        ),",
            ["            package='p',", "            remappings=[('a', 'b')]  # the package"],
        ),
        ("Node(package='p', remappings=made()),", []),
    ],
)
def test_a_remap_of_a_node_in_python(item: str, expected: list[str]) -> None:
    file = _python(item)
    assert file.changed(file.writer.add_remap(file.first("node"), "a", "b")) == expected


@pytest.mark.parametrize(
    ("path", "text", "old", "new", "expected"),
    [
        (
            "/a.launch.xml",
            '<launch><log message="one"/></launch>',
            "one",
            'a<"b"&',
            '<launch><log message="a&lt;&quot;b&quot;&amp;"/></launch>',
        ),
        (
            "/a.launch.xml",
            "<launch><log message='one'/></launch>",
            "one",
            "it's",
            "<launch><log message='it&apos;s'/></launch>",
        ),
        ("/a.launch.yaml", "launch:\n- log: {message: one}\n", "one", "true", "launch:\n- log: {message: 'true'}\n"),
        ("/a.launch.yaml", "launch:\n- log: {message: one}\n", "one", "a, b", "launch:\n- log: {message: 'a, b'}\n"),
        ("/a.launch.yaml", "launch:\n- log: {message: 'one'}\n", "one", "it's", "launch:\n- log: {message: 'it''s'}\n"),
        ("/a.launch.yaml", 'launch:\n- log: {message: "one"}\n', "one", 'a"b', 'launch:\n- log: {message: "a\\"b"}\n'),
        ("/a.launch.py", "x = 'one'\n", "one", "it's", "x = 'it\\'s'\n"),
        ("/a.launch.py", 'x = r"one"\n', "one", 'a"b', None),
        ("/a.launch.py", "x = 'on' 'one'\n", "one", "two", None),
        ("/a.launch.py", "x = f'{y}one'\n", "one", "two", None),
        ("/a.launch.py", "one = 1\n", "one", "two", None),
        ("/a.launch.py", "x = 1  # preflight: ignore[one]\n", "one", "two", "x = 1  # preflight: ignore[two]\n"),
    ],
)
def test_a_text_is_replaced_with_its_quoting(path: str, text: str, old: str, new: str, expected: str | None) -> None:
    file = _Text(path, text)
    assert file.after(replaced(file.document, Span(0, len(text)), old, new)) == expected


def test_the_text_that_a_name_stands_for_is_replaced() -> None:
    file = _python("Node(package=package, executable=other),")
    text = file.text.replace("    return", "    package = 'demo'\n    other = 'demo'\n    return")
    file = _Text("/a.launch.py", text)
    start = file.text.index("=package") + 1
    result = file.after(replaced(file.document, Span(start, start + len("package")), "demo", "demos")) or ""
    assert "package = 'demos'\n    other = 'demo'\n" in result


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a:\n  x: 1\n  y: [1, 2]\n", "a:\n  ros__parameters:\n    x: 1\n    y: [1, 2]\n"),
        ("a:\n  # of x\n  x: 1\n\n  y:\n    z: 2\nb:\n  c: 1\n", None),
        ("a: {x: 1}\n", None),
        ("x: 1\n", None),
        ("a:\n  x: |\n    one\n    two\n", None),
    ],
)
def test_values_are_put_below_another_key(text: str, expected: str | None) -> None:
    file = _Text("/a.yaml", text)
    writer = file.writer
    assert isinstance(writer, YamlWriter)
    at = text.index("x:")
    result = file.after(writer.nest(Span(at, at + 1), "ros__parameters"))
    if expected is None and "# of x" in text:
        assert result is not None and "\n  ros__parameters:\n    x: 1\n\n    y:\n      z: 2\nb:\n  c: 1\n" in result
    else:
        assert result == expected


@pytest.mark.parametrize(
    ("body", "removed"),
    [
        ("return LaunchDescription([\n        DeclareLaunchArgument('a'),\n        Node(),\n    ])", 1),
        ("a = DeclareLaunchArgument('a')\n    return LaunchDescription([a, Node()])", 1),
        ("ld = LaunchDescription()\n    ld.add_action(DeclareLaunchArgument('a'))\n    return ld", 1),
        ("ld = LaunchDescription()\n    a = DeclareLaunchArgument('a')\n    ld.add_action(a)\n    return ld", 2),
        ("a = DeclareLaunchArgument('a')\n    return LaunchDescription([*use(a), Node()])", 0),
        ("return LaunchDescription([first] + [DeclareLaunchArgument('a')])", 0),
    ],
)
def test_a_declaration_is_removed_from_python(body: str, removed: int) -> None:
    text = f"from launch import *\n\n\ndef generate_launch_description():\n    {body}\n"
    file = _Text("/a.launch.py", text)
    result = file.after(file.writer.remove(file.named("a")))
    assert (result is not None) == bool(removed) or "[first]" in body
    if result is not None:
        assert "DeclareLaunchArgument('a')" not in result
        assert text.count("\n") - result.count("\n") == removed or "[first]" in body
