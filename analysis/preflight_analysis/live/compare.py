"""The running system beside the expected one.

What is not known is not held against the system: of a node of which nothing is known only its presence is judged, an
end that is not sure to be made may be missing, and an end is extra only where all ends of its node are known, and then
for information.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace

from preflight_analysis.dataclass import dataclass
from preflight_analysis.generation import ros
from preflight_analysis.graph.actions import actions_of
from preflight_analysis.live.model import (
    Comparison,
    Expected,
    ExpectedEndpoint,
    ExpectedNode,
    Issue,
    LiveEndpoint,
    LiveNode,
    Observation,
    State,
    is_builtin,
)
from preflight_analysis.model.fit import in_short
from preflight_analysis.model.nearest import nearest
from preflight_analysis.tracing.interface import Endpoint, Role

_ANONYMOUS = re.compile(r"([^/]+?)_ANON\d+")
_ANONYMOUS_TAIL = r"_\w+_\d+_\d+"
"""What roslaunch and launch_ros put behind an anonymous name: host, process and a number."""
_INFRASTRUCTURE = {
    1: re.compile(r"/rosout\Z|.*/ros_preflight_watch"),
    # What a listener to transforms makes for itself, `ros2 launch` itself, and hidden ones: `ros2` commands, ours.
    2: re.compile(r".*/(?:transform_listener_impl_\w+|launch_ros_\d+|_[^/]*)\Z"),
}
_TOOLS = re.compile(
    r"(?:.*/)?(?:rviz2?(?:_\w+)?|rqt\w*|rosbag2?_\w+|(?:record|play)_\d+|roswtf_\w+"
    r"|ros(?:topic|service|node|param|run|msg)_\d+_\d+|plotjuggler\w*|foxglove\w*)\Z"
)
"""What people start beside a robot to look at it."""
_COMPARED_QOS = ("reliability", "durability")
_GROUPS: Mapping[str, str] = {
    "publisher": "topics",
    "subscriber": "topics",
    "service": "services",
    "client": "services",
    "action_server": "actions",
    "action_client": "actions",
}
_SEEN_ROLES = {1: frozenset(_GROUPS) - {"client"}, 2: frozenset(_GROUPS)}
"""A master does not know who calls a service."""
_WORSE: tuple[State, ...] = ("unsure", "extra", "present", "missing", "dead", "wrong-type")


@dataclass(slots=True)
class _States:
    """The states of nodes and of what they meet at; the worst of what is said of one counts."""

    nodes: dict[str, State] = field(default_factory=dict)
    topics: dict[str, State] = field(default_factory=dict)
    services: dict[str, State] = field(default_factory=dict)
    actions: dict[str, State] = field(default_factory=dict)

    def say(self, role: str, name: str, state: State) -> None:
        states: dict[str, State] = getattr(self, _GROUPS[role])
        states[name] = max(states.get(name, state), state, key=_WORSE.index)


_LiveEndpoints = dict[tuple[Role, str], list[LiveEndpoint]]


def compare(expected: Expected, live: Observation) -> Comparison:
    """What of `live` is missing, extra or of the wrong type."""
    states = _States()
    issues: list[Issue] = []
    running_as, tokens = matched((node.name for node in expected.nodes), live)
    nodes = [_with_tokens(node, tokens) for node in expected.nodes]
    endpoints: dict[str, _LiveEndpoints] = defaultdict(lambda: defaultdict(list))
    for endpoint in live.endpoints:
        endpoints[endpoint.node][endpoint.role, endpoint.name].append(endpoint)

    owned: dict[str, list[ExpectedNode]] = defaultdict(list)
    for node in nodes:
        running = live.nodes.get(node.name)
        issue = _of_node(node, running)
        if issue is not None:
            issues.append(issue)
        state = _state(issue, running)
        states.nodes[node.name] = state
        if state in ("missing", "dead", "unsure"):
            for expected_endpoint in node.endpoints:
                states.say(
                    expected_endpoint.role, expected_endpoint.name, state if expected_endpoint.certain else "unsure"
                )
        if state == "present":
            if node.by is not None:
                owned[node.by].append(node)
                owned[node.name].append(
                    replace(node, endpoints=tuple(_of_loader(node.endpoints)), complete=False, by=None)
                )
            else:
                owned[node.name].append(node)
    for owner, of_owner in owned.items():
        if states.nodes.get(owner) == "present":
            inactive = live.nodes[owner].inactive
            issues += _of_endpoints(owner, of_owner, endpoints[owner], expected.generation, states, inactive)
    issues += _wrong_topics(nodes, live, states) if ros(expected.generation).has_master else ()
    for name, running in live.nodes.items():
        if running.inactive is not None and states.nodes.get(name) == "present":
            states.nodes[name] = "inactive"
    for issue in issues:
        if issue.counts and states.nodes.get(issue.node) in ("present", "inactive"):
            states.nodes[issue.node] = "differs"
    for issue in issues:
        if issue.kind == "wrong-type":
            states.nodes[issue.node] = "wrong-type"
    issues += _extra_nodes(expected, live, set(running_as.values()), states)
    found = (states.nodes, states.topics, states.services, states.actions)
    return Comparison(tuple(issues), *(_as_listed(each, tokens) for each in found))


def _as_listed(states: Mapping[str, State], tokens: Mapping[str, str]) -> dict[str, State]:
    """With the anonymous parts of names as the tree has them."""

    def listed(name: str) -> str:
        for token, actual in tokens.items():
            name = name.replace(actual, token)
        return name

    return {listed(name): state for name, state in states.items()} if tokens else dict(states)


# Which node is which


def matched(expected: Iterable[str], live: Observation) -> tuple[dict[str, str], dict[str, str]]:
    """Expected names to those that run, and what the anonymous parts of names are in this run."""
    expected = list(expected)
    found = {name: name for name in expected if name in live.nodes}
    tokens: dict[str, str] = {}
    for wanted in expected:
        if wanted in found or not _ANONYMOUS.search(wanted):
            continue
        places = list(_ANONYMOUS.finditer(wanted))
        pattern, at = "", 0
        for place in places:
            known = tokens.get(place[0])
            part = re.escape(known) if known is not None else re.escape(place[1]) + _ANONYMOUS_TAIL
            pattern += re.escape(wanted[at : place.start()]) + f"({part})"
            at = place.end()
        pattern += re.escape(wanted[at:]) + r"\Z"
        taken = set(found.values())
        for name in sorted(live.nodes, key=lambda each: (live.nodes[each].dead is not None, each)):
            match = re.match(pattern, name)
            if match and name not in taken:
                found[wanted] = name
                tokens.update((place[0], match[number]) for number, place in enumerate(places, 1))
                break
    return found, tokens


def _with_tokens(node: ExpectedNode, tokens: Mapping[str, str]) -> ExpectedNode:
    """The node and its ends with the anonymous parts of their names as they are in this run."""
    if not tokens:
        return node

    def actual(name: str) -> str:
        return _ANONYMOUS.sub(lambda match: tokens.get(match[0], match[0]), name)

    endpoints = tuple(
        replace(
            endpoint, name=actual(endpoint.name), parts=tuple((role, actual(name)) for role, name in endpoint.parts)
        )
        for endpoint in node.endpoints
    )
    return replace(
        node, name=actual(node.name), endpoints=endpoints, by=actual(node.by) if node.by is not None else None
    )


# Nodes


def _of_node(node: ExpectedNode, running: LiveNode | None) -> Issue | None:
    if running is None:
        sure = node.certain and not node.exits
        return Issue("missing", "node", node.name, actual=node.reason, counts=sure, place=node.place)
    if running.dead is not None:
        return Issue("dead", "node", node.name, actual=running.dead, counts=not node.exits, place=node.place)
    if running.count > 1:
        return Issue("twice", "node", node.name, actual=str(running.count), place=node.place)
    return None


def _state(issue: Issue | None, running: LiveNode | None) -> State:
    if running is None:
        return "missing" if issue is not None and issue.counts else "unsure"
    if running.dead is not None:
        return "dead" if issue is not None and issue.counts else "unsure"
    return "present"


def _extra_nodes(expected: Expected, live: Observation, known: set[str], states: _States) -> Iterator[Issue]:
    loose = [node.name for node in expected.nodes if not node.certain]
    for name, node in sorted(live.nodes.items()):
        if name in known or _INFRASTRUCTURE[live.generation].match(name):
            continue
        counts = expected.complete and not loose and node.dead is None and not _TOOLS.match(name)
        if node.dead is None:
            states.nodes[name] = "extra"
            yield Issue("extra", "node", name, counts=counts)
        else:
            states.nodes[name] = "dead"
            yield Issue("dead", "node", name, actual=node.dead, counts=False)


# Ends


def _of_loader(endpoints: Iterable[ExpectedEndpoint]) -> Iterator[ExpectedEndpoint]:
    """Of a nodelet's ends those that the process which loads it makes itself."""
    return (endpoint for endpoint in endpoints if endpoint.name.endswith(("/bond", "/load_nodelet")))


