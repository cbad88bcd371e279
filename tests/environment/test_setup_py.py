"""What a setup.py says, whatever stands in it."""

import pytest
from preflight_analysis.environment.setup_py import read_python_build

ENTRY = (
    "from setuptools import setup\nsetup(name='p', data_files=d, entry_points={'console_scripts': ['a = p.a:main']})\n"
)


@pytest.mark.parametrize(
    "text",
    [
        "d = ['x']\n" + "d = d + d\n" * 60,
        "d = '%999999999d' % 5\n",
        "d = '%*d' % (999999999, 5)\n",
        "x = ['a']\n" + "x = x + x\n" * 11 + "d = [[[[c for e in x] for c in x] for b in x] for a in x]\n",
        "s = 'xx'\n" + "s = f'{s}{s}'\n" * 60 + "d = [s]\n",
        "d = 5 % 0\n",
    ],
)
def test_what_would_take_all_memory_is_not_known(text: str) -> None:
    build = read_python_build("/p", "p", lambda path: text + ENTRY if path.endswith("setup.py") else None)
    assert (list(build.scripts), build.complete) == (["a"], False)
