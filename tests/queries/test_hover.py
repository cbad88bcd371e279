"""Hover in a file that several roots reach: what is the same in all is said once, what is not for each."""

from __future__ import annotations

from pathlib import Path

from markdown_it import MarkdownIt
from preflight_analysis.queries.hover import hover
from preflight_analysis.workspace.index import Root
from support.workspace_harness import create_workspace

INCLUDES = """
    //- robots/fast.launch
    <launch><include ns="f" file="{folder}/main.launch"><arg name="rate" value="50"/></include></launch>
    //- robots/slow.launch
    <launch>
      <arg name="rate" default="2"/>
      <include ns="s" file="{folder}/main.launch"><arg name="rate" value="$(arg rate)"/></include>
    </launch>
    """


def hovered(tmp_path: Path, text: str, *, named: tuple[Root, ...] = (), unseen: int = 0) -> list[str]:
    """The lines of the hover at the cursor, without the empty ones."""
    workspace = create_workspace(tmp_path, text, named=named)
    found = hover(workspace.context.analyses, workspace.context.path, workspace.offset, unseen)
    return [line for line in found.markdown.split("\n") if line] if found else []


def test_values_of_each_root(tmp_path: Path) -> None:
    text = '    <launch><arg name="rate"/><param name="a" value="$(arg $0rate)"/></launch>' + INCLUDES
    root = Root.of(str(tmp_path / "robots/slow.launch"), {"rate": "3"})
    lines = hovered(tmp_path, text, named=(root,))
    assert lines[0] == "argument `rate` = `50`"
    assert lines[2:] == [
        "By launch:",
        "- `50` in `robots/fast.launch`",
        "- `3` in `robots/slow.launch rate:=3`",
    ]


def test_what_is_the_same_everywhere_is_said_once(tmp_path: Path) -> None:
    text = '    <launch><arg name="rate"/><arg name="x" default="1"/><param name="a" value="$(arg $0x)"/></launch>'
    text += INCLUDES
    lines = hovered(tmp_path, text)
    assert lines[0] == "argument `x` = `1`"
    assert "By launch:" not in lines


def test_several_contexts_in_one_root(tmp_path: Path) -> None:
    lines = hovered(
        tmp_path,
        """
        <launch><arg name="rate"/><param name="a" value="$(arg $0rate)"/></launch>
        //- twice.launch
        <launch>
          <include ns="a" file="{folder}/main.launch"><arg name="rate" value="1"/></include>
          <include ns="b" file="{folder}/main.launch"><arg name="rate" value="2"/></include>
        </launch>
        """,
    )
    assert lines[-2:] == ["By launch:", "- `1`, `2` in `twice.launch`"]


def test_nodes_parameters_and_remaps(tmp_path: Path) -> None:
    tags = """
        <launch>
          <arg name="rate"/>
          <node%s pkg="p" type="t" name="n"/>
          <param%s name="a" value="$(arg rate)"/>
          <rosparam%s>{b: 1, c: 2}</rosparam>
          <include%s file="$(dirname)/$(arg rate).xml"/>
        </launch>
        """
    expected = [
        ["- `/f/n` in `robots/fast.launch`", "- `/s/n` in `robots/slow.launch`"],
        ["- `/f/a` = `50` in `robots/fast.launch`", "- `/s/a` = `2` in `robots/slow.launch`"],
        [
            "- `/f/b` = `1`, `/f/c` = `2` in `robots/fast.launch`",
            "- `/s/b` = `1`, `/s/c` = `2` in `robots/slow.launch`",
        ],
        ["- `{folder}/50.xml` in `robots/fast.launch`", "- `{folder}/2.xml` in `robots/slow.launch`"],
    ]
    for number, wanted in enumerate(expected):
        folder = tmp_path / str(number)
        lines = hovered(folder, tags % tuple("$0" if n == number else "" for n in range(4)) + INCLUDES)
        start = lines.index("By launch:") + 1
        assert lines[start : start + 2] == [line.replace("{folder}", str(folder)) for line in wanted]


def test_a_tag_that_only_one_root_takes(tmp_path: Path) -> None:
    text = '    <launch><arg name="rate"/><node$0 pkg="p" type="t" name="n" if="$(eval rate > 9)"/></launch>' + INCLUDES
    lines = hovered(tmp_path, text)
    assert lines[0].startswith("**/f/n**")
    assert "By launch:" not in lines


def test_many_roots(tmp_path: Path) -> None:
    roots = "".join(
        f"""
    //- r{n}.launch
    <launch><include file="{{folder}}/main.launch"><arg name="rate" value="{n % 2}"/></include></launch>"""
        for n in range(12)
    )
    text = '    <launch><arg name="rate"/><param name="a" value="$(arg $0rate)"/></launch>' + roots
    workspace = create_workspace(tmp_path, text, analysed=12)
    found = hover(workspace.context.analyses, workspace.context.path, workspace.offset, 3)
    assert found is not None
    lines = found.markdown.split("\n")
    assert len([word for line in lines for word in line.split() if word.startswith("`r")]) == 8 + 1
    assert lines[-1] == "- … and 7 more"


def test_a_prefix_that_a_run_left_out_is_said(tmp_path: Path) -> None:
    text = """
        <launch><node$0 pkg="p" type="t" name="n" launch-prefix="gdb --args"/></launch>
        //- interfaces
        {"/n": {"publishers": {"a": "std_msgs/String"}}}
    """
    without = "Run without its `launch-prefix` `gdb --args`"
    assert without in hovered(tmp_path, text)
    assert without not in hovered(tmp_path / "not_run", text.partition("//- interfaces")[0])
    assert not [line for line in hovered(tmp_path / "none", text.replace("launch-prefix", "args")) if "prefix" in line]


def test_a_file_that_does_not_parse(tmp_path: Path) -> None:
    text = '    <launch><arg name="rate"/><param name="a" value="$(arg $0rate)"<node' + INCLUDES
    assert "By launch:" in hovered(tmp_path, text)


def test_a_picture_in_a_value_is_not_loaded(tmp_path: Path) -> None:
    """Nor in a name: what a launch file says is shown, in an untrusted workspace too."""
    picture = "`![x](https://evil.example/x.png)`<img src='https://evil.example/y.png'>".replace("<", "&lt;")
    reader = MarkdownIt("gfm-like", {"html": True, "linkify": False})
    for text in (
        f'<launch><arg name="a" default="{picture}" doc="{picture}"/><param name="p" value="$(arg $0a)"/></launch>',
        f'<launch><arg name="{picture}" default="1"/><param $0name="{picture}" value="{picture}"/></launch>',
        f'<launch><node $0pkg="{picture}" type="{picture}" name="n"/></launch>',
        f'<launch><include $0file="{picture}.launch"><arg name="{picture}" value="{picture}"/></include></launch>',
        f'<launch><param name="p" $0command="{picture}"/></launch>',
    ):
        shown = reader.render("\n".join(hovered(tmp_path, "    " + text)))
        assert "evil.example" in shown
        assert "<img" not in shown
