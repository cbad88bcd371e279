"""The extension's manifest has the settings that the server reads."""

from __future__ import annotations

import dataclasses
import json
import re
from pathlib import Path

from preflight_server.lsp.contribution import COMMAND, contributed
from preflight_server.lsp.settings import SCHEMA, Settings

CLIENT = Path(__file__).parents[2] / "vscode-client"


def test_the_manifest_is_up_to_date() -> None:
    manifest = (CLIENT / "package.json").read_text()
    assert contributed(manifest) == manifest, f"stale: run {COMMAND}"


def test_every_setting_is_described_with_its_default() -> None:
    fields = {re.sub("_(.)", lambda m: m[1].upper(), f.name): f.default for f in dataclasses.fields(Settings)}
    assert {name: described["default"] for name, described in SCHEMA.items()} == fields


def test_what_names_folders_and_programs_counts_in_trusted_workspaces_only() -> None:
    manifest = json.loads((CLIENT / "package.json").read_text())
    settings = manifest["contributes"]["configuration"]["properties"]
    choices = {name for name, described in settings.items() if described["type"] == "boolean" or "enum" in described}
    of_the_user = {name for name, described in settings.items() if described["scope"] == "machine"}
    restricted = manifest["capabilities"]["untrustedWorkspaces"]["restrictedConfigurations"]
    assert set(settings) - choices - of_the_user == set(restricted)


def test_a_setting_that_is_not_the_servers_stays() -> None:
    own = json.dumps(
        {"contributes": {"configuration": {"properties": {"rosPreflight.server.command": {"default": []}}}}}
    )
    properties = json.loads(contributed(own))["contributes"]["configuration"]["properties"]
    assert properties["rosPreflight.server.command"] == {"default": []}
    assert properties["rosPreflight.runNodes"]["default"] is True


def test_the_pictures_of_the_page_are_there_and_small() -> None:
    pictures = re.findall(r"!\[[^]]+\]\(([^)]+)\)", (CLIENT / "README.md").read_text())
    assert pictures
    for picture in pictures:
        assert 0 < (CLIENT / picture).stat().st_size < 200_000, picture
