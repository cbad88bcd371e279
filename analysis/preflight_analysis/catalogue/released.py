"""The names of all packages that distributions of ROS have released, and of what rosdep knows beside them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

from preflight_analysis.slips import within

DISTRIBUTIONS: Mapping[int, Mapping[str, str]] = {
    1: {"indigo": "I", "kinetic": "K", "melodic": "M", "noetic": "N"},
    2: {
        "foxy": "f",
        "galactic": "g",
        "humble": "h",
        "iron": "i",
        "jazzy": "j",
        "kilted": "k",
        "lyrical": "l",
        "rolling": "r",
    },
}
"""Those whose packages are known, of each generation, the oldest first, with the letter that each has in the data."""
DATA = Path(__file__).with_name("data")
RELEASED = DATA / "released.txt"
"""A line a package: its name and the letters of the distributions that have it. Lines with `#` say where it is from."""

DEBIAN = DATA / "debian.txt"
"""A line a package of ROS: its name and the packages of Debian's own archive that have it. Lines with `#` as above."""

ROSDEP = DATA / "rosdep.txt"
"""A line a key: what rosdep knows of packages of operating systems. Lines with `#` say where it is from."""


@lru_cache(maxsize=1)
def system_keys() -> frozenset[str]:
    """The names of packages of operating systems by which `package.xml` may ask for them."""
    return frozenset(line for line in ROSDEP.read_text().splitlines() if not line.startswith("#"))


def distributions_with(name: str, generation: int) -> tuple[str, ...]:
    """The distributions of a generation that have a package, the oldest first."""
    letters = _letters().get(name, "")
    return tuple(distro for distro, letter in DISTRIBUTIONS[generation].items() if letter in letters)


def debian_package(name: str, distro: str) -> str:
    """What a package of ROS is called where it is installed from its distribution."""
    return f"ros-{distro}-{name.replace('_', '-')}"


def in_debian(name: str) -> str | None:
    """What of Debian's own archive has a package of ROS 1, apart by blanks; None where nothing is known to."""
    return _in_debian().get(name)


@lru_cache(maxsize=1024)
def nearest_released(name: str, generation: int, edits: int) -> tuple[str, ...]:
    """The packages of a generation, in whichever distribution, that are at most so many edits away; nearest first."""
    return tuple(within(name, _names(generation), edits, 4))


@lru_cache(maxsize=1)
def released_words() -> frozenset[str]:
    """The words that the names of packages are made of, of which several have each."""
    words = Counter(word for name in _letters() for word in set(name.split("_")))
    return frozenset(word for word, times in words.items() if times > 1)


@lru_cache(maxsize=2)
def _names(generation: int) -> tuple[str, ...]:
    letters = set(DISTRIBUTIONS[generation].values())
    return tuple(name for name, of in _letters().items() if not letters.isdisjoint(of))


@lru_cache(maxsize=1)
def _letters() -> Mapping[str, str]:
    return _table(RELEASED)


@lru_cache(maxsize=1)
def _in_debian() -> Mapping[str, str]:
    return _table(DEBIAN)


def _table(data: Path) -> Mapping[str, str]:
    lines = data.read_text().splitlines()
    return dict(line.split(" ", 1) for line in lines if not line.startswith("#"))
