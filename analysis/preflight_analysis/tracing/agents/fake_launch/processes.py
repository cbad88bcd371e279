"""`launch.actions` and `launch.descriptions` of programs that are started. `preflight_serialize` is that of
`actions`."""

from __future__ import annotations

from typing import Any, Optional

from .base import Action, LaunchDescriptionEntity, Made, normalize_to_list_of_substitutions


class Executable(Made):
    """`launch.descriptions.Executable`."""

    def __init__(
        self,
        *,
        cmd: Any,
        prefix: Any = None,
        name: Any = None,
        cwd: Any = None,
        env: Optional[dict[Any, Any]] = None,
        additional_env: Optional[dict[Any, Any]] = None,
        arguments: Any = None,
    ) -> None:
        self.preflight = (prefix, name, cwd, env, additional_env)
        self.cmd = [normalize_to_list_of_substitutions(x) for x in cmd]
        if arguments is not None:
            self.cmd += [normalize_to_list_of_substitutions(x) for x in arguments]
        for value in (prefix, name, cwd):
            if value is not None:
                normalize_to_list_of_substitutions(value)
        self.name, self.cwd, self.env, self.additional_env = name, cwd, env, additional_env


class ExecuteLocal(Action):
    def __init__(
        self,
        *,
        process_description: Any,
        shell: Any = False,
        sigterm_timeout: Any = "5",
        sigkill_timeout: Any = "5",
        emulate_tty: Any = False,
        output: Any = "log",
        output_format: str = "",
        cached_output: Any = False,
        log_cmd: Any = False,
        on_exit: Any = None,
        respawn: Any = False,
        respawn_delay: Optional[float] = None,
        respawn_max_retries: int = -1,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.__process_description = process_description
        self.__options = (output, respawn, respawn_delay, on_exit)

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
        t.kind = "executable"
        for word in self.__process_description.cmd:
            t.child("argument", value=word)
        self.preflight_process(t)

    def preflight_process(self, t: Any) -> None:
        prefix, _, cwd, env, additional = self.__process_description.preflight
        output, respawn, _, on_exit = self.__options
        t.attribute("id", str(self.preflight_id))
        t.attribute("launch-prefix", prefix)
        t.attribute("cwd", cwd)
        for name, value in {**(env or {}), **(additional or {})}.items():
            t.child("env", name=normalize_to_list_of_substitutions(name), value=value)
        t.attribute("output", str(output) if isinstance(output, dict) else output)
        t.attribute("respawn", "true" if respawn is True else None if respawn is False else respawn)
        entities = [on_exit] if isinstance(on_exit, LaunchDescriptionEntity) else on_exit
        if isinstance(entities, (list, tuple)) and entities:
            with t.inside("on_exit"):
                t.entities(entities)


class ExecuteProcess(ExecuteLocal):
    def __init__(
        self,
        *,
        cmd: Any,
        prefix: Any = None,
        name: Any = None,
        cwd: Any = None,
        env: Any = None,
        additional_env: Any = None,
        **kwargs: Any,
    ) -> None:
        described = Executable(cmd=cmd, prefix=prefix, name=name, cwd=cwd, env=env, additional_env=additional_env)
        super().__init__(process_description=described, **kwargs)

    @property
    def cwd(self) -> Any:
        return self.process_description.cwd

    @property
    def env(self) -> Any:
        return self.process_description.env
