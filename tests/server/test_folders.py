"""Several workspace folders: each has its own packages, generation of ROS and index."""

from __future__ import annotations

from pathlib import Path

from lsprotocol import types
from support.editor_harness import Harness
from support.lsp_client import editing

_ROS2 = "<export><build_type>ament_cmake</build_type></export>"


def _package(folder: Path, name: str, launch: str, export: str = "") -> Path:
    """A package of `folder` with `a.launch.xml` or, for ROS 1, `a.launch`, and a script `run`."""
    package = folder / name
    (package / "launch").mkdir(parents=True)
    (package / "scripts").mkdir()
    script = package / "scripts/run"
    script.write_text("#!/usr/bin/env python3\n")
    script.chmod(0o755)
    (package / "package.xml").write_text(f"<package format='3'><name>{name}</name>{export}</package>\n")
    file = package / "launch" / ("a.launch.xml" if export else "a.launch")
    file.write_text(launch)
    return file


def _node(package: str) -> str:
    return f'<launch>\n  <node pkg="{package}" type="run" name="{package}_node"/>\n</launch>\n'


async def test_each_folder_has_its_own_packages(harness: Harness) -> None:
    """A package of the other folder is unknown, as it would be to roslaunch there."""
    one, two = harness.home / "one", harness.home / "two"
    first = _package(one, "apple", _node("apple"))
    second = _package(two, "pear", _node("pear"))
    async with editing(harness, folders=[one, two]) as editor:
        for file in (first, second):
            editor.open(file)
        for file in (first, second):
            await editor.until(lambda file=file: editor.rules(file) is not None)
        assert "PKG001" not in (editor.rules(first) or ())
        assert "PKG001" not in (editor.rules(second) or ())
        editor.change(second, _node("apple"))
        await editor.having(second, "PKG001")
        assert "PKG001" not in (editor.rules(first) or ())


async def test_folders_of_both_generations_stand_side_by_side(harness: Harness) -> None:
    one, two = harness.home / "one", harness.home / "two"
    old = _package(one, "apple", '<launch>\n  <include file="$(find apple)/launch/b.launch"/>\n</launch>\n')
    (old.parent / "b.launch").write_text("<launch/>\n")
    text = '<launch>\n  <include file="$(find-pkg-share pear)/launch/b.launch.xml"/>\n</launch>\n'
    new = _package(two, "pear", text, _ROS2)
    (new.parent / "b.launch.xml").write_text("<launch/>\n")
    async with editing(harness, folders=[one, two]) as editor:
        for file in (old, new):
            editor.open(file)
            await editor.until(lambda file=file: editor.rules(file) == [])
        text = await editor.doctor()
        assert str(one) in text
        assert "ROS 1" in text
        assert str(two) in text
        assert "ROS 2" in text


async def test_a_nested_folder_is_a_workspace_of_its_own(harness: Harness) -> None:
    """The innermost folder that holds a file counts, in whatever order the client names them."""
    outer = harness.home / "outer"
    inner = outer / "src/inner"
    outside = _package(outer / "src", "apple", _node("apple"))
    inside = _package(inner / "src", "pear", _node("apple"))
    async with editing(harness, folders=[outer, inner]) as editor:
        for file in (outside, inside):
            editor.open(file)
        await editor.having(inside, "PKG001")
        await editor.until(lambda: editor.rules(outside) is not None)
        assert "PKG001" not in (editor.rules(outside) or ())


async def test_folders_come_and_go(harness: Harness) -> None:
    one, two = harness.home / "one", harness.home / "two"
    first = _package(one, "apple", _node("apple"))
    second = _package(two, "pear", _node("pear"))
    async with editing(harness, folders=[one]) as editor:
        for file in (first, second):
            editor.open(file)
        await editor.having(second, "PKG001")
        editor.folders_changed(added=[two])
        await editor.without(second, "PKG001")
        editor.folders_changed(removed=[two])
        await editor.having(second, "PKG001")
        editor.folders_changed(removed=[one], added=[two])
        await editor.without(second, "PKG001")
        await editor.having(first, "PKG001")


