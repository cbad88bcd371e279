"""What the quick fix of a rule about the language makes of one tag."""

from support.check import apply, findings_of


def fixed(tag: str, rule: str, fix: int = 0) -> str:
    """The tag, alone in a launch file, after a fix of the only finding of that rule."""
    text = f"<launch>{tag}</launch>"
    (finding,) = [finding for finding in findings_of(text) if finding.rule == rule]
    after = apply(text, finding.fixes[fix].edits)["/main.launch"]
    return after.removeprefix("<launch>").removesuffix("</launch>\n")


def unfixable(tag: str, rule: str) -> bool:
    """Whether the only finding of that rule has no fix."""
    (finding,) = [finding for finding in findings_of(f"<launch>{tag}</launch>") if finding.rule == rule]
    return finding.fixes == ()
