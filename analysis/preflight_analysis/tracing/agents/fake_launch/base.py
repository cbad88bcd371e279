"""What everything else is made of: entities, substitutions, the context, and the place at which each was made."""

from __future__ import annotations

import collections.abc
import functools
import itertools
import os
import sys
import types
from typing import TYPE_CHECKING, Any, Iterable, Optional

from ..anything import Anything, marked, unknown_text
from . import api
from .answers import Answers

OURS = os.path.dirname(os.path.abspath(__file__))
_AGENTS = os.path.dirname(OURS) + os.sep
_STANDARD_LIBRARY = os.path.dirname(os.path.abspath(os.__file__)) + os.sep
_STEPS = 200
"""How far up the stack to look for the launch file."""
_PARTS = 10_000
_PACKAGE = __name__.rpartition(".")[0]


class NotHereError(RuntimeError):
    """Only a launch that goes on can say: it is no error of the file's."""


class Recorder:
    """What the run remembers. `file` is the launch file; whatever is made gets a number, in order."""

    def __init__(self) -> None:
        self.file = ""
        self.folder = ""
        self.count = itertools.count(1)
        self.made: dict[int, Any] = {}
        self.packages: dict[str, str] = {}
        self.positions: dict[Any, list[tuple[Any, ...]]] = {}
        self.missed: dict[tuple[str, str], Any] = {}
        self.assumed: frozenset[str] = frozenset()
        """Variables of the environment that are not set where the file is launched, and have a likely value here."""
        self.assumed_in: dict[str, Any] = {}
        """Those of them that the file asks for, each where it does so first."""
        self.guessed: dict[tuple[str, int], Any] = {}
        """Where the file asks whether something holds that is not known, by what that is and the line."""
        self.unmatched: list[list[Any]] = []
        """What `RewrittenYaml` and the like are to replace and did not find, each with its line."""
        self.absent: dict[Any, str] = {}
        """What a function of the file looked for last and did not find, a path, a pattern or a program, by its code."""
        self.answers = Answers()
        self.own_xacro = ""
        """The folder of the module that is used where ROS has none."""
        self.descriptions: dict[str, Any] = {}
        """What is known of robot descriptions in packages that are not here (`skeletons.Skeletons`)."""
        self.written: dict[int, tuple[Any, list[int]]] = {}
        """Texts by `id`, with the places of the expressions that made them, where a launch file is read and not run."""
        self.unknown = False
        """Whether something that the file is given is not known."""
        self.none: dict[str, Any] = {}
        """Variables of the environment that are not set, for which a program got `None`, with the place."""
        self.reads: Any = None
        """What notes what is read (`reads.Reads`), while something does."""
        self.last_reads: Any = None

    def begin(self) -> None:
        """A further call begins: the answers to those before tell what was missed in them."""
        self.missed.clear()
        self.assumed_in.clear()
        self.guessed.clear()
        self.unmatched.clear()
        self.absent.clear()
        self.answers.begin_part()

    def miss(self, what: str, name: str) -> None:
        """Note a module or package that is not here, where it is asked for first."""
        self.missed.setdefault((what, name), self.place())
        self.unknown = True

    def in_place_of_none(self, value: Any) -> Any:
        """What a program writes into a text: `None` is there for a variable that this machine does not have."""
        if value is not None or not self.none:
            return value
        variable, place = next(iter(self.none.items()))
        self.missed.setdefault(("none", variable), place)
        self.unknown = True
        return unknown_text(f"the variable {variable}")

    def asks_for(self, variable: Any, frame: Any) -> None:
        """Note that a program asks for a variable of the environment, where its value is but assumed."""
        if variable in self.assumed and is_own(frame):
            self.assumed_in.setdefault(variable, self.place_of(frame))

    def looks_for(self, path: Any, found: Any, frame: Any) -> None:
        """Note what a program looked for, where it did not find it."""
        if not found and is_own(frame) and isinstance(path, (str, os.PathLike)):
            self.absent[frame.f_code] = str(path)

    def guess(self, name: str, frame: Any, answer: bool) -> bool:
        """Note that a program goes on in one way of several, as it asks for something that is not known; the answer
        that it gets."""
        if not is_own(frame):
            return answer
        self.note_guess(name, frame)
        return self.answers.choose(frame, answer)

    def note_guess(self, name: str, frame: Any) -> None:
        """Note alone that what a program does from here on depends on something that is not known."""
        place = self.place_of(frame)
        self.guessed.setdefault((str(name), place[0] if place is not None else 0), place)

    def place(self) -> Optional[list[int]]:
        """Line and column (-1: not known) in the launch file of the call that is going on."""
        return self.place_of(sys._getframe(2))

    def place_of(self, frame: Any) -> Optional[list[int]]:
        """That of the call that leads to a frame."""
        for _ in range(_STEPS):
            if frame.f_code.co_filename == self.file:
                return self._position(frame)
            if frame.f_back is None:
                return None
            frame = frame.f_back
        return None

    def _position(self, frame: Any) -> list[int]:
        code = frame.f_code
        if hasattr(code, "co_positions"):
            known = self.positions.get(code)
            if known is None:
                known = self.positions[code] = list(code.co_positions())
            line, _, column, _ = known[frame.f_lasti // 2]
            if line is not None:
                return [line, -1 if column is None else column]
        return [frame.f_lineno, -1]


RECORDER = Recorder()


def is_own(frame: Any) -> bool:
    """Whether a frame is of the launch file or of what belongs to it: not ours, and no library's."""
    return is_own_file(frame.f_code.co_filename)


def is_own_file(file: str) -> bool:
    """Whether code of a file is."""
    return not file.startswith((_AGENTS, _STANDARD_LIBRARY, "<frozen")) and "-packages" + os.sep not in file


def caller() -> Any:
    """The frame of the code that is not ours."""
    frame: Any = sys._getframe(1)
    while frame.f_back is not None and frame.f_code.co_filename.startswith(OURS):
        frame = frame.f_back
    return frame


class Made:
    """Whatever remembers where it was made.

    What `api` declares gets its `__init__` from there. That hands what is given to `preflight_take` of the same class,
    with what is left for the class above; where the class has none, what is given is kept.
    """

    preflight_id = 0
    preflight_place: Optional[list[int]] = None
    preflight_call = api.Call("")
    preflight_given: dict[str, Any] = {}
    """What was kept, by the parameters."""
    preflight_flags: tuple[str, ...] = ()
    """Parameters that take a truth value as it is, beside a text."""

    if TYPE_CHECKING:

        def __init__(self, *args: Any, **kwargs: Any) -> None: ...

    def __init_subclass__(cls, declared: str = "", **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        call = api.BY_SHORT_NAME.get(cls.__name__) if cls.__module__.startswith(_PACKAGE) else None
        if call is not None:
            cls.preflight_call = call = next((each for each in api.CALLS if each.name == declared), call)
            if not call.inherits:
                _declare(cls, call)

    def preflight_keep(self, given: dict[str, Any]) -> None:
        flags = {name for name in self.preflight_flags if isinstance(given[name], bool)}
        self.preflight_given = {
            name: value if name in flags else normalize_to_list_of_substitutions(value) for name, value in given.items()
        }

    def __new__(cls, *args: Any, **kwargs: Any) -> Any:
        self = super().__new__(cls)
        self.preflight_id = next(RECORDER.count)
        self.preflight_place = RECORDER.place()
        RECORDER.made[self.preflight_id] = self
        return self

    def __repr__(self) -> str:
        # Without the address, which is another one in each run: a launch file may make a text of it by mistake.
        return f"<{type(self).__name__} object>"


def _declare(cls: Any, call: api.Call) -> None:
    """Give a class the `__init__` that is declared, by a `def`: so Python says what is wrong with a call."""
    take = vars(cls).get("preflight_take")
    more = call.takes.partition("**")[2]

    def made(self: Any, given: dict[str, Any]) -> None:
        del given["self"]
        left = given.pop(more, None)
        if take is not None:
            take(self, types.SimpleNamespace(**given), left)
            return
        if left is not None:
            super(cls, self).__init__(**left)
        self.preflight_keep(given)

    names: dict[str, Any] = {"made": made, "__name__": cls.__module__}
    exec(compile(f"def __init__(self, {call.takes}): made(self, locals())", __file__, "exec"), names)  # noqa: S102
    cls.__init__ = init = names["__init__"]
    init.__qualname__ = f"{cls.__name__}.__init__"
    if take is None:
        for name in init.__code__.co_varnames[1 : init.__code__.co_argcount + init.__code__.co_kwonlyargcount]:
            setattr(cls, name, property(functools.partial(_given, name)))


def _given(name: str, made: Any) -> Any:
    return made.preflight_given[name]


def ours(cls: type) -> type:
    """The class of this package that a class is, or is made from."""
    return next(c for c in cls.__mro__ if c.__module__.startswith(_PACKAGE))


def overrides(thing: Any, method: str) -> bool:
    """Whether the user's own class says what `method` does."""
    return getattr(type(thing), method) is not getattr(ours(type(thing)), method)


class LaunchDescriptionEntity(Made):
    def describe(self) -> str:
        return type(self).__name__ + "(...)"

    def describe_sub_entities(self) -> list[Any]:
        return []

    def describe_conditional_sub_entities(self) -> list[Any]:
        return []

    def get_sub_entities(self) -> list[Any]:
        return []

    def visit(self, context: Any) -> Any:
        return None

    def get_asyncio_future(self) -> Any:
        return None


class Substitution(Made):
    def describe(self) -> str:
        return type(self).__name__

    def perform(self, context: Any) -> str:
        return type(self).__name__


class TextSubstitution(Substitution):
    def preflight_take(self, given: Any, left: Any) -> None:
        text = str(given.text) if isinstance(given.text, Anything) else given.text
        if not isinstance(text, str):
            raise TypeError(f"TextSubstitution expected Text object got '{type(text)}' instead.")
        self.__text = text

    @property
    def text(self) -> str:
        return self.__text

    def describe(self) -> str:
        return f"'{self.text}'"

    def perform(self, context: LaunchContext) -> str:
        return self.text


SomeSubstitutionsType_types_tuple = (str, Substitution, collections.abc.Iterable)


class Condition(Made):
    def preflight_take(self, given: Any, left: Any) -> None:
        self._predicate = given.predicate

    def describe(self) -> str:
        return type(self).__name__

    def evaluate(self, context: Any) -> bool:
        if self._predicate is None:
            return False
        return bool(self._predicate(context))


class Action(LaunchDescriptionEntity):
    def preflight_take(self, given: Any, left: Any) -> None:
        self.__condition: Optional[Condition] = given.condition

    @staticmethod
    def parse(entity: Any, parser: Any) -> Any:
        return Action, {}

    @property
    def condition(self) -> Optional[Condition]:
        return self.__condition

    def visit(self, context: Any) -> Any:
        condition = self.condition
        return self.execute(context) if condition is None or condition.evaluate(context) else None

    def execute(self, context: Any) -> Any:
        """Of an action that the user's own one derives from: what that does besides is told, and then itself."""
        context.preflight_executed.append(self)
        return None

    def preflight_serialize(self, t: Any) -> None:
        names = {parameter: attribute for attribute, parameter in self.preflight_call.attributes.items()}
        for name, value in self.preflight_given.items():
            t.attribute(names.get(name, name), value)


class LaunchDescription(LaunchDescriptionEntity):
    def preflight_take(self, given: Any, left: Any) -> None:
        self.__entities = list(given.initial_entities) if given.initial_entities is not None else []
        self.__deprecated_reason = given.deprecated_reason

    def visit(self, context: Any) -> Any:
        return self.__entities

    def describe_sub_entities(self) -> list[Any]:
        return self.__entities

    def get_launch_arguments(self, conditional_inclusion: bool = False) -> list[Any]:
        return [e for e in self.__entities if type(e).__name__ == "DeclareLaunchArgument"]

    def preflight_serialize(self, t: Any) -> None:
        t.entities(self.entities)

    @property
    def entities(self) -> list[Any]:
        return self.__entities

    def add_entity(self, entity: Any) -> None:
        self.entities.append(entity)

    def add_action(self, action: Any) -> None:
        self.add_entity(action)

    @property
    def deprecated(self) -> bool:
        return self.__deprecated_reason is not None

    @property
    def deprecated_reason(self) -> Any:
        return self.__deprecated_reason


class _Locals:
    def __init__(self, values: dict[str, Any]) -> None:
        self.__dict__.update(values)

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(f"context.locals does not contain attribute '{name}'")


class LaunchContext:
    """The context that opaque functions and substitutions get."""

    def __init__(self, *, argv: Optional[Iterable[str]] = None, noninteractive: bool = False) -> None:
        self.argv = list(argv or ())
        self.noninteractive = noninteractive
        self.launch_configurations: dict[str, Any] = {}
        self.preflight_executed: list[Any] = []
        self.is_shutdown = False
        self.asyncio_loop: Any = None
        self._event_handlers: list[Any] = []
        self.__globals: dict[str, Any] = {}
        self.__locals: dict[str, Any] = {}
        self.__stack: list[Any] = []

    @property
    def environment(self) -> Any:
        return os.environ

    @property
    def locals(self) -> Any:
        return _Locals(self.get_locals_as_dict())

    def get_locals_as_dict(self) -> dict[str, Any]:
        if RECORDER.reads is not None:
            RECORDER.reads.file = True
        return {**self.__globals, **self.__locals}

    def extend_globals(self, extensions: dict[str, Any]) -> None:
        self.__globals.update(extensions)

    def extend_locals(self, extensions: dict[str, Any]) -> None:
        self.__locals.update(extensions)

    def add_completion_future(self, completion_future: Any) -> None:
        return None

    def register_event_handler(self, event_handler: Any, append: bool = False) -> None:
        self._event_handlers.append(event_handler)

    def unregister_event_handler(self, event_handler: Any) -> None:
        if event_handler in self._event_handlers:
            self._event_handlers.remove(event_handler)

    def would_handle_event(self, event: Any) -> bool:
        return False

    def emit_event_sync(self, event: Any) -> None:
        return None

    async def emit_event(self, event: Any) -> None:
        return None

    def perform_substitution(self, substitution: Substitution) -> str:
        return substitution.perform(self)

    def _push_launch_configurations(self) -> None:
        self.__stack.append(dict(self.launch_configurations))

    def _pop_launch_configurations(self) -> None:
        self.launch_configurations = self.__stack.pop()


class Event:
    name = "launch.Event"


def ensure_argument_type(argument: Any, types: Any, argument_name: str, caller: Optional[str] = None) -> None:
    """Raise `TypeError` as launch does; a stand-in may be of any type."""
    if isinstance(argument, Anything):
        return
    allowed = tuple(types) if isinstance(types, collections.abc.Iterable) else (types,)
    if not isinstance(argument, allowed):
        where = "" if caller is None else f"{caller} "
        named = " or ".join(str(t) for t in allowed)
        raise TypeError(
            f"{where}Expected '{argument_name}' to be of type '{named}' but got '{argument}' of type '{type(argument)}'"
        )


def normalize_to_list_of_substitutions(subs: Any) -> list[Substitution]:
    def one(x: Any) -> Substitution:
        if isinstance(x, Substitution):
            return x
        if isinstance(x, str):
            return TextSubstitution(text=x)
        if isinstance(x, os.PathLike):  # a stand-in is one too
            return TextSubstitution(text=os.fspath(x))
        raise TypeError(
            f"Failed to normalize given item of type '{type(x)}', "
            "when only 'str' or 'launch.Substitution' were expected."
        )

    if isinstance(subs, (str, Substitution, os.PathLike)):
        return [one(subs)]
    if isinstance(subs, collections.abc.Iterable):
        return [one(x) for x in itertools.islice(subs, _PARTS)]
    return [one(subs)]


def normalize_to_list_of_entities(entities: Any) -> list[Any]:
    flat: list[Any] = []
    for entity in entities:
        if isinstance(entity, LaunchDescriptionEntity):
            flat.append(entity)
        else:
            flat.extend(normalize_to_list_of_entities(entity))
    return flat


def perform_substitutions(context: LaunchContext, subs: Iterable[Substitution]) -> str:
    performed = (context.perform_substitution(sub) for sub in subs)
    text: str = marked("".join([str(part) if isinstance(part, Anything) else part for part in performed]))
    return text


def is_a(obj: Any, entity_type: type) -> bool:
    return isinstance(obj, entity_type)


def is_a_subclass(obj: Any, entity_type: type) -> bool:
    if isinstance(obj, entity_type):
        return True
    return isinstance(obj, type) and issubclass(obj, entity_type)


def isclassinstance(obj: Any) -> bool:
    return hasattr(obj, "__class__")
