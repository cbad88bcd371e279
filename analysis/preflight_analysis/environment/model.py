"""The user's ROS environment as data. It is not the server's own interpreter, which needs no ROS."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field, replace
from functools import cached_property

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.secrets import Access
from preflight_analysis.generation import Generation, ros


@dataclass(frozen=True, slots=True)
class Package:
    """A package found by its `package.xml`. `share` is the folder that `$(find)` gives."""

    name: str
    share: str
    manifest: str
    dependencies: frozenset[str] = frozenset()
    build_type: str | None = None
    """`ament_cmake`, `ament_python` or `catkin`, None where the manifest does not say."""
    conditional: tuple[tuple[int, str], ...] = ()
    """Of one that is built for both generations the build type for each."""

    @property
    def is_ament(self) -> bool:
        """Whether ament builds it."""
        return (self.build_type or "").startswith("ament")

    def is_within(self, folder: str | None) -> bool:
        """Whether its share folder is `folder` or below it; never where there is no folder."""
        return folder is not None and f"{self.share}/".startswith(f"{folder.rstrip('/')}/")

    def built_for(self, generation: int) -> Package:
        """It as it is built for a generation of ROS."""
        chosen = dict(self.conditional).get(generation, self.build_type)
        return self if chosen == self.build_type else replace(self, build_type=chosen)

    @property
    def generation(self) -> int:
        """The ROS that it is for, as far as its build type tells."""
        return 2 if self.is_ament else 1


@dataclass(frozen=True, slots=True)
class Executable:
    """What `pkg` and `type` lead to. `path` is None when nothing was found; `candidates` are all that were."""

    path: str | None
    candidates: tuple[str, ...] = ()
    package_path: str | None = None
    """None when the package itself was not found."""
    not_executable: tuple[str, ...] = ()
    """Files of that name that may not be executed: what is missing is a `chmod +x`."""
    entry_point: str | None = None
    """`module:function` of a Python package that is run from its source; `path` is then the module's file."""


class Packages(dict[str, Package]):
    """Packages by name. Never changed."""

    @cached_property
    def by_folder(self) -> Mapping[str, Package]:
        """The same by the folders that they are in."""
        return {package.share.rstrip("/"): package for package in self.values()}


@dataclass(frozen=True, slots=True, eq=False)
class Environment:
    """What launch files and nodes see. Immutable; a new one is detected when package folders or settings change. It is
    equal to itself alone, and so a key by which is remembered what was found with it.

    `packages` has, for each name, the first package in the order of the package path; `shadowed` the others.
    `variables` is what `$(env)` reads and what nodes get (before the sandbox filters it), without those that are
    `withheld`.
    """

    generation: int
    distro: str | None
    variables: Mapping[str, str]
    package_path: tuple[str, ...]
    packages: Mapping[str, Package]
    shadowed: Mapping[str, tuple[Package, ...]]
    devel_spaces: tuple[str, ...]
    """catkin devel and install spaces whose `lib/<pkg>` and `share/<pkg>` hold executables, first wins."""
    system_prefixes: tuple[str, ...]
    """Prefixes such as `/usr` and `/opt/ros/noetic`."""
    python: str | None
    """The interpreter that has rospy, None when there is none."""
    workspace: str | None = None
    problems: tuple[str, ...] = ()
    """What is missing, in sentences that say what to install."""
    ament_prefixes: tuple[str, ...] = ()
    """Prefixes of ROS 2 whose `share` and `lib` hold installed packages, the first one wins."""
    ros2_python: str | None = None
    """The interpreter that has rclpy, None when there is none."""
    meant: Mapping[str, str] = field(default_factory=dict)
    """As one launch file sees it: the folders of packages that are others than for most, by name."""
    own_variables: Mapping[str, str] = field(default_factory=dict)
    """The variables as the user has them, without what is only found in the workspace: what a program outside of the
    sandbox starts from."""
    workspace_folders: tuple[str, ...] = ()
    """The folders of the workspace, whose links are not to be believed; as they are written and as they really are."""
    named_folders: tuple[str, ...] = ()
    """Folders and files that the user named, likewise: by variables, package path and interpreters. See `reach.py`."""
    debians: bool = False
    """Whether ROS 1 comes from Debian's own archive here, whose packages have other names than those of ROS's."""
    distro_by: str = ""
    """What of the workspace says which distribution it is for, where none is sourced or installed."""
    meant_for: tuple[str, ...] = ()
    """The distributions that the workspace says it is for, whichever is used here."""
    withheld: frozenset[str] = frozenset()
    """The names of the variables that are set and whose values are secrets: nobody is told these."""
    allowed_secrets: tuple[str, ...] = ()
    """The secrets that the user allows: paths and names of variables."""
    beside: tuple[str, ...] = ()
    """Further folders that the user has open, as they really are: their files may be read."""
    outside: bool = True
    """Whether its launch files may name files out of the workspace and of what the user named."""

    @property
    def ros(self) -> Generation:
        """What is so in its generation of ROS."""
        return ros(self.generation)

    @property
    def access(self) -> Access:
        """What may be read of the disk for its launch files."""
        named = (
            *self.workspace_folders,
            *self.named_folders,
            *self.system_prefixes,
            *self.ament_prefixes,
            *self.beside,
        )
        return Access(named, self.allowed_secrets, self.outside)

    def is_installed(self, package: Package) -> bool:
        """Whether a package lies where ROS is installed, and not in the workspace."""
        return any(map(package.is_within, (*self.system_prefixes, *self.ament_prefixes)))

    @property
    def own_packages(self) -> list[Package]:
        """Those that are not installed with ROS."""
        return [package for package in self.packages.values() if not self.is_installed(package)]

    def interpreter(self, generation: int) -> str | None:
        """The one that has rospy or rclpy."""
        return {1: self.python, 2: self.ros2_python}[generation]

    def __post_init__(self) -> None:
        if not isinstance(self.packages, Packages):
            object.__setattr__(self, "packages", Packages(self.packages))

    @property
    def packages_by_folder(self) -> Mapping[str, Package]:
        """The packages by the folders that they are in."""
        assert isinstance(self.packages, Packages)
        return self.packages.by_folder
