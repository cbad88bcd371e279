"""What stands in for Python modules that a node imports and this machine does not have: where it may, and what it
means for the node's end.

`agents/stand_ins/` are the modules, which are found inside of the sandbox only, after all that is there.
"""

from __future__ import annotations

import ast
import json
import os
import re
from collections.abc import Iterator, Set
from dataclasses import replace

from preflight_analysis.documents.reading import Text, read_text
from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing import recipe as recipes
from preflight_analysis.tracing.agents.variables import STAND_INS
from preflight_analysis.tracing.interface import Outcome, telling_line
from preflight_analysis.tracing.records import Gathered

_FILE = f"{recipes.ROS_HOME}/stand_ins.json"
_MOST_NAMED = 3
_OURS = re.compile(r"(Attribute|Type|Import|ModuleNotFound|NotImplemented|Recursion)Error\b")
"""What a stand-in that is not like the real thing would make a node end for."""

_NO_ATTRIBUTE = re.compile(r"AttributeError: '(\w+)' object has no attribute '(\w+)'")
_FRAME = re.compile(r'  File "(/[^"]+)", line \d+, in ')
_BASES = frozenset({"Node", "LifecycleNode", "object", "ABC"})
_DIR = """
PARAM_REL_TOL ParameterInput add_managed_entity add_on_set_parameters_callback add_post_set_parameters_callback
add_pre_set_parameters_callback add_waitable clients context count_clients count_publishers count_services
count_subscribers create_client create_guard_condition create_lifecycle_publisher create_publisher create_rate
create_service create_subscription create_timer declare_parameter declare_parameters default_callback_group
describe_parameter describe_parameters destroy_client destroy_guard_condition destroy_lifecycle_publisher
destroy_node destroy_publisher destroy_rate destroy_service destroy_subscription destroy_timer executor
get_client_names_and_types_by_node get_clock get_fully_qualified_name get_fully_qualified_node_names get_logger
get_name get_namespace get_node_names get_node_names_and_namespaces get_node_names_and_namespaces_with_enclaves
get_parameter get_parameter_or get_parameter_type get_parameter_types get_parameters get_parameters_by_prefix
get_publisher_names_and_types_by_node get_publishers_info_by_topic get_service_names_and_types
get_service_names_and_types_by_node get_subscriber_names_and_types_by_node get_subscriptions_info_by_topic
get_topic_names_and_types guards handle has_parameter list_parameters on_activate on_cleanup on_configure
on_deactivate on_error on_shutdown publishers remove_on_set_parameters_callback remove_post_set_parameters_callback
remove_pre_set_parameters_callback remove_waitable resolve_service_name resolve_topic_name services set_descriptor
set_parameters set_parameters_atomically subscriptions timers trigger_activate trigger_cleanup trigger_configure
trigger_deactivate trigger_shutdown undeclare_parameter wait_for_node waitables
"""
"""`dir()` of rclpy's `Node` and `LifecycleNode` (Kilted)."""
_OF_NODES = frozenset(_DIR.split())
"""What a node in Python has of its library, whatever stands in for that."""

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
    ours = found.unknown or (
        _OURS.search(outcome.reason or "") is not None and not _is_of_own_class(outcome, executable)
    )
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


def _is_of_own_class(outcome: Outcome, executable: str) -> bool:
    """Whether a node ended for what an object of a class of its own does not have, and no library would give it."""
    missing = _NO_ATTRIBUTE.search(outcome.reason or "")
    frames = [found[1] for line in outcome.stderr_tail if (found := _FRAME.match(line)) is not None]
    if missing is None or missing[2] in _OF_NODES or missing[2].startswith("_") or not frames:
        return False
    # What the node says of itself names the file: no other one than its own is looked into.
    own_folder = os.path.join(os.path.dirname(os.path.abspath(executable)), "")
    text = read_text(frames[-1]) if os.path.normpath(frames[-1]).startswith(own_folder) else None
    try:
        tree = ast.parse(text.text) if isinstance(text, Text) else None
    except (ValueError, SyntaxError, RecursionError, MemoryError):
        return False
    if tree is None:
        return False
    own = [node for node in ast.walk(tree) if isinstance(node, ast.ClassDef) and node.name == missing[1]]
    bases = {
        base.attr if isinstance(base, ast.Attribute) else getattr(base, "id", "") for each in own for base in each.bases
    }
    return len(own) == 1 and not own[0].keywords and bases <= _BASES


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
