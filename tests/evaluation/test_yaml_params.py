import gc
import weakref
from contextlib import suppress
from traceback import walk_tb

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from preflight_analysis.evaluation import yaml_params
from preflight_analysis.evaluation.yaml_params import YamlError, YamlValue, load_yaml


def test_keys_have_their_places() -> None:
    text = "a:\n  bc: 1\nd: {e: 2}\n"
    keys = load_yaml(text).keys
    assert {path: text[span.start : span.end] for path, span in keys.items()} == {
        ("a",): "a",
        ("a", "bc"): "bc",
        ("d",): "d",
        ("d", "e"): "e",
    }


def test_aliases_that_multiply_are_refused() -> None:
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]" for n in range(1, 12)]
    with pytest.raises(YamlError, match="unfolds to more than"):
        load_yaml("\n".join(lines))


@pytest.mark.parametrize(
    "text",
    [
        "a: [1, ",
        "\ta: 1",
        "a: *nothing",
        "&a [*a]",
        "!!python/object/apply:os.system [ls]",
        "a: 1\n---\nb: 2",
        "a: rad(x)",
    ],
)
def test_what_cannot_be_loaded_is_an_error_with_a_message(text: str) -> None:
    with pytest.raises(YamlError) as error:
        load_yaml(text)
    assert error.value.message


@given(st.text(alphabet="ab:-[]{}&*!|>#'\"\n\t ,01.?%@`", max_size=80))
@settings(max_examples=300, deadline=None)
def test_nothing_but_its_own_error_comes_out(text: str) -> None:
    with suppress(YamlError):
        loaded = load_yaml(text)
        assert all(0 <= span.start <= span.end <= len(text) for span in loaded.keys.values())


@pytest.mark.parametrize(
    "text", ["a: rad(pi/2)\nb: [deg(90), {c: 0x10}]\n", "a: !degrees 90\n", "- 1_000\n- 2001-01-01\n"]
)
def test_values_and_places_are_pyyamls_whichever_parser_makes_the_nodes(
    text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    fast = yaml_params._load(text)
    monkeypatch.setattr(yaml_params, "_LibyamlLoader", yaml_params._Loader)
    slow = yaml_params._load(text)
    assert isinstance(fast, YamlValue) and isinstance(slow, YamlValue)
    assert (fast.value, fast.keys, fast.twice) == (slow.value, slow.keys, slow.twice)


def test_a_remembered_error_keeps_nothing_of_who_asked_and_does_not_grow() -> None:
    class Local:
        pass

    def ask() -> tuple[weakref.ref[Local], int]:
        local = Local()
        try:
            load_yaml("[only: here")
        except YamlError as error:
            return weakref.ref(local), len(list(walk_tb(error.__traceback__)))
        raise AssertionError

    answers = [ask() for _ in range(3)]
    gc.collect()
    assert [local() for local, _ in answers] == [None] * 3
    assert len({frames for _, frames in answers}) == 1
