"""What the end of a container's run tells of the component that it was to load."""

from __future__ import annotations

import pytest
from preflight_analysis.tracing.interface import Outcome
from preflight_analysis.tracing.loaded import outcome_of_component
from preflight_analysis.tracing.records import Gathered

SPINS = Outcome("spinning")
CRASHES = Outcome("crashed", -6, reason="it was killed by SIGABRT")
THROWN = "Component constructor threw an exception: no device"


@pytest.mark.parametrize(
    ("found", "outcome", "status", "reason"),
    [
        (Gathered(loading=True, loaded=""), SPINS, "spinning", None),
        (Gathered(loading=True), CRASHES, "crashed", "it was killed by SIGABRT"),
        (Gathered(loading=True, loaded=THROWN), SPINS, "crashed", "its constructor threw an exception: no device"),
        (Gathered(loading=True, loaded="No."), SPINS, "crashed", "its container did not load it: No."),
        (
            Gathered(loading=True, loaded="Failed to load library: x"),
            SPINS,
            "not-run",
            "it cannot be loaded here: Failed to load library: x",
        ),
        (Gathered(loading=True), SPINS, "not-run", "the answer of its container is not known"),
        (Gathered(), SPINS, "not-run", "its container did not get to load it"),
        (Gathered(), CRASHES, "not-run", "its container did not get to load it: it was killed by SIGABRT"),
    ],
)
def test_how_it_ended(found: Gathered, outcome: Outcome, status: str, reason: str | None) -> None:
    ended = outcome_of_component(found, outcome)
    assert (ended.status, ended.reason) == (status, reason)
