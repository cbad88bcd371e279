"""What launch files call of `launch` and `launch_ros` besides making actions: loaders, frontends, logs, adapters.

What needs a launch that goes on, or a ROS node, raises `NotHereError`, which is no error of the launch file's.
"""

from __future__ import annotations

import importlib.machinery
import importlib.util
import os
from typing import Any, List, Optional

from .base import LaunchContext, LaunchDescription, NotHereError, Substitution, normalize_to_list_of_substitutions
from .includes import AnyLaunchDescriptionSource, IncludeLaunchDescription
from .substitutions import Written
from .typed import is_typing_list

PYTHON = ".py"


def not_here(name: str) -> Any:
    """A function that only a launch has."""

    def function(*args: Any, **kwargs: Any) -> Any:
        raise NotHereError(f"{name}() needs a running launch")

    return function


# Launch files


class InvalidLaunchFileError(Exception):
    def __init__(self, extension: str = "", *, likely_errors: Any = None) -> None:
        said = "The launch file may have a syntax error, or its format is unknown"
        if extension and likely_errors:
            several = "multiple exceptions" if len(likely_errors) > 1 else "exception"
            said = f"Caught {several} when trying to load file of format [{extension}]:"
            said += "".join(f"\n - {type(error).__name__}: {error}" for error in likely_errors)
        super().__init__(said)


class InvalidFrontendLaunchFileError(InvalidLaunchFileError):
    pass


class InvalidPythonLaunchFileError(Exception):
    pass


def load_python_launch_file_as_module(python_launch_file_path: Any) -> Any:
    loader = importlib.machinery.SourceFileLoader("python_launch_file", os.fspath(python_launch_file_path))
    spec = importlib.util.spec_from_loader(loader.name, loader)
    assert spec is not None
    module = importlib.util.module_from_spec(spec)
    loader.exec_module(module)
    return module


def get_launch_description_from_python_launch_file(python_launch_file_path: Any) -> Any:
    module = load_python_launch_file_as_module(python_launch_file_path)
    if not hasattr(module, "generate_launch_description"):
        raise InvalidPythonLaunchFileError(
            f"launch file at '{python_launch_file_path}' does not contain the required function "
            "'generate_launch_description()'"
        )
    return module.generate_launch_description()


def get_launch_description_from_frontend_launch_file(frontend_launch_file_path: Any, *, parser: Any = None) -> Any:
    """The host reads XML and YAML: a description with nothing but the include of the file."""
    path = os.fspath(frontend_launch_file_path)
    with open(path):
        return LaunchDescription([IncludeLaunchDescription(AnyLaunchDescriptionSource(path))])


def get_launch_description_from_any_launch_file(launch_file_path: Any, *, parser: Any = None) -> Any:
    if os.fspath(launch_file_path).endswith(PYTHON):
        return get_launch_description_from_python_launch_file(launch_file_path)
    return get_launch_description_from_frontend_launch_file(launch_file_path, parser=parser)


# Frontends


class Entity:
    """`launch.frontend.Entity`, of which a Python launch file gets none."""


class XMLEntity(Entity):
    def __init__(self, xml_element: Any = None, *, parent: Any = None) -> None:
        self.parent = parent


class YAMLEntity(Entity):
    def __init__(self, element: Any = None, type_name: Any = None, *, parent: Any = None) -> None:
        self.parent = parent


def parse_substitution(string_value: str) -> list[Substitution]:
    return [Written(string_value)] if "$" in string_value else normalize_to_list_of_substitutions(string_value)


def parse_if_substitutions(value: Any) -> Any:
    if isinstance(value, str):
        return parse_substitution(value)
    return [parse_substitution(x) if isinstance(x, str) else x for x in value] if isinstance(value, list) else value


def replace_escaped_characters(data: str) -> str:
    return data.encode("raw_unicode_escape").decode("unicode_escape")


class Parser:
    parse_action = parse_description = staticmethod(not_here("parse_action"))
    load = get_parser_from_extension = get_parsers_from_filename = staticmethod(not_here("load"))

    @staticmethod
    def parse_substitution(value: str) -> Any:
        return parse_substitution(value)

    @staticmethod
    def parse_if_substitutions(value: Any) -> Any:
        return parse_if_substitutions(value)

    @staticmethod
    def escape_characters(value: str) -> str:
        return replace_escaped_characters(value)

    @classmethod
    def load_launch_extensions(cls) -> None:
        return None

    @classmethod
    def load_parser_implementations(cls) -> None:
        return None

    @classmethod
    def get_available_extensions(cls) -> list[str]:
        return ["xml", "yaml"]

    @classmethod
    def is_extension_valid(cls, extension: str) -> bool:
        return extension in cls.get_available_extensions()


class XMLParser(Parser):
    pass


class YAMLParser(Parser):
    pass


class ExtractSubstitution:
    pass


def expose(name: str) -> Any:
    """A decorator that leaves a class as it is."""
    return lambda thing: thing


def instantiate_action(entity: Any, parser: Any) -> Any:
    raise NotHereError("elements of XML and YAML are read when it is launched")


def instantiate_substitution(type_name: str, args: Any = None) -> Any:
    raise NotHereError("substitutions of XML and YAML are read when it is launched")


def check_is_list_entity(data_type: Any) -> bool:
    return is_typing_list(data_type) and issubclass(data_type.__args__[0], Entity)


