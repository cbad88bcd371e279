"""Names and the namespaces around them: however they came about, they are those of all names that are there."""

from hypothesis import given
from hypothesis import strategies as st
from preflight_analysis.evaluation.names import with_namespaces
from preflight_analysis.model.name_tally import NO_NAMES

_NAMES = st.lists(st.sampled_from(["/a", "/a/b", "/a/b/c", "/a/b/d", "/a/e/f/g", "/h", "/", "/h/i"]), max_size=8)


@given(st.lists(st.tuples(_NAMES, st.randoms(use_true_random=False)), max_size=6))
def test_it_is_that_of_the_names_that_are_there(steps: list) -> None:
    tally, there = NO_NAMES, list[str]()
    for come, random in steps:
        gone = random.sample(there, random.randint(0, len(there)))
        names_before, spaces_before = set(tally.counts), set(tally.around)
        tally, different = tally.changed(gone, come)
        for name in gone:
            there.remove(name)
        there += come
        assert tally.counts == {name: there.count(name) for name in there}
        assert tally.around.keys() == with_namespaces(name.rpartition("/")[0] for name in there)
        assert different >= (names_before ^ set(tally.counts)) | (spaces_before ^ set(tally.around))


def test_a_name_that_is_there_twice_stays_when_one_goes() -> None:
    twice, _ = NO_NAMES.changed((), ["/a/b", "/a/b"])
    once, different = twice.changed(["/a/b"], ())
    assert "/a/b" in once
    assert "/a" in once
    assert not different