def _of_endpoints(
    owner: str,
    nodes: Sequence[ExpectedNode],
    endpoints: _LiveEndpoints,
    generation: int,
    states: _States,
    inactive: str | None,
) -> Iterator[Issue]:
    """The ends of a node that runs, and of what it runs for others. `inactive`: the state of a lifecycle node that is
    not active."""
    left = {key: list(found) for key, found in endpoints.items() if not is_builtin(generation, *key)}
    wanted: list[tuple[ExpectedNode, ExpectedEndpoint]] = []
    for node in nodes:
        of_owner = (
            node.endpoints
            if node.by is None
            else [e for e in node.endpoints if e not in tuple(_of_loader(node.endpoints))]
        )
        wanted += ((node, endpoint) for endpoint in of_owner if endpoint.role in _SEEN_ROLES[generation])
    for _, endpoint in wanted:
        for key in endpoint.parts or ((endpoint.role, endpoint.name),):
            left.pop(key, None)
    complete = all(node.complete for node in nodes)
    extra = list(_extra_endpoints(left, generation))
    missing: list[Issue] = []
    for node, endpoint in wanted:
        there = [endpoints.get(key, []) for key in endpoint.parts or ((endpoint.role, endpoint.name),)]
        if not all(there):
            sure = endpoint.certain and inactive is None
            states.say(endpoint.role, endpoint.name, "missing" if sure else "unsure")
            if endpoint.on_demand:
                continue
            missing.append(
                Issue(
                    "missing",
                    endpoint.role,
                    node.name,
                    endpoint.name,
                    expected=endpoint.type,
                    similar=_similar(endpoint, extra),
                    counts=sure,
                    place=endpoint.place,
                    source=endpoint.source,
                    inactive=inactive,
                )
            )
            continue
        issue = _different(node.name, endpoint, there[0], generation)
        states.say(
            endpoint.role,
            endpoint.name,
            "wrong-type" if issue is not None and issue.kind == "wrong-type" else "present",
        )
        if issue is not None:
            yield issue
    yield from missing
    for found in extra:
        states.say(found.role, found.name, "extra")
        if complete:
            place = nodes[0].place
            # Tools subscribe to whatever is there: what is wrong with it is told by what is missing.
            yield Issue("extra", found.role, owner, found.name, actual=found.type, counts=False, place=place)


