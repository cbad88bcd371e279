"""Prints which of the names on standard input the fake of launch lacks, and which take something else: as JSON."""

from __future__ import annotations

import importlib
import inspect
import json
import sys
from typing import Any

from preflight_analysis.tracing.agents.fake_launch.modules import install


def main() -> None:
    """Import each module as a launch file would."""
    names: dict[str, dict[str, str | None]] = json.load(sys.stdin)
    install()
    missing, other = [], []
    for module, contents in names.items():
        try:
            found = importlib.import_module(module)
        except ImportError:
            missing += [f"{module}.{name}" for name in contents]
            continue
        for name, signature in contents.items():
            if not hasattr(found, name):
                missing.append(f"{module}.{name}")
            elif signature is not None and not _takes(getattr(found, name), signature):
                other.append(f"{module}.{name}({signature})")
    json.dump({"missing": missing, "other": other}, sys.stdout)


def _takes(thing: Any, signature: str) -> bool:
    """Whether it can be called in each way in which the real one can: with all arguments, and with the required ones
    only, those by position in their order."""
    ours = inspect.signature(thing)
    parameters = [each for each in signature.split(", ") if each]
    star = next((i for i, each in enumerate(parameters) if each.startswith("*")), len(parameters))
    plain, named = parameters[:star], [each for each in parameters[star:] if not each.startswith("*")]
    try:
        ours.bind(*plain, **{each.rstrip("="): 0 for each in named})
        ours.bind(**{each.rstrip("="): 0 for each in (*plain, *named)})
        ours.bind(**{each: 0 for each in (*plain, *named) if not each.endswith("=")})
    except TypeError:
        return False
    for index, each in enumerate(plain):
        bound = ours.bind_partial(*range(index + 1)).arguments
        if each.rstrip("=") in ours.parameters and bound.get(each.rstrip("=")) != index:
            return False
    return True


if __name__ == "__main__":
    main()
