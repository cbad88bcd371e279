"""What a rule costs grows with the launch, not with its square: they run on each keystroke. Calls are counted, not
time."""

from __future__ import annotations

import cProfile
import json
import pstats

from preflight_analysis.model.context import Context
from preflight_analysis.rules.registry import all_rules, run_rules
from support.check import analyse, read_fixture

KINDS = 5
NODE = """<node pkg="p" exec="e{kind}" name="n{kind}" namespace="r{robot}"><param from="/p.yaml"/>
<param name="rate" value="{robot}"/><remap from="scan" to="/shared"/></node>"""


def _launch(robots: int) -> Context:
    """Robots whose nodes all share topics, are out of range, and have names that a lifecycle manager misspells."""
    pairs = [(robot, kind) for robot in range(robots) for kind in range(KINDS)]
    nodes = "\n".join(NODE.format(robot=robot, kind=kind) for robot, kind in pairs)
    names = [f"r{robot}/m{kind}" for robot, kind in pairs]
    manager = f'<node pkg="p" exec="lifecycle_manager" name="lm"><param name="node_names" value="{names}"/></node>'
    sections = "".join(f"r{robot}:\n  n{kind}:\n    ros__parameters:\n      gains: [1, 2.5]\n" for robot, kind in pairs)
    topics = {"/cmd_vel": "geometry_msgs/msg/Twist", "scan": "std_msgs/msg/String", "own": "std_msgs/msg/String"}
    interfaces = {
        f"/r{robot}/n{kind}": {
            "publishers" if kind % 2 else "subscribers": topics,
            "qos": {"/cmd_vel": {"reliability": "reliable", "durability": "volatile"}},
            "params": {"rate": 5},
            "described": {"rate": {"range": [0, 1]}},
        }
        for robot, kind in pairs
    }
    launch = f"<launch>\n{nodes}\n{manager}\n</launch>"
    files = f"//- /a.launch.xml\n{launch}\n//- /p.yaml\n{sections}//- interfaces\n{json.dumps(interfaces)}\n"
    return analyse(read_fixture(files))


def _calls(context: Context) -> dict[str, int]:
    run_rules(context)  # what is remembered of each file is made once
    counts = {}
    for rule in all_rules():
        profile = cProfile.Profile()
        profile.enable()
        run_rules(context, [rule])
        profile.disable()
        counts[rule.id] = pstats.Stats(profile).total_calls  # type: ignore[attr-defined]
    return counts


def test_no_rule_compares_each_node_with_each() -> None:
    few, many = _calls(_launch(15)), _calls(_launch(60))
    assert {rule: (few[rule], many[rule]) for rule in few if many[rule] > 7 * few[rule]} == {}