_IDENTIFIERS = {
    "str": str,
    "bool": bool,
    "float": float,
    "int": int,
    "list_of_str": List[str],
    "list_of_bool": List[bool],
    "list_of_float": List[float],
    "list_of_int": List[int],
    "yaml": None,
}


def get_data_type_from_identifier(type_identifier: str) -> Any:
    if type_identifier not in _IDENTIFIERS:
        raise ValueError(f"Got invalid type identifier '{type_identifier}'")
    return _IDENTIFIERS[type_identifier]


# Launches


class LaunchService:
    """Nothing is launched."""

    def __init__(self, *, argv: Any = None, noninteractive: bool = False, debug: bool = False) -> None:
        self.context = LaunchContext(argv=argv, noninteractive=noninteractive)

    def include_launch_description(self, launch_description: Any) -> None:
        return None

    def run(self, *args: Any, **kwargs: Any) -> int:
        return 0

    async def run_async(self, *args: Any, **kwargs: Any) -> int:
        return 0

    def shutdown(self) -> None:
        return None


class AsyncSafeSignalManager:
    def __init__(self, loop: Any) -> None:
        self.__loop = loop


def visit_all_entities_and_collect_futures(entity: Any, context: Any) -> Any:
    raise NotHereError("what an action does is known only when it is launched")


def indent(lines: list[str], indention: str = "  ") -> list[str]:
    return [indention + line for line in lines]


def tree_like_indent(lines: list[str]) -> list[str]:
    return indent(lines, "    ")


def format_substitutions(substitutions: Any) -> str:
    return " + ".join(sub.describe() for sub in normalize_to_list_of_substitutions(substitutions))


def format_entities(entities: Any) -> list[str]:
    return [str(each) for each in entities]


def format_action(action: Any) -> list[str]:
    return [str(action)]


def format_event_handler(event_handler: Any) -> list[str]:
    return [str(event_handler)]


class LaunchIntrospector:
    def format_launch_description(self, launch_description: Any) -> str:
        return "\n".join(format_entities(launch_description.entities))


# Logs


class LaunchLogger:
    """Whatever is logged is dropped."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        pass

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return lambda *args, **kwargs: None


class LaunchConfig(LaunchLogger):
    level = 20
    log_dir = "/tmp"  # noqa: S108 - the sandbox's own

    def __init__(self) -> None:
        super().__init__()


def get_logger(name: Optional[str] = None) -> Any:
    return LaunchLogger()


def get_output_loggers(process_name: str, output_config: Any) -> Any:
    return LaunchLogger(), LaunchLogger()


def log_launch_config(*, logger: Any = None) -> None:
    return None


def reset() -> None:
    return None


def with_per_logger_formatting(cls: Any) -> Any:
    return cls


# ROS


class ROSAdapter:
    """The node that a launch has of its own."""

    def __init__(self, *, argv: Any = None, autostart: bool = True) -> None:
        self.argv = argv

    def start(self) -> None:
        return None

    def shutdown(self) -> None:
        return None

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        raise NotHereError(f"ROSAdapter.{name} needs ROS")


def get_ros_adapter(context: Any) -> ROSAdapter:
    return ROSAdapter()


def get_ros_node(context: Any) -> Any:
    return get_ros_adapter(context).ros_node


class LifecycleEventManager:
    def __init__(self, lifecycle_node: Any) -> None:
        self.__lifecycle_node = lifecycle_node

    @property
    def node_name(self) -> Any:
        return self.__lifecycle_node.node_name

    def setup_lifecycle_manager(self, context: Any) -> None:
        return None


class NodeActionExtension:
    NAME: Any = None

    @property
    def name(self) -> Any:
        return self.NAME

    def prepare_for_execute(self, context: Any, ros_specific_arguments: Any, node_action: Any) -> Any:
        return [], ros_specific_arguments


def get_extensions(logger: Any) -> Any:
    return {}


def instantiate_extension(
    group_name: Any,
    extension_name: Any,
    extension_class: Any,
    extensions: Any,
    logger: Any,
    *,
    unique_instance: bool = False,
) -> Any:
    return extension_class()


def match_node_name_goal(node_name: str, goal_state: str) -> Any:
    return lambda event: event.action.node_name == node_name and event.goal_state == goal_state


def match_node_name_start_goal(node_name: str, start_state: str, goal_state: str) -> Any:
    matches = match_node_name_goal(node_name, goal_state)
    return lambda event: matches(event) and event.start_state == start_state


def add_node_name(context: Any, node_name: str) -> None:
    return None


def get_node_name_count(context: Any, node_name: str) -> int:
    return 1


def evaluate_parameter_dict(context: Any, parameters: Any) -> Any:
    raise NotHereError("the values of parameters are known only when it is launched")


def evaluate_parameters(context: Any, parameters: Any) -> Any:
    return evaluate_parameter_dict(context, parameters)


def to_parameters_list(context: Any, node_name: str, namespace: str, evaluated_parameters: Any) -> Any:
    return evaluate_parameter_dict(context, evaluated_parameters)


class PluginException(Exception):
    pass


def get_upper_bound_caret_version(version: Any) -> Any:
    return f"{int(str(version).partition('.')[0]) + 1}.0.0"


def satisfies_version(version: Any, caret_range: str) -> None:
    return None


def event_named(name: str) -> Any:
    return lambda event: event.name == name


def gen_handler(entities: Any) -> Any:
    return lambda event, context: entities
