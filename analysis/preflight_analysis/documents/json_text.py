"""JSON as text."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any


def dumps(data: Mapping[str, Any] | list[dict[str, Any]], *, indent: int | None = 2) -> str:
    """JSON text with sorted keys; characters stay what they are, save halves of surrogate pairs."""
    text = json.dumps(data, sort_keys=True, indent=indent, ensure_ascii=False, allow_nan=False)
    try:
        text.encode()
    except UnicodeEncodeError:
        return json.dumps(data, sort_keys=True, indent=indent, allow_nan=False)
    return text
