"""What is found among many names is what a comparison with each of them finds."""

from __future__ import annotations

import random

import pytest
from preflight_analysis.model.alike import Names
from preflight_analysis.model.near_miss import extra_level
from preflight_analysis.model.nearest import likeness

WORDS = ("camera", "front", "image", "raw", "points", "cmd", "vel", "cmdvel", "odom", "c_am", "came", "scan", "scan1")


def _name(made: random.Random) -> str:
    segments = ("_".join(made.choices(WORDS, k=made.randint(1, 3))) for _ in range(made.randint(1, 3)))
    name = "/" + "/".join(segments)
    at = made.randrange(1, len(name))
    return made.choice((name, name, name[:at] + name[at + 1 :], name[:at] + made.choice("ab_") + name[at:]))


@pytest.mark.parametrize("seed", range(4))
def test_nothing_that_is_alike_is_missed(seed: int) -> None:
    made = random.Random(seed)
    many = sorted({_name(made) for _ in range(400)})
    known = Names((name, name) for name in many)
    typos = 0
    for name in (*many[::4], *(_name(made) for _ in range(100))):
        how = {other: likeness(name, other) for other in many}
        of_typos = {other for other, each in how.items() if each is not None and each[0] == "typo"}
        assert of_typos <= {other for other, _ in known.typos(name)}
        of_words = {other for other, each in how.items() if each is not None and each[0] == "words"}
        assert of_words <= {other for other, _ in known.alike(name)} <= of_words | of_typos
        levels = {other for other in many if extra_level(*sorted((name, other), key=len)) is not None}
        assert levels | of_typos <= {*known.close(name)}
        typos += len(of_typos)
    assert typos
