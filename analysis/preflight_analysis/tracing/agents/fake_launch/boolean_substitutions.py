"""Those of `launch.substitutions` that decide: yes or no, and one of two texts."""

from __future__ import annotations

import math
from typing import Any

from .base import LaunchContext
from .worded import Worded, is_scalar, truth


class IfElseSubstitution(Worded):
    def preflight_take(self, given: Any, left: Any) -> None:
        if given.if_value == given.else_value == "":
            raise RuntimeError("One of if_value and else_value must be specified")
        self._words(given.condition, given.if_value, given.else_value)

    def perform(self, context: LaunchContext) -> str:
        return self._text(context, 1 if truth(self._text(context, 0)) else 2)


class NotSubstitution(Worded):
    def perform(self, context: LaunchContext) -> str:
        return str(not truth(self._text(context, 0))).lower()


class AndSubstitution(Worded):
    def perform(self, context: LaunchContext) -> str:
        return str(truth(self._text(context, 0)) and truth(self._text(context, 1))).lower()


class OrSubstitution(Worded):
    def perform(self, context: LaunchContext) -> str:
        return str(truth(self._text(context, 0)) or truth(self._text(context, 1))).lower()


class AnySubstitution(Worded):
    def preflight_take(self, given: Any, left: Any) -> None:
        self._words(*given.args)

    def perform(self, context: LaunchContext) -> str:
        return str(any(truth(self._text(context, i)) for i in range(len(self.words)))).lower()


class AllSubstitution(Worded):
    def preflight_take(self, given: Any, left: Any) -> None:
        self._words(*given.args)

    def perform(self, context: LaunchContext) -> str:
        return str(all(truth(self._text(context, i)) for i in range(len(self.words)))).lower()


class EqualsSubstitution(Worded):
    def preflight_take(self, given: Any, left: Any) -> None:
        self._words(_as_text(given.left), _as_text(given.right))

    def _equal(self, context: LaunchContext) -> bool:
        left, right = self._text(context, 0), self._text(context, 1)
        booleans = ("true", "false", "1", "0")
        if left.lower() in booleans and right.lower() in booleans:
            return truth(left) == truth(right)
        try:
            return math.isclose(float(left), float(right))
        except ValueError:
            return left == right

    def perform(self, context: LaunchContext) -> str:
        return str(self._equal(context)).lower()


class NotEqualsSubstitution(EqualsSubstitution):
    def perform(self, context: LaunchContext) -> str:
        return str(not self._equal(context)).lower()


def _as_text(value: Any) -> Any:
    if value is None:
        return ""
    return str(value).lower() if isinstance(value, bool) else str(value) if is_scalar(value) else value
