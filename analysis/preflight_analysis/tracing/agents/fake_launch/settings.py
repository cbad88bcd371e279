"""Those of `launch.actions` that change launch configurations and the environment."""

from __future__ import annotations

import os
from typing import Any, Iterable, Optional

from ..anything import is_unknown
from .base import Action, Substitution, normalize_to_list_of_substitutions


class DeclareLaunchArgument(Action):
    def __init__(
        self,
        name: str,
        *,
        default_value: Any = None,
        description: Optional[str] = None,
        choices: Optional[Iterable[str]] = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.__name = name
        self.__default_value = None if default_value is None else normalize_to_list_of_substitutions(default_value)
        self.__choices = None if choices is None else list(choices)
        self.__description = description or "no description given"
        self.preflight_doc = description
        self._conditionally_included = False
        if self.__choices is not None:
            if not self.__choices:
                raise RuntimeError("Provided choices arg is empty. Use None to ignore the choice list.")
            literal = isinstance(default_value, str) and not is_unknown(default_value)
            is_known = literal and all(isinstance(each, str) and not is_unknown(each) for each in self.__choices)
            if is_known and default_value not in self.__choices:
                raise RuntimeError(
                    f'Provided default_value "{default_value}" is not in provided choices "{self.__choices}".'
                )

    @property
    def name(self) -> str:
        return self.__name

    @property
    def default_value(self) -> Optional[list[Substitution]]:
        return self.__default_value

    @property
    def description(self) -> str:
        return self.__description

    @property
    def choices(self) -> Optional[list[str]]:
        return self.__choices

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "arg"
        t.attribute("name", self.__name)
        t.attribute("default", self.__default_value)
        t.attribute("description", self.preflight_doc)
        for choice in self.__choices or ():
            t.child("choice", value=str(choice))


class _Set(Action):
    """Sets something by name; `preflight_kind` is its tag."""

    preflight_kind = ""

    def __init__(self, name: Any, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name = normalize_to_list_of_substitutions(name)
        self.__value = normalize_to_list_of_substitutions(value)

    @property
    def name(self) -> list[Substitution]:
        return self.__name

    @property
    def value(self) -> list[Substitution]:
        return self.__value

    def preflight_serialize(self, t: Any) -> None:
        t.kind = self.preflight_kind
        t.attribute("name", self.__name)
        t.attribute("value", self.__value)


class _Unset(Action):
    """Takes something away by name; `preflight_kind` is its tag."""

    preflight_kind = ""

    def __init__(self, name: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name = normalize_to_list_of_substitutions(name)

    @property
    def name(self) -> list[Substitution]:
        return self.__name

    def preflight_serialize(self, t: Any) -> None:
        t.kind = self.preflight_kind
        t.attribute("name", self.__name)


class SetLaunchConfiguration(_Set):
    preflight_kind = "let"


class UnsetLaunchConfiguration(_Unset):
    preflight_kind = "unlet"


class SetEnvironmentVariable(_Set):
    preflight_kind = "set_env"


class UnsetEnvironmentVariable(_Unset):
    preflight_kind = "unset_env"


class AppendEnvironmentVariable(Action):
    def __init__(self, name: Any, value: Any, prepend: Any = False, separator: Any = os.pathsep, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name = normalize_to_list_of_substitutions(name)
        self.__value = normalize_to_list_of_substitutions(value)
        self.__prepend, self.__separator = prepend, normalize_to_list_of_substitutions(separator)

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "append_env"
        t.attribute("name", self.__name)
        t.attribute("value", self.__value)
        t.attribute("prepend", self.__prepend if isinstance(self.__prepend, bool) else t.parts(self.__prepend))
        t.attribute("separator", self.__separator)


class _Plain(Action):
    """One without attributes."""

    preflight_kind = ""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)

    def preflight_serialize(self, t: Any) -> None:
        t.kind = self.preflight_kind


class PushEnvironment(_Plain):
    preflight_kind = "push_env"


class PopEnvironment(_Plain):
    preflight_kind = "pop_env"


class ResetEnvironment(_Plain):
    preflight_kind = "reset_env"


class PushLaunchConfigurations(_Plain):
    preflight_kind = "push_configurations"


class PopLaunchConfigurations(_Plain):
    preflight_kind = "pop_configurations"


class ResetLaunchConfigurations(Action):
    def __init__(self, launch_configurations: Optional[dict[Any, Any]] = None, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__kept = dict(launch_configurations or {})

    def preflight_serialize(self, t: Any) -> None:
        t.kind = "reset"
        for name, value in self.__kept.items():
            t.child("keep", name=normalize_to_list_of_substitutions(name), value=value)
