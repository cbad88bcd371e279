"""`launch.actions` and `launch.descriptions` of programs that are started. `preflight_serialize` is that of
`actions`."""

from __future__ import annotations

from typing import Any

from .base import Action, LaunchDescriptionEntity, Made, normalize_to_list_of_substitutions


class Executable(Made):
    """`launch.descriptions.Executable`."""

    def preflight_take(self, given: Any, left: Any) -> None:
        self.prefix, self.name, self.cwd = given.prefix, given.name, given.cwd
        self.env, self.additional_env = given.env, given.additional_env
        self.cmd = [normalize_to_list_of_substitutions(x) for x in given.cmd]
        if given.arguments is not None:
            self.cmd += [normalize_to_list_of_substitutions(x) for x in given.arguments]
        for value in (self.prefix, self.name, self.cwd):
            if value is not None:
                normalize_to_list_of_substitutions(value)


class ExecuteLocal(Action):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)
        self.__process_description = given.process_description
        self.__options = given

    @property
    def process_description(self) -> Any:
        return self.__process_description

    @property
    def cmd(self) -> Any:
        return self.__process_description.cmd

    @property
    def name(self) -> Any:
        return self.__process_description.name

    def preflight_serialize(self, t: Any) -> None:
        for word in self.__process_description.cmd:
            t.child("argument", value=word)
        self.preflight_process(t)

    def preflight_process(self, t: Any) -> None:
        process, output, respawn = self.__process_description, self.__options.output, self.__options.respawn
        on_exit = self.__options.on_exit
        t.attribute("id", str(self.preflight_id))
        t.attribute("launch-prefix", process.prefix)
        t.attribute("cwd", process.cwd)
        for name, value in {**(process.env or {}), **(process.additional_env or {})}.items():
            t.child("env", name=normalize_to_list_of_substitutions(name), value=value)
        t.attribute("output", str(output) if isinstance(output, dict) else output)
        t.attribute("respawn", "true" if respawn is True else None if respawn is False else respawn)
        entities = [on_exit] if isinstance(on_exit, LaunchDescriptionEntity) else on_exit
        if isinstance(entities, (list, tuple)) and entities:
            with t.inside("on_exit"):
                t.entities(entities)


class ExecuteProcess(ExecuteLocal):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(process_description=Executable(**vars(given)), **left)

    @property
    def cwd(self) -> Any:
        return self.process_description.cwd

    @property
    def env(self) -> Any:
        return self.process_description.env
