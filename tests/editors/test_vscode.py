"""The packaged extension in the VS Code workbench of code-server, driven through Chromium."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
from editor_desk import ROOT, Desk

pytestmark = [pytest.mark.editor, pytest.mark.vscode]

HERE = Path(__file__).with_name("vscode")
VSIX = ROOT / "out/ros-preflight.vsix"
SCREENSHOTS = ROOT / "out/screenshots"


def drive(desk: Desk, scenario: str) -> dict[str, Any]:
    if not (HERE / "node_modules/.installed").exists():
        pytest.fail("code-server is missing: run tests/editors/install.sh")
    if not VSIX.exists():
        pytest.fail(f"{VSIX} is missing: run make vsix")
    chromium = shutil.which("chromium")
    if chromium is None:
        pytest.fail("chromium is missing: apt-get install chromium")
    log = desk.home / "code-server.log"
    given = {
        "home": str(desk.home),
        "workspace": str(desk.workspace),
        "launchFile": str(desk.launch_file),
        "sandboxRecord": str(desk.sandbox_record),
        "vsix": str(VSIX),
        "screenshots": str(SCREENSHOTS),
        "chromium": chromium,
        "log": str(log),
        "server": str(desk.server),
    }
    done = subprocess.run(
        ["node", str(HERE / "drive.mjs"), scenario, json.dumps(given)],
        env=desk.environment,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=400,
        check=False,
    )
    logs = "".join(f"\n--- {p}\n{p.read_text()}" for p in sorted(desk.home.glob("data/logs/**/*ROS Preflight.log")))
    assert done.returncode == 0, f"{done.stderr}{done.stdout}{logs}"
    seen: dict[str, Any] = json.loads(done.stdout)
    print(json.dumps(seen["seconds"]))
    return seen


def test_finding_is_seen_and_fixed(trusted_desk: Desk) -> None:
    original = trusted_desk.launch_file.read_text()

    seen = drive(trusted_desk, "fix")

    assert "/chatter" in seen["hoverOnTopic"]
    assert "std_msgs/String" in seen["hoverOnNode"]
    assert "chatter" in seen["quickFix"]
    assert seen["fixed"] == original.replace('to="chater"', 'to="chatter"')
    assert trusted_desk.sandbox_starts() > 0


def test_untrusted_workspace_says_why_and_trust_needs_no_restart(untrusted_desk: Desk) -> None:
    seen = drive(untrusted_desk, "untrusted")

    assert any("not trusted" in problem for problem in seen["problems"])
    assert seen["squiggles"] == 0
    assert seen["sandboxStarts"] == 0
    assert seen["sameServer"]
    assert untrusted_desk.sandbox_starts() > 0


def test_server_is_asked_for_and_started_again_when_it_dies(desk_without_server: Desk) -> None:
    seen = drive(desk_without_server, "restarts")

    assert "No matching distribution found" in seen["missing"]
    assert {"Show Log", "Choose Python", "Set Path"} <= set(seen["buttons"])
    assert seen["told"] == 1
