"""What a run of a container tells of the one component that it was to load."""

from __future__ import annotations

from dataclasses import replace

from preflight_analysis.tracing.interface import REASON_COLUMNS, Outcome
from preflight_analysis.tracing.outcome import TAIL_COLUMNS
from preflight_analysis.tracing.records import Gathered

_THROWN = "Component constructor threw an exception: "
_NO_LIBRARY = "Failed to load library"


def outcome_of_component(found: Gathered, outcome: Outcome) -> Outcome:
    """How it ended for the component, where `outcome` is that of the container's process."""
    if outcome.status == "not-run" or found.loaded == "":
        return outcome
    if found.loaded is not None:
        return _refused(found.loaded, outcome)
    if not found.loading:
        # That finding is one of the container, which is run for itself too.
        said = f": {outcome.reason}" if outcome.reason else ""
        return Outcome("not-run", stderr_tail=outcome.stderr_tail, reason=f"its container did not get to load it{said}")
    if outcome.status == "spinning":
        return Outcome("not-run", stderr_tail=outcome.stderr_tail, reason="the answer of its container is not known")
    return outcome


def _refused(why: str, outcome: Outcome) -> Outcome:
    """Its container said why it did not load it."""
    thrown = why.removeprefix(_THROWN)
    tail = (*outcome.stderr_tail, thrown[:TAIL_COLUMNS])
    said = f": {thrown[:REASON_COLUMNS]}"
    if why.startswith(_NO_LIBRARY):
        # What the library needs is not on this machine.
        return Outcome("not-run", stderr_tail=tail, reason=f"it cannot be loaded here{said}")
    how = "its constructor threw an exception" if thrown != why else "its container did not load it"
    return replace(outcome, status="crashed", stderr_tail=tail, reason=how + said)
