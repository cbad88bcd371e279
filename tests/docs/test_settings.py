"""The page of the settings has all of them."""

import json
from pathlib import Path

import pytest
from preflight_analysis.workspace.settings_schema import schema
from preflight_server.lsp.settings import SCHEMA

ROOT = Path(__file__).parent.parent.parent
PAGE = (ROOT / "docs" / "settings.md").read_text()


@pytest.mark.parametrize("key", schema()["properties"])
def test_a_key_of_the_settings_file(key: str) -> None:
    assert f"| `{key}` |" in PAGE


@pytest.mark.parametrize("name", SCHEMA)
def test_a_setting_of_the_server(name: str) -> None:
    assert f"| `rosPreflight.{name}` |" in PAGE


def test_a_setting_of_vscode_only() -> None:
    manifest = json.loads((ROOT / "vscode-client" / "package.json").read_text())
    page = (ROOT / "vscode-client" / "README.md").read_text()
    for name in manifest["contributes"]["configuration"]["properties"]:
        assert f"`{name}`" in page
