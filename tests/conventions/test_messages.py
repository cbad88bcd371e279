"""Messages that are worded otherwise than users read them best are found."""

import pytest
from preflight_analysis.documents.span import Location
from preflight_analysis.findings.finding import Finding
from support.messages import wording


@pytest.mark.parametrize(
    ("message", "found"),
    [
        ("'/chater' has no publisher (subscriber: /listener)", []),
        ("duplicate node name '/talker'", []),
        ("no node of this launch does what is necessary for the long remainder of this whole text '/x'", ["no name"]),
        ("'x' is set to 1 here, which does not count", ["'does not count'"]),
        (f"'x' is {'very ' * 30}long", ["a sentence of more than 30 words"]),
        (f"'{'very ' * 30}long' is unused", []),
    ],
)
def test_what_is_wrong_with_a_message(message: str, found: list[str]) -> None:
    finding = Finding("TOP001", "x", "warning", "certain", message, Location.of_file("/r.launch"))
    complaints = list(wording(finding))
    assert len(complaints) == len(found)
    assert all(complaint.startswith(start) for complaint, start in zip(complaints, found, strict=True))
