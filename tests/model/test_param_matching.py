"""What is set against what is asked for: brought up to date from step to step it is what it would be made anew."""

from dataclasses import fields

from hypothesis import example, given, settings
from hypothesis import strategies as st
from preflight_analysis.evaluation.tree import Param
from preflight_analysis.graph.model import ParamRead
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.model.param_matching import Asked, Matched, asked_by, matched
from preflight_analysis.model.parameters import namespace_of
from preflight_analysis.tracing.interface import ParamUse

_NODES = ("/n", "/a/m", "/b", "/n")
_SET = ("/n/x", "/n/y", "/n/y/z", "/a/m/x", "/a/x", "/b/c/d/x", "/x", "/b/x")
_READ = (*_SET, "/n/", "/a", "/", "/b/c/y")
_ACCESS = ("get", "get", "has", "set", "search", "list")


@st.composite
def _steps(draw: st.DrawFn) -> list[tuple[list[str], list[list[tuple[str, str]]], list[str], list[bool]]]:
    read = st.tuples(st.sampled_from(_READ), st.sampled_from(_ACCESS))
    count = draw(st.integers(1, 4))
    step = st.tuples(
        st.lists(st.sampled_from(_SET), unique=True),
        st.lists(st.lists(read, max_size=3), min_size=count, max_size=count),
        st.lists(st.sampled_from(_NODES), min_size=count, max_size=count),
        st.lists(st.booleans(), min_size=count, max_size=count),
    )
    return draw(st.lists(step, min_size=2, max_size=5))


@settings(deadline=None, derandomize=True, max_examples=300)
@given(_steps())
@example([(["/a/m/x"], [[]], ["/n"], [False]), (["/n/x"], [[("/n/x", "search")]], ["/n"], [False])])
def test_it_does_not_show_what_was_before(steps: list) -> None:
    kept = Kept()
    params = {name: Param(name, 1, ()) for name in _SET}
    asked_before: dict[tuple, Asked] = {}
    for names, reads, nodes, known in steps:
        asked = tuple(asked_before.setdefault(tuple(each), _asked(each)) for each in reads)
        kept = Kept(kept)
        groups = kept.grouped(namespace_of, "", tuple(params[name] for name in names))
        arguments = groups, asked, tuple(nodes), tuple(known)
        assert _plain(kept.patched(matched, "", *arguments)) == _plain(matched(None, *arguments))


def _asked(reads: list[tuple[str, str]]) -> Asked:
    return asked_by(tuple(ParamRead(name, None, ParamUse(name, access)) for name, access in reads))  # type: ignore[arg-type]


def _plain(found: Matched) -> dict[str, object]:
    plain: dict[str, object] = {each.name: getattr(found, each.name) for each in fields(found)}
    plain.update(given=(found.given.counts, found.given.around), asked=(found.asked.counts, found.asked.around))
    plain["leaves"] = {leaf: count for leaf, count in found.leaves.items() if count}
    plain["spaces"] = [(space, each.unread, each.holder) for space, each in found.spaces.items()]
    return plain
