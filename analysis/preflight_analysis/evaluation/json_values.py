"""Values of parameters in JSON."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping
from typing import Any

from preflight_analysis.evaluation.tree import CommandValue, ParamValue


def json_value(value: ParamValue) -> Any:
    """A parameter's value as JSON can say it: text for dates and for what is no finite number, `{"command": ...}` for
    a command that was not run, `{"binary_sha1": ...}` for bytes."""
    if isinstance(value, CommandValue):
        return {"command": value.command}
    if isinstance(value, bytes):
        return {"binary_sha1": hashlib.sha1(value, usedforsecurity=False).hexdigest()}
    if isinstance(value, float) and not math.isfinite(value):
        return repr(value)
    if isinstance(value, Mapping):
        return {str(key): json_value(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [json_value(each) for each in value]
    return value if value is None or isinstance(value, (bool, int, float, str)) else str(value)
