"""The plugins that Nav2 has in each distribution, by the names that its plugin descriptions give them.

pluginlib looks for the name itself: `nav2_navfn_planner/NavfnPlanner` of Humble is `nav2_navfn_planner::NavfnPlanner`
since Jazzy (https://docs.nav2.org/migration/Iron.html). What was renamed before that is in its `migration` folder, too.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

from preflight_analysis.catalogue.released import DISTRIBUTIONS

PLUGINS = Path(__file__).with_name("data") / "plugins.txt"
"""A line a plugin: its name and the letters of the distributions that have it. Lines with `#` say where it is from."""
_GENERATION = 2
_RENAMED = {"nav2_recoveries": "nav2_behaviors", "smac_planner": "nav2_smac_planner"}
_CALLED = {"SmacPlanner": "SmacPlannerHybrid"}
_MARK = re.compile(r"/|::")


def is_known(distro: str | None) -> bool:
    """Whether the plugins of the distribution are known."""
    letter = DISTRIBUTIONS[_GENERATION].get(distro or "")
    return letter is not None and any(letter in letters for letters in _letters().values())


def names_of(package: str, distro: str) -> tuple[str, ...]:
    """The plugins of a package of Nav2 there; none of any other package."""
    letter = DISTRIBUTIONS[_GENERATION].get(distro, " ")
    return tuple(
        name for name, of in _letters().items() if letter in of and _MARK.split(name, maxsplit=1)[0] == package
    )


def distributions_with(name: str) -> tuple[str, ...]:
    """The distributions whose Nav2 has the plugin of that very name, the oldest first."""
    letters = _letters().get(name, "")
    return tuple(distro for distro, letter in DISTRIBUTIONS[_GENERATION].items() if letter in letters)


def name_there(name: str, distro: str) -> str | None:
    """What the distribution calls a plugin that others call `name`: with another mark, or in another package."""
    package, leaf = ["", *_MARK.split(name)][-2:]
    leaves = (leaf, _CALLED.get(leaf, leaf))
    known = names_of(package, distro) or names_of(_RENAMED.get(package, ""), distro)
    return next((each for each in known if each != name and _MARK.split(each)[-1] in leaves), None)


@lru_cache(maxsize=1)
def _letters() -> Mapping[str, str]:
    lines = PLUGINS.read_text().splitlines()
    return dict(line.split(" ", 1) for line in lines if not line.startswith("#"))
