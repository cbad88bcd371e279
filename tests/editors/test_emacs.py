"""Emacs with eglot, set up word for word as docs/other_editors.md says, opens the demo's launch file."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
from support.editor_harness import ROOT, Harness

pytestmark = pytest.mark.editor

DRIVER = Path(__file__).with_name("emacs") / "drive.el"


def drive(harness: Harness, scenario: str) -> dict[str, Any]:
    emacs = shutil.which("emacs")
    assert emacs is not None, "Emacs is missing: apt-get install emacs-nox elpa-eglot"
    (block,) = re.findall(
        r"^```elisp\n(.*?)^```$", (ROOT / "docs/other_editors.md").read_text(), re.DOTALL | re.MULTILINE
    )
    init, result = harness.home / "init.el", harness.home / "result.json"
    init.write_text("(package-initialize)\n" + block)
    done = subprocess.run(
        [emacs, "--batch", "-l", init, "-l", DRIVER, "-f", "drive", "--", harness.launch_file, result, scenario],
        cwd=harness.workspace,
        env=harness.environment,
        capture_output=True,
        text=True,
        timeout=180,
        check=False,
    )
    assert result.exists(), done.stdout + done.stderr
    found: dict[str, Any] = json.loads(result.read_text())
    return found


def test_a_finding_is_shown_and_mended(trusted_harness: Harness) -> None:
    seen = drive(trusted_harness, "trusted")
    finding = next(each for each in seen["before"] if "did you mean" in each["text"])
    assert finding["underlined"] == "chater"
    assert "Replace 'chater' with 'chatter'" in seen["offered"]
    assert [each["line"] for each in seen["after"]] == [7]
    assert "to itself has no effect" in seen["after"][0]["text"]
    assert 'to="chatter"' in trusted_harness.launch_file.read_text()


def test_nothing_is_run_in_a_folder_that_is_not_trusted(untrusted_harness: Harness) -> None:
    seen = drive(untrusted_harness, "untrusted")
    assert any("not trusted" in each["text"] for each in seen["before"])
    assert untrusted_harness.sandbox_starts() == 0
