"""The language that a launch file is written in, as data, and what it says of a tag or an attribute."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from preflight_analysis import generation
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.ros2.actions.registry import tags
from preflight_analysis.findings.markdown import code
from preflight_analysis.launch.model import LaunchFile, Substitution, action_at
from preflight_analysis.launch.recognize import is_yaml
from preflight_analysis.launch.schema import Attribute, Kind, Tag
from preflight_analysis.launch.schema_ros1 import TAGS
from preflight_analysis.launch.substitutions import SUBSTITUTIONS
from preflight_analysis.launch.substitutions_ros2 import SUBSTITUTIONS_ROS2, nested
from preflight_analysis.queries.cursor import Place, place_at
from preflight_analysis.queries.cursor_yaml import place_at_yaml


@dataclass(frozen=True, slots=True)
class Snippet:
    """A tag with what belongs into it, in LSP's syntax for tab stops: in XML without its first `<`, in YAML without its
    dash. Offered as `label` where the tag can stand."""

    tag: str
    label: str
    doc: str
    xml: str
    yaml: str = ""


@dataclass(frozen=True, slots=True)
class Language:
    """The launch language of one generation of ROS. `substitutions` are what each takes and stands for.

    `argument` and `package` are the substitutions for those, `executable` is the attribute that names one. `also` are
    attributes that are not required but nearly always there; of `excludes` only one can be.
    """

    tags: Mapping[str, Tag]
    substitutions: Mapping[str, tuple[str, str]]
    argument: str
    package: str
    executable: str
    also: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    excludes: Mapping[str, tuple[tuple[str, ...], ...]] = field(default_factory=dict)
    only_declared: frozenset[str] = frozenset()
    """Attributes of `<arg>` that cannot stand where it passes one on."""
    suffixes: Mapping[Kind, tuple[str, ...]] = field(default_factory=dict)
    has_expressions: bool = False
    """Whether `$(eval ` takes the rest of a value and knows arguments by name."""
    nests: bool = False
    """Whether substitutions can stand in substitutions."""
    snippets: tuple[Snippet, ...] = ()

    def tag(self, name: str) -> Tag | None:
        """What the language says of a tag; roslaunch takes some in capitals, too."""
        return self.tags.get(name) or self.tags.get(name.lower())


ROS1 = Language(
    TAGS,
    SUBSTITUTIONS,
    generation.ROS1.argument,
    generation.ROS1.find,
    generation.ROS1.executable,
    also={"arg": ("default",), "param": ("value",), "rosparam": ("file",)},
    excludes={"arg": (("default", "value"),), "param": (("value", "textfile", "binfile", "command"),)},
    only_declared=frozenset({"default", "doc"}),
    suffixes={"launch-file": (".launch", ".xml", ".test"), "yaml-file": (".yaml", ".yml")},
    has_expressions=True,
    snippets=(
        Snippet(
            "node",
            "node with parameter file",
            "Starts a node and loads a YAML file into its namespace.",
            'node pkg="$1" type="$2" name="$3">\n'
            '\t<rosparam command="load" file="\\$(find $4)/config/$5.yaml"/>\n</node>',
        ),
        Snippet(
            "node",
            "node container (nodelet manager)",
            "Starts a nodelet manager and loads a nodelet into it.",
            'node pkg="nodelet" type="nodelet" name="${1:manager}" args="manager"/>\n'
            '<node pkg="nodelet" type="nodelet" name="$2" args="load $3 ${1:manager}"/>',
        ),
        Snippet(
            "include",
            "include with argument",
            "Includes a launch file of a package and passes an argument.",
            'include file="\\$(find $1)/launch/$2.launch">\n\t<arg name="$3" value="$4"/>\n</include>',
        ),
    ),
)
ROS2 = Language(
    tags(),
    {command: (takes, doc) for command, (takes, doc, _) in SUBSTITUTIONS_ROS2.items()},
    generation.ROS2.argument,
    generation.ROS2.find,
    generation.ROS2.executable,
    also={"node": ("pkg", "exec", "name"), "arg": ("default",), "param": ("name", "value")},
    excludes={"arg": (("default", "value"),), "param": (("value", "from"), ("name", "from"))},
    only_declared=frozenset({"default", "description"}),
    suffixes={"launch-file": (".launch", ".xml", ".py", ".yaml", ".yml"), "yaml-file": (".yaml", ".yml")},
    nests=generation.ROS2.nested_substitutions,
    snippets=(
        Snippet(
            "node",
            "node with parameter file",
            "Starts a node with the parameters of a YAML file.",
            'node pkg="$1" exec="$2" name="$3">\n\t<param from="\\$(find-pkg-share $4)/config/$5.yaml"/>\n</node>',
            "node:\n    pkg: $1\n    exec: $2\n    name: $3\n    param:\n"
            "      - from: \\$(find-pkg-share $4)/config/$5.yaml",
        ),
        Snippet(
            "node_container",
            "node_container with component",
            "Starts a component container and loads a component into it.",
            'node_container pkg="rclcpp_components" exec="component_container" name="$1" namespace="$2">\n'
            '\t<composable_node pkg="$3" plugin="$4" name="$5"/>\n</node_container>',
            "node_container:\n    pkg: rclcpp_components\n    exec: component_container\n    name: $1\n"
            '    namespace: "$2"\n    composable_node:\n      - pkg: $3\n        plugin: $4\n        name: $5',
        ),
        Snippet(
            "include",
            "include with argument",
            "Includes a launch file of a package and passes an argument.",
            'include file="\\$(find-pkg-share $1)/launch/$2">\n\t<arg name="$3" value="$4"/>\n</include>',
            "include:\n    file: \\$(find-pkg-share $1)/launch/$2\n    arg:\n      - name: $3\n        value: $4",
        ),
        Snippet("param", "param from file", "Gives the node the parameters of a YAML file.", 'param from="$1"/>', ""),
    ),
)

_BY_GENERATION = {1: ROS1, 2: ROS2}


def language_of(launch_file: LaunchFile) -> Language:
    """The language of a launch file."""
    return _BY_GENERATION[launch_file.generation]


def place_in(launch_file: LaunchFile, offset: int) -> Place | None:
    """What kind of place a cursor is in; None where nothing of the language can stand."""
    if launch_file.is_python:
        return None
    if is_yaml(launch_file.path):
        return place_at_yaml(launch_file.document, offset)
    return place_at(launch_file.document, offset)


def attribute_doc(attribute: Attribute) -> str:
    """What an attribute is, what it may be and what it is where it is left out, as Markdown."""
    lines = [attribute.doc]
    if attribute.kind == "choice":
        lines.append(f"One of {', '.join(code(choice) for choice in attribute.choices)}.")
    if attribute.default is not None:
        lines.append(f"Default: {code(attribute.default)}.")
    return "\n\n".join(lines)


def described(launch_file: LaunchFile, offset: int) -> tuple[str, Span] | None:
    """The description, as Markdown, of the tag, attribute or substitution whose name is at `offset`, and where that
    name is. None in Python, which has a language server of its own."""
    if launch_file.is_python:
        return None
    substitution = _substitution_at(launch_file, offset)
    if substitution is not None:
        known = language_of(launch_file).substitutions.get(substitution.command)
        takes = f" {known[0]}" if known is not None and known[0] else ""
        text = f"{code(f'$({substitution.command}{takes})')} {known[1]}" if known is not None else ""
        return (text, substitution.command_span) if text else None
    place = place_in(launch_file, offset)
    element = place.element if place is not None else None
    tag = language_of(launch_file).tag(element.tag) if element is not None else None
    if place is None or element is None or tag is None:
        return None
    if place.kind == "element":
        name = element.tag if is_yaml(launch_file.path) else f"<{element.tag}>"
        return f"{code(name)} {tag.doc}", place.word
    if place.kind == "attribute" and place.attribute is not None:
        attribute = tag.attributes.get(place.attribute.name)
        if attribute is not None:
            required = " (required)" if attribute.required else ""
            return f"{code(attribute.name)}{required}: {attribute_doc(attribute)}", place.word
    return None


def _substitution_at(launch_file: LaunchFile, offset: int) -> Substitution | None:
    """The substitution whose command is at `offset`."""
    action = action_at(launch_file, offset)
    for attribute in action.attributes if action is not None else ():
        if attribute.value.span.contains(offset):
            for part in nested(attribute.value.parts):
                if part.command_span.contains(offset) and part.command_span.end > part.command_span.start:
                    return part
    return None
