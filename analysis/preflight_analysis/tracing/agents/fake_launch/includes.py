"""`launch.launch_description_sources`, and the action that includes them."""

from __future__ import annotations

from typing import Any, Optional

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

    def __init__(
        self,
        launch_description: Optional[LaunchDescription] = None,
        location: Any = "<string>",
        method: str = "unspecified mechanism from a script",
    ) -> None:
        self.preflight_description = launch_description
        self.preflight_location = normalize_to_list_of_substitutions(location)
        self.__method = method

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
        return self.__method


class AnyLaunchDescriptionSource(LaunchDescriptionSource):
    def __init__(self, launch_file_path: Any) -> None:
        super().__init__(None, launch_file_path, "interpreted launch file")


class FrontendLaunchDescriptionSource(LaunchDescriptionSource):
    def __init__(
        self, launch_file_path: Any, *, method: str = "interpreted frontend launch file", parser: Any = None
    ) -> None:
        super().__init__(None, launch_file_path, method)


class PythonLaunchDescriptionSource(LaunchDescriptionSource):
    kind = "python"

    def __init__(self, launch_file_path: Any) -> None:
        super().__init__(None, launch_file_path, "interpreted python launch file")


class XMLLaunchDescriptionSource(FrontendLaunchDescriptionSource):
    kind = "xml"

    def __init__(self, launch_file_path: Any) -> None:
        super().__init__(launch_file_path, method="interpreted XML launch file")


class YAMLLaunchDescriptionSource(FrontendLaunchDescriptionSource):
    kind = "yaml"

    def __init__(self, launch_file_path: Any) -> None:
        super().__init__(launch_file_path, method="interpreted YAML launch file")


class IncludeLaunchDescription(Action):
    def __init__(self, launch_description_source: Any, *, launch_arguments: Any = None, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        if not isinstance(launch_description_source, LaunchDescriptionSource):
            launch_description_source = AnyLaunchDescriptionSource(launch_description_source)
        self.__source = launch_description_source
        self.__arguments = () if launch_arguments is None else tuple(launch_arguments)

    @property
    def launch_description_source(self) -> Any:
        return self.__source

    @property
    def launch_arguments(self) -> Any:
        return self.__arguments

    def preflight_serialize(self, t: Any) -> None:
        description = self.__source.preflight_description
        t.kind = "include" if description is None else "inline"
        if description is None:
            t.attribute("file", self.__source.preflight_location)
            t.attribute("source", self.__source.kind or None)
        for pair in self.__arguments:
            name, value = pair
            t.child("arg" if description is None else "arg_passed", name=name, value=value)
        if description is not None:
            t.entities(description.entities)
