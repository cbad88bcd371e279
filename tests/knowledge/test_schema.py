"""The schema of knowledge files says what their reader understands."""

from pathlib import Path

import jsonschema
import pytest
import yaml
from preflight_analysis.knowledge.load import DATA
from preflight_analysis.knowledge.read import read_knowledge
from preflight_analysis.knowledge.schema import COMMAND, schema, text

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "knowledge.md").read_text()
VALIDATOR = jsonschema.Draft7Validator(schema())


def test_the_extension_brings_it_as_it_is() -> None:
    assert (ROOT / "vscode-client/ros-preflight-knowledge.schema.json").read_text() == text(), f"run: {COMMAND}"


@pytest.mark.parametrize("path", sorted(DATA.glob("*.yaml")), ids=lambda path: path.stem)
def test_what_comes_with_it_fits(path: Path) -> None:
    assert not list(VALIDATOR.iter_errors(yaml.safe_load(path.read_text())))


def test_the_example_of_the_page_fits() -> None:
    example = PAGE.split("```yaml\n")[2].split("```")[0]
    assert not list(VALIDATOR.iter_errors(yaml.safe_load(example)))
    assert read_knowledge(example).problems == ()


@pytest.mark.parametrize(
    "wrong",
    [
        "entries: []",
        "{package: p, entries: [{parameters: {}}]}",
        "{package: p, entries: [{executables: [e], parameters: {x: {topic: reader}}}]}",
        "{package: p, entries: [{executables: [e], parameters: {x: {type: a/B}}}]}",
        "{package: p, entries: [{executables: [e], broadcasts: [{parent: a}]}]}",
        "{package: p, entries: [{executables: [e], parameters: {x: {file: map}}}]}",
        "{package: p, entries: [{executables: [e], parameters: {x: {default: t, type: a/B}}}]}",
        "{package: p, more: 1}",
    ],
)
def test_both_refuse(wrong: str) -> None:
    assert read_knowledge(wrong).problems
    assert list(VALIDATOR.iter_errors(yaml.safe_load(wrong)))
