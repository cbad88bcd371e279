"""What stands in for Python modules that a node imports and this machine does not have: where it may, and what it
means for the node's end.

`agents/stand_ins/` are the modules, which are found inside of the sandbox only, after all that is there.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Set
from dataclasses import replace

from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing import recipe as recipes
from preflight_analysis.tracing.agents.variables import STAND_INS
from preflight_analysis.tracing.interface import Outcome, telling_line
from preflight_analysis.tracing.records import Gathered

_FILE = f"{recipes.ROS_HOME}/stand_ins.json"
_MOST_NAMED = 3
_OURS = re.compile(r"(Attribute|Type|Import|ModuleNotFound|NotImplemented|Recursion)Error\b")
"""What a stand-in that is not like the real thing would make a node end for."""

_CONFIG = "dynamic_reconfigure"
"""What a build makes of its files is not here: which keys there are."""
_KEY = re.compile(r"KeyError: '([A-Za-z_]\w*)'")
_INSTALL = re.compile(
    r"(?i)\bpip3? install\b|\bnot (?:be )?(?:installed|available|found|imported)\b|\b(?:un|in)available\b"
    r"|\bno (?:\w+ ){1,4}available\b|\bis missing\b|\brequire[sd]?\b|'NoneType' object|\bname '\w+' is not defined"
)
"""How a program that goes on without a module says later that it cannot."""

_WORD = re.compile(r"\w+")

_OLD = re.compile(
    r"\b(Syntax|Indentation|Tab)Error\b|there is no '[^']*python2[^']*'|from partially initialized module '(\w+)'"
)
"""What a program in Python 2 ends for that is run by Python 3, or by nothing. There a package's own `__init__.py` may
import a module of the package by the name that both have."""


def admitted(recipe: recipes.Recipe, environment: Environment, generation: int) -> recipes.Recipe:
    """The recipe with stand-ins, where it is that of a program in Python."""
    if not recipe.python:
        return recipe
    packages = {p.name: p.share for p in environment.packages.values() if p.generation == generation}
    job = json.dumps({"generation": generation, "packages": packages})
    return replace(recipe, env={**recipe.env, STAND_INS: _FILE}, files={**recipe.files, _FILE: job})


def explained(outcome: Outcome, found: Gathered, executable: str) -> Outcome:
    """With what a node lacked here that ended after it had used a stand-in, or for being written in Python 2: it says
    nothing of the robot."""
    failed = outcome.status == "crashed" or (outcome.status == "exited" and outcome.exit_code not in (None, 0))
    if failed and _OLD.search(outcome.reason or "") and recipes.may_be_python2(executable):
        return replace(outcome, lacks="Python 2")
    if outcome.status == "exited" and found.unknown and not _has_endpoints(found):
        # What it would have done is in the module that is missing.
        outcome, failed = replace(outcome, status="crashed"), True
    ours = found.unknown or _OURS.search(outcome.reason or "") is not None
    modules = sorted(found.stand_ins) if ours else []
    if not modules and _CONFIG in found.stand_ins and _lacks_key(outcome, found):
        modules = [_CONFIG]
    if not modules and any(map(_INSTALL.search, _said_of_modules(outcome, found.lacked))):
        modules = sorted(found.lacked)
    if not failed or not modules:
        return outcome
    more = f" and {len(modules) - _MOST_NAMED} more" if len(modules) > _MOST_NAMED else ""
    plural = "s" if len(modules) > 1 else ""
    return replace(outcome, lacks=f"the Python module{plural} {', '.join(modules[:_MOST_NAMED])}{more}")


def _said_of_modules(outcome: Outcome, lacked: Set[str]) -> Iterator[str]:
    """What may tell that a node ended for want of a module: why it ended, and what it says of the modules before."""
    yield from (outcome.reason or "", telling_line(outcome.stderr_tail))
    modules = {each.lower() for each in lacked}
    yield from (line for line in outcome.stderr_tail if not modules.isdisjoint(_WORD.findall(line.lower())))


def _lacks_key(outcome: Outcome, found: Gathered) -> bool:
    """Whether it ended for a key that is no parameter, such as one of a configuration."""
    key = _KEY.search(outcome.reason or "")
    return key is not None and all(use.name.rpartition("/")[2].strip("~") != key[1] for use, _ in found.params.values())


def hides_all(found: Gathered) -> bool:
    """Whether a node used a stand-in and made nothing: what it does may all be in the module that is missing."""
    return found.unknown and not _has_endpoints(found) and all(use.builtin for use, _ in found.params.values())


def _has_endpoints(found: Gathered) -> bool:
    return any(not each.builtin for each, _ in found.endpoints.values())
