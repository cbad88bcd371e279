"""`launch.conditions`."""

from __future__ import annotations

from typing import Any, Optional

from ..anything import asked, is_unknown
from .base import (
    Condition,
    LaunchContext,
    Substitution,
    caller,
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from .worded import Worded

VALID_TRUE_EXPRESSIONS = ["true", "1"]
VALID_FALSE_EXPRESSIONS = ["false", "0"]


class InvalidConditionExpressionError(ValueError):
    def __init__(self, expression: str, unexpanded_expression: Any, valid_expressions: Any) -> None:
        super().__init__(f"invalid condition expression '{expression}', expected one of: {valid_expressions}")


def evaluate_condition_expression(context: LaunchContext, expression: Any) -> bool:
    text = perform_substitutions(context, expression).strip().lower()
    if is_unknown(text):
        return asked(text, caller(), False)
    if text in VALID_TRUE_EXPRESSIONS:
        return True
    if text in VALID_FALSE_EXPRESSIONS:
        return False
    valid = VALID_TRUE_EXPRESSIONS + VALID_FALSE_EXPRESSIONS
    raise InvalidConditionExpressionError(text, expression, valid)


class IfCondition(Condition):
    attribute = "if"

    def preflight_take(self, given: Any, left: Any) -> None:
        self.expression: list[Substitution] = normalize_to_list_of_substitutions(given.predicate_expression)
        super().__init__(predicate=self._predicate_func)

    def _predicate_func(self, context: LaunchContext) -> bool:
        return evaluate_condition_expression(context, self.expression)


class UnlessCondition(IfCondition):
    attribute = "unless"

    def _predicate_func(self, context: LaunchContext) -> bool:
        return not evaluate_condition_expression(context, self.expression)


class _Comparison(Worded):
    """A configuration with a text, as the host is told of it."""

    def __init__(self, command: str, *words: Any) -> None:
        self.preflight_kind = command
        self._words(*words)


class LaunchConfigurationEquals(Condition):
    comparison = "config-equals"

    def preflight_take(self, given: Any, left: Any) -> None:
        self._name = given.launch_configuration_name
        ensure_argument_type(self._name, str, "launch_configuration_name", type(self).__name__)
        self._expected: Optional[list[Substitution]] = None
        if given.expected_value is not None:
            self._expected = normalize_to_list_of_substitutions(given.expected_value)
        words = (self._name,) if self._expected is None else (self._name, self._expected)
        self.expression: list[Substitution] = [_Comparison(self.comparison, *words)]
        super().__init__(predicate=self._predicate_func)

    attribute = "if"

    def _predicate_func(self, context: LaunchContext) -> bool:
        expected = None if self._expected is None else perform_substitutions(context, self._expected)
        return bool(context.launch_configurations.get(self._name) == expected)


class LaunchConfigurationNotEquals(LaunchConfigurationEquals):
    comparison = "config-not-equals"

    def _predicate_func(self, context: LaunchContext) -> bool:
        return not super()._predicate_func(context)