def _similar(endpoint: ExpectedEndpoint, extra: Sequence[LiveEndpoint]) -> str | None:
    """The end that the node has instead, if one is like it."""
    alike = [
        e.name for e in extra if e.role == endpoint.role and (endpoint.type in (None, "*", e.type) or e.type is None)
    ]
    return nearest(endpoint.name, alike) or (alike[0] if len(alike) == 1 else None)


def _extra_endpoints(left: _LiveEndpoints, generation: int) -> Iterator[LiveEndpoint]:
    """What is there and was not expected; an action of ROS 1 as such."""
    endpoints = [endpoint for found in left.values() for endpoint in found]
    if not ros(generation).native_actions:
        plain = [Endpoint(endpoint.role, endpoint.name, endpoint.type) for endpoint in endpoints]
        of_actions: set[tuple[str, str]] = set()
        for action in actions_of(plain):
            of_actions.update((topic.role, topic.name) for topic in action.parts)
            yield LiveEndpoint(action.endpoint.role, endpoints[0].node, action.endpoint.name, action.endpoint.type)
        endpoints = [endpoint for endpoint in endpoints if (endpoint.role, endpoint.name) not in of_actions]
    yield from sorted(endpoints, key=lambda endpoint: (endpoint.name, endpoint.role))


def _different(node: str, endpoint: ExpectedEndpoint, there: Sequence[LiveEndpoint], generation: int) -> Issue | None:
    """The type and QoS of an end that is there. The types of topics of ROS 1 are compared by topic."""
    types = {each.type for each in there if each.type is not None}
    wanted = endpoint.type
    if wanted is not None and endpoint.parts:
        wanted += "Goal"
    by_topic = ros(generation).has_master and endpoint.role in ("publisher", "subscriber")
    if wanted not in (None, "*") and types and not by_topic and in_short(wanted) not in map(in_short, types):
        actual = " | ".join(sorted(types))
        actual = actual.removesuffix("Goal") if endpoint.parts else actual
        return Issue(
            "wrong-type",
            endpoint.role,
            node,
            endpoint.name,
            endpoint.type,
            actual,
            place=endpoint.place,
            source=endpoint.source,
        )
    for policy in _COMPARED_QOS:
        asked = endpoint.qos.get(policy)
        found = {each.qos[policy] for each in there if policy in each.qos}
        if asked is not None and found and asked not in found:
            actual = f"{policy} {' | '.join(sorted(map(str, found)))}"
            return Issue(
                "wrong-qos",
                endpoint.role,
                node,
                endpoint.name,
                f"{policy} {asked}",
                actual,
                place=endpoint.place,
                source=endpoint.source,
            )
    return None


