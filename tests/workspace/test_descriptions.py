"""Files of robot descriptions that no launch reaches are checked with the launches of their package."""

from __future__ import annotations

from pathlib import Path

from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.descriptions import xacro
from support.packaging import CMAKE, LAUNCH, lay_out

FIN = '<xacro:macro name="fin" params="min_limit">\n<limit lower="${min_limi}"/></xacro:macro>'
PATH = "launch/arm.launch.xml"


def found(workspace: Workspace, launch: str) -> list[Finding]:
    findings = (finding for finding, _ in workspace.branches(workspace.static(launch)).findings)
    return [each for each in findings if each.rule.startswith("URD")]


def create(folder: Path, text: str) -> tuple[Workspace, str]:
    package = lay_out(folder, {**CMAKE, "urdf/fin.xacro": xacro(text)})
    environment = detect_environment(str(folder), {}, root=str(folder / "nothing"))
    return Workspace(environment, Sources(), str(folder)), str(package / PATH)


def test_a_file_that_no_launch_reads(tmp_path: Path) -> None:
    workspace, launch = create(tmp_path, FIN)
    (finding,) = found(workspace, launch)
    assert (finding.rule, Path(finding.location.file).name) == ("URD011", "fin.xacro")


def test_a_comment_silences_it(tmp_path: Path) -> None:
    workspace, launch = create(tmp_path, FIN.replace("\n", "\n<!-- preflight: ignore[URD011] known -->\n"))
    assert found(workspace, launch) == []


def test_an_edit_of_the_launch_file_leaves_what_was_found(tmp_path: Path) -> None:
    workspace, launch = create(tmp_path, FIN)
    before = found(workspace, launch)
    workspace.sources.open(launch, LAUNCH.replace("/>", "><!-- edited --></launch>"))
    after = found(workspace, launch)
    assert [id(each) for each in after] == [id(each) for each in before]


def test_an_edit_of_the_file_counts(tmp_path: Path) -> None:
    workspace, launch = create(tmp_path, FIN)
    (finding,) = found(workspace, launch)
    workspace.sources.open(finding.location.file, xacro(FIN.replace("min_limi}", "min_limit}")))
    assert found(workspace, launch) == []
