import math
import time
from contextlib import suppress
from types import EllipsisType, NoneType

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from preflight_analysis.evaluation.expression import EvaluationError, NotAllowedError, evaluate, evaluate_arithmetic


def no_names(name: str) -> object:
    raise KeyError(name)


@pytest.mark.parametrize(
    "hostile",
    [
        "().__class__",
        "open('/etc/passwd')",
        "exec('1')",
        "eval('1')",
        "(lambda: 1)()",
        "[x for x in (1,)]",
        "str.format('{0.a}', 1)",
        "'{0.real}'.format(1)",
        "'{0[0]}'.format([1])",
        "'{:99999999}'.format(1)",
        "'{:{}}'.format(1, 99999999)",
        "'{!r:>99999999}'.format(1)",
        "format(1, '99999999d')",
        "'a'.zfill(10**12)",
        "f'{1}'",
        "getattr(1, 'real')",
        "''.encode()",
        "(y := 1)",
        "9**9**9**9",
        "'a' * 10**12",
        "[0] * 10**12",
        "1 << 10**12",
        "'%999999999d' % 1",
        "'%*d' % (10**9, 1)",
        "factorial(10**9)",
        "comb(10**9, 10**8)",
        "('a' * 100000).replace('a', 'b' * 100000)",
        "(" * 5000 + ")" * 5000,
        "-" * 100_000 + "1",
        "list(range(10**12))",
        "max(range(10**12))",
        "sum([[0] * 1000] * 1000, [])",
        "str([['a' * 1000000] * 1000] * 1000)",
        "'%s' % [['a' * 1000000] * 1000]",
        "list(map(list, ['a' * 1000] * 1000000))",
        "list(map(range, [1000000] * 1000))",
        "('a' * 100000).join(['a'] * 100000)",
        "[[0] * 1000000] * 1000000 == [[0] * 1000000] * 1000000",
        "sorted([[0] * 100000] * 100000)",
        "min",
        "map(str, [1])",
        "print(1)",
        "round(1, -10**9)",
        "list(map(round, [1], [-10**9]))",
        "prod(range(1, 1000000))",
        "globals()",
    ],
)
def test_hostile_expressions_are_refused_at_once(hostile: str) -> None:
    begin = time.monotonic()
    with pytest.raises((EvaluationError, NotAllowedError)):
        evaluate(hostile, no_names, {})
    assert time.monotonic() - begin < 60


@pytest.mark.parametrize(
    ("expression", "value"),
    [("pi / 2", math.pi / 2), ("2 ** 10", 1024), ("-3 // 2", -2), ("sqrt(2)", math.sqrt(2)), ("1 if 2 > 1 else 0", 1)],
)
def test_arithmetic(expression: str, value: float) -> None:
    assert evaluate_arithmetic(expression) == value


_PLAIN = (NoneType, EllipsisType, bool, int, float, complex, str, bytes, list, tuple, dict, set)


@given(st.text(alphabet="()[]{}+-*/%<>=!.,'\" abx019_:andortif", max_size=60))
@settings(max_examples=300, deadline=None)
def test_nothing_but_its_own_errors_comes_out(expression: str) -> None:
    with suppress(EvaluationError, NotAllowedError):
        value = evaluate(expression, no_names, {})
        assert isinstance(value, _PLAIN), value
