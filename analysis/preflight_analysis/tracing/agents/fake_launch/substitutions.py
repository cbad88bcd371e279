"""The other ones of `launch.substitutions`."""

from __future__ import annotations

import collections.abc
import importlib
import math
import os
import shlex
import shutil
import subprocess
from typing import Any

from ..anything import marked, unknown_text
from ..missing_modules import provided_for
from .base import (
    RECORDER,
    LaunchContext,
    NotHereError,
    Substitution,
    caller,
    ensure_argument_type,
    normalize_to_list_of_substitutions,
)
from .worded import Parts, SubstitutionFailure, Worded

_FAILURE = ("SubstitutionFailure", "RuntimeError")


class LaunchConfiguration(Worded):
    def preflight_take(self, given: Any, left: Any) -> None:
        name, default = given.variable_name, given.default
        ensure_argument_type(
            name, (str, Substitution, collections.abc.Iterable), "variable_name", "LaunchConfiguration"
        )
        if default is None:
            self._words(name)
            return
        if isinstance(default, collections.abc.Iterable) and not isinstance(default, str):
            default = [x if isinstance(x, Substitution) else str(x) for x in default]
        elif not isinstance(default, Substitution):
            default = str(default)
        self._words(name, default)

    @property
    def variable_name(self) -> Parts:
        return self.words[0]

    def describe(self) -> str:
        return f"LaunchConfig({' + '.join(sub.describe() for sub in self.variable_name)})"

    def perform(self, context: LaunchContext) -> str:
        name = self._text(context, 0)
        if name in context.launch_configurations:
            text: str = marked(str(context.launch_configurations[name]))
            return text
        if len(self.words) == 2:
            return self._text(context, 1)
        if provided_for(caller(), _FAILURE):
            raise SubstitutionFailure(f"launch configuration '{name}' does not exist")
        RECORDER.miss("configuration", name)
        return unknown_text(name)


class EnvironmentVariable(Worded):
    def perform(self, context: LaunchContext) -> str:
        name = self._text(context, 0)
        if name in context.environment:
            return str(context.environment[name])
        if len(self.words) == 2:
            return self._text(context, 1)
        if provided_for(caller(), _FAILURE):
            raise SubstitutionFailure(f"environment variable '{name}' does not exist")
        RECORDER.miss("variable", name)
        return unknown_text(f"the variable {name}")


class PathJoinSubstitution(Worded):
    def preflight_take(self, given: Any, left: Any) -> None:
        self._words(*given.substitutions)

    @property
    def substitutions(self) -> list[Parts]:
        return list(self.words)

    def __truediv__(self, more: Any) -> PathJoinSubstitution:
        return PathJoinSubstitution([*self.words, more])

    def perform(self, context: LaunchContext) -> str:
        return os.path.join(*(self._text(context, i) for i in range(len(self.words))))


class PathSubstitution(PathJoinSubstitution):
    """`PathSubstitution(share) / "launch"`, of a launch newer than 3.7."""

    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__([given.path])


