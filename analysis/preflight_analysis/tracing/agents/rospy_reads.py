"""What a rospy node reads: parameters, and its own name, namespace and remaps."""

from __future__ import annotations

import json
from typing import Any, Callable

from . import channel, polling
from .rospy_aspects import Advised, before, caller
from .weaving import in_main_thread

_MAX_DEFAULT = 4_000
_MAX_SITES = 2_000
_reported: set[tuple[Any, ...]] = set()


def _default(value: object) -> object:
    try:
        return value if len(json.dumps(value)) <= _MAX_DEFAULT else repr(value)[:_MAX_DEFAULT]
    except (TypeError, ValueError, RecursionError):
        return repr(value)[:_MAX_DEFAULT]


def polled_parameter(
    access: str, unspecified: object, resolve: Callable[[str], str], watch: polling.Watch
) -> Callable[[Advised], Advised]:
    """A parameter that the main thread asks for again and again until it is set."""

    def aspect(cutpoint: Advised) -> Advised:
        def advised(param_name: Any, default: Any = unspecified) -> Any:
            more = () if default is unspecified else (default,)
            try:
                result = cutpoint(param_name, *more)
            except KeyError:
                if not polled(param_name):
                    raise
                return plausible(param_name)
            if default is not unspecified and default is not None:
                watch.defaults[resolve(str(param_name))] = default
            if (result is False if access == "has" else result is None and default is None) and polled(param_name):
                return True if access == "has" else plausible(param_name)
            return result

        return advised

    def plausible(name: Any) -> Any:
        """What the node itself takes elsewhere, or what can be a rate, a size and a yes."""
        return watch.defaults.get(resolve(str(name)), 1)

    def polled(name: Any) -> bool:
        """Whether a parameter that is not set is to be taken as set."""
        full = resolve(str(name))
        if in_main_thread() and full not in watch.given:
            watch.asked(full, *caller())
        return full in watch.given

    return aspect


def reads_parameter(
    access: str, unspecified: object, resolve: Callable[[str], str], watch: polling.Watch
) -> Callable[[Advised], Advised]:
    """A call that reads or writes a parameter, or asks for some."""

    def report(arguments: dict[str, Any]) -> None:
        file, line, internal = caller()
        name = str(arguments.get("param_name", "/"))
        site = (access, name, file, line)
        if site in _reported or len(_reported) > _MAX_SITES:
            return
        _reported.add(site)
        watch.something_new()
        default = arguments.get("default", unspecified)
        channel.send(
            "param",
            access=access,
            name=name,
            resolved=name if access in ("search", "list") else resolve(name),
            default=None if default is unspecified else _default(default),
            has_default=default is not unspecified,
            file=file,
            line=line,
            builtin=internal,
        )

    return before(report)


def asks_for(*what: str) -> Callable[[Advised], Advised]:
    """The node looks at its own name, namespace or remaps: what it does may depend on them."""

    def report(_arguments: dict[str, Any]) -> None:
        if what not in _reported and not caller()[2]:
            _reported.add(what)
            for one in what:
                channel.send("asked", what=one)

    return before(report)
