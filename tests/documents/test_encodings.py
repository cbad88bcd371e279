"""Files in other encodings than UTF-8 are taken exactly where expat, roslaunch's parser, takes them."""

from itertools import product
from pathlib import Path
from xml.dom import minidom
from xml.parsers.expat import ExpatError

import pytest
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.workspace.sources import Sources

_CODECS = ("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "latin-1")
_DECLARED = (None, "UTF-8", "utf-16", "UTF-16LE", "ISO-8859-1")


def _text(declared: str | None) -> str:
    declaration = f'<?xml version="1.0" encoding="{declared}"?>\n' if declared else ""
    return f'{declaration}<launch>\n  <param name="a" value="\u00e9"/>\n</launch>\n'


@pytest.mark.parametrize(("codec", "declared"), [*product(_CODECS, _DECLARED)])
def test_a_file_is_taken_where_expat_takes_it(codec: str, declared: str | None, tmp_path: Path) -> None:
    path = tmp_path / "a.launch"
    path.write_bytes(_text(declared).encode(codec))
    found = Sources().launch_file(str(path))
    ours = not isinstance(found, Unreadable) and not found.document.problems
    try:
        minidom.parseString(path.read_bytes())
        theirs = True
    except (ExpatError, ValueError):
        theirs = False
    assert ours == theirs


def test_an_editor_has_decoded_what_it_shows() -> None:
    sources = Sources()
    sources.open("/a.launch", _text("utf-16"))
    found = sources.launch_file("/a.launch")
    assert not isinstance(found, Unreadable)
    assert found.document.problems == ()


@pytest.mark.parametrize("declared", ["punycode", "idna", "utf-7", "unicode_escape", "raw_unicode_escape", "rot13"])
def test_a_codec_that_is_no_encoding_of_files_is_not_asked(declared: str, tmp_path: Path) -> None:
    path = tmp_path / "a.launch"
    path.write_bytes(_text(declared).replace("\u00e9", "e").encode() + b"a-" * 200_000)
    found = Sources().launch_file(str(path))
    assert isinstance(found, Unreadable)
    assert found.reason == f"declares the encoding '{declared}', which is not known"


@pytest.mark.parametrize(
    "declared", ["us-ascii", "cp1252", "windows-1251", "koi8-r", "macintosh", "ISO-8859-15", "IBM850"]
)
def test_encodings_of_one_byte_for_a_character_are_read(declared: str, tmp_path: Path) -> None:
    path = tmp_path / "a.launch"
    path.write_bytes(_text(declared).replace("\u00e9", "e").encode())
    found = Sources().launch_file(str(path))
    assert not isinstance(found, Unreadable)
    minidom.parseString(path.read_bytes())
    assert found.document.problems == ()