class Command(Worded):
    def perform(self, context: LaunchContext) -> str:
        line = self._text(context, 0)
        words = shlex.split(line)
        found = shutil.which(words[0]) if words else None
        if found is None and words[:1] == ["xacro"]:
            return _own_xacro(words[1:])
        if found is None:
            raise SubstitutionFailure(f"executable '{words[0] if words else ''}' not found on the PATH")
        done = subprocess.run([found, *words[1:]], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SubstitutionFailure(f"executed command failed. Command: {line}")
        if done.stderr and self._text(context, 1) == "fail":
            raise SubstitutionFailure(f"executed command showed stderr output. Command: {line}")
        return done.stdout


def _own_xacro(words: list[str]) -> str:
    """What `xacro` prints, where there is no such program."""
    xacro = importlib.import_module("xacro")
    path, *given = [word for word in words if not word.startswith("-")]
    document = xacro.process_file(path, mappings=dict(each.split(":=", 1) for each in given if ":=" in each))
    return str(document.toprettyxml(indent="  "))


class PythonExpression(Worded):
    def preflight_take(self, given: Any, left: Any) -> None:
        expression, modules = given.expression, given.python_modules
        ensure_argument_type(
            expression, (str, Substitution, collections.abc.Iterable), "expression", "PythonExpression"
        )
        modules = [modules] if isinstance(modules, str) else list(modules)
        joined: list[Any] = []
        for module in modules:
            joined += [", "] if joined else []
            joined += normalize_to_list_of_substitutions(module)
        self._words(expression, joined)

    @property
    def expression(self) -> Parts:
        return self.words[0]

    def perform(self, context: LaunchContext) -> str:
        names = [name.strip() for name in self._text(context, 1).split(",")]
        values: Any = {name: importlib.import_module(name) for name in names if name}
        if "math" in values:
            values.update({k: v for k, v in vars(math).items() if not k.startswith("__")})
        return str(eval(self._text(context, 0), {}, values))  # noqa: S307 - what launch does, in the sandbox


class ThisLaunchFileDir(Worded):
    def perform(self, context: LaunchContext) -> str:
        return os.path.dirname(ThisLaunchFile().perform(context))


class ThisLaunchFile(Worded):
    def perform(self, context: LaunchContext) -> str:
        return str(context.get_locals_as_dict().get("current_launch_file_path", RECORDER.file))


class LaunchLogDir(Worded):
    def perform(self, context: LaunchContext) -> str:
        return os.environ.get("ROS_LOG_DIR", "/tmp")  # noqa: S108


class AnonName(Worded):
    def perform(self, context: LaunchContext) -> str:
        name = self._text(context, 0)
        return str(context.launch_configurations.setdefault("anon" + name, name + "_ANON1"))


class FindExecutable(Worded):
    def perform(self, context: LaunchContext) -> str:
        found = shutil.which(self._text(context, 0))
        if found is None and self._text(context, 0) == "xacro":
            return "xacro"
        if found is None:
            raise SubstitutionFailure(f"executable '{self._text(context, 0)}' not found on the PATH")
        return found


class FileContent(Worded):
    def perform(self, context: LaunchContext) -> str:
        with open(self._text(context, 0)) as file:
            return file.read()


class LocalSubstitution(Worded):
    def preflight_take(self, given: Any, left: Any) -> None:
        ensure_argument_type(given.expression, str, "expression", "LocalSubstitution")
        self.__expression = given.expression
        self._words(given.expression)

    @property
    def expression(self) -> str:
        return str(self.__expression)

    def perform(self, context: LaunchContext) -> str:
        return str(eval("context.locals." + self.__expression, {}, {"context": context}))  # noqa: S307 - as launch


class StringJoinSubstitution(Worded):
    """Of Kilted, as `ForEachVar` and `ForLoopIndex`."""

    def preflight_take(self, given: Any, left: Any) -> None:
        self._words(given.delimiter, *given.substitutions)

    @property
    def substitutions(self) -> list[Parts]:
        return list(self.words[1:])

    @property
    def delimiter(self) -> Parts:
        return self.words[0]

    def perform(self, context: LaunchContext) -> str:
        return self._text(context, 0).join(self._text(context, i) for i in range(1, len(self.words)))


class ForEachVar(Worded):
    @classmethod
    def get_local_arg_name(cls, name: str) -> str:
        return f"ForEachVar__{name}"

    def perform(self, context: LaunchContext) -> str:
        name = self._text(context, 0)
        known = context.get_locals_as_dict()
        if self.get_local_arg_name(name) in known:
            return str(known[self.get_local_arg_name(name)])
        if len(self.words) == 2:
            return self._text(context, 1)
        raise RuntimeError(f"No value available for {type(self).__name__} '{name}' and no default value provided")


class ForLoopIndex(ForEachVar):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(given.name)


class Written(Worded):
    """A text with `$(...)` in it, which the host reads."""

    preflight_kind = "written"

    def __init__(self, text: str) -> None:
        self._words(text)

    def perform(self, context: LaunchContext) -> str:
        raise NotHereError("a substitution that is written as a text is performed when it is launched")
