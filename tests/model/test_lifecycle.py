"""What keeps a lifecycle node from being active: asked of the rule, hover, `why` and the tree."""

from __future__ import annotations

import pytest
from preflight_analysis.queries.hover import hover
from preflight_analysis.queries.node_tree import node_tree
from preflight_analysis.queries.why import chains
from support.query_harness import at_cursor

LAUNCH = """//- /map.launch.xml
<launch>
  {comment}
  <nod$0e pkg="nav2_map_server" exec="map_server" name="map_server"/>
  <node pkg="p" exec="pilot" name="pilot"/>
</launch>
//- /nav2_map_server/package.xml
<package><name>nav2_map_server</name></package>
//- interfaces
{{"/map_server": {{"publishers": {{"/map": "x/Y"}},
   "services": {{"~/change_state": "lifecycle_msgs/srv/ChangeState"}}}},
 "/pilot": {{"subscribers": {{"/map": "x/Y"}}}}}}
"""
REASON = "is never activated by this launch (no lifecycle manager); it does nothing until it is active"


@pytest.mark.parametrize("comment", ["", "<!-- preflight: ignore[LCH035] until we have a manager -->"])
def test_all_who_ask_get_one_answer(comment: str) -> None:
    there = at_cursor(LAUNCH.format(comment=comment))
    analysis = there.analysis
    said = [f.message for f in analysis.findings if f.rule == "LCH035"]
    assert said == ([] if comment else [f"lifecycle node /map_server {REASON}"])
    shown = hover([analysis], there.file, there.offset)
    assert shown is not None
    assert f"The lifecycle node {REASON}" in shown.markdown
    assert analysis.graph is not None
    (chain,) = chains(analysis, analysis.graph, "map_server", "pilot")
    assert chain.broken is not None
    assert (chain.broken.about, chain.broken.text) == ("lifecycle", f"lifecycle node /map_server {REASON}")
    notes = {each.label: each.note for each in node_tree(analysis, {}).items}
    assert notes["map_server"] == f"the lifecycle node {REASON}"
