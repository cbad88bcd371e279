"""The scripts of pages: modules that are joined to one script, as a page that stands alone needs it."""

from __future__ import annotations

import re
from importlib.resources import files

import pytest
from preflight_analysis.view.page_parts import script

PAGE = files("preflight_analysis.view").joinpath("page")
NAMES = re.compile(r"^(?:export )?(?:const|let|function|async function|class) (\w+)", re.MULTILINE)


def modules() -> dict[str, str]:
    return {each.name: each.read_text() for each in PAGE.iterdir() if each.name.endswith(".js")}


@pytest.mark.parametrize("name", ["view.js", "tree.js"])
def test_nothing_of_modules_is_left(name: str) -> None:
    joined = script(name)
    assert joined.startswith('"use strict";')
    assert re.findall(r"^(?:import|export)\b.*", joined, flags=re.MULTILINE) == []


def test_each_module_is_joined_once_after_what_it_imports() -> None:
    joined = script("view.js")
    at = {name: joined.index(text.splitlines()[0]) for name, text in modules().items() if name != "tree.js"}
    for name, text in modules().items():
        if name != "tree.js":
            assert joined.count(text.splitlines()[0]) == 1
            assert all(at[other] < at[name] for other in re.findall(r'from "\./(\w+\.js)";$', text, re.MULTILINE))


def test_joined_modules_have_no_name_in_common() -> None:
    names = NAMES.findall("\n".join(text for name, text in modules().items() if name != "tree.js"))
    assert len(names) > 50
    assert sorted(set(names)) == sorted(names)


def test_no_module_renames_what_it_imports() -> None:
    for text in modules().values():
        assert not re.search(r"^import .* as ", text, flags=re.MULTILINE)
