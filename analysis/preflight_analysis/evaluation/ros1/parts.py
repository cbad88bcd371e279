"""Tags as parts of a launch: what one added in the same scope is added again, where it says and stands the same and the
arguments that it asks for are the same."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from functools import partial

from preflight_analysis.evaluation.before import Before, Question
from preflight_analysis.evaluation.ros1.included import Record, tags_key_of
from preflight_analysis.evaluation.ros1.scope import Scope
from preflight_analysis.evaluation.ros1.state import State
from preflight_analysis.incremental.hashed import Hashed
from preflight_analysis.launch.model import Action

Evaluate = Callable[[State, Scope], str | None]
"""Evaluates a tag in a scope, and returns which machine is the default one after it."""
MAX_REMEMBERED_DEPTH = 24
"""Of includes within each other; what is deeper is evaluated anew, as Python's stack has an end."""


def within_tags(state: State, scope: Scope, default_machine: str | None) -> Hashable | None:
    """All of a scope that nodes and includes in it depend on beside arguments, the same object while that is equal;
    None where nothing of them can be remembered."""
    key = tags_key_of(scope, default_machine) if _is_remembered(state, scope) else None
    if key is None:
        return None
    hashed = Hashed(key)
    return state.files.db.part(hashed, lambda: hashed)


def within_parameters(state: State, scope: Scope, node: str | None) -> Hashable | None:
    """The same of what loads parameters, in the tag of a node or elsewhere."""
    if not _is_remembered(state, scope):
        return None
    return node, scope.file, scope.ns, scope.chain, tuple(scope.anonymous.items())


def remembered(state: State, scope: Scope, action: Action, within: Hashable | None, evaluate: Evaluate) -> str | None:
    """As `evaluate`, of this tag. `within` is all of the scope that it depends on beside arguments; None where nothing
    can be remembered."""
    if within is None:
        return evaluate(state, scope)
    lines, source = scope.lines.lines_of(action.span), scope.lines.text[slice(*action.span)]
    key = within, source, action.span.start - lines[0].start, lines
    anonymous = dict(scope.anonymous)
    alone = partial(_alone, state, scope, evaluate)
    record = state.files.db.part_answered(key, alone, scope.arguments.look)
    if record is not None and state.absorb(record):
        return record.default_machine
    # A node's name is taken, say: then order matters, and it is evaluated in its place.
    scope.anonymous = anonymous
    return evaluate(state, scope)


def _is_remembered(state: State, scope: Scope) -> bool:
    return state.files.db.is_making and not state.outline and len(scope.chain) <= MAX_REMEMBERED_DEPTH


def _alone(state: State, scope: Scope, evaluate: Evaluate) -> tuple[Record | None, Mapping[Question, object]]:
    """What a tag adds, whatever is around it, and what it asked for; None where it depends on more than that, and where
    something is wrong with the tag itself."""
    before, inner = Before(scope.arguments.look), state.inner()
    inside = scope.part(before)
    after = evaluate(inner, inside)
    wrong = any(problem.location.file == scope.file for problem in inner.problems)
    if wrong or inner.depends_on_outside or inner.exhausted:
        return None, before.answers
    record, previous = inner.record(inside, after), state.files.db.previous_part
    return record if previous is None else record.taking_over(previous), before.answers
