"""Which open documents are launch files, or may be read by one: everything else is left alone, whatever the editor
calls it."""

from __future__ import annotations

import re

from preflight_analysis.documents.python_text import LAUNCH_FUNCTION, is_python
from preflight_analysis.launch.read import LAUNCH_SUFFIXES, is_module, is_yaml

from preflight_server.lsp.text_store import OpenDocument

_LIKE_OTHER_XML = "_launch.xml"
"""Usual in ROS 2, but no name that only a launch file can have."""
_BLANKS = re.compile(r"\s*")
_DOCTYPE = re.compile(r"<!DOCTYPE[^<>]*>")
_LAUNCH_TAG = re.compile(r"<launch(?=[\s/>]|\Z)")


def is_launch_file(document: OpenDocument) -> bool:
    """By its name, by the language that the editor gave it, or, for other XML, by its document element."""
    if document.path is None:
        return False
    if is_python_launch_file(document):
        return True
    says_so = document.path.endswith(LAUNCH_SUFFIXES) and not document.path.endswith(_LIKE_OTHER_XML)
    if document.language_id == "roslaunch" or says_so:
        return document.language_id != "python"
    return document.language_id == "xml" and _is_launch(document.text)


def _is_launch(text: str) -> bool:
    """Whether `<launch` is the first tag, behind declarations and comments."""
    at = 1 if text.startswith("\ufeff") else 0
    while True:
        blanks = _BLANKS.match(text, at)
        at = blanks.end() if blanks else at
        if text.startswith(("<?", "<!--"), at):
            closing = "?>" if text.startswith("<?", at) else "-->"
            close = text.find(closing, at + 2)
            if close < 0:
                return False
            at = close + len(closing)
        elif doctype := _DOCTYPE.match(text, at):
            at = doctype.end()
        else:
            return _LAUNCH_TAG.match(text, at) is not None


def is_python_launch_file(document: OpenDocument) -> bool:
    """By its name, or by the function that launch calls. The user's Python language server has it too: we say only
    what is ours to say."""
    if document.path is None or not is_python(document.path, document.text):
        return False
    is_named = document.path.endswith(LAUNCH_SUFFIXES) and not is_module(document.path, document.text)
    return is_named or LAUNCH_FUNCTION.search(document.text) is not None


def may_be_parameter_file(document: OpenDocument) -> bool:
    """By its name: whether it is one, the launch files say."""
    return document.path is not None and is_yaml(document.path) and not is_launch_file(document)
