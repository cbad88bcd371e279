"""The names of released packages."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from preflight_analysis.catalogue.released import debian_package, distributions_with, in_debian, nearest_released


def test_the_distributions_that_have_a_package() -> None:
    assert distributions_with("nav2_bringup", 2)[:3] == ("foxy", "galactic", "humble")
    assert "noetic" in distributions_with("move_base", 1)
    assert distributions_with("move_base", 2) == ()
    assert distributions_with("no_such_package_anywhere", 1) == ()


def test_the_name_of_a_debian_package() -> None:
    assert debian_package("nav2_bringup", "jazzy") == "ros-jazzy-nav2-bringup"


def test_what_debian_has() -> None:
    assert in_debian("joint_state_publisher") == "joint-state-publisher"
    assert in_debian("tf") == "libtf-dev tf-tools"
    assert in_debian("move_base") is None


@pytest.mark.ros
def test_what_debian_has_is_what_this_one_has_installed() -> None:
    """By dpkg, of the packages of ROS that are installed here."""
    query = ["dpkg-query", "--search", "/usr/share/*/package.xml"]
    done = subprocess.run(query, capture_output=True, text=True, check=True)
    owners = [line.split(": ") for line in done.stdout.splitlines() if line.count("/") == 4]
    here = {Path(path).parent.name: owner.partition(":")[0] for owner, path in owners}
    assert len(here) > 30
    wrong = {name: owner for name, owner in here.items() if owner not in str(in_debian(name)).split(" ")}
    assert wrong == {"rosbag_storage": "librosbag-storage4d"}, "its name has a number that changes"


def test_near_names_are_those_of_the_generation() -> None:
    assert list(nearest_released("nav2_bringap", 2, 1)) == ["nav2_bringup"]
    assert "move_base" not in nearest_released("move_bas", 2, 1)
    assert list(nearest_released("move_base", 1, 0)) == []
