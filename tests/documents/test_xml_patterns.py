"""Names of XML, against the productions of the specification."""

from __future__ import annotations

import re

from preflight_analysis.documents.xml_patterns import NAME, NAME_START, NO_NAME_STARTS

# https://www.w3.org/TR/xml/#NT-NameStartChar
STARTS = (
    ":A-Z_a-z\xc0-\xd6\xd8-\xf6\xf8-\u02ff\u0370-\u037d\u037f-\u1fff\u200c-\u200d\u2070-\u218f\u2c00-\u2fef"
    "\u3001-\ud7ff\uf900-\ufdcf\ufdf0-\ufffd\U00010000-\U000effff"
)
WITHIN = f"{STARTS}\\-.0-9\xb7\u0300-\u036f\u203f-\u2040"
ALL = "".join(map(chr, range(0x110000)))


def test_every_character_is_as_the_specification_says() -> None:
    starts = "".join(re.findall(f"[{STARTS}]", ALL))
    assert "".join(re.findall(NAME_START, ALL)) == starts
    assert "".join(re.findall(f"[^{NO_NAME_STARTS}]", ALL)) == starts
    within = re.findall(f"[{WITHIN}]", ALL)
    assert re.fullmatch(NAME, "".join(("a", *within)))
    others = re.findall(f"[^{WITHIN}]", ALL)
    assert not any(re.fullmatch(NAME, f"a{each}") for each in others)