async def test_symbols_and_roots_are_those_of_all_folders(harness: Harness) -> None:
    one, two = harness.home / "one", harness.home / "two"
    first = _package(one, "apple", _node("apple"))
    second = _package(two, "pear", '<launch>\n  <include file="$(dirname)/b.launch"/>\n</launch>\n')
    included = second.parent / "b.launch"
    included.write_text(_node("pear"))
    async with editing(harness, folders=[one, two]) as editor:
        editor.open(first)
        editor.open(included)

        async def names() -> set[str]:
            found = await editor.client.workspace_symbol_async(types.WorkspaceSymbolParams("_node"))
            return {symbol.name for symbol in found or ()}

        await editor.once(names, lambda found: {"/apple_node", "/pear_node"} <= found)

        async def titles() -> list[str]:
            return [lens.command.title for lens in await editor.lenses(included) if lens.command]

        await editor.once(titles, lambda shown: shown[:1] == ["included by 1 file"])
        answer = await editor.client.protocol.send_request_async("rosPreflight/roots", {"uri": included.as_uri()})
        assert [root.uri for root in answer.roots] == [included.as_uri(), second.as_uri()]
        assert await editor.definition(included, editor.at(included, "pear"))


async def test_an_open_text_counts_in_each_folder_that_reads_it(harness: Harness) -> None:
    """A launch file of the first folder includes one of the second, which is open and not saved."""
    one, two = harness.home / "one", harness.home / "two"
    second = _package(two, "pear", '<launch><arg name="x" default="1"/><param name="x" value="$(arg x)"/></launch>\n')
    given = f'<launch>\n  <include file="{second}"><arg name="x" value="2"/></include>\n</launch>\n'
    first = _package(one, "apple", given)
    async with editing(harness, folders=[one, two]) as editor:
        editor.open(first)
        editor.open(second)
        await editor.until(lambda: editor.rules(first) == [])
        editor.change(second, '<launch><arg name="y" default="1"/><param name="y" value="$(arg y)"/></launch>\n')
        await editor.having(first, "ARG004")


async def test_a_folder_has_its_own_settings(harness: Harness) -> None:
    """The client is asked for the settings of each folder."""
    one, two, elsewhere = harness.home / "one", harness.home / "two", harness.home / "elsewhere"
    first = _package(one, "apple", _node("plum"))
    second = _package(two, "pear", _node("plum"))
    _package(elsewhere, "plum", _node("plum"))
    async with editing(harness, folders=[one, two]) as editor:
        for file in (first, second):
            editor.open(file)
            await editor.having(file, "PKG001")
        editor.client.set_configuration({"rosPreflight": {"packagePath": [str(elsewhere)]}}, scope_uri=two.as_uri())
        editor.client.workspace_did_change_configuration(types.DidChangeConfigurationParams(None))
        await editor.without(second, "PKG001")
        assert "PKG001" in (editor.rules(first) or ())


async def test_a_folder_has_the_environment_that_the_client_sourced_for_it(harness: Harness) -> None:
    one, two, elsewhere = harness.home / "one", harness.home / "two", harness.home / "elsewhere"
    first = _package(one, "apple", _node("plum"))
    second = _package(two, "pear", _node("plum"))
    _package(elsewhere, "plum", _node("plum"))
    sourced = {two.as_uri(): {**harness.environment, "ROS_PACKAGE_PATH": str(elsewhere)}}
    async with editing(harness, folders=[one, two], settings={"environments": sourced}) as editor:
        for file in (first, second):
            editor.open(file)
        await editor.having(first, "PKG001")
        await editor.until(lambda: editor.rules(second) is not None)
        assert "PKG001" not in (editor.rules(second) or ())
