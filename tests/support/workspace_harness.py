"""A workspace on the disk for the queries that look across files, written as one text.

    create_workspace(tmp_path, '''
        <launch><arg name="x"/></launch>
        //- inc.launch
        <launch><arg name="$0x"/></launch>
    ''')

`//- path` starts another file, the first one is `main.launch`; `{folder}` stands for the workspace's folder and `$0`
is the cursor. There is a package `p` in the folder, whose executables are the files of `p/scripts`. Interfaces as in
`support.check`.
"""

from __future__ import annotations

import json
import re
import textwrap
from dataclasses import dataclass
from pathlib import Path

from preflight_analysis.documents.span import Location
from preflight_analysis.edits.edit import Edit
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.tracing.commands import CommandCache, CommandRunner
from preflight_analysis.tracing.interface import NOT_RUN
from preflight_analysis.workspace.commands import CommandResults
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.indexing import build_index
from preflight_analysis.workspace.resolve_commands import Resolving, resolve_commands
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

from support.check import interface_from_json

_FILE = re.compile(r"//- (\S+)\s*\Z")


@dataclass(frozen=True)
class TestWorkspace:
    """Files on the disk, the cursor in it, and how to speak of what is in it."""

    __test__ = False  # pytest: no class of tests

    folder: Path
    context: QueryContext
    offset: int

    def shown(self, location: Location) -> str:
        """`inc.launch:3 what is written there`."""
        document = self.context.document(location.file)
        line = document.lines.position(location.span.start)[0] + 1 if document else 1
        path = Path(location.file)
        name = path.relative_to(self.folder) if path.is_relative_to(self.folder) else path
        return f"{name}:{line} {self.context.text(location)}".strip()

    def edited(self, edits: tuple[Edit, ...]) -> dict[str, str]:
        """The texts of the files that the edits change, after them."""
        texts: dict[str, str] = {}
        for edit in sorted(edits, key=lambda e: e.location.span, reverse=True):
            path = edit.location.file
            text = texts.get(path) or Path(path).read_text()
            texts[path] = text[: edit.location.span.start] + edit.text + text[edit.location.span.end :]
        return {str(Path(path).relative_to(self.folder)): text for path, text in texts.items()}


def create_workspace(
    folder: Path,
    text: str,
    *,
    named: tuple[Root, ...] = (),
    analysed: int = 8,
    build_type: str | None = None,
    runs: bool = False,
    root: str = "",
) -> TestWorkspace:
    """Write the files and analyse what the cursor's file needs, or `root` where that is a file which is handed over.
    `build_type` is that of the package `p`, of ROS 2 where it is an ament one; `runs`: commands and Python launch files
    are run."""
    cursor: tuple[str, int] | None = None
    files: dict[str, str] = {}
    name = "main.launch"
    for line in textwrap.dedent(text).strip("\n").split("\n"):
        if start := _FILE.match(line):
            name = start[1]
        else:
            files[name] = files.get(name, "") + line.replace("{folder}", str(folder)) + "\n"
    interfaces = json.loads(files.pop("interfaces", "{}"))
    for name, content in files.items():
        if "$0" in content:
            cursor = name, content.index("$0")
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content.replace("$0", ""))
        path.chmod(0o755 if "/scripts/" in name else 0o644)
    assert cursor is not None, "no cursor"
    package = Package("p", str(folder / "p"), str(folder / "p/package.xml"), build_type=build_type)
    generation, distro = (1, "noetic") if package.generation == 1 else (2, "jazzy")
    environment = Environment(
        generation, distro, {}, (str(folder),), {"p": package}, {}, (), (), "/usr/bin/python3", workspace=str(folder)
    )
    results = CommandResults(lambda: None if runs else "not run")
    workspace = Workspace(environment, Sources(), str(folder), results)
    index = build_index(workspace, str(folder), named)
    assert index is not None
    path = str(folder / cursor[0])
    analyses = []
    roots = (Root(str(folder / root)),) if root else index.roots_reading(path) or index.roots_of(path)
    for each in roots[:analysed]:
        if runs:
            runner = CommandRunner(environment, str(folder), CommandCache(folder / ".cache"))
            resolve_commands(workspace, each.path, dict(each.args), Resolving(results, runner))
        analysis = workspace.static(each.path, dict(each.args))
        if interfaces:
            given = [interface_from_json(i) if (i := interfaces.get(n.name)) else NOT_RUN for n in analysis.tree.nodes]
            analysis = workspace.with_interfaces(analysis, given, None)
        analyses.append(analysis)
    return TestWorkspace(folder, QueryContext(path, tuple(analyses), index, workspace), cursor[1])
