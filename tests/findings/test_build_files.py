"""Comments that silence findings in the files that say how a package is built."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.queries.suppressing import suppress_on_line
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.packaging import CFG, CMAKE, LISTS, PYTHON, SETUP, findings, lay_out

MISSPELT = SETUP.replace("arm.driver:main", "arm.drivr:main")
BROKEN = [
    pytest.param(PYTHON, "setup.py", MISSPELT, "'driver", "PKG010", id="setup.py"),
    pytest.param(PYTHON, "setup.cfg", CFG.replace("scripts=$base/lib/arm", "scripts=$base/lib/leg"), "install_scripts",
                 "PKG011", id="setup.cfg"),
    pytest.param(CMAKE, "CMakeLists.txt", LISTS.replace("DIRECTORY launch", "DIRECTORY lanch"), "install(DIRECTORY",
                 "PKG012", id="CMakeLists.txt"),
]  # fmt: skip


@pytest.mark.parametrize(("files", "name", "text", "line", "rule"), BROKEN)
def test_a_comment_above_the_line_suppresses(
    tmp_path: Path, files: dict[str, str], name: str, text: str, line: str, rule: str
) -> None:
    assert [each.rule for each in findings(tmp_path, {**files, name: text}, rule)] == [rule]
    at = text.rindex("\n", 0, text.index(line)) + 1
    silenced = text[:at] + f"# preflight: ignore[{rule}] it is generated\n" + text[at:]
    assert findings(tmp_path, {**files, name: silenced}, rule) == []
    assert findings(tmp_path, {**files, name: silenced}, "LCH019") == []


@pytest.mark.parametrize(("files", "name", "text", "line", "rule"), BROKEN)
def test_the_comment_that_an_editor_writes_suppresses(
    tmp_path: Path, files: dict[str, str], name: str, text: str, line: str, rule: str
) -> None:
    (finding,) = findings(tmp_path, {**files, name: text}, rule)
    document = Sources().text(finding.location.file)
    edit = suppress_on_line(document, finding)  # type: ignore[arg-type]
    assert edit is not None
    start = edit.location.span.start
    assert findings(tmp_path, {**files, name: text[:start] + edit.text + text[start:]}, rule) == []


@pytest.mark.parametrize(("files", "name", "text", "line", "rule"), BROKEN)
def test_an_unused_comment_is_a_finding(
    tmp_path: Path, files: dict[str, str], name: str, text: str, line: str, rule: str
) -> None:
    (found,) = findings(tmp_path, {**files, name: f"# preflight: ignore[{rule}]\n{files[name]}"}, "LCH019")
    assert found.location.file.endswith(f"/{name}")
    assert found.message == f"unused suppression of '{rule}': it has no finding here"


@pytest.mark.parametrize(("files", "name", "text", "line", "rule"), BROKEN)
def test_of_a_package_that_no_launch_has_to_do_with(
    tmp_path: Path, files: dict[str, str], name: str, text: str, line: str, rule: str
) -> None:
    at = text.rindex("\n", 0, text.index(line)) + 1
    comment = f"# preflight: ignore[{rule}] it is generated\n"
    for written, expected in (
        (text, [rule]),
        (text[:at] + comment + text[at:], []),
        (comment + files[name], ["LCH019"]),
    ):
        lay_out(tmp_path, {**files, name: written})
        environment = detect_environment(str(tmp_path), {}, root=str(tmp_path / "nothing"))
        workspace = Workspace(environment, Sources(), str(tmp_path))
        found, documents = workspace.findings_of_packages(environment.own_packages)
        assert [each.rule for each in found] == expected
        assert {each.location.file for each in found} == {*documents}


def test_the_settings_say_how_severe_it_is_there(tmp_path: Path) -> None:
    lay_out(tmp_path, {**PYTHON, "setup.py": MISSPELT})
    (tmp_path / ".ros-preflight.yaml").write_text("severities: {PKG010: off}\n")
    environment = detect_environment(str(tmp_path), {}, root=str(tmp_path / "nothing"))
    found, _ = Workspace(environment, Sources(), str(tmp_path)).findings_of_packages(environment.own_packages)
    assert found == ()


def test_in_a_manifest(tmp_path: Path) -> None:
    manifest = PYTHON["package.xml"].replace("<exec_depend>rclpy", "<exec_depend>rlcpy</exec_depend><exec_depend>rclpy")
    assert len(findings(tmp_path, {**PYTHON, "package.xml": manifest}, "PKG007")) == 1
    silenced = manifest.replace("<exec_depend>rlcpy", "<!-- preflight: ignore[PKG007] --><exec_depend>rlcpy")
    assert findings(tmp_path, {**PYTHON, "package.xml": silenced}, "PKG007") == []
