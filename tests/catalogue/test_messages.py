"""Definitions of messages in the catalogue."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import preflight_analysis
import pytest
from tools.catalogue.messages import DEFINITIONS, plain

MEMBER = re.compile(r"---|[\w/]+(?:<=\d+)?(?:\[(?:<=)?\d*\])? \w+(?:=.*| .+)?")


@pytest.fixture(scope="module")
def definitions() -> dict[str, Any]:
    path = Path(preflight_analysis.__file__).parents[2] / DEFINITIONS
    found: dict[str, Any] = json.loads(path.read_text())
    return found


def test_members_are_kept_and_nothing_else() -> None:
    text = """
        # what it is
        Header   header      # when
        float64[9] K         # 3x3
        uint8 POINTS = 0     # a constant
        string<=8 NAME = a # b
        int32 depth 10
        ---   # the response
        bool ok
        <no member>
    """
    assert plain(text).splitlines() == [
        "Header header",
        "float64[9] K",
        "uint8 POINTS=0",
        "string<=8 NAME=a # b",
        "int32 depth 10",
        "---",
        "bool ok",
    ]


def test_the_data_has_members_only(definitions: dict[str, Any]) -> None:
    assert all(re.fullmatch(r"[\w.-]+/[\w.-]+ [0-9a-f]{40}", each) for each in definitions.pop(""))
    texts = [each for of in definitions.values() for each in (of.values() if isinstance(of, dict) else [of])]
    lines = {line for text in texts for line in text.splitlines()}
    assert [line for line in lines if not MEMBER.fullmatch(line)] == []


def test_both_generations_have_the_common_ones(definitions: dict[str, Any]) -> None:
    assert definitions["geometry_msgs/msg/Point"] == "float64 x\nfloat64 y\nfloat64 z"
    assert definitions["std_msgs/msg/Header"]["1"].startswith("uint32 seq")
    assert "NavigateToPose" in {name.rpartition("/")[2] for name in definitions if name.startswith("nav2_msgs/action/")}
