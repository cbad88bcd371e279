"""Those of `launch.actions` that change launch configurations and do more than keep what they are given."""

from __future__ import annotations

from typing import Any, Optional

from ..anything import is_unknown
from .base import Action, Substitution, normalize_to_list_of_substitutions


class DeclareLaunchArgument(Action):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)
        default = given.default_value
        self.__name = given.name
        self.__default_value = None if default is None else normalize_to_list_of_substitutions(default)
        self.__choices = None if given.choices is None else list(given.choices)
        self.__description = given.description or "no description given"
        self.preflight_doc = given.description
        self._conditionally_included = False
        if self.__choices is not None:
            if not self.__choices:
                raise RuntimeError("Provided choices arg is empty. Use None to ignore the choice list.")
            literal = isinstance(default, str) and not is_unknown(default)
            is_known = literal and all(isinstance(each, str) and not is_unknown(each) for each in self.__choices)
            if is_known and default not in self.__choices:
                raise RuntimeError(f'Provided default_value "{default}" is not in provided choices "{self.__choices}".')

    @property
    def name(self) -> str:
        return str(self.__name)

    @property
    def default_value(self) -> Optional[list[Substitution]]:
        return self.__default_value

    @property
    def description(self) -> str:
        return str(self.__description)

    @property
    def choices(self) -> Optional[list[str]]:
        return self.__choices

    def preflight_serialize(self, t: Any) -> None:
        t.attribute("name", self.__name)
        t.attribute("default", self.__default_value)
        t.attribute("description", self.preflight_doc)
        for choice in self.__choices or ():
            t.child("choice", value=str(choice))


class AppendEnvironmentVariable(Action):
    preflight_flags = ("prepend",)


class ResetLaunchConfigurations(Action):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)
        self.__kept = dict(given.launch_configurations or {})

    def preflight_serialize(self, t: Any) -> None:
        for name, value in self.__kept.items():
            t.child("keep", name=normalize_to_list_of_substitutions(name), value=value)
