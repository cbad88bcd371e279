"""Python launch files of a small workspace, run in the sandbox and evaluated. What is read of them has to agree."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.commands import CommandCache, CommandRunner
from preflight_analysis.workspace.commands import CommandResults
from preflight_analysis.workspace.resolve_commands import Resolving, resolve_commands
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace

from support.readings import assert_readings_agree

MANIFEST = """<package format="3"><name>{}</name><version>0.1.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>BSD</license><export><build_type>ament_python</build_type></export>
</package>"""


@dataclass
class PythonHarness:
    """A folder with one package."""

    folder: Path
    name: str = "p"
    workspace: Workspace | None = field(default=None, init=False)
    """That of the last launch."""

    @property
    def package(self) -> Path:
        """The folder of the package."""
        return self.folder / "src" / self.name

    def write(self, name: str, text: str) -> Path:
        """A file of the package."""
        path = self.package / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(textwrap.dedent(text))
        return path

    def launch(
        self,
        path: Path,
        args: Mapping[str, str] | None = None,
        *,
        why_not: str | None = None,
        variables: Mapping[str, str] | None = None,
        sources: Sources | None = None,
        prefixes: Sequence[Path] = (),
    ) -> Analysis:
        """The analysis after all that it asks for was run; `why_not` is why nothing is, `variables` are set
        beside those of ROS (an empty one is none at all), `prefixes` are those of an underlay."""
        (self.package / "package.xml").write_text(MANIFEST.format(self.name))
        ros = {"PATH": "/usr/bin:/bin", "ROS_DISTRO": "jazzy", "ROS_VERSION": "2", "LANG": "C.UTF-8"}
        underlay = tuple(map(str, prefixes))
        given = {name: value for name, value in {**ros, **(variables or {})}.items() if value}
        environment = detect_environment(None, given, (str(self.folder / "src"),), underlay)
        results = CommandResults(lambda: why_not)
        self.workspace = workspace = Workspace(
            environment, sources or Sources(), str(self.folder), results, reads=False
        )
        if why_not is not None:
            return workspace.static(str(path), args)
        runner = CommandRunner(environment, str(self.folder), CommandCache(self.folder / "cache"))
        analysis = resolve_commands(workspace, str(path), args or {}, Resolving(results, runner))
        assert_readings_agree(analysis.tree, workspace.environment_of(str(path)), workspace.sources)
        return analysis


def line_of(analysis: Analysis, index: int = 0) -> tuple[str, int]:
    """Rule and line (counted from 1) of a finding."""
    finding = analysis.findings[index]
    document = analysis.documents[finding.location.file]
    return finding.rule, document.lines.position(finding.location.span.start)[0] + 1
