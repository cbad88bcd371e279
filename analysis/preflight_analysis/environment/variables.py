"""Environment variables of which is known who depends on them."""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from dataclasses import replace
from typing import Any

from preflight_analysis.environment.model import Environment
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query

WITHHELD = "\0"
"""In place of a secret; no variable has this value."""


@query
def variable_of(db: Database, environment: Environment, name: str) -> str | None:
    """The value of a variable; None where it is not set, `WITHHELD` where that is a secret."""
    return value_of(environment, name)


def value_of(environment: Environment, name: str) -> str | None:
    """The same, not remembered."""
    return WITHHELD if name in environment.withheld else environment.variables.get(name)


def with_queried_variables(db: Database, environment: Environment) -> Environment:
    """The environment, whose variables are asked for by `variable_of`."""
    return replace(environment, variables=_QueriedVariables(db, environment, environment.variables))


def with_variables(environment: Environment, others: Mapping[str, str]) -> Environment:
    """The environment with these variables set as well, or to other values."""
    if not others:
        return environment
    variables = copied(environment.variables)
    variables.update(others)
    return replace(environment, variables=variables, withheld=environment.withheld.difference(others))


def copied(variables: Mapping[str, str]) -> dict[str, str]:
    """A copy that tells whoever notes which ones are read what the first one does."""
    return copy(variables) if isinstance(variables, dict) else dict(variables)


class _QueriedVariables(dict[str, str]):
    """Whoever asks for a variable, or sets it, depends on it as it was at first. So it is with copies, too; who goes
    through all of them without a question depends on none."""

    def __init__(self, db: Database, environment: Environment, variables: Mapping[str, str]) -> None:
        super().__init__(variables)
        self._db = db
        self._environment = environment

    def _ask(self, name: str) -> None:
        variable_of(self._db, self._environment, name)

    def __copy__(self) -> _QueriedVariables:
        return _QueriedVariables(self._db, self._environment, self)

    def __contains__(self, name: object) -> bool:
        self._ask(str(name))
        return super().__contains__(name)

    def __getitem__(self, name: str) -> str:
        self._ask(name)
        return super().__getitem__(name)

    def __setitem__(self, name: str, value: str) -> None:
        self._ask(name)
        super().__setitem__(name, value)

    def get(self, name: str, *default: Any) -> Any:
        self._ask(name)
        return super().get(name, *default)

    def pop(self, name: str, *default: Any) -> Any:
        self._ask(name)
        return super().pop(name, *default)

    def update(self, values: Mapping[str, str]) -> None:  # type: ignore[override]
        for name, value in values.items():
            self[name] = value
