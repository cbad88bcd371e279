"""What does not depend on any context, in texts that nobody would write."""

from support.check import findings_of


def test_stray_text_is_looked_for_in_elements_nested_without_end() -> None:
    findings = findings_of(f"<launch>stray{'<group>' * 3000}{'</group>' * 3000}</launch>")
    assert [f.rule for f in findings if f.rule == "LCH028"] == ["LCH028"]
