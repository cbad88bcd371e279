"""Launch files that would take for ever, or all of the stack."""

from pathlib import Path

from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.evaluation.problems import IncludeCycle, NestedTooDeeply, ValueTooLong
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace


def tree_of(folder: Path, files: dict[str, str]) -> LaunchTree:
    for name, text in files.items():
        (folder / name).write_text(text)
    environment = detect_environment(None, {}, [str(folder)])
    return Workspace(environment, Sources(), str(folder)).static(str(folder / "root.launch")).tree


def nested(levels: int, inside: str) -> str:
    return f"<launch>{'<group>' * levels}{inside}{'</group>' * levels}</launch>"


def test_groups_and_includes_nested_too_deeply(tmp_path: Path) -> None:
    files = {f"f{n}.launch": nested(60, f'<include file="$(dirname)/f{n + 1}.launch"/>') for n in range(10)}
    tree = tree_of(tmp_path, {"root.launch": '<launch><include file="$(dirname)/f0.launch"/></launch>', **files})
    assert [type(p.kind) for p in tree.problems] == [NestedTooDeeply]
    assert tree.unknowns


def test_reasonable_nesting_is_fine(tmp_path: Path) -> None:
    tree = tree_of(tmp_path, {"root.launch": nested(60, '<param name="a" value="1"/>')})
    assert (list(tree.problems), list(tree.params)) == ([], ["/a"])


def test_an_include_that_multiplies_itself(tmp_path: Path) -> None:
    twice = '<include file="$(dirname)/root.launch"><arg name="n" value="$(arg n)x"/></include>' * 2
    tree = tree_of(tmp_path, {"root.launch": f'<launch><arg name="n" default=""/>{twice}</launch>'})
    assert [type(p.kind) for p in tree.problems] == [NestedTooDeeply]


def test_a_file_that_includes_itself_until_it_has_counted_down(tmp_path: Path) -> None:
    text = """<launch>
      <arg name="n" default="20"/>
      <param name="p$(arg n)" value="1"/>
      <include file="$(dirname)/root.launch" if="$(eval n > 0)"><arg name="n" value="$(eval n - 1)"/></include>
    </launch>"""
    tree = tree_of(tmp_path, {"root.launch": text})
    assert not tree.problems
    assert len(tree.params) == 21


def test_a_circle_ends_at_its_first_turn(tmp_path: Path) -> None:
    tree = tree_of(
        tmp_path,
        {
            "root.launch": '<launch><include file="$(dirname)/a.launch"/></launch>',
            "a.launch": '<launch><include file="$(dirname)/root.launch"/></launch>',
        },
    )
    assert [type(p.kind) for p in tree.problems] == [IncludeCycle]
    assert len(tree.includes) <= 3


def doubling(first: str, line: str) -> str:
    return f"<launch>{first}{''.join(line.format(n=n, before=n - 1) for n in range(1, 60))}</launch>"


def test_values_that_hold_others_twice(tmp_path: Path) -> None:
    files = {
        "root.launch": doubling(
            '<arg name="a0" value="xx"/>', '<arg name="a{n}" value="$(arg a{before})$(arg a{before})"/>'
        ),
        "mixed.launch": doubling(
            '<arg name="a0" value="xx"/>', '<arg name="a{n}" value="$(arg a{before}) $(arg a{before})"/>'
        ),
        "root.launch.xml": doubling('<let name="a" value="xx"/>', '<let name="a" value="$(var a)$(var a)"/>'),
    }
    environment = detect_environment(None, {}, [str(tmp_path)])
    for name, text in files.items():
        (tmp_path / name).write_text(text)
        analysis = Workspace(environment, Sources(), str(tmp_path)).static(str(tmp_path / name))
        assert {type(p.kind) for p in analysis.tree.problems} == {ValueTooLong}
        assert {f.rule for f in analysis.findings} >= {"LCH018"}
