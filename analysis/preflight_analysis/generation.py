"""What differs between the generations of ROS, where a word or a flag says it: one object for each.

Where whole modules differ (evaluation, how nodes are run, the launch language, ...) they are in a table by the number
of the generation, in the layer that has them.
"""

from __future__ import annotations

from preflight_analysis.dataclass import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Generation:
    """ROS 1 or ROS 2."""

    number: int
    default_distro: str | None
    """The distribution where the environment names none; of ROS 2 there are many in use."""

    # The launch language
    executable: str
    """The attribute that names the executable of a node."""
    argument: str
    """The substitution for a launch argument."""
    find: str
    """The substitution for the folder of a package."""
    nested_substitutions: bool
    """Whether substitutions can stand in substitutions."""
    shared_configurations: bool
    """Whether what is configured in a file is known in those that it includes, and what they configure after them."""
    deferred_actions: bool
    """Whether actions can wait for timers and other events."""
    first_remap_wins: bool
    """Which of two remaps of one name counts: the first, or the last."""
    remaps_of_nodes: bool
    """Whether a remap can be for one node of a process alone, and change the name of that."""

    # Packages
    ament: bool
    """Whether packages are found by the index of ament, and executables in its prefixes; otherwise it is rospkg, and
    executables may lie in the source."""
    needs_rclpy: bool
    """Whether nodes are run with an interpreter that has rclpy."""

    # Nodes
    has_master: bool
    """Whether there is a master that nodes tell of all their topics, and that knows the types of those."""
    own_parameters: bool
    """Whether parameters are of the nodes that declare them; otherwise a server has them all."""
    nodes_name_themselves: bool
    """Whether a node without a name in the launch file has the one of its code."""
    has_nodelets: bool
    has_handles: bool
    """Whether a node has handles with a namespace and remaps of their own."""
    has_qos: bool
    native_actions: bool
    """Whether actions are a kind of their own; otherwise each is five topics."""
    kinds_in_types: bool
    """Whether types are written `package/msg/Name`; otherwise `package/Name`."""
    all_servers_answer: bool
    """Whether of several servers of one service each answers, and not only the last."""
    traces_have_places: bool
    """Whether a run tells where in the source an endpoint is made, also that of a program in C++."""


ROS1 = Generation(
    number=1,
    default_distro="noetic",
    executable="type",
    argument="arg",
    find="find",
    nested_substitutions=False,
    shared_configurations=False,
    deferred_actions=False,
    first_remap_wins=False,
    remaps_of_nodes=False,
    ament=False,
    needs_rclpy=False,
    has_master=True,
    own_parameters=False,
    nodes_name_themselves=False,
    has_nodelets=True,
    has_handles=True,
    has_qos=False,
    native_actions=False,
    kinds_in_types=False,
    all_servers_answer=False,
    traces_have_places=True,
)
ROS2 = Generation(
    number=2,
    default_distro=None,
    executable="exec",
    argument="var",
    find="find-pkg-share",
    nested_substitutions=True,
    shared_configurations=True,
    deferred_actions=True,
    first_remap_wins=True,
    remaps_of_nodes=True,
    ament=True,
    needs_rclpy=True,
    has_master=False,
    own_parameters=True,
    nodes_name_themselves=True,
    has_nodelets=False,
    has_handles=False,
    has_qos=True,
    native_actions=True,
    kinds_in_types=True,
    all_servers_answer=True,
    traces_have_places=False,
)
_BY_NUMBER = {generation.number: generation for generation in (ROS1, ROS2)}


def ros(number: int) -> Generation:
    """The generation of a number."""
    return _BY_NUMBER[number]
