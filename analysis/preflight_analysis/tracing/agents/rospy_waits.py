"""Waits of a rospy node for others, and calls of services that nobody offers, which are answered (`mock_replies`)."""

from __future__ import annotations

import inspect
from typing import Any, Callable

from . import channel, mock_replies, polling
from .rospy_aspects import Advised, caller
from .weaving import in_main_thread, quiet


def waits(
    rospy: Any,
    flush: Callable[[], None],
    watch: polling.Watch,
    kind: str,
    argument: str,
    answer: Callable[[dict[str, Any]], Any],
) -> Callable[[Advised], Advised]:
    """The node blocks until somebody else is there; if nobody comes, `answer(bound arguments)` is returned."""

    @quiet
    def report(state: str, name: str) -> None:
        file, line, _ = caller()
        channel.send("state", state=state, kind=kind, name=name, file=file, line=line, main=in_main_thread())
        if in_main_thread():
            watch.waits(1 if state == "wait" else -1)
        if state == "wait":
            flush()

    def aspect(cutpoint: Advised) -> Advised:
        signature = inspect.signature(cutpoint)

        def advised(*args: Any, **kwargs: Any) -> Any:
            try:
                bound = signature.bind(*args, **kwargs)
                name = str(bound.arguments[argument])
            except TypeError:
                return cutpoint(*args, **kwargs)
            report("wait", name)
            try:
                by_itself, result = mock_replies.limited(
                    cutpoint, bound, rospy.ROSInterruptException, rospy.ROSException
                )
                if by_itself:
                    return result
                mock_replies.made_up(kind, name)
                return answer(bound.arguments)
            finally:
                report("resume", name)

        return advised

    return aspect


def calls_service(refused: Any) -> Callable[[Advised], Advised]:
    """A call of a service that nobody offers."""

    def aspect(cutpoint: Advised) -> Advised:
        def advised(self: Any, *args: Any, **kwargs: Any) -> Any:
            try:
                return cutpoint(self, *args, **kwargs)
            except refused as error:
                service = self.resolved_name
                if not str(error).endswith("unavailable") or not mock_replies.call_is_answered(service, *caller()):
                    raise
                return mock_replies.empty(self.response_class)

        return advised

    return aspect
