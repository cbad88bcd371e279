"""Which sections of a parameter file nodes take, as people edit it: one that a launch file wrote of it
(`RewrittenYaml`, `ReplaceString`) stands for it (ROS 2)."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.param_files import ParamFile, Section
from preflight_analysis.evaluation.tree import FileSection, LaunchNode, ParamSource


class SectionReader:
    """Which sections of a file its sources have for nodes, by their numbers."""

    def __init__(self, path: str, file: ParamFile) -> None:
        self._path, self._file = path, file
        self._at = {id(section): at for at, section in enumerate(file.sections)}
        self._made: dict[str, list[tuple[Section, set[int]]]] = {}
        self._is_read = False

    def patterns(self, at: int) -> frozenset[str]:
        """What a section is for, as nodes get it; nothing where a launch file made what is not found again."""
        made = (each.pattern for of_source in self._made.values() for each, of in of_source if at in of)
        own = (self._file.sections[at].pattern,) if self._is_read or not self._made else ()
        return frozenset((*made, *own))

    def reached(self, source: ParamSource, node: LaunchNode, name: str | None = None) -> set[int]:
        """Those for a node, or for another one of its process."""
        if source.sections and source.path is not None:
            made = self._made_of(source.path, source.sections)
            return {at for each, of in made if each.fits(name or node.name) for at in of}
        if source.made_from is not None:
            patterns = {f"/{key.strip('/')}" for key in source.keys}
            return {at for pattern in patterns for at in self._of_pattern(pattern)}
        return self.as_it_stands(name or node.name, composable=node.kind == "composable" and name is None)

    def as_it_stands(self, name: str, *, composable: bool = False) -> set[int]:
        """Those for a node that gets the text as it is written."""
        self._is_read = True
        return {self._at[id(section)] for section in self._file.reaching(name, composable=composable)}

    def in_namespace(self, name: str, namespace: str) -> set[int]:
        """Those for a node of Nav2's launch files, which put the sections below its namespace."""
        self._is_read = True
        below = {name, name.removeprefix(namespace.rstrip("/"))}
        return {at for each in below for at in self.as_it_stands(each)}

    def _made_of(self, path: str, sections: tuple[FileSection, ...]) -> list[tuple[Section, set[int]]]:
        if path not in self._made:
            self._made[path] = [(Section(each.pattern, (), (), each.key), self._origin(each)) for each in sections]
        return self._made[path]

    def _origin(self, made: FileSection) -> set[int]:
        """The sections that one was made of: that of its key, which may have got a namespace, else that in which its
        parameters stand."""
        if found := self._of_pattern(made.pattern):
            return found
        places = {p.name_location.span for p in made.params if p.name_location and p.name_location.file == self._path}
        return {
            at
            for at, section in enumerate(self._file.sections)
            if any(param.name_span in places for param in section.params)
        }

    def _of_pattern(self, pattern: str) -> set[int]:
        ends = [each.pattern for each in self._file.sections if pattern.endswith(each.pattern)]
        longest = max(ends, key=len, default="")
        return {at for at, each in enumerate(self._file.sections) if each.pattern == longest}


def taken_by(node: LaunchNode, source: ParamSource, file: ParamFile) -> list[Section]:
    """The sections that a node takes of a file as people edit it, of which the source is or was made."""
    reader = SectionReader(source.made_from or source.path or "", file)
    return [file.sections[at] for at in sorted(reader.reached(source, node))]
