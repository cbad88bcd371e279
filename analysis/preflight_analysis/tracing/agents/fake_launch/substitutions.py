"""The other ones of `launch.substitutions`."""

from __future__ import annotations

import collections.abc
import importlib
import math
import os
import shlex
import shutil
import subprocess
from typing import Any, Optional

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
    command = "var"

    def __init__(self, variable_name: Any, *, default: Any = None) -> None:
        ensure_argument_type(
            variable_name, (str, Substitution, collections.abc.Iterable), "variable_name", "LaunchConfiguration"
        )
        if default is None:
            self._words(variable_name)
            return
        if isinstance(default, collections.abc.Iterable) and not isinstance(default, str):
            default = [x if isinstance(x, Substitution) else str(x) for x in default]
        elif not isinstance(default, Substitution):
            default = str(default)
        self._words(variable_name, default)

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


class _WithDefault(Worded):
    """A name, and the text where nothing has it."""

    def __init__(self, name: Any, *, default_value: Any = None) -> None:
        self._words(*((name,) if default_value is None else (name, default_value)))

    @property
    def name(self) -> Parts:
        return self.words[0]

    @property
    def default_value(self) -> Optional[Parts]:
        return self.words[1] if len(self.words) == 2 else None


class EnvironmentVariable(_WithDefault):
    command = "env"

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
    command = "path-join"

    def __init__(self, substitutions: Any) -> None:
        self._words(*substitutions)

    @property
    def substitutions(self) -> list[Parts]:
        return list(self.words)

    def __truediv__(self, more: Any) -> PathJoinSubstitution:
        return PathJoinSubstitution([*self.words, more])

    def perform(self, context: LaunchContext) -> str:
        return os.path.join(*(self._text(context, i) for i in range(len(self.words))))


class PathSubstitution(PathJoinSubstitution):
    """`PathSubstitution(share) / "launch"`, of a launch newer than 3.7."""

    def __init__(self, path: Any) -> None:
        super().__init__([path])


class Command(Worded):
    command = "command"

    def __init__(self, command: Any, *, on_stderr: Any = "fail") -> None:
        self._words(command, on_stderr)

    @property
    def on_stderr(self) -> Parts:
        return self.words[1]

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
    command = "eval"

    def __init__(self, expression: Any, python_modules: Any = ("math",)) -> None:
        ensure_argument_type(
            expression, (str, Substitution, collections.abc.Iterable), "expression", "PythonExpression"
        )
        modules = [python_modules] if isinstance(python_modules, str) else list(python_modules)
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
    command = "dirname"

    def __init__(self) -> None:
        self._words()

    def perform(self, context: LaunchContext) -> str:
        return os.path.dirname(ThisLaunchFile().perform(context))


class ThisLaunchFile(Worded):
    command = "filename"

    def __init__(self) -> None:
        self._words()

    def perform(self, context: LaunchContext) -> str:
        return str(context.get_locals_as_dict().get("current_launch_file_path", RECORDER.file))


class LaunchLogDir(Worded):
    command = "launch_log_dir"

    def __init__(self) -> None:
        self._words()

    def perform(self, context: LaunchContext) -> str:
        return os.environ.get("ROS_LOG_DIR", "/tmp")  # noqa: S108


class AnonName(Worded):
    command = "anon"

    def __init__(self, name: Any) -> None:
        self._words(name)

    @property
    def name(self) -> Parts:
        return self.words[0]

    def perform(self, context: LaunchContext) -> str:
        name = self._text(context, 0)
        return str(context.launch_configurations.setdefault("anon" + name, name + "_ANON1"))


class FindExecutable(Worded):
    command = "find-exec"

    def __init__(self, *, name: Any) -> None:
        self._words(name)

    @property
    def name(self) -> Parts:
        return self.words[0]

    def perform(self, context: LaunchContext) -> str:
        found = shutil.which(self._text(context, 0))
        if found is None and self._text(context, 0) == "xacro":
            return "xacro"
        if found is None:
            raise SubstitutionFailure(f"executable '{self._text(context, 0)}' not found on the PATH")
        return found


class FileContent(Worded):
    command = "file-content"

    def __init__(self, path: Any) -> None:
        self._words(path)

    def perform(self, context: LaunchContext) -> str:
        with open(self._text(context, 0)) as file:
            return file.read()


class LocalSubstitution(Worded):
    command = "local"

    def __init__(self, expression: str, description: Optional[str] = None) -> None:
        ensure_argument_type(expression, str, "expression", "LocalSubstitution")
        self.__expression = expression
        self._words(expression)

    @property
    def expression(self) -> str:
        return self.__expression

    def perform(self, context: LaunchContext) -> str:
        return str(eval("context.locals." + self.__expression, {}, {"context": context}))  # noqa: S307 - as launch


class StringJoinSubstitution(Worded):
    """Of Kilted, as `ForEachVar` and `ForLoopIndex`."""

    command = "string-join"

    def __init__(self, substitutions: Any, delimiter: Any = "") -> None:
        self._words(delimiter, *substitutions)

    @property
    def substitutions(self) -> list[Parts]:
        return list(self.words[1:])

    @property
    def delimiter(self) -> Parts:
        return self.words[0]

    def perform(self, context: LaunchContext) -> str:
        return self._text(context, 0).join(self._text(context, i) for i in range(1, len(self.words)))


class ForEachVar(_WithDefault):
    command = "for-var"

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
    command = "index"

    def __init__(self, name: Any, **kwargs: Any) -> None:
        super().__init__(name)


class Written(Worded):
    """A text with `$(...)` in it, which the host reads."""

    command = "written"

    def __init__(self, text: str) -> None:
        self._words(text)

    def perform(self, context: LaunchContext) -> str:
        raise NotHereError("a substitution that is written as a text is performed when it is launched")