def _wrong_topics(nodes: Iterable[ExpectedNode], live: Observation, states: _States) -> Iterator[Issue]:
    """A master has one type for each topic, that of whom it heard of last: not all ends need to have it."""
    actual = {
        endpoint.name: endpoint.type for endpoint in live.endpoints if endpoint.role in ("publisher", "subscriber")
    }
    there = {(endpoint.node, endpoint.role, endpoint.name) for endpoint in live.endpoints}
    wanted: dict[str, list[tuple[ExpectedNode, ExpectedEndpoint]]] = defaultdict(list)
    for node in nodes:
        for endpoint in node.endpoints:
            owner = node.by or node.name
            if endpoint.role in ("publisher", "subscriber") and (owner, endpoint.role, endpoint.name) in there:
                wanted[endpoint.name].append((node, endpoint))
    for topic, found in wanted.items():
        types = {endpoint.type for _, endpoint in found if endpoint.type is not None}
        kind = actual.get(topic)
        if kind is None or not types or "*" in (kind, *types) or in_short(kind) in map(in_short, types):
            continue
        states.say("publisher", topic, "wrong-type")
        node, endpoint = min((each for each in found if each[1].type), key=lambda each: each[1].role != "publisher")
        wanted_types = " | ".join(sorted(types))
        yield Issue(
            "wrong-type",
            endpoint.role,
            node.name,
            topic,
            wanted_types,
            kind,
            place=endpoint.place,
            source=endpoint.source,
        )
