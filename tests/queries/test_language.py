"""Tags and attributes explain themselves."""

from __future__ import annotations

from preflight_analysis.queries.hover import hover
from support.query_harness import at_cursor


def told(text: str) -> tuple[str, str] | None:
    """The text, and what it speaks of."""
    there = at_cursor(text)
    found = hover((there.analysis,), there.file, there.offset)
    return (found.markdown, there.text(found.span)) if found else None


def test_tags_and_attributes_without_anything_else_to_say() -> None:
    assert told("<launch><gro$0up ns='x'/></launch>") == (
        "`<group>` Tags that share a namespace, a condition, and remaps, environment and arguments of their own.",
        "group",
    )
    assert told("<launch><machine name='a' address='b' default='never' time$0out='1'/></launch>") == (
        "`timeout`: Seconds to wait for a node to start.\n\nDefault: `10`.",
        "timeout",
    )
    assert told("<launch><arg na$0me='a'/></launch>") == (
        "`name` (required): The name of the argument, for `$(arg name)`.",
        "name",
    )


def test_behind_what_is_known_of_the_place() -> None:
    found = told("<launch><node pkg='p' type='t' name='n' out$0put='log'/></launch>")
    assert found is not None
    assert found[0].startswith("**/n** `p/t`")
    assert found[0].endswith(
        "\n\n---\n\n`output`: Where the node's output goes.\n\nOne of `log`, `screen`.\n\nDefault: `log`."
    )


def test_half_typed_and_unknown_ones() -> None:
    found = told("<launch>\n  <node pk$0g=\n</launch>")
    assert found is not None and "The package of the node." in found[0]
    assert told("<launch><nonsense$0/></launch>") is None
    assert told("<launch><group non$0sense='x'/></launch>") is None
    assert told("<launch>\n$0\n</launch>") is None
