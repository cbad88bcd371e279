"""Prints the texts for users that are not Markdown files, as JSON for prose.mjs: help texts of the command line,
descriptions of settings, and what the manifests show."""

from __future__ import annotations

import argparse
import importlib
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml
from preflight_server.cli.main import VERBS

ROOT = Path(__file__).resolve().parents[2]
SHOWN = {"title", "description", "markdownDescription", "enumDescriptions", "contents", "deprecationMessage"}
"""The keys of a manifest whose values are texts."""
MANIFESTS = (
    "vscode-client/package.json",
    "vscode-client/ros-preflight.schema.json",
    "vscode-client/ros-preflight-knowledge.schema.json",
    "action.yml",
    "packaging/devcontainer/ros-preflight/devcontainer-feature.json",
)


def texts() -> Iterator[tuple[str, str]]:
    """Each text with its place."""
    for verb, help_text in VERBS.items():
        yield f"ros-preflight {verb}", help_text
        module = importlib.import_module(f"preflight_server.cli.{verb}")
        yield f"ros-preflight {verb} --help", module.DESCRIPTION
        parser = argparse.ArgumentParser(prog=verb)
        module.add_arguments(parser)
        for action in parser._actions:  # argparse has no other way to its arguments
            if action.help:
                yield f"ros-preflight {verb} {'/'.join(action.option_strings) or action.dest}", action.help
    for name in MANIFESTS:
        yield from _shown(yaml.safe_load((ROOT / name).read_text(encoding="utf-8")), name)


def _shown(data: Any, place: str) -> Iterator[tuple[str, str]]:
    if isinstance(data, dict):
        for key, value in data.items():
            if key in SHOWN and isinstance(value, (str, list)):
                yield from ((f"{place} {key}", text) for text in ([value] if isinstance(value, str) else value))
            else:
                yield from _shown(value, f"{place} {key}")
    elif isinstance(data, list):
        for each in data:
            yield from _shown(each, place)


if __name__ == "__main__":
    json.dump([{"place": place, "text": text} for place, text in texts()], sys.stdout)
