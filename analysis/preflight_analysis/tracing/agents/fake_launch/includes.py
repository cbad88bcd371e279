"""`launch.launch_description_sources`, and the action that includes them."""

from __future__ import annotations

from typing import Any

from .base import (
    Action,
    LaunchContext,
    LaunchDescription,
    Made,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)


class LaunchDescriptionSource(Made):
    kind = ""

    def preflight_take(self, given: Any, left: Any) -> None:
        self.preflight_description = given.launch_description
        self.preflight_location = normalize_to_list_of_substitutions(given.location)
        self.__method = given.method

    def try_get_launch_description_without_context(self) -> Any:
        return self.preflight_description

    def get_launch_description(self, context: LaunchContext) -> Any:
        if self.preflight_description is None:
            location = perform_substitutions(context, self.preflight_location)
            self.preflight_description = self._get_launch_description(location)
        return self.preflight_description

    def _get_launch_description(self, location: str) -> Any:
        """A description with nothing but the include of that file."""
        return LaunchDescription([IncludeLaunchDescription(AnyLaunchDescriptionSource(location))])

    @property
    def location(self) -> str:
        return " + ".join(sub.describe() for sub in self.preflight_location)

    @property
    def method(self) -> str:
        return str(self.__method)


class AnyLaunchDescriptionSource(LaunchDescriptionSource):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(None, given.launch_file_path, "interpreted launch file")


class FrontendLaunchDescriptionSource(LaunchDescriptionSource):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(None, given.launch_file_path, given.method)


class PythonLaunchDescriptionSource(LaunchDescriptionSource):
    kind = "python"

    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(None, given.launch_file_path, "interpreted python launch file")


class XMLLaunchDescriptionSource(FrontendLaunchDescriptionSource):
    kind = "xml"

    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(given.launch_file_path, method="interpreted XML launch file")


class YAMLLaunchDescriptionSource(FrontendLaunchDescriptionSource):
    kind = "yaml"

    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(given.launch_file_path, method="interpreted YAML launch file")


class IncludeLaunchDescription(Action):
    def preflight_take(self, given: Any, left: Any) -> None:
        super().__init__(**left)
        source = given.launch_description_source
        self.__source = source if isinstance(source, LaunchDescriptionSource) else AnyLaunchDescriptionSource(source)
        self.__arguments = () if given.launch_arguments is None else tuple(given.launch_arguments)

    @property
    def launch_description_source(self) -> Any:
        return self.__source

    @property
    def launch_arguments(self) -> Any:
        return self.__arguments

    def preflight_serialize(self, t: Any) -> None:
        description = self.__source.preflight_description
        if description is not None:
            t.kind = "inline"
        else:
            t.attribute("file", self.__source.preflight_location)
            t.attribute("source", self.__source.kind or None)
        for pair in self.__arguments:
            name, value = pair
            t.child("arg" if description is None else "arg_passed", name=name, value=value)
        if description is not None:
            t.entities(description.entities)
