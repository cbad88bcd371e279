"""The text of a robot description to what it says."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache

from lxml import etree

from preflight_analysis.documents.reading import SIZE_LIMIT
from preflight_analysis.evaluation.partial_text import catalogued_of, lacks_of, missing_of
from preflight_analysis.robot.model import (
    ControlJoint,
    ControlSystem,
    Description,
    GazeboPlugin,
    GazeboReference,
    Joint,
    Malformed,
    SensorFrame,
    SimulatedSensor,
    Transmission,
)

_KEPT = 32
_XACRO = re.compile(r"\{http[^{}]*xacro/?\}")
"""The namespaces that xacro has had, as lxml writes them before a tag (`xacro.XACRO_NS` of ROS 1 and ROS 2)."""
_EMPTY = Description("")
_TAKEN_BY_URDFDOM = (etree.ErrorTypes.NS_ERR_UNDEFINED_NAMESPACE, etree.ErrorTypes.ERR_HYPHEN_IN_COMMENT)
_DECLARATION = re.compile(r"\A\s*<\?xml[^>]*\?>")
_OF_ROS2_CONTROL = ("hardware", "properties", "joint", "sensor", "gpio", "transmission")
"""What may be in a `<ros2_control>` element (`parse_resource_from_xml` of ros2_control)."""
_JOINT_TAG = re.compile(r"(?:joint|joint_?name)$", re.IGNORECASE)
"""Elements of plugins that name a joint: `leftJoint`, `front_left_joint`, `joint_name`."""
_NAME = re.compile(r"[A-Za-z_][\w./-]*")
_TOPIC_TAGS = ("topic", "camera_info_topic")
_FRAME_TAGS = ("gz_frame_id", "ignition_frame_id", "frameName", "frame_name")
"""What has the frame of a simulated sensor: in the sensor (Gazebo), or in its plugin (Gazebo Classic)."""


@lru_cache(maxsize=_KEPT)
def parse_description(text: str) -> Description:
    """What a description says. Never raises; entities are not expanded, nothing is loaded, and of a text that is longer
    than a file may be nothing is read."""
    if len(text) > SIZE_LIMIT:
        return _EMPTY
    try:
        root = xml_root(text)
    except etree.XMLSyntaxError as error:
        lenient = _as_urdfdom(text)
        if lenient is not None:
            return _described(lenient, text)
        above = text[: len(text) - len(text.lstrip())].count("\n")
        return Description("", malformed=Malformed(_words(error), (error.lineno or 1) + above))
    except ValueError:
        return _EMPTY
    return _described(root, text)


def _as_urdfdom(text: str) -> etree._Element | None:
    """The <robot> of a text with prefixes that nothing declares, with `--` in comments, or beside other elements: the
    parser of urdfdom minds none of it. None where it has other errors, too."""
    parser = _parser(recover=True)
    root: etree._Element | None
    try:
        root = xml_root(text, parser)
        if any(each.type == etree.ErrorTypes.ERR_DOCUMENT_END for each in parser.error_log):
            parser = _parser(recover=True)
            root = xml_root(f"<all>{_DECLARATION.sub('', text)}</all>", parser).find("robot")
    except etree.XMLSyntaxError:
        return None
    only = all(each.type in _TAKEN_BY_URDFDOM for each in parser.error_log)
    return root if only and root is not None else None


def _described(root: etree._Element, text: str) -> Description:
    if _tag(root) != "robot":
        return Description(_tag(root), _get(root, "name"))
    lacks = lacks_of(text)
    if missing_of(text):
        _leave_unknown(root)
    elif _is_raw(root):
        return Description("xacro", _get(root, "name"))
    joints = tuple(map(_joint, _children(root, "joint")))
    gazebo = [(each, _get(each, "reference")) for each in _children(root, "gazebo")]
    meshes = (_get(mesh, "filename") for link in _children(root, "link") for mesh in link.iter("mesh"))
    return Description(
        "robot",
        _get(root, "name"),
        tuple(_get(each, "name") for each in _children(root, "link")),
        joints,
        tuple(dict.fromkeys(filter(None, meshes))),
        tuple(map(_system, _children(root, "ros2_control"))),
        tuple(_system(each) for each in root.iter("ros2_control") if each.getparent() is not root),
        tuple(map(_transmission, _children(root, "transmission"))),
        tuple(plugin_of(plugin, about) for each, about in gazebo for plugin in each.iter("plugin")),
        tuple(sensor_of(sensor) for each, _ in gazebo for sensor in each.iter("sensor")),
        tuple(
            GazeboReference(about, any(each.find(tag) is not None for tag in ("sensor", "plugin")))
            for each, about in gazebo
            if about
        ),
        tuple(frame for each, _ in gazebo for sensor in each.iter("sensor") for frame in _sensor_frames(sensor)),
        lacks=lacks,
        catalogued=catalogued_of(text),
    )


def xml_root(text: str, parser: etree.XMLParser | None = None) -> etree._Element:
    """The element that a text is, without its comments; raises XMLSyntaxError or ValueError."""
    # A declaration has to be the first thing, which launch files with a text in them do not keep.
    return etree.fromstring(text.strip().encode("utf-8", "replace"), parser if parser is not None else _parser())


def _parser(*, recover: bool = False) -> etree.XMLParser:
    """One that loads nothing and expands no entities; `recover`: it goes on behind what is wrong, and logs it."""
    return etree.XMLParser(
        encoding="utf-8",
        recover=recover,
        resolve_entities=False,
        no_network=True,
        load_dtd=False,
        remove_comments=True,
        remove_pis=True,
    )


def _leave_unknown(root: etree._Element) -> None:
    """Takes out what has a name, or is at a place, that is not known."""
    for element in list(root.iter()):
        above = element.getparent()
        is_named = element.tag != "limit"  # that there is one is what counts
        if above is not None and is_named and any("${" in str(value) for value in element.values()):
            above.remove(element)


def _is_raw(root: etree._Element) -> bool:
    """Whether xacro did not process it: it leaves no element of its own, and computes each `${...}`."""
    return any(_XACRO.match(_tag(each)) or _tag(each).startswith("xacro:") for each in root.iter()) or any(
        "${" in _get(each, "name") for tag in ("link", "joint") for each in _children(root, tag)
    )


def _words(error: etree.XMLSyntaxError) -> str:
    """The parser's words without the place, which is that in a text that nobody sees."""
    message = (error.msg or "").partition(", line ")[0]
    return message[:1].lower() + message[1:]


