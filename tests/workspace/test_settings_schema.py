"""The schema of the settings file says what the reader of the file understands."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import jsonschema
import preflight_analysis.workspace.project_settings as reader
import pytest
import yaml
from preflight_analysis.workspace.project_settings import KEYS, read_project_settings
from preflight_analysis.workspace.settings_schema import COMMAND, page, schema, text

ROOT = Path(__file__).resolve().parents[2]
EVERYTHING = """
roots: [a.launch, {file: b.launch, args: {sim: true, n: 3, name: x}}]
external: {topics: [/joy]}
nodes:
  - package: p
    executable: t
    topics: [{name: chatter, type: std_msgs/String, class: pub}]
    services: [{name: reset, type: std_srvs/Empty, class: client}]
    actions: [{name: go, type: a/Go, class: server}]
    params: [{name: ~rate, default: 10}, {name: ~x}]
  - name: /b
knowledge: [config/knowledge.yaml]
select: [LCH, TOP001]
ignore: [LCH005]
severities: {TOP001: off, all: hint, PRM: warning}
paths: [{path: old, severities: {PRM001: error}, select: [PRM], ignore: [PRM002]}]
profile: strict
"""


def yaml_1_2(text: str) -> Any:
    """As editors read it: `off` is a text there."""
    return yaml.safe_load(text.replace("off", "'off'"))


def test_the_extension_brings_it() -> None:
    manifest = json.loads((ROOT / "vscode-client/package.json").read_text())
    brought = (ROOT / "vscode-client/.vscodeignore").read_text().splitlines()
    for entry in manifest["contributes"]["yamlValidation"]:
        assert (ROOT / "vscode-client" / entry["url"]).is_file()
        assert f"!{entry['url'].removeprefix('./')}" in brought


def test_the_extension_brings_it_as_it_is() -> None:
    written = (ROOT / "vscode-client/ros-preflight.schema.json").read_text()
    assert written == text(), f"run: {COMMAND}"
    assert (ROOT / "docs/settings_reference.md").read_text() == page(), f"run: {COMMAND}"


def test_it_is_a_schema_of_the_same_names() -> None:
    jsonschema.Draft7Validator.check_schema(schema())
    assert tuple(schema()["properties"]) == KEYS


@pytest.mark.parametrize("settings", [EVERYTHING, str(reader.__doc__).partition("\n\n")[2], ""])
def test_both_take(tmp_path: Path, settings: str) -> None:
    (tmp_path / ".ros-preflight.yaml").write_text(settings)
    assert read_project_settings(str(tmp_path)).problems == ()
    jsonschema.Draft7Validator(schema()).validate(yaml_1_2(settings))


@pytest.mark.parametrize(
    "settings",
    [
        "rots: [a.launch]",
        "roots: a.launch",
        "roots: [{args: {a: b}}]",
        "roots: [{file: a, arg: {a: b}}]",
        "roots: [{file: a, args: {a: [b]}}]",
        "external: {topic: [/a]}",
        "external: {topics: /a}",
        "nodes: [{package: p}]",
        "nodes: [{name: /a, topic: []}]",
        "nodes: [{name: /a, topics: [{name: a, class: publisher}]}]",
        "nodes: [{name: /a, topics: [{class: pub}]}]",
        "nodes: [{name: /a, params: [{default: 1}]}]",
        "severities: {TOP999: off}",
        "severities: {TOP001: fatal}",
        "severities: [TOP001]",
        "paths: {path: a}",
        "paths: [{severities: {all: off}}]",
        "paths: [{path: a, rules: {}}]",
    ],
)
def test_both_refuse(tmp_path: Path, settings: str) -> None:
    (tmp_path / ".ros-preflight.yaml").write_text(settings)
    assert [problem.line for problem in read_project_settings(str(tmp_path)).problems] == [1]
    assert not jsonschema.Draft7Validator(schema()).is_valid(yaml_1_2(settings))
