"""What the Gazebo of a launch has: its world, the robots that are spawned in it, and their topics.

How sensors and plugins name their topics: `knowledge/gazebo`. What is not known of it, a world that is not here or a
plugin of one's own, may have any topic.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from itertools import pairwise

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location
from preflight_analysis.environment.installed_paths import located
from preflight_analysis.evaluation.problems import IncludeNotFound
from preflight_analysis.evaluation.ros2.spawners import SPAWN
from preflight_analysis.evaluation.ros2.unknown_text import is_unknown
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree
from preflight_analysis.evaluation.words import beside_ros, words_of
from preflight_analysis.findings.finding import Related
from preflight_analysis.incremental.derived import derived
from preflight_analysis.knowledge.gazebo import Direction, TopicForm, gazebo_topics, is_of_classic, plugin_name
from preflight_analysis.model.context import Context
from preflight_analysis.model.files import address
from preflight_analysis.model.gazebo_bridges import Bridge, bridges
from preflight_analysis.robot.model import GazeboPlugin, IncludedModel, Simulated, SimulatedSensor
from preflight_analysis.robot.of_launch import robots_of, unread_of
from preflight_analysis.robot.parse import parse_description
from preflight_analysis.robot.sdf import parse_sdf

ANY = "*"
"""In the name of a topic: a part that is not known."""
_SIMULATORS = (("ros_gz_sim", "gzserver"), ("ros_gz_sim", "ros_gz_sim::GzServer"))
_COMMAND = re.compile(
    r"(?:^|[\s/(])(?:gz\)?\s+sim|ign\)?\s+gazebo|ros2\s+launch\s+ros_gz_sim\s+gz_sim\.launch\.py)\b(.*)", re.DOTALL
)
_WORLD = re.compile(r"\.(?:sdf|world)\Z")
_OWN_WORLDS = frozenset({"empty", "empty.sdf"})
"""Gazebo's, which has nothing but systems."""
_SYSTEMS_OF_EMPTY = ("physics", "user-commands", "scene-broadcaster", "contact")
_RESOURCES = ("GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "SDF_PATH")
_CONFIGURED_BY = ("GZ_SIM_SERVER_CONFIG_PATH", "IGN_GAZEBO_SERVER_CONFIG_PATH")
_OPTIONS = {"-file": "file", "-topic": "topic", "-string": "string", "-param": "param", "-name": "name"}
_FOLDERS = ("", "models", "model", "sdf", "..")
"""Where packages have models, below the folder of the package."""
_EXPANDS = "expand_gz_topic_names"
_NO_PLUGIN = "__default__"
"""The file of the plugins that a world has which Gazebo wrote down."""
_WITHOUT_TOPICS = re.compile(r"https?://[^ ]+/OpenRobotics/models/(?:Sun|Ground[ _]Plane)\Z", re.IGNORECASE)
"""Models of Fuel that nearly all worlds have."""
_MAX_DEPTH = 8
_PART = re.compile(r"\{(\w+)\}")


@dataclass(frozen=True, slots=True)
class GazeboTopic:
    """A topic of Gazebo, its type without package. `maker` is what has it, in words; `needs` the plugin that publishes
    for a sensor, "" where it is a plugin itself."""

    name: str
    type: str
    direction: Direction
    maker: str
    needs: str = ""

    def is_named(self, name: str) -> bool:
        """Whether that is its name, as far as that is known."""
        mine, theirs = self.name.split("/"), plain(name).split("/")
        return len(mine) == len(theirs) and all(a in (ANY, b) for a, b in zip(mine, theirs, strict=True))

    @property
    def is_certain(self) -> bool:
        """Whether its name is known as a whole."""
        return ANY not in self.name.split("/")


@dataclass(frozen=True, slots=True)
class Gazebo:
    """`systems` are the plugins of its world and models, by their names; `lacks` says what of it is not known, in
    words. `worlds` are the files or texts of its worlds, and where each is named."""

    topics: tuple[GazeboTopic, ...]
    systems: frozenset[str]
    lacks: tuple[str, ...]
    worlds: tuple[tuple[str, Location], ...]

    @property
    def related(self) -> tuple[Related, ...]:
        """Where its worlds are named."""
        return tuple(Related(f"Gazebo starts here with {os.path.basename(world)}", at) for world, at in self.worlds)

    @property
    def whole(self) -> bool:
        """Whether there is nothing that is not known."""
        return not self.lacks

    def named(self, name: str, direction: str) -> tuple[GazeboTopic, ...]:
        """The topics of a name that Gazebo has for a bridge in that direction; those of both where it goes both
        ways."""
        wanted = ENDS[direction]
        return tuple(each for each in self.topics if each.direction in wanted and each.is_named(name))


ENDS: Mapping[str, tuple[Direction, ...]] = {
    "GZ_TO_ROS": ("publishes",),
    "ROS_TO_GZ": ("subscribes",),
    "BIDIRECTIONAL": ("publishes", "subscribes"),
}
"""What Gazebo has to do with a topic for a bridge."""


def plain(name: str) -> str:
    """A topic with one slash before it, as Gazebo takes `scan` and `/scan` for the same."""
    return "/" + re.sub(r"/+", "/", name).strip("/")


def to_gazebo(context: Context) -> Iterator[Bridge]:
    """The bridges whose topics in Gazebo are known: those of a bridge that puts its own namespace before them are
    not."""
    for bridge in bridges(context):
        expands = any(param.name == _EXPANDS and param.value is not False for param in bridge.node.params)
        if bridge.direction in ENDS and not expands and not is_unknown(bridge.gazebo_topic):
            yield bridge


@derived
def gazebo_of(context: Context) -> Gazebo | None:
    """The Gazebo that the launch starts; None where it starts none."""
    worlds = list(worlds_of(context))
    return _Reader(context).gazebo(worlds) if worlds else None


def worlds_of(context: Context) -> Iterator[tuple[LaunchNode, str, str]]:
    """What starts a simulator, the file of its world and its text; both empty where that is not known."""
    for node in context.tree.nodes:
        if node.kind == "process":
            found = _COMMAND.search(f"{node.executable} {node.args}")
            words = found[1].replace("gz_args:=", " ").split() if found is not None else []
            # A client that shows what another one simulates.
            if found is not None and "-g" not in words:
                world = next((each for each in words if _WORLD.search(each) or each in _OWN_WORLDS), "")
                yield node, world, ""
        elif (node.package, node.plugin or node.executable) in _SIMULATORS:
            given = {param.name: param.value for param in node.params}
            yield node, _text(given.get("world_sdf_file")), _text(given.get("world_sdf_string"))


def is_cut(tree: LaunchTree) -> bool:
    """Whether there may be more of the launch than the tree has."""
    if any(include.path is None for include in tree.includes) or any(each.decides for each in tree.unknowns):
        return True
    return any(isinstance(problem.kind, IncludeNotFound) for problem in tree.problems)


def _text(value: object) -> str:
    return value if isinstance(value, str) else ""


class _Reader:
    def __init__(self, context: Context) -> None:
        self.context = context
        self.topics: list[GazeboTopic] = []
        self.systems: set[str] = set()
        self.lacks: list[str] = []
        self._lacks_if(bool(unread_of(context.tree)), "a robot description")
        self._lacks_if(is_cut(context.tree), "an included launch file")
        environment = [each for node in context.tree.nodes for each in node.env]
        self._lacks_if(any(key in _CONFIGURED_BY for key, _ in environment), "the configuration of the server")
        self._folders = [path for key, value in environment if key in _RESOURCES for path in value.split(":") if path]

    def _lacks_if(self, lacks: bool, what: str) -> None:
        if lacks:
            self.lacks.append(what)

    def gazebo(self, worlds: Iterable[tuple[LaunchNode, str, str]]) -> Gazebo:
        named, names = [], set[str]()
        for node, file, text in worlds:
            named.append((file or "its text", node.location))
            if file in _OWN_WORLDS:
                self.systems.update(_SYSTEMS_OF_EMPTY)
                self._add_world(Simulated("world", "empty"))
                names.add("empty")
                continue
            path = self._file(file) if file and not is_unknown(file) else None
            content = self.context.disk.content(path) if path is not None else text or None
            found = parse_sdf(content) if content is not None and not is_unknown(content) else None
            if found is None:
                self.lacks.append(f"the world {os.path.basename(file)}".rstrip())
                names.add(ANY)
            for each in found or ():
                names.add(each.name)
                self.systems.update(() if each.plugins else gazebo_topics().defaults)
                self._add_world(each)
        world = names.pop() if len(names) == 1 else ANY
        for node in self.context.tree.nodes:
            if (node.package, node.executable) in SPAWN:
                self._spawn(node, world)
        topics = tuple(dict.fromkeys(self.topics))
        return Gazebo(topics, frozenset(self.systems), tuple(dict.fromkeys(self.lacks)), tuple(named))

    def _add_world(self, world: Simulated) -> None:
        values = {"world": world.name}
        for form in gazebo_topics().world:
            self._add(form, values, "Gazebo itself")
        self._add_model(world, values, f"/world/{world.name}", 0)

    def _spawn(self, node: LaunchNode, world: str) -> None:
        given = {**_options(node), **{param.name: param.value for param in node.params if param.name in _NAMED}}
        name = _text(given.get("name"))
        name = ANY if is_unknown(name) or "$(" in name else name
        text = _text(given.get("string"))
        if _text(given.get("topic")):
            for robot in robots_of(self.context.tree):
                self._add_text(robot.text, name, world)
            self._lacks_if(not robots_of(self.context.tree), "a robot description")
        elif param := _text(given.get("param")):
            text = _text(next((each.value for each in node.params if each.name == param), None))
            self._add_text(text, name, world)
        elif text:
            self._add_text(text, name, world)
        else:
            file = _text(given.get("file"))
            path = None if is_unknown(file) else self._model_file(file)
            self._add_text((self.context.disk.content(path) or "") if path is not None else "", name, world)

    def _add_text(self, text: str, name: str, world: str) -> None:
        """A model that is spawned, under its own name where it is given none."""
        found = [each for each in parse_sdf(text) or () if each.kind == "model"]
        described = parse_description(text) if not found else None
        if described is not None and described.kind == "robot":
            found = [Simulated("model", described.name or ANY, described.plugins, described.sensors)]
            self._lacks_if(not described.is_whole, f"packages of the robot {described.name}")
        self._lacks_if(not found or is_unknown(text), "a model that is spawned")
        for each in found:
            called = name or each.name
            self._add_model(each, {"world": world, "model": called}, f"/world/{world}/model/{called}", 0)

    def _add_model(self, model: Simulated, values: Mapping[str, str], scope: str, depth: int) -> None:
        for plugin in model.plugins:
            self._add_plugin(plugin, values)
        for sensor in model.sensors:
            self._add_sensor(sensor, scope)
        for each in model.models:
            self._add_model(each, {**values, "model": each.name}, f"{scope}/model/{each.name}", depth)
        for included in model.includes:
            self._include(included, values, scope, depth)

    def _include(self, included: IncludedModel, values: Mapping[str, str], scope: str, depth: int) -> None:
        if _WITHOUT_TOPICS.match(included.uri):
            return
        path = self._model_file(included.uri)
        content = self.context.disk.content(path) if path is not None else None
        found = parse_sdf(content) if content is not None else None
        if found is None or depth >= _MAX_DEPTH:
            self.lacks.append(f"the model {included.uri}")
            return
        for each in found:
            name = included.name or each.name
            self._add_model(each, {**values, "model": name}, f"{scope}/model/{name}", depth + 1)

    def _add_plugin(self, plugin: GazeboPlugin, values: Mapping[str, str]) -> None:
        if plugin.filename == _NO_PLUGIN:
            return
        name = plugin_name(plugin.filename)
        forms = gazebo_topics().plugins.get(name)
        self.systems.add(name)
        if forms is None:
            self._lacks_if(not is_of_classic(plugin.filename), f"the plugin {plugin.filename}")
            return
        given = {**plugin.params, **values}
        for form in forms:
            if all((plugin.params.get(key) or None) == value for key, value in form.when.items()):
                self._add(form, given, f"the plugin {name}")

    def _add_sensor(self, sensor: SimulatedSensor, scope: str) -> None:
        form = gazebo_topics().sensors.get(sensor.type)
        if form is None:
            self.lacks.append(f"sensors of type {sensor.type}")
            return
        default = "/".join(filter(None, (f"{scope}{sensor.within}", "sensor", sensor.name or ANY, form.default)))
        topic = sensor.texts.get("topic") or default
        values = {**sensor.texts, "topic": topic, "above": topic.rpartition("/")[0]}
        for each in form.topics:
            self._add(each, values, f"the sensor '{sensor.name}'", form.system)

    def _add(self, form: TopicForm, values: Mapping[str, str], maker: str, needs: str = "") -> None:
        for each in form.names:
            if all(part in values and (values[part] or part == "above") for part in _PART.findall(each)):
                name = _PART.sub(lambda part: values[part[1]], each)
                self.topics.append(GazeboTopic(plain(name), form.type, form.direction, maker, needs))
                return

    def _file(self, path: str) -> str | None:
        if path.startswith("/"):
            found = located(self.context.disk, self.context.environment, path)
            return found if self.context.disk.is_file(found) else None
        candidates = (os.path.join(folder, path) for folder in self._folders)
        return next(filter(self.context.disk.is_file, candidates), None)

    def _model_file(self, uri: str) -> str | None:
        """The file of a model by its path or address; None where it is not here."""
        scheme, sign, rest = uri.partition("://")
        if not sign:
            found = self._file(uri)
            return found or (self._in(uri) if uri.startswith("/") else None)
        named = address(self.context.environment, uri)
        if named is not None:
            return self._file(named.path) or self._in(named.path) if named.path is not None else None
        if scheme != "model":
            return None
        return next(filter(None, map(self._in, self._candidates(rest))), None)

    def _candidates(self, model: str) -> Iterator[str]:
        yield from (os.path.join(folder, model) for folder in self._folders)
        for package in self.context.environment.own_packages:
            yield from (os.path.normpath(os.path.join(package.share, each, model)) for each in _FOLDERS)

    def _in(self, path: str) -> str | None:
        """A path of a file, or the file of the model that a folder has."""
        disk = self.context.disk
        if disk.is_file(path):
            return path
        return next(filter(disk.is_file, (os.path.join(path, f"model.{end}") for end in ("sdf", "urdf"))), None)


_NAMED = frozenset(_OPTIONS.values())


def _options(node: LaunchNode) -> Mapping[str, str]:
    """What the command line of a spawner says."""
    words = list(beside_ros(words_of(node.args)))
    options = {f"-{each}": name for each, name in _OPTIONS.items()} | _OPTIONS
    return {options[word]: value for word, value in pairwise(words) if word in options}