def _tag(element: etree._Element) -> str:
    return element.tag if isinstance(element.tag, str) else ""


def _get(element: etree._Element, attribute: str) -> str:
    return element.get(attribute) or ""


def _children(element: etree._Element, tag: str) -> Iterator[etree._Element]:
    return element.iterchildren(tag)


def _text(element: etree._Element, tag: str) -> str:
    """The text of the first element of that tag within another one."""
    found = element.find(tag)
    return (found.text or "").strip() if found is not None else ""


def _joint(element: etree._Element) -> Joint:
    ends = {tag: _get(found, "link") for tag in ("parent", "child") if (found := element.find(tag)) is not None}
    mimic = element.find("mimic")
    return Joint(
        _get(element, "name"),
        _get(element, "type"),
        ends.get("parent", ""),
        ends.get("child", ""),
        (_get(mimic, "joint") or None) if mimic is not None else None,
        element.find("limit") is not None,
        _get(element, "preflight"),
    )


def _system(element: etree._Element) -> ControlSystem:
    joints, sensors, gpios = (tuple(map(_controlled, _children(element, tag))) for tag in ("joint", "sensor", "gpio"))
    above = element.getparent()
    return ControlSystem(
        _get(element, "name"),
        _get(element, "type"),
        _text(element, "hardware/plugin"),
        joints,
        sensors,
        gpios,
        tuple(map(_transmission, _children(element, "transmission"))),
        tuple(dict.fromkeys(tag for each in element if (tag := _tag(each)) not in _OF_ROS2_CONTROL)),
        _tag(above) if above is not None else "",
    )


def _controlled(element: etree._Element) -> ControlJoint:
    commands, states = (
        tuple(_get(each, "name") for each in _children(element, f"{kind}_interface")) for kind in ("command", "state")
    )
    return ControlJoint(_get(element, "name"), commands, states, _get(element, "mimic"))


def _transmission(element: etree._Element) -> Transmission:
    joints = tuple(
        ControlJoint(
            _get(each, "name"),
            tuple((found.text or "").strip() for found in _children(each, "hardwareInterface")),
        )
        for each in _children(element, "joint")
    )
    return Transmission(_get(element, "name"), joints)


def plugin_of(element: etree._Element, reference: str = "") -> GazeboPlugin:
    """A `<plugin>` element of Gazebo."""
    params: dict[str, str] = {}
    joints: list[tuple[str, str]] = []
    for each in element.iter():
        if each is not element and not len(each) and "${" not in (each.text or ""):
            tag, text = _tag(each), (each.text or "").strip()
            params.setdefault(tag, text)
            if _JOINT_TAG.search(tag) and _NAME.fullmatch(text):
                joints.append((tag, text))
    return GazeboPlugin(_get(element, "name"), _get(element, "filename"), params, reference, tuple(joints))


def sensor_of(element: etree._Element, within: str = "/link/*") -> SimulatedSensor:
    """A `<sensor>` element of Gazebo."""
    type_ = _get(element, "type")
    # A contact sensor has its topic in an element of its own, and the first one of a camera is its own.
    texts = {tag: text for tag in _TOPIC_TAGS if (text := _text(element, tag) or _text(element, f".//{tag}"))}
    if type_ != "contact" and not _text(element, "topic"):
        texts.pop("topic", None)
    return SimulatedSensor(_get(element, "name"), type_, texts, within)


def _sensor_frames(element: etree._Element) -> Iterator[SensorFrame]:
    for tag in _FRAME_TAGS:
        for found in element.iter(tag):
            frame = (found.text or "").strip()
            if frame and "${" not in frame:
                yield SensorFrame(_get(element, "name"), tag, frame)
