"""The names of released packages."""

from __future__ import annotations

from preflight_analysis.catalogue.released import debian_package, distributions_with, nearest_released


def test_the_distributions_that_have_a_package() -> None:
    assert distributions_with("nav2_bringup", 2)[:3] == ("foxy", "galactic", "humble")
    assert "noetic" in distributions_with("move_base", 1)
    assert distributions_with("move_base", 2) == ()
    assert distributions_with("no_such_package_anywhere", 1) == ()


def test_the_name_of_a_debian_package() -> None:
    assert debian_package("nav2_bringup", "jazzy") == "ros-jazzy-nav2-bringup"


def test_near_names_are_those_of_the_generation() -> None:
    assert list(nearest_released("nav2_bringap", 2, 1)) == ["nav2_bringup"]
    assert "move_base" not in nearest_released("move_bas", 2, 1)
    assert list(nearest_released("move_base", 1, 0)) == []
