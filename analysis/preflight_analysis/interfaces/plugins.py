"""Which parameters plugins declare in the nodes that load them: by their source in the workspace, or the catalogue."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

from preflight_analysis.catalogue.packages import distribution_of, interfaces_of
from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.model.context import Plugin
from preflight_analysis.source.analyse import SourceAnalysis

_GENERATION = 2
_KEPT = 512
_PACKAGES = {"mppi": "nav2_mppi_controller"}
"""Packages of plugins whose namespace is another one."""


def package_of(name: str) -> str:
    """The package of the plugin `package::Name` by convention; empty where the name has none."""
    owner, colons, rest = name.partition("::")
    return _PACKAGES.get(owner, owner) if colons and rest else ""


class PluginIndex:
    """The plugins that are known. Implements `rules.rule.Plugins`."""

    def __init__(self, environment: Environment, disk: Disk) -> None:
        self._environment = environment
        self._disk = disk
        self._distro = distribution_of(_GENERATION, environment.distro)

    def plugin(self, name: str) -> Plugin | None:
        """The plugin `package::Name`, also written `package/Name`."""
        name = name.replace("/", "::")
        package = package_of(name)
        if not package:
            return None
        here = self._environment.packages.get(package)
        if here is not None and self._is_ours(here):
            return self._of_source(name, package)
        return _catalogued(package, name, self._distro)

    def names(self, package: str) -> tuple[str, ...]:
        """The plugins that a package has, as far as the catalogue knows it; none where it is in the workspace."""
        here = self._environment.packages.get(package)
        known = interfaces_of(package, self._distro) if here is None or not self._is_ours(here) else {}
        return (*known.get("controllers", ()), *known.get("plugins", ()))

    def exported(self, package: str) -> tuple[str, ...]:
        """The plugins, of any kind, that the descriptions of a package in the workspace list."""
        here = self._environment.packages.get(package)
        if here is None or not self._is_ours(here):
            return ()
        return SourceAnalysis(self._environment, self._disk).exported(package)

    def _is_ours(self, package: Package) -> bool:
        """Whether it is of the workspace, whose version may be any."""
        environment = self._environment
        if package.is_within(environment.workspace):
            return True
        return not environment.is_installed(package)

    def _of_source(self, name: str, package: str) -> Plugin | None:
        # Loads the parser, which who has no plugins does without.
        from preflight_analysis.source.plugins import plugin_params  # noqa: PLC0415

        found = plugin_params(SourceAnalysis(self._environment, self._disk), name, package)
        defaults = {param: use.default for param, use in (found or {}).items()}
        evidence = f"its source in package '{package}'"
        return Plugin(name, defaults, frozenset(), evidence, of_workspace=True) if defaults else None


@lru_cache(maxsize=_KEPT)
def _catalogued(package: str, name: str, distro: str) -> Plugin | None:
    """What the catalogue knows of a plugin; None where that is nothing, or the data is broken."""
    try:
        of_package = interfaces_of(package, distro)
        found = of_package["plugins"][name]
        params: Mapping[str, Mapping[str, object]] = found.get("parameters", {})
        repository, commit, _ = of_package["source"]
        defaults = {param: about.get("default_value") for param, about in params.items()}
        evidence = f"the catalogue of {distro} ({repository} at {commit[:7]})"
        return Plugin(name, defaults, frozenset(found.get("elsewhere", ())), evidence)
    except (KeyError, TypeError, ValueError, AttributeError):
        return None
