"""Ends of topics, services or actions that were probably meant to meet."""

from __future__ import annotations

from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.graph.model import Connection
from preflight_analysis.model.channels import OF_ENDS, doubts_of_ends
from preflight_analysis.model.nearest import has_all_words, is_word_more

Evidence = Literal["typo", "remap", "slash", "level", "words"]
"""How two names are alike, the strongest first. `typo` and `words` as in `nearest`. `remap`: both ends had one name,
and the launch remaps one of them alone. `slash`: one end was given an
absolute name, and the other end's is the same below its node's namespace. `level`: one has a namespace more."""
EVIDENCE: tuple[Evidence, ...] = ("typo", "remap", "slash", "level", "words")


@dataclass(frozen=True, slots=True)
class NearMiss:
    """`consumer` (a subscriber or client) has no other end; `provider` has a like name and no conflicting type."""

    consumer: Connection
    provider: Connection
    likeness: Evidence
    same_type: bool
    """Both types are known and equal."""
    provider_dangles: bool

    @property
    def site(self) -> Connection:
        """The endpoint at which it is reported: that whose name the launch sets, else the consumer."""
        if not self.consumer.is_placed and self.provider.is_placed:
            return self.provider
        return self.consumer

    @property
    def other(self) -> Connection:
        """The endpoint that is not the site."""
        return self.provider if self.site is self.consumer else self.consumer

    @property
    def doubtful(self) -> Connection:
        """The end whose name may be written on purpose: that which a remap moved away, else the consumer."""
        return self.site if self.likeness == "remap" else self.consumer

    @property
    def made_relative(self) -> bool:
        """Whether a parameter has the provider's name but for the slash before it, and the node puts a namespace of its
        own before that, as costmaps do: `front/scan` is `/local_costmap/front/scan`."""
        end = self.consumer
        if self.likeness != "level" or end.remap is not None or end.endpoint.named_by is None or end.endpoint.displayed:
            return False
        level = extra_level(self.provider.name, end.name)
        return level is not None and level not in end.node.namespace.split("/") and level != names.leaf(end.node.name)

    @property
    def strong(self) -> bool:
        """Whether it speaks for itself, whatever else the launch may hold."""
        return self.likeness == "typo" and self.same_type

    @property
    def mendable(self) -> bool:
        """Whether the evidence will do for a change that is made for the user: like words are of other things as often
        as not (`pose`, `goal_pose`)."""
        if self.likeness == "words":
            return self.same_type and self.provider_dangles and _same_leaf(self)
        return self.same_type or self.provider_dangles

    @property
    def why(self) -> str:
        """What speaks for it, for a message: `same type x/Y; '/scan' is absolute`."""
        said = f"same type {self.consumer.endpoint.type}" if self.same_type else "type unknown"
        if self.likeness == "remap":
            return f"{said}; both have the name '{given_name(self.site)}' before the remap at {self.site.node.name}"
        short, long = sorted((self.consumer.name, self.provider.name), key=len)
        if self.likeness == "slash":
            return f"{said}; '{short}' is absolute, the other name is relative to its node's namespace"
        if self.likeness == "level":
            return f"{said}; the names differ by the namespace '{extra_level(short, long)}'"
        return said


OF_NEAR_MISSES = (Reason.LIKE_NAMES, Reason.COMPUTED, *OF_ENDS)
"""What `doubts_of` may say."""


def doubts_of(near: NearMiss, lacks: str | bool, likely_complete: bool) -> tuple[Doubt, ...]:
    """Why the ends of a near miss may not be meant to meet, in a graph of which so much is known: `lacks` as of
    `channels.not_all_known`."""
    ends = (near.consumer, near.provider)
    lone = near.provider_dangles and not _of_another_node(near)
    alike = (
        near.likeness in ("typo", "remap")
        or near.made_relative
        or (lone and (likely_complete or is_word_more(*_both_names(near))))
    )
    # Two ends that nobody else has anything to do with speak for each other, be one of them but assumed.
    both_lone = near.provider_dangles and (near.likeness in ("typo", "remap") or _same_leaf(near))
    return (
        *doubts(
            LIKE_NAMES=not (near.same_type and alike),
            COMPUTED=any("computed names" in each.endpoint.evidence.doubts for each in ends),
            ASSUMED=next((each.node.name for each in ends if "on demand" in each.endpoint.evidence.doubts), ""),
        ),
        *doubts_of_ends(*ends, assumed="DEPENDS" if both_lone else "ASSUMED", lacks=lacks),
    )


def given_name(end: Connection) -> str:
    """The full name that it would have without the remap."""
    return names.resolve(end.endpoint.name, end.node.name)


def _same_leaf(near: NearMiss) -> bool:
    return names.leaf(near.consumer.name) == names.leaf(near.provider.name)


def _both_names(near: NearMiss) -> tuple[str, str]:
    return near.consumer.name, near.provider.name


def _of_another_node(near: NearMiss) -> bool:
    """Whether the offered name is a private one and the wanted one is that of another node, which may well be started
    elsewhere: `/rectifier/image` for `/camera/image`, but not `/tracker/image` for `/old_tracker/image`."""
    private = near.provider.remap is None and near.provider.endpoint.name.startswith("~")
    if near.likeness != "words" or not private or near.consumer.name.startswith(f"{near.provider.node.name}/"):
        return False
    return not has_all_words(near.consumer.name, near.provider.name)


def extra_level(short: str, long: str) -> str | None:
    """The one namespace that `long` has more than `short`, None if they differ otherwise."""
    parts, more = short.split("/"), long.split("/")
    if len(more) != len(parts) + 1:
        return None
    at = next((i for i, (a, b) in enumerate(zip(parts, more, strict=False)) if a != b), len(parts))
    return more[at] if at < len(parts) and parts[at:] == more[at + 1 :] else None
