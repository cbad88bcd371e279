"""The text of a semantic robot description (SRDF) to what it says: the groups of joints that MoveIt plans for.

https://github.com/ros-planning/srdfdom, `srdf::Model::initXml` in src/model.cpp; http://wiki.ros.org/srdf
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import lru_cache

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document, Element
from preflight_analysis.documents.reading import SIZE_LIMIT
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.robot.model import Malformed
from preflight_analysis.robot.parse import parse_description

_KEPT = 32
_LINKS = {
    "virtual_joint": ("child_link",),
    "end_effector": ("parent_link",),
    "disable_collisions": ("link1", "link2"),
    "enable_collisions": ("link1", "link2"),
    "disable_default_collisions": ("link",),
    "link_sphere_approximation": ("link",),
}
_JOINTS = {"passive_joint": ("name",), "joint_property": ("joint_name",)}
_GROUPS = {"end_effector": ("group",), "group_state": ("group",)}
_Attributes = Mapping[str, tuple[str, ...]]
_OWN: Mapping[str, tuple[_Attributes, _Attributes, _Attributes]] = {
    "group": ({"link": ("name",), "chain": ("base_link", "tip_link")}, {"joint": ("name",)}, {"group": ("name",)}),
    "group_state": ({}, {"joint": ("name",)}, {}),
}
"""What stands within an element: the attributes that name links, joints and groups, by tags."""


def _tags(own: _Attributes, index: int) -> frozenset[tuple[str, str]]:
    by_tag = (own, *(inside[index] for inside in _OWN.values()))
    return frozenset((tag, attribute) for each in by_tag for tag, found in each.items() for attribute in found)


NAMING_LINKS, NAMING_JOINTS, NAMING_GROUPS = _tags(_LINKS, 0), _tags(_JOINTS, 1), _tags(_GROUPS, 2)
"""The attributes that name links, joints and groups, each with its tag."""


@dataclass(frozen=True, slots=True)
class Named:
    """A name in an attribute. `owner` is the tag of the element that it is in or within, `whose` the name of that, for
    example of the group; `within` is "" where the attribute is that of the owner itself."""

    value: str
    owner: str
    whose: str
    within: str
    tag: str
    attribute: str


@dataclass(frozen=True, slots=True)
class Semantic:
    """A semantic description: what it defines, and what it names of the robot. `groups` are the names of groups,
    `virtual_joints` joints that only MoveIt knows. Of one that is `malformed` nothing else is known."""

    groups: tuple[str, ...] = ()
    virtual_joints: tuple[str, ...] = ()
    links: tuple[Named, ...] = ()
    joints: tuple[Named, ...] = ()
    group_names: tuple[Named, ...] = ()
    malformed: Malformed | None = None


@lru_cache(maxsize=_KEPT)
def parse_semantic(text: str) -> Semantic | None:
    """What a description says; None where it is none. Never raises."""
    if len(text) > SIZE_LIMIT or "<robot" not in text:
        return None
    malformed = parse_description(text).malformed
    if malformed is not None:
        return Semantic(malformed=malformed)
    root = _root(parse_xml("", text))
    if root is None:
        return None
    links: list[Named] = []
    joints: list[Named] = []
    groups: list[Named] = []
    for element in root.elements:
        tag, whose = element.tag, _get(element, "name")
        for found, attributes in ((links, _LINKS), (joints, _JOINTS), (groups, _GROUPS)):
            found.extend(_named(element, attributes.get(tag, ()), tag, whose, ""))
        for part in element.elements if tag in _OWN else ():
            for found, by_tag in zip((links, joints, groups), _OWN[tag], strict=True):
                found.extend(_named(part, by_tag.get(part.tag, ()), tag, whose, tag))
    return Semantic(
        tuple(_get(each, "name") for each in root.elements if each.tag == "group"),
        tuple(_get(each, "name") for each in root.elements if each.tag == "virtual_joint"),
        tuple(links),
        tuple(joints),
        tuple(groups),
    )


def _root(document: Document) -> Element | None:
    """The root of a description that can be read: no expression of xacro is left in it."""
    root = document.root
    if root is None or document.problems or root.tag != "robot":
        return None
    return None if any(element.tag.startswith("xacro:") for element in root.elements) else root


def _named(element: Element, attributes: tuple[str, ...], owner: str, whose: str, within: str) -> Iterator[Named]:
    for attribute in attributes:
        if (value := _get(element, attribute)) and "$" not in value:
            yield Named(value, owner, whose, within, element.tag, attribute)


def _get(element: Element, attribute: str) -> str:
    found = element.get(attribute)
    return found.value.text.strip() if found is not None else ""
